"""Bounds for the error of B from rounded sums."""
import sys

import numpy as np

from tables import shared
import grseg

INSIDE = ("A_SS_yy", "A_Sb_yy", "M_yy")
LARGE = ("A_LL_yy", "A_Lb_yy")
AREAS = ("area_S", "area_L")
AREA_DIGITS = 3


def half_unit(values, digits):
    """Half a unit of the last digit of numbers with so many significant digits."""
    with np.errstate(divide="ignore"):
        return np.where(values == 0, 0, 0.5 * 10.0 ** (np.floor(np.log10(abs(values))) - digits + 1))


def of_tables(paths, heights="4dS:56dS"):
    """B of all tables together, with bounds for its error."""
    tables = [shared.table(path) for path in paths]
    digits = next((int(table.header["kept"].split()[0]) for table in tables if "kept" in table.header), None)
    if digits is None:
        sys.exit("rounding: no table has the line '# kept: N digits'; these tables are not rounded")
    points = grseg.Points(tables, heights=heights)
    b = points.fit("size").B
    at = {name: np.concatenate([table[name][points.row[points.table == k]] for k, table in enumerate(tables)])
          for name in (*INSIDE, *LARGE, "Msize_yy", *AREAS)}
    phi, area, total = points.phi_large, sum(at[name] for name in AREAS), sum(at[name] for name in INSIDE + LARGE)
    psi = (sum(at[name] for name in LARGE) + at["Msize_yy"]) / total
    # Derivatives of psi_L - phi_L - B phi_L phi_S.
    of_phi = -1 - b * (1 - 2 * phi)
    slopes = {**dict.fromkeys(INSIDE, -psi / total), **dict.fromkeys(LARGE, (1 - psi) / total), "Msize_yy": 1 / total,
              "area_S": -of_phi * phi / area, "area_L": of_phi * (1 - phi) / area}
    weight = np.where(total > 0, points.frames, 0)
    errors = [weight * slope * half_unit(at[name], AREA_DIGITS if name in AREAS else digits) / (weight * phi * (1 - phi)).sum()
              for name, slope in slopes.items()]
    return {"B": b, "worst": np.abs(errors).sum(), "rms": np.sqrt((np.square(errors) / 3).sum())}


def rounding(options):
    """Prints bounds for the error of B that comes from rounding the sums of contacts in archived tables.

    Every number v of a table with "# kept: N digits" is known to half a unit of its last digit,
    h = 0.5 x 10^(floor(log10 |v|) - N + 1); areas have one digit more. The error of B (by size, of sigma_yy) of all tables
    together is the sum of derivative x error. Prints
        B        B of all points
        worst    sum of |derivative| x h: the largest possible error (to first order)
        rms      root of the sum of (derivative x h)^2/3: standard deviation for errors that are independent and uniform
                 within h
    --heights is the option of grseg-fit (default: 4 to 56 small diameters, as in the document). Other filters are the defaults
    of grseg-fit.
    """
    for name, value in of_tables(options.tables, heights=options.heights).items():
        print(f"{name}\t{value:.6f}")
