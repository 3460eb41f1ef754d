// SPDX-License-Identifier: MIT
// The interface of the compiled simulation as this side sees it.
export type { Live as LiveClass, BanyanLive as LiveModule } from '../../live/live';
