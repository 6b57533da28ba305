#!/usr/bin/python3
"""Runs of spheres: a restart, other vector instructions and several threads lead to the same bytes; all checks pass.

Usage: spheres_test.py FOLDER-OF-PROGRAMS
"""
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

BIN = os.path.abspath(sys.argv[1])
SCENE = """dimension = 3
length = 16dS
width = 8dS
depth = 10dS
phi-large = 0.45
slope = 26
"""
FIELDS = ("particles/grains/position/value", "particles/grains/velocity/value", "grseg/contacts/force")


def run(*arguments):
    subprocess.run([f"{BIN}/grseg-sim", *arguments, "--quiet", "--overwrite"], check=True)


def same(one, other, last):
    """True if the `last` frames of two runs are equal."""
    with h5py.File(one) as a, h5py.File(other) as b:
        return all(np.array_equal(a[field][-last:], b[field][-last:]) for field in FIELDS)


def main():
    with open("spheres.ini", "w", encoding="utf-8") as scene:
        scene.write(SCENE)
    run("spheres.ini", "--duration", "0.2", "-o", "whole.h5")
    run("spheres.ini", "--duration", "0.1", "--checkpoint", "run.chk", "-o", "half.h5")
    run("--restart", "run.chk", "--duration", "0.2", "-o", "rest.h5")
    assert same("whole.h5", "rest.h5", 2), "a restart changes the run"
    run("spheres.ini", "--duration", "0.2", "--isa", "scalar", "-o", "scalar.h5")
    assert same("whole.h5", "scalar.h5", 4), "vectors change the run"
    # Two strips, which only beds of 10,000 grains have.
    wide = ("spheres.ini", "--length", "80dS", "--width", "24dS", "--accuracy", "draft", "--duration", "0.02",
            "--frame-interval", "0.01")
    for threads in "12":
        run(*wide, "--threads", threads, "-o", f"wide{threads}.h5")
    assert same("wide1.h5", "wide2.h5", 2), "threads change the run"
    for file in "whole.h5", "wide1.h5":
        checks = subprocess.run([f"{BIN}/grseg-check", "--physics", file], capture_output=True, text=True, check=False)
        failed = [line for line in checks.stdout.split("\n") if "\tfailed\t" in line]
        assert "energy_defect" in checks.stdout and not failed, (failed, checks.stderr)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
