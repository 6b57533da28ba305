"""Statements of Staron & Phillips (2015), and the range of values in which each statement counts as met.

A range is the paper's value +- a tolerance, or one-sided for a claim ("more than 10 times"). The tolerance comes from the
paper: its printed error, its digits, or definitions that it does not give; `source` says which. It is not an error of
measurement. The ranges were fixed before the runs that are judged by them. verdicts.py has the rule by which a measured
number meets a range.
"""
import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Statement:
    """A statement. `value` is nan if the paper states no number; `error` is the standard error of the paper's value."""
    text: str
    low: float
    high: float
    source: str
    value: float = math.nan
    error: float = 0

    def range_text(self, plain):
        """The range in words; plain(number) formats a number."""
        if math.isinf(self.high):
            return f"> {plain(self.low)}"
        if math.isinf(self.low):
            return f"< {plain(self.high)}"
        return f"{plain(self.low)} to {plain(self.high)}"


def number(text, value, tolerance, source, error=None, unit=None):
    """Statement of a printed number. Its standard error is `error` or, if None, that of rounding to multiples of `unit`."""
    if error is None:
        error = unit / math.sqrt(12) if unit else 0
    return Statement(text, value - tolerance, value + tolerance, source, value, error)


def above(text, edge, source):
    return Statement(text, edge, math.inf, source)


def below(text, edge, source):
    return Statement(text, -math.inf, edge, source)


FIT_ERROR = 0.003  # printed error of the slope s = 0.9660; also that of B, as dB/ds = -1 to 4 %
OPEN_B = "open in the paper: fit (0.02), layer of a contact (0.01)"
OPEN_RULES = "open in the paper: fit, layer of a contact; its values have one or two digits"
OPEN_P_KAPPA = ("open in the paper: mean velocity, V, e, step, together a factor of 2; its smaller side is taken on "
                "both")
OPEN_B_KAPPA = "open in the paper: which mean over φ (0.31 to 0.44 in size), mean velocity"
OPEN_PI = "open in the paper: step, averages; up to twice the printed error"
ORDER = "the claim, for the window in which the ratio is least"

FIGURE_1_END = above(
    "\"segregation occurred\"", 0.8, "no number in the paper; four fifths of the way from one order of separated species to the other")
FIGURE_1_MIXED = below(
    "\"segregation occurred\"", 0.2, "no number in the paper; the same four fifths, from mixed (1) to separated (0)")
FIGURE_2A = number("ρ g cosθ, cos 23° = 0.9205", 0.9205, 0.046, "5 %: the line is that of σ_yy, and σ_xx/σ_yy is not given")
SLOPE = number("0.9660 ± 0.003", 0.9660, 0.035, "0.93 to 1.00: that of B, as dB/ds is −1", error=FIT_ERROR)
B = number("0.034 to 0.035", 0.0345, 0.03, OPEN_B, error=FIT_ERROR)
SIGN = above("\"supports\" segregation by gravity", 0, "the claim, for the mixture in which B is least certain")
CONTROL = number("0 by symmetry", 0, 0.005, "a seventh of the paper's B")
MIXED_MOST = number("\"can reach locally 50 %\"", 0.5, 0.04, "a figure without numbers: 8 % of its maximum", unit=0.01)
MIXED_MOST_AT = Statement("neutral 2/3", 0.55, 0.72, "a flat maximum: neutral contacts stay within 0.03 of it")
MIXED_CURVE = number("neutral 4 φ_L φ_S/(1 + φ_S)²", 0, 0.04, "a figure without numbers: 8 % of its maximum")
B_PRESSURE = number("0.045 to 0.047", 0.046, 0.03, OPEN_B, error=FIT_ERROR)
PRESSURE_LESS_YY = number("0.011", 0.011, 0.015, "half of the room of B: same fit, same layers", error=FIT_ERROR)
RULES = {
    "uniform:0.8": number("≈ 0.33", 0.33, 0.05, OPEN_RULES, unit=0.01),
    "uniform:0.6": number("≈ −0.1", -0.1, 0.05, OPEN_RULES, unit=0.1),
    "half": number("≈ −0.32", -0.32, 0.05, OPEN_RULES, unit=0.01),
}
RULES_LESS_SIZE = {
    rule: number(f"{text}", value, 0.05, OPEN_RULES, error=math.hypot(FIT_ERROR, RULES[rule].error))
    for rule, text, value in (("uniform:0.8", "0.295", 0.295), ("uniform:0.6", "−0.135", -0.135), ("half", "−0.355", -0.355))
}
TREND = number("\"no influence\"", 0, 0.008, "B within 0.02 of its mean over slopes of ± 2.5°")
STAGES = number("\"no visible influence\"", 0, 0.012,
                "twice the error of a difference between fits of half the points each, 0.003 √2 √2")
P_KAPPA = number("0.98", 0.98, 0.49, OPEN_P_KAPPA, unit=0.01)
P_KAPPA_DECAY = number("14.8 d_L", 14.8, 4.8,
                       "10 to 25: Bagnold's profile is not an exponential; its smaller side is taken on both", unit=0.1)
KINETIC_PREFACTOR = number("1.4413 ± 0.0022", 1.4413, 0.10, "open in the paper: e, step, base", error=0.0022)
KINETIC_EXPONENT = number("1.0057", 1.0057, 0.02, "open in the paper: fit", unit=0.0001)
# B_kappa = half the sum of 1 - s and (1 - s)/s, and dB_kappa/ds = -0.74 at s = 1.4413.
B_KAPPA = number("−0.373", -0.373, 0.04, OPEN_B_KAPPA, error=0.74 * 0.0022)
B_KAPPA_OVER_B = above("\"more than 10 times larger\" (0.373/0.0345 = 10.8)", 10, "the claim")
KINETIC_OVER_CONTACT = Statement("\"about four orders of magnitude smaller\"", 10 ** -4.5, 10 ** -3.5, "a factor of ten about 1e-4")
FIGURE_4_RISES = above("\"monotonous increase\"; 0.205", 0, "the claim, for the line through the six slopes")
FIGURE_5 = {
    "": (number("2.2", 2.2, 2.2, OPEN_PI, unit=0.1), number("3", 3, 3, OPEN_PI, unit=1)),
    "_L": (number("1.9", 1.9, 1.9, OPEN_PI, unit=0.1), number("5", 5, 5, OPEN_PI, unit=1)),
    "_S": (number("6.4", 6.4, 6.4, OPEN_PI, unit=0.1), below("\"less than 9 %\"", 9, "the claim")),
}
START = Statement("large below: 0.225", 0.22, 0.24, "geometry and packing")
END = Statement("separated: 0.775", 0.65, 0.76, "77 to 97 % of the way")
Z_ORDER = above("z_L > z_S always", 1, ORDER)
Z_MOST = above("\"maximum when the mixing is maximum\"", 1, "the claim: largest ratio over that of the first and of the last windows")
F_ORDER = above("f_L > f_S, also \"as segregation proceeds\"", 1, ORDER)
F_DEPTH_ORDER = above("\"significantly larger\"", 1, ORDER)


def figure_4(rate):
    """Statement of -B_kappa at the shear rate x = `rate`, in units of sqrt(g/d_S): the paper's line, with the tolerance of B_kappa."""
    value = 0.310 + 0.205 * rate
    return number("0.310 + 0.205 x", value, 0.04, OPEN_B_KAPPA, unit=0.001)
