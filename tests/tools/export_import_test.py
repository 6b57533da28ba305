#!/usr/bin/python3
"""A run that is exported to LAMMPS dumps and imported by the command that grseg-export prints is unchanged,
in every number and in its content digest, but for forces on a driven boundary: discs, and spheres and discs of three species, also if grains
come and go; a bed that turns with a drum; spheres without gravity, or on a steep slope, or uphill.
Usage: export_import_test.py FOLDER-OF-PROGRAMS SYNTHETIC_RUN RUN.h5 FOLDER-OF-SCENES
"""
import os
import shlex
import subprocess
import sys
import tempfile

import h5py
import numpy as np

bin, synthetic, path, scenes = sys.argv[1:]
exporter, importer = (f"{bin}/grseg-{tool}" for tool in ("export", "import"))
SMALL = "--depth 5dS --length 4dL --duration 0.2 --frame-interval 0.02".split()


def same(a, b):
    """True if both arrays are equal; NaN means absent."""
    return np.array_equal(a, b, equal_nan=a.dtype.kind == "f")


def require_that_it_comes_back(path, *more, driven=False):
    """`driven`: boundary grains accelerate; an import leaves out the forces on them."""
    said = subprocess.run([exporter, path, "--to", "lammps", "-o", "run.dump.gz", "--overwrite"],
                          check=True, capture_output=True, text=True).stderr
    words = shlex.split(said.split("back into a run: ")[1])
    assert words[0] == "grseg-import" and words[-2:] == ["-o", "again.h5"], said
    subprocess.run([importer, *words[1:], *more, "--overwrite"], check=True)

    with h5py.File(path) as run, h5py.File("again.h5") as again:
        for group, names in (
                ("particles/grains", "id species radius mass fixed position/value position/step "
                 "position/time image/value velocity/value angular_velocity/value force/value"),
                ("grseg/contacts", "offset i j force branch gap"),
                ("grseg/species", "name diameter mobile"),
                ("parameters", "step gravity small_diameter large_diameter")):
            for name in names.split():
                part = (slice(None), run["particles/grains/fixed"][:] == 0) if driven and name == "force/value" else ()
                assert same(run[group][name][part], again[group][name][part]), f"{name} differs"
        box, box_again = (f["particles/grains/box"] for f in (run, again))
        assert np.array_equal(box.attrs["boundary"], box_again.attrs["boundary"])
        assert np.array_equal(box["edges"][::2], box_again["edges"][::2])  # periods along x and z
        assert driven or run["grseg/digest"][-1] == again["grseg/digest"][-1], "only the sign of a zero differs"


def simulate(scene, *options):
    subprocess.run([f"{bin}/grseg-sim", f"{scenes}/{scene}.ini", *options, "-o", "sim.h5", "--overwrite", "--quiet"], check=True)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    require_that_it_comes_back(path)
    for dimension, *words in ((3, "small,large"), (3, "fine,middle,coarse"), (2, "fine,middle,coarse"),
                              (2, "small,large", "changing"), (3, "fine,middle,coarse", "changing")):
        subprocess.run([synthetic, "synthetic.h5", str(dimension), *words], check=True)
        # Grains of this run are at random places, and few of those that overlap have a contact.
        require_that_it_comes_back("synthetic.h5", "--accept-residual", "completeness=100")
    simulate("drum", "--drum-diameter", "24dS", "--duration", "0.6", "--frame-interval", "0.02")
    require_that_it_comes_back("sim.h5", driven=True)
    # With these values no pair of the first frame overlaps without a contact.
    simulate("shear", *SMALL, "--dimension", "3", "--width", "6dS", "--density", "1", "--plate-pressure", "2")
    require_that_it_comes_back("sim.h5", driven=True)
    for dimension, slope in ((2, -25), (2, 60), (3, -25), (3, 60), (3, -60)):
        simulate("chute", *SMALL, "--dimension", str(dimension), "--slope", str(slope), *(("--width", "8dS") if dimension == 3 else ()))
        require_that_it_comes_back("sim.h5")
