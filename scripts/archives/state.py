#!/usr/bin/python3
"""Writes the state of a run at the end of a frame's time step (default: last frame) as a file that LAMMPS (atom_style
sphere) and LIGGGHTS (granular) both read.

    scripts/archives/state.py run.h5 [--at S] [-o FILE]

Units of the output: small nominal diameter = gravity = density (mass per area) = 1. A frame includes positions at
mid-step and velocities after the step, so positions are advanced by half a step and wrapped into [0, length). Boundary
grains are at rest. The density 1 is mass per area of discs. LIGGGHTS reads it so in two dimensions; LAMMPS needs
`set group all density/disc 1`.

Types: 1 boundary, 2 large, 3 small. Ids are 1, 2, ... in the order of the run.
"""
import argparse
import math
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import shared  # noqa: E402, F401 (grseg's folder)
import grseg  # noqa: E402

TYPE_OF_SPECIES = np.array([3, 2, 1])


def state(run, at):
    """Length of the period; type, diameter, position, velocity and spin of each grain after the step of the last frame
    with time <= `at` (s)."""
    frames = int(np.searchsorted(run.times, at, "right"))
    if frames < 1:
        sys.exit(f"{run.path}: there is no frame up to {at:g} s; use a later --at, or a run of at least one step")
    frame, d = run[frames - 1], run.small_diameter
    second = (d / np.hypot(*run.gravity))**0.5
    position = frame.position + run.step / 2 * frame.velocity
    position[:, 0] %= run.length
    moves = run.kind < 2
    velocity, spin = (np.where(moves, field.T, 0).T for field in (frame.velocity, frame.angular_velocity))
    return run.length / d, TYPE_OF_SPECIES[run.kind], 2 * run.radius / d, position / d, velocity / (d / second), spin * second


def write(out, length, kind, diameter, position, velocity, spin):
    low, high = position[:, 1].min() - 4, position[:, 1].max() + 60
    out.write(f"state of a grseg run, d_S = g = rho = 1\n\n"
              f"{len(kind)} atoms\n3 atom types\n0 {length:.17g} xlo xhi\n"
              f"{low:.17g} {high:.17g} ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms\n\n")
    for i, (type_, d, (x, y)) in enumerate(zip(kind, diameter, position), 1):
        out.write(f"{i} {type_} {d:.17g} 1 {x:.17g} {y:.17g} 0\n")
    out.write("\nVelocities\n\n")
    for i, ((u, v), w) in enumerate(zip(velocity, spin), 1):
        out.write(f"{i} {u:.17g} {v:.17g} 0 0 0 {w:.17g}\n")


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("run")
    options.add_argument("--at", type=float, default=math.inf, metavar="S", help="write the last frame up to this time")
    options.add_argument("-o", "--output", type=argparse.FileType("w"), default=sys.stdout)
    given = options.parse_args()
    with grseg.Run(given.run) as run:
        write(given.output, *state(run, given.at))


if __name__ == "__main__":
    main()
