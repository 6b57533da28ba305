"""Measured values by name, from the tables of fits, flows and numbers; and numbers as text."""
import math
import os

import combined
import tables


class Value:
    """A number with its 95 % interval and standard error; low, high and error are nan if unknown."""

    def __init__(self, value, low=math.nan, high=math.nan, error=math.nan):
        self.value, self.low, self.high, self.error = value, low, high, error

    def __neg__(self):
        return Value(-self.value, -self.high, -self.low, self.error)

    def minus(self, number):
        return Value(self.value - number, self.low - number, self.high - number, self.error)

    def has_interval(self):
        return not math.isnan(self.low + self.high)

    def text(self, digits):
        if math.isnan(self.value):
            return "none"
        if not self.has_interval():
            return plain(self.value, digits)
        return f"{plain(self.value, digits)} [{plain(self.low, digits)}, {plain(self.high, digits)}]"


def plain(value, digits):
    if math.isnan(value):
        return "none"
    text = f"{value:.{digits}f}"
    if not float(text):
        text = text.lstrip("-")
    return text.replace("-", "−")


def of_student(value, low, high, freedom):
    """A Value whose interval was made by Student's t with `freedom` degrees of freedom; nan means a normal distribution."""
    return Value(value, low, high, (high - low) / 2 / tables.student(1e9 if math.isnan(freedom) else freedom))


class Measured:
    """All numbers that the document quotes, read from the tables in `folder`."""

    def __init__(self, folder):
        self.folder = folder
        at = lambda name: tables.read(os.path.join(folder, name + ".tsv"))
        self.fits, self.flows, numbers = at("fits")[1], at("flows")[1], at("numbers")[1]
        self.scan, _ = at("scan")
        self.choices = at("choices")[1]
        path = os.path.join(folder, "combinations.tsv")
        self.combinations = combined.read(path) if os.path.exists(path) else []
        self.likely = combined.meeting_most(self.combinations) if self.combinations else None
        self._numbers = {(row["of"], row["name"]): row for row in numbers}

    def number(self, of, name):
        row = self._numbers.get((of, name))
        return Value(row["value"], row["low"], row["high"], row["error"]) if row else Value(math.nan)

    def row(self, which, rule="size", component="yy", heights="inside", stage="all",
            quantity="contact"):
        """Row of the table of fits; None if there is no such fit."""
        if quantity == "kinetic":
            rule = "kinetic"
        for row in self.fits:
            if (row["set"], row["rule"], row["component"], row["heights"], row["stage"],
                    row["quantity"]) == (which, rule, component, heights, stage, quantity):
                return row
        return None

    def fit(self, which, name="B", **how):
        row = self.row(which, **how)
        if row is None:
            return Value(math.nan)
        return of_student(row[name], row.get(f"{name}_low", math.nan), row.get(f"{name}_high", math.nan), row["degrees_of_freedom"])

    def of_slope(self, which, of, **how):
        """of(s), a function that decreases with the slope s of the paper's fit, with its interval."""
        s = self.fit(which, "paper_s", **how)
        return Value(*(math.nan if math.isnan(end) else of(end) for end in (s.value, s.high, s.low)))

    def flow(self, name):
        return next((row for row in self.flows if row["flow"] == name), None)

    def of_scan(self, name):
        """A number from the header of the table of B(p), with its interval."""
        return Value(*(float(self.scan.get(name + end, "nan")) for end in ("", "_low", "_high")))

    def of_flow(self, name, quantity):
        row = self.flow(name)
        if row is None:
            return Value(math.nan)
        value, half = row[quantity], row.get(f"hw_{quantity}", math.nan)
        return of_student(value, value - half, value + half, max(1, row["seeds"] - 1))

    def flows_with(self, name):
        """Names of the flows, or sets of flows, that have a number of this name, sorted."""
        return sorted(of for of, other in self._numbers if other == name)

    def plain_flows(self):
        return [row for row in self.flows if row["variant"] == "none"]

    def mixtures(self):
        """Rows of the flows at 23 degrees that have a B, in order of phi_L."""
        return [row for row in self.plain_flows() if row["slope"] == 23 and not math.isnan(row["B"])]

    def range_over_mixtures(self, digits):
        found = [row["B"] for row in self.mixtures()] or [math.nan]
        return f"{plain(min(found), digits)} to {plain(max(found), digits)}"


def line_fit(x, y):
    """Slope, and level at x = 0, of the least-squares line, with 95 % intervals from its residuals."""
    if len(x) < 3:
        return Value(math.nan), Value(math.nan)
    level, slope, (of_level, _, of_slope), left = tables.line(x, y)
    t = tables.student(len(x) - 2)
    dl, ds = (t * math.sqrt(left / (len(x) - 2) * of) for of in (of_level, of_slope))
    return Value(slope, slope - ds, slope + ds, ds / t), Value(level, level - dl, level + dl, dl / t)
