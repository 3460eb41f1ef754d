// SPDX-License-Identifier: MIT
// Banyan's sign: a root, three workers, a relay on each way. The same as public/icon.svg.
import icon from '../../public/icon.svg?raw';

export function logo(): SVGElement {
  const svg = new DOMParser().parseFromString(icon, 'image/svg+xml').documentElement as unknown as SVGElement;
  svg.setAttribute('aria-hidden', 'true');
  svg.querySelector('g')?.setAttribute('stroke', 'currentColor');
  return svg;
}
