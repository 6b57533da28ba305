// SPDX-License-Identifier: GPL-3.0-or-later
// Table of several runs: B under the selected rule for each run, and for all runs together.

import {byId, element, fixed, interval} from "./format.js";
import {fitOf, intervalOf, zeroOf} from "./partition.js";
import {set, state} from "./state.js";

export class Compare {
  /** `all`: [{name, fit, why}] by run, the last entry for all runs together; `why`: reason if there is no fit. */
  constructor(all) {
    this.all = all;
    byId("compare").hidden = all.length < 2;
    if (all.length < 2) return;
    const heads = ["run", "B", "95 %", "over", "p*"].map((text, k) => element("th", k ? {class: "number"} : {}, text));
    this.rows = all.map(({name}, k) => {
      const button = element("button", {class: "link"}, name);
      button.addEventListener("click", () => set({run: k, ...(k < all.length - 1 ? {player: k, grain: -1} : {})}));
      const cells = heads.slice(1).map(() => element("td", {class: "number"}));
      return {row: element("tr", {}, element("td", {}, button), ...cells), cells, button};
    });
    byId("compare-table").append(
      element("thead", {}, element("tr", {}, ...heads)),
      element("tbody", {}, ...this.rows.map(({row}) => row)),
    );
    const why = all[all.length - 1].why;
    byId("compare-note").textContent = why
      ? `The runs have no common B: ${why}`
      : "The plots show the chosen run; thin lines in the plot of B over p are the other runs.";
  }

  update() {
    if (!this.rows) return;
    this.all.forEach(({fit}, k) => {
      const {row, cells, button} = this.rows[k];
      row.classList.toggle("chosen", k === state.run);
      button.disabled = !fit;
      if (!fit) return;
      const B = fitOf(fit, state.rule).B;
      const {interval: ends} = intervalOf(fit, state.rule);
      const texts = [fixed(B), Number.isFinite(B) ? interval(ends) : "", fit.over, fixed(zeroOf(fit)[0])];
      texts.forEach((text, n) => (cells[n].textContent = text));
    });
  }
}
