#!/usr/bin/python3
"""Writes the state of a run at the end of a frame's step (default: the last) for other programs.

    tests/bench/peers/state.py run.h5 --to data|text [--at S] [-o FILE]

Units of the output: small nominal diameter = gravity = density = 1 (discs: mass per area). A frame holds
positions at mid-step and velocities after the step; positions are advanced by the other half step and
wrapped into [0, length), those of spheres also into [0, width) along z. Boundary grains are at rest.

    data    the format of LAMMPS (atom_style sphere) and LIGGGHTS (granular). The density 1 is that of
            discs: LIGGGHTS reads it so in two dimensions, LAMMPS after `set group all density/disc 1`.
            The density 1 of spheres is mass per volume
    text    first line: length, number; then fixed(0/1) type radius x y vx vy omega; of spheres, all three
            components of each vector

Types: 1 boundary, 2 large, 3 small. Ids count from 1 in the order of the run.
"""
import argparse
import dataclasses
import math
import sys

import h5py
import numpy as np

BASE, LARGE, SMALL = 1, 2, 3
TYPE_OF_SPECIES = np.array([SMALL, LARGE, BASE])


@dataclasses.dataclass
class State:
    length: float              # period of the cell along x, d_S
    type: np.ndarray           # BASE, LARGE, SMALL
    radius: np.ndarray         # d_S
    position: np.ndarray       # [N][dimension], d_S
    velocity: np.ndarray       # [N][dimension], sqrt(g d_S)
    spin: np.ndarray           # [N], counter-clockwise, or [N][3]; sqrt(g/d_S)
    width: float = 1.0         # period of the cell along z, d_S; 1 for discs
    slope: float = 0.0         # degrees

    @property
    def dimension(self):
        return self.position.shape[1]

    @property
    def mobile(self):
        return self.type != BASE


@dataclasses.dataclass
class Units:
    """SI values of the units of length, time and mass."""
    length: float
    time: float

    @property
    def velocity(self):
        return self.length / self.time


def read_run(path, at=math.inf):
    """State after the step of the last frame up to `at` s, its units, and its time in s."""
    with h5py.File(path, "r") as run:
        grains, parameters = run["particles/grains"], run["parameters"]
        times = grains["position/time"][:len(run["grseg/contacts/offset"]) - 1]
        frames = int(np.searchsorted(times, at, "right"))
        if frames < 1:
            sys.exit(f"{path}: holds no frame up to {at:g} s; let the run flow for at least one step")
        d = float(parameters["small_diameter"][()])
        g = float(np.hypot.reduce(parameters["gravity"][:]))
        half = float(parameters["step"][()]) / 2
        units = Units(d, (d / g)**0.5)
        length, _, *width = map(float, grains["box/edges"][:])
        velocity = grains["velocity/value"][frames - 1].astype(float)
        position = grains["position/value"][frames - 1] + half * velocity
        position[:, ::2] %= [length, *width]
        spin = grains["angular_velocity/value"][frames - 1].astype(float)
        type_ = TYPE_OF_SPECIES[grains["species"][:]]
        velocity[type_ == BASE] = 0
        spin[type_ == BASE] = 0
        state = State(length / d, type_, grains["radius"][:] / d, position / d,
                      velocity / units.velocity, spin * units.time,
                      *(w / d for w in width), slope=float(parameters["slope"][()]))
        return state, units, float(times[frames - 1]) + half


def words(numbers):
    return " ".join(f"{number:.17g}" for number in numbers)


def write_data(state, out):
    """Atom lines: id type diameter density x y z; the same for both programs."""
    low, high = state.position[:, 1].min() - 4, state.position[:, 1].max() + 60
    out.write(f"state of a grseg run, d_S = g = rho = 1\n\n"
              f"{len(state.type)} atoms\n3 atom types\n0 {state.length:.17g} xlo xhi\n"
              f"{low:.17g} {high:.17g} ylo yhi\n{-state.width / 2:.17g} {state.width / 2:.17g} zlo zhi\n\n"
              "Atoms\n\n")
    flat = 3 - state.dimension
    position, velocity = (np.pad(field, ((0, 0), (0, flat))) for field in (state.position, state.velocity))
    spin = np.pad(state.spin.reshape(len(velocity), -1), ((0, 0), (flat and 2, 0)))
    for i, (kind, r, x) in enumerate(zip(state.type, state.radius, position), 1):
        out.write(f"{i} {kind} {2 * r:.17g} 1 {words(x)}\n")
    out.write("\nVelocities\n\n")
    for i, motion in enumerate(np.hstack([velocity, spin]), 1):
        out.write(f"{i} {words(motion)}\n")


def write_text(state, out):
    out.write(f"{state.length:.17g} {len(state.type)}\n")
    rows = np.column_stack([state.radius, state.position, state.velocity, state.spin])
    for kind, row in zip(state.type, rows):
        out.write(f"{int(kind == BASE)} {kind} {words(row)}\n")


WRITERS = {"data": write_data, "text": write_text}


def main():
    options = argparse.ArgumentParser(description=__doc__,
                                      formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("run")
    options.add_argument("--to", choices=WRITERS, required=True)
    options.add_argument("--at", type=float, default=math.inf, metavar="S",
                         help="the last frame up to this time")
    options.add_argument("-o", "--output")
    given = options.parse_args()
    state, _, _ = read_run(given.run, given.at)
    if given.output is None:
        WRITERS[given.to](state, sys.stdout)
    else:
        with open(given.output, "w") as out:
            WRITERS[given.to](state, out)


if __name__ == "__main__":
    main()
