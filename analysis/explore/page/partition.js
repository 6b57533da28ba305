// SPDX-License-Identifier: GPL-3.0-or-later
// The algebra of grseg-fit: stresses under a rule, and B of them (analysis/stress/partial_stress.cpp,
// analysis/fit/estimators.cpp). Stress under uniform:p is linear in p:
//
//   sigma^L(p) = (1 - p) sigma^L(0) + p sigma^L(1),  of two species sigma^L(0) = A_LL/V, sigma^L(1) = (A_LL + M)/V,
//
// and that of small grains likewise; `size` and `contact-point` have sums of their own.

/** A rule as typed, "size", "uniform:0.65": {kind, value}; p and Q within what the page knows of. */
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

/** The same as grseg-fit takes it: without sums by power:Q that of nominal radii. */
export function commandRule(fit, rule) {
  const nominal = rule.kind === "power" && !hasPowers(fit);
  return nominal ? {kind: "uniform", value: powerShare(fit.size_ratio, rule.value)} : rule;
}

/** Share of the larger of two grains by power:Q, `ratio` being r_L/r_S. */
export function powerShare(ratio, Q) {
  return 1 / (1 + ratio ** -Q);
}

/** What barycentric interpolation in Chebyshev's points (of the second kind) gives to each at Q. */
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

/** Whether Q is that of the grains' own radii, rather than of the nominal ones. */
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
  return {small, large, total};
}

/** {small, large, total}: stresses of the points of the fit, or with `prefix` "layer_" of the layers' means. */
export function stressOf(fit, rule, prefix = "") {
  const get = (name) => fit.arrays[prefix + name];
  const uniform = (p) => {
    const small = mixed(get("none_small"), get("all_small"), p);
    const large = mixed(get("none_large"), get("all_large"), p);
    return {small, large, total: added(small, large)};
  };
  switch (rule.kind) {
    case "uniform":
      return uniform(rule.value);
    case "half":
      return uniform(0.5);
    case "power":
      return hasPowers(fit) ? ofPower(fit, get, rule.value) : uniform(powerShare(fit.size_ratio, rule.value));
    case "drop":
      return {small: get("drop_small"), large: get("drop_large"), total: get("drop_total")};
    default: {
      const name = rule.kind.replace("-", "_");
      const small = get(`${name}_small`), large = get(`${name}_large`);
      return {small, large, total: added(small, large)};
    }
  }
}

/** {B, points, weight} as grseg-fit has them; `which`: the numbers of the points, if not all. */
export function sumsOf(fit, stress, which = null) {
  const {phi_large, frames} = fit.arrays;
  const {large: larges, total: totals} = stress;
  let excess = 0, weight = 0, points = 0;
  const n = (which ?? phi_large).length;
  for (let m = 0; m < n; ++m) {
    const k = which ? which[m] : m;
    if (!(totals[k] > 0)) continue;
    const phi = phi_large[k];
    excess += frames[k] * (larges[k] / totals[k] - phi);
    weight += frames[k] * phi * (1 - phi);
    ++points;
  }
  return {B: excess / weight, points, weight};
}

/** Of two species: B of contacts that ignore grain size, of nominal radii, at p (partition_rule.cpp). */
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

/** The same of a rule; B of `drop`, whose stresses do not add up to the whole, is not a number. */
export function fitOf(fit, rule) {
  const all = sumsOf(fit, stressOf(fit, rule));
  return rule.kind === "drop" ? {...all, B: NaN} : all;
}

/**
 * The share of all mixed contacts that gives the same B (rule_fit.hpp). Of more than two species it is not in the
 * sums of the pair, which hold contacts with the others: NaN but where the rule itself says it.
 */
export function shareOf(fit, rule) {
  if (rule.kind === "uniform") return rule.value;
  if (rule.kind === "half") return 0.5;
  if (rule.kind === "drop") return NaN;
  if (rule.kind === "power" && !hasPowers(fit)) return powerShare(fit.size_ratio, rule.value);
  if (!fit.two) return NaN;
  const at = (p) => fitOf(fit, {kind: "uniform", value: p}).B;
  return (fitOf(fit, rule).B - at(0)) / (at(1) - at(0));
}

/** [p*, low, high] at which B is 0, as grseg-fit says; NaN of more than two species. */
export function zeroOf(fit) {
  return (fit.scan.p_zero ?? [null, null, null]).map((value) => value ?? NaN);
}
/** Whether a share can be p*. */
export function isShare(p) {
  return p >= 0 && p <= 1;
}

/** [low, high] of the band at the share p, between the shares at which grseg-fit made it. */
export function bandAt(fit, p) {
  const {p: grid, B: rows} = fit.scan;
  if (!(p >= grid[0] && p <= grid[grid.length - 1])) return [NaN, NaN];
  let k = 0;
  while (k < grid.length - 2 && grid[k + 1] < p) ++k;
  const t = (p - grid[k]) / (grid[k + 1] - grid[k]);
  return [1, 2].map((side) =>
    rows[k][side] === null || rows[k + 1][side] === null
      ? NaN
      : (1 - t) * rows[k][side] + t * rows[k + 1][side]);
}

/** The row of a rule that grseg-fit fitted for all runs together, if it did. */
export function fittedRule(fit, rule) {
  const name = ruleName(rule);
  return fit.rules.filter((row) => row.name === name).pop();
}

/** {interval: [low, high], of: what it is of} of a rule: its own, or that of the band at its share. */
export function intervalOf(fit, rule) {
  const own = fittedRule(fit, rule);
  if (own) return {interval: own.B.slice(1).map((x) => x ?? NaN), of: ""};
  const p = shareOf(fit, rule);
  return {interval: bandAt(fit, p), of: rule.kind === "uniform" ? "" : `that of uniform:${Number(p.toPrecision(3))}`};
}
