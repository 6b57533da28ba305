// SPDX-License-Identifier: GPL-3.0-or-later
// Draws a frame on a canvas: grains, and every contact as a line as wide as its force is strong. The part of
// the line that belongs to a species has the colour of the species.

import {colour, element} from "./format.js";
import {powerShare} from "./partition.js";
import {state} from "./state.js";

const widths = 10; // number of classes of line width
const thickest = 1.1; // width of the thickest line, in radii of a small grain

/** Share of the larger grain in a mixed contact, from the two radii; NaN for drop and for a rule that is not listed. */
export function shareOfContact(rule, large, small) {
  switch (rule.kind) {
    case "uniform":
      return rule.value;
    case "half":
      return 0.5;
    case "power":
      return powerShare(large / small, rule.value);
    case "size":
    case "contact-point": // equals size for grains that just touch
      return large / (large + small);
    default:
      return NaN;
  }
}

export class Player {
  constructor(run, frames, onPick) {
    this.run = run;
    this.frames = frames;
    this.canvas = element("canvas", {tabindex: "0", role: "img"});
    this.context = this.canvas.getContext("2d");
    this.still = document.createElement("canvas"); // image of everything that does not depend on the rule
    this.pair = run.fit ? run.fit.numbers_of_pair : [0, 1];
    this.base = run.fit ? run.fit.settings.base : "contact-point";
    this.hasLayers = run.fit && run.bins === "layers"; // annuli are not drawn
    this.cached = {frame: -1, contacts: null};
    this.canvas.addEventListener("click", (event) => onPick(this.grainAt(event)));
  }

  get frame() {
    return this.frames.at(state.time);
  }
  contacts() {
    const {frame} = this;
    if (this.cached.frame !== frame) this.cached = {frame, contacts: this.frames.contacts(frame)};
    return this.cached.contacts;
  }

  /** Sets the canvas to `width` and to the height that the flow then has, at most `tallest`; px. */
  resize(width, tallest) {
    const [[x0, y0], [x1, y1]] = [this.frames.low, this.frames.high];
    this.scale = Math.min(width / (x1 - x0), tallest / (y1 - y0));
    this.width = width;
    this.height = Math.ceil(this.scale * (y1 - y0));
    this.left = (width - this.scale * (x1 - x0)) / 2;
    const ratio = window.devicePixelRatio || 1;
    for (const canvas of [this.canvas, this.still]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(this.height * ratio);
      canvas.getContext("2d").setTransform(ratio, 0, 0, ratio, 0, 0);
    }
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${this.height}px`;
    this.drawn = "";
  }
  px(x) {
    return this.left + (x - this.frames.low[0]) * this.scale;
  }
  py(y) {
    return this.height - (y - this.frames.low[1]) * this.scale;
  }

  draw() {
    const {context: c} = this;
    this.colours = Object.fromEntries(
      ["small", "large", "other", "base", "ink", "line", "card"].map((name) => [name, colour(name)]),
    );
    this.#drawStill();
    c.clearRect(0, 0, this.width, this.height);
    c.drawImage(this.still, 0, 0, this.width, this.height);
    c.save();
    this.#clip(c);
    if (state.showForces) this.#drawForces();
    this.#drawChosen();
    c.restore();
    this.#drawGravity();
  }

  #clip(c) {
    const [[x0], [x1]] = [this.frames.low, this.frames.high];
    c.beginPath();
    c.rect(this.px(x0), 0, this.px(x1) - this.px(x0), this.height);
    c.clip();
  }

  /** Draws grains, walls and layers again if they have changed. */
  #drawStill() {
    const {showGrains, showForces, showLayers, layer} = state;
    const wanted = [this.frame, showGrains, showForces, showLayers, layer, this.colours.ink].join(" ");
    if (wanted === this.drawn) return;
    this.drawn = wanted;
    const c = this.still.getContext("2d");
    c.clearRect(0, 0, this.width, this.height);
    c.save();
    this.#clip(c);
    if (showLayers || layer) this.#drawLayers(c);
    this.#drawGrains(c);
    this.#drawWalls(c);
    c.restore();
  }

  colourOf(species) {
    if (species === this.frames.base) return this.colours.base;
    const at = this.pair.indexOf(species);
    return at === 0 ? this.colours.small : at === 1 ? this.colours.large : this.colours.other;
  }

  /** Calls at(x, y, r) (pixels) for a grain and, if it crosses an end of a periodic cell, also for its image. */
  #images(grain, at) {
    const {frames, frame} = this;
    const x = frames.x(frame, grain), r = frames.arrays.radius[grain], y = this.py(frames.y(frame, grain));
    const {periodic_x: periodic, length_x: length} = frames.player;
    at(this.px(x), y, r * this.scale);
    if (periodic && x < r) at(this.px(x + length), y, r * this.scale);
    if (periodic && x > length - r) at(this.px(x - length), y, r * this.scale);
  }

  #drawGrains(c) {
    const {frames, frame} = this;
    const {species, z} = frames.arrays;
    // One path per disc: browsers take longer to fill one path of thousands of discs.
    const disc = (x, y, r, ink, alpha) => {
      c.fillStyle = ink;
      c.globalAlpha = alpha;
      c.beginPath();
      c.arc(x, y, Math.max(r, 0.3), 0, 2 * Math.PI);
      c.fill();
    };
    for (const g of frames.inOrder(frame)) {
      if (!state.showGrains && species[g] !== frames.base) continue;
      const ink = this.colourOf(species[g]), near = frames.nearness(frame, g);
      const alpha = (species[g] === frames.base ? 0.8 : state.showForces ? 0.24 : 0.85) * (0.4 + 0.6 * near);
      this.#images(g, (x, y, r) => {
        if (z) {
          disc(x, y, r, this.colours.card, 1); // hides what is behind
          disc(x, y, r, ink, Math.min(1, alpha + 0.25)); // a rim
          disc(x, y, r - 1.2, this.colours.card, 1);
        }
        disc(x, y, z ? r - 1.2 : r - 0.25, ink, alpha);
      });
    }
    c.globalAlpha = 1;
  }

  #drawWalls(c) {
    const {frames} = this;
    const far = 2 * (this.width + this.height);
    c.strokeStyle = this.colours.base;
    c.lineWidth = 2;
    for (const [nx, ny, offset] of frames.walls(this.frame)) {
      const x = this.px(nx * offset), y = this.py(ny * offset);
      c.beginPath();
      c.moveTo(x - far * ny, y - far * nx);
      c.lineTo(x + far * ny, y + far * nx);
      c.stroke();
    }
  }

  #drawLayers(c) {
    if (!this.hasLayers) return;
    if (state.layer) {
      const [bottom, top] = state.layer.map((y) => this.py(y));
      c.fillStyle = this.colours.ink;
      c.globalAlpha = 0.12;
      c.fillRect(0, top, this.width, bottom - top);
      c.globalAlpha = 1;
    }
    if (!state.showLayers) return;
    c.strokeStyle = this.colours.line;
    c.lineWidth = 1;
    c.beginPath();
    for (const bottom of this.run.fit.arrays.layer_bottom) {
      const y = Math.round(this.py(bottom)) + 0.5;
      c.moveTo(0, y);
      c.lineTo(this.width, y);
    }
    c.stroke();
  }

  /** Class of line width for a normal force `along`, N; -1 if the line would be too thin to see. */
  widthClass(along) {
    const width = Math.abs(along) / (4 * this.frames.meanForce);
    return width < 0.01 ? -1 : Math.min(widths - 1, Math.floor(width * widths));
  }
  lineWidth(k) {
    const {small_diameter: d} = this.run;
    return Math.max(0.5, (((k + 0.6) / widths) * thickest * d * this.scale) / 2);
  }

  /** Position `at` at which the line of contact k changes colour, from 0 (grain i) to 1 (grain j), and the species of both grains. */
  cut(contacts, k) {
    const {species, radius} = this.frames.arrays;
    const i = contacts.i[k], j = contacts.j[k];
    const si = species[i], sj = j < 0 ? this.frames.base : species[j];
    if (sj === this.frames.base) return {si, sj, at: this.#partAtBase(i, j), mixed: false};
    if (si === sj) return {si, sj, at: 1, mixed: false};
    const iLarger = si > sj; // species are numbered in order of size
    const share = shareOfContact(state.rule, radius[iLarger ? i : j], radius[iLarger ? j : i]);
    return {si, sj, at: iLarger ? share : 1 - share, mixed: true};
  }

  /** Part of a contact with the base that the grain gets. A line to a wall ends at the contact point. */
  #partAtBase(i, j) {
    const {radius} = this.frames.arrays;
    if (this.base === "none") return 0;
    if (this.base === "half") return 0.5;
    return j < 0 ? 1 : radius[i] / (radius[i] + radius[j]);
  }

  #drawForces() {
    const {context: c} = this;
    const contacts = this.contacts();
    const {length_x: length, periodic_x: periodic} = this.frames.player;
    const paths = new Map(); // colour -> one path for each class of line width
    const add = (ink, k, x0, y0, x1, y1) => {
      if (!paths.has(ink)) paths.set(ink, Array.from({length: widths}, () => new Path2D()));
      const path = paths.get(ink)[k];
      path.moveTo(x0, y0);
      path.lineTo(x1, y1);
    };
    for (let k = 0; k < contacts.i.length; ++k) {
      const width = this.widthClass(contacts.along[k]);
      if (width < 0) continue;
      const {si, sj, at, mixed} = this.cut(contacts, k);
      if (state.onlyMixed && !mixed) continue;
      const shifts = [0];
      if (periodic && contacts.xj[k] < 0) shifts.push(length);
      if (periodic && contacts.xj[k] > length) shifts.push(-length);
      for (const shift of shifts) {
        const x0 = this.px(contacts.xi[k] + shift), y0 = this.py(contacts.yi[k]);
        const x1 = this.px(contacts.xj[k] + shift), y1 = this.py(contacts.yj[k]);
        if (mixed && Number.isNaN(at)) {
          add(this.colours.other, width, x0, y0, x1, y1);
          continue;
        }
        const xc = x0 + at * (x1 - x0), yc = y0 + at * (y1 - y0);
        if (at > 0) add(this.colourOf(si), width, x0, y0, xc, yc);
        if (at < 1) add(this.colourOf(sj), width, xc, yc, x1, y1);
      }
    }
    c.lineCap = "butt";
    for (const [ink, classes] of paths) {
      c.strokeStyle = ink;
      classes.forEach((path, k) => {
        c.lineWidth = this.lineWidth(k);
        c.stroke(path);
      });
    }
  }

  #drawChosen() {
    const {context: c, frames, frame} = this;
    if (state.grain < 0 || !this.active || !frames.isShown(frame, state.grain)) return;
    c.strokeStyle = this.colours.ink;
    c.lineWidth = 2.5;
    this.#images(state.grain, (x, y, r) => {
      c.beginPath();
      c.arc(x, y, r + 1, 0, 2 * Math.PI);
      c.stroke();
    });
  }

  /** Draws the direction of gravity as an arrow in the corner. */
  #drawGravity() {
    const {context: c} = this;
    const [gx, gy] = this.frames.player.gravity[this.frame];
    const size = Math.hypot(gx, gy);
    if (!(size > 0)) return;
    const [ux, uy] = [gx / size, -gy / size];
    const length = 26, x = this.width - 16 - Math.max(0, ux) * length, y = 10;
    c.strokeStyle = c.fillStyle = this.colours.ink;
    c.lineWidth = 1.5;
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x + ux * length, y + uy * length);
    c.stroke();
    c.beginPath();
    c.moveTo(x + ux * (length + 5), y + uy * (length + 5));
    c.lineTo(x + ux * (length - 3) - 3.5 * uy, y + uy * (length - 3) + 3.5 * ux);
    c.lineTo(x + ux * (length - 3) + 3.5 * uy, y + uy * (length - 3) - 3.5 * ux);
    c.fill();
    c.font = "italic 12px system-ui, sans-serif";
    c.textAlign = "right";
    c.fillText("g", x - 6, y + 12);
  }

  /** The grain under the pointer, the front one of several; the nearest one within 4 pixels if there is none; or -1. */
  grainAt(event) {
    const {frames, frame} = this;
    const bounds = this.canvas.getBoundingClientRect();
    const at = {x: event.clientX - bounds.left, y: event.clientY - bounds.top};
    let best = -1, nearest = 4; // distance of the pointer from the rim of the grain, pixels
    for (const g of frames.inOrder(frame))
      this.#images(g, (x, y, r) => {
        const away = Math.max(0, Math.hypot(at.x - x, at.y - y) - r);
        if (away <= nearest) [best, nearest] = [g, away];
      });
    return best;
  }
}
