// SPDX-License-Identifier: MIT
// The door of the compiled simulation as this side sees it.
export type { Live as LiveClass, BanyanLive as LiveModule } from '../../live/live';
