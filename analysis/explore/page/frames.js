// SPDX-License-Identifier: GPL-3.0-or-later
// Decodes the frames of a run (player_data.hpp).

import {extent} from "./d3.js";

const none = 65535; // code of the position of a grain that is not shown

export class Frames {
  constructor(run) {
    const {player, arrays} = run;
    this.player = player;
    this.arrays = arrays;
    this.times = player.times;
    this.grains = player.grains;
    this.count = player.times.length;
    this.base = 255; // species number of fixed grains, e.g. of the base
    this.wallCodes = arrays.j.BYTES_PER_ELEMENT === 2 ? 65535 : 4294967295;
    this.meanForce = this.#meanForce();
    [this.low, this.high] = this.#extent();
  }

  /** Number of the frame nearest to a time (s). */
  at(time) {
    let best = 0;
    for (let k = 1; k < this.count; ++k)
      if (Math.abs(this.times[k] - time) <= Math.abs(this.times[best] - time)) best = k;
    return best;
  }

  #decoded(name, code) {
    const {from, step} = this.player.bounds[name];
    return from + code * step;
  }
  isShown(frame, grain) {
    return this.arrays.x[frame * this.grains + grain] !== none;
  }
  x(frame, grain) {
    return this.#decoded("x", this.arrays.x[frame * this.grains + grain]);
  }
  y(frame, grain) {
    return this.#decoded("y", this.arrays.y[frame * this.grains + grain]);
  }
  /** Numbers of the grains shown; spheres in the order of z, the nearest to the reader last. */
  inOrder(frame) {
    const shown = Array.from({length: this.grains}, (_, g) => g).filter((g) => this.isShown(frame, g));
    const z = this.arrays.z?.subarray(frame * this.grains, (frame + 1) * this.grains);
    return z ? shown.sort((a, b) => z[a] - z[b]) : shown;
  }
  /** Place of a sphere in the slice, from 0 (far) to 1 (near); 1 for discs. */
  nearness(frame, grain) {
    return this.arrays.z ? this.arrays.z[frame * this.grains + grain] / 65534 : 1;
  }

  /**
   * Contacts of a frame: grains i and j (j < 0: wall -j-1), their positions in m (for j the nearest periodic
   * image, for a wall the contact point), and the components of the force on i in N, along the branch and across it.
   */
  contacts(frame) {
    const {contact_offset, i, j, along, across} = this.arrays;
    const from = contact_offset[frame], to = contact_offset[frame + 1], n = to - from;
    const all = {i: new Int32Array(n), j: new Int32Array(n)};
    for (const name of ["xi", "yi", "xj", "yj", "along", "across"]) all[name] = new Float32Array(n);
    const {length_x: length, periodic_x: periodic, bounds} = this.player;
    for (let k = 0, grain = 0; k < n; ++k) {
      grain += i[from + k];
      const other = j[from + k] > this.wallCodes / 2 ? j[from + k] - this.wallCodes - 1 : j[from + k];
      const x = this.x(frame, grain), y = this.y(frame, grain);
      let [xj, yj] = other < 0 ? this.#onWall(frame, -1 - other, x, y) : [this.x(frame, other), this.y(frame, other)];
      if (periodic) xj += length * Math.round((x - xj) / length);
      all.i[k] = grain;
      all.j[k] = other;
      all.xi[k] = x;
      all.yi[k] = y;
      all.xj[k] = xj;
      all.yj[k] = yj;
      all.along[k] = bounds.along.from + along[from + k] * bounds.along.step;
      all.across[k] = bounds.across.from + across[from + k] * bounds.across.step;
    }
    return all;
  }

  /** Largest rounding error of a force (half a step of its code), divided by the mean force. */
  get rounding() {
    const {along, across} = this.player.bounds;
    return Math.max(along.step, across.step) / 2 / this.meanForce;
  }

  /** Walls that had a contact up to this frame: [normal x, normal y, offset in m]. */
  walls(frame) {
    const n = this.player.walls;
    const known = [];
    for (let w = 0; w < n; ++w) {
      const wall = this.#wall(frame, w);
      if (!Number.isNaN(wall[0])) known.push(wall);
    }
    return known;
  }

  #wall(frame, w) {
    const at = 3 * (frame * this.player.walls + w);
    return this.arrays.walls.subarray(at, at + 3);
  }
  #onWall(frame, w, x, y) {
    const [nx, ny, offset] = this.#wall(frame, w);
    const away = nx * x + ny * y - offset;
    return [x - away * nx, y - away * ny];
  }

  /** Mean normal force, N, over all repulsive contacts of all frames. */
  #meanForce() {
    const {along} = this.arrays, {from, step} = this.player.bounds.along;
    let sum = 0, n = 0;
    for (const code of along) {
      const force = from + code * step;
      if (force > 0) {
        sum += force;
        ++n;
      }
    }
    return n ? sum / n : 1;
  }

  /** Lower left and upper right corner of the region that grains reach in any frame: [[x, y], [x, y]] in m. */
  #extent() {
    const {bounds, length_x, periodic_x} = this.player;
    const margin = extent(this.arrays.radius)[1] ?? 0;
    const ends = ({from, step}) => [from, from + 65534 * step];
    const [x0, x1] = periodic_x ? [0, length_x] : ends(bounds.x).map((x, k) => x + (k ? margin : -margin));
    const [y0, y1] = ends(bounds.y);
    return [[x0, y0 - margin], [x1, y1 + margin]];
  }
}
