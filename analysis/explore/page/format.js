// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as text, and elements of the page. Strings become text, never HTML.

export const minus = (text) => text.replace(/-/g, "−");

export function fixed(value, digits = 3) {
  return Number.isFinite(value) ? minus(value.toFixed(digits)) : "–";
}
/** Text of a number with at most `digits` significant digits; very large and small numbers have an exponent. */
export function short(value, digits = 4) {
  if (value === null || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return minus(value.toExponential(digits - 1).replace("e+", "e"));
  return minus(String(Number(value.toPrecision(digits))));
}
/** Texts of numbers that are shown side by side, with up to three more digits if different numbers would look equal. */
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
/** Rounds the decimal numbers in a sentence to 4 significant digits. */
export function rounded(text) {
  return text.replace(/\d*\.\d+(e[-+]?\d+)?/g, (number) => {
    const digits = number.replace(/e.*|\./g, "").replace(/^0+/, "").length;
    return digits > 4 ? short(Number(number)) : number;
  });
}
/** Readable name and unit of a table's column: "T_S_y [m²/s²]". */
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

/** Key of a caption: a sample and a name for each [look, name]. Samples are lines, or discs if `piece` is "key"; `look` is a CSS class. */
export function keys(looks, piece = "stroke") {
  return looks.flatMap(([look, name]) => [element("span", {class: "named"}, element("i", {class: `${piece} ${look}`}), name), " "]);
}

/** A table: `columns` are [name, CSS class], `rows` are lists of texts or elements. */
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

/** A sentence of the tools as texts and elements: numbers are rounded, and stay in one line with their unit; so do options. */
export function sentence(text) {
  const shown = rounded(text).replace(/\+-/g, "±").replace(/(?<= )-(?=\d)/g, "−");
  const number = String.raw`−?\d*\.?\d+(?:e[-+−]?\d+)?`;
  const wholes = RegExp(String.raw`(--[a-z][\w-]*(?: ${number})?|(?:t = |B ± )?${number}(?: ± ${number})?(?: (?:s|m/s|dS)\b)?)`);
  return shown.split(wholes).map((part, k) => (k % 2 ? element("span", {class: "whole"}, part) : part));
}

/** Fills a list with sentences, without full stops, and hides it if there are none. */
export function listOf(list, sentences) {
  list.hidden = !sentences.length;
  list.replaceChildren(...sentences.map((text) => element("li", {}, ...sentence(`${text}.`))));
  return list;
}

export const byId = (id) => document.getElementById(id);

let known = {};
/** A colour of the style sheet by name, "small". */
export function colour(name) {
  known[name] ??= getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return known[name];
}
/** Clears the cache of colour(), after the colours of the style sheet have changed. */
export function forgetColours() {
  known = {};
}
