// SPDX-License-Identifier: MIT
// One robot in full: its state, its neighbours, its last message.
import { button, h, setText } from '../dom';
import { column, type Column, type Frame, needs, phases, roles, spareStates } from '../frame';

/** A row of the state: its name, and its value in words. */
export interface Fact {
  name: string;
  value: string;
  robot?: number; // the value is this robot
  help?: string;
}

const nobody = '–';

/** The values in a frame where the algorithm has no such quantity: what no report has set in these columns. */
const untouched: Partial<Record<Column, number>> = {
  role: 0, target: -1, phase: 0, epoch: 0, label_m: -1, depth: 0, parent: -1, old_parent: -1, want_m: 0,
};

/** Whether some robot's report has a value in one of these columns. Before the first tick no robot has been in a
 *  tree yet: there the roles decide. */
function reported(frame: Frame, ...names: Column[]): boolean {
  return names.some((name) => column(frame, name).some((value) => value !== untouched[name]));
}

/** What the frame says of a robot, in the order of the inspector: of an algorithm without roles, or that builds no trees
 *  as the paper does, only what its reports have. */
export function facts(frame: Frame, robot: number): Fact[] {
  const hasRoles = reported(frame, 'role');
  const hasTree = reported(frame, 'phase', 'label_m', 'depth', 'old_parent') || (frame.tick === 0 && hasRoles);
  const own: Partial<Record<string, boolean>> = {
    epoch: reported(frame, 'epoch'), parent: reported(frame, 'parent'), children: reported(frame, 'parent'), want: reported(frame, 'want_m'),
  };
  const get = (name: Column) => column(frame, name)[robot];
  const who = (name: Column, help: string): Fact => {
    const other = get(name);
    return other < 0 ? { name, value: nobody, help } : { name, value: `robot ${other}`, robot: other, help };
  };
  const role = roles[get('role')] ?? 'unknown';
  const target = get('target');
  const children: number[] = [];
  const parents = column(frame, 'parent');
  const allRoles = column(frame, 'role');
  const alive = column(frame, 'alive');
  for (let i = 0; i < frame.robots; ++i) if (parents[i] === robot && allRoles[i] !== 0 && alive[i] === 1) children.push(i);
  const ofTree: Fact[] = [
    { name: 'phase', value: phases[get('phase')] ?? 'unknown', help: 'Of the reconstruction of the tree, as this robot knows it' },
    { name: 'epoch', value: String(get('epoch')), help: 'Counts the trees' },
    { name: 'label', value: get('label_m') < 0 ? nobody : `${get('label_m').toFixed(2)} m`, help: 'Distance to the root along hops when the epoch began' },
    { name: 'depth', value: get('depth') === 0 ? nobody : String(get('depth')), help: 'In the tree; the root has 1' },
    who('parent', 'In the tree'),
    who('old_parent', 'In the old tree, while trees are switched'),
    { name: 'children', value: children.length === 0 ? nobody : children.join(', '), help: 'Living robots of the tree whose parent it is' },
    { name: 'need', value: needs[get('need')] ?? 'unknown', help: 'Of the edge to the parent: does it want a robot inserted' },
    who('grant', 'The spare that may join the edge to the parent'),
    { name: 'spare_state', value: role === 'spare' ? (spareStates[get('spare_state')] ?? 'unknown') : nobody },
    who('request', 'The owner of the edge that this spare wants to join'),
    { name: 'want', value: `${get('want_m').toFixed(2)} m`, help: 'Largest remaining distance of a worker below' },
  ];
  return [
    { name: 'position', value: `${get('x_m').toFixed(4)}, ${get('y_m').toFixed(4)} m`, help: 'The truth; the robot does not know it' },
    { name: 'heading', value: `${get('heading_rad').toFixed(4)} rad`, help: 'The truth' },
    ...(hasRoles ? [{ name: 'role', value: role }] : []),
    ...ofTree.filter(({ name }) => hasTree || own[name] === true),
    ...(hasRoles || reported(frame, 'target') ? [{ name: 'target', value: target < 0 ? nobody : `T${target}`, help: 'That it was sent to' }] : []),
    { name: 'alive', value: get('alive') === 1 ? 'yes' : 'no' },
    ...(hasRoles ? [{ name: 'connected', value: get('connected') === 1 ? 'yes' : 'no', help: 'Alive and in one radio component with the root' }] : []),
  ];
}

/** Recordings have enumerators by number, live runs by name. */
export function word(field: string, value: number | string | boolean): string {
  const names: Record<string, readonly string[]> = { role: roles, phase: phases, need: needs };
  if (typeof value !== 'number') return String(value);
  return names[field]?.[value] ?? String(Number.isInteger(value) ? value : Number(value.toPrecision(5)));
}

export interface InspectorActions {
  select(robot: number | null): void;
  follow(robot: number | null): void;
  kill(robot: number): void;
}

/** What a robot had broadcast last at a tick. */
export interface Said {
  tick: number;
  fields: Record<string, number | string | boolean> | null; // null: not known
  problem: string; // why it could not be asked for, in words; else ''
}

/** The message as rows; where there is none, why. */
export function messageFacts(said: Said, live: boolean): Fact[] {
  if (said.fields !== null) return Object.entries(said.fields).map(([name, value]) => ({ name, value: word(name, value) }));
  if (said.problem !== '') return [{ name: 'not known', value: said.problem }];
  // A recording without messages, or before the first; a live run keeps some only (docs/viewer.md).
  return [{ name: 'none', value: live ? 'not kept for this moment' : 'this recording has none for this moment' }];
}

export interface Inspected {
  frame: Frame;
  robot: number;
  neighbours: number[]; // robots it can hear
  said: Said | null; // null: not there yet
  followed: boolean;
  live: boolean;
}

export class Inspector {
  readonly element = h('section', { class: 'inspector', 'aria-label': 'Robot' });
  private readonly title = h('h2');
  private readonly follow = button('Follow', 'Keep this robot in the middle (F)', () => this.actions.follow(this.shown?.followed ? null : (this.shown?.robot ?? null)));
  private readonly kill = button('Kill', 'This robot dies now (Delete)', () => { if (this.shown) this.actions.kill(this.shown.robot); }, { class: 'danger' });
  private readonly state = h('table', { class: 'facts' });
  private readonly neighbours = h('div', { class: 'neighbours' });
  private readonly message = h('table', { class: 'facts message' });
  private readonly messageTitle = h('h3');
  private readonly body = h(
    'div', {},
    h('header', { class: 'robot-head' }, this.title, this.follow, this.kill, button('×', 'Close (Escape)', () => this.actions.select(null))),
    this.state, h('h3', {}, 'Neighbours in radio contact'), this.neighbours, this.messageTitle, this.message,
  );
  private readonly empty = h('p', { class: 'hint' }, 'Click a robot, or type its number and press Enter, to see what it knows, whom it hears and what it says.');
  private shown: Inspected | null = null;

  constructor(private readonly actions: InspectorActions) {
    this.element.append(this.empty);
  }

  update(shown: Inspected | null): void {
    this.shown = shown;
    const content = shown === null ? this.empty : this.body;
    if (this.element.firstChild !== content) this.element.replaceChildren(content);
    if (shown === null) return;
    const roleName = roles[column(shown.frame, 'role')[shown.robot]] ?? '';
    setText(this.title, `Robot ${shown.robot}`);
    this.title.dataset.role = roleName;
    setText(this.follow, shown.followed ? 'Unfollow' : 'Follow');
    this.follow.setAttribute('aria-pressed', String(shown.followed));
    this.kill.hidden = !shown.live || column(shown.frame, 'alive')[shown.robot] === 0;
    this.fill(this.state, facts(shown.frame, shown.robot));
    this.fillNeighbours(shown.neighbours);
    this.fillMessage(shown);
  }

  private fill(table: HTMLTableElement, rows: Fact[]): void {
    while (table.rows.length > rows.length) table.deleteRow(-1);
    rows.forEach((fact, k) => {
      const row = table.rows[k] ?? this.addRow(table);
      setText(row.cells[0], fact.name.replaceAll('_', ' '));
      row.title = fact.help ?? '';
      const cell = row.cells[1];
      if (cell.textContent === fact.value && cell.dataset.robot === (fact.robot === undefined ? undefined : String(fact.robot))) return;
      if (fact.robot === undefined) {
        delete cell.dataset.robot;
        cell.textContent = fact.value;
      } else {
        cell.dataset.robot = String(fact.robot);
        cell.replaceChildren(this.robotButton(fact.robot, fact.value));
      }
    });
  }

  private addRow(table: HTMLTableElement): HTMLTableRowElement {
    const row = table.insertRow();
    row.append(h('th', { scope: 'row' }));
    row.insertCell();
    return row;
  }

  private robotButton(robot: number, text: string): HTMLElement {
    return h('button', { type: 'button', class: 'link', title: `Show robot ${robot}`, onclick: () => this.actions.select(robot) }, text);
  }

  private fillNeighbours(neighbours: number[]): void {
    const key = neighbours.join(' ');
    if (this.neighbours.dataset.key === key) return;
    this.neighbours.dataset.key = key;
    this.neighbours.replaceChildren(...(neighbours.length === 0 ? ['none'] : neighbours.map((n) => this.robotButton(n, String(n)))));
  }

  private fillMessage(shown: Inspected): void {
    const { said } = shown;
    // It may be older than the tick that was asked for.
    setText(this.messageTitle, said?.fields ? `Last message up to tick ${said.tick}` : 'Last message');
    if (said !== null) this.fill(this.message, messageFacts(said, shown.live));
    // Of another robot until the answer comes; the rows stay, or the panel would jump.
    else for (const row of this.message.rows) setText(row.cells[1], '…');
  }
}
