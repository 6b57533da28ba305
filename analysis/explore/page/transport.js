// SPDX-License-Identifier: GPL-3.0-or-later
// Controls that play all runs with one clock.

import {byId, fixed} from "./format.js";
import {set, state} from "./state.js";

export class Transport {
  /** `all`: the Frames of each run. */
  constructor(all) {
    const times = all.flatMap((frames) => frames.times).sort((a, b) => a - b);
    this.times = times.filter((time, k) => k === 0 || time - times[k - 1] > 1e-9);
    const step = (this.times[this.times.length - 1] - this.times[0]) / (this.times.length - 1);
    this.digits = Math.min(6, Math.max(2, Math.ceil(-Math.log10(step)) || 0)); // decimals of times with which frames differ
    this.slider = byId("frame");
    this.slider.max = this.times.length - 1;
    this.slider.addEventListener("input", () => this.goTo(this.slider.valueAsNumber));
    byId("play").addEventListener("click", () => this.toggle());
    this.playing = false;
  }

  get number() {
    return Math.max(0, this.times.indexOf(state.time));
  }
  goTo(number) {
    set({time: this.times[number]});
  }
  goToTime(time) {
    const away = this.times.map((own) => Math.abs(own - time));
    this.goTo(away.indexOf(Math.min(...away)));
  }
  step(by) {
    this.stop();
    this.goTo((this.number + by + this.times.length) % this.times.length);
  }
  toggle() {
    if (this.playing) this.stop();
    else this.play();
  }
  stop() {
    this.playing = false;
    this.#label();
  }
  play() {
    this.playing = true;
    this.#label();
    let last = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      const interval = 1000 / Number(byId("speed").value);
      if (now - last >= interval - 2) {
        last = now;
        this.goTo((this.number + 1) % this.times.length);
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  show() {
    this.slider.value = this.number;
    const text = `t = ${fixed(state.time, this.digits)} s`;
    this.slider.setAttribute("aria-valuetext", text);
    byId("time").textContent = text;
  }
  #label() {
    const button = byId("play");
    button.textContent = this.playing ? "❚❚" : "▶";
    button.setAttribute("aria-label", this.playing ? "Pause" : "Play");
  }
}
