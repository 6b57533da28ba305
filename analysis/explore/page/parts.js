// SPDX-License-Identifier: GPL-3.0-or-later
// Bar that divides the pressure: contacts between large grains, the two parts of mixed contacts, contacts
// between small grains.

import {apart, byId, element, percent} from "./format.js";
import {state} from "./state.js";

/** Share of each part in the pressure of a layer, as a mean over layers and frames; B is computed from these shares. */
function meanParts(fit, stress) {
  const {none_large, all_large, all_small, phi_large, frames} = fit.arrays;
  const mean = {small: 0, large: 0, mixed: 0, given: 0, phi: 0};
  let n = 0;
  for (let k = 0; k < frames.length; ++k) {
    if (!(stress.total[k] > 0)) continue;
    const each = frames[k] / stress.total[k];
    mean.small += each * all_small[k];
    mean.large += each * none_large[k];
    mean.mixed += each * (all_large[k] - none_large[k]);
    mean.given += each * (stress.large[k] - none_large[k]);
    mean.phi += frames[k] * phi_large[k];
    n += frames[k];
  }
  for (const name of Object.keys(mean)) mean[name] /= n;
  return mean;
}

export class Parts {
  constructor() {
    this.spans = ["large", "to-large", "nobody", "to-small", "small"].map((name) => element("span", {class: `part ${name}`}));
    this.phi = element("span", {class: "phi"});
    this.words = element("p", {class: "note"});
    byId("parts").append(element("div", {class: "bar-of-parts"}, ...this.spans, this.phi), this.words);
  }

  /** Shows the bar for two species, and hides it for more. */
  update(fit, stress) {
    byId("parts").hidden = !fit.two;
    if (!fit.two) return;
    const {small, large, mixed, given, phi} = meanParts(fit, stress);
    const dropped = state.rule.kind === "drop";
    const parts = [
      ["large–large", large],
      ["mixed, to the large grain", dropped ? 0 : given],
      ["mixed, dropped", dropped ? mixed : 0],
      ["mixed, to the small grain", dropped ? 0 : mixed - given],
      ["small–small", small],
    ];
    parts.forEach(([name, value], k) => {
      const part = Math.max(0, value);
      this.spans[k].style.width = `${100 * part}%`;
      this.spans[k].textContent = part > 0.16 && !name.startsWith("mixed") ? name : "";
      this.spans[k].title = `${name}: ${percent(value)} of the pressure`;
    });
    this.phi.style.left = `${100 * phi}%`;
    const [carried, present] = apart([large + (dropped ? 0 : given), phi], percent, 0);
    this.words.replaceChildren(
      "Large grains carry ",
      element("b", {class: "large"}, carried),
      ` of the pressure (mean over layers). The vertical line marks their share of the grains, ${present}. Hatched: mixed contacts.`,
    );
  }
}
