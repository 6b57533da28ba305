// SPDX-License-Identifier: GPL-3.0-or-later
// Algebra of grseg-fit: stresses under a partition rule, and B (analysis/stress/partial_stress.cpp,
// analysis/fit/estimators.cpp). Stress under uniform:p is linear in p:
//
//   sigma^L(p) = (1 - p) sigma^L(0) + p sigma^L(1),  for two species sigma^L(0) = A_LL/V, sigma^L(1) = (A_LL + M)/V,
//
// and sigma^S likewise; A_LL sums contacts between large grains, M mixed contacts, V is the volume. The rules
// size and contact-point have sums of their own.

/** Reads a rule such as "size" or "uniform:0.65" as {kind, value}; p is limited to [0, 1], Q to [0, 4]. */
export function parseRule(text) {
  const [kind, number] = text.split(":");
  return kind === "power" || kind === "uniform" ? numberedRule(kind, Number(number)) : {kind, value: NaN};
}
export function numberedRule(kind, value) {
  return {kind, value: Math.min(kind === "power" ? 4 : 1, Math.max(0, value))};
}
export function ruleName({kind, value}) {
  return Number.isNaN(value) || value === undefined ? kind : `${kind}:${Number(value.toPrecision(12))}`;
}

/** Rule with which grseg-fit gives the B of the page. It differs from `rule` for power:Q if the page has no sums for it. */
export function commandRule(fit, rule) {
  const nominal = rule.kind === "power" && !hasPowers(fit);
  return nominal ? {kind: "uniform", value: powerShare(fit.size_ratio, rule.value)} : rule;
}

/** Share of the larger of two grains under power:Q; `ratio` is r_L/r_S. */
export function powerShare(ratio, Q) {
  return 1 / (1 + ratio ** -Q);
}

/** Weight of each node in barycentric interpolation at Q; the nodes are Chebyshev points of the second kind. */
function weightsAt(nodes, Q) {
  const weights = nodes.map((node, k) => {
    const end = k === 0 || k === nodes.length - 1 ? 0.5 : 1;
    return (k % 2 ? -end : end) / (Q - node);
  });
  const hit = nodes.indexOf(Q);
  if (hit >= 0) return nodes.map((_, k) => (k === hit ? 1 : 0));
  const sum = weights.reduce((a, b) => a + b, 0);
  return weights.map((weight) => weight / sum);
}

/** True if the page has sums under power:Q with the radius of each grain; otherwise the page uses nominal radii. */
export function hasPowers(fit) {
  return fit.power_nodes.length > 0;
}

const mixed = (none, all, p) => none.map((_, k) => (1 - p) * none[k] + p * all[k]);
const added = (a, b) => a.map((value, k) => value + b[k]);

function ofPower(fit, get, Q) {
  const total = added(get("none_small"), get("none_large"));
  const weights = weightsAt(fit.power_nodes, Q);
  const nodes = get("power_large");
  const n = total.length;
  const large = new Float64Array(n);
  for (let node = 0; node < weights.length; ++node)
    for (let k = 0; k < n; ++k) large[k] += weights[node] * nodes[node * n + k];
  const small = total.map((value, k) => value - large[k]);
  return {small, large, total, within: get("none_within")};  // two species: the same under every rule
}

/**
 * Stresses under a rule, {small, large, total, within}, each by layer and window; with `prefix` "layer_", means over time by
 * layer. `within`: the part of `large` that gradients inside the layers add.
 */
export function stressOf(fit, rule, prefix = "") {
  const get = (name) => fit.arrays[prefix + name];
  const uniform = (p) => {
    const small = mixed(get("none_small"), get("all_small"), p);
    const large = mixed(get("none_large"), get("all_large"), p);
    return {small, large, total: added(small, large), within: mixed(get("none_within"), get("all_within"), p)};
  };
  switch (rule.kind) {
    case "uniform":
      return uniform(rule.value);
    case "half":
      return uniform(0.5);
    case "power":
      return hasPowers(fit) ? ofPower(fit, get, rule.value) : uniform(powerShare(fit.size_ratio, rule.value));
    case "drop":
      return {small: get("drop_small"), large: get("drop_large"), total: get("drop_total"), within: get("none_within")};
    default: {
      const name = rule.kind.replace("-", "_");
      const small = get(`${name}_small`), large = get(`${name}_large`);
      return {small, large, total: added(small, large), within: get(`${name}_within`)};
    }
  }
}

/** {B, points, weight} as in grseg-fit. A point is one layer in one window; `which`: numbers of the points used, null for all. */
export function sumsOf(fit, stress, which = null) {
  const {phi_large, frames} = fit.arrays;
  const {large: larges, total: totals, within} = stress;
  let excess = 0, weight = 0, points = 0;
  const n = (which ?? phi_large).length;
  for (let m = 0; m < n; ++m) {
    const k = which ? which[m] : m;
    if (!(totals[k] > 0)) continue;
    const phi = phi_large[k];
    excess += frames[k] * ((larges[k] - within[k]) / totals[k] - phi);
    weight += frames[k] * phi * (1 - phi);
    ++points;
  }
  return {B: excess / weight, points, weight};
}

/** B that contacts would have at the share p if they ignored grain size; two species of nominal radii (partition_rule.cpp). */
export function neutralSums(fit, p) {
  if (!fit.two) return NaN;
  const {phi_large, frames} = fit.arrays;
  const r = fit.size_ratio;
  let above = 0, below = 0;
  for (let k = 0; k < phi_large.length; ++k) {
    const phi = phi_large[k], Q = phi * (1 - phi);
    above += (frames[k] * Q * ((p - r / (1 + r)) * (1 + r))) / (phi + r * (1 - phi));
    below += frames[k] * Q;
  }
  return above / below;
}

/** {B, points, weight} under a rule; B is NaN for drop, under which the two stresses do not add up to the total. */
export function fitOf(fit, rule) {
  const all = sumsOf(fit, stressOf(fit, rule));
  return rule.kind === "drop" ? {...all, B: NaN} : all;
}

/**
 * Share p for which uniform:p gives the B of the rule (rule_fit.hpp). NaN if there are more than two species,
 * because the sums then include contacts with other species, unless the rule itself names p.
 */
export function shareOf(fit, rule) {
  if (rule.kind === "uniform") return rule.value;
  if (rule.kind === "half") return 0.5;
  if (rule.kind === "drop") return NaN;
  if (rule.kind === "power" && !hasPowers(fit)) return powerShare(fit.size_ratio, rule.value);
  if (!fit.two) return NaN;
  const wanted = fitOf(fit, rule).B, beyond = (p) => fitOf(fit, {kind: "uniform", value: p}).B - wanted;
  // One secant, unless the tables count contacts at the grains' centres (--assign grain): B(p) is no straight line then.
  let p = 1, at = beyond(p), last = 0, before = beyond(last);
  for (let step = 0; step < 8 && !(Math.abs(at) < 1e-12); ++step) {
    const next = p - (at * (p - last)) / (at - before);
    [last, before, p, at] = [p, at, next, beyond(next)];
  }
  return p;
}

/** Share p* at which B is 0, with its interval, from grseg-fit: [p*, low, high]; NaN if there are more than two species. */
export function zeroOf(fit) {
  return (fit.scan.p_zero ?? [null, null, null]).map((value) => value ?? NaN);
}
/** True for numbers from 0 to 1. */
export function isShare(p) {
  return p >= 0 && p <= 1;
}

/**
 * Half of the interval of B at the share p, from [B, low, high] at equally spaced shares. Its square is a parabola
 * between three of them: B is linear in p, and so is each part of its deviation.
 */
export function halfAt(p, {p: grid, B: rows}) {
  const last = grid.length - 1, place = (p - grid[0]) / (grid[1] - grid[0]);
  if (!(place >= -1e-9 && place <= last + 1e-9)) return NaN;
  const k = Math.min(last - 1, Math.max(1, Math.round(place))), t = place - k;
  const [a, b, c] = [k - 1, k, k + 1].map((n) => (rows[n][1] === null ? NaN : ((rows[n][2] - rows[n][1]) / 2) ** 2));
  return Math.sqrt(Math.max(0, b + (t * (c - a)) / 2 + (t * t * (a - 2 * b + c)) / 2));
}

/** Result of grseg-fit for a rule, over all runs of the fit; undefined if the page does not contain it. */
export function fittedRule(fit, rule) {
  const name = ruleName(rule);
  return fit.rules.filter((row) => row.name === name).pop();
}

/**
 * Interval of B under a rule, {interval: [low, high], of, doubts}: from grseg-fit, with `of` "", or as wide as the
 * interval at the rule's share.
 */
export function intervalOf(fit, rule) {
  const own = fittedRule(fit, rule);
  if (own) return {interval: own.B.slice(1).map((x) => x ?? NaN), of: "", doubts: [...fit.doubts, own.doubt].filter(Boolean)};
  const p = shareOf(fit, rule), {B} = fitOf(fit, rule), half = halfAt(p, fit.scan);
  const doubt = fit.scan.doubts[Math.round(p * (fit.scan.p.length - 1))];
  return {
    interval: [B - half, B + half],
    of: rule.kind === "uniform" ? "" : `taken from uniform:${Number(p.toPrecision(3))}`,
    doubts: [...fit.doubts, doubt].filter(Boolean),
  };
}
