// SPDX-License-Identifier: MIT
// The compiled module is not there when types are checked; what comes out of it is.
declare module '@live/banyan_live.mjs' {
  const create: (options?: object) => Promise<import('./live_module').LiveModule>;
  export default create;
}
