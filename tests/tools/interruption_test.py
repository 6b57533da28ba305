#!/usr/bin/python3
"""An import or export that receives SIGINT or SIGTERM reports it, also by its exit code, and leaves no file.

Usage: interruption_test.py GRSEG-IMPORT GRSEG-EXPORT FOLDER RUN.h5
FOLDER holds atoms.dump and contacts.dump of LAMMPS, which are repeated until the import takes a while.
"""
import os
import signal
import subprocess
import sys
import tempfile
import time

importer, exporter, dumps, run = (os.path.abspath(word) for word in sys.argv[1:])


def repeat(name, times):
    """The frames of a dump, repeated with increasing steps."""
    frames = open(os.path.join(dumps, name)).read().split("ITEM: TIMESTEP\n")[1:]
    bodies = [frame.split("\n", 1)[1] for frame in frames]
    with open(name, "w") as out:
        for k in range(times):
            out.write(f"ITEM: TIMESTEP\n{1000 * k}\n{bodies[k % len(bodies)]}")


def interrupt(number, command):
    """Sends the signal as soon as the program has begun to write a file beside its output."""
    before = set(os.listdir())
    program = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    while program.poll() is None and set(os.listdir()) == before:
        time.sleep(0.001)
    program.send_signal(number)
    said = program.communicate()[1]
    name = os.path.basename(command[0])
    assert program.returncode == 128 + number, f"{command}: exit code {program.returncode}: {said}"
    assert said == f"{name}: interrupted; nothing is written\n", said
    assert set(os.listdir()) == before, f"{command} leaves {set(os.listdir()) - before}"


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    for name in ("atoms.dump", "contacts.dump"):
        repeat(name, 10000)
    importing = [importer, "--format", "lammps", "--grains", "atoms.dump", "--contacts",
                 "contacts.dump", *"--units si --step 1e-5 --gravity 9.8 --slope 23".split(),
                 *"--boundary 3 --columns i=2,j=3,dist=6,force=7,tangential=10 --quiet".split()]
    for number in (signal.SIGINT, signal.SIGTERM):
        interrupt(number, [*importing, "-o", "run.h5"])
        for form in ("vtp", "extxyz", "lammps", "h5md3d"):
            interrupt(number, [exporter, run, "--to", form, "--quiet", "-o", "view.gz"])
