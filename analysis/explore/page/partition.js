// SPDX-License-Identifier: GPL-3.0-or-later
// The algebra of grseg-fit: stresses under a rule, and B of them (analysis/stress/partial_stress.cpp,
// analysis/fit/estimators.cpp). Stress under uniform:p is linear in p:
//
//   sigma^L(p) = (1 - p) sigma^L(0) + p sigma^L(1),  of two species sigma^L(0) = A_LL/V, sigma^L(1) = (A_LL + M)/V,
//
// and that of small grains likewise; `size` and `contact-point` have sums of their own.

/** A rule as typed, "size", "uniform:0.65": {kind, value}. */
export function parseRule(text) {
  const [kind, number] = text.split(":");
  return {kind, value: number === undefined ? NaN : Number(number)};
}
export function ruleName({kind, value}) {
  return Number.isNaN(value) || value === undefined ? kind : `${kind}:${Number(value.toPrecision(12))}`;
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

function mixed(none, all, p) {
  const values = new Float64Array(none.length);
  for (let k = 0; k < values.length; ++k) values[k] = (1 - p) * none[k] + p * all[k];
  return values;
}

function added(a, b) {
  const values = new Float64Array(a.length);
  for (let k = 0; k < values.length; ++k) values[k] = a[k] + b[k];
  return values;
}

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

/** B and what belongs to it, as grseg-fit prints them; `where` chooses points by number. */
export function estimatorsOf(fit, stress, where = () => true) {
  const {phi_large, weight, frames} = fit.arrays;
  const {small: smalls, large: larges, total: totals} = stress;
  let w = 0, wLog = 0, xx = 0, xy = 0, wQD = 0, wQQ = 0, fD = 0, fQ = 0, points = 0;
  for (let k = 0; k < phi_large.length; ++k) {
    if (!where(k)) continue;
    const phi = phi_large[k], small = smalls[k], large = larges[k], total = totals[k];
    if (small > 0 && large > 0) {
      const x = (1 - phi) / phi, y = small / large;
      w += weight[k];
      wLog += weight[k] * Math.log(y / x);
      xx += x * x;
      xy += x * y;
      ++points;
    }
    if (total > 0) {
      const Q = phi * (1 - phi), D = large / total - phi;
      wQD += weight[k] * Q * D;
      wQQ += weight[k] * Q * Q;
      fD += frames[k] * D;
      fQ += frames[k] * Q;
    }
  }
  const slope = Math.exp(wLog / w), linear = xy / xx;
  const atHalf = (s) => (2 * (1 - s)) / (1 + s);
  return {
    points,
    slope,
    B_half: atHalf(slope),
    B_mean: -wLog / w,
    slope_linear: linear,
    B_linear: atHalf(linear),
    B_direct: wQD / wQQ,
    B_sums: fD / fQ,
    weight: fQ,
  };
}

/** B_sums of contacts that ignore grain size, of nominal radii, at the share p (neutral_contacts.hpp). */
export function neutralSums(fit, p) {
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
  const all = estimatorsOf(fit, stressOf(fit, rule));
  if (rule.kind === "drop") for (const name of Object.keys(all)) if (name.startsWith("B_")) all[name] = NaN;
  return all;
}

/** Mean share of the large grains in the stress of mixed contacts. */
export function shareOf(fit, rule) {
  if (rule.kind === "uniform") return rule.value;
  if (rule.kind === "half") return 0.5;
  if (rule.kind === "drop") return NaN;
  const {none_large, all_large, weight} = fit.arrays;
  const {large} = stressOf(fit, rule);
  let given = 0, whole = 0;
  for (let k = 0; k < large.length; ++k) {
    given += weight[k] * (large[k] - none_large[k]);
    whole += weight[k] * (all_large[k] - none_large[k]);
  }
  return given / whole;
}

/** p*, at which B_sums = 0: the sum over frames of psi_L - phi_L is linear in p. */
export function zeroOfSums(fit) {
  const at = (p) => {
    const {B_sums, weight} = fitOf(fit, {kind: "uniform", value: p});
    return B_sums * weight;
  };
  const none = at(0);
  return -none / (at(1) - none);
}

/** [p*, low, high] of B by sums: of the rule that was fitted next to it. */
export function zeroOfSumsWithInterval(fit) {
  const size = (row) => Math.abs(row.B_sums[0]);
  const rows = fit.rules.filter((row) => row.p_zero_sums[0] !== null && row.B_sums[0] !== null);
  const nearest = rows.reduce((best, row) => (best && size(best) <= size(row) ? best : row), null);
  return [zeroOfSums(fit), ...(nearest ? nearest.p_zero_sums.slice(1).map((v) => v ?? NaN) : [NaN, NaN])];
}

/** [low, high] of the band at the share p, between the shares at which grseg-fit made it. */
export function bandAt(fit, estimator, p) {
  const {p: grid, [estimator]: rows} = fit.scan;
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

/** [low, high] of a rule: its own, or that of the band at its mean share. */
export function intervalOf(fit, rule, estimator) {
  const own = fittedRule(fit, rule);
  if (own) return own[estimator].slice(1).map((x) => (x === null ? NaN : x));
  return bandAt(fit, estimator, shareOf(fit, rule));
}
