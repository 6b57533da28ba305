// SPDX-License-Identifier: GPL-3.0-or-later
// The fragment of the address (after #) stores the state of the page, so that a link shows the same view:
// "#report&rule=uniform:0.62&time=4.5&run=2&grain=2:17&draw=forces,layers".

import {byId} from "./format.js";
import {parseRule, ruleName} from "./partition.js";
import {listen, set, state} from "./state.js";

/** Checkboxes that select what is drawn: [word in the address, id of the element, name in the state]. */
export const boxes = [
  ["grains", "show-grains", "showGrains"],
  ["forces", "show-forces", "showForces"],
  ["mixed", "only-mixed", "onlyMixed"],
  ["layers", "show-layers", "showLayers"],
];

/** Fragment of the present state. Runs are numbered from 1, the last number means all runs together; a grain is RUN:ROW, with its row in the file. */
function fragment(page) {
  const {tab, rule, time, run, player, grain} = state;
  const words = [tab, `rule=${ruleName(rule)}`, `time=${Number(time.toPrecision(6))}`];
  if (page.fits.length > 1) words.push(`run=${run + 1}`);
  if (grain >= 0) words.push(`grain=${player + 1}:${page.players[player].frames.arrays.row[grain]}`);
  words.push(`draw=${boxes.filter(([, , name]) => state[name]).map(([word]) => word)}`);
  return `#${words.join("&")}`;
}

/** Sets the state from the address; rules, runs and grains that the page does not have are ignored. */
export function restore(page) {
  const told = new URLSearchParams(window.location.hash.slice(1));
  const changes = {};
  const rule = parseRule(told.get("rule") ?? "");
  if (Number.isFinite(rule.value) || page.ruleWords.includes(rule.kind)) changes.rule = rule;
  const run = told.get("run") - 1;
  if (page.fits[run]) Object.assign(changes, {run, grain: -1}, page.players[run] && {player: run});
  const [player, row] = (told.get("grain") ?? "").split(":").map(Number);
  const grain = page.players[player - 1]?.frames.arrays.row.indexOf(row) ?? -1;
  if (grain >= 0) Object.assign(changes, {player: player - 1, grain});
  const drawn = told.get("draw")?.split(",");
  if (drawn)
    for (const [word, id, name] of boxes) byId(id).checked = changes[name] = drawn.includes(word);
  set(changes);
  const time = parseFloat(told.get("time"));
  if (Number.isFinite(time)) page.transport.goToTime(time);
  const tab = ["report", "explore"].find((name) => told.has(name));
  if (tab) page.showTab(tab);
}

/** Updates the address 0.4 s after the last of several changes, because browsers allow few changes per second. */
export function keepAddress(page) {
  let waiting = 0;
  listen(() => {
    clearTimeout(waiting);
    waiting = setTimeout(() => window.history.replaceState(null, "", fragment(page)), 400);
  });
  window.addEventListener("hashchange", () => restore(page));
}
