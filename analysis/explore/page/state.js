// SPDX-License-Identifier: GPL-3.0-or-later
// State of the page: the reader's choices. Listeners are called once for all changes between two repaints.

export const state = {
  tab: "explore",
  rule: {kind: "size", value: NaN},
  run: 0, // number of the run that the plots show, from 0; the number of runs means all runs together
  time: 0, // time of the frame shown, s
  player: 0, // number of the run of the chosen grain
  grain: -1, // number of the chosen grain in the page, -1: none
  layer: null, // [bottom, top] of the layer under the pointer, m
  showGrains: true,
  showForces: true,
  onlyMixed: false,
  showLayers: false,
};

const listeners = [];
let changed = null;

/** Adds a listener, which is called with the names of the entries that have changed. */
export function listen(listener) {
  listeners.push(listener);
}

/** Calls the listeners now if anything has changed. */
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
