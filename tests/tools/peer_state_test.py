#!/usr/bin/python3
"""The state that scripts/archives/state.py writes for other programs equals the run's state, in units d_S = g = rho = 1.

Usage: peer_state_test.py STATE.py RUN.h5
"""
import subprocess
import sys

import h5py
import numpy as np

exporter, path = sys.argv[1:]


def export(*words):
    """Period, bounds by name, rows of the sections Atoms and Velocities, and the number of grains."""
    text = subprocess.run([exporter, path, *words], capture_output=True, text=True, check=True).stdout
    sections = text.split("\n\n")
    assert sections[2] == "Atoms" and sections[4] == "Velocities"
    bounds = {line.split()[2]: list(map(float, line.split()[:2]))
              for line in sections[1].splitlines() if line.endswith("hi")}
    atoms, motion = (np.array([line.split() for line in sections[k].splitlines()], float) for k in (3, 5))
    return bounds, atoms, motion, int(sections[1].split()[0])


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

# Every grain appears once, inside the box, with its own mass, position, velocity and spin; discs have density 1.
bounds, atoms, motion, count = export()
box = bounds["xlo"][1]
assert count == len(atoms) == len(motion) == len(mass)
assert bounds["xlo"][0] == 0 and np.isclose(box, length / d, rtol=1e-12)
assert fixed.any() and (atoms[:, 1] == np.where(fixed, 1, np.where(large, 2, 3))).all() and (atoms[:, 3] == 1).all()
assert (atoms[:, 0] == np.arange(1, len(mass) + 1)).all() and (motion[:, 0] == atoms[:, 0]).all()
assert np.allclose(np.pi * atoms[:, 2]**2 / 4, mass, rtol=1e-6)
assert (atoms[:, 4] >= 0).all() and (atoms[:, 4] < box).all() and (atoms[:, 6] == 0).all()
assert (atoms[:, 5] > bounds["ylo"][0]).all() and (atoms[:, 5] < bounds["ylo"][1]).all()
apart = atoms[:, 4:6] - end_of_step / d
apart[:, 0] -= box * np.round(apart[:, 0] / box)
assert np.abs(apart).max() < 1e-9, np.abs(apart).max()
assert np.allclose(motion[:, 1:3] * velocity_unit, velocity, rtol=1e-12)
assert np.allclose(motion[:, 6] * velocity_unit / d, spin, rtol=1e-6) and (motion[:, 3:6] == 0).all()
assert (motion[fixed, 1:] == 0).all() and (motion[~fixed, 1].mean() > 1)

# If a time is named, the state is that of the last frame up to this time.
with h5py.File(path, "r") as run:
    times, grains = run["particles/grains/position/time"][:], run["particles/grains"]
    early = len(times) // 2
    velocity = grains["velocity/value"][early][:, 1].astype(float)
    height = grains["position/value"][early][:, 1] + half_step * velocity
_, atoms, _, _ = export("--at", repr(float(times[early]) + half_step))
assert np.allclose(atoms[:, 5], height / d, rtol=0, atol=1e-9)
