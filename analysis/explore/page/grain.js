// SPDX-License-Identifier: GPL-3.0-or-later
// Panel of the chosen grain: its contacts, enlarged, and its part of the stress of its mixed contacts under each rule.

import {byId, element, fixed, percent, short, table} from "./format.js";
import {parseRule, ruleName} from "./partition.js";
import {shareOfContact} from "./player.js";
import {set, state} from "./state.js";

/**
 * Contacts of a grain in the frame that is shown. For spheres: only contacts with grains of the slice, with
 * the components of forces in the plane of the page.
 */
export function contactsOf(player, grain) {
  const contacts = player.contacts();
  const {frames} = player;
  const {species, radius} = frames.arrays;
  const own = [];
  for (let k = 0; k < contacts.i.length; ++k) {
    const first = contacts.i[k] === grain;
    if (!first && contacts.j[k] !== grain) continue;
    const other = first ? contacts.j[k] : contacts.i[k];
    const side = first ? 1 : -1; // sign of the branch, which points from the other grain to this one
    const bx = side * (contacts.xi[k] - contacts.xj[k]), by = side * (contacts.yi[k] - contacts.yj[k]);
    const length = Math.hypot(bx, by) || 1;
    const [ex, ey] = [bx / length, by / length];
    const fy = contacts.along[k] * ey + contacts.across[k] * ex;
    const ofOther = other < 0 ? frames.base : species[other];
    const mixed = ofOther !== frames.base && ofOther !== species[grain];
    own.push({
      k,
      other,
      species: ofOther,
      mixed,
      larger: mixed && species[grain] > ofOther,
      radii: mixed ? [radius[grain], radius[other]].sort((a, b) => b - a) : null,
      angle: (Math.atan2(-by, -bx) * 180) / Math.PI,
      along: contacts.along[k],
      across: contacts.across[k],
      stress: fy * by, // yy component of the dyadic product of force and branch, N m
      dx: -bx,
      dy: -by,
    });
  }
  return own;
}

/** Part of the stress of its mixed contacts that a grain gets under a rule, N m; NaN for the rule drop. */
export function partOf(contacts, rule) {
  let part = 0;
  for (const contact of contacts.filter(({mixed}) => mixed)) {
    const p = shareOfContact(rule, ...contact.radii);
    part += contact.stress * (contact.larger ? p : 1 - p);
  }
  return part;
}

export class GrainPanel {
  constructor(content) {
    this.rules = content.rules.filter((rule) => rule.stock).map((rule) => parseRule(rule.word));
    this.host = byId("grain");
    this.canvas = element("canvas", {role: "img", "aria-label": "The grain and its contacts"});
    this.contacts = element("div", {class: "facts"});
    this.rulesOfIt = element("div", {class: "facts"});
    const close = element("button", {class: "quiet close", "aria-label": "Close"}, "×");
    close.addEventListener("click", () => set({grain: -1}));
    this.host.append(this.canvas, this.contacts, this.rulesOfIt, close);
  }

  update(player) {
    const {grain} = state;
    const shown = grain >= 0 && player && player.frames.isShown(player.frame, grain);
    this.host.hidden = !shown;
    if (!shown) return;
    const contacts = contactsOf(player, grain);
    this.#draw(player, grain, contacts);
    this.#tell(player, grain, contacts);
  }

  #draw(player, grain, contacts) {
    const size = 210, ratio = window.devicePixelRatio || 1;
    const {frames, colours} = player;
    const {radius} = frames.arrays, r = radius[grain];
    const around = contacts.map(({other}) => (other < 0 ? 0 : radius[other]));
    const reach = r + 2 * Math.max(r, ...around);
    const scale = size / 2 / reach;
    this.canvas.width = this.canvas.height = size * ratio;
    this.canvas.style.width = this.canvas.style.height = `${size}px`;
    const c = this.canvas.getContext("2d");
    c.setTransform(ratio, 0, 0, ratio, (size / 2) * ratio, (size / 2) * ratio);
    c.clearRect(-size, -size, 2 * size, 2 * size);
    const disc = (x, y, radius, species, alpha) => {
      c.beginPath();
      c.arc(x * scale, -y * scale, radius * scale, 0, 2 * Math.PI);
      c.fillStyle = player.colourOf(species);
      c.globalAlpha = alpha;
      c.fill();
      c.globalAlpha = 1;
    };
    contacts.forEach(({other, species, dx, dy}, n) => {
      if (other >= 0) disc(dx, dy, around[n], species, species === frames.base ? 0.5 : 0.22);
    });
    const own = frames.arrays.species[grain];
    disc(0, 0, r, own, 0.35);
    const strongest = Math.max(...contacts.map(({along}) => Math.abs(along)), 1e-300);
    for (const contact of contacts) {
      const width = Math.max(1.5, (14 * Math.abs(contact.along)) / strongest);
      const p = contact.mixed ? shareOfContact(state.rule, ...contact.radii) : 1;
      const cut = !contact.mixed ? 1 : contact.larger ? p : 1 - p;
      const stretch = (from, to, ink) => {
        c.beginPath();
        c.moveTo(contact.dx * from * scale, -contact.dy * from * scale);
        c.lineTo(contact.dx * to * scale, -contact.dy * to * scale);
        c.strokeStyle = ink;
        c.lineWidth = width;
        c.stroke();
      };
      if (Number.isNaN(cut)) {
        stretch(0, 1, colours.other);
        continue;
      }
      stretch(0, cut, player.colourOf(own));
      if (cut < 1) stretch(cut, 1, player.colourOf(contact.species));
    }
    c.beginPath();
    c.arc(0, 0, r * scale, 0, 2 * Math.PI);
    c.strokeStyle = colours.ink;
    c.lineWidth = 2;
    c.stroke();
  }

  #tell(player, grain, contacts) {
    const {frames, run} = player;
    const {species, radius, row} = frames.arrays;
    const name = (s) => (s === frames.base ? "base" : run.species[s].name);
    const mean = frames.meanForce;
    const mixed = contacts.filter((contact) => contact.mixed);
    const whole = mixed.reduce((sum, {stress}) => sum + stress, 0);
    const flat = run.dimension === 2;
    const heading = element(
      "h3",
      {},
      `Grain ${row[grain]}, ${name(species[grain])}`,
      element("small", {}, ` radius ${fixed(radius[grain] / run.small_diameter, 2)} dS, ${contacts.length} ${contacts.length === 1 ? "contact" : "contacts"}${flat ? "" : " with grains of the slice"}`),
    );
    const rows = contacts.map((contact) => {
      const p = contact.mixed ? shareOfContact(state.rule, ...contact.radii) : NaN;
      return [
        contact.other < 0 ? `wall ${-contact.other}` : name(contact.species),
        `${Math.round(contact.angle)}°`.replace("-", "−"),
        fixed(contact.along / mean, 2),
        fixed(contact.across / contact.along, 2),
        ...(flat ? [short(contact.stress, 3)] : []),
        contact.mixed ? fixed(contact.larger ? p : 1 - p) : "",
      ];
    });
    const heads = [["with"], ["towards", "number"], ["fn/⟨fn⟩", "number"], ["ft/fn", "number"], ...(flat ? [["fy ℓy (N m)", "number"]] : []), ["its share", "number"]];
    const parts = [...this.rules, state.rule].map((rule, k, all) => {
      const part = partOf(contacts, rule);
      return [k === all.length - 1 ? `now, ${ruleName(rule)}` : ruleName(rule), short(part, 3), percent(part / whole)];
    });
    const words = !flat
      ? "The slice has only some of its contacts, so that its part of the stress is not known here."
      : mixed.length
      ? `Its ${mixed.length} contact${mixed.length > 1 ? "s" : ""} with the other species ${mixed.length > 1 ? "have" : "has"} the sum Σ fy ℓy = ${short(whole, 3)} N m. The grain’s part of this sum under each rule:`
      : "It has no contact with the other species: its stress is the same under every rule.";
    this.contacts.replaceChildren(heading, rows.length ? element("div", {class: "scroll"}, table(heads, rows)) : "");
    this.rulesOfIt.replaceChildren(
      element("p", {}, words),
      flat && mixed.length ? table([["rule"], ["its part (N m)", "number"], ["of the sum", "number"]], parts) : "",
      element(
        "p",
        {class: "note"},
        `${flat ? "" : "Forces are components in the plane of the page. "}This page rounds forces to ±${short(frames.rounding, 2)} ⟨fn⟩ (⟨fn⟩: mean normal force). ` +
          `The rule contact-point is shown as size; the shares of the two rules differ by at most ${short(run.player.contact_point_from_size, 2)}.`,
      ),
    );
  }
}
