#!/usr/bin/python3
"""Computes the numbers that the tools print from the raw file, by their definitions and with no code of grseg.

Usage: recompute.py BIN RUN.h5 SCENE.ini

For a few frames of RUN.h5, of a short fresh run of SCENE.ini, and of runs without symmetries in two
and three dimensions and of two and three species, in some of which grains come and go: sums of force
(x) branch by pair of species under three assignments, partial stresses by three rules, volumes of
grains, kinetic stresses about four means of the velocities after a step and in its middle,
coordination z and mean force f, divergence of stress and interaction of each species by five rules,
by layer; then BIN/grseg-stress, grseg-kinetic, grseg-micro and grseg-balance on the same frames.
Every number must agree to 1e-10 of the largest
component of its tensor. Then faults are put into the data read here (raw_run.py); each of them must
cause a difference.
"""
import collections
import itertools
import math
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

import definitions as by_definition
from raw_run import Run, faults_of
from tool_tables import Columns, keys, table

TOLERANCE = 1e-10
SYNTHETIC = ((2, "small,large"), (2, "fine,middle,coarse"), (3, "small,large"),
             (3, "fine,middle,coarse"), (2, "small,large", "changing"),
             (3, "fine,middle,coarse", "changing"))
RULES = ("size", "contact-point", "half", "drop", f"power:{by_definition.POWER:g}")
ASSIGNMENTS = ("contact-point", "branch", "grain")
MEANS = ("profile", "layer", "instant", "instant-unbiased", "profile-unbiased")
compared, largest = 0, 0.0  # numbers; largest difference in units of its bound


class Difference(Exception):
    pass


def compare(what, mine, tools, terms=0.0):
    """True if both numbers agree to TOLERANCE times the largest component, or times the largest of the `terms`
    whose difference they are, or if both are NaN."""
    global compared, largest
    mine, tools = np.asarray(mine, dtype=float), np.asarray(tools, dtype=float)
    compared += mine.size
    if np.isnan(mine).all() and np.isnan(tools).all():
        return
    if mine.shape != tools.shape:
        raise Difference(f"{what}: the shapes {mine.shape} and {tools.shape} differ")
    scale = max(abs(mine).max(), abs(tools).max(), np.abs(terms).max())
    difference = abs(mine - tools).max()
    if scale > 0:
        largest = max(largest, difference / (TOLERANCE * scale))
    if not difference <= TOLERANCE * scale:
        raise Difference(f"{what}: the definition gives\n{mine}\nthe tool gives\n{tools}\n"
                         f"they differ by {difference / scale:.3g}, more than {TOLERANCE:g}")


def quotient(a, b):
    return a / b if b else math.nan


class Window:
    """Some frames of a run, divided into layers or annuli of thickness h. `sizes`: for each tool, the sum of the
    magnitudes of all terms that it adds; by default, results are compared relative to their own size."""

    def __init__(self, run, frames, h, where, composition="clipped", sizes=None):
        self.composition, self.sizes = composition, sizes or collections.defaultdict(float)
        self.run, self.frames, self.h, self.where = run, frames, h, where
        self.layers = by_definition.layers_of(run, frames, h)
        self.columns = Columns(run)

    def definition(self, what, *more):
        return what(self.run, self.frames, self.h, self.layers, *more)

    def place(self, n):
        return f"{self.where}, " + (f"layer {n}" if n < self.layers else "whole bed")

    def require_rows(self, rows, expected):
        if len(rows) != expected or rows[0]["frames"] != len(self.frames):
            raise Difference(f"{self.where}: {len(rows)} rows of {rows[0]['frames']} frames, and "
                             f"{expected} of {len(self.frames)} are expected")

    def check_stress(self, rows, assignment):
        run, columns = self.run, self.columns
        self.require_rows(rows, self.layers)
        sums, numbers = self.definition(by_definition.contact_sums, assignment)
        content = self.definition(by_definition.volumes, self.composition)
        moved = [(f"{columns.content}_{name}", self.definition(by_definition.volumes, self.composition, of).sum(axis=0))
                 for name, of in (("u", lambda v: v[0]), ("v2", lambda v: v[:run.dimension] @ v[:run.dimension]))]
        for n, row in enumerate(rows):
            where = f"{self.place(n)}, {assignment}"
            compare(f"{where}: V", run.volume_of_layer(self.h, n), row["V"])
            for name, mine in moved:
                compare(f"{where}: {name}", mine[n], row[name], row["V"] * self.sizes[name.split("_")[1]])
            for s in range(run.species_count):
                name = f"{columns.content}_{columns.names[s]}"
                compare(f"{where}: {name}", content[s][n], row[name], row["V"])
            for key in keys(run, assignment):
                name = columns.sum(key)
                compare(f"{where}: {name}", sums[key][n], columns.tensor(row, name), self.sizes["stress"])
            for count in (1, 2):
                for ends in itertools.combinations_with_replacement(range(run.species_count), count):
                    # Contacts with a single species: with the base.
                    name = columns.with_base(ends[0]) if len(ends) == 1 else columns.pair(*ends)
                    compare(f"{where}: n_{name}", numbers[ends][n], row[f"n_{name}"])
        if assignment != "grain" and run.axis is None:
            self.check_stresses(rows, sums)

    def check_stresses(self, rows, sums):
        """Stress of each species under three rules, and total stress, from the tool's columns."""
        run, columns = self.run, self.columns
        for rule in ("Msize", "Mcp", "Mpower"):
            mine = by_definition.partial_stresses(run, sums, self.h, rule)
            for n, row in enumerate(rows):
                of_tool = {key: columns.tensor(row, columns.sum(key)) for key in keys(run, "")}
                tools = by_definition.partial_stresses(run, of_tool, self.h, rule)
                terms = max(abs(sum).max() for sum in of_tool.values()) + self.sizes["stress"]
                terms /= run.volume_of_layer(self.h)
                for s, name in enumerate(columns.names):
                    compare(f"{self.place(n)}: sigma^{name} by {rule}", mine[s][n], tools[s], terms)
                compare(f"{self.place(n)}: sigma", sum(mine)[n], sum(tools), terms)

    def fluctuations(self, mean, frames):
        """Fluctuations by their definition: K and Kr; about an unbiased mean also masses and grains left out."""
        of = (self.run, frames, self.h, self.layers)
        if mean == "instant-unbiased":
            return by_definition.unbiased_fluctuations(*of)
        if mean == "profile-unbiased":
            return by_definition.about_profile_of_others(*of)
        if mean == "instant":
            return by_definition.about_each_frame(*of)
        mean_at = {"profile": by_definition.profile, "layer": by_definition.layer_mean}[mean]
        return by_definition.fluctuations(*of, mean_at(self.run, frames, self.h))

    def check_kinetic(self, rows, mean, velocity):
        columns = self.columns
        self.require_rows(rows, self.layers)
        frames = self.frames
        if velocity == "middle":
            frames = by_definition.in_mid_step(self.run, frames)
        kinetic, rotational, *more = self.fluctuations(mean, frames)
        # If a grain is its own mean, both results are the square of round-off.
        of_rest, of_no_spin = by_definition.fluctuations(self.run, frames, self.h, self.layers,
                                                         lambda y: 0)
        for n, row in enumerate(rows):
            for s, name in enumerate(columns.names):
                where = f"{self.place(n)}, about the {mean}, {velocity}"
                compare(f"{where}: K_{name}", kinetic[s][n], columns.tensor(row, f"K_{name}"),
                        np.append(1e-12 * of_rest[s][n], self.sizes["kinetic"]))
                compare(f"{where}: Kr_{name}", rotational[s][n], row[f"Kr_{name}"],
                        np.append(1e-12 * of_no_spin[s][n], self.sizes["spin"]))
                for column, mine in zip(("mass", "left_out"), more):
                    compare(f"{where}: {column}_{name}", mine[s][n], row[f"{column}_{name}"])

    def check_micro(self, rows):
        columns = self.columns
        self.require_rows(rows, self.layers + 1)
        z, f = self.definition(by_definition.coordination_and_force)
        for n, row in enumerate(rows):
            for s, name in enumerate(columns.names):
                pairs = columns.pairs_of(s)
                compare(f"{self.place(n)}: z_{name}", z[s][n],
                        quotient(row[f"ends_{name}"], row[f"grains_{name}"]))
                compare(f"{self.place(n)}: f_{name}", f[s][n],
                        quotient(sum(row[f"sum_f_{p}"] for p in pairs),
                                 sum(row[f"n_{p}"] for p in pairs)))

    def check_balance(self, rows, rules=RULES):
        run, columns = self.run, self.columns
        self.require_rows(rows, self.layers)
        volume = run.volume_of_layer(self.h)
        for rule in rules:
            of_rule = self.definition(by_definition.forces_by_rule, rule, run.small_diameter)
            names = (f"contact_{{}}_{{}}@{rule}", f"interaction_{{}}_{{}}@{rule}", "N_{}_{}")
            for n, row in enumerate(rows):
                terms = max(self.sizes["balance"], *(abs(of_all[:, n]).max() for of_all in of_rule)) / volume
                for name, of_all in zip(names, of_rule):
                    for s, species in enumerate(columns.names):
                        tools = [row[name.format(species, axis)] for axis in columns.axes]
                        compare(f"{self.place(n)}: {name.format(species, '*')}",
                                of_all[s][n] / volume, tools, terms)


def check(bin_folder, path, frames, layer, fault=None):
    """Two windows, each with half of the frames."""
    run = Run(path, frames)
    half, h = len(frames) // 2, layer * run.small_diameter
    length = half * run.interval
    common = ("--begin", repr(run.begin), "--end", repr(run.begin + 2 * length), "--window",
              repr(length), "--layer", f"{layer}dS")
    if fault:
        fault(run)

    def rows_of(tool, *options):
        return table(os.path.join(bin_folder, f"grseg-{tool}"), path, common + options)

    for number in range(2):
        window = Window(run, run.frames[number * half:(number + 1) * half], h,
                        f"{path}, layers of {layer} d_S, window {number}")
        for assignment in ASSIGNMENTS:
            rows = rows_of("stress", "--assign", assignment, "--composition", "clipped",
                           "--partition", f"power:{by_definition.POWER:g}")
            window.check_stress(rows[number], assignment)
        for mean, velocity in itertools.product(MEANS, ("after", "middle")):
            rows = rows_of("kinetic", "--mean", mean, "--velocity", velocity)
            window.check_kinetic(rows[number], mean, velocity)
        window.check_balance(rows_of("balance", "--partition", ",".join(RULES))[number])
        if window.columns.two:
            window.check_micro(rows_of("micro")[number])


def check_mid_step(path):
    """In consecutive frames, velocity and spin in the middle of a step are the means of the values stored before
    and after it."""
    with h5py.File(path, "r") as f:
        steps = f["particles/grains/position/step"][:]
    pairs = [k for k in range(1, len(steps)) if steps[k] == steps[k - 1] + 1]
    if len(pairs) < 5:
        raise Difference(f"{path}: {len(pairs)} pairs of consecutive steps")
    for k in pairs[-5:]:
        run = Run(path, range(k - 1, k + 1))
        before, after = run.frames
        middle = by_definition.in_mid_step(run, [after])[0]
        for name in ("velocity", "spin"):
            mean = (before[name] + after[name]) / 2
            compare(f"{path}, frame {k}: {name} in the middle of the step", mean[run.mobile],
                    middle[name][run.mobile])


def require_that_faults_show(bin_folder, path, frames, layer):
    faults = faults_of(Run(path, frames))
    for what, fault in faults.items():
        try:
            check(bin_folder, path, frames, layer, fault)
        except Difference:
            continue
        sys.exit(f"{path}: {what}: no number differs")
    return len(faults)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    bin_folder, sample, scene = sys.argv[1:]
    faults = 0
    try:
        check(bin_folder, sample, range(150, 154), 4)
        check(bin_folder, sample, range(60, 62), 1.5)
        with tempfile.TemporaryDirectory() as folder:
            fresh = os.path.join(folder, "fresh.h5")

            def simulate(path, *options):
                subprocess.run([os.path.join(bin_folder, "grseg-sim"), scene, "--depth", "12dS",
                                "--length", "10dL", "--phi-large", "0.4", "--accuracy", "draft",
                                "--quiet", "-o", path, *options], check=True)

            simulate(fresh, "--duration", "1.5")
            check(bin_folder, fresh, range(24, 28), 4)
            check(bin_folder, fresh, range(20, 22), 1.5)
            bursts = os.path.join(folder, "bursts.h5")
            simulate(bursts, "--duration", "0.4", "--burst", "2")
            check_mid_step(bursts)
            for dimension, *words in SYNTHETIC:
                run = os.path.join(folder, f"{dimension}-{'-'.join(words)}.h5")
                subprocess.run([os.path.join(bin_folder, "synthetic_run"), run, str(dimension), *words],
                               check=True)
                check(bin_folder, run, range(2, 6), 3)
                check(bin_folder, run, range(0, 2), 1.2)
                faults += require_that_faults_show(bin_folder, run, range(0, 4), 3)
    except Difference as difference:
        sys.exit(str(difference))
    print(f"{compared} numbers agree to {TOLERANCE:g}, and {faults} faults show")


if __name__ == "__main__":
    main()
