"""Every number that the paper prints, under every combination of choices that it does not state."""
import collections
import functools
import itertools
import math
import os
import sys

import numpy as np

from combined import AXES, TARGETS, pull, read, report, write_figure
import tables
import grseg

LAYER, GRAVITY, DIAMETER = 4, 9.8, 0.005  # thickness of layers, d_S; gravity, m/s^2; d_S, m
LAYERS = {"4-56": range(1, 14), "0-56": range(14), "4-top": range(1, 40), "all": range(40)}
FRAMES = {"25": "stride1", "5": "stride5", "3": "stride8", "2": "stride12"}
FORMS = ("logarithms", "weighted", "least squares")
MEANS = {"profile": "", "layer": "layer-", "instant": "instant-", "others": "others-"}
VELOCITIES = {"after": "", "middle": "middle-"}
RESTITUTIONS = {"0.25": "", "0.5": "e0.5"}
VOLUMES, PERIODS = ("with voids", "of grains"), {"100-150": (100, 150), "40-90": (40, 90), "10-150": (10, 150)}


class Table:
    """Columns of a table by name, and the number of each row's layer."""

    def __init__(self, path):
        self.columns = grseg.read_table(path)
        self.layer = np.rint(self["y0"] / (LAYER * DIAMETER)).astype(int)

    def __getitem__(self, name):
        return self.columns[name]

    def content(self):
        """Areas (m^2) or masses (kg) of the two species; both are the same numbers, since the density is 1 kg/m^2."""
        kind = "area" if "area_S" in self.columns else "mass"
        return self[f"{kind}_S"], self[f"{kind}_L"]

    def solid(self):
        """True for rows of layers with at least half the median solid fraction, as in grseg-fit."""
        fraction = sum(self.content()) / self["V"]
        return fraction >= 0.5 * np.median(fraction)


def tensor(table, name, component):
    if component == "pressure":
        return (table[f"{name}_xx"] + table[f"{name}_yy"]) / 2
    return table[f"{name}_yy"]


def stresses(table, rule, component):
    """Stresses of the small and of the large grains, times the volume. rule: the large grain's share or "size"; None: kinetic."""
    part = lambda name: tensor(table, name, component)
    if rule is None:
        return part("K_S"), part("K_L")
    share = part("Msize") if rule == "size" else rule * part("M")
    return part("A_SS") + part("M") - share + part("A_Sb"), part("A_LL") + share + part("A_Lb")


def points(of_runs, layers, rule=None, component="yy"):
    """x = phi_S/phi_L, y = sigma^S/sigma^L and weights of all windows and layers of all runs."""
    x, y, weights = [], [], []
    for table in of_runs:
        small, large = table.content()
        y_small, y_large = stresses(table, rule, component)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio, of_stress = small / large, y_small / y_large
        counts = np.isin(table.layer, list(layers)) & table.solid() & (ratio > 0.01) & (ratio < 100) & (of_stress > 0) & np.isfinite(of_stress)
        x.append(ratio[counts])
        y.append(of_stress[counts])
        weights.append((table["frames"] * np.minimum(small, large / 4))[counts])
    return tuple(map(np.concatenate, (x, y, weights)))


def proportional(x, y, weights, form):
    """The slope s of y = s x."""
    if form == "least squares":
        return x @ y / (x @ x)
    return math.exp(np.average(np.log(y / x), weights=weights if form == "weighted" else None))


def best_scale(shape, y, low, high):
    """Least-squares fit of y = a shape(b); returns a and b. a follows from b, and b is found between low and high by golden sections."""
    def scale(b):
        return shape(b) @ y / (shape(b) @ shape(b))

    def rest(b):
        return ((y - scale(b) * shape(b)) ** 2).sum()
    golden = (math.sqrt(5) - 1) / 2
    for _ in range(70):
        left, right = high - golden * (high - low), low + golden * (high - low)
        low, high = (low, right) if rest(left) < rest(right) else (left, high)
    return scale(low), low


def power(x, y, weights, form):
    """a and b of y = a x^b."""
    root = np.sqrt(weights) if form == "weighted" else np.ones_like(x)
    b, a = np.polyfit(np.log(x), np.log(y), 1, w=root)
    if form == "least squares":
        return best_scale(lambda b: x**b, y, 0, 3)
    return math.exp(a), b


def b_at_half(s):
    return 2 * (1 - s) / (1 + s)


def contact_numbers(of_runs, layers, form):
    at = lambda rule, component="yy": proportional(*points(of_runs, layers, rule, component), form)
    return {"slope": at("size"), "pressure": at("size", "pressure"), "B 0.8": b_at_half(at(0.8)), "B 0.6": b_at_half(at(0.6)), "B 0.5": b_at_half(at(0.5))}


def kinetic_numbers(of_runs, layers, form):
    return dict(zip(("prefactor", "exponent"), power(*points(of_runs, layers), form)))


def kinetic_profile(table, layers, form, volume, period):
    """P^kappa/(rho g d_S) = level exp(-z/(decay d_L)) of one flow."""
    counts = np.isin(table.layer, list(layers)) & table.solid() & (table["t0"] >= period[0]) & (table["t1"] <= period[1] + 1e-6)
    heights, pressure = [], []
    energy = sum(tensor(table, name, "pressure") for name in ("K_S", "K_L"))
    space = table["V"] if volume == "with voids" else sum(table.content())
    for n in sorted(set(table.layer[counts])):
        rows = counts & (table.layer == n)
        heights.append((n + 0.5) * LAYER / 2)  # height in d_L
        pressure.append(energy[rows].sum() / space[rows].sum() / (GRAVITY * DIAMETER))
    z, p = np.array(heights), np.array(pressure)
    if form == "least squares":
        level, decay = best_scale(lambda decay: np.exp(-z / decay), p, 1, 100)
    else:
        rate, level = np.polyfit(z, np.log(p), 1)
        level, decay = math.exp(level), -1 / rate
    return {"3a level": level, "3a decay": decay}


def shear_rate(table):
    """Mean shear rate between 4 and 56 d_S from 10 s on, in units of sqrt(g/d_S)."""
    counts = np.isin(table.layer, list(LAYERS["4-56"])) & (table["t0"] >= 10)
    return np.nanmean(table["du_dy"][counts]) / math.sqrt(GRAVITY / DIAMETER)


def over_shear_rate(of_slopes, layers, form):
    """Level and slope of the line of -B_kappa over the shear rate, with standard errors; B_kappa is half the sum of its end values."""
    x, y = [], []
    for table in of_slopes:
        s = proportional(*points([table], layers), form)
        x.append(shear_rate(table))
        y.append((s - 1) / 2 * (1 + 1 / s))
    (slope, level), covariance = np.polyfit(x, y, 1, cov=True)
    return {"4 level": (level, math.sqrt(covariance[1, 1])), "4 slope": (slope, math.sqrt(covariance[0, 0]))}


table_in = functools.cache(Table)


class Runs:
    """The tables of `make combinations`, each read once."""

    def __init__(self, folder):
        self.runs = tables.runs_in(folder)

    def tables(self, name, chosen):
        return [table_in(run.path(name)) for run in self.runs if chosen(run)]

    def seeds(self, variant):
        """Seeds for which all mixtures have finished."""
        found = collections.Counter(run.seed for run in self.runs if run.variant == variant and run.slope == 23)
        return sorted(seed for seed, mixtures in found.items() if mixtures == max(found.values()))

    def mixtures(self, name, variant, seed):
        return self.tables(name, lambda run: (run.variant, run.slope, run.seed) == (variant, 23, seed))

    def slopes(self, name, variant):
        return self.tables(name, lambda run: (run.variant, run.phi, run.seed) == (variant, 0.45, 1))

    def shown(self, name, variant, seed):
        return self.tables(name, lambda run: (run.variant, run.slope, run.phi, run.seed) == (variant, 23, 0.3, seed))[0]


def summary(of_seeds, scatter):
    """(Mean over seeds, standard error of one set of runs) for each name. If there are several seeds, stores their standard
    deviations in `scatter`; otherwise uses those in `scatter`."""
    found = {}
    for name in of_seeds[0]:
        values = [numbers[name] for numbers in of_seeds]
        n = len(values)
        if n > 1:
            scatter[name] = float(np.std(values, ddof=1))
        found[name] = float(np.mean(values)), scatter[name] * math.sqrt(1 + 1 / n)
    return found


def every_combination(runs):
    """Yields (choices by axis, {target: (value, standard error)}) for every combination."""
    for layers, frames, form in itertools.product(LAYERS, FRAMES, FORMS):
        stride, heights, scatter = FRAMES[frames], LAYERS[layers], {}
        contact = {}
        for restitution, variant in RESTITUTIONS.items():
            contact[restitution] = summary([contact_numbers(runs.mixtures(f"stress-{stride}", variant, seed), heights, form)
                                            for seed in runs.seeds(variant)], scatter)
        for mean, velocity in itertools.product(MEANS, VELOCITIES):
            if velocity == "middle" and mean not in ("profile", "layer"):
                continue
            name, scatter = f"kinetic-{MEANS[mean]}{VELOCITIES[velocity]}{stride}", {}
            for restitution, variant in RESTITUTIONS.items():
                numbers = dict(contact[restitution])
                numbers.update(summary([kinetic_numbers(runs.mixtures(name, variant, seed), heights, form) for seed in runs.seeds(variant)], scatter))
                numbers.update(best_profile(runs, name, variant, heights, form, scatter))
                numbers.update(over_shear_rate(runs.slopes(name, variant), heights, form))
                yield dict(zip(AXES, (layers, frames, form, mean, velocity, restitution))), numbers


def best_profile(runs, name, variant, layers, form, scatter):
    """Numbers of figure 3a, for the volume and the period that come nearest to the paper's numbers."""
    found = []
    for volume, (period, span) in itertools.product(VOLUMES, PERIODS.items()):
        of_seeds = [kinetic_profile(runs.shown(name, variant, seed), layers, form, volume, span) for seed in runs.seeds(variant)]
        own = scatter.setdefault((volume, period), {})
        found.append(summary(of_seeds, own))
    return min(found, key=lambda numbers: sum(pull(target, *numbers[target])**2 for target in numbers))


def rows(folder):
    for axes, numbers in every_combination(Runs(folder)):
        row = dict(axes)
        for target in TARGETS:
            row[target], row[f"{target} error"] = numbers[target]
        yield row


def combinations(options):
    """Computes the paper's printed numbers under every combination of the choices that it does not state.

    The paper states layers of 4 d_S, windows of 1.25 s, all stages of all six mixtures, 0.01 < phi_S/phi_L < 100, and the
    component yy. Choices that it does not state ("axes"):
        layers        heights of the layers that are used (d_S)
        frames        number of frames in a window
        form          fit of y over x: means of logarithms; the same, weighted by frames times grains of the rarer species; or
                      least squares of y itself
        mean          mean velocity about which fluctuations are taken: of the layer or of a fine profile, both over the window;
                      or of layer and frame
        velocity      after the time step of a frame, or in its middle
        restitution   0.25 as a coefficient of velocities, or of energy, which makes 0.5
        for the profile of figure 3a only: volume (with voids, or of grains) and period ("steady state", s)
    A target is met if our number differs from the paper's by at most 1.96 standard errors. They combine the paper's error
    (statements.py; the error of rounding if none is printed) and the error of one set of runs like the paper's: sqrt(1 + 1/n)
    times the standard deviation over n seeds, taken from restitution 0.25. A target is not met if 1.96 of the latter exceed the
    paper's tolerance (statements.py), since such a combination is no test of this target.
    SOURCE is the folder of runs of `make combinations`, whose numbers are written to FILE; or the table FILE, which is reported.
    """
    if os.path.isdir(options.source):
        if not options.output:
            sys.exit("combinations: name the table to write: -o FILE")
        found = list(rows(options.source))
        tables.write(options.output, "combinations", list(found[0]), found)
        return
    found = read(options.source)
    if options.figure:
        write_figure(found, options.figure)
    print("\n\n".join(report(found)))
