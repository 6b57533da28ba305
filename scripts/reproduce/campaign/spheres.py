"""B of the chutes of spheres: by mixture and time, and over the composition of a layer."""
import math
import os

import numpy as np

import rise
import tables

INSIDE = (4, 20)  # heights between which layers are used, d_S; the bed is 26 d_S deep
TIMES = ((10, 20), (20, 30), (60, 100))  # s
NUMBERS = (20, 30)  # times of all numbers but B, s
EARLY, LATE = (10, 30), (60, 100)  # s
# What B of a layer may depend on: Phi_L of the flow, phi_L of the layer, height and time over those of these flows.
FOLLOWED = {"whole": None, "phi": 1, "y": 26, "t": 100}


def fitted(options, runs, table, begin, end, *words):
    """Numbers of grseg-fit for these runs between two times; none if it has no layer to fit."""
    rows = tables.fits_if_any(options, f"spheres: {runs[0].flow}, {begin} to {end} s", *(run.path(table) for run in runs), "--heights",
                              "{}dS:{}dS".format(*INSIDE), "--begin", begin, "--end", end, "--flows", len(runs), "--quiet", *words)
    return rows[0] if rows else {}


def of_mixture(options, runs):
    """Rows of one mixture: name, value, low, high."""
    found = {}
    for begin, end in TIMES:
        time = f"{begin}-{end}"
        found[f"B {time}"] = fitted(options, runs, "stress-branch-1dS", begin, end), "B"
        found[f"B kept 4dS {time}"] = fitted(options, runs, "stress", begin, end, "--thickness", "kept"), "B"
    found |= {"p_star": (found["B {}-{}".format(*NUMBERS)][0], "p_zero"),
              "B half": (fitted(options, runs, "stress-branch-1dS", *NUMBERS, "--partition", "half"), "B"),
              "B_kappa": (fitted(options, runs, "kinetic-2dS", *NUMBERS, "--quantity", "kinetic"), "B")}
    return {name: [row.get(number + end, math.nan) for end in tables.ENDS] for name, (row, number) in found.items()}


def between(layers, times):
    return layers[(layers.t >= times[0]) & (layers.t < times[1])]


def of_composition(mixtures):
    """B of all mixtures of one seed over phi_L of a layer, and slopes of B of a layer over each of FOLLOWED."""
    every = np.concatenate([layers for _, layers in mixtures]).view(np.recarray)
    found = {}
    for name, times in (("all", (EARLY[0], LATE[1])), ("early", EARLY), ("late", LATE)):
        found |= {f"{name} {k}": b for k, b in enumerate(rise.of_composition(between(every, times), "excess"))}
    flowing = [(phi, between(layers, (EARLY[0], LATE[1]))) for phi, layers in mixtures]
    joined = np.concatenate([layers for _, layers in flowing]).view(np.recarray)
    for name in ("excess", "kept"):
        found |= {f"{name} over {of}": slope for of, slope in rise.followed(flowing, joined, name, FOLLOWED).items()}
    return found


def spheres(options):
    """Writes B of the chutes of spheres from the tables that `keep --spheres` archives.

    Layers are from 4 to 20 d_S, 1 d_S thick, by branch vectors, without what gradients inside them add, but for "kept 4dS": layers
    of 4 d_S, by contact points, with it. Intervals are 95 % over runs. Rows of a mixture (of = Phi_L):
        B T0-T1, B kept 4dS T0-T1   B by size between these times, s
        p_star, B half, B_kappa   20 to 30 s; B_kappa in layers of 2 d_S
    Rows of all mixtures (of = phi_L), where a seed of all mixtures counts as one run:
        all K, early K, late K      B by size of layers with phi_L from K/10 to (K + 1)/10: from 10 s on, 10 to 30 s, 60 to 100 s
        excess over X, kept over X  slope of B of a layer over Phi_L of the flow (whole), phi_L, height over 26 d_S (y) and time
                                    over 100 s (t), at equal others, without and with what gradients add
    """
    runs = tables.runs_in(options.tables)
    rows = []
    for own in tables.by_flow(runs).values():
        rows += [dict(zip(("of", "name", "value", "low", "high"), (f"{own[0].phi:.2f}", name, *three)))
                 for name, three in of_mixture(options, own).items()]
    seeds = {}
    for run in runs:
        seeds.setdefault(run.seed, []).append((run.phi, rise.layers_of(run.path("stress-branch-1dS"), INSIDE, pairs=())))
    whole = max(map(len, seeds.values()))
    found = [of_composition(mixtures) for mixtures in seeds.values() if len(mixtures) == whole]
    for name in found[0]:
        value, half = tables.mean_and_half_width([each[name] for each in found])
        rows.append({"of": "phi_L", "name": name, "value": value, "low": value - half, "high": value + half})
    tables.write(options.output, f"spheres of {os.path.basename(options.tables)}: {len(found)} seeds", list(rows[0]), rows)
