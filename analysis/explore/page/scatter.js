// SPDX-License-Identifier: GPL-3.0-or-later
// Plot of sigma^S/sigma^L over phi_S/phi_L, with one point per layer and window. A canvas under the axes shows
// the points, since there may be thousands.

import {Chart} from "./chart.js";
import {extent, line, scaleLog} from "./d3.js";
import {byId, colour, element, keys} from "./format.js";
import {stressOf} from "./partition.js";
import {state} from "./state.js";

const tenths = (scale) => [4, (value) => (scale.domain()[1] / scale.domain()[0] > 300 && Math.log10(value) % 1 ? "" : String(Number(value.toPrecision(3))))];

export class Scatter {
  /** `windowTimes()`: [[begin, end], ...] of the windows of the sums, s. */
  constructor(fitOfRun, windowTimes) {
    this.fitOfRun = fitOfRun;
    this.windowTimes = windowTimes;
    const host = byId("scatter-plot");
    this.canvas = element("canvas", {class: "under", "aria-hidden": "true"});
    host.append(this.canvas);
    this.chart = new Chart(host, {
      scales: {x: scaleLog(), y: scaleLog()},
      labels: {x: "φ_S/φ_L", y: "σ^S/σ^L"},
      logarithmic: true,
      height: 300,
      name: "Ratio of the stresses of small and large grains over the ratio of their shares, with the fit",
    });
    this.equal = this.chart.under.append("path").attr("class", "neutral");
    this.fitted = this.chart.marks.append("path").attr("class", "curve");
  }

  layout() {
    const fit = this.fitOfRun();
    const {phi_large} = fit.arrays;
    this.ratio = phi_large.map((phi) => (1 - phi) / phi);
    // The axes include the points for all shares p from 0.4 to 0.8.
    let low = Infinity, high = 0;
    for (const p of [0.4, 0.8]) {
      const {small, large} = stressOf(fit, {kind: "uniform", value: p});
      for (let k = 0; k < small.length; ++k) {
        if (!(small[k] > 0 && large[k] > 0)) continue;
        low = Math.min(low, small[k] / large[k]);
        high = Math.max(high, small[k] / large[k]);
      }
    }
    const xs = extent(this.ratio);
    this.chart.scales.x.domain([xs[0] / 1.2, xs[1] * 1.2]);
    this.chart.scales.y.domain([Math.max(low, 1e-3) / 1.2, Math.min(high, 1e3) * 1.2]);
    this.chart.ticks = {x: tenths(this.chart.scales.x), y: tenths(this.chart.scales.y)};
    this.chart.layout();
    const {x, y} = this.chart.scales;
    const ends = [Math.max(x.domain()[0], y.domain()[0]), Math.min(x.domain()[1], y.domain()[1])];
    this.equal.attr("d", line().x(x).y(y)(ends));
    const ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(this.chart.width * ratio);
    this.canvas.height = Math.round(this.chart.height * ratio);
    this.canvas.style.width = `${this.chart.width}px`;
    this.canvas.style.height = `${this.chart.height}px`;
    this.canvas.getContext("2d").setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  /** Points of the curve on which B is everywhere equal to the fitted B. */
  #curve(found) {
    const {x} = this.chart.scales;
    const [from, to] = x.domain();
    const points = Array.from({length: 61}, (_, k) => from * (to / from) ** (k / 60));
    const {B} = found;
    const at = (r) => {
      const phi = 1 / (1 + r);
      return (r * (1 - B * phi)) / (1 + B * (1 - phi));
    };
    return points.map((r) => [r, at(r)]).filter(([, value]) => value > 0);
  }

  update(stress, found) {
    const {x, y} = this.chart.scales;
    const {left, right, top, bottom} = this.chart.inner;
    const {begin, bottom: heights} = this.fitOfRun().arrays;
    const c = this.canvas.getContext("2d");
    c.clearRect(0, 0, this.chart.width, this.chart.height);
    c.save();
    c.beginPath();
    c.rect(left, top, right - left, bottom - top);
    c.clip();
    const now = this.windowNow();
    const ink = colour("point"), strong = colour("ink");
    let outside = 0;
    for (const current of [false, true]) {
      c.fillStyle = current ? strong : ink;
      c.globalAlpha = current ? 1 : 0.45;
      c.beginPath();
      for (let k = 0; k < this.ratio.length; ++k) {
        const own = (now !== null && begin[k] === now) || (state.layer && state.layer[0] === heights[k]);
        if (Boolean(own) !== current) continue;
        const value = stress.small[k] / stress.large[k];
        if (!(stress.small[k] > 0 && stress.large[k] > 0)) {
          ++outside;
          continue;
        }
        const px = x(this.ratio[k]), py = y(value), r = current ? 3.2 : 2.4;
        c.moveTo(px + r, py);
        c.arc(px, py, r, 0, 2 * Math.PI);
      }
      c.fill();
    }
    c.restore();
    const points = this.#curve(found);
    const inside = points.filter(([, value]) => value >= y.domain()[0] && value <= y.domain()[1]);
    this.fitted.attr("d", Number.isFinite(found.B) ? line().x((d) => x(d[0])).y((d) => y(d[1]))(inside) : null);
    byId("scatter-note").replaceChildren(
      `${this.ratio.length} points, one per layer and window: `,
      ...keys(now === null ? [] : [["total", "the window of the frame shown"]], "key"),
      ...keys([...(Number.isFinite(found.B) ? [["total", "B the same everywhere"]] : []), ["neutral", "equal shares"]]),
      outside ? `– ${outside} points without positive stresses are left out` : "",
    );
  }

  /** Begin of the window that contains the frame shown, s; null if there is none. */
  windowNow() {
    const window = this.windowTimes().find(([begin, end]) => state.time >= begin && state.time < end);
    return window ? window[0] : null;
  }
}
