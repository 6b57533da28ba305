"""What of a trajectory is kept beside its sums, and a trajectory with other labels."""
import shutil

import h5py
import numpy

STORED_ELSEWHERE = {"scene", "history", "command_line"}  # in scene.ini and in every table


def text(value):
    value = value[()]
    if isinstance(value, bytes):
        return value.decode()
    return " ".join(f"{number:.17g}" for number in numpy.ravel(value))


def print_record(run):
    species = run["particles/grains/species"][:]
    print("name\tvalue")
    print(f"digest\t{run['grseg/digest'][-1]:016x}")
    print(f"frames\t{len(run['grseg/digest'])}")
    for code, name in enumerate(("small", "large", "boundary")):
        print(f"grains_{name}\t{numpy.count_nonzero(species == code)}")
    for name, value in sorted(run["parameters"].items()):
        if name not in STORED_ELSEWHERE:
            print(f"{name}\t{text(value)}")


def print_observables(run):
    columns = {"time": run["particles/grains/position/time"][:]}
    columns.update((name, group["value"][:]) for name, group in sorted(run["observables"].items()))
    print("\t".join(columns))
    for row in zip(*columns.values()):
        print("\t".join(f"{value:.9g}" for value in row))


def print_snapshots(run):
    grains = run["particles/grains"]
    print("t[s]\tspecies\tx[m]\ty[m]\tr[m]")
    for frame in (0, -1):
        time = grains["position/time"][frame]
        for species, (x, y), r in zip(grains["species"], grains["position/value"][frame], grains["radius"]):
            print(f"{time:.6g}\t{species}\t{x:.6g}\t{y:.6g}\t{r:.6g}")


def extract(options):
    """Parts of a trajectory that are kept beside its sums, as a table on standard output.

    record         names and values of the run's parameters, content digest first
    observables    the observables of every frame
    snapshots      the grains of the first and the last frame
    """
    with h5py.File(options.run, "r") as file:
        {"record": print_record, "observables": print_observables, "snapshots": print_snapshots}[options.what](file)


def relabel(options):
    """A copy of a trajectory in which the species of the mobile grains are permuted at random.

    For grains of one size B must then be 0; a value outside its interval would be an error of the tool.
    """
    shutil.copyfile(options.run, options.random)
    with h5py.File(options.random, "r+") as run:
        species = run["particles/grains/species"][:]
        mobile = species < 2
        species[mobile] = numpy.random.RandomState(1).permutation(species[mobile])
        run["particles/grains/species"][:] = species
