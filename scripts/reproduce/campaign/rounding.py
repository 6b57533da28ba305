"""How far rounded sums can have moved B."""
import math
import statistics
import sys

import tables

SUMS = ("A_SS_yy", "A_LL_yy", "M_yy", "Msize_yy", "A_Sb_yy", "A_Lb_yy")
AREAS = ("area_S", "area_L")
AREA_DIGITS = 3


def half_unit(value, digits):
    """Half a unit of the last of so many digits."""
    return 0.5 * 10.0 ** (math.floor(math.log10(abs(value))) - digits + 1) if value else 0.0


def points_of(header, rows, heights):
    """Rows that grseg-fit takes by default, with what is needed of them."""
    small, large = float(header["small_diameter"]), float(header["large_diameter"])
    low, high = heights or (4 * small, 56 * small)
    solid = [(row["area_S"] + row["area_L"]) / row["V"] for row in rows]
    median = statistics.median(value for value in solid if value > 0)
    tiny = 1e-9 * large
    for row, fraction in zip(rows, solid):
        if row["y0"] < low - tiny or row["y1"] > high + tiny or fraction < 0.5 * median:
            continue
        if row["area_S"] <= 0 or row["area_L"] <= 0 or not 0.01 <= row["area_S"] / row["area_L"] <= 100:
            continue
        yield row


def terms_of(row):
    """sigma^S and sigma^L times V, and the total."""
    on_large = row["A_LL_yy"] + row["Msize_yy"] + row["A_Lb_yy"]
    total = sum(row[name] for name in SUMS if name != "Msize_yy")
    return total - on_large, on_large, total


def derivatives_of_sums(row, b):
    """Of psi_L - phi_L - B phi_L phi_S."""
    _, on_large, total = terms_of(row)
    psi, area = on_large / total, row["area_S"] + row["area_L"]
    phi = row["area_L"] / area
    of_phi = -1 - b * (1 - 2 * phi)
    return {"A_SS_yy": -psi / total, "M_yy": -psi / total, "A_Sb_yy": -psi / total,
            "A_LL_yy": (1 - psi) / total, "A_Lb_yy": (1 - psi) / total, "Msize_yy": 1 / total,
            "area_S": -of_phi * phi / area, "area_L": of_phi * (1 - phi) / area}


def bounds(weighted_slopes, digits):
    """Worst case and rms of a sum over rows of (row, weight, derivatives)."""
    worst = squares = 0
    for row, weight, slopes in weighted_slopes:
        for name, slope in slopes.items():
            error = weight * slope * half_unit(row[name], AREA_DIGITS if name in AREAS else digits)
            worst += abs(error)
            squares += error ** 2 / 3
    return worst, math.sqrt(squares)


def effect(rows, digits):
    """B, with its bounds."""
    def product(row):
        return row["area_L"] * row["area_S"] / (row["area_L"] + row["area_S"]) ** 2

    def excess(row):
        _, on_large, total = terms_of(row)
        return on_large / total - row["area_L"] / (row["area_L"] + row["area_S"])

    used = [row for row in rows if terms_of(row)[2] > 0]
    below = sum(row["frames"] * product(row) for row in used)
    b = sum(row["frames"] * excess(row) for row in used) / below
    worst, rms = bounds(((row, row["frames"] / below, derivatives_of_sums(row, b)) for row in used), digits)
    return {"B": b, "worst": worst, "rms": rms}


def of_tables(paths, digits=None, heights=None):
    """The effect on all tables together; `digits` of those that do not say how many they keep."""
    points = []
    for path in paths:
        header, rows = tables.read(path)
        if "kept" in header:
            digits = int(header["kept"].split()[0])
        points += points_of(header, rows, heights)
    if digits is None:
        sys.exit("rounding: no table says '# kept: N digits'; these are not rounded")
    return effect(points, digits)


def rounding(options):
    """How far rounding the sums of contacts can have moved B: bounds from the digits that tables hold.

    Every number v of a table with "# kept: N digits" is known to half a unit of its last digit,
    h = 0.5 x 10^(floor(log10 |v|) - N + 1), areas to one digit more. B (by size, of sigma_yy) of all tables together changes by the sum of
    derivative x error; printed are
        B        computed here
        worst    the sum of |derivative| x h: no rounding can do more (to first order)
        rms      the root of the sum of (derivative x h)^2/3: standard deviation for errors that are
                 independent and uniform within h
    --heights in m (default: 4 to 56 small diameters, as in the document); further filters as grseg-fit has by default.
    """
    heights = tuple(map(float, options.heights.split(":"))) if options.heights else None
    for name, value in of_tables(options.tables, heights=heights).items():
        print(f"{name}\t{value:.6f}")
