// SPDX-License-Identifier: GPL-3.0-or-later
// Content of the tab "report": settings, accuracy and results of the runs; suited for printing.

import {Chart, upright} from "./chart.js";
import {area, extent, line, scaleLinear} from "./d3.js";
import {byId, element, fixed, interval, keys, listOf, rounded, short, table, withUnit} from "./format.js";
import {isShare, stressOf, zeroOf} from "./partition.js";

const charts = [];

/**
 * A figure with a chart, which layoutReport() draws as soon as its width is known. `domains(x, y)` sets the domains of the
 * scales. `paths(x, y, chart)` returns pairs [CSS class, outline]. `lines`: pairs [CSS class, name] for the key in the caption.
 */
function figure(caption, labels, domains, paths, lines = []) {
  const host = element("div", {class: "plot"});
  const made = element("figure", {}, host, element("figcaption", {}, `${caption}${lines.length ? ": " : "."}`, ...keys(lines)));
  const chart = new Chart(host, {height: 240, scales: {x: scaleLinear(), y: scaleLinear()}, name: caption, labels});
  const {x, y} = chart.scales;
  charts.push(() => {
    if (!(host.clientWidth > 0)) return;
    domains(x, y);
    chart.layout();
    chart.under.selectAll("*").remove();
    for (const [look, outline] of paths(x, y, chart)) chart.under.append("path").attr("class", look).attr("d", outline);
  });
  return made;
}

/** Figure of B over the share p, with the band of its intervals. */
function shareFigure(fit) {
  const [p] = zeroOf(fit);
  const grid = fit.scan.p.map((share, k) => [share, ...fit.scan.B[k]]).filter(([, B]) => B !== null);
  const band = grid.filter(([, , low]) => low !== null);
  const caption = `B over the share p of a mixed contact that goes to its large grain${band.length ? "; 95 % band" : ""}${isShare(p) ? "; p*" : ""}`;
  const domains = (_, y) => y.domain([Math.min(0, ...grid.map(([, B]) => B)), Math.max(0, ...grid.map(([, B]) => B))]).nice();
  return figure(caption, {x: "share p", y: "B"}, domains, function* (x, y, chart) {
    yield ["band", area().x((d) => x(d[0])).y0((d) => y(d[2])).y1((d) => y(d[3]))(band)];
    yield ["curve", line().x((d) => x(d[0])).y((d) => y(d[1]))(grid)];
    if (!isShare(p)) return;
    const {top, bottom} = chart.inner;
    const zero = chart.under.append("g").attr("class", "p-zero");
    upright(zero.append("line"), x(p), top, bottom);
    zero.append("text").attr("x", x(p) + 5).attr("y", bottom - 8).text(`p* = ${fixed(p)}`);
  });
}

/** Figure of psi_L over phi_L with one point per layer and window. All points are one path, since there may be thousands. */
function excessFigure(fit) {
  const caption = "Large grains’ share of the pressure, under the rule size, over their share of the grains; one point per layer and window";
  const {small, large} = stressOf(fit, {kind: "size", value: NaN});
  const points = Array.from(fit.arrays.phi_large, (phi, k) => [phi, large[k] / (small[k] + large[k])]).filter(([, psi]) => Number.isFinite(psi));
  const [least, most] = extent(points, ([, psi]) => psi);
  if (!points.length) return null;
  const domains = (_, y) => y.domain([Math.min(0, least), Math.max(1, most)]);
  return figure(caption, {x: "φ_L", y: "ψ_L"}, domains, (x, y) => [
    ["neutral", line()([[x(0), y(0)], [x(1), y(1)]])],
    [points.length < 200 ? "points few" : "points", points.map(([phi, psi]) => `M${x(phi).toFixed(1)},${y(psi).toFixed(1)}h0`).join("")],
  ], [["neutral", "equal shares"]]);
}

/**
 * Figure of columns of a table by layer, over height. `lines`: [[column, CSS class, name in the caption], ...]; those with
 * fewer than two numbers are left out. Null if nothing is left.
 */
function profileFigure(layers, name, lines, caption, label, smallDiameter) {
  const {columns, rows} = layers.tables.find((one) => one.name === name) ?? {columns: [], rows: []};
  const places = lines
    .map(([column, ...look]) => [columns.findIndex((c) => c.replace(/\[.*/, "") === column), ...look])
    .filter(([at]) => rows.filter((row) => (row[at] ?? null) !== null).length > 1);
  if (!places.length) return null;
  const middle = (row) => (row[0] + row[1]) / 2 / smallDiameter;
  const values = rows.flatMap((row) => places.map(([at]) => row[at])).filter((v) => v !== null);
  const [least, most] = extent(values);
  const domains = (x, y) => {
    x.domain([Math.min(0, least), Math.max(0, most)]).nice();
    y.domain([0, Math.max(...rows.map((row) => row[1])) / smallDiameter]);
  };
  const paths = (x, y) => places.map(([at, look]) =>
    [`profile ${look}`, line().defined((row) => row[at] !== null).x((row) => x(row[at])).y((row) => y(middle(row)))(rows)]);
  return figure(caption, {x: label, y: "y/d_S"}, domains, paths, places.filter(([, , words]) => words).map(([, look, words]) => [look, words]));
}

function profileFigures(run) {
  const d = run.small_diameter;
  const force = run.dimension === 3 ? "N/m³" : "N/m²";
  const stress = run.dimension === 3 ? "Pa" : "N/m";
  const own = (...rest) => profileFigure(run.layers, ...rest, d);
  return [
    own("stress", [["sigma_yy", "total", "both"], ["sigma_S_yy", "small", "small grains"], ["sigma_L_yy", "large", "large grains"]], "Contact pressure, mixed contacts shared by size", `σ_{yy} (${stress})`),
    own("kinetic", [["u", "total"]], "Mean velocity along x", "u (m/s)"),
    own("kinetic", [["T_S_y", "small", "small grains"], ["T_L_y", "large", "large grains"]], "Granular temperature along y", "T (m²/s²)"),
    own("micro", [["z_S", "small", "small grains"], ["z_L", "large", "large grains"]], "Contacts of a grain", "contacts z"),
    own("micro", [["mixed_share", "total", "all contacts of the run"], ["neutral_share", "neutral", "contacts that ignore size"]], "Share of mixed contacts", "share of contacts"),
    run.species.length !== 2 ? null : own("balance", [["push", "large", "contact push, cut at the contact point"], ["push_kinetic", "large dashed", "kinetic push"], ["drag", "total", "drag"]], "Forces on large grains along y, upward positive", `force (${force})`),
  ];
}

/** A button that saves a table as tab-separated text. */
function saveButton(name, {columns, rows}) {
  const button = element("button", {class: "save"}, "Save as TSV");
  button.addEventListener("click", () => {
    const lines = [columns, ...rows.map((row) => row.map((v) => v ?? "nan"))].map((row) => row.join("\t"));
    const link = element("a", {download: `${name}.tsv`});
    link.href = URL.createObjectURL(new Blob([lines.join("\n") + "\n"], {type: "text/tab-separated-values"}));
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
  return button;
}

/** A table by layer. It shows the most important columns, and all columns if its checkbox is set. */
function layerTable(one, smallDiameter) {
  const host = element("div", {class: "scroll"});
  const put = (all) => {
    const chosen = one.columns.map((c, k) => [c, k]).filter(([c, k]) => k > 1 && (all || one.shown.includes(c)));
    const some = chosen.length ? chosen : one.columns.map((c, k) => [c, k]).slice(2, 10);
    const heads = [["y/dS"], ["frames", "number"], ...some.map(([column]) => [withUnit(column), "number"])];
    const rows = one.rows.map((row, layer) => [
      `${short(row[0] / smallDiameter)}–${short(row[1] / smallDiameter)}`,
      String(one.frames[layer]),
      ...some.map(([, k]) => short(row[k])),
    ]);
    host.replaceChildren(table(heads, rows));
  };
  const box = element("input", {type: "checkbox"});
  box.addEventListener("change", () => put(box.checked));
  put(false);
  return element(
    "section",
    {class: "by-layer"},
    element("h4", {}, one.note),
    host,
    element("p", {class: "note screen"}, element("label", {}, box, " all columns"), " ", saveButton(one.name, one), ` means over all frames of the rows of ${one.tool}; in windows without this layer, which "frames" leaves out, it counts as empty`),
  );
}

/** [value, low, high] as text. */
function estimate(triple) {
  const [value, low, high] = triple.map((v) => v ?? NaN);
  return `${fixed(value)} ${interval([low, high])}`.trim();
}

function fitSection(fit, heading) {
  const columns = [["rule"], ["B", "number"], ["share p", "number"], ["layers and windows", "number"], ["used by"]];
  const several = fit.rules.some((row) => row.flow);
  if (several) columns.splice(1, 0, ["flow"], ["95 % over"]);
  const rows = fit.rules.map((row) => {
    const cells = [row.name, estimate(row.B), fixed(row.share ?? NaN), String(row.points), row.used_by || "–"];
    if (several) cells.splice(1, 0, row.flow, row.over);
    return cells;
  });
  const zero = zeroOf(fit);
  const doubts = new Map(); // sentence -> names of its rules
  for (const {name, doubt} of fit.rules) if (doubt) doubts.set(doubt, (doubts.get(doubt) ?? new Set()).add(name));
  const all = new Set(fit.rules.map(({name}) => name)).size;
  const undecided = [...new Set(fit.rules.filter(({B: [, low, high]}) => low !== null && low <= 0 && high >= 0).map(({name}) => name))];
  return element(
    "section",
    {},
    element("h3", {}, heading),
    listOf(element("ul", {class: "verdict"}), fit.verdict),
    element("div", {class: "scroll"}, table(columns, rows)),
    element("p", {}, Number.isFinite(zero[0]) ? `p* = ${estimate(zero)}: at this share B is 0. ` : "", fit.rules.some(({B: [, low]}) => low !== null) ? `${several ? "The intervals of all flows are" : "95 % intervals are"} over ${fit.over}: ${fit.over_words}.` : ""),
    undecided.length ? element("p", {}, `The sign of B is undecided under ${undecided.join(", ")}: the interval includes 0. A longer run, or further runs with other seeds, make the interval narrower.`) : null,
    listOf(element("ul", {class: "doubt"}), [...fit.doubts, ...Array.from(doubts, ([doubt, names]) => `${names.size < all ? `${[...names].join(", ")}: ` : ""}${doubt}`)]),
    element("p", {class: "note"}, Object.entries(fit.settings).map(([key, value]) => (key === "rows" ? value : `${key} ${value}`)).join("; "), "."),
  );
}

/** Remarks "NAME: REASON", with the names of one reason together. */
function gathered(remarks) {
  const names = new Map();
  for (const text of remarks) {
    const [, name, reason] = text.match(/^(\S+): (.*)$/) ?? [null, null, text];
    names.set(reason, [...(names.get(reason) ?? []), ...(name ? [withUnit(name).replace(/ \[.*/, "")] : [])]);
  }
  return Array.from(names, ([reason, own]) => rounded(`${own.length ? `${own.join(", ")}: ` : ""}${reason}.`));
}

/** Section with the heights of the centres of mass of both species over time, and the numbers of grseg-segregation. */
function segregationSection(run) {
  const {segregation} = run;
  if (!segregation) return null;
  const {columns, rows, numbers, remarks} = segregation;
  const [large, small] = ["yL[m]", "yS[m]"].map((name) => columns.indexOf(name));
  const d = run.small_diameter;
  const middle = (row) => (row[0] + row[1]) / 2;
  const values = rows.flatMap((row) => [row[large], row[small]]).filter((v) => v !== null);
  const domains = (x, y) => {
    x.domain([rows[0][0], rows[rows.length - 1][1]]);
    y.domain(extent(values).map((height) => height / d)).nice();
  };
  const paths = (x, y) => [[small, "small"], [large, "large"]].map(([at, look]) =>
    [`profile ${look}`, line().defined((row) => row[at] !== null).x((row) => x(middle(row))).y((row) => y(row[at] / d))(rows)]);
  const lines = [["small", "small grains"], ["large", "large grains"]];
  const drawn = values.length < 3 ? null : figure("Heights of the centres of mass, mean of each window", {x: "t (s)", y: "y/d_S"}, domains, paths, lines);
  const cells = numbers.filter(([, value]) => value !== null).map(([name, value, low, high]) => [
    withUnit(name),
    short(value),
    low === null ? "" : `[${short(low)}, ${short(high)}]`,
  ]);
  return element(
    "section",
    {},
    element("h3", {}, "Segregation"),
    element("div", {class: "figures"}, drawn, element("div", {class: "scroll"}, table([["quantity"], ["value", "number"], ["95 %", "number"]], cells))),
    ...gathered(remarks).map((text) => element("p", {class: "note"}, text)),
    element("p", {class: "note screen"}, saveButton("segregation", segregation), " the table of grseg-segregation for the whole bed, one row per window"),
  );
}

const verdicts = {passed: "✓ passed", failed: "✗ failed", undecided: "? undecided", skipped: "– skipped"};

/** Unit of the numbers of a check; most are ratios, "–". */
function unitOfCheck(quantity) {
  if (/^(overlap|open_gap)/.test(quantity)) return "dS";
  if (quantity.startsWith("approach")) return "dS per step";
  if (/^[xz]_drift$/.test(quantity)) return "√(g dS)";
  return quantity === "damaged_frames" ? "frames" : "–";
}

function checkSection(run) {
  const {lines, failures, undecided} = run.checks;
  const d = run.small_diameter;
  const rows = lines.map((row) => [
    row.quantity,
    row.y0 === null ? "" : `${short(row.y0 / d)}–${short(row.y1 / d)}`,
    short(row.measured, 3),
    short(row.tolerance, 3),
    unitOfCheck(row.quantity),
    element("span", {class: row.verdict}, verdicts[row.verdict]),
    rounded(row.remark),
  ]);
  const count = (verdict) => lines.filter((row) => row.verdict === verdict).length;
  const words = failures
    ? `Failed: ${failures}.`
    : `None failed: ${count("passed")} passed, ${count("undecided")} undecided, ${count("skipped")} skipped.`;
  return element(
    "section",
    {},
    element("h3", {}, "Checks"),
    element("p", failures ? {class: "failed"} : {}, `${run.checks.command}. ${words}`, ""),
    undecided ? element("p", {}, `${undecided[0].toUpperCase()}${undecided.slice(1)}: the effect of chance decreases with the square root of the duration. Continue the run, or import more of the archive.`) : null,
    element("details", failures ? {open: ""} : {}, element("summary", {}, `All ${lines.length} lines`), element("div", {class: "scroll"}, table([["quantity"], ["y/dS"], ["measured", "number"], ["tolerance", "number"], ["unit"], ["verdict"], ["remark"]], rows))),
  );
}

function pairs(entries) {
  return element("dl", {class: "facts"}, ...entries.flatMap(([key, value]) => [element("dt", {}, key), element("dd", {}, value)]));
}

/** Readable unit of an observable: "m s-1" becomes "m/s"; "–" for ratios and counts. */
function unitOf(text) {
  return text.replace(/^1?$/, "–").replace(/ (\w+)-1$/, "/$1");
}

const dimensions = {
  m: /diameter$|overlap$|mean_gap|height$|_margin$|_origin$|centre$/,
  s: /^(step|frame_interval|advised_step|restart_time)$/,
  "m/s²": /^gravity$/,
  "m/s": /(speed|velocity)$/,
  "°": /^slope$/,
  "°/s": /^slope_rate$/,
  dS: /^perturb$/,
  "N/m": /^stiffness$/,
  steps: /^horizon$/,
};

/** Parameters of the file with the units that formats/README.md defines. */
function parameters(run, all) {
  const perVolume = run.dimension === 3 ? "kg/m³" : "kg/m²";
  return all.map(([name, value]) => {
    const unit = name === "density" ? perVolume : Object.keys(dimensions).find((one) => dimensions[one].test(name));
    const text = /^[-+.e\d ]+$/.test(value) ? rounded(value) : value;
    return [name.replace(/_/g, " "), unit ? `${text} ${unit}` : text];
  });
}

function accuracySection(run) {
  const observed = run.observables.map(([name, unit, mean, largest]) => [name, unitOf(unit), short(mean), short(largest)]);
  return element(
    "section",
    {},
    element("h3", {}, "Accuracy reached"),
    run.accuracy.length ? pairs(parameters(run, run.accuracy.filter(([, value]) => value !== "nan"))) : element("p", {}, "The file has no summary of the run."),
    observed.length
      ? element("details", {}, element("summary", {}, "Observables over all frames"), element("div", {class: "scroll"}, table([["observable"], ["unit"], ["mean", "number"], ["largest", "number"]], observed)))
      : null,
  );
}

/** Keys of scenes that concern one geometry; each is in the text of every scene (sim/scene/keys/keys.cpp). */
const ofGeometry = {bed: /^shake-/, drum: /^(drum-|fill$)/, shear: /^plate-/, column: /^column-/, hopper: /^outlet/};

/** The text of a scene without the keys of other geometries than its own. */
function ownKeys(scene) {
  const own = /^geometry = (.*)$/m.exec(scene)?.[1];
  const isOther = (key) => Object.entries(ofGeometry).some(([geometry, keys]) => geometry !== own && keys.test(key));
  return own in ofGeometry ? scene.split("\n").filter((line) => !isOther(line.split(" = ")[0])).join("\n") : scene;
}

function settingsSection(run) {
  return element(
    "section",
    {},
    element("h3", {}, "Settings"),
    element("p", {class: "note"}, "SI units; angles in degrees."),
    run.scene ? element("pre", {class: "scene"}, ownKeys(run.scene)) : null,
    element("details", run.scene ? {} : {open: ""}, element("summary", {}, `All ${run.parameters.length} parameters of the file`), pairs(parameters(run, run.parameters))),
  );
}

const unsettled = ". To decide it, compare with the input of the program that wrote the archive, or import frames that are closer together, with forces on grains.";

function runSection(run) {
  const {layers} = run;
  const facts = [
    ["Digest", run.digest],
    ["Verified", run.verified],
    ...run.notes.map(([key, value]) => [key, rounded(value) + (key === "undecided" ? unsettled : "")]),
    ["Frames", `${run.frames} from ${short(run.begin)} to ${short(run.end)} s, with ${run.contacts} contacts`],
    ["Species", run.species.map(({name, diameter}) => `${name}, diameter ${short(diameter)} m`).join("; ")],
    ["Program", run.program],
    ["Sums", run.sums ? `from the table ${run.sums}` : "made for this page, as grseg-stress makes them"],
  ];
  return element(
    "article",
    {},
    element("h2", {}, run.name),
    pairs(facts),
    run.fit ? fitSection(run.fit, "B of the contact stress") : element("p", {class: "doubt"}, `B is not shown: ${run.why_no_fit}.`),
    element("div", {class: "figures"}, ...[...(run.fit ? [shareFigure(run.fit), excessFigure(run.fit)] : []), ...profileFigures(run)].filter(Boolean)),
    checkSection(run),
    accuracySection(run),
    element("h3", {}, "By layer"),
    element("p", {class: "note"}, (layers.tables.length ? `Means over ${layers.windows} window${layers.windows > 1 ? "s" : ""} from ${short(layers.begin)} to ${short(layers.end)} s, weighted by frames. ` : "") +
      layers.missing.map((text) => `${text}. `).join("")),
    ...layers.tables.map((one) => layerTable(one, run.small_diameter)),
    segregationSection(run),
    settingsSection(run),
    element("section", {}, element("h3", {}, "History"), element("ol", {class: "history"}, ...run.history.map((text) => element("li", {}, element("code", {}, text))))),
  );
}

/** Fills the tab. `together`: {fit} over all runs, if there are several. */
export function writeReport(content, together) {
  const host = byId("report");
  const print = element("button", {class: "screen"}, "Print");
  print.addEventListener("click", () => window.print());
  host.replaceChildren(
    element("p", {class: "lead"}, `${content.runs.length === 1 ? "One run" : `${content.runs.length} runs`}, analysed by ${content.program}. `, print),
    element("p", {class: "command"}, element("code", {}, content.command)),
    together?.fit ? element("article", {}, element("h2", {}, "All runs together"), fitSection(together.fit, "B of the contact stress")) : "",
    ...content.runs.map(runSection),
  );
}

/** Opens all <details> while the page is printed. */
export function listenToPrinting() {
  let folded = [];
  window.addEventListener("beforeprint", () => {
    folded = Array.from(byId("report").querySelectorAll("details:not([open])"));
    for (const one of folded) one.open = true;
    layoutReport();
  });
  window.addEventListener("afterprint", () => {
    for (const one of folded) one.open = false;
  });
}

/** Draws all charts; called when their widths become known or change. */
export function layoutReport() {
  for (const draw of charts) draw();
}

