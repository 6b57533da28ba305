// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and elements for people. Text reaches the page as text, never as HTML.

export const minus = (text) => text.replace(/-/g, "−");

export function fixed(value, digits = 3) {
  return Number.isFinite(value) ? minus(value.toFixed(digits)) : "–";
}
/** As many digits as tell: 4 significant ones. */
export function short(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return minus(value.toExponential(digits - 1).replace("e+", "e"));
  return minus(String(Number(value.toPrecision(digits))));
}
/** Numbers that stand beside each other: where two that differ would read alike, with up to three digits more. */
export function apart(values, write, digits) {
  const written = [0, 1, 2, 3].map((more) => values.map((value) => write(value, digits + more)));
  const count = (all) => new Set(all).size;
  return written.find((texts) => count(texts) === count(values)) ?? written[0];
}
export function interval(ends, digits = 3) {
  return ends.every(Number.isFinite) ? `[${apart(ends, fixed, digits).join(", ")}]` : "";
}
export function percent(value, digits = 0) {
  return Number.isFinite(value) ? `${fixed(100 * value, digits + (value < 0.1 ? 1 : 0))} %` : "–";
}
/** Prose whose decimal numbers have no more than 4 significant digits. */
export function rounded(text) {
  return text.replace(/\d*\.\d+(e[-+]?\d+)?/g, (number) => {
    const digits = number.replace(/e.*|\./g, "").replace(/^0+/, "").length;
    return digits > 4 ? short(Number(number)) : number;
  });
}
/** A name with its unit as people write them: "T_S_y [m²/s²]". */
export function withUnit(column) {
  return column.replace("[", " [").replace("^2", "²").replace("^2", "²").replace("^3", "³");
}

/** An element with attributes and children; strings become text. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (value !== undefined && value !== null) made.setAttribute(key, value);
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** What a caption says of lines (or with `piece` "key" of discs): a piece of each in its look, and its name. */
export function keys(looks, piece = "stroke") {
  return looks.flatMap(([look, name]) => [element("span", {class: "named"}, element("i", {class: `${piece} ${look}`}), name), " "]);
}

/** A table of columns of [name, alignment] and rows of texts or elements. */
export function table(columns, rows, caption) {
  const cell = (name, content, side) => element(name, side ? {class: side} : {}, content);
  return element(
    "table",
    {},
    caption ? element("caption", {}, caption) : null,
    element("thead", {}, element("tr", {}, ...columns.map(([text, side]) => cell("th", text, side)))),
    element(
      "tbody",
      {},
      ...rows.map((row) => element("tr", {}, ...row.map((content, k) => cell("td", content, columns[k][1])))),
    ),
  );
}

export const byId = (id) => document.getElementById(id);

let known = {};
/** A colour of the sheet, "small". */
export function colour(name) {
  known[name] ??= getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return known[name];
}
/** After the sheet has changed. */
export function forgetColours() {
  known = {};
}
