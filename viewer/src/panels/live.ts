// SPDX-License-Identifier: MIT
// The controls of a live run: what to run, and what to do to it. Everything here becomes either a start
// or an intervention; the panel keeps only what has been typed in.
import { algorithms } from '../algorithms';
import { button, h, setText } from '../dom';
import { aboutOf, scenarios as builtIn, type Scenario } from '../scenarios';
import type { Experiment } from '../link';
import type { Intervention } from '../source/protocol';
import type { Settings } from '../state/controls';

/** What the pointer does in the picture, beside looking. */
export type Tool = 'look' | 'add_target' | 'add_obstacle' | 'kill_area';

export interface LiveChoice {
  picked: string; // of those that come with Banyan; "": it is the visitor's own
  name: string;
  text: string; // of the scenario
  /** One or two algorithms, side by side; "": the scenario's own. */
  algorithms: string[];
  /** Of the runs side by side; null: the scenario's own. */
  seeds: (number | null)[];
  overrides: string[]; // "key=value", beside algorithm and seed
}

export interface LiveActions {
  start(choice: LiveChoice): void;
  /** Beside what is shown. */
  add(choice: LiveChoice): void;
  /** Many seeds, small, from this one on. */
  many(choice: LiveChoice, firstSeed: number): void;

  reset(): void;
  undo(): void;
  redo(): void;
  /** What is selected. */
  remove(): void;
  setTool(tool: Tool): void;
  intervene(events: Intervention[]): void;
  saveRecording(): void;
  saveScenario(): void;
}

const ownName = 'own';

export class LivePanel {
  readonly element: HTMLElement;
  private own: { name: string; text: string } | null = null;
  private scenarios: Scenario[] = builtIn;
  private readonly scenario = h('select', { id: 'live-scenario', onchange: () => this.describe() });
  private readonly about = h('p', { class: 'hint' });
  private readonly first = this.algorithmSelect('live-algorithm', 'the scenario’s');
  private readonly second = this.algorithmSelect('live-versus', 'nothing');
  private readonly repeats = h('select', { id: 'live-repeats' }, ...[1, 2, 3, 4].map((n) => h('option', { value: n }, n === 1 ? 'this one only' : `${n} in a row`)));
  private readonly seed = h('input', { id: 'live-seed', type: 'number', min: 0, step: 1, placeholder: 'the scenario’s' });
  private readonly keys = h('textarea', {
    id: 'live-keys', rows: 3, spellcheck: false, placeholder: 'radio.loss = 0.3\nswarm.redundancy = 3', 'aria-describedby': 'live-keys-help',
  });
  private readonly problems = h('ul', { class: 'problems', role: 'alert' });
  private readonly loss = h('input', { id: 'live-loss', type: 'range', min: 0, max: 0.95, step: 0.05, value: 0 });
  private readonly lossText = h('output', { for: 'live-loss' }, '0 %');
  private readonly sight = h('input', { id: 'live-sight', type: 'checkbox' });
  private readonly tools: Record<Exclude<Tool, 'look'>, HTMLButtonElement>;
  private readonly now: HTMLFieldSetElement;
  private tool: Tool = 'look';
  private sliding = false; // the visitor holds the slider: it stays where it is

  constructor(private readonly actions: LiveActions) {
    this.tools = {
      add_target: button('Add target', 'Then click where it is to be (T)', () => this.choose('add_target'), { 'aria-pressed': 'false' }),
      add_obstacle: button('Add obstacle', 'Then click where it is to be, or draw it from its middle (X)', () => this.choose('add_obstacle'), { 'aria-pressed': 'false' }),
      kill_area: button('Kill area', 'Then draw a rectangle: all robots in it die (K)', () => this.choose('kill_area'), { 'aria-pressed': 'false' }),
    };
    this.loss.addEventListener('input', () => { this.sliding = true; setText(this.lossText, percent(this.loss.value)); });
    for (const end of ['change', 'pointerup', 'pointercancel', 'blur']) this.loss.addEventListener(end, () => { this.sliding = false; });
    this.loss.addEventListener('change', () => actions.intervene([{ kind: 'set_loss', loss: Number(this.loss.value) }]));
    this.sight.addEventListener('change', () => actions.intervene([{ kind: 'set_line_of_sight', line_of_sight: this.sight.checked }]));
    this.now = this.interventions();
    this.element = h('section', { class: 'live', 'aria-label': 'Live' }, this.startForm(), this.now);
    this.offer();
    this.setLive(null);
  }

  /** A scenario that is not one of ours: from the program or dropped on the page. */
  setOwn(name: string, text: string, overrides: string[]): void {
    this.own = { name, text };
    this.offer();
    this.scenario.value = ownName;
    this.keys.value = overrides.join('\n');
    this.describe();
  }

  /** Other scenarios to choose from than those built in; there is at least one. */
  setScenarios(scenarios: Scenario[]): void {
    this.scenarios = scenarios;
    this.offer();
  }

  setProblems(problems: string[]): void {
    this.problems.replaceChildren(...problems.map((p) => h('li', {}, p)));
  }

  /** Of the live run at the moment that is shown; null: none is. */
  setLive(settings: Settings | null): void {
    this.now.disabled = settings === null;
    if (settings === null) return;
    this.sight.checked = settings.lineOfSight;
    if (this.sliding) return;
    const loss = String(settings.loss);
    if (this.loss.value !== loss) this.loss.value = loss;
    setText(this.lossText, percent(loss));
  }

  setTool(tool: Tool): void {
    this.tool = tool;
    for (const [name, element] of Object.entries(this.tools)) element.setAttribute('aria-pressed', String(name === tool));
  }

  /** As an address has it; false: there is no such scenario. */
  set(experiment: Experiment): boolean {
    const { scenario, name, text, algorithms, seeds, sets } = experiment;
    if (text !== '') this.setOwn(name === '' ? 'link.toml' : name, text, []);
    else if (!this.pick(scenario)) return false;
    this.first.value = algorithms[0] ?? '';
    this.second.value = algorithms[1] ?? '';
    this.seed.value = seeds[0] === undefined ? '' : String(seeds[0]);
    this.repeats.value = String(Math.min(4, Math.max(1, seeds.length)));
    this.keys.value = sets.join('\n');
    return true;
  }

  /** One run of those that a choice means. */
  narrow(algorithm: string, seed: number): void {
    this.first.value = algorithm;
    this.second.value = '';
    this.seed.value = String(seed);
    this.repeats.value = '1';
  }

  compare(first: string, second: string): void {
    this.first.value = first;
    this.second.value = second;
  }

  private get picked(): string { return this.scenario.value === ownName ? '' : this.scenario.value; }

  choice(): LiveChoice {
    const picked = this.scenarios.find((s) => s.name === this.scenario.value);
    const { name, text } = this.own && this.scenario.value === ownName ? this.own : (picked ?? this.scenarios[0]);
    const overrides = this.keys.value.split('\n').map(assignment).filter((line) => line !== '');
    const count = Number(this.repeats.value);
    const first = this.seed.value === '' ? (count === 1 ? null : seedIn(text)) : Number(this.seed.value);
    const seeds = first === null ? [null] : Array.from({ length: count }, (_, k) => first + k);
    return { picked: this.picked, name, text, algorithms: [this.first.value, ...(this.second.value === '' ? [] : [this.second.value])], seeds, overrides };
  }

  /** Picks one of the built-in scenarios by its name. */
  pick(name: string): boolean {
    if (!this.scenarios.some((s) => s.name === name)) return false;
    this.scenario.value = name;
    this.describe();
    return true;
  }

  private many(): void {
    const choice = this.choice();
    this.actions.many(choice, choice.seeds[0] ?? seedIn(choice.text));
  }

  private choose(tool: Tool): void {
    this.actions.setTool(this.tool === tool ? 'look' : tool);
  }

  private algorithmSelect(id: string, none: string): HTMLSelectElement {
    return h('select', { id }, h('option', { value: '' }, none), ...algorithms.map((a) => h('option', { value: a }, a)));
  }

  private offer(): void {
    const before = this.scenario.value;
    this.scenario.replaceChildren(
      ...(this.own ? [h('option', { value: ownName }, this.own.name)] : []),
      ...this.scenarios.map((s) => h('option', { value: s.name }, s.name)),
    );
    this.scenario.value = before || 'three-targets';
    if (this.scenario.selectedIndex < 0) this.scenario.selectedIndex = 0;
    this.describe();
  }

  private describe(): void {
    const own = this.scenario.value === ownName ? this.own : null;
    setText(this.about, own ? aboutOf(own.text) : (this.scenarios.find((s) => s.name === this.scenario.value)?.about ?? ''));
  }

  private startForm(): HTMLElement {
    const form = h(
      'form',
      { onsubmit: (event: SubmitEvent) => { event.preventDefault(); this.actions.start(this.choice()); } },
      field('Scenario', 'live-scenario', this.scenario),
      this.about,
      field('Algorithm', 'live-algorithm', this.first),
      field('Beside it', 'live-versus', this.second),
      field('Seed', 'live-seed', this.seed),
      field('Seeds', 'live-repeats', this.repeats),
      h('details', {}, h('summary', {}, 'Change other keys'),
        h('label', { for: 'live-keys', class: 'hint', id: 'live-keys-help' }, 'One “key = value” a line, as with banyan run --set.'), this.keys),
      h('button', { type: 'submit', class: 'primary' }, 'Start'),
      h('div', { class: 'buttons' },
        button('Add beside', 'Beside the runs and recordings that are shown, up to four', () => this.actions.add(this.choice())),
        button('Many seeds …', 'Many runs of this, small, and what they come to', () => this.many())),
      this.problems,
    );
    return form;
  }

  private interventions(): HTMLFieldSetElement {
    return h(
      'fieldset',
      { class: 'now' },
      h('legend', {}, 'While it runs'),
      h('p', { class: 'hint' }, 'Drag a target or an obstacle; Remove takes away the one that you click. Go back in time and do something else: the run is simulated anew from there.'),
      h('div', { class: 'buttons' }, this.tools.add_target, this.tools.add_obstacle, this.tools.kill_area,
        button('Remove', 'The selected target or obstacle is no more; a selected robot dies (Delete)', this.actions.remove),
        button('Undo', 'Takes back what you did last (U)', this.actions.undo),
        button('Redo', 'Does again what you took back last (Y)', this.actions.redo),
        button('Reset', 'The same run from its beginning, without what you did', this.actions.reset),
        button('Blackout', 'Nobody hears anything for a second', () => this.actions.intervene([{ kind: 'blackout', duration_s: 1 }]))),
      h('div', { class: 'field' }, h('label', { for: 'live-loss' }, 'Packet loss'), this.loss, this.lossText),
      h('label', { class: 'switch' }, this.sight, 'Line of sight: bodies and obstacles block the radio'),
      h('div', { class: 'buttons' },
        button('Save .mcap', 'The run so far as a recording', this.actions.saveRecording),
        button('Save .toml', 'The scenario with all you have done to it; banyan run repeats it', this.actions.saveScenario)),
    );
  }
}

/** A scenario's own seed; 1 if it names none. */
export const seedIn = (text: string): number => Number(/^\s*"?seed"?\s*[=:]\s*(\d+)/m.exec(text)?.[1] ?? 1);

const percent = (value: string) => `${Math.round(Number(value) * 100)} %`;

/** "radio.loss = 0.3  # much" as --set wants it; "" for an empty line or a remark. */
export function assignment(line: string): string {
  const text = line.replace(/^\s*#.*$/, '').trim();
  const equals = text.indexOf('=');
  return equals < 0 ? text : `${text.slice(0, equals).trim()}=${text.slice(equals + 1).trim()}`;
}

function field(label: string, id: string, control: HTMLElement): HTMLElement {
  return h('div', { class: 'field' }, h('label', { for: id }, label), control);
}
