// SPDX-License-Identifier: GPL-3.0-or-later
// What the reader has chosen. A change tells all who listen once, before the browser paints next.

export const state = {
  tab: "explore",
  rule: {kind: "size", value: NaN},
  run: 0, // that plots are of; the number of runs: all together
  time: 0, // s
  player: 0, // the run of which a grain was chosen
  grain: -1, // of it
  layer: null, // [bottom, top] in m, of the pointer
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

/** Tells them now. */
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
