#!/usr/bin/python3
"""A run exported to LAMMPS dumps and imported by the command that grseg-export prints is the same run,
number by number, and by its content digest. Usage: export_import_test.py GRSEG-EXPORT GRSEG-IMPORT RUN.h5
"""
import os
import shlex
import subprocess
import sys
import tempfile

import h5py
import numpy as np

exporter, importer, path = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    said = subprocess.run([exporter, path, "--to", "lammps", "-o", "run.dump.gz"], check=True,
                          capture_output=True, text=True).stderr
    words = shlex.split(said.split("back into a run: ")[1])
    assert words[0] == "grseg-import" and words[-2:] == ["-o", "again.h5"], said
    subprocess.run([importer] + words[1:], check=True)

    with h5py.File(path) as run, h5py.File("again.h5") as again:
        for group, names in (
                ("particles/grains", "id species radius mass fixed position/value position/step "
                 "position/time image/value velocity/value angular_velocity/value force/value"),
                ("grseg/contacts", "offset i j force branch gap"),
                ("parameters", "step gravity small_diameter large_diameter")):
            for name in names.split():
                assert np.array_equal(run[group][name], again[group][name]), f"{name} differs"
        assert run["particles/grains/box/edges"][0] == again["particles/grains/box/edges"][0]
        assert run["grseg/digest"][-1] == again["grseg/digest"][-1], "only the sign of a zero differs"
