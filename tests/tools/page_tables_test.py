#!/usr/bin/python3
"""The tables by layer of a page are means over all frames of the rows that the tools print, of grains of two densities, too. A window that
does not reach up to a layer counts as an empty layer; "frames" leaves it out.

Usage: page_tables_test.py FOLDER-OF-PROGRAMS chute.ini
"""
import json
import os
import re
import subprocess
import sys
import tempfile

import numpy as np

BIN, SCENE = map(os.path.abspath, sys.argv[1:])
CUT = "--window", "0.1", "--layer", "1dS"


def run(tool, *arguments):
    subprocess.run([f"{BIN}/grseg-{tool}", *arguments, "--quiet", "--overwrite"], check=True, capture_output=True)


def table(tool, *arguments):
    """Columns of a table without the rows of the whole bed."""
    run(tool, *arguments, "-o", f"{tool}.tsv")
    with open(f"{tool}.tsv", encoding="utf-8") as file:
        lines = [line.rstrip("\n").split("\t") for line in file if not line.startswith("#")]
    values = np.array([[float(number) for number in line] for line in lines[1:]])
    return dict(zip([name.split("[")[0] for name in lines[0]], values[~np.isnan(values[:, 2])].T))


def mean(rows, values, bottom, empty, frames_of_all):
    """Mean of one layer over all frames, and the frames of its rows; `empty`: the number of an empty layer."""
    own = abs(rows["y0"] - bottom) < 1e-9
    frames, values = rows["frames"][own], values[own]
    there = np.isfinite(values)
    total, weight = (frames * values)[there].sum(), frames[there].sum()
    if np.isfinite(empty):
        weight += frames_of_all - frames.sum()
    return total / weight if weight > 0 else np.nan, frames.sum()


def check(page, tool, rows, columns):
    """`columns`: for some of the page's columns their values by row, and the number of an empty layer."""
    one = next(one for one in page["tables"] if one["tool"] == f"grseg-{tool}")
    names = [name.split("[")[0] for name in one["columns"]]
    windows = {(t0, frames) for t0, frames in zip(rows["t0"], rows["frames"])}
    frames_of_all = sum(frames for _, frames in windows)
    partly = 0
    for row, frames in zip(one["rows"], one["frames"]):
        for name, (values, empty) in columns.items():
            expected, own = mean(rows, values, row[0], empty, frames_of_all)
            found = np.nan if row[names.index(name)] is None else row[names.index(name)]
            assert frames == own, (tool, row[0], frames, own)
            assert np.isclose(found, expected, rtol=1e-9, atol=1e-12, equal_nan=True), (tool, name, row[0], found, expected)
        partly += frames < frames_of_all
    assert partly > 0, f"every window reaches every layer of {tool}"


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    run("sim", SCENE, "--depth", "10dS", "--length", "8dL", "--initial", "mixed", "--density-ratio", "10", "--slope", "26", "--duration", "1",
        "--frame-interval", "0.02", "--accuracy", "draft", "-o", "run.h5")
    run("report", "run.h5", *CUT, "--heights", "all", "-o", "page.html")
    with open("page.html", encoding="utf-8") as page:
        content = re.search(r'<script type="application/json" id="content">(.*?)</script>', page.read(), re.S)[1]
    layers = json.loads(content)["runs"][0]["layers"]
    stress = table("stress", "run.h5", *CUT)
    solid = stress["area_S"] + stress["area_L"]
    sigma = sum(stress[f"{name}_yy"] for name in ("A_SS", "A_LL", "M", "A_Sb", "A_Lb")) / stress["V"]
    with np.errstate(invalid="ignore"):
        check(layers, "stress", stress, {"nu": (solid / stress["V"], 0), "sigma_yy": (sigma, 0), "phi_L": (stress["area_L"] / solid, np.nan)})
    table("micro", "run.h5", *CUT)
    derived = table("derive", "micro.tsv")
    check(layers, "derive", derived, {name: (derived[name], np.nan) for name in
                                      ("z_S", "f_S", "f_weight_S", "f_weight_neutral_L", "f_depth_S", "f_depth_L", "f_depth_neutral_L")})
    balance = table("balance", "run.h5", *CUT)
    check(layers, "balance", balance, {"gravity_L_y": (balance["gravity_L_y"], 0), "B": (balance["B"], np.nan)})
