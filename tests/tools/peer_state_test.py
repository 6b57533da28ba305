#!/usr/bin/python3
"""The state that scripts/archives/state.py gives other programs is the run's, in units d_S = g = rho = 1.

Usage: peer_state_test.py STATE.py RUN.h5
"""
import subprocess
import sys

import h5py
import numpy as np

exporter, path = sys.argv[1:]


def export(form):
    return subprocess.run([exporter, path, "--to", form], capture_output=True, text=True,
                          check=True).stdout


with h5py.File(path, "r") as run:
    grains, parameters = run["particles/grains"], run["parameters"]
    d = parameters["small_diameter"][()]
    velocity_unit = np.sqrt(d * np.hypot(*parameters["gravity"][:]))
    mass = grains["mass"][:] / (parameters["density"][()] * d**2)
    fixed = grains["fixed"][:] == 1
    large = grains["species"][:] == 1
    half_step = float(parameters["step"][()]) / 2
    length = grains["box/edges"][0]
    velocity = grains["velocity/value"][-1].astype(float)
    end_of_step = grains["position/value"][-1] + half_step * velocity
    spin = grains["angular_velocity/value"][-1]

# The text: every grain once, inside the box, with its own mass, place, velocity and spin.
lines = export("text").splitlines()
box, count = lines[0].split()
assert int(count) == len(lines) - 1 == len(mass)
assert np.isclose(float(box), length / d, rtol=1e-12)
state = np.array([line.split() for line in lines[1:]], float)
assert (state[:, 0] == fixed).all() and fixed.any()
assert (state[:, 1] == np.where(fixed, 1, np.where(large, 2, 3))).all()
assert np.allclose(np.pi * state[:, 2]**2, mass, rtol=1e-6)
assert (state[:, 3] >= 0).all() and (state[:, 3] < float(box)).all()
apart = state[:, 3:5] - end_of_step / d
apart[:, 0] -= float(box) * np.round(apart[:, 0] / float(box))
assert np.abs(apart).max() < 1e-9, np.abs(apart).max()
assert np.allclose(state[:, 5:7] * velocity_unit, velocity, rtol=1e-12)
assert np.allclose(state[:, 7] * velocity_unit / d, spin, rtol=1e-6)
assert (state[fixed, 5:] == 0).all() and (state[~fixed, 5].mean() > 1)

# LAMMPS's and LIGGGHTS's file says the same; its discs have density 1.
sections = export("data").split("\n\n")
assert f"{len(mass)} atoms" in sections[1]
bounds = {line.split()[2]: list(map(float, line.split()[:2]))
          for line in sections[1].splitlines() if line.endswith("hi")}
atoms = np.array([line.split() for line in sections[3].splitlines()], float)
motion = np.array([line.split() for line in sections[5].splitlines()], float)
assert sections[2] == "Atoms" and sections[4] == "Velocities"
assert (atoms[:, 0] == np.arange(1, len(mass) + 1)).all() and (motion[:, 0] == atoms[:, 0]).all()
assert bounds["xlo"] == [0, float(box)]
assert (atoms[:, 5] > bounds["ylo"][0]).all() and (atoms[:, 5] < bounds["ylo"][1]).all()
assert (atoms[:, 1] == state[:, 1]).all() and (atoms[:, 3] == 1).all()
assert np.isclose((np.pi * atoms[:, 2]**2 / 4).sum(), mass.sum(), rtol=1e-6)
assert (atoms[:, 4:6] == state[:, 3:5]).all()
assert (motion[:, [1, 2, 6]] == state[:, 5:]).all() and (motion[:, 3:6] == 0).all()

# An earlier frame where a time is named: that of the last frame up to it.
with h5py.File(path, "r") as run:
    times, grains = run["particles/grains/position/time"][:], run["particles/grains"]
    early = len(times) // 2
    velocity = grains["velocity/value"][early][:, 1].astype(float)
    height = grains["position/value"][early][:, 1] + half_step * velocity
words = subprocess.run([exporter, path, "--to", "text", "--at", repr(float(times[early]) + half_step)],
                       capture_output=True, text=True, check=True).stdout.splitlines()[1:]
assert np.allclose([float(line.split()[4]) for line in words], height / d, rtol=0, atol=1e-9)
