// SPDX-License-Identifier: GPL-3.0-or-later
// Profiles over height under the selected rule: pressures of both species, and B of each layer.

import {Chart, upright} from "./chart.js";
import {extent, group, line, scaleLinear} from "./d3.js";
import {byId, keys} from "./format.js";
import {halfAt, shareOf, sumsOf, stressOf} from "./partition.js";
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
    this.bars = this.strength.under.append("g");
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
      return {y: (this.layers[k][0] + this.layers[k][1]) / 2, own, weight, rows: fit.by_layer.layers.find(({bottom: low}) => low === y).B};
    });
    const heaviest = Math.max(...this.fitted.map((layer) => layer.weight));
    for (const layer of this.fitted) layer.light = layer.weight < heaviest / 10;
    this.strength.scales.y.domain([0, top]);
    this.strength.layout();
  }

  /** Fitted layers with B and its interval under the selected rule. */
  #strengths(stress) {
    const fit = this.fitOfRun();
    const p = shareOf(fit, state.rule);
    return this.fitted
      .map((layer) => {
        const {B} = sumsOf(fit, stress, layer.own), half = halfAt(p, {p: fit.by_layer.p, B: layer.rows}) || 0;
        return {...layer, B, low: B - half, high: B + half};
      })
      .filter(({B}) => state.rule.kind !== "drop" && Number.isFinite(B));
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
    this.#drawStrengths(this.#strengths(stress), found.B);
  }

  /** The axis includes 0, B of all layers, and the intervals of the layers with much weight. */
  #drawStrengths(layers, B) {
    const {x, y} = this.strength.scales;
    const {left, right, top, bottom} = this.strength.inner;
    const ends = [0, B || 0, ...layers.filter(({light}) => !light).flatMap(({low, high}) => [low, high])];
    const width = Math.max(...ends) - Math.min(...ends);
    x.domain([Math.min(...ends) - 0.05 * width, Math.max(...ends) + 0.05 * width]).nice();
    this.strength.axes();
    upright(this.nothing, x(0), top, bottom);
    upright(this.all, x(B || 0), top, bottom).attr("visibility", Number.isFinite(B) ? "visible" : "hidden");
    const inside = layers.filter((layer) => x(layer.B) >= left && x(layer.B) <= right);
    const outside = layers.length - inside.length;
    byId("layers-note").textContent = outside ? `Beyond the axis: ${outside} ${outside > 1 ? "layers" : "layer"}.` : "";
    const look = (layer) => (layer.B > 0 ? "large" : "small");
    this.bars
      .selectAll("line")
      .data(inside)
      .join("line")
      .attr("class", (layer) => `bar-of-error ${look(layer)}`)
      .attr("x1", ({low}) => x(low))
      .attr("x2", ({high}) => x(high))
      .attr("y1", ({y: at}) => y(at))
      .attr("y2", ({y: at}) => y(at));
    this.dots
      .selectAll("circle")
      .data(inside)
      .join("circle")
      .attr("class", (layer) => `dot ${look(layer)}${layer.light ? " light" : ""}`)
      .attr("r", 4)
      .attr("cx", (layer) => x(layer.B))
      .attr("cy", ({y: at}) => y(at));
  }
}
