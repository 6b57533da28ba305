"""The coefficients c and d of Gray & Thornton's closure: from fluxes, and c from large grains of another density."""
import math
import re
import sys

import tables

NAMES = {"B_over_c": "B_over_c[s]", "d_over_c": "d_over_c[m^2/s]", "p_star": "p_zero", "dc_dp": "dc_dp[1/s]",
         "c_size": "c@size[1/s]", "c_half": "c@half[1/s]", "d_size": "d@size[m^2/s^2]", "error_factor": "error_factor"}


def closure(options, runs):
    """Value and interval of every number in NAMES, from grseg-closure."""
    paths = [run.path(table) for run in runs for table in ("segregation", "stress")]
    _, rows = tables.program(options, "grseg-closure", *paths, "--heights", options.heights, "--begin", options.begin,
                             *(["--end", options.end] if options.end else []), "--partition", "size,half", "--quiet")
    by_name = {row["quantity"]: row for row in rows}
    return {name + end: float(by_name[quantity][of]) for name, quantity in NAMES.items()
            for end, of in zip(tables.ENDS, ("value", "low", "high"))}


def closures(options):
    """Writes c and d of Gray & Thornton's closure for each mixture, from the flux of large grains, with c under two rules.

    There is a row per flow; the default is all mixtures at 23 degrees with e = 0.25, for which `make questions` stores the flux
    by layer. grseg-closure uses layers from 12 to 56 d_S, because the gradient in lower layers includes the trapped row of large
    grains; times from 10 s on, when the flow is developed; and all seeds together. Intervals are 95 %.
        B_over_c [s], d_over_c [m^2/s]   coefficients of the flux, the same for every rule
        p_star, dc_dp [1/s]              c(p) = dc_dp (p - p_star)
        c_size, c_half [1/s]             c under two rules
    """
    flows = tables.flows_in(options, lambda run: re.fullmatch(r"phi[\d.]+-s23-e0\.25", run.flow))
    rows = [{"flow": flow, "phi": runs[0].phi, "runs": len(runs), **closure(options, runs)} for flow, runs in flows.items()]
    tables.write(options.output, "closures", list(rows[0]), rows)


def points_of(options):
    """For every run: D, the factor of X, p_zero and dc/dp; see denser()."""
    for run in tables.runs_in(options.tables):
        if found := re.fullmatch(re.escape(options.flow) + r"-density([\d.]+)-t\d+", run.flow):
            excess, of_run = float(found[1]) - 1, closure(options, [run])
            yield {"D": excess, "phi": run.phi, "value": (1 + run.phi * excess) * of_run["B_over_c"], "p_zero": of_run["p_star"], "dc_dp": of_run["dc_dp"]}


def row(of, runs, value, half):
    return {"of": of, "runs": runs, "value": value, "value_low": value - half, "value_high": value + half}


class Line:
    """The least-squares line through the points over D, and the scatter of runs about it."""

    def __init__(self, points):
        self.level, self.slope, self.covariance, left = tables.line(*([point[name] for point in points] for name in ("D", "value")))
        self.student, self.deviation = tables.student(len(points) - 2), math.sqrt(left / (len(points) - 2))

    def reach(self, a, b):
        """Half the width of the interval of a * level + b * slope."""
        v00, v01, v11 = self.covariance
        return self.student * self.deviation * math.sqrt(a * a * v00 + 2 * a * b * v01 + b * b * v11)


def ratios(points):
    """Yields a row for each density ratio."""
    line = Line(points)
    for excess in sorted({point["D"] for point in points}):
        alike = [point["value"] for point in points if point["D"] == excess]
        yield row(f"D = {excess:g}", len(alike), sum(alike) / len(alike), line.student * line.deviation / math.sqrt(len(alike)))


def conclusions(points):
    line, n, phi = Line(points), len(points), points[0]["phi"]
    level, slope = line.level, line.slope
    c = 1 / (phi * level - slope)
    plain = [point for point in points if point["D"] == 0]
    p_zero, dc_dp = (sum(point[name] for point in plain) / len(plain) for name in ("p_zero", "dc_dp"))
    yield row("slope", n, slope, line.reach(0, 1))
    yield row("at_zero", n, level, line.reach(1, 0))
    yield row("c", n, c, line.reach(-phi * c * c, c * c))
    yield row("B", n, c * level, line.reach(c - level * phi * c * c, level * c * c))
    yield row("stops", n, 1 - level / slope, line.reach(-1 / slope, level / slope**2))
    yield row("share", n, p_zero + c / dc_dp, line.reach(-phi * c * c, c * c) / dc_dp)


def denser(options):
    """Writes c of Gray & Thornton's closure, measured with large grains that are denser or lighter than the small ones.

    In a flow without other forces the motion determines only B/c and d/c. An additional weight of the large grains enters their
    balance besides B. With f^L = phi_L (1 + B phi_S), a density rho_L = (1 + D) rho_S, and a drag per volume of large grains,
    rho_S c (w_L - w_S) phi_S, that does not depend on their density, the balance of the large grains minus phi_L times the
    balance of the mixture is

        c q = (B (1 + phi_L D) - D) X - d G,    q = phi_L phi_S (w_L - w_S),  X = phi_L phi_S g cos(slope),  G = dphi_L/dy.

    The factor of X in the flux is a line over D. Its level is a = B/c and its slope s = -(1 - B phi_L)/c, so that c = 1/(phi_L a
    - s) and B = a c. No partition rule is needed. The flux of grseg-segregation is relative to the mean velocity weighted with
    mass, and equals q/(1 + phi_L D); the mean Phi_L is used in place of phi_L.

    Rows: one per density ratio (flows FLOW-densityR-t60), the mean over runs of the factor (1 + Phi_L D) x B_over_c, with
    B_over_c as in `closures`, run by run. Then follow numbers of the least-squares line through all runs over D: slope, at_zero
    (B/c), c [1/s], B, stops (density ratio 1 - a/s at which segregation stops), and share (the p at which contacts give this c:
    p_zero + c/dc_dp of the runs with D = 0). Intervals are 95 %, by Student's t with the scatter of all runs about the line.
    """
    points = list(points_of(options))
    if len({point["D"] for point in points}) < 3 or all(point["D"] != 0 for point in points):
        sys.exit(f"denser: {options.tables}: {len(points)} runs of {options.flow} have finished; at least three density ratios are needed, "
                 "one of them 1")
    tables.write(options.output, "denser", ["of", "runs", "value", "value_low", "value_high"], [*ratios(points), *conclusions(points)])
