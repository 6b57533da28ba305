"""What the rows of `combinations` say: which choices make the paper's numbers.

A row has the choices by axis, and of every target the number, its standard error and its pull, the difference from the paper in
standard errors of both.
"""
import itertools
import math

import statements as paper
import tables

SIGMAS = 1.96
# Means that an author may have taken fluctuations from; `others` is the profile without its bias.
TRIED = ("profile", "layer", "instant")
ROUNDED = 1 / math.sqrt(12)
# Name: the paper's number and its standard error. Of the exponent none is printed: that of the prefactor, as a part of it.
TARGETS = {
    "slope": (0.9660, paper.FIT_ERROR), "pressure": (0.955, paper.FIT_ERROR),
    **{f"B {rule}": (paper.RULES[name].value, math.hypot(paper.FIT_ERROR, paper.RULES[name].error))
       for rule, name in (("0.8", "uniform:0.8"), ("0.6", "uniform:0.6"), ("0.5", "half"))},
    "prefactor": (1.4413, 0.0022), "exponent": (1.0057, 0.0022 / 1.4413),
    "3a level": (0.98, 0.01 * ROUNDED), "3a decay": (14.8, 0.1 * ROUNDED),
    "4 level": (0.310, 0.001 * ROUNDED), "4 slope": (0.205, 0.001 * ROUNDED),
}
AXES = ("layers", "frames", "form", "mean", "velocity", "restitution")
# Ours: of reproduction.md, with the mean that has no bias.
OURS = ("4-56", "25", "weighted", "others", "after", "0.25")


def pull(target, value, error):
    """The difference from the paper in standard errors."""
    number, of_paper = TARGETS[target]
    return (value - number) / math.hypot(error, of_paper)


def meets(row, target):
    return abs(row[f"{target} pull"]) <= SIGMAS


def markdown(heads, lines):
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [heads, ["---"] * len(heads), *lines])


def text_of(row):
    return ", ".join(f"{axis} {row[axis]}" for axis in AXES)


def read(path):
    """The rows of a table; choices are words."""
    return [{name: f"{value:g}" if name in AXES and isinstance(value, float) else value for name, value in row.items()} for row in tables.read(path)[1]]


def an_author_may_have_tried(found):
    return [row for row in found if row["mean"] in TRIED]


def meeting_most(found):
    """Of the rows that meet most targets the most likely."""
    return max(an_author_may_have_tried(found), key=lambda row: (row["met"], row["log_likelihood"]))


def report(found):
    """What the rows say."""
    tried, best = an_author_may_have_tried(found), meeting_most(found)
    most, likely = best["met"], max(tried, key=lambda row: row["log_likelihood"])
    ours = next(row for row in found if tuple(row[axis] for axis in AXES) == OURS)
    yield f"{len(tried)} combinations, {len(TARGETS)} numbers. Met by the best: {most:.0f}. By how many combinations: " + ", ".join(
        f"{k} by {sum(row['met'] == k for row in tried)}" for k in range(int(most), -1, -1)) + "."
    yield f"Meets most (of these the most likely): {text_of(best)}."
    yield f"Most likely: {text_of(likely)}; it meets {likely['met']:.0f}."
    cell = lambda row, target: f"{row[target]:.4g} ± {row[target + ' error']:.2g} ({row[target + ' pull']:+.1f})" + ("" if meets(row, target) else " **no**")
    yield markdown(["number", "paper", "meets most", "most likely", "without the bias of the mean, 4 to 56 d_S", "met by combinations"],
                   [[target, f"{number:g}", cell(best, target), cell(likely, target), cell(ours, target), f"{sum(meets(row, target) for row in tried)}"]
                    for target, (number, _) in TARGETS.items()])
    excluded = [f"{a} and {b}" for a, b in itertools.combinations(TARGETS, 2)
                if any(meets(row, a) for row in tried) and any(meets(row, b) for row in tried) and not any(meets(row, a) and meets(row, b) for row in tried)]
    yield "Never met together: " + ("; ".join(excluded) or "none") + "."


def write_figure(found, path):
    """For each choice and target the part of the combinations with that choice that meet it."""
    tried = an_author_may_have_tried(found)
    out = []
    for axis in AXES:
        for choice in dict.fromkeys(row[axis] for row in tried):
            with_it = [row for row in tried if row[axis] == choice]
            out.append({"axis": axis, "choice": str(choice).replace(" ", "_"),
                        **{target.replace(" ", "_"): sum(meets(row, target) for row in with_it) / len(with_it) for target in TARGETS}})
    tables.write(path, "combinations", list(out[0]), out)
