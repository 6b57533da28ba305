"""Dependence of B on composition, flux and gradient in a flow that segregates."""
import math

import numpy as np

import tables

STRESS = ["t0", "t1", "y0", "y1", "frames", "area_S", "area_L", "A_SS_yy", "A_LL_yy", "M_yy", "Msize_yy", "A_Sb_yy", "A_Lb_yy"]
FLUX = ["t0", "y0", "frames", "q_L", "q_L_error", "dphi_dy"]
TIMES = ((5, 20), (20, 60), (60, 100), (100, 150), (150, 300), (300, 600))  # intervals of time, s
BED = 60  # height of the bed, d_S
BLOCK = 60  # length of the blocks of a single run, s


def stresses(sums):
    """phi_L, the stress of large grains by size, and the total stress, from sums with the columns STRESS[5:]."""
    of = dict(zip(STRESS[5:], sums))
    small = of["A_SS_yy"] + of["M_yy"] - of["Msize_yy"] + of["A_Sb_yy"]
    large = of["A_LL_yy"] + of["Msize_yy"] + of["A_Lb_yy"]
    return of["area_L"] / (of["area_S"] + of["area_L"]), large, large + small


def points_of(run, options):
    """Points of a run, a row each: time, y/H, phi_L, psi_L - phi_L without what gradients inside the layers add, frames,
    q_L/sqrt(g d_S), d_S dphi_L/dy, and the variance of the number with q_L."""
    sums, fluxes = (tables.table(run.path(name)) for name in ("stress", "segregation"))
    stress, flux = (np.stack([table[name] for name in names], 1) for table, names in ((sums, STRESS), (fluxes, FLUX)))
    d = sums.number("small_diameter")
    speed = np.sqrt(np.hypot(float(sums.header["gravity_x"]), float(sums.header["gravity_y"])) * d)
    at = {(round(row[0], 6), round(row[1], 9)): row for row in flux[~np.isnan(flux[:, 1])]}
    groups, means = {}, {}
    for row in stress:
        where = int(row[0] / options.window + 1e-6), round((row[2] + row[3]) / 2 / d, 3)
        means[where] = means.get(where, 0) + row[4] * row[5:]
        other = at.get((round(row[0], 6), round(row[2], 9)))
        if other is not None and row[2] > (tables.INSIDE[0] - 1e-6) * d and row[3] < (tables.INSIDE[1] + 1e-6) * d:
            groups.setdefault(where, []).append((row, other))
    of = {where: stresses(mean) for where, mean in means.items() if mean[:2].sum() > 0}
    points = []
    for (k, y), pairs in sorted(groups.items()):
        thickness = round((pairs[0][0][3] - pairs[0][0][2]) / d, 3)
        phi, large, whole = own = of[k, y]
        below, above = (of.get((k, round(y + side * thickness, 3)), own) for side in (-1, 1))
        layers = max((below is not own) + (above is not own), 1)
        within = tables.part_within(above[0] - below[0], above[2] - below[2], layers, whole)
        q = np.array([other for _, other in pairs])
        frames = q[:, 2].sum()
        flow, error = (q[:, 2] * q[:, 3]).sum() / frames, np.sqrt(((q[:, 2] * q[:, 4]) ** 2).sum()) / frames
        points.append([(k + 0.5) * options.window, y / BED, phi, large / whole - phi - within, frames,
                       flow / speed, d * (q[:, 2] * q[:, 5]).sum() / frames, (error / speed) ** 2])
    points = np.array(points)
    return points[~np.isnan(points).any(1)]


def background(points):
    y, phi = points[:, 1], points[:, 2]
    return (phi * (1 - phi))[:, None] * np.stack([np.ones_like(y), phi, y, phi**2, phi * y, y**2], 1)


def beyond(basis, weight, value):
    """Residual of `value` after weighted least squares on `basis`."""
    root = np.sqrt(weight)[:, None]
    solution = np.linalg.lstsq(basis * root, value * root[:, 0], rcond=None)[0]
    return value - basis @ solution


MODELS = {"+q": [5], "+gradient": [6], "both": [5, 6]}
NAMES = {5: "j", 6: "k"}


def fit(points):
    """Numbers by (model, name): coefficients, r2, reliability, j_true and correlation; see stages()."""
    basis, weight = background(points), points[:, 4]
    rest = beyond(basis, weight, points[:, 3])
    found = {}
    for model, columns in MODELS.items():
        parts = np.stack([beyond(basis, weight, points[:, c]) for c in columns], 1)
        root = np.sqrt(weight)[:, None]
        solution = np.linalg.lstsq(parts * root, rest * root[:, 0], rcond=None)[0]
        for c, value in zip(columns, solution):
            found[model, NAMES[c]] = value
        found[model, "r2"] = 1 - (weight * (rest - parts @ solution) ** 2).sum() / (weight * rest**2).sum()
    flux, gradient = (beyond(basis, weight, points[:, c]) for c in (5, 6))
    found["q", "reliability"] = 1 - (weight * points[:, 7]).sum() / (weight * flux**2).sum()
    found["+q", "j_true"] = found["+q", "j"] / found["q", "reliability"]
    found["q and gradient", "correlation"] = (weight * flux * gradient).sum() / np.sqrt((weight * flux**2).sum() * (weight * gradient**2).sum())
    return found


def classes(points, edges):
    return 3 * np.searchsorted(edges, points[:, 2]) + np.minimum(2, (3 * points[:, 1]).astype(int))


def blocks(points, length):
    """Points of a run, split into blocks of `length` s."""
    number = np.floor(points[:, 0] / length + 1e-6)
    return [points[number == n] for n in np.unique(number)]


def left_out(value, units):
    """Standard error and degrees of freedom of value(units) by the jackknife; the error is nan if there is one unit."""
    n = len(units)
    if n < 2:
        return math.nan, 1
    each = np.array([value(units[:k] + units[k + 1:]) for k in range(n)])
    return math.sqrt((n - 1) / n * ((each - each.mean()) ** 2).sum()), n - 1


def level(units, common, edges):
    """Mean of B over the classes `common` of composition and height, or B of all points if `common` is empty. It is nan if a
    class is empty."""
    points = np.concatenate(units)
    kind = classes(points, edges)
    parts = [points[kind == c] for c in common] or [points]
    return np.mean([(p[:, 4] * p[:, 3]).sum() / (p[:, 4] * p[:, 2] * (1 - p[:, 2])).sum() if len(p) else math.nan for p in parts])


def by_time(starts, window):
    """Rows with B by start and time: of all points, and as mean over the classes of composition and height that all starts
    have, with equal weights."""
    edges = np.quantile(np.concatenate([points for runs in starts.values() for points in runs])[:, 2], [0.2, 0.4, 0.6, 0.8])
    inside = lambda points, time: points[(points[:, 0] - window / 2 >= time[0] - 1e-6) & (points[:, 0] + window / 2 <= time[1] + 1e-6)]
    for time in TIMES:
        chosen = {start: [inside(points, time) for points in runs] for start, runs in starts.items()}
        chosen = {start: runs for start, runs in chosen.items() if all(len(points) for points in runs)}
        common = set.intersection(*[set(classes(points, edges)) for runs in chosen.values() for points in runs]) if chosen else set()
        for what, parts in (("B", []), (f"B over {len(common)} classes", sorted(common))):
            if what != "B" and not common:
                continue
            value = lambda units: level(units, parts, edges)
            for start, runs in chosen.items():
                if len(runs) > 1:
                    mean, reach = tables.mean_and_half_width([value([points]) for points in runs])
                    over = f"{len(runs)} runs"
                else:
                    units = blocks(runs[0], max(window, (time[1] - time[0]) / 10)) if window else runs
                    mean, (error, freedom), over = value(units), left_out(value, units), f"{len(units)} block" + ("s" if len(units) > 1 else "")
                    reach = tables.student(freedom) * error
                yield f"{start} {time[0]}-{time[1]} s", what, mean, mean - reach, mean + reach, over


def jackknife(starts):
    """Rows with every number of `fit` and its interval. Units are the runs of a start, or blocks of its only run. The units of
    each start are left out one by one, the variances of the starts are added, and degrees of freedom are Satterthwaite's."""
    units = {start: runs if len(runs) > 1 else blocks(runs[0], BLOCK) for start, runs in starts.items()}
    of = lambda key, start: lambda less: fitted(start, less)[key]
    kept = {}

    def fitted(start, less):
        name = (start, tuple(map(id, less)))
        if name not in kept:
            kept[name] = fit(np.concatenate([points for other, own in units.items() for points in (less if other == start else own)]))
        return kept[name]

    over = " and ".join(sorted({"runs" if len(runs) > 1 else f"blocks of {BLOCK} s" for runs in starts.values()}, reverse=True))
    for key, value in fit(np.concatenate([points for runs in starts.values() for points in runs])).items():
        error, freedom = tables.welch(*[left_out(of(key, start), own) for start, own in units.items()])
        reach = math.nan if math.isnan(error) else tables.student(freedom) * error
        yield *key, value, value - reach, value + reach, over


def stages(options):
    """Tests if B in a flow that segregates depends on composition and height, on the flux, or on the gradient of composition.

    The flows start with large grains below, mixed, and above, so that flux and gradient have both signs at the same composition
    and height. A point is a layer of 4 d_S inside (4 to 56 d_S) over --window seconds of one run, weighted by its frames. The
    large grains' share of the stress minus their share of the grains, psi_L - phi_L by size, is fitted by least squares as

        psi_L - phi_L = phi_L phi_S P(phi_L, y/H) + j q_L/sqrt(g d_S) + k d_S (d phi_L/dy)

    P, a full quadratic, is B as a function of composition and height. q_L is the flux of large grains, positive upward
    (grseg-segregation). No number is divided by the contents of a species, which may be small. Intervals (95 %) are from the
    jackknife with Student's t, over the runs of each start. If a start has one run, they are over blocks of this run: 60 s for
    the fit, and up to a tenth of the time, but at least one window, for B by time. Such an interval describes differences
    inside the run, not between seeds (column over).

    Rows: model (+q, +gradient, both), coefficient, value, low, high. r2 is the share of the variance beyond P that the model
    explains. q_L has an error of measurement: reliability is the share of its variance beyond P that is not noise, and j_true =
    j/reliability for the model +q. Then follows B by start and time, of all points and at equal composition and height: the mean
    over classes of phi_L (quintiles of all points) and height (thirds) that all starts have, with equal weights.
    """
    starts = {flow: [points_of(run, options) for run in runs] for flow, runs in tables.flows_in(options).items()}
    columns = ["of", "what", "value", "low", "high", "over"]
    found = [dict(zip(columns, row)) for row in (*jackknife(starts), *by_time(starts, options.window))]
    tables.write(options.output, f"stages {options.window:g}", columns, found)
