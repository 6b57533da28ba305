// SPDX-License-Identifier: GPL-3.0-or-later
// Card with the share p of a mixed contact that its large grain gets, and with the resulting B.

import {Chart, margin, upright} from "./chart.js";
import {area, line, scaleLinear} from "./d3.js";
import {apart, byId, element, fixed, interval, keys, listOf, percent, sentence} from "./format.js";
import {commandRule, fitOf, hasPowers, intervalOf, isShare, neutralSums} from "./partition.js";
import {numberedRule, parseRule, ruleName, shareOf, zeroOf} from "./partition.js";
import {Parts} from "./parts.js";
import {set, state} from "./state.js";

const uniform = (p) => numberedRule("uniform", p);

/** Exponent Q for which power:Q gives the share p with nominal radii; limited to the range of the slider, 0 to 4. */
function powerOf(fit, p) {
  const Q = Math.log(p / (1 - p)) / Math.log(fit.size_ratio);
  return Math.min(4, Math.max(0, Number.isNaN(Q) ? 1 : Q));
}

/** Short names of the programs that use a rule: "MercuryDPM; YADE, PFC". */
function shortUse(text) {
  return text
    .replace(/ compute stress\/atom.*| coarse graining| stress per body|^grseg, |^sums over | \(.*\)/g, "")
    .trim();
}

export class Share {
  /** `fitOfRun()`: the fit that the plots show; `runsOfFit()`: the runs it is made of. */
  constructor(content, fitOfRun, runsOfFit) {
    this.known = content.rules;
    this.fitOfRun = fitOfRun;
    this.runsOfFit = runsOfFit;
    this.chart = new Chart(byId("share-plot"), {
      scales: {x: scaleLinear().domain([0, 1]), y: scaleLinear()},
      labels: {x: "share p of the large grain", y: "B"},
      height: 330,
      above: 40, // for four lines of names
      name: "B over the share p, with the band of its intervals, p*, and the rules of published programs",
    });
    const {under, marks} = this.chart;
    this.band = under.append("path").attr("class", "band");
    this.neutral = under.append("path").attr("class", "neutral");
    this.others = under.append("g");
    this.curve = under.append("path").attr("class", "curve");
    this.zero = marks.append("g").attr("class", "p-zero");
    this.codes = marks.append("g").attr("class", "codes");
    this.names = marks.append("g");
    this.stem = marks.append("line").attr("class", "stem");
    this.point = marks.append("circle").attr("class", "point").attr("r", 6.5);
    this.parts = new Parts();
    this.#listen();
    this.#addRules();
  }

  #addRules() {
    const stock = this.known.filter((rule) => rule.stock);
    this.buttons = stock.map((rule, k) => {
      const button = element(
        "button",
        {"aria-pressed": "false", title: `${rule.meaning}${rule.used_by ? `: ${rule.used_by}` : ""} (${k + 1})`},
        element("b", {}, rule.word),
        element("small", {}, shortUse(rule.used_by)),
      );
      button.addEventListener("click", () => set({rule: parseRule(rule.word)}));
      return [rule.word, button];
    });
    byId("rules").append(...this.buttons.map(([, button]) => button));
  }

  #listen() {
    const controls = {p: "uniform", "dock-p": "uniform", q: "power", "p-number": "uniform", "q-number": "power"};
    for (const [id, kind] of Object.entries(controls))
      byId(id).addEventListener(id.endsWith("number") ? "change" : "input", ({target: {valueAsNumber: value}}) => {
        if (!Number.isNaN(value)) set({rule: numberedRule(kind, value)});
      });
    // A second slider appears at the bottom of the window while the first one is out of sight.
    new IntersectionObserver(([{isIntersecting: inSight}]) => {
      byId("dock").hidden = inSight;
    }).observe(byId("p-row"));
    const svg = this.chart.svg.node();
    const drag = (event) => {
      if (!(event.buttons & 1)) return;
      const x = event.clientX - svg.getBoundingClientRect().left;
      set({rule: uniform(Math.round(1000 * this.chart.scales.x.invert(x)) / 1000)});
    };
    svg.addEventListener("pointerdown", (event) => {
      svg.setPointerCapture(event.pointerId);
      drag(event);
    });
    svg.addEventListener("pointermove", drag);
  }

  /** Draws everything that depends on the run but not on the rule. `others`: fits of the other runs. */
  layout(others) {
    const fit = this.fitOfRun();
    const {chart} = this;
    const grid = fit.scan.p;
    this.values = grid.map((p) => fitOf(fit, uniform(p)).B);
    const finite = this.values.filter(Number.isFinite);
    chart.scales.y.domain([Math.min(...finite, 0), Math.max(...finite, 0)]).nice();
    chart.layout();
    const {x, y} = chart.scales;
    const curveOf = (values) =>
      line()
        .defined((_, k) => Number.isFinite(values[k]))
        .x((_, k) => x(grid[k]))
        .y((_, k) => y(values[k]))(grid);
    const rows = fit.scan.B.map(([, low, high], k) => [grid[k], low, high]);
    const known = rows.filter(([, low]) => low !== null);
    this.band.attr("d", area().x((d) => x(d[0])).y0((d) => y(d[1])).y1((d) => y(d[2]))(known));
    this.curve.attr("d", curveOf(this.values));
    this.neutral.attr("d", curveOf(grid.map((p) => neutralSums(fit, p))));
    this.others
      .selectAll("path")
      .data(others)
      .join("path")
      .attr("class", "thin")
      .attr("d", (other) => curveOf(grid.map((p) => fitOf(other, uniform(p)).B)));
    this.#drawZero(fit);
    this.#drawCodes(fit);
    const drawn = [
      ["band", "95 % interval of B", known.length > 0],
      ["neutral", "contacts that ignore size", fit.two],
      ["zero", "p*, where B = 0", isShare(zeroOf(fit)[0])],
      ["thin", "the other runs", others.length > 0],
    ];
    byId("share-note").replaceChildren(...keys(drawn.filter(([, , is]) => is)));
    // These widths put the thumb of the slider under the point of the plot.
    byId("p-row").style.paddingLeft = `${chart.inner.left - 9}px`;
    byId("p-row").style.paddingRight = `${margin.right - 9}px`;
    byId("q-note").textContent = hasPowers(fit)
      ? ""
      : "Here power:Q uses nominal radii: p = r^Q/(1 + r^Q), r = r_L/r_S. grseg-fit --partition power:Q uses the radius of each grain.";
  }

  #drawZero(fit) {
    const {x} = this.chart.scales;
    const {top, bottom} = this.chart.inner;
    const [p, low, high] = zeroOf(fit);
    this.zero.selectAll("*").remove();
    if (!isShare(p)) return;
    if (Number.isFinite(low))
      this.zero
        .append("rect")
        .attr("x", x(Math.max(0, low)))
        .attr("width", x(Math.min(1, high)) - x(Math.max(0, low)))
        .attr("y", top)
        .attr("height", bottom - top);
    upright(this.zero.append("line"), x(p), top, bottom);
  }

  /** Marks the rules of published programs on the curve. Their names and p* stand above the plot. */
  #drawCodes(fit) {
    const {x, y} = this.chart.scales;
    const marks = this.known
      .filter((rule) => rule.stock && rule.word !== "drop")
      .map((rule) => {
        const own = parseRule(rule.word);
        return {name: rule.word, p: shareOf(fit, own), B: fitOf(fit, own).B};
      })
      .filter(({p, B}) => Number.isFinite(p) && Number.isFinite(B));
    this.codes.selectAll("*").remove();
    const names = [];
    for (const {name, p, B} of marks) {
      this.codes.append("circle").attr("cx", x(p)).attr("cy", y(B)).attr("r", 3.5);
      names.push({text: name, at: x(p), to: y(B) - 4, look: "codes"});
    }
    const [zero] = zeroOf(fit);
    if (isShare(zero)) names.push({text: `p* = ${fixed(zero)}`, at: x(zero), to: this.chart.inner.top, look: "p-zero"});
    this.#drawNames(names);
  }

  /** Writes names above the plot, each to the right of its line down to `to`, and above all names that begin below it. */
  #drawNames(names) {
    const {top} = this.chart.inner;
    this.names.selectAll("*").remove();
    const placed = [];
    for (const name of names.sort((a, b) => b.at - a.at)) {
      const own = this.names.append("g").attr("class", name.look);
      const guide = own.append("line"), text = own.append("text").text(name.text);
      const width = text.node().getComputedTextLength() + 10;
      const row = Math.max(0, ...placed.filter(({at}) => at < name.at + width).map((other) => other.row + 1));
      const base = top - 8 - 15 * row;
      text.attr("x", Math.min(name.at + 4, this.chart.width - width + 10)).attr("y", base);
      upright(guide, name.at, base - 10, name.to);
      placed.push({at: name.at, row});
    }
  }

  /** Draws everything that depends on the rule. `found`: the result of fitOf(). */
  update(stress, found) {
    const fit = this.fitOfRun();
    const {rule} = state;
    const p = shareOf(fit, rule), {B} = found;
    const {x, y} = this.chart.scales;
    const seen = Number.isFinite(p) && Number.isFinite(B);
    for (const mark of [this.point, this.stem]) mark.attr("visibility", seen ? "visible" : "hidden");
    if (seen) {
      this.point.attr("cx", x(p)).attr("cy", y(B));
      upright(this.stem, x(p), y(B), this.chart.inner.bottom);
    }
    this.#updateControls(fit, p);
    this.#updateReadout(fit, p, B, stress);
    this.#updateCommand(fit);
    this.parts.update(fit, stress);
  }

  #updateControls(fit, p) {
    const {rule} = state;
    const own = Number.isFinite(p) ? p : 0;
    for (const slider of [byId("p"), byId("dock-p")]) {
      if (document.activeElement !== slider || rule.kind !== "uniform") slider.value = own;
      slider.style.setProperty("--p", own);
      slider.classList.toggle("off", !Number.isFinite(p));
      slider.setAttribute("aria-valuetext", `${percent(p)} to the large grain`);
    }
    const Q = rule.kind === "power" ? rule.value : powerOf(fit, own);
    byId("q").value = Q;
    byId("q").classList.toggle("off", rule.kind !== "power");
    const put = (id, value, digits) => {
      if (document.activeElement !== byId(id)) byId(id).value = Number.isFinite(value) ? value.toFixed(digits) : "";
    };
    put("p-number", p, 3);
    put("q-number", rule.kind === "power" ? rule.value : NaN, 2);
    byId("q-number").placeholder = Q.toFixed(2); // Q of the same share
    for (const [word, button] of this.buttons) button.setAttribute("aria-pressed", String(word === rule.kind));
    const [large, small] = apart([p, 1 - p], fixed, 3);
    const text = Number.isFinite(p)
      ? [element("b", {class: "large"}, large), " to the large grain, ", element("b", {class: "small"}, small), " to the small one"]
      : [...(rule.kind === "drop" ? keys([["other", ""]], "key") : []), this.#withoutShare(fit)];
    byId("proportion").replaceChildren(...text);
  }

  #withoutShare(fit) {
    if (state.rule.kind === "drop") return "mixed contacts belong to neither species";
    return fit.two ? "there are no mixed contacts to share" : "each mixed contact is shared by its own radii";
  }

  #updateReadout(fit, p, B, stress) {
    const {rule} = state;
    byId("b-name").textContent = `B by ${ruleName(rule)}`;
    byId("b-value").textContent = byId("dock-value").textContent = fixed(B);
    byId("dock-name").textContent = `p = ${fixed(p)}, B =`;
    const {interval: band, of, doubts} = intervalOf(fit, rule);
    const known = Number.isFinite(B) ? interval(band) : "";
    byId("b-interval").textContent = known && `${known} (95 %${of && `, ${of}`})`;
    const {windows, window, times} = fit.settings;
    byId("b-over").replaceChildren(...sentence(`${known && `95 % over ${fit.over}: ${fit.over_words}. `}From ${windows} window${windows === "1" ? "" : "s"} of ${window}, t = ${times}.`));
    listOf(byId("b-verdict"), fit.verdict);
    listOf(byId("b-doubts"), Number.isFinite(B) ? doubts : fit.doubts);
    const [low, high] = band;
    const sure = low > 0 || high < 0;
    byId("b-words").textContent = !Number.isFinite(B)
      ? `No B: ${rule.kind === "drop" ? "the stresses of the two species do not add up to the total stress" : "no layer has a positive pressure in any window"}.`
      : `${B > 0 ? "Large grains carry more than their share of the pressure" : "Large grains carry less than their share of the pressure"}, under this rule${Number.isFinite(low) && !sure ? "; but the interval includes 0" : ""}.`;
  }

  /** Shows the commands that print the same B, in the order in which they must run. */
  #updateCommand(fit) {
    const rule = commandRule(fit, state.rule);
    const ofPower = rule.kind === "power" ? ` --partition ${ruleName(rule)}` : "";
    const all = this.runsOfFit().map((run) => run.commands);
    const made = all.filter(({sums}) => sums).map(({sums, file}) => `${sums}${ofPower} -o ${file}`);
    const pair = fit.settings.pair ? ` --pair ${fit.settings.pair}` : "";
    const {fit: options} = all.find(({sums}) => !sums) ?? all[0]; // grseg-fit selects the rows of a table that was given
    const files = all.map(({file}) => file).join(" ");
    byId("command").textContent = [...made, `grseg-fit ${files} --partition ${ruleName(rule)}${pair}${options}`].join("\n");
  }
}
