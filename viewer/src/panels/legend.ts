// SPDX-License-Identifier: MIT
// What the colours mean.
import { h } from '../dom';

export function legend(): HTMLElement {
  const entry = (name: string) => {
    const dot = h('i');
    dot.style.background = `var(--${name})`;
    return h('span', {}, dot, name);
  };
  return h('div', { class: 'legend', 'aria-hidden': 'true' }, ...['root', 'worker', 'connector', 'spare', 'target'].map(entry));
}
