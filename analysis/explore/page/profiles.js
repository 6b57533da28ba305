// SPDX-License-Identifier: GPL-3.0-or-later
// Profiles over height under the selected rule: pressures of both species, and B of each layer.

import {Chart, upright} from "./chart.js";
import {extent, group, line, scaleLinear} from "./d3.js";
import {byId, keys} from "./format.js";
import {sumsOf, stressOf} from "./partition.js";
import {set, state} from "./state.js";

const looks = ["total", "small", "large"];

/** Sets state.layer to the layer under the pointer. */
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
  /** `height()`: {unit of heights in m, name of the axis}; `namesOfPair()`: names of the two species of the fit. */
  constructor(fitOfRun, height, unitOfStress, namesOfPair) {
    this.namesOfPair = namesOfPair;
    this.fitOfRun = fitOfRun;
    this.heightOfRun = height;
    const tall = 300;
    this.pressure = new Chart(byId("profile-plot"), {
      scales: {x: scaleLinear(), y: scaleLinear()},
      labels: {x: `σ (${unitOfStress()})`, y: "y/d_S"},
      height: tall,
      name: "Pressure of small and of large grains, and of both, over height",
    });
    this.strength = new Chart(byId("layers-plot"), {
      scales: {x: scaleLinear(), y: scaleLinear()},
      labels: {x: "B of the layer", y: "y/d_S"},
      height: tall,
      name: "B of each layer over height",
    });
    this.unitOfStress = unitOfStress;
    this.lines = looks.map((look) => this.pressure.marks.append("path").attr("class", `profile ${look}`));
    const names = ["both", ...this.namesOfPair().map((name) => `${name} grains`)];
    byId("profile-note").replaceChildren(...keys(looks.map((look, k) => [look, names[k]])), "– means over all windows");
    this.nothing = this.strength.under.append("line").attr("class", "zero-line");
    this.all = this.strength.under.append("line").attr("class", "all-line");
    this.dots = this.strength.marks.append("g");
    for (const chart of [this.pressure, this.strength]) follow(chart, () => this.layers ?? []);
  }

  layout() {
    const fit = this.fitOfRun();
    const {layer_bottom, layer_top, bottom, frames, phi_large} = fit.arrays;
    const {unit, name} = this.heightOfRun();
    this.layers = Array.from(layer_bottom, (y, k) => [y / unit, layer_top[k] / unit, [y, layer_top[k]]]);
    // A line joins layers of equal thickness: runs with other grain sizes have other layers, which lie between.
    this.profiles = group(Array.from(this.layers.keys()), (k) => (layer_top[k] - layer_bottom[k]).toPrecision(6));
    const [, top] = extent(this.layers, ([, y]) => y);
    const {large, total} = stressOf(fit, {kind: "uniform", value: 1}, "layer_");
    this.pressure.scales.x.domain([Math.min(0, extent(large)[0]), extent(total)[1]]).nice();
    this.pressure.scales.y.domain([0, top]);
    this.pressure.setLabels({x: `σ (${this.unitOfStress()})`, y: name});
    this.strength.setLabels({x: "B of the layer", y: name});
    this.pressure.layout();

    // Layers used in the fit, with their weights.
    const pointsAt = group(Array.from(bottom.keys()), (k) => bottom[k]);
    this.fitted = Array.from(pointsAt, ([y, own]) => {
      const weight = own.reduce((sum, k) => sum + frames[k] * phi_large[k] * (1 - phi_large[k]), 0);
      const k = this.layers.findIndex(([, , [low]]) => low === y);
      return {y: (this.layers[k][0] + this.layers[k][1]) / 2, own, weight};
    });
    const heaviest = Math.max(...this.fitted.map((layer) => layer.weight));
    for (const layer of this.fitted) layer.light = layer.weight < heaviest / 10;
    const ends = [0.35, 0.85].flatMap((p) => this.#strengths(stressOf(fit, {kind: "uniform", value: p})));
    const finite = ends.filter((B) => Number.isFinite(B));
    this.strength.scales.x.domain([Math.max(-3, Math.min(...finite, 0)), Math.min(3, Math.max(...finite, 0))]).nice();
    this.strength.scales.y.domain([0, top]);
    this.strength.layout();
    upright(this.nothing, this.strength.scales.x(0), this.strength.inner.top, this.strength.inner.bottom);
  }

  #strengths(stress) {
    const fit = this.fitOfRun();
    return this.fitted.map(({own}) => sumsOf(fit, stress, own).B);
  }

  update(stress, found) {
    const fit = this.fitOfRun();
    const means = stressOf(fit, state.rule, "layer_");
    const {x, y} = this.pressure.scales;
    looks.forEach((name, row) => {
      const path = line()
        .x((k) => x(means[name][k]))
        .y((k) => y((this.layers[k][0] + this.layers[k][1]) / 2));
      this.lines[row].attr("d", Array.from(this.profiles.values(), path).join(""));
    });
    const values = state.rule.kind === "drop" ? this.fitted.map(() => NaN) : this.#strengths(stress);
    const {x: xb, y: yb} = this.strength.scales;
    const seen = this.fitted.map((layer, k) => ({...layer, B: values[k]})).filter(({B}) => Number.isFinite(B));
    const {left, right, top, bottom} = this.strength.inner;
    const B = found.B;
    upright(this.all, xb(B || 0), top, bottom).attr("visibility", B >= xb.domain()[0] && B <= xb.domain()[1] ? "visible" : "hidden");
    this.dots
      .selectAll("circle")
      .data(seen)
      .join("circle")
      .attr("class", ({B, light}) => `dot ${B > 0 ? "large" : "small"}${light ? " light" : ""}`)
      .attr("r", 5)
      .attr("cx", ({B}) => Math.min(right, Math.max(left, xb(B))))
      .attr("cy", ({y: at}) => yb(at));
  }
}
