"""The dependence of B on the mixture: B as a product of factors, B over the composition of a layer, and what B follows.

Sums of grseg-micro are merged into windows of WINDOW s, for layers inside. psi = sigma^L/sigma (yy, rule size), M is the
stress of mixed contacts, and q = phi_L phi_S. `excess` is psi - phi_L without what gradients inside a layer add
(grseg-fit --thickness removed), `kept` with it. Sums over layers and windows weighted by frames give B exactly as a product of
three factors, without the bias that the logarithm of a ratio of few grains has:

    B            = sum(excess)/sum(q) = beyond x mixed x geometry
    beyond       = sum(excess)/sum(M/sigma) = p_size - p_star: the large grain's share of a mixed contact minus the
                   share at which B = 0
    mixed        = sum(M/sigma)/sum(M/sigma of neutral contacts)
    geometry     = sum(M/sigma of neutral contacts)/sum(q); for neutral contacts M/sigma = q (1 + r)/(phi_L + r phi_S)

Means of logarithms over layers with at least FEW grains of each species, weighted by q, give four terms whose sum is -ln s of
sigma_yy. s = r (z_S/z_L)(f_S/f_L) is valid for the pressure (the paper's last equation of section V), for means over contact
ends and normal forces:

    ends         = -ln(r z_S/z_L)
    forces       = -ln(f_S/f_L) for the measured numbers of ends, paired at random, each pair with its mean force
    pairing      = -ln(f_S/f_L) - forces
    normal       = the remaining term, by which sigma_yy differs from the pressure
"""
import statistics

import numpy as np

import tables

WINDOW = 5  # length of windows, s
FEW = 3  # least number of grains of each species
PAIRS = ("SS", "LS", "LL", "Sb", "Lb")
CLASSES = 10  # classes of equal width of phi_L of a layer
LEAST = 1e-3  # least share of a class in sum(frames q)
# What B of a layer may depend on: Phi_L of the flow, phi_L of the layer, height and time over those of the paper's flows.
FOLLOWED = {"whole": None, "phi": 1, "y": 60, "t": 150}
FROM = 0.3  # least Phi_L of the upper mixtures; layers of mixtures with less have few large grains


def layers_of(path, inside=tables.INSIDE, pairs=PAIRS):
    """Layers inside with both species, from one run's table of grseg-micro, in windows of WINDOW s.

    Returns a record array. It includes sums over the frames of a window: contents, numbers of contacts n_ and normal forces f_
    by pair, stresses `small` and `large`; and numbers that follow from these sums. r is the ratio of diameters. A table of
    grseg-stress has no numbers of grains and contacts, so `pairs` is then empty."""
    table = tables.table(path)
    d = table.number("small_diameter")
    r = table.number("large_diameter") / d
    of_small, of_large = ("area_S", "area_L") if "area_S" in table.columns else ("volume_S", "volume_L")
    use = ~np.isnan(table["y0"]) & (table[of_small] + table[of_large] > 0)
    column = lambda name: table[name][use]
    at = np.column_stack([np.floor(column("t0") / WINDOW + 1e-6), (column("y0") / d).round(6)])
    at, first, group = np.unique(at, axis=0, return_index=True, return_inverse=True)
    total = lambda *names: np.bincount(group.ravel(), column("frames") * sum(map(column, names)))
    of = {"frames": np.bincount(group.ravel(), column("frames")), "t": column("t0")[first],
          "y": (column("y0") + column("y1"))[first] / 2 / d, "r": np.full(len(at), r),
          "area_S": total(of_small), "area_L": total(of_large), "large": total("A_LL_yy", "A_Lb_yy", "Msize_yy")}
    of |= {f"n_{pair}": total(f"n_{pair}") for pair in pairs} | {f"f_{pair}": total(f"sum_fn_{pair}") for pair in pairs}
    if pairs:
        of["grains"] = np.minimum(total("grains_S"), total("grains_L")) / of["frames"]
    stress = total("A_SS_yy", "A_Sb_yy", "M_yy", "A_LL_yy", "A_Lb_yy")
    whole = np.where(stress == 0, np.nan, stress)
    phi = of["area_L"] / (of["area_S"] + of["area_L"])
    q, thickness = phi * (1 - phi), (column("y1") - column("y0"))[first] / d
    of |= {"small": whole - of["large"], "phi": phi, "q": q,
           "kept": of["large"] / whole - phi, "mixed": total("M_yy") / whole, "by_size": total("Msize_yy") / whole,
           "neutral": q * (1 + r) / (phi + r * (1 - phi))}
    step = np.diff(at, axis=0)
    joined = (step[:, 0] == 0) & (abs(step[:, 1] - thickness[:-1]) < 2e-6)
    below, above = np.arange(len(at)) - np.r_[False, joined], np.arange(len(at)) + np.r_[joined, False]
    of["excess"] = of["kept"] - tables.part_within(phi[above] - phi[below], stress[above] - stress[below],
                                                   np.maximum(above - below, 1), whole)
    layers = np.rec.fromarrays(list(of.values()), names=list(of))
    low, high = inside
    return layers[(layers.y > low) & (layers.y < high) & (layers.q > 0) & ~np.isnan(layers.excess)]


def ends(layers):
    """Numbers of contact ends on small grains and on large grains."""
    return 2 * layers.n_SS + layers.n_LS + layers.n_Sb, 2 * layers.n_LL + layers.n_LS + layers.n_Lb


def logarithms(layers):
    """The terms ends, forces, pairing and normal of each layer; not finite if a kind of contact is missing."""
    small, large = ends(layers)
    with np.errstate(divide="ignore", invalid="ignore"):
        by_ends = -np.log(small / large / (layers.r * layers.area_S / layers.area_L))
        whole = -np.log((2 * layers.f_SS + layers.f_LS + layers.f_Sb) / small
                        / ((2 * layers.f_LL + layers.f_LS + layers.f_Lb) / large))
        ss, ls, ll = (layers[f"f_{pair}"] / layers[f"n_{pair}"] for pair in ("SS", "LS", "LL"))
        forces = -np.log((small * ss + large * ls) / (small * ls + large * ll))
        yy = -np.log(layers.small / layers.large * layers.area_L / layers.area_S)
        return {"ends": by_ends, "forces": forces, "pairing": whole - forces, "normal": yy - by_ends - whole}


def factors(layers):
    excess, mixed, neutral, q, by_size = ((layers.frames * layers[name]).sum() for name in ("excess", "mixed", "neutral", "q", "by_size"))
    return {"B": excess / q, "beyond": excess / mixed, "mixed": mixed / neutral, "geometry": neutral / q,
            "p_star": (by_size - excess) / mixed}


def terms(layers):
    """Means of the logarithmic terms, and ratios of the number of mixed contacts to their number for neutral contacts and for
    random pairs of the measured ends."""
    each = logarithms(layers)
    use = (layers.grains >= FEW) & np.isfinite(sum(each.values()))
    weight = (layers.frames * layers.q)[use]
    found = {name: (weight * values[use]).sum() / weight.sum() for name, values in each.items()}
    count = layers.n_SS + layers.n_LS + layers.n_LL
    x = layers.phi / (layers.phi + layers.r * (1 - layers.phi))
    e = (2 * layers.n_LL + layers.n_LS) / (2 * np.where(count, count, 1))
    mixed, neutral, random = layers.n_LS.sum(), *((2 * part * (1 - part) * count).sum() for part in (x, e))
    return {**found, "log": sum(found.values()), "LS/neutral": mixed / neutral, "LS/random": mixed / random}


def of_composition(layers, name):
    """B from the sums of `excess` or `kept`, in each class of phi_L; nan for a class with less than LEAST of the weight."""
    of = np.minimum(layers.phi * CLASSES, CLASSES - 1).astype(int)
    weight = np.bincount(of, layers.frames * layers.q, CLASSES)
    enough = weight > LEAST * weight.sum()
    return np.where(enough, np.bincount(of, layers.frames * layers[name], CLASSES) / np.where(enough, weight, 1), np.nan)


def followed(mixtures, layers, name, units=FOLLOWED):
    """Slopes of B of a layer, from `excess` or `kept`, over each of `units` at equal others: least squares, weighted by frames
    times q. `mixtures` are pairs of Phi_L and layers; `layers` are all of them."""
    of = {"whole": np.repeat([phi for phi, _ in mixtures], [len(own) for _, own in mixtures])}
    of |= {field: layers[field] / unit for field, unit in units.items() if unit}
    weight = np.sqrt(layers.frames * layers.q)
    at = np.column_stack([weight] + [weight * of[field] for field in units])
    return dict(zip(units, np.linalg.lstsq(at, weight * layers[name] / layers.q, rcond=None)[0][1:]))


def both(label, mixtures, slope):
    """A slope over Phi_L, for all mixtures and for those with Phi_L >= FROM."""
    parts = {label: mixtures, f"upper_{label}": [pair for pair in mixtures if pair[0] >= FROM]}
    return {name: slope(part) for name, part in parts.items() if len(part) > 1}


def mixture(layers):
    """All numbers of one mixture, from the layers of one run."""
    early, late = layers[layers.t < tables.EARLY], layers[layers.t >= tables.LATE]
    found = {**factors(layers), **terms(layers)}
    if len(early) and len(late):
        found["early_less_late"] = factors(early)["B"] - factors(late)["B"]
    return {f"rise_{name}": value for name, value in found.items()}


def trends(mixtures):
    """Trends over mixtures, from one seed of each. Slopes over Phi_L are for all mixtures and for those with Phi_L >= FROM.
    Numbers: `beyond` of all mixtures together; B of each mixture with this common `beyond`; slopes of all numbers; B in each
    class of phi_L and slopes of B of a layer, of `excess` and of `kept`."""
    layers = np.concatenate([own for _, own in mixtures]).view(np.recarray)
    parts = [(phi, {**factors(own), **terms(own)}) for phi, own in mixtures]
    found = {"beyond": factors(layers)["beyond"]}
    for phi, part in parts:
        part["one"] = found["beyond"] * part["mixed"] * part["geometry"]
        found[f"one_{phi:g}"] = part["one"]
    for name in parts[0][1]:
        found |= both(f"trend_{name}", parts, lambda points: statistics.linear_regression(
            [phi for phi, _ in points], [part[name] for _, part in points]).slope)
    for name in ("excess", "kept"):
        found |= {f"{name}_of_{k}": value for k, value in enumerate(of_composition(layers, name))}
        found |= {f"{name}_over_{field}": slope for field, slope in followed(mixtures, layers, name).items()}
    return {f"rise_{name}": value for name, value in found.items()}
