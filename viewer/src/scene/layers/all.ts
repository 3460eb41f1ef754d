// SPDX-License-Identifier: MIT
// Everything above ground, obstacles and radio links, in the order in which it is drawn. One list, so that whatever
// makes a picture (a canvas, an SVG) has the same in it.
import type { Shot } from '../shot';
import { drawCharge } from './charge';
import { drawJoining } from './joining';
import { drawCommitted, drawHeadings, drawSparesAndDead } from './robots';
import { drawOverSelection, drawUnderSelection } from './selection';
import { drawTargets } from './targets';
import { drawTrails } from './trails';
import { drawTree } from './tree';

export interface Layer { name: string; draw(shot: Shot): void }

/** Labels and the scale bar come on top of them. */
export const layers: readonly Layer[] = [
  { name: 'trails', draw: drawTrails },
  { name: 'targets', draw: drawTargets },
  { name: 'below selection', draw: drawUnderSelection },
  { name: 'headings', draw: drawHeadings },
  { name: 'spares and dead', draw: drawSparesAndDead },
  { name: 'tree', draw: drawTree },
  { name: 'joining', draw: drawJoining },
  { name: 'committed', draw: drawCommitted },
  { name: 'charge', draw: drawCharge },
  { name: 'selection', draw: drawOverSelection },
];
