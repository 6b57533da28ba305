# SPDX-License-Identifier: GPL-3.0-or-later
# A first look at a run, cell by cell (# %%: VS Code, Spyder and Jupytext run them one by one). From a clone:
#
#     PYTHONPATH=analysis/python python3 docs/guide/first_look.py

# %% Open a run and see what it is
import pathlib
import sys

import grseg
import numpy as np

run = grseg.Run(sys.argv[1] if len(sys.argv) > 1 else "data/sample/chute.h5")
d_small, d_large = run.small_diameter, run.large_diameter
slope = np.degrees(np.arctan2(run.gravity[0], -run.gravity[1]))
print(f"{run.path}: {len(run)} frames from {run.times[0]:.4g} to {run.times[-1]:.4g} s, version {run.version}")
print(f"{run.mobile.sum()} mobile grains in {run.dimension} dimensions, {d_large / d_small:g} : 1, {slope:.4g} degrees")
print("made by: " + run.history[0])

# %% Go through its frames: how fast it flows, and which species is on top
for frame in run.frames(stride=max(1, len(run) // 8)):
    there = frame.present
    speed = np.average(frame.velocity[there, 0], weights=run.mass[there])
    heights = [frame.position[there & (run.kind == k), 1].mean() / d_small for k in range(len(run.species))]
    words = ", ".join(f"{species.name} {height:.1f} d_S" for species, height in zip(run.species, heights))
    print(f"t = {frame.time:6.2f} s: {speed:.3f} m/s; mean heights: {words}")

# %% Who presses on whom: contacts per grain, and the mean contact force of each pair of species
names = [species.name for species in run.species] + ["base"]
force, number = np.zeros((2, len(names), len(names)))
ends, grains = np.zeros((2, len(run.species)))
for frame in run.frames():
    contacts = frame.contacts
    pushing = contacts.pushing      # the others bear no force
    pair = np.sort([contacts.kind_i[pushing], contacts.kind_j[pushing]], axis=0)
    np.add.at(force, tuple(pair), np.linalg.norm(contacts.force[pushing], axis=1))
    np.add.at(number, tuple(pair), 1)
    np.add.at(ends, run.kind[frame.present], frame.coordination()[frame.present])
    np.add.at(grains, run.kind[frame.present], 1)
print("contacts per grain: " + ", ".join(f"{name} {z:.3f}" for name, z in zip(names, ends / grains)))
for a, b in np.argwhere(number):
    print(f"{names[a]}-{names[b]}: {force[a, b] / number[a, b]:.6g} N, {number[a, b] / len(run):.1f} contacts per frame")

# %% Sums by layer and window, and what rules make of the same forces
points = grseg.Points(run.contact_sums(layer="4dS", window=1.25, power=2))
print(f"{len(points)} layers and windows hold both species")
for rule in ("size", "contact-point", "half", "power:2"):
    fit = points.fit(rule)
    low, high = fit.B_interval
    print(f"B by {rule:13} = {fit.B:+.3f} [{low:+.3f}, {high:+.3f}] (95 % over {fit.over})")
print(f"B = 0 where the larger grain of every mixed contact gets p* = {points.fit().p_zero:.4f}")

# %% So small and short a run tells little. B of 150 s of the paper's chute, from the table of its sums
table = pathlib.Path(run.path).with_name("paper-chute.tsv")
if table.exists():
    fit = grseg.Points(grseg.read_table(table), begin=80).fit()
    low, high = fit.B_interval
    print(f"{table}: B by size = {fit.B:+.3f} [{low:+.3f}, {high:+.3f}]")

# %% B over that share
shares = np.linspace(0.4, 0.9, 11)
b = points.b_of_p(shares)
for p, value in zip(shares, b):
    print(f"p = {p:.2f}: B = {value:+.3f}")

# %% The stress ratio over the ratio of areas with its fit, and B(p)
try:
    import matplotlib.pyplot as plt
except ImportError:
    plt = None
    print("no figure: matplotlib (python3-matplotlib) is not installed")

if plt:
    small, large, _ = points.stresses("size")
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 4), layout="constrained")
    left.loglog(points.x, small / large, "o", alpha=0.6)
    x = np.array([points.x.min(), points.x.max()])
    left.loglog(x, points.fit("size").paper_s * x, "k-")
    left.set(xlabel=r"$\phi_S/\phi_L$", ylabel=r"$\sigma^S/\sigma^L$ by size")
    right.plot(shares, b, "o-")
    right.axhline(0, color="k", linewidth=0.8)
    right.set(xlabel="share of a mixed contact for its larger grain, p", ylabel="B")
    figure.savefig("first_look.png", dpi=150)
    print("first_look.png shows it")

run.close()
