"""The dependence of B on composition, flux and gradient in a flow that segregates."""
import math

import numpy as np

import tables
import grseg

STRESS = ["t0", "t1", "y0", "y1", "frames", "area_S", "area_L", "A_SS_yy", "A_LL_yy", "M_yy", "Msize_yy", "A_Sb_yy", "A_Lb_yy"]
FLUX = ["t0", "y0", "frames", "q_L", "q_L_error", "dphi_dy"]
TIMES = ((5, 20), (20, 60), (60, 100), (100, 150), (150, 300), (300, 600))  # s
BED = 60  # d_S, height of the bed
BLOCK = 60  # s, of a single run


def points_of(run, options):
    """Rows time, y/H, phi_L, psi_L - phi_L, frames, q_L/sqrt(g d_S), d_S dphi_L/dy, variance of the sixth."""
    sums, fluxes = (grseg.read_table(run.path(name)) for name in ("stress", "segregation"))
    stress, flux = (np.stack([table[name] for name in names], 1) for table, names in ((sums, STRESS), (fluxes, FLUX)))
    d = sums.number("small_diameter")
    speed = np.sqrt(np.hypot(float(sums.header["gravity_x"]), float(sums.header["gravity_y"])) * d)
    at = {(round(row[0], 6), round(row[1], 9)): row for row in flux[~np.isnan(flux[:, 1])]}
    groups = {}
    for row in stress:
        other = at.get((round(row[0], 6), round(row[2], 9)))
        if other is None or row[2] < (tables.INSIDE[0] - 1e-6) * d or row[3] > (tables.INSIDE[1] + 1e-6) * d:
            continue
        groups.setdefault((int(row[0] / options.window + 1e-6), round((row[2] + row[3]) / 2 / d, 3)), []).append((row, other))
    points = []
    for (k, y), pairs in sorted(groups.items()):
        s, q = (np.array([pair[n] for pair in pairs]) for n in (0, 1))
        mean = dict(zip(STRESS[5:], (s[:, 4:5] * s[:, 5:]).sum(0)))
        large = mean["A_LL_yy"] + mean["Msize_yy"] + mean["A_Lb_yy"]
        small = mean["A_SS_yy"] + mean["M_yy"] - mean["Msize_yy"] + mean["A_Sb_yy"]
        phi = mean["area_L"] / (mean["area_S"] + mean["area_L"])
        frames = q[:, 2].sum()
        flow, error = (q[:, 2] * q[:, 3]).sum() / frames, np.sqrt(((q[:, 2] * q[:, 4]) ** 2).sum()) / frames
        points.append([(k + 0.5) * options.window, y / BED, phi, large / (large + small) - phi, frames, flow / speed,
                       d * (q[:, 2] * q[:, 5]).sum() / frames, (error / speed) ** 2])
    points = np.array(points)
    return points[~np.isnan(points).any(1)]


def background(points):
    y, phi = points[:, 1], points[:, 2]
    return (phi * (1 - phi))[:, None] * np.stack([np.ones_like(y), phi, y, phi**2, phi * y, y**2], 1)


def beyond(basis, weight, value):
    """The part of `value` that `basis` does not explain (weighted least squares)."""
    root = np.sqrt(weight)[:, None]
    solution = np.linalg.lstsq(basis * root, value * root[:, 0], rcond=None)[0]
    return value - basis @ solution


MODELS = {"+q": [5], "+gradient": [6], "both": [5, 6]}
NAMES = {5: "j", 6: "k"}


def fit(points):
    """Coefficients by model, and what they explain."""
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
    """The points of a run in blocks of time."""
    number = np.floor(points[:, 0] / length + 1e-6)
    return [points[number == n] for n in np.unique(number)]


def left_out(value, units):
    """Error and degrees of freedom of value(units) by the jackknife; not a number where there is one unit."""
    n = len(units)
    if n < 2:
        return math.nan, 1
    each = np.array([value(units[:k] + units[k + 1:]) for k in range(n)])
    return math.sqrt((n - 1) / n * ((each - each.mean()) ** 2).sum()), n - 1


def level(units, common, edges):
    """B as mean over these classes of composition and height; of all points where there is none. Not a number where a class is empty."""
    points = np.concatenate(units)
    kind = classes(points, edges)
    parts = [points[kind == c] for c in common] or [points]
    return np.mean([(p[:, 4] * p[:, 3]).sum() / (p[:, 4] * p[:, 2] * (1 - p[:, 2])).sum() if len(p) else math.nan for p in parts])


def by_time(starts, window):
    """B by start and time: as it is, and over the classes of composition and height that all starts have, equally weighted."""
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
    """Every number of `fit`, with its interval: the units of each start are left out one by one, the starts' variances add up, and
    degrees of freedom are Satterthwaite's. Units are the start's runs, or blocks of its only run."""
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
    """Tests if B in a flow that segregates follows composition and height, the flux, or the gradient of composition.

    The flows start with large grains below, mixed, and above, so that flux and gradient take both signs at the same composition
    and height. A point is a layer of 4 d_S inside (4 to 56 d_S) over --window seconds of one run, weighted by its frames. The large grains' share of the stress less
    their share of the grains, psi_L - phi_L by size, is fitted by least squares as

        psi_L - phi_L = phi_L phi_S P(phi_L, y/H) + j q_L/sqrt(g d_S) + k d_S (d phi_L/dy)

    P, a full quadratic, is B as a function of composition and height; q_L is the flux of large grains, up > 0 (grseg-segregation). Nothing is divided by few grains. 95 % intervals are from the jackknife with Student's t: over the
    runs of each start; of a start that has one run over blocks of that run, of 60 s for the fit and of up to a tenth of the time for B by time, at least one window. These say how the run differs
    from itself, not what another seed would give (column over).

    Rows: model (+q, +gradient, both), coefficient, value, low, high; r2 is the share of the variance that the model explains beyond P. q_L is measured with an
    error: reliability is the share of its variance, beyond P, that is not noise; j_true = j/reliability of the model +q. Then B by start and time, as it is and at equal composition and height: sums over
    classes of phi_L (quintiles of all points) and height (thirds), equally weighted over the classes that all starts have.
    """
    starts = {flow: [points_of(run, options) for run in runs] for flow, runs in tables.flows_in(options).items()}
    columns = ["of", "what", "value", "low", "high", "over"]
    found = [dict(zip(columns, row)) for row in (*jackknife(starts), *by_time(starts, options.window))]
    tables.write(options.output, f"stages {options.window:g}", columns, found)
