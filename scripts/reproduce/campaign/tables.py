"""Runs of the campaign, and results of grseg's programs for them."""
import glob
import math
import os
import re
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
import shared  # noqa: E402
from shared import mean_and_half_width, parse, read, student, table, write  # noqa: E402, F401

# Name of a run: phi0.30-s23-seed1, phi0.45-s23-e0.5-seed2. Its tables are NAME/QUANTITY.tsv.
NAME = re.compile(r"phi(?P<phi>[\d.]+)-s(?P<slope>[\d.]+)(?:-(?P<variant>.+?))?-seed(?P<seed>\d+)$")
CONTROL = "ratio1"  # the variant with equal grains
EARLY, LATE = 60, 100  # end of the early stage and begin of the late stage, s
INSIDE = (4, 56)  # heights between which layers are used ("inside"), d_S
WHERE = ["--heights", "4dS:56dS", "--quiet"]
ENDS = ("", "_low", "_high")


def welch(*estimates):
    """Standard error and degrees of freedom of a sum or difference of independent numbers with these pairs (standard error,
    degrees of freedom)."""
    variance = sum(error**2 for error, _ in estimates)
    if not variance > 0:
        return math.sqrt(variance), 1e9
    return math.sqrt(variance), variance**2 / sum(error**4 / freedom for error, freedom in estimates)


def line(x, y, weights=None):
    """The least-squares line: level at x = 0; slope; the variance of the level, the covariance of both, and the variance of
    the slope, over the variance of y at weight 1; and the weighted sum of squared residuals."""
    x, y, w = np.array(x), np.array(y), np.array(weights or [1.0] * len(x))
    total, mx, my = w.sum(), np.average(x, weights=w), np.average(y, weights=w)
    sxx = w @ (x - mx) ** 2
    slope = w * (x - mx) @ (y - my) / sxx
    level = my - slope * mx
    left = w @ (y - level - slope * x) ** 2
    return level, slope, (1 / total + mx**2 / sxx, -mx / sxx, 1 / sxx), left


def part_within(rise_of_phi, rise_of_stress, layers, stress):
    """What gradients inside a layer add to psi_L - phi_L (Thickness of analysis/fit/fit_data.hpp), from the differences of phi_L
    and of the stress across `layers` layers."""
    return rise_of_phi * rise_of_stress / (12 * layers**2 * stress)


class Run:
    def __init__(self, folder, name, match):
        self.folder, self.name = folder, name
        self.flow = name[:name.rindex("-seed")]
        self.phi, self.slope = float(match["phi"]), float(match["slope"])
        self.variant, self.seed = match["variant"] or "", int(match["seed"])

    def path(self, quantity):
        return os.path.join(self.folder, self.name, f"{quantity}.tsv")

    def has(self, quantity):
        return os.path.exists(self.path(quantity))

    def record(self):
        """Parameters of the run by name, from record.tsv."""
        return {row["name"]: row["value"] for row in read(self.path("record"))[1]}


def runs_in(folder):
    """All finished Runs in a folder, in order of mixture, slope, variant and seed."""
    found = []
    for path in glob.glob(os.path.join(glob.escape(folder), "*", "checksums")):
        name = os.path.basename(os.path.dirname(path))
        match = NAME.match(name)
        if match:
            found.append(Run(folder, name, match))
    if not found:
        sys.exit(f"{folder}: no finished run, such as phi0.30-s23-seed1/checksums; "
                 "name the folder that make reproduce filled")
    return sorted(found, key=lambda run: (run.phi, run.slope, run.variant, run.seed))


def by_flow(runs):
    flows = {}
    for run in runs:
        flows.setdefault(run.flow, []).append(run)
    return flows


def flows_in(options, otherwise=lambda run: True):
    """Runs by flow: the flows of --flows or, without it, all runs for which `otherwise` is true."""
    wanted = options.flows.split(",") if options.flows else None
    flows = by_flow(run for run in runs_in(options.tables) if (run.flow in wanted if wanted else otherwise(run)))
    if not flows:
        sys.exit(f"{options.command}: {options.tables}: none of {options.flows or 'these flows'} has finished")
    return flows


def sizes_of(runs):
    """The option --flows of grseg-fit: the number of runs of each flow."""
    return ["--flows", ",".join(str(len(of_flow)) for of_flow in by_flow(runs).values())]


def of_bed(run):
    """Header of the table of grseg-segregation, its rows of the whole bed, and the mean shear rate from 10 s on in units of sqrt(g/d_S)."""
    header, rows = read(run.path("segregation"))
    bed = [row for row in rows if math.isnan(row["y0"])]
    d, g = float(header["small_diameter"]), math.hypot(float(header["gravity_x"]), float(header["gravity_y"]))
    # Windows of the spin-up are excluded unless there are no others.
    flowing = [row for row in bed if row["t0"] >= 10] or bed
    rate = sum(row["frames"] * row["shear_rate"] for row in flowing) / sum(row["frames"] for row in flowing)
    return header, bed, rate * math.sqrt(d / g)


def program(options, name, *words):
    """The table that a program of grseg prints, as shared.parse() returns it."""
    return parse(shared.tool(options.bin, name, *words), name)


def fits(options, *words):
    """Numbers of grseg-fit --fit paper: one dictionary per rule and flow."""
    return shared.by_rule(program(options, "grseg-fit", *words, "--fit", "paper")[1])


def fits_if_any(options, label, *words):
    """Numbers of grseg-fit; if it fails, prints its message on standard error and returns []."""
    try:
        return fits(options, *words)
    except RuntimeError as trouble:
        print(f"{label}: {trouble}", file=sys.stderr)
        return []
