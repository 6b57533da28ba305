// SPDX-License-Identifier: GPL-3.0-or-later
// What the rule makes of each layer: the pressures of both species, and B.

import {Chart} from "./chart.js";
import {line, scaleLinear} from "./d3.js";
import {byId} from "./format.js";
import {estimatorsOf, stressOf} from "./partition.js";
import {set, state} from "./state.js";

/** Calls on the layer under the pointer. */
function follow(chart, layers) {
  const svg = chart.svg.node();
  svg.addEventListener("pointermove", (event) => {
    const y = chart.scales.y.invert(event.clientY - svg.getBoundingClientRect().top);
    const layer = layers().find(([bottom, top]) => y >= bottom && y < top);
    const own = layer ? layer[2] : null;
    if (String(own) !== String(state.layer)) set({layer: own});
  });
  svg.addEventListener("pointerleave", () => set({layer: null}));
}

export class Profiles {
  constructor(fitOfRun, smallDiameter, unitOfStress) {
    this.fitOfRun = fitOfRun;
    this.smallDiameter = smallDiameter;
    const height = 300;
    this.pressure = new Chart(byId("profile-plot"), {
      scales: {x: scaleLinear(), y: scaleLinear()},
      labels: {x: `σ (${unitOfStress()})`, y: "y/d_S"},
      height,
      name: "Pressure of small and of large grains, and of both, over height",
    });
    this.strength = new Chart(byId("layers-plot"), {
      scales: {x: scaleLinear(), y: scaleLinear()},
      labels: {x: "B of the layer", y: "y/d_S"},
      height,
      name: "B of each layer over height",
    });
    this.unitOfStress = unitOfStress;
    this.lines = ["total", "small", "large"].map((name) => this.pressure.marks.append("path").attr("class", `profile ${name}`));
    this.nothing = this.strength.under.append("line").attr("class", "zero-line");
    this.all = this.strength.under.append("line").attr("class", "all-line");
    this.dots = this.strength.marks.append("g");
    for (const chart of [this.pressure, this.strength]) follow(chart, () => this.layers ?? []);
  }

  layout() {
    const fit = this.fitOfRun();
    const {layer_bottom, layer_top, bottom, frames, phi_large} = fit.arrays;
    const d = this.smallDiameter();
    this.layers = Array.from(layer_bottom, (y, k) => [y / d, layer_top[k] / d, [y, layer_top[k]]]);
    const top = Math.max(...this.layers.map(([, y]) => y));
    const {large, total} = stressOf(fit, {kind: "uniform", value: 1}, "layer_");
    this.pressure.scales.x.domain([Math.min(0, ...large), Math.max(...total)]).nice();
    this.pressure.scales.y.domain([0, top]);
    this.pressure.setLabels({x: `σ (${this.unitOfStress()})`, y: "y/d_S"});
    this.pressure.layout();

    // The layers of the fit, and by which weight they count in it.
    const heights = [...new Set(bottom)].sort((a, b) => a - b);
    this.fitted = heights.map((y) => {
      const own = Array.from(bottom.keys()).filter((k) => bottom[k] === y);
      const weight = own.reduce((sum, k) => sum + frames[k] * phi_large[k] * (1 - phi_large[k]), 0);
      const k = this.layers.findIndex(([, , [low]]) => low === y);
      return {y: (this.layers[k][0] + this.layers[k][1]) / 2, own: new Set(own), weight};
    });
    const heaviest = Math.max(...this.fitted.map((layer) => layer.weight));
    for (const layer of this.fitted) layer.light = layer.weight < heaviest / 10;
    const ends = [0.35, 0.85].flatMap((p) => this.#strengths(stressOf(fit, {kind: "uniform", value: p})));
    const finite = ends.filter((B) => Number.isFinite(B));
    this.strength.scales.x.domain([Math.max(-3, Math.min(...finite, 0)), Math.min(3, Math.max(...finite, 0))]).nice();
    this.strength.scales.y.domain([0, top]);
    this.strength.layout();
    const {x} = this.strength.scales, {top: high, bottom: low} = this.strength.inner;
    this.nothing.attr("x1", x(0)).attr("x2", x(0)).attr("y1", high).attr("y2", low);
  }

  #strengths(stress) {
    const fit = this.fitOfRun();
    return this.fitted.map(({own}) => estimatorsOf(fit, stress, (k) => own.has(k))[state.estimator]);
  }

  update(stress, found) {
    const fit = this.fitOfRun();
    const means = stressOf(fit, state.rule, "layer_");
    const {x, y} = this.pressure.scales;
    ["total", "small", "large"].forEach((name, row) => {
      const path = line()
        .x((_, k) => x(means[name][k]))
        .y(([bottom, top]) => y((bottom + top) / 2))(this.layers);
      this.lines[row].attr("d", path);
    });
    byId("profile-note").textContent = "Blue: of small grains, orange: of large ones, dark: of both; means over all windows.";
    const values = state.rule.kind === "drop" ? this.fitted.map(() => NaN) : this.#strengths(stress);
    const {x: xb, y: yb} = this.strength.scales;
    const seen = this.fitted.map((layer, k) => ({...layer, B: values[k]})).filter(({B}) => Number.isFinite(B));
    const {left, right, top, bottom} = this.strength.inner;
    const B = found[state.estimator];
    this.all
      .attr("visibility", B >= xb.domain()[0] && B <= xb.domain()[1] ? "visible" : "hidden")
      .attr("x1", xb(B || 0))
      .attr("x2", xb(B || 0))
      .attr("y1", top)
      .attr("y2", bottom);
    this.dots
      .selectAll("circle")
      .data(seen)
      .join("circle")
      .attr("class", ({B, light}) => `dot ${B > 0 ? "positive" : "negative"}${light ? " light" : ""}`)
      .attr("r", 5)
      .attr("cx", ({B}) => Math.min(right, Math.max(left, xb(B))))
      .attr("cy", ({y: at}) => yb(at));
  }
}
