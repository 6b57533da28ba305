"""Numbers from which the paper's figures are drawn, other than fits."""
import math
import statistics
import sys

import numpy as np

import profiles
import rise
import tables

QUARTERS = 4


class Part:
    """Runs that are measured together, between two times, s."""

    def __init__(self, runs, begin=-math.inf, end=math.inf):
        self.runs, self.begin, self.end = runs, begin, end


def parts_of(runs, begin=0):
    """A Part for each run from `begin` (s) on; if there are fewer than three runs, a Part for each quarter of each run."""
    if len(runs) > 2:
        return [Part([run], begin) for run in runs]
    parts = []
    for run in runs:
        edges = np.linspace(begin, tables.table(run.path("segregation"))["t1"].max(), QUARTERS + 1)
        parts += [Part([run], *pair) for pair in zip(edges, edges[1:])]
    return parts


def pressures(_, part):
    """Numbers of figures 2a and 3a, from the profiles of one run."""
    run = part.runs[0]
    profile = profiles.Profile([run.path("stress")], [run.path("kinetic")], part.begin, part.end)
    use = profile.inside()
    at = {name: values[use] for name, (values, _) in profile.columns().items()}
    height, parts = profile.middle[use], at["Kyy/syy"]
    over_weight = at["syy"] * (1 + parts) * profile.unit / profile.weights()[use]
    found = {"P_solid_slope": -statistics.linear_regression(height, at["P_solid"]).slope,
             "P_slope": -statistics.linear_regression(height, at["P"]).slope, "nu": at["nu"].mean(), "weight": over_weight.mean(),
             "Kyy/syy_least": parts.min(), "Kyy/syy_most": parts.max(), "Kyy/syy": parts.mean()}
    for name in ("K", "K_solid", "K_layer", "K_layer_solid"):
        # P^kappa = a exp(-z/l), fitted as a straight line to the logarithm.
        slope, level = statistics.linear_regression(height, np.log(at[name]))
        found[f"{name}_prefactor"] = math.exp(level)
        found[f"{name}_decay"] = -1 / slope / 2  # decay length in d_L
        found[f"{name}_lowest"] = at[name][0]
    found["shear_share"] = (at["K_layer"] / at["K"]).mean() - 1
    return found


def derived(options, runs, *words):
    return tables.program(options, "grseg-derive", *(run.path("micro") for run in runs), "--quiet", *words)[1]


def last_layers(part):
    """Layers of the last window: heights, areas of small grains, areas of large grains, numbers of large grains."""
    table = tables.table(part.runs[0].path("micro"))
    use = (table["t1"] == table["t1"][-1]) & ~np.isnan(table["y0"])
    return [table[name][use] for name in ("y0", "area_S", "area_L", "grains_L")]


def separation(options, part):
    """Numbers of figure 1, in the last window: height of the large grains, from 0 (below) to 1 (above); and degree of
    mixing, from 0 (separated) to 1 (mixed)."""
    end = over_windows(options, part)[-1]["yL/H"]
    _, areas_small, areas_large, _ = last_layers(part)
    both = areas_small + areas_large
    mixed = (areas_small * areas_large / np.where(both, both, 1)).sum()
    small, large, whole = areas_small.sum(), areas_large.sum(), both.sum()
    return {"way": (end - large / whole / 2) / (small / whole), "mixed": mixed * whole / (small * large)}


def trapped(options, part):
    """Number of large grains in the lowest layer at the end: a row that the base traps, or almost none."""
    heights, *_, large_grains = last_layers(part)
    return {"lowest_large": large_grains[heights.argmin()]}


def strength(options, runs, *words, name="B"):
    """B of all runs together, from layers inside."""
    kind = "kinetic" if "kinetic" in words else "stress"
    return tables.fits(options, *(run.path(kind) for run in runs), "--heights", "4dS:56dS",
                       "--over", "windows", "--quiet", *words)[0][name]


def early_less_late(options, part):
    return {"early_less_late": strength(options, part.runs, "--end", tables.EARLY)
            - strength(options, part.runs, "--begin", tables.LATE)}


def differences(options, part):
    """B of the pressure minus B of yy, B of kinetic stress over B, and B of early minus late times, from the same runs."""
    b = strength(options, part.runs)
    return {"pressure_less_yy": strength(options, part.runs, "--component", "pressure") - b,
            "B_kappa/B": -strength(options, part.runs, "--quantity", "kinetic", name="paper_B")
                         / strength(options, part.runs, name="paper_B"),
            **early_less_late(options, part)}


def layers_of(part):
    """Pairs of Phi_L and layers inside, one per run."""
    return [(run.phi, rise.layers_of(run.path("micro"))) for run in part.runs]


def mixed_share(options, part):
    """Numbers of figure 2c, by composition of layers inside."""
    bins = derived(options, part.runs, "--pool", "composition", "--heights", "4dS:56dS")
    most = max(bins, key=lambda row: row["mixed_share"])
    off = [row["mixed_share"] - row["neutral_share"] for row in bins]
    return {"mixed_most": most["mixed_share"], "mixed_most_at": most["phi_L"],
            "mixed_off_least": min(off), "mixed_off_most": max(off)}


def estimates(options, part):
    """Numbers of figure 5: mean and largest error of Pi, %, over compositions of layers inside."""
    found = {}
    for label, words in (("contacts", ["--preset", "paper"]),
                         ("ends", ["--force", "normal", "--average", "ends"])):
        bins = derived(options, part.runs, "--pool", "composition", "--heights", "4dS:56dS",
                       *words)
        for name in ("error", "error_S", "error_L", "error_printed", "error_S_printed",
                     "error_L_printed"):
            sizes = [100 * abs(row[name]) for row in bins]
            found[f"{label}_{name}_mean"] = statistics.fmean(sizes)
            found[f"{label}_{name}_most"] = max(sizes)
        found[f"{label}_error_S_signed"] = 100 * statistics.fmean(row["error_S"] for row in bins)
        found[f"{label}_error_L_signed"] = 100 * statistics.fmean(row["error_L"] for row in bins)
        found[f"{label}_B"] = b_of_structure(options, part.runs, words)
    return found


def b_of_structure(options, runs, words):
    """B at phi = 1/2 from s = r (z_S/z_L)(f_S/f_L): logarithmic mean over layers and windows inside,
    with the weights and the range of grseg-fit."""
    sum_log = sum_weight = 0
    for run in runs:
        sums = tables.table(run.path("micro"))
        rarer = dict(zip(zip(sums["t0"], sums["y0"]), np.minimum(sums["grains_S"], sums["grains_L"])))
        for row in derived(options, [run], "--heights", "4dS:56dS", *words):
            phi = row["phi_L"]
            if not math.isnan(row["y0"]) and 0 < row["s_Pi"] < math.inf and 0.01 <= (1 - phi) / phi <= 100:
                weight = row["frames"] * rarer[row["t0"], row["y0"]]
                sum_log += weight * math.log(row["s_Pi"])
                sum_weight += weight
    s = math.exp(sum_log / sum_weight)
    return 2 * (1 - s) / (1 + s)


def over_windows(options, part):
    """Rows of grseg-derive for the whole bed, window by window."""
    return [row for row in derived(options, part.runs) if math.isnan(row["y0"])]


def over_time(options, part):
    """Numbers of figure 6, for the whole bed."""
    rows = over_windows(options, part)
    ratio = lambda row, name: row[f"{name}_L"] / row[f"{name}_S"]
    z = [ratio(row, "z") for row in rows]
    f = [ratio(row, "f") for row in rows]
    hat = [ratio(row, "f_depth") for row in rows]
    neutral = [ratio(row, "f_weight_neutral") for row in rows]
    last = max(1, round(12.5 / (rows[0]["t1"] - rows[0]["t0"])))
    mean = statistics.fmean
    return {"yL_first": rows[0]["yL/H"], "yL_last": mean(row["yL/H"] for row in rows[-last:]),
            "yL_falls": sum(b["yL/H"] < a["yL/H"] for a, b in zip(rows, rows[1:])),
            "windows": len(rows), "z_first": z[0], "z_most": max(z), "z_least": min(z),
            "z_last": mean(z[-last:]), "z_most/ends": max(z) / max(z[0], mean(z[-last:])), "z_most_at": rows[z.index(max(z))]["t0"],
            "f_first": f[0], "f_least": min(f), "f_last": mean(f[-last:]),
            "neutral_last": mean(neutral[-last:]), "neutral_least": min(neutral),
            "f_below_neutral": sum(a < b for a, b in zip(f, neutral)),
            "f_over_neutral": mean(a / b for a, b in zip(f, neutral)),
            "hat_first": hat[0], "hat_least": min(hat), "hat_last": mean(hat[-last:])}


def pushes(_, part):
    """Forces on the large grains inside, in thousandths of their weight, positive upward."""
    names = "push", "push_kinetic", "drag"
    layers = profiles.Layers([part.runs[0].path("balance")], begin=part.begin, end=part.end, present=names)
    use = layers.inside()[layers.layer]
    weight = -layers.rows["gravity_L_y"][use].sum()
    if not weight:
        raise ValueError("no large grains")
    return {name: 1000 * layers.rows[name][use].sum() / weight for name in names}


def collected(options, label, parts, measure):
    """A row for each number of measure(options, part): its mean over the parts, with its interval."""
    found, runs = [], set()
    for part in parts:
        try:
            found.append(measure(options, part))
            runs.update(run.name for run in part.runs)
        except (ValueError, RuntimeError) as trouble:
            print(f"numbers: {label}: {trouble}", file=sys.stderr)
    lines = []
    for name in found[0] if found else []:
        value, half = tables.mean_and_half_width([each[name] for each in found])
        lines.append({"of": label, "name": name, "value": value, "low": value - half, "high": value + half,
                      "error": half / tables.student(max(1, len(found) - 1)), "runs": len(runs)})
    return lines


def numbers(options):
    """Writes the numbers of the paper's figures, other than fits: one row per number, with its 95 % interval.

    Each number is measured in every seed separately (of one flow, or of the six mixtures together). value, low, high and
    error are the mean, its interval by Student's t over seeds, and its standard error. If there are fewer than three seeds,
    numbers that need only part of a run (profiles, forces) are measured in each quarter of the time (QUARTERS), and the
    interval is over these; other numbers have no interval (nan). Profiles are means over the last third of the time. `inside`
    means heights from 4 to 56 d_S.
    """
    every = tables.runs_in(options.tables)
    runs = [run for run in every if not run.variant]
    mixtures = [run for run in runs if run.slope == 23]
    seeds = sorted({run.seed for run in mixtures})
    together = [[run for run in mixtures if run.seed == seed] for seed in seeds]
    whole = max(map(len, together), default=0)
    together = [Part(group) for group in together if len(group) == whole]
    flow = lambda name: [run for run in runs if run.flow == name]
    each = lambda name: [Part([run]) for run in flow(name)]
    steady = flow("phi0.30-s23")
    late = profiles.last_third(steady[0].path("stress")) if steady else 0
    lines = collected(options, "phi0.30-s23", parts_of(steady, late), pressures)
    lines += collected(options, "mixtures", together, mixed_share)
    lines += collected(options, "mixtures", together, estimates)
    lines += collected(options, "mixtures", together, differences)
    lines += collected(options, "mixtures", together, lambda _, part: rise.trends(layers_of(part)))
    for name in sorted({run.flow for run in mixtures}):
        lines += collected(options, name, each(name), early_less_late)
        lines += collected(options, name, each(name), lambda _, part: rise.mixture(layers_of(part)[0][1]))
    for name in sorted({run.flow for run in every if run.flow.startswith("phi0.30-s23")}):
        lines += collected(options, name, [Part([run]) for run in every if run.flow == name], separation)
    for name in sorted({run.flow for run in every if not run.variant or run.flow.startswith("phi0.30-s23")}):
        lines += collected(options, name, [Part([run]) for run in every if run.flow == name], trapped)
    lines += collected(options, "phi0.45-s23", each("phi0.45-s23"), over_time)
    for name in sorted({run.flow for run in runs}):
        lines += collected(options, name, parts_of(flow(name)), pushes)
    tables.write(options.output, "numbers", ["of", "name", "value", "low", "high", "error", "runs"], lines)
