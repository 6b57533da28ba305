#!/usr/bin/python3
"""Checks the tables in tests/tools/expected, with which the tools' output is compared: they must contain the
numbers that follow from three grains and from neutral contacts. These are computed here by their definitions,
with no code of grseg and without reading its output.

Usage: golden.py FOLDER

The run of tests/three_grains.hpp: a large grain on a boundary grain, a small one on the large one. Frames
differ only in the position along x. Every number of a table must agree with this script to 1e-12.
"""
import json
import math
import pathlib
import sys

TOLERANCE = 1e-12
NAN = math.nan

# tests/three_grains.hpp: radius (m), velocity (m/s), spin (1/s), force (N); density 1, so that mass is area.
R = {"S": 0.0025, "L": 0.005}
MASS = {k: math.pi * r * r for k, r in R.items()}
HEIGHT = {"S": 0.0125, "L": 0.005}
V = {"S": (0.3, -0.4), "L": (0.1, 0.2)}
SPIN = {"S": -2.0, "L": 1.0}
FORCE = {"S": (3e-6, 4e-6), "L": (1e-6, 2e-6)}
GRAVITY = (3.8, -9.0)
# Contacts of the large grain with the small one above it and with the base below it: force (N), branch (m).
MIXED = ((1e-4, -2e-4), (0.0, -0.0075))
BASE = ((-3e-4, 1e-3), (0.0, 0.01))
LENGTH, LAYER = 0.35, 0.02
# Centre of mass; the height of the bed is twice its height.
BED = 2 * sum(MASS[k] * HEIGHT[k] for k in "SL") / sum(MASS.values())


def outer(a, b):
    return {f"{x}{y}": a[i] * b[j] for i, x in enumerate("xy") for j, y in enumerate("xy")}


def tensor(name, values, unit, factor=1.0):
    return {f"{name}_{c}[{unit}]": factor * v for c, v in values.items()}


ZERO = outer((0, 0), (0, 0))


def contact_sums():
    """Row of grseg-stress: each contact as a whole, by pair; the large grain's part by its share."""
    mixed, base = outer(*MIXED), outer(*BASE)
    share = R["L"] / (R["L"] + R["S"])  # there is no gap, so the contact point gives the same share
    row = {}
    for name in ("A_SS", "A_LL", "A_Sb", "F_Sb"):
        row |= tensor(name, ZERO, "N m")
    row |= tensor("M", mixed, "N m")
    for name in ("Msize", "Mcp"):
        row |= tensor(name, mixed, "N m", share)
    row |= tensor("A_Lb", base, "N m", 0.5)  # up to the contact point: the radii are equal
    row |= tensor("F_Lb", base, "N m")
    row |= {"n_SS": 0, "n_LS": 1, "n_LL": 0, "n_Sb": 0, "n_Lb": 1}
    return row


def areas():
    return {f"area_{k}[m^2]": MASS[k] for k in "SL"}


def windows(number, row):
    return [dict(row, **{"t0[s]": 0.1 * n, "t1[s]": 0.1 * (n + 1), "y0[m]": 0, "y1[m]": LAYER,
                         "frames": 2, "V[m^2]": LENGTH * LAYER}) for n in range(number)]


def whole_bed(row):
    return dict(row, **{"y0[m]": NAN, "y1[m]": NAN, "V[m^2]": LENGTH * BED})


def in_turn(layers, beds):
    return [row for pair in zip(layers, beds) for row in pair]


def stress():
    squares = {k: sum(v * v for v in V[k]) for k in "SL"}
    motion = {"area_u[m^3/s]": sum(MASS[k] * V[k][0] for k in "SL"),
              "area_v2[m^4/s^2]": sum(MASS[k] * squares[k] for k in "SL")}
    return windows(2, areas() | motion | contact_sums())


def mean_flow():
    total = sum(MASS.values())
    u, v = (sum(MASS[k] * V[k][axis] for k in "SL") / total for axis in (0, 1))
    slope = (V["S"][0] - V["L"][0]) / (HEIGHT["S"] - HEIGHT["L"])
    return u, v, slope


def kinetic(unbiased=False):
    """Fluctuations about the layer's mean; the velocity profile passes through both grains, so none are left about it."""
    u, v, slope = mean_flow()
    spin = sum(MASS[k] * SPIN[k] for k in "SL") / sum(MASS.values())
    row = {"u[m/s]": u, "v[m/s]": v, "du_dy[1/s]": slope}
    temperature = {}
    for k in "SL":
        dv, dw = (V[k][0] - u, V[k][1] - v), SPIN[k] - spin
        energy, turning = outer(dv, dv), R[k]**2 / 2 * dw**2
        counts = 0 if unbiased else 1  # one other grain is too few
        row |= tensor(f"K_{k}", energy, "J", counts * MASS[k])
        row[f"Kr_{k}[J]"] = counts * MASS[k] * turning
        row[f"mass_{k}[kg]"], row[f"grains_{k}"] = counts * MASS[k], counts
        temperature[k] = (energy["xx"], energy["yy"], turning)
        for freedom, t in zip("xyr", temperature[k]):
            row[f"T_{k}_{freedom}[m^2/s^2]"] = NAN if unbiased else t
        row |= {f"layer_bias_{k}_{c}[J]": counts * MASS[k] * energy[c] for c in ("xx", "xy", "yy")}
        row[f"layer_bias_{k}_r[J]"] = counts * MASS[k] * turning
        row[f"shear_bias_{k}_xx[J]"] = counts * MASS[k] * (slope * LAYER)**2 / 12
        if unbiased:
            row[f"left_out_{k}"] = 1
    for n, freedom in enumerate("xyr"):
        quotient = temperature["L"][n] * MASS["L"] / (temperature["S"][n] * MASS["S"])
        row[f"equipartition_{freedom}"] = NAN if unbiased else quotient
    return windows(2, row)


def micro():
    """Both contacts are vertical: cos 2 theta = -1, sin 2 theta = 0. Without a friction coefficient, sliding is
    unknown. Strong contacts exceed the mean force of contacts between grains, of which there is one here."""
    row = areas() | {"grains_S": 1, "grains_L": 1, "ends_S": 1, "ends_L": 2, "ends_S_mixed": 1,
                     "ends_L_mixed": 1, "ends_S_base": 0, "ends_L_base": 1}
    for pair in ("SS", "LS", "LL", "Sb", "Lb"):
        force, branch = {"LS": MIXED, "Lb": BASE}.get(pair, ((0.0, 0.0), (0.0, 1.0)))
        up = math.copysign(1, branch[1])
        normal, tangential = force[1] * up, -force[0] * up  # t is n turned by 90 degrees
        there = int(force != (0.0, 0.0))
        row |= {f"sum_f_{pair}[N]": math.hypot(*force), f"sum_fn_{pair}[N]": normal,
                f"sum_ft/fn_{pair}": abs(tangential) / normal if there else 0, f"n_{pair}": there,
                f"n_slide_{pair}": NAN if there else 0, f"n_strong_{pair}": 0, f"c2_{pair}": -there, f"s2_{pair}": 0,
                f"fn_c2_{pair}[N]": -normal, f"fn_s2_{pair}[N]": 0, f"ft_c2_{pair}[N]": -tangential,
                f"ft_s2_{pair}[N]": 0}
    sums = contact_sums()
    row |= {name: value for name, value in sums.items()
            if name.startswith(("A_", "M_", "Msize_"))}
    row |= {"base_fx[N]": BASE[0][0], "base_fy[N]": BASE[0][1]}
    heights = {"yL[m]": HEIGHT["L"], "yS[m]": HEIGHT["S"], "height[m]": BED}
    layers = windows(2, row | {name: NAN for name in heights})
    return in_turn(layers, [whole_bed(one | heights) for one in layers])


def segregation():
    u, v, slope = mean_flow()
    phi = MASS["L"] / sum(MASS.values())
    row = areas() | {"u[m/s]": u, "v[m/s]": v, "du_dy[1/s]": slope, "phi_L": phi, "phi_L_error": 0}
    for k, part in (("S", 1 - phi), ("L", phi)):
        w = V[k][1] - v
        row |= {f"w_{k}[m/s]": w, f"q_{k}[m/s]": part * w, f"w_{k}_error[m/s]": 0,
                f"q_{k}_error[m/s]": 0, f"displacements_{k}": 0,
                # All frames of a window are equal: no momentum is gained.
                f"mass_{k}[kg]": MASS[k], f"mvv_{k}_yy[J]": MASS[k] * V[k][1]**2, f"gain_{k}_y[N]": 0}
    layers = windows(2, row)
    # There is one layer, so its composition is that of the bed: s = 0. s_r^2/s_0^2 for one grain of each species.
    total = sum(MASS.values())
    random = ((1 - phi) * MASS["L"] + phi * MASS["S"]) / total
    bed = {"yL[m]": HEIGHT["L"], "yS[m]": HEIGHT["S"], "height[m]": BED, "mixing": 1 / (1 - random)}
    beds = [dict({name: NAN for name in row}, **bed) for _ in layers]
    for one, layer in zip(beds, layers):
        one |= {name: layer[name] for name in ("t0[s]", "t1[s]", "frames")}
    return in_turn(layers, [whole_bed(one) for one in beds])


class Smoothed:
    """Part of a Gaussian of width 2 mm that lies in a layer of 6 mm. The lowest layer includes everything below,
    the highest layer everything above."""
    width, thickness, layers = 0.002, 0.006, 3

    def __init__(self, layer):
        self.low = layer * self.thickness if layer > 0 else -math.inf
        self.high = (layer + 1) * self.thickness if layer < self.layers - 1 else math.inf

    def __call__(self, y):
        root = math.sqrt(2) * self.width
        low, high = (self.low - y) / root, (self.high - y) / root
        if low > 0:  # this form loses no digits in the upper tail
            return (math.erfc(low) - math.erfc(high)) / 2
        return (math.erfc(-high) - math.erfc(-low)) / 2

    def along(self, start, end, pieces=2000):
        """Mean over a line between two heights, by Simpson's rule."""
        values = [self(start + (end - start) * k / pieces) for k in range(pieces + 1)]
        return (values[0] + values[-1] + 4 * sum(values[1::2]) + 2 * sum(values[2:-1:2])) / (3 * pieces)


STEP = 1e-4


def momentum_of_species(k, inside, volume):
    """Terms of the balance in momentum_balance.hpp; contacts are cut where the grains touch."""
    m, v, y, force = MASS[k], V[k], HEIGHT[k], FORCE[k]
    sign, cut = (1, 0.01) if k == "L" else (-1, 0.01)
    others = [(tuple(sign * f for f in MIXED[0]), cut)]
    base = [(BASE[0], 0.0)] if k == "L" else []
    later, here = inside(y + STEP * v[1]), inside(y)

    def vector(value):
        return [value(axis) / volume for axis in (0, 1)]

    return {
        "rho": m * here / volume,
        "j": vector(lambda a: m * v[a] * here),
        "Sc": {f"{x}y": sum(f[a] * (y - c) * inside.along(y, c) for f, c in others + base) / volume
               for a, x in enumerate("xy")},
        "rate": vector(lambda a: m / STEP * (v[a] * later - (v[a] - force[a] * STEP / m) * here)),
        "gravity": vector(lambda a: m * GRAVITY[a] * here),
        "contact": vector(lambda a: sum(f[a] * (here - inside(c)) for f, c in others + base)),
        "kinetic": vector(lambda a: m / STEP * v[a] * (later - here)),
        "interaction": vector(lambda a: sum(f[a] * inside(c) for f, c in others)),
        "base": vector(lambda a: sum(f[a] * inside(c) for f, c in base)),
        "force": vector(lambda a: force[a] * here),
        "change": [0.0, 0.0],  # both frames are alike
    }


def balance_terms(of, volume_unit="N/m^2"):
    """Columns of both species."""
    row = {}
    total = sum(own["rho"] for own in of.values())
    mean = [sum(own["j"][a] for own in of.values()) / total for a in (0, 1)]
    for k, own in of.items():
        excess = [V[k][a] - mean[a] for a in (0, 1)]
        row[f"rho_{k}[kg/m^2]"] = own["rho"]
        row |= {f"j{x}_{k}[kg/(m s)]": own["j"][a] for a, x in enumerate("xy")}
        row |= {f"Sc_{k}_{c}[N/m]": own["Sc"].get(c, 0) for c in ("xx", "xy", "yx", "yy")}
        flux = outer(excess, excess)
        row |= {f"Sk_{k}_{c}[N/m]": own["rho"] * flux[c] for c in ("xx", "xy", "yy")}
        own["residual"] = [own["rate"][a] - sum(own[name][a] for name in (
            "gravity", "contact", "kinetic", "interaction", "base")) for a in (0, 1)]
        for name in ("rate", "gravity", "contact", "kinetic", "interaction", "base", "force",
                     "residual", "change"):
            row |= {f"{name}_{k}_{x}[{volume_unit}]": own[name][a] for a, x in enumerate("xy")}
    return row


def driving_forces(of):
    """Forces by the definitions of driving_forces.hpp."""
    phi = of["L"]["rho"] / (of["L"]["rho"] + of["S"]["rho"])
    stress = {k: own["Sc"]["yy"] for k, own in of.items()}
    flux = {k: own["rho"] * V[k][1]**2 for k, own in of.items()}
    slope = {k: -(own["contact"][1] + own["base"][1]) for k, own in of.items()}
    slope_of_flux = {k: -own["kinetic"][1] for k, own in of.items()}
    psi, psi_kinetic = (one["L"] / (one["L"] + one["S"]) for one in (stress, flux))

    def pushed(part, slopes):
        return -(part - phi) * sum(slopes.values()), slopes["L"] - part * sum(slopes.values())

    def beyond(name):
        return of["L"][name][1] - phi * (of["L"][name][1] + of["S"][name][1])

    push, spread = pushed(psi, slope)
    push_kinetic, spread_kinetic = pushed(psi_kinetic, slope_of_flux)
    drag = -push - push_kinetic
    unit = "[N/m^2]"
    return {"phi_L": phi, "psi_L": psi, "psik_L": psi_kinetic, "B": (psi - phi) / (phi * (1 - phi)),
            "B_kappa": (psi_kinetic - phi) / (phi * (1 - phi)), f"push{unit}": push,
            f"push_kinetic{unit}": push_kinetic, f"spread{unit}": spread,
            f"spread_kinetic{unit}": spread_kinetic, f"drag{unit}": drag, f"scatter{unit}": beyond("rate"),
            "drift[kg/(m s)]": beyond("j"), "drag_rate[1/s]": -drag / beyond("j")}


def balance():
    volume = LENGTH * Smoothed.thickness
    rows = []
    for window in range(2):
        for layer in range(Smoothed.layers):
            of = {k: momentum_of_species(k, Smoothed(layer), volume) for k in "SL"}
            rows.append(balance_terms(of) | driving_forces(of) | {
                "t0[s]": 0.1 * window, "t1[s]": 0.1 * (window + 1), "frames": 2, "V[m^2]": volume,
                "y0[m]": layer * Smoothed.thickness, "y1[m]": (layer + 1) * Smoothed.thickness})
    return rows


def physics():
    """Residual of the large grain, whose forces are further from balance than the small grain's."""
    worst = 0
    for k, contacts in (("L", (MIXED[0], BASE[0])), ("S", ((-MIXED[0][0], -MIXED[0][1]),))):
        defect = [sum(f[axis] for f in contacts) + MASS[k] * GRAVITY[axis] - FORCE[k][axis]
                  for axis in (0, 1)]
        worst = max(worst, math.hypot(*defect))
    largest = max(math.hypot(*MIXED[0]), math.hypot(*BASE[0]), MASS["L"] * math.hypot(*GRAVITY))
    return {"force_balance": worst / largest, "not_closed": 1, "no_frames": 0, "damaged_frames": 0, "damaged_outside_frames": 0,
            "tension_largest": 0, "tension_mean": 0, "open_gap_largest": 0, "open_gap_mean": 0,
            "overlap_largest": 0, "overlap_mean": 0, "sum_of_partials": 0}


class Neutral:
    """tests/inputs/neutral-sums.tsv: phi_L, and sums over contacts of small grains, large ones, and both."""
    points = ((1 / 3, 16, 2, 12), (1 / 2, 10, 5, 15), (2 / 3, 5, 10, 15))
    area = 0.006
    diameter = {"S": 0.005, "L": 0.01}

    def __init__(self, share):
        self.x, self.y, self.weight, self.psi, self.phi = [], [], [], [], []
        for phi, small, large, mixed in self.points:
            of_small = small + (0 if share is None else (1 - share) * mixed)
            of_large = large + (0 if share is None else share * mixed)
            self.x.append((1 - phi) / phi)
            self.y.append(of_small / of_large)
            self.psi.append(of_large / (of_small + of_large))
            self.phi.append(phi)
            number = {"S": (1 - phi) * self.area / (math.pi / 4 * self.diameter["S"]**2),
                      "L": phi * self.area / (math.pi / 4 * self.diameter["L"]**2)}
            self.weight.append(min(number.values()))

    def mean(self, values):
        return sum(w * v for w, v in zip(self.weight, values)) / sum(self.weight)

    def fit(self):
        """Results of grseg-fit for these layers, with equal numbers of frames."""
        logs = [math.log(y / x) for x, y in zip(self.x, self.y)]
        s = math.exp(self.mean(logs))
        # Weighted straight line in the logarithms.
        u, v = [math.log(x) for x in self.x], [math.log(y) for y in self.y]
        mu, mv = self.mean(u), self.mean(v)
        a = (self.mean([(x - mu) * (y - mv) for x, y in zip(u, v)])
             / self.mean([(x - mu)**2 for x in u]))
        b = (sum(psi - p for psi, p in zip(self.psi, self.phi))
             / sum(p * (1 - p) for p in self.phi))
        return {"B": b, "paper_s": s, "paper_B": ((1 - s) + (1 - s) / s) / 2,
                "paper_k": math.exp(mv - a * mu), "paper_a": a}


def line_over_share():
    """p* is the sum of phi_L - psi_L without mixed contacts, divided by the sum of the mixed contacts' part of the
    stress; dB/dp is the latter sum divided by the sum of phi_L phi_S."""
    part = sum(mixed / (small + large + mixed) for _, small, large, mixed in Neutral.points)
    missing = sum(p - large / (small + large + mixed) for p, small, large, mixed in Neutral.points)
    return {"p_zero": missing / part, "dB_dp": part / sum(p * (1 - p) for p, *_ in Neutral.points)}


def neutral_b(share):
    """B(phi_L) = (p - r/(1 + r)) (1 + r)/(phi_L + r phi_S), weighted by phi_L phi_S as B is."""
    r, products = 2, [p * (1 - p) for p, *_ in Neutral.points]
    b = [(share - r / (1 + r)) * (1 + r) / (p + r * (1 - p)) for p, *_ in Neutral.points]
    return sum(x * q for x, q in zip(b, products)) / sum(products)


def fit():
    """{(rule, quantity): value}."""
    shares = {"size": 2 / 3, "contact-point": 2 / 3, "half": 1 / 2, "drop": None, "uniform:0.8": 0.8}
    numbers = {("-", "points"): 3, ("-", "runs"): 1, ("-", "weight_share"): 1,
               ("-", "Phi_L"): sum(p for p, *_ in Neutral.points) / 3}
    numbers |= {("-", name): value for name, value in line_over_share().items()}
    by_size = Neutral(shares["size"]).fit()["B"]
    for rule, share in shares.items():
        own = Neutral(share).fit()
        if share is None:  # the stresses do not add up to the total, so there is no B
            del own["B"], own["paper_B"]
        else:
            # The total stress of all layers is the same: no gradient of it inside a layer.
            own |= {"share": share, "neutral": neutral_b(share), "B_minus_size": own["B"] - by_size,
                    "B_of_thickness": 0}
        numbers |= {(rule, name): value for name, value in own.items()}
    return numbers


def scan():
    return [{"p": p, "B": Neutral(p).fit()["B"], "neutral": neutral_b(p)} for p in (0.5, 0.6, 0.7, 0.8)]


def read(path):
    lines = [line for line in path.read_text().splitlines() if not line.startswith("# ")]
    names = lines[0].split("\t")
    return [dict(zip(names, line.split("\t"))) for line in lines[1:]]


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def agree(there, value, round_off):
    if there is None or value is None:
        return there is value
    if math.isnan(there) or math.isnan(value):
        return math.isnan(there) and math.isnan(value)
    return abs(there - value) <= max(TOLERANCE * abs(value), round_off)


def compare_headers(path, mine):
    lines = dict(line[2:].split(": ", 1) for line in path.read_text().splitlines() if line.startswith("# "))
    for key, value in mine.items():
        if not agree(float(lines[key]), value, 1e-15):
            sys.exit(f"{path.name}: {key} is {lines[key]}, and by its definition {value!r}")
    return len(mine)


def compare_numbers(path, rows, mine):
    """Rows of grseg-fit, from its table or from JSON; rows that were not asked for may be missing."""
    for row in rows:
        key = row["rule"], row["quantity"]
        if key not in mine:
            sys.exit(f"{path.name}: nothing here computes {key}")
        if not agree(float(row["value"]), mine[key], 1e-15):
            sys.exit(f"{path.name}: {key} is {row['value']}, and by its definition {mine[key]!r}")
    return len(rows)


def compare_words(path, numbers):
    """B of each rule, p* and dB/dp to three digits."""
    lines = path.read_text().splitlines()
    line = line_over_share()
    expected = [("B = 0 if", f"p* = {line['p_zero']:.3f} of every"), ("B = 0 if", f"dB/dp = {line['dB_dp']:.3f}")]
    for rule in dict.fromkeys(rule for rule, _ in numbers if rule != "-"):
        b = numbers.get((rule, "B"), NAN)
        expected.append((rule + " ", " - " if math.isnan(b) else f" {0.0 if abs(b) < 1e-9 else b:.3f} "))
    for start, words in expected:
        if not any(line.startswith(start) and words in line for line in lines):
            sys.exit(f"{path.name}: '{words.strip()}' is not in the line that begins with '{start.strip()}'")
    return len(expected)


def compare_physics(path, mine):
    found = {row["quantity"]: row for row in read(path)}
    measured = {name: float(row["measured"]) for name, row in found.items()
                if row["verdict"] != "skipped"}
    if set(measured) != set(mine):
        sys.exit(f"{path.name}: {set(measured) ^ set(mine)}: measured or computed, but not both")
    for name, value in mine.items():
        if not agree(measured[name], value, 1e-15):
            sys.exit(f"{path.name}: {name} is {measured[name]}, and by its definition {value!r}")
        passed = measured[name] <= float(found[name]["tolerance"])
        if found[name]["verdict"] != ("passed" if passed else "failed"):
            sys.exit(f"{path.name}: {name} has {found[name]['verdict']}")
    return len(mine)


def compare(path, mine):
    """Compares a table, and returns the number of numbers compared. Columns of text, and columns that are NaN
    throughout, need not be computed. Zeros may be round-off: the last digit of 1 in fits, that of the smallest
    energies in other tables."""
    round_off = 1e-15 if path.name.startswith("neutral") else 1e-24
    if path.name == "three-grains.balance.tsv":  # m/h times differences of 1; of the stresses, of velocities
        round_off = {"[N/m^2]": 5e-14, "[N/m]": 1e-18, "[1/s]": 1e-10}
    rows = read(path)
    if len(rows) != len(mine):
        sys.exit(f"{path.name}: {len(rows)} rows, and {len(mine)} are computed")
    compared = 0
    for n, (row, own) in enumerate(zip(rows, mine)):
        for column in own:
            if column not in row:
                sys.exit(f"{path.name}: the column {column} is missing")
        for column, text in row.items():
            if column not in own:
                if number(text) is not None and not math.isnan(number(text)):
                    sys.exit(f"{path.name}, row {n + 1}: {column} is {text}, and nothing computes it; "
                             "write its definition into golden.py")
                continue
            if isinstance(own[column], str):
                if own[column] != text:
                    sys.exit(f"{path.name}, row {n + 1}: {column} is {text}, not {own[column]}")
                continue
            compared += 1
            digits = round_off
            if isinstance(round_off, dict):
                digits = next((one for unit, one in round_off.items() if column.endswith(unit)), 1e-15)
            if not agree(number(text), own[column], digits):
                sys.exit(f"{path.name}, row {n + 1}: {column} is {text}, and by its definition "
                         f"{own[column]!r}")
    return compared


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    tables = {"three-grains.stress.tsv": stress(), "three-grains.kinetic.tsv": kinetic(),
              "three-grains.unbiased.tsv": kinetic(unbiased=True), "three-grains.micro.tsv": micro(),
              "three-grains.segregation.tsv": segregation(), "three-grains.balance.tsv": balance(),
              "neutral.scan.tsv": scan()}
    compared = 0
    for name, mine in tables.items():
        compared += compare(folder / name, mine)
    compared += compare_headers(folder / "neutral.scan.tsv", line_over_share())
    numbers = fit()
    compared += compare_numbers(folder / "neutral.fit.tsv", read(folder / "neutral.fit.tsv"), numbers)
    for name in ("neutral.fit.json", "one-window.fit.json"):
        compared += compare_numbers(folder / name, json.loads((folder / name).read_text())["numbers"], numbers)
    compared += compare_words(folder / "neutral.fit.txt", numbers)
    compared += compare_physics(folder / "three-grains.physics.tsv", physics())
    print(f"{compared} numbers follow from their definitions")


main()
