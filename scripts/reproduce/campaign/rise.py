"""Why B depends on the mixture: B taken apart, and its trend over mixtures where layers are alike.

From the sums of grseg-micro, merged into windows of WINDOW s, layers inside. With psi = sigma^L/sigma (yy, rule size), M the
stress of mixed contacts and q = phi_L phi_S, sums over layers and windows weighted by frames give B as a product of
three factors, exactly, and without the bias of the logarithm of a ratio of few grains:

    B            = sum(psi - phi_L)/sum(q) = beyond x mixed x geometry
    beyond       = sum(psi - phi_L)/sum(M/sigma) = p_size - p_star: what a mixed contact gives its large grain beyond the
                   share at which B = 0
    mixed        = sum(M/sigma)/sum(the same of neutral contacts)
    geometry     = sum(the same of neutral contacts)/sum(q); of neutral contacts M/sigma = q (1 + r)/(phi_L + r phi_S)

and, in means of logarithms of layers with FEW grains or more of each species, weighted by q, four terms whose sum is
-ln s of sigma_yy, s = r (z_S/z_L)(f_S/f_L) being that of the pressure (paper's last equation of section V), over contact
ends, with normal forces:

    ends         = -ln(r z_S/z_L)
    forces       = -ln(f_S/f_L) if the ends that there are paired at random, each pair with its mean force
    pairing      = -ln(f_S/f_L) - forces
    normal       = what sigma_yy has beyond the sum of these, that is beyond the pressure
"""
import math
import statistics

import tables

WINDOW, LONG_WINDOW = 5, 25  # s; in the longer one phi_L scatters less
FEW = 3
PAIRS = ("SS", "LS", "LL", "Sb", "Lb")
# Edges of the classes in which layers count as alike; gradient of phi_L upward in 1/d_S, t in s, y in d_S.
CLASSES = {"phi": (0.05, 0.1, 0.2, 0.4, 0.6, 0.8), "y": (20, 36), "t": (tables.EARLY, tables.LATE),
           "gradient": (-0.02, -0.01, -0.003, 0.003, 0.01, 0.02)}
ALIKE = ((), ("phi",), ("y",), ("gradient",), ("phi", "y"), ("phi", "y", "t"), ("phi", "y", "gradient"))
FROM = 0.3  # Phi_L; below, layers hold few large grains


class Layer:
    """Sums of one layer over the frames of a window; r is the ratio of diameters."""

    def __init__(self, rows, d, r):
        total = lambda *names: sum(row["frames"] * row[name] for row in rows for name in names)
        self.frames = sum(row["frames"] for row in rows)
        self.y, self.t = (rows[0]["y0"] + rows[0]["y1"]) / 2 / d, rows[0]["t0"]
        self.area_s, self.area_l = total("area_S"), total("area_L")
        self.grains = min(total("grains_S"), total("grains_L")) / self.frames
        self.n = {pair: total(f"n_{pair}") for pair in PAIRS}
        self.f = {pair: total(f"sum_fn_{pair}") for pair in PAIRS}
        large = total("A_LL_yy", "A_Lb_yy", "Msize_yy")
        self.stress = total("A_SS_yy", "A_Sb_yy", "M_yy", "A_LL_yy", "A_Lb_yy") - large, large  # small, large
        self.phi, self.r, self.gradient = self.area_l / (self.area_s + self.area_l), r, math.nan
        self.q = self.phi * (1 - self.phi)
        whole = sum(self.stress) or math.nan
        self.excess = self.stress[1] / whole - self.phi
        self.mixed, self.by_size = total("M_yy") / whole, total("Msize_yy") / whole
        self.neutral = self.q * (1 + r) / (self.phi + r * (1 - self.phi))

    def ends(self):
        """Contact ends on small and on large grains."""
        return 2 * self.n["SS"] + self.n["LS"] + self.n["Sb"], 2 * self.n["LL"] + self.n["LS"] + self.n["Lb"]

    def terms(self):
        """ends, forces, pairing, normal; ValueError or ZeroDivisionError where a kind of contact is missing."""
        small, large = self.ends()
        grains_ratio = self.r ** 2 * self.area_s / self.area_l
        ends = -math.log(self.r * small / large / grains_ratio)
        whole = -math.log((2 * self.f["SS"] + self.f["LS"] + self.f["Sb"]) / small
                          / ((2 * self.f["LL"] + self.f["LS"] + self.f["Lb"]) / large))
        mean = {pair: self.f[pair] / self.n[pair] for pair in ("SS", "LS", "LL")}
        forces = -math.log((small * mean["SS"] + large * mean["LS"]) / (small * mean["LS"] + large * mean["LL"]))
        yy = -math.log(self.stress[0] / self.stress[1] * self.area_l / self.area_s)
        return {"ends": ends, "forces": forces, "pairing": whole - forces, "normal": yy - ends - whole}


def layers_of(path, window=WINDOW):
    """Layers inside, with both species, of one run's table of grseg-micro, in windows of so many seconds."""
    header, rows = tables.read(path)
    d, large = float(header["small_diameter"]), float(header["large_diameter"])
    groups = {}
    for row in rows:
        if not math.isnan(row["y0"]) and row["area_S"] + row["area_L"] > 0:
            groups.setdefault((int(row["t0"] / window + 1e-6), round(row["y0"] / d, 6)), []).append(row)
    found = {key: Layer(group, d, large / d) for key, group in groups.items()}
    for (t, y), layer in found.items():
        thickness = (groups[t, y][0]["y1"] - groups[t, y][0]["y0"]) / d
        below, above = (found.get((t, round(y + step * thickness, 6))) for step in (-1, 1))
        if below and above:
            layer.gradient = (above.phi - below.phi) / (2 * thickness)
    return [layer for layer in found.values() if tables.INSIDE[0] < layer.y < tables.INSIDE[1] and layer.q > 0
            and not math.isnan(layer.excess)]


def total(layers, name):
    return sum(layer.frames * getattr(layer, name) for layer in layers)


def factors(layers):
    excess, mixed, neutral, q = (total(layers, name) for name in ("excess", "mixed", "neutral", "q"))
    return {"B": excess / q, "beyond": excess / mixed, "mixed": mixed / neutral, "geometry": neutral / q,
            "p_star": (total(layers, "by_size") - excess) / mixed}


def terms(layers):
    """Means of the logarithmic terms, and of who touches whom."""
    sums, weight = {}, 0
    for layer in layers:
        if layer.grains < FEW:
            continue
        try:
            each = layer.terms()
        except (ValueError, ZeroDivisionError):
            continue
        weight += layer.frames * layer.q
        for name, value in each.items():
            sums[name] = sums.get(name, 0) + layer.frames * layer.q * value
    found = {name: value / weight for name, value in sums.items()}
    count = lambda layer: sum(layer.n[pair] for pair in ("SS", "LS", "LL"))
    mixed = sum(layer.n["LS"] for layer in layers)
    x = lambda layer: layer.phi / (layer.phi + layer.r * (1 - layer.phi))
    neutral = sum(2 * x(layer) * (1 - x(layer)) * count(layer) for layer in layers)
    e = lambda layer: (2 * layer.n["LL"] + layer.n["LS"]) / (2 * count(layer))
    random = sum(2 * e(layer) * (1 - e(layer)) * count(layer) for layer in layers if count(layer))
    return {**found, "log": sum(found.values()), "LS/neutral": mixed / neutral, "LS/random": mixed / random}


def class_of(layer, names):
    return tuple(sum(getattr(layer, name) >= edge for edge in CLASSES[name]) for name in names)


def trend_where_alike(mixtures, names):
    """Slope of B over Phi_L within classes of layers: least squares, weighted by frames times q, with a level of its
    own for each class. `mixtures` are pairs of Phi_L and layers."""
    classes = {}
    for phi, layers in mixtures:
        for layer in layers:
            if not math.isnan(layer.gradient):
                classes.setdefault(class_of(layer, names), []).append((phi, layer))
    above = below = 0
    for members in classes.values():
        middle = sum(phi * layer.frames * layer.q for phi, layer in members) / total([layer for _, layer in members], "q")
        above += sum((phi - middle) * layer.frames * layer.excess for phi, layer in members)
        below += sum((phi - middle) ** 2 * layer.frames * layer.q for phi, layer in members)
    return above / below


def both(label, mixtures, slope):
    """A slope over Phi_L of all mixtures, and of those from FROM on."""
    parts = {label: mixtures, f"upper_{label}": [pair for pair in mixtures if pair[0] >= FROM]}
    return {name: slope(part) for name, part in parts.items() if len(part) > 1}


def mixture(layers):
    """Of the layers of one run: everything that is said of a mixture."""
    early, late = ([layer for layer in layers if begin <= layer.t < end]
                   for begin, end in ((0, tables.EARLY), (tables.LATE, math.inf)))
    found = {**factors(layers), **terms(layers)}
    if early and late:
        found["early_less_late"] = factors(early)["B"] - factors(late)["B"]
    return {f"rise_{name}": value for name, value in found.items()}


def trends(mixtures, long):
    """Of one seed of each mixture: slopes over Phi_L, of all mixtures and of those from FROM on; B if p_size - p* were
    that of all together; slopes where layers are alike, of equal phi_L also in the windows of `long`."""
    parts = [(phi, {**factors(layers), **terms(layers)}) for phi, layers in mixtures]
    found = {"beyond": factors([layer for _, layers in mixtures for layer in layers])["beyond"]}
    for phi, part in parts:
        part["one"] = found["beyond"] * part["mixed"] * part["geometry"]
        found[f"one_{phi:g}"] = part["one"]
    for name in parts[0][1]:
        found |= both(f"trend_{name}", parts, lambda points: statistics.linear_regression(
            [phi for phi, _ in points], [part[name] for _, part in points]).slope)
    for names in ALIKE:
        found |= both("_".join(("alike",) + names), mixtures, lambda part: trend_where_alike(part, names))
    found |= both("alike_phi_long", long, lambda part: trend_where_alike(part, ("phi",)))
    return {f"rise_{name}": value for name, value in found.items()}
