// SPDX-License-Identifier: GPL-3.0-or-later
// Keyboard shortcuts. Keys that the focused control uses itself are left to the control.

import {byId} from "./format.js";
import {isShare, parseRule, shareOf} from "./partition.js";
import {set, state} from "./state.js";

/** `page`: {fit(), zero(), step(by), play(), nextGrain(by), nextRun(), tab(name), theme(), rules}. */
export function listenToKeys(page) {
  const move = (by) => {
    const fit = page.fit();
    if (!fit) return;
    const p = shareOf(fit, state.rule);
    const next = Math.round(1000 * ((Number.isFinite(p) ? p : 0.5) + by)) / 1000;
    set({rule: {kind: "uniform", value: Math.min(1, Math.max(0, next))}});
  };
  const toZero = () => {
    const fit = page.fit();
    const p = fit ? page.zero() : NaN;
    if (isShare(p)) set({rule: {kind: "uniform", value: p}});
  };
  const keys = {
    " ": () => page.play(),
    ArrowLeft: () => page.step(-1),
    ArrowRight: () => page.step(1),
    ArrowUp: (event) => move(event.shiftKey ? 0.05 : 0.005),
    ArrowDown: (event) => move(event.shiftKey ? -0.05 : -0.005),
    0: toZero,
    g: () => byId("show-grains").click(),
    f: () => byId("show-forces").click(),
    m: () => byId("only-mixed").click(),
    l: () => byId("show-layers").click(),
    ".": () => page.nextGrain(1),
    ",": () => page.nextGrain(-1),
    Escape: () => set({grain: -1}),
    n: () => page.nextRun(),
    r: () => page.tab(byId("report").hidden ? "report" : "explore"),
    t: () => page.theme(),
    "?": () => byId("help").showModal(),
  };
  page.rules.forEach((word, k) => (keys[k + 1] = () => page.fit() && set({rule: parseRule(word)})));

  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || byId("help").open) return;
    const {target} = event;
    const typing = target.matches("input[type=number], select, textarea");
    const ownArrows = target.matches("input[type=range], [role=tab], input[type=radio]") && event.key.startsWith("Arrow");
    const ownSpace = event.key === " " && target.matches("button, summary, input[type=checkbox], input[type=radio], a");
    const explore = !byId("explore").hidden;
    if (typing || ownArrows || ownSpace || !keys[event.key]) return;
    if (!explore && !["r", "t", "?"].includes(event.key)) return;
    event.preventDefault();
    keys[event.key](event);
  });
}
