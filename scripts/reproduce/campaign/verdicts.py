"""The one rule by which measured numbers meet a statement of the paper.

A statement is met by our choices if the whole 95 % interval lies in its range, not met if it lies wholly outside,
and undecided if it crosses an edge or does not exist. A statement that our choices do not meet may be met by the choices that meet
most of the paper's numbers (combined.py). Several points (a line, "always") are judged by the worst.
The difference from the paper's value in standard errors is a stricter measure, because it allows no room for choices
that the paper leaves open.
"""
import math

AGREES, LIKELY, UNDECIDED, DIFFERS, NOT_YET = "met", "met by the likely choices", "undecided", "**not met**", "not measured yet"
FROM_BEST_TO_WORST = (AGREES, LIKELY, UNDECIDED, DIFFERS, NOT_YET)


def verdict(value, statement):
    if math.isnan(value.value):
        return NOT_YET
    if not value.has_interval():
        return UNDECIDED
    if statement.low <= value.low and value.high <= statement.high:
        return AGREES
    if value.high < statement.low or value.low > statement.high:
        return DIFFERS
    return UNDECIDED


def reference(statement):
    """The number from which the difference is taken: the paper's value, or the edge of a claim that has only one."""
    if not math.isnan(statement.value):
        return statement.value
    edges = [edge for edge in (statement.low, statement.high) if math.isfinite(edge)]
    return edges[0] if len(edges) == 1 else math.nan


def difference(value, statement):
    """(ours - paper)/sqrt(s^2 + s_paper^2); nan where there is no number to take it from, or no error."""
    error = math.hypot(value.error, statement.error)
    return (value.value - reference(statement)) / error if error > 0 else math.nan


def margin(value, statement):
    """Distance of the interval's ends from the edges of the range, the smaller one; negative outside."""
    return min(value.low - statement.low, statement.high - value.high)


def worst(points):
    """The pair (value, statement) that decides on several of them; None if there is none."""
    rank = lambda point: (FROM_BEST_TO_WORST.index(verdict(*point)),
                          -margin(*point) if point[0].has_interval() else -math.inf)
    return max(points, key=rank, default=None)
