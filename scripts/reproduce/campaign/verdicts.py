"""The rule by which measured numbers meet a statement of the paper.

A statement is met by our choices if the whole 95 % interval lies in the statement's range. It is not met if the interval lies
wholly outside, and undecided if the interval crosses an edge or does not exist. If our choices do not meet a statement, the
choices that meet most of the paper's numbers may meet it (combined.py). Several points (a line, "always") are judged by the
worst point. The difference from the paper's value in standard errors is a stricter measure, because it has no tolerance for
choices that the paper does not state.
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
    """The number from which the difference is taken: the paper's value, or the edge of a claim with only one edge."""
    if not math.isnan(statement.value):
        return statement.value
    edges = [edge for edge in (statement.low, statement.high) if math.isfinite(edge)]
    return edges[0] if len(edges) == 1 else math.nan


def difference(value, statement):
    """(ours - paper)/sqrt(s^2 + s_paper^2); nan if there is no reference() or no error."""
    error = math.hypot(value.error, statement.error)
    return (value.value - reference(statement)) / error if error > 0 else math.nan


def margin(value, statement):
    """The smaller distance of the interval's ends from the edges of the range; negative outside the range."""
    return min(value.low - statement.low, statement.high - value.high)


def worst(points):
    """The pair (value, statement) with the worst verdict; None if `points` is empty."""
    rank = lambda point: (FROM_BEST_TO_WORST.index(verdict(*point)),
                          -margin(*point) if point[0].has_interval() else -math.inf)
    return max(points, key=rank, default=None)
