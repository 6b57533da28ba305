"""Finds, in the table of `combinations`, the choices that give the paper's numbers.

A row has one choice for each axis, and the value and standard error of every target. A target is a number that the paper prints.
"""
import itertools
import math

import statements as paper
import tables
from tables import shared

SIGMAS = 1.96
# Mean velocities about which the paper's authors may have taken fluctuations. `others`, the profile without its bias, is not
# among them.
TRIED = ("profile", "layer", "instant")


def target(statement, value=None, error=None, room=None):
    """The paper's number, its standard error, and its tolerance: half the range in statements.py."""
    return (statement.value if value is None else value, statement.error if error is None else error,
            (statement.high - statement.low) / 2 if room is None else room)


# The paper prints no error of the exponent; the relative error of the prefactor is used. The slope of the pressure has the
# tolerance of its B, since dB/ds is -1. The slope of figure 4 has the tolerance of its line, 0.04, over half the range of x, 0.2.
TARGETS = {
    "slope": target(paper.SLOPE), "pressure": target(paper.B_PRESSURE, 0.955),
    **{f"B {rule}": target(paper.RULES[name], error=math.hypot(paper.FIT_ERROR, paper.RULES[name].error))
       for rule, name in (("0.8", "uniform:0.8"), ("0.6", "uniform:0.6"), ("0.5", "half"))},
    "prefactor": target(paper.KINETIC_PREFACTOR), "exponent": target(paper.KINETIC_EXPONENT, error=0.0022 / 1.4413),
    "3a level": target(paper.P_KAPPA), "3a decay": target(paper.P_KAPPA_DECAY),
    "4 level": target(paper.figure_4(0)), "4 slope": target(paper.figure_4(0), 0.205, room=0.2),
}
AXES = ("layers", "frames", "form", "mean", "velocity", "restitution")
# Choices of docs/studies/reproduction.md, with the mean velocity that has no bias.
OURS = ("4-56", "25", "weighted", "others", "after", "0.25")


def both(name, error):
    """The standard error of the difference between our number and the paper's."""
    return math.hypot(error, TARGETS[name][1])


def pull(name, value, error):
    """The difference from the paper's number, in standard errors."""
    return (value - TARGETS[name][0]) / both(name, error)


def meets(row, name):
    """True if the row agrees with the target within both errors, and 1.96 of our errors are within the paper's tolerance; a
    less certain number meets no target."""
    error = row[f"{name} error"]
    return abs(pull(name, row[name], error)) <= SIGMAS and SIGMAS * error <= TARGETS[name][2]


def text_of(row):
    return ", ".join(f"{axis} {row[axis]}" for axis in AXES)


def read(path):
    """Rows of the table of `combinations`, judged(); choices are text."""
    return [judged({name: f"{value:g}" if name in AXES and isinstance(value, float) else value for name, value in row.items()})
            for row in tables.read(path)[1]]


def judged(row):
    """The row with two more entries: number of targets that it meets, and logarithm of the likelihood for normal errors, up to
    a constant. The likelihood decreases with the width of the errors."""
    error = {name: row[f"{name} error"] for name in TARGETS}
    row["met"] = sum(meets(row, name) for name in TARGETS)
    row["log_likelihood"] = -sum(pull(name, row[name], error[name]) ** 2 / 2 + math.log(both(name, error[name]) / TARGETS[name][1]) for name in TARGETS)
    return row


def an_author_may_have_tried(found):
    return [row for row in found if row["mean"] in TRIED]


def meeting_most(found):
    """The row with the highest likelihood, of the rows that meet the most targets."""
    return max(an_author_may_have_tried(found), key=lambda row: (row["met"], row["log_likelihood"]))


def without_the_lowest_layer(found):
    """Rows of fits without the lowest layer. This layer has a trapped row of large grains in some runs only, which makes errors wide."""
    return [row for row in found if row["layers"].startswith("4-")]


def report(found):
    """Yields the paragraphs of the report on these rows."""
    tried, best = an_author_may_have_tried(found), meeting_most(found)
    above = meeting_most(without_the_lowest_layer(found))
    ours = next(row for row in found if tuple(row[axis] for axis in AXES) == OURS)

    def by_number(rows):
        return ", ".join(f"{k} by {sum(row['met'] == k for row in rows)}" for k in range(len(TARGETS), -1, -1) if any(row["met"] == k for row in rows))
    yield (f"Of {len(tried)} combinations, by the count of the {len(TARGETS)} numbers that they meet: {by_number(tried)}. "
           f"Of the {len(without_the_lowest_layer(tried))} without the lowest layer: {by_number(without_the_lowest_layer(tried))}.")
    columns = {"meets most": best, "meets most without the lowest layer": above, "our choices, mean of others": ours}
    if above is best:
        del columns["meets most without the lowest layer"]
    for title, row in columns.items():
        yield f"* *{title}*: {text_of(row)}; {row['met']:.0f} of {len(TARGETS)}."
    cell = lambda row, target: f"{row[target]:.4g} ± {row[target + ' error']:.2g} ({pull(target, row[target], row[target + ' error']):+.1f})" + ("" if meets(row, target) else " **no**")
    met_by = lambda rows, target: f"{sum(meets(row, target) for row in rows)}"
    yield shared.markdown(["number", "paper", *columns, "combinations that meet it", "... without the lowest layer"],
                   [[target, f"{number:g}", *(cell(row, target) for row in columns.values()), met_by(tried, target), met_by(without_the_lowest_layer(tried), target)]
                    for target, (number, _, _) in TARGETS.items()]).replace("-", "−").replace("−−−", "---")
    yield f"Never met together: {excluded(tried)}. Without the lowest layer: {excluded(without_the_lowest_layer(tried))}."


def excluded(rows):
    """Words on targets that no row meets, and on pairs of targets that rows meet, but never both at once."""
    met = {target: {k for k, row in enumerate(rows) if meets(row, target)} for target in TARGETS}
    pairs = [f"{a} and {b}" for a, b in itertools.combinations(TARGETS, 2) if met[a] and met[b] and not met[a] & met[b]]
    never = [f"{target} at all" for target in TARGETS if not met[target]]
    return "; ".join(never + pairs) or "none"


def write_figure(found, path):
    """Writes, for each choice and target, the share of the combinations with this choice that meet the target."""
    tried = an_author_may_have_tried(found)
    out = []
    for axis in AXES:
        for choice in dict.fromkeys(row[axis] for row in tried):
            with_it = [row for row in tried if row[axis] == choice]
            out.append({"axis": axis, "choice": str(choice).replace(" ", "_"),
                        **{target.replace(" ", "_"): sum(meets(row, target) for row in with_it) / len(with_it) for target in TARGETS}})
    tables.write(path, "combinations", list(out[0]), out)
