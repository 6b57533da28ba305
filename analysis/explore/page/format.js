// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers and elements for people. Text reaches the page as text, never as HTML.

const minus = (text) => text.replace("-", "−");

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
export function interval([low, high], digits = 3) {
  return Number.isFinite(low) && Number.isFinite(high) ? `[${fixed(low, digits)}, ${fixed(high, digits)}]` : "";
}
export function percent(value) {
  return Number.isFinite(value) ? `${(100 * value).toFixed(value < 0.1 ? 1 : 0)} %` : "–";
}

/** An element with attributes and children; strings become text. */
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (value !== undefined && value !== null) made.setAttribute(key, value);
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
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
