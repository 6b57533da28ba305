// SPDX-License-Identifier: GPL-3.0-or-later
// The state of the page: the reader's choices. Listeners are called once for all changes between two paints.

export const state = {
  tab: "explore",
  rule: {kind: "size", value: NaN},
  run: 0, // of the plots; the number of runs stands for all together
  time: 0, // s
  player: 0, // run of the chosen grain
  grain: -1, // the chosen grain, -1: none
  layer: null, // [bottom, top] in m, under the pointer
  showGrains: true,
  showForces: true,
  onlyMixed: false,
  showLayers: false,
};

const listeners = [];
let changed = null;

/** `listener` gets the names of what has changed. */
export function listen(listener) {
  listeners.push(listener);
}

/** Calls the listeners now. */
export function flush() {
  if (!changed) return;
  const names = changed;
  changed = null;
  for (const listener of listeners) listener(names);
}

export function set(changes) {
  if (!changed) {
    changed = new Set();
    requestAnimationFrame(flush);
  }
  for (const [name, value] of Object.entries(changes)) {
    state[name] = value;
    changed.add(name);
  }
}
