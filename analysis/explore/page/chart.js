// SPDX-License-Identifier: GPL-3.0-or-later
// Axes of a plot: an SVG as wide as the element around it, two scales, axes and their labels.

import {axisBottom, axisLeft, select} from "./d3.js";
import {minus} from "./format.js";

let charts = 0; // number of charts made so far, for ids

export const margin = {top: 27, right: 14, bottom: 38, left: 46};

/** Writes a label such as "σ^S/σ_{yy}" into an SVG text; ^ starts a superscript, _ a subscript. */
function setLabel(text, label) {
  text.selectAll("tspan").remove();
  let shift = 0;
  for (const part of label.split(/([_^](?:{[^}]*}|.))/)) {
    const raised = part[0] === "^" ? -5 : part[0] === "_" ? 3 : 0;
    const own = text.append("tspan").attr("dy", raised - shift).text(raised ? part.slice(1).replace(/[{}]/g, "") : part);
    if (raised) own.attr("class", "script");
    shift = raised;
  }
}

/** Places an SVG line vertically at x. */
export const upright = (mark, x, from, to) => mark.attr("x1", x).attr("x2", x).attr("y1", from).attr("y2", to);

export class Chart {
  /** `scales`: d3 scales {x, y}; `labels`: axis labels {x, y}; `height` in pixels, `above` of it over the usual margin; `name`: text for screen readers. */
  constructor(host, {scales, labels, height, name, above = 0, ticks = {}, logarithmic = false}) {
    this.host = host;
    this.logarithmic = logarithmic;
    this.scales = scales;
    this.ticks = ticks;
    this.height = height;
    this.above = above;
    this.svg = select(host).append("svg").attr("role", "img").attr("aria-label", name);
    this.grid = this.svg.append("g").attr("class", "grid");
    // Marks in `under` are cut off at the ends of the axes.
    const clip = `clip-${++charts}`;
    this.clip = this.svg.append("clipPath").attr("id", clip).append("rect");
    this.under = this.svg.append("g").attr("clip-path", `url(#${clip})`);
    this.marks = this.svg.append("g");
    this.xAxis = this.svg.append("g").attr("class", "axis");
    this.yAxis = this.svg.append("g").attr("class", "axis");
    this.xLabel = this.svg.append("text").attr("class", "label").attr("text-anchor", "end");
    this.yLabel = this.svg.append("text").attr("class", "label");
    this.setLabels(labels);
  }

  setLabels({x, y}) {
    setLabel(this.xLabel, x);
    setLabel(this.yLabel, y);
  }

  get inner() {
    return {left: margin.left, right: this.width - margin.right, top: margin.top + this.above, bottom: this.height - margin.bottom};
  }

  /** Makes the chart as wide as the element around it, and draws axes and grid. */
  layout() {
    this.width = Math.max(220, Math.floor(this.host.clientWidth));
    this.svg.attr("width", this.width).attr("height", this.height).attr("viewBox", `0 0 ${this.width} ${this.height}`);
    const {left, right, top, bottom} = this.inner;
    this.clip.attr("x", left).attr("y", top).attr("width", right - left).attr("height", bottom - top);
    this.scales.x.range([left, right]);
    this.scales.y.range([bottom, top]);
    this.axes();
  }

  axes() {
    const {left, right, top, bottom} = this.inner;
    const {x, y} = this.scales;
    const ofX = axisBottom(x).ticks(...(this.ticks.x ?? [Math.floor(this.width / 80)])).tickSizeOuter(0);
    const ofY = axisLeft(y).ticks(...(this.ticks.y ?? [6])).tickSizeOuter(0);
    this.xAxis.attr("transform", `translate(0,${bottom})`).call(ofX);
    this.yAxis.attr("transform", `translate(${left},0)`).call(ofY);
    for (const axis of [this.xAxis, this.yAxis])
      axis.selectAll(".tick text").text(function () {
        return minus(this.textContent);
      });
    this.xLabel.attr("x", right).attr("y", this.height - 5);
    this.yLabel.attr("x", 4).attr("y", 11 + this.above);
    const whole = (value) => !this.logarithmic || Math.log10(value) % 1 === 0;
    const lines = y.ticks(6).filter(whole).map((value) => ({value, at: y(value)}));
    this.grid
      .selectAll("line")
      .data(lines)
      .join("line")
      .attr("x1", left)
      .attr("x2", right)
      .attr("y1", (d) => d.at)
      .attr("y2", (d) => d.at)
      .classed("at-zero", (d) => d.value === 0);
    return {left, right, top, bottom};
  }
}
