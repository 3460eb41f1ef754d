// SPDX-License-Identifier: MIT
// Elements in one expression, so that panels read like what they show. All text goes in as text: nothing
// from a file can become markup.

type Attributes = Record<string, string | number | boolean | undefined | ((event: never) => void)>;

/** `on…` attributes that are functions become listeners; false and undefined leave an attribute out. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name.slice(2), value as EventListener);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false && value !== undefined) element.setAttribute(name, String(value));
  }
  element.append(...children);
  return element;
}

/** A button. Its label is its name, so that it can be called by what is seen; one that shows only a sign is called by
 *  its title. */
export function button(sign: string | Node, title: string, onclick: () => void, attributes: Attributes = {}): HTMLButtonElement {
  const isLabel = typeof sign === 'string' && /[A-Za-z]{2}/.test(sign);
  return h('button', { type: 'button', title, ...(isLabel ? {} : { 'aria-label': title }), onclick, ...attributes }, sign);
}

const icons = {
  play: 'M7 4.5v15l12.5-7.5z',
  pause: 'M6.5 4.5h4v15h-4zM13.5 4.5h4v15h-4z',
  back: 'M15.5 5v14L6 12z',
  on: 'M8.5 5v14l9.5-7z',
  last: 'M5 5h2.5v14H5zM18.5 5v14L9 12z',
  loop: 'M7 7h10v3l4-4-4-4v3H5v6h2zM17 17H7v-3l-4 4 4 4v-3h12v-6h-2z',
  next: 'M16.5 5H19v14h-2.5zM5.5 5v14L15 12z',
};
export type Icon = keyof typeof icons;

/** Drawn, not written: fonts differ in what signs they have. */
export function icon(name: Icon): SVGSVGElement {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(space, 'path');
  path.setAttribute('d', icons[name]);
  svg.append(path);
  return svg;
}

/** Sets a text only if it differs: a text that is set is laid out again. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

/** Hands a file to the visitor. */
export function download(name: string, blob: Blob): void {
  const url = URL.createObjectURL(blob);
  const link = h('a', { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
