#!/usr/bin/python3
"""Writes the state of a run at the end of a frame's step (default: the last) for other programs.

    tests/bench/peers/state.py run.h5 --to data|text [--at S] [-o FILE]

Units of the output: small nominal diameter = gravity = density (mass per area) = 1. A frame holds
positions at mid-step and velocities after the step; positions are advanced by the other half step and
wrapped into [0, length). Boundary grains are at rest.

    data    the format of LAMMPS (atom_style sphere) and LIGGGHTS (granular). The density 1 is that of
            discs: LIGGGHTS reads it so in two dimensions, LAMMPS after `set group all density/disc 1`
    text    first line: length, number; then fixed(0/1) type radius x y vx vy omega

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
    position: np.ndarray       # [N][2], d_S
    velocity: np.ndarray       # [N][2], sqrt(g d_S)
    spin: np.ndarray           # counter-clockwise, sqrt(g/d_S)

    @property
    def mass(self):
        return np.pi * self.radius**2

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
        g = float(np.hypot(*parameters["gravity"][:]))
        half = float(parameters["step"][()]) / 2
        units = Units(d, (d / g)**0.5)
        length = float(grains["box/edges"][0])
        velocity = grains["velocity/value"][frames - 1].astype(float)
        position = grains["position/value"][frames - 1] + half * velocity
        position[:, 0] %= length
        spin = grains["angular_velocity/value"][frames - 1].astype(float)
        type_ = TYPE_OF_SPECIES[grains["species"][:]]
        velocity[type_ == BASE] = 0
        spin[type_ == BASE] = 0
        state = State(length / d, type_, grains["radius"][:] / d, position / d,
                      velocity / units.velocity, spin * units.time)
        return state, units, float(times[frames - 1]) + half


def write_data(state, out):
    """Atom lines: id type diameter density x y z; the same for both programs."""
    low, high = state.position[:, 1].min() - 4, state.position[:, 1].max() + 60
    out.write(f"state of a grseg run, d_S = g = rho = 1\n\n"
              f"{len(state.type)} atoms\n3 atom types\n0 {state.length:.17g} xlo xhi\n"
              f"{low:.17g} {high:.17g} ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms\n\n")
    for i, (kind, r, (x, y)) in enumerate(zip(state.type, state.radius, state.position), 1):
        out.write(f"{i} {kind} {2 * r:.17g} 1 {x:.17g} {y:.17g} 0\n")
    out.write("\nVelocities\n\n")
    for i, ((u, v), w) in enumerate(zip(state.velocity, state.spin), 1):
        out.write(f"{i} {u:.17g} {v:.17g} 0 0 0 {w:.17g}\n")


def write_text(state, out):
    out.write(f"{state.length:.17g} {len(state.type)}\n")
    for kind, r, (x, y), (u, v), w in zip(state.type, state.radius, state.position, state.velocity,
                                          state.spin):
        numbers = " ".join(f"{value:.17g}" for value in (r, x, y, u, v, w))
        out.write(f"{int(kind == BASE)} {kind} {numbers}\n")


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
