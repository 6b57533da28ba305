#!/usr/bin/python3
"""Messages of grseg.py about damaged, unfinished and foreign files, and about wrong arguments: each names the file,
the place and the remedy in one sentence.
Usage: refusals_test.py SOURCE SYNTHETIC_RUN
"""
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from unittest import mock

import h5py
import numpy as np

sys.dont_write_bytecode = True
source, synthetic = sys.argv[1:]
sys.path.insert(0, os.path.join(source, "analysis", "python"))
import grseg

inputs = os.path.join(source, "tests", "inputs")
RUN = os.path.join(inputs, "three-grains-closed.h5")


def require(sentence, work, kind=grseg.Error):
    try:
        work()
    except kind as error:
        assert re.search(sentence, str(error)) and "\n" not in str(error), f"{error}\nis not\n{sentence}"
    else:
        sys.exit(f"nothing is refused, but should be: {sentence}")


def read_all(path, **how):
    with grseg.Run(path, **how) as run:
        for frame in run.frames():
            for field in ("position", "velocity", "angular_velocity", "force", "image"):
                getattr(frame, field)
            for field in ("i", "j", "force", "branch", "gap"):
                getattr(frame.contacts, field)


def changed(change, path=RUN):
    """A copy of a run with the change `damage`."""
    shutil.copyfile(path, "changed.h5")
    with h5py.File("changed.h5", "r+") as file:
        change(file)
    return lambda: read_all("changed.h5")


def put(path, index, value):
    def change(file):
        file[path][index] = value
    return change


def without(path):
    def change(file):
        del file[path]
    return change


def with_version(module, version):
    def change(file):
        file[module].attrs["version"] = version
    return change


def files_that_are_not_runs():
    require(r"^nowhere.h5: No such file or directory$", lambda: grseg.Run("nowhere.h5"))
    for name in ("neutral-sums.tsv", "truncated.h5"):
        require(rf"{name}: is not an HDF5 file, or is truncated or damaged; use an intact copy$",
                lambda name=name: grseg.Run(os.path.join(inputs, name)))
    with h5py.File("foreign.h5", "w") as file:
        file["particles/all/position"] = np.zeros(3)
    require(r"^foreign.h5: /h5md/modules/grseg has no version: not a run of grseg, or damaged; grseg-import converts",
            lambda: grseg.Run("foreign.h5"))
    require(r"^changed.h5: /h5md/modules/grseg has version 2.0, and this grseg.py reads 1.0; use the grseg.py of the grseg",
            changed(with_version("h5md/modules/grseg", np.array([2, 0]))))


def in_another_process(path):
    """Message in another process, because HDF5's locks are between processes."""
    said = subprocess.run([sys.executable, "-B", "-c", "import grseg, sys\ntry: grseg.Run(sys.argv[1])\n"
                           "except grseg.Error as error: print(error, end='')", path], capture_output=True, text=True,
                          env=os.environ | {"PYTHONPATH": sys.path[0]}, check=True)
    raise grseg.Error(said.stdout)


def runs_that_have_not_ended():
    require(r"^changed.h5: the run has not ended, or its end was lost: pass unfinished=True to read the frames",
            changed(put("grseg/seal", slice(None), 0)))
    with grseg.Run("changed.h5", unfinished=True) as run:
        assert not run.finished and len(run) == 4
    with h5py.File("live.h5", "w", libver=("v110", "v110")) as file:
        file.swmr_mode = True
        require("^live.h5: the run has not ended", lambda: grseg.Run("live.h5"))
        require("^live.h5: /h5md/modules/grseg has no version: not a run", lambda: grseg.Run("live.h5", unfinished=True))
    with h5py.File("locked.h5", "w"):
        require("^locked.h5: is being written by a run; wait", lambda: in_another_process("locked.h5"))
    require("three-grains-1.0.h5: the run has not ended",
            lambda: grseg.Run(os.path.join(inputs, "three-grains-1.0.h5")))


def damaged_runs():
    for path in ("grseg/contacts/branch", "particles/grains/position/value", "particles/grains/radius",
                 "parameters/step", "grseg/seal", "grseg/species/name"):
        require(rf"^changed.h5: /{path} is missing: not a run of grseg, or damaged", changed(without(path)))
    require(r"^changed.h5: /grseg/seal does not agree with the frames: the file is damaged",
            changed(lambda file: file["grseg/contacts/offset"].resize((4,))))
    require(r"^changed.h5: /grseg/contacts/offset does not increase", changed(put("grseg/contacts/offset", 2, 9)))
    require(r"^changed.h5: /particles/grains/velocity/value has the shape \(3, 3, 2\) and should have \(4, 3, 2\)",
            changed(lambda file: file["particles/grains/velocity/value"].resize((3, 3, 2))))
    require(r"steps or times do not increase", changed(put("particles/grains/position/step", 3, 0)))
    require(r"a radius or mass is not positive", changed(put("particles/grains/radius", 1, 0)))
    require(r"species names a species that is not listed", changed(put("particles/grains/species", 1, 7)))


def damaged_frames():
    place = "in contact 1 of frame 2, which is not the row of a grain that can have a contact; the frame is damaged"
    for name, value in (("i", 3), ("i", 2), ("i", -1), ("j", 3)):
        require(rf"^changed.h5: /grseg/contacts/{name} is {value} {place}",
                changed(put(f"grseg/contacts/{name}", 5, value)))
    require(r"/grseg/contacts/force is not a finite number in contact 0 of frame 2; the frame is damaged: use an intact",
            lambda: read_all(os.path.join(inputs, "nan.h5"), unfinished=True))
    require(r"/particles/grains/velocity/value is not a finite number in grain 1 of frame 3",
            changed(put("particles/grains/velocity/value", (3, 1), np.nan)))
    shutil.copyfile(RUN, "changed.h5")
    with h5py.File(RUN) as file:
        chunk = file["particles/grains/velocity/value"].id.get_chunk_info_by_coord((2, 0, 0))
    with open("changed.h5", "r+b") as file:
        file.seek(chunk.byte_offset)
        file.write(bytes(chunk.size))
    require(r"^changed.h5: /particles/grains/velocity/value: rows 0 to 3 cannot be read: the file is damaged",
            lambda: read_all("changed.h5"))


def grains_that_come_and_go():
    subprocess.run([synthetic, "absent.h5", "3", "small,large", "changing"], check=True)
    read_all("absent.h5")
    with grseg.Run("absent.h5") as run:
        frame = run[0]
        assert run.version == "1.0" and 0 < frame.present.sum() < run.mobile.sum()
        absent = int(np.flatnonzero(np.isnan(frame.position[:, 1]))[0])
    require(rf"/grseg/contacts/j is {absent} in contact 2 of frame 0, which is not the row of a grain that can have a contact",
            changed(put("grseg/contacts/j", 2, absent), "absent.h5"))
    require(rf"/particles/grains/position/value is not a finite number in grain {absent} of frame 0",
            changed(put("particles/grains/position/value", (0, absent, 0), 0.0), "absent.h5"))


def what_is_not_there():
    with grseg.Run(os.path.join(inputs, "no-force.h5")) as run:
        require("no-force.h5: /particles/grains/force/value is missing: this run was imported without it",
                lambda: run[0].force)
        require("no-force.h5: frame 4 of 4", lambda: run[4], IndexError)


def wrong_arguments():
    with grseg.Run(RUN) as run:
        require("'4dX' is not a length: give a number with a unit, as in 0.02m, 20mm, 4dS, 2dL", lambda: run.metres("4dX"),
                ValueError)
        require("'4' has no unit: 4dS, 4dL or 4m[?]", lambda: run.metres("4"), ValueError)
        require("layer = 4 is 4 m, more than the 0.35 m of the cell: write \"4dS\" for", lambda: run.contact_sums(layer=4), ValueError)
        require("no window of 1.25 s is filled: the frames used are from 0 s to 0.2 s; choose a shorter",
                run.contact_sums)
        require("a window of 0.01 s is shorter than the 0.05 s between the frames", lambda: run.windows(0.01), ValueError)
        require("mean = 'instant': write profile or layer; grseg-kinetic has more choices",
                lambda: run.kinetic_sums(mean="instant"), ValueError)
        require("no frame lies between begin and end; the run goes from 0 s to 0.15 s", lambda: run.windows("all", begin=3))
        sums = run.contact_sums(window=0.1)
        all_frames = run.contact_sums(window="all")
        require("three-grains-closed.h5 and .*three-grains-closed.h5 both contain the time from 0 s of the same run; leave one",
                lambda: grseg.Points([sums, all_frames]))
    for rule in ("sizes", "uniform", "uniform:2", "power:x", "half:1"):
        require(f"'{rule}' is not a rule: size, contact-point", lambda rule=rule: grseg.partial_stress(sums, rule),
                ValueError)
    require("three-grains-closed.h5: the rule mine asks for r_small of each contact, and the table has only sums over contacts: give the run",
            lambda: grseg.partial_stress(sums, mine), ValueError)
    require("window: .*three-grains-closed.h5 is a table, which has its layers and windows", lambda: grseg.fit(sums, window=2), ValueError)
    require(r"its column Mpower_\* was not made with power:3; make the table with --partition power:3",
            lambda: grseg.partial_stress(sums, "power:3"))


def mine(r_small):
    return r_small / 0.0025


def wrong_rules():
    with grseg.Run(RUN) as run:
        for sentence, rule in (
                ("rule <lambda> has the argument 'x'; grseg knows d_large, d_small, r_large, r_small, gap, force, branch", lambda x: x),
                (r"rule <lambda> returns an array of shape \(3,\) for 4 contacts; it should return one number, or one for each",
                 lambda gap: gap[1:]),
                ("rule <lambda> returns nan for a contact; a share should be a finite number", lambda gap: gap * math.nan)):
            require(sentence, lambda rule=rule: run.contact_sums(window=0.2, rule=rule), ValueError)
        sums = run.contact_sums(window=0.2, rule=mine)
    grseg.partial_stress(sums, mine)
    require("the rule <lambda> asks for gap of each contact", lambda: grseg.partial_stress(sums, lambda gap: gap), ValueError)


def wrong_tables():
    def read(text):
        with open("table.tsv", "w") as file:
            file.write(text)
        return lambda: grseg.read_table("table.tsv")
    head = "# program: grseg-stress 0.2.0\nt0[s]\tt1[s]\n"
    require("table.tsv: the last line is incomplete: the table is truncated", read(head + "0\t1"))
    require("table.tsv: does not end with the line '# end: ...' of every table: it is truncated", read(head + "0\t1\n"))
    require("table.tsv: has 1 rows, but its last line states another number: it is damaged",
            read(head + "0\t1\n# end: 2 rows, xxh3 0\n"))
    require("table.tsv: has a row without a number in each column",
            read(head + "0\n# end: 1 rows, xxh3 0\n"))
    require("three-grains-closed.h5: is an HDF5 file, not a table; open a run with grseg.Run", lambda: grseg.read_table(RUN))
    require("nowhere.tsv: No such file or directory", lambda: grseg.read_table("nowhere.tsv"))
    neutral = grseg.read_table(os.path.join(inputs, "neutral-sums.tsv"))
    require("neutral-sums.tsv: no column 'mass_S'; it has area_S, .*; grseg-stress makes tables of contacts",
            lambda: grseg.Points(neutral, quantity="kinetic"))
    require(r"neutral-sums.tsv: its column Mpower_\* was not made with power:2", lambda: grseg.Points(neutral).fit("power:2"))
    require("only-small-sums.tsv: no layer and window passes the filters",
            lambda: grseg.Points(grseg.read_table(os.path.join(inputs, "only-small-sums.tsv"))))
    with mock.patch.dict(sys.modules, pandas=None):
        require("^Table.to_pandas needs pandas, which is not installed: install Debian's python3-pandas, or pip install pandas$",
                neutral.to_pandas, ImportError)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    files_that_are_not_runs()
    runs_that_have_not_ended()
    damaged_runs()
    damaged_frames()
    grains_that_come_and_go()
    what_is_not_there()
    wrong_arguments()
    wrong_rules()
    wrong_tables()
