"""Extracts parts of a trajectory that are stored with its sums, and makes a trajectory with random labels."""
import shutil

import h5py
import numpy

import tables  # noqa: F401 (grseg's folder)
import grseg

STORED_ELSEWHERE = {"scene", "history", "command_line"}  # parameters that scene.ini and every table include


def record(run):
    yield "name", "value"
    yield "digest", run.digest
    yield "frames", str(len(run))
    for code, name in enumerate(("small", "large", "boundary")):
        yield f"grains_{name}", str(numpy.count_nonzero(run.kind == code))
    for name, value in sorted(run.parameters.items()):
        if name not in STORED_ELSEWHERE:
            yield name, value if isinstance(value, str) else " ".join(f"{number:.17g}" for number in numpy.ravel(value))


def observables(run):
    yield "time", *run.observables
    for row in zip(run.times, *map(run.observable, run.observables)):
        yield (f"{value:.9g}" for value in row)


def snapshots(run):
    yield "t[s]", "species", "x[m]", "y[m]", "r[m]"
    for frame in (run[0], run[-1]):
        for species, (x, y), r in zip(run.kind, frame.position, run.radius):
            yield f"{frame.time:.6g}", str(species), f"{x:.6g}", f"{y:.6g}", f"{r:.6g}"


def extract(options):
    """Prints a part of a trajectory that is stored with its sums, as a table.

    record         content digest of the run, numbers of frames and grains, names and values of its parameters
    observables    observables of every frame
    snapshots      grains of the first and of the last frame
    """
    with grseg.Run(options.run) as run:
        for row in {"record": record, "observables": observables, "snapshots": snapshots}[options.what](run):
            print(*row, sep="\t")


def relabel(options):
    """Writes a copy of a trajectory in which the species of the mobile grains are permuted at random.

    For grains of one size B of this copy must be 0; if its interval excludes 0, the tool has an error.
    """
    shutil.copyfile(options.run, options.random)
    with h5py.File(options.random, "r+") as run:
        species = run["particles/grains/species"][:]
        mobile = species < 2
        species[mobile] = numpy.random.RandomState(1).permutation(species[mobile])
        run["particles/grains/species"][:] = species
