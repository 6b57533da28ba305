#!/usr/bin/python3
"""Grains that have left a hopper, of discs or spheres, are in no layer of any tool's table, nor in maps xz, which sum over the height of the bed:
no layer or cell holds more grains than fit into it, and all together hold the grains that are still in the bed. Their forces on these grains
count, so that each grain's balance closes. Other maps and annuli hold all grains, and spheres whole.

Usage: hopper_test.py FOLDER-OF-PROGRAMS hopper.ini
"""
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

BIN, SCENE = map(os.path.abspath, sys.argv[1:])
DENSEST = {2: 0.91, 3: 0.75}  # solid fraction
CONTACTS = "n_SS", "n_LS", "n_LL", "n_Sb", "n_Lb"
SIZE = {2: ("--length", "32dS"), 3: ("--dimension", "3", "--length", "12dS", "--width", "8dS")}


def run(tool, *arguments):
    return subprocess.run([f"{BIN}/grseg-{tool}", *arguments, "--overwrite"], check=True, capture_output=True, text=True).stderr


def table(tool, *arguments):
    """Columns of the tool's table, without the rows of the whole bed, and its remarks."""
    remarks = run(tool, "run.h5", "--window", "all", "--begin", "0.1", *arguments, "-o", f"{tool}.tsv")
    with open(f"{tool}.tsv", encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file if not line.startswith("#")]
    names = [name.split("[")[0] for name in lines[0]]
    values = np.array([[float(number) for number in line] for line in lines[1:]])
    return dict(zip(names, values[~np.isnan(values[:, 2])].T)), remarks


def counts_of_run():
    """Means per frame, by definition: mobile grains, those in the bed, their area or volume, and contacts among them."""
    with h5py.File("run.h5") as file:
        grains = file["particles/grains"]
        used = grains["position/time"][:] > 0.1
        y, radius, mobile = grains["position/value"][used, :, 1], grains["radius"][:], grains["fixed"][:] == 0
        bottom = np.minimum(y[:, ~mobile].min(axis=1), -2 * radius[mobile].max())
        inside = mobile & (y >= bottom[:, None])
        contacts, offset = file["grseg/contacts"], file["grseg/contacts/offset"][:]
        i, j, pushing = contacts["i"][:], contacts["j"][:], contacts["force"][:].any(axis=1)
        number = across = 0
        for frame, there in zip(np.flatnonzero(used), inside):
            own = slice(offset[frame], offset[frame + 1])
            both = there[i[own]] & (there[j[own]] | (j[own] < 0) | ~mobile[j[own]])
            number += (pushing[own] & both).sum()
            across += (pushing[own] & (j[own] >= 0) & mobile[j[own]] & (there[i[own]] != there[j[own]])).sum()
        content = np.pi * radius**2 if grains["position/value"].shape[2] == 2 else 4 * np.pi / 3 * radius**3
        frames = used.sum()
        return {"mobile": mobile.sum(), "inside": inside.sum() / frames, "content": (inside * content).sum() / frames,
                "whole": content[mobile].sum(), "contacts": number / frames, "across": across, "mass": (inside * grains["mass"][:]).sum() / frames}


def total(columns, *names):
    return sum(columns[name].sum() for name in names if name in columns)


def check(dimension):
    run("sim", SCENE, "--depth", "16dS", "--outlet", "8dS", "--size-ratio", "2", "--phi-large", "0.3", *SIZE[dimension], "--duration", "0.7",
        "--frame-interval", "0.02", "--accuracy", "draft", "-o", "run.h5")
    known = counts_of_run()
    assert known["inside"] < 0.7 * known["mobile"], "few grains have left"
    stress, remarks = table("stress")
    assert "grains below the base, up to" in remarks and "--bins xy" in remarks, remarks
    content = [f"{'area' if dimension == 2 else 'volume'}_{species}" for species in "SL"]
    solid = sum(stress[name] for name in content) / stress["V"]
    assert solid.max() < DENSEST[dimension], solid
    kinetic, _ = table("kinetic")
    micro, _ = table("micro")
    segregation, _ = table("segregation")
    balance, _ = table("balance")
    found = {
        "content": (total(stress, *content), total(segregation, *content)),
        "contacts": (total(stress, *CONTACTS), total(micro, *CONTACTS)),
        "inside": (total(kinetic, "grains_S", "grains_L"),),
        "mass": (total(kinetic, "mass_S", "mass_L"), (balance["V"] * (balance["rho_S"] + balance["rho_L"])).sum()),
    }
    for what, numbers in found.items():
        assert np.allclose(numbers, known[what], rtol=1e-12), (dimension, what, numbers, known[what])
    residual = max(abs(balance[name]).max() for name in balance if name.startswith("residual_"))
    assert residual < 1e-9 * max(abs(balance[name]).max() for name in balance if name.startswith("gravity_")), residual
    assert known["across"] > 0, "no grain of the bed touches one that has left"
    whole, remarks = table("kinetic", "--bins", "xy")
    assert np.isclose(total(whole, "grains_S", "grains_L"), known["mobile"], rtol=1e-12) and "below the base" not in remarks, remarks

    if os.path.exists(f"{BIN}/grseg-report"):
        run("report", "run.h5", "--window", "all", "--begin", "0.1", "-o", "page.html")
        with open("page.html", encoding="utf-8") as page:
            assert "grains below the base, up to" in page.read()
    if dimension == 3:
        run("micro", "run.h5", "--window", "all", "--begin", "0.1", "-o", "micro.tsv")
        with open("micro.tsv", encoding="utf-8") as file:
            rows = [line.split("\t") for line in file if not line.startswith("#")]
        place = [name.split("[")[0] for name in rows[0]].index("height")
        height = next(float(row[place]) for row in rows[1:] if row[2] == "nan")
        above, _ = table("stress", "--bins", "xz", "--layer", "2dS")
        with open("stress.tsv", encoding="utf-8") as file:
            assert f"# height: {height:.17g}\n" in file.read(), height
        assert above["nu"].max() < 1, above["nu"].max()  # above the mean of the bed where its surface is higher than the mean
        assert np.isclose(total(above, *content), known["content"], rtol=1e-12)
        assert np.isclose(total(above, *CONTACTS), known["contacts"], rtol=1e-12)
        coordination, _ = table("micro", "--bins", "xz", "--layer", "2dS")
        run("micro", "run.h5", "--window", "all", "--begin", "0.1", "--bins", "xz", "--layer", "2dS", "-o", "map.h5")
        with h5py.File("map.h5") as file:
            assert np.allclose(file["z"], np.unique((coordination["z0"] + coordination["z1"]) / 2))
            assert np.array_equal(file["z_all"][:].ravel(), coordination["z"], equal_nan=True)
    annuli = "--bins", "radius:30mm,20mm", "--layer", "2dS"
    if dimension == 3:
        stress, remarks = table("stress", *annuli)
        assert np.isclose(total(stress, *content), known["whole"], rtol=1e-12) and "below the base" not in remarks, remarks
        with open("stress.tsv", encoding="utf-8") as file:
            assert "# composition: centre\n" in file.read()
        refused = subprocess.run([f"{BIN}/grseg-stress", "run.h5", "--window", "all", *annuli, "--composition", "clipped"], check=False,
                                 capture_output=True, text=True)
        assert refused.returncode == 2 and "spheres are not clipped at annuli; use --composition centre" in refused.stderr, refused


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for of_grains in 2, 3:
        check(of_grains)
