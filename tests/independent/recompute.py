#!/usr/bin/python3
"""Computes from the raw file, by the definitions and with no code of grseg, what the tools print.

Usage: recompute.py BIN RUN.h5 SCENE.ini

For a few frames of RUN.h5 and of a short fresh run of SCENE.ini: the stresses sigma^S, sigma^L and
sigma, the kinetic stresses of both species about the profile and about the layer's mean, and
coordination z and mean force f of both, by layer; then BIN/grseg-stress, grseg-kinetic and
grseg-micro on the same frames. Every number must agree to 1e-10 of the largest component of its
tensor. One loop over contacts, one over grains: slow and plain on purpose.
"""
import math
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

SMALL, LARGE, BOUNDARY = 0, 1, 2
NAME = {SMALL: "S", LARGE: "L"}
TOLERANCE = 1e-10
compared = 0


class Run:
    """A few consecutive frames of a file."""

    def __init__(self, path, frames):
        f = h5py.File(path, "r")
        grains = f["particles/grains"]
        self.radius = grains["radius"][:].astype(float)
        self.mass = grains["mass"][:].astype(float)
        self.species = grains["species"][:]
        self.mobile = (self.species != BOUNDARY) & (grains["fixed"][:] == 0)
        self.length = float(grains["box/edges"][0])
        self.small_diameter = float(f["parameters/small_diameter"][()])
        self.interval = float(f["parameters/frame_interval"][()])
        h = float(f["parameters/step"][()])
        offset = f["grseg/contacts/offset"][:]
        self.begin = int(grains["position/step"][frames.start]) * h
        self.frames = []
        for k in frames:
            rows = slice(int(offset[k]), int(offset[k + 1]))
            frame = {name: f[f"grseg/contacts/{name}"][rows].astype(float)
                     for name in ("force", "branch", "gap")}
            frame["i"], frame["j"] = f["grseg/contacts/i"][rows], f["grseg/contacts/j"][rows]
            for name in ("position", "velocity", "angular_velocity"):
                frame[name] = grains[f"{name}/value"][k].astype(float)
            self.frames.append(frame)

    def is_mobile(self, g):
        return g >= 0 and self.mobile[g]


def layer_of(y, h):
    """Layer n is [n h, (n+1) h); the first also takes all below."""
    return max(0, math.floor(y / h))


def layers_of(run, frames, h):
    """As many layers as the highest grain reaches."""
    top = max((f["position"][:, 1] + run.radius)[run.mobile].max() for f in frames)
    return math.ceil(top / h)


def tensors(layers):
    return np.zeros((layers, 2, 2))


def stress(run, frames, h, layers):
    """Stresses, N/m, by size; contacts where they touch; base: from the centre to the contact."""
    sigma = {SMALL: tensors(layers), LARGE: tensors(layers), "all": tensors(layers)}
    for f in frames:
        for force, branch, gap, i, j in zip(f["force"], f["branch"], f["gap"], f["i"], f["j"]):
            r_i, r_j = run.radius[i], run.radius[j] if j >= 0 else 0.0
            to_contact = branch if j < 0 else branch * (r_i + gap / 2) / (r_i + r_j + gap)
            y = (f["position"][i] - to_contact)[1]
            layer = min(layer_of(y, h), layers - 1)
            if run.is_mobile(j):
                whole = np.outer(force, branch)
                sigma[run.species[i]][layer] += whole * r_i / (r_i + r_j)
                sigma[run.species[j]][layer] += whole * r_j / (r_i + r_j)
            else:
                whole = np.outer(force, to_contact)
                sigma[run.species[i]][layer] += whole
            sigma["all"][layer] += whole
    return {which: t / (len(frames) * run.length * h) for which, t in sigma.items()}


def whole_base(run, frames, h, layers):
    """Sums of force (x) whole branch over contacts with the base, N m: F_Sb and F_Lb."""
    sums = {SMALL: tensors(layers), LARGE: tensors(layers)}
    for f in frames:
        for force, branch, gap, i, j in zip(f["force"], f["branch"], f["gap"], f["i"], f["j"]):
            if run.is_mobile(j):
                continue
            r_i, r_j = run.radius[i], run.radius[j] if j >= 0 else 0.0
            part = 1.0 if j < 0 else (r_i + gap / 2) / (r_i + r_j + gap)
            y = f["position"][i][1] - part * branch[1]
            sums[run.species[i]][min(layer_of(y, h), layers - 1)] += np.outer(force, branch)
    return {which: t / len(frames) for which, t in sums.items()}


def mobile_grains(run, frames):
    for f in frames:
        for g in np.flatnonzero(run.mobile):
            yield g, f["position"][g][1], f["velocity"][g]


def mean_in_bins(run, frames, bin_height):
    """By bin: mass, mean height, mean velocity; of the bins that hold grains, from below."""
    sums = {}
    for g, y, v in mobile_grains(run, frames):
        one = run.mass[g] * np.array([1.0, y, v[0], v[1]])
        n = layer_of(y, bin_height)
        sums[n] = sums.get(n, 0) + one
    return {n: s / s[0] for n, s in sorted(sums.items())}


def profile(run, frames, h):
    """Straight lines through one point per bin of at most half a d_S; beyond the outer points the
    slope over the outer two bins."""
    bin_height = h / math.ceil(h / (run.small_diameter / 2) - 1e-9)
    points = np.array([m[1:] for m in mean_in_bins(run, frames, bin_height).values()])
    heights = points[:, 0]

    def line(a, b, y):
        return a[1:] + (b[1:] - a[1:]) * (y - a[0]) / (b[0] - a[0])

    def at(y):
        n = np.searchsorted(heights, y, side="right")
        if n == 0:
            return line(points[0], points[2], y)
        if n == len(points):
            return line(points[-1], points[-3], y)
        return line(points[n - 1], points[n], y)

    return at


def layer_mean(run, frames, h):
    means = mean_in_bins(run, frames, h)
    return lambda y: means[layer_of(y, h)][2:]


def kinetic_stress(run, frames, h, layers, mean_at):
    """sum m dv (x) dv / V, N/m; grains where their centres are."""
    sigma = {SMALL: tensors(layers), LARGE: tensors(layers)}
    for g, y, v in mobile_grains(run, frames):
        dv = v - mean_at(y)
        sigma[run.species[g]][layer_of(y, h)] += run.mass[g] * np.outer(dv, dv)
    return {which: t / (len(frames) * run.length * h) for which, t in sigma.items()}


def micro(run, frames, h, layers):
    """z: contact ends per grain, both where the grain's centre is. f: mean modulus of the contacts
    with at least one grain of the species, where they touch. The last entry is the whole bed."""
    grains, ends = np.zeros((2, layers)), np.zeros((2, layers))
    contacts, forces = np.zeros((2, layers)), np.zeros((2, layers))
    for f in frames:
        for g in np.flatnonzero(run.mobile):
            grains[run.species[g], layer_of(f["position"][g][1], h)] += 1
        for force, branch, gap, i, j in zip(f["force"], f["branch"], f["gap"], f["i"], f["j"]):
            if not force.any():
                continue
            on = [g for g in (i, j) if run.is_mobile(g)]
            for g in on:
                ends[run.species[g], layer_of(f["position"][g][1], h)] += 1
            r_i, r_j = run.radius[i], run.radius[j] if j >= 0 else 0.0
            part = 1.0 if j < 0 else (r_i + gap / 2) / (r_i + r_j + gap)
            layer = min(layer_of(f["position"][i][1] - part * branch[1], h), layers - 1)
            for species in {run.species[g] for g in on}:
                contacts[species, layer] += 1
                forces[species, layer] += math.hypot(*force)

    def with_bed(a):
        return np.append(a, a.sum(axis=1)[:, None], axis=1)

    with np.errstate(invalid="ignore"):
        return with_bed(ends) / with_bed(grains), with_bed(forces) / with_bed(contacts)


def table(tool, path, options):
    """Rows of a tool's table as dictionaries, by window."""
    text = subprocess.run([tool, path, "--quiet", *options], check=True, capture_output=True,
                          text=True).stdout
    end = text.splitlines()[-1]
    lines = [line.split("\t") for line in text.splitlines() if not line.startswith("# ")]
    if not end.startswith(f"# end: {len(lines) - 1} rows, xxh3 "):
        sys.exit(f"{tool}: the table ends with '{end}', and {len(lines) - 1} rows were read")
    names = [name.split("[")[0] for name in lines[0]]
    windows = {}
    for line in lines[1:]:
        row = dict(zip(names, map(float, line)))
        windows.setdefault(row["t0"], []).append(row)
    return [rows for _, rows in sorted(windows.items())]


def tensor(row, name):
    return np.array([[row[f"{name}_{a}{b}"] for b in "xy"] for a in "xy"])


def compare(what, mine, tools):
    """Fails unless both agree to TOLERANCE of the largest component, or both are NaN."""
    global compared
    mine, tools = np.asarray(mine, dtype=float), np.asarray(tools, dtype=float)
    compared += mine.size
    if np.isnan(mine).all() and np.isnan(tools).all():
        return
    scale = max(abs(mine).max(), abs(tools).max())
    difference = abs(mine - tools).max()
    if not difference <= TOLERANCE * scale:
        sys.exit(f"{what}: the definition gives\n{mine}\nthe tool gives\n{tools}\n"
                 f"they differ by {difference / scale:.3g}, more than {TOLERANCE:g}")


def compare_stress(where, row, mine, base, n):
    volume = row["V"]
    share = {SMALL: tensor(row, "M") - tensor(row, "Msize"), LARGE: tensor(row, "Msize")}
    own = {SMALL: tensor(row, "A_SS"), LARGE: tensor(row, "A_LL")}
    total = tensor(row, "A_SS") + tensor(row, "A_LL") + tensor(row, "M")
    for species in (SMALL, LARGE):
        letter = NAME[species]
        on_base = tensor(row, f"A_{letter}b")
        total = total + on_base
        compare(f"{where}: sigma^{letter}", mine[species][n],
                (own[species] + share[species] + on_base) / volume)
        compare(f"{where}: F_{letter}b", base[species][n], tensor(row, f"F_{letter}b"))
    compare(f"{where}: sigma", mine["all"][n], total / volume)


def quotient(a, b):
    return a / b if b else math.nan


def coordination(row, letter):
    return quotient(row[f"ends_{letter}"], row[f"grains_{letter}"])


def mean_force(row, letter):
    pairs = [letter * 2, "LS", f"{letter}b"]
    return quotient(sum(row[f"sum_f_{p}"] for p in pairs), sum(row[f"n_{p}"] for p in pairs))


def check(bin_folder, path, frames, layer):
    """Two windows, each of half of the frames."""
    run = Run(path, frames)
    half = len(frames) // 2
    h = layer * run.small_diameter
    window = half * run.interval
    options = ["--begin", repr(run.begin), "--end", repr(run.begin + 2 * window), "--window",
               repr(window), "--layer", f"{layer}dS"]
    tables = {tool: table(os.path.join(bin_folder, f"grseg-{tool}"), path, options)
              for tool in ("stress", "kinetic", "micro")}
    tables["layer"] = table(os.path.join(bin_folder, "grseg-kinetic"), path,
                            options + ["--mean", "layer"])
    for number in range(2):
        some = run.frames[number * half:(number + 1) * half]
        layers = layers_of(run, some, h)
        sigma, base = stress(run, some, h, layers), whole_base(run, some, h, layers)
        kinetic = {"kinetic": kinetic_stress(run, some, h, layers, profile(run, some, h)),
                   "layer": kinetic_stress(run, some, h, layers, layer_mean(run, some, h))}
        z, f = micro(run, some, h, layers)
        rows = {tool: windows[number] for tool, windows in tables.items()}
        for tool, got in rows.items():
            expected = layers + (tool == "micro")
            if len(got) != expected or got[0]["frames"] != half:
                sys.exit(f"{path}: grseg-{tool} has {len(got)} rows of {got[0]['frames']} frames, "
                         f"and {expected} of {half} are expected")
        for n in range(layers):
            where = f"{path}, window {number}, layer {n} of {layer} d_S"
            compare(f"{where}: V", run.length * h, rows["stress"][n]["V"])
            compare_stress(where, rows["stress"][n], sigma, base, n)
            for about, mine in kinetic.items():
                for species, letter in NAME.items():
                    row = rows[about][n]
                    compare(f"{where}: sigma^kappa{letter} ({about})", mine[species][n],
                            tensor(row, f"K_{letter}") / row["V"])
        for n in range(layers + 1):
            where = f"{path}, window {number}, " + (f"layer {n}" if n < layers else "whole bed")
            row = rows["micro"][n]
            for species, letter in NAME.items():
                compare(f"{where}: z_{letter}", z[species][n], coordination(row, letter))
                compare(f"{where}: f_{letter}", f[species][n], mean_force(row, letter))


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    bin_folder, sample, scene = sys.argv[1:]
    check(bin_folder, sample, range(150, 154), 4)
    check(bin_folder, sample, range(60, 62), 1.5)
    with tempfile.TemporaryDirectory() as folder:
        fresh = os.path.join(folder, "fresh.h5")
        subprocess.run([os.path.join(bin_folder, "grseg-sim"), scene, "--depth", "12dS", "--length",
                        "10dL", "--phi-large", "0.4", "--duration", "1.5", "--accuracy", "draft",
                        "--quiet", "-o", fresh], check=True)
        check(bin_folder, fresh, range(24, 28), 4)
        check(bin_folder, fresh, range(20, 22), 1.5)
    print(f"{compared} numbers agree to {TOLERANCE:g}")


main()
