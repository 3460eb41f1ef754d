// SPDX-License-Identifier: MIT
// A pen that writes SVG, with the part of a canvas's pen that the layers use. So an SVG shows what the picture shows,
// whatever is added to it. Whole circles become circles, everything else paths, arcs clockwise and never part of a filled outline; nothing is measured or clipped.

const digits = (px: number) => String(Math.round(px * 100) / 100);
export const escaped = (text: string) => text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);

type Attributes = Record<string, string | number | undefined>;

export function element(name: string, attributes: Attributes, content = ''): string {
  const written = Object.entries(attributes).flatMap(([key, value]) =>
    (value === undefined ? [] : [` ${key}="${typeof value === 'number' ? digits(value) : escaped(value)}"`])).join('');
  return content === '' ? `<${name}${written}/>` : `<${name}${written}>${content}</${name}>`;
}

interface Circle { x: number; y: number; radius: number }

const wholeCircle = 2 * Math.PI - 1e-9;

export class SvgPen {
  globalAlpha = 1;
  fillStyle = '#000000';
  strokeStyle = '#000000';
  lineWidth = 1;
  lineCap = 'butt';
  lineJoin = 'miter';
  private dashes: number[] = [];
  private path: string[] = [];
  private circles: Circle[] = [];
  private readonly written: string[] = [];

  /** What has been drawn so far. */
  get content(): string { return this.written.join('\n'); }

  /** What is drawn meanwhile is a group with this name. */
  group(name: string, draw: () => void): void {
    const from = this.written.length;
    draw();
    const inside = this.written.splice(from);
    if (inside.length > 0) this.written.push(element('g', { class: name }, `\n${inside.join('\n')}\n`));
  }

  beginPath(): void {
    this.path = [];
    this.circles = [];
  }
  moveTo(x: number, y: number): void { this.path.push(`M${digits(x)} ${digits(y)}`); }
  lineTo(x: number, y: number): void { this.path.push(`${this.path.length === 0 ? 'M' : 'L'}${digits(x)} ${digits(y)}`); }
  closePath(): void { this.path.push('Z'); }

  arc(x: number, y: number, radius: number, from: number, to: number): void {
    const at = (angle: number) => `${digits(x + radius * Math.cos(angle))} ${digits(y + radius * Math.sin(angle))}`;
    if (this.path.at(-1) === `M${at(from)}`) this.path.pop(); // to where it begins
    if (to - from >= wholeCircle) this.circles.push({ x, y, radius });
    else this.path.push(`M${at(from)}A${digits(radius)} ${digits(radius)} 0 ${to - from > Math.PI ? 1 : 0} 1 ${at(to)}`);
  }

  setLineDash(dashes: number[]): void { this.dashes = dashes; }

  fill(): void { this.put({ fill: this.fillStyle }); }
  stroke(): void { this.put({ fill: 'none', ...this.lines() }); }
  fillRect(x: number, y: number, width: number, height: number): void {
    this.write('rect', { x, y, width, height, fill: this.fillStyle });
  }
  strokeRect(x: number, y: number, width: number, height: number): void {
    this.write('rect', { x, y, width, height, fill: 'none', ...this.lines() });
  }

  /** One line of text that begins at x, its middle at y; `halo`: what it is set off with. */
  text(words: string, x: number, y: number, look: { sizePx: number; weight: number; family: string; color: string }, halo?: Attributes): void {
    this.write('text', {
      x, y, fill: look.color, 'font-size': look.sizePx, 'font-weight': look.weight, 'font-family': look.family,
      'dominant-baseline': 'central', ...halo,
    }, escaped(words));
  }

  private lines(): Attributes {
    return {
      stroke: this.strokeStyle, 'stroke-width': this.lineWidth, 'stroke-linecap': this.lineCap, 'stroke-linejoin': this.lineJoin,
      'stroke-dasharray': this.dashes.length === 0 ? undefined : this.dashes.join(' '),
    };
  }

  private put(how: Attributes): void {
    if (this.path.length > 0) this.write('path', { d: this.path.join(''), ...how });
    for (const { x, y, radius } of this.circles) this.write('circle', { cx: x, cy: y, r: radius, ...how });
  }

  private write(name: string, attributes: Attributes, content = ''): void {
    this.written.push(element(name, { ...attributes, opacity: this.globalAlpha === 1 ? undefined : this.globalAlpha }, content));
  }
}
