#!/usr/bin/python3
"""Numbers of the scenes of sim/scenes that can be compared with theory or literature.

    scripts/scenes/measure.py SCENE run.h5 ...

Prints a table for gnuplot: one row per run where a law requires several runs (shear, column, hopper),
otherwise one row per frame (drum, shaken-box, intruder). Definitions are given with the functions.
scripts/scenes-study makes the runs.
"""
import sys

import h5py
import numpy


class Run:
    def __init__(self, path):
        self.file = h5py.File(path)
        grains = self.file["particles/grains"]
        self.position = grains["position/value"]
        self.velocity = grains["velocity/value"]
        self.time = grains["position/time"][:]
        self.species = grains["species"][:]
        self.radius = grains["radius"][:]
        self.mass = grains["mass"][:]
        self.mobile = self.species != 2
        self.length = grains["box/edges"][0]
        scene = self.file["parameters/scene"][()].decode()
        self.scene = dict(line.split(" = ") for line in scene.splitlines())

    def key(self, name):
        return float(self.scene[name])

    def forces(self, frame):
        contacts = self.file["grseg/contacts"]
        begin, end = contacts["offset"][frame], contacts["offset"][frame + 1]
        return contacts["j"][begin:end], contacts["force"][begin:end]


def slope_with_error(x, y):
    (slope, level), cover = numpy.polyfit(x, y, 1, cov=True)
    return slope, cover[0, 0] ** 0.5, level, cover[1, 1] ** 0.5


def shear(paths):
    """Inertial number I = shear rate x mean diameter x sqrt(density/P) and effective friction, over
    the second half of each run: rate from the velocity profile's middle 60 %, P and the shear
    stress from the forces on the plate; error of the mean over ten blocks."""
    print("inertial_number\tfriction\tfriction_error\tsolid_fraction")
    for path in paths:
        run = Run(path)
        first = len(run.time) // 2
        beads = numpy.flatnonzero(~run.mobile)
        plate = beads[len(beads) // 2:]
        ratios, heights, speeds, tops = [], [], [], []
        for frame in range(first, len(run.time)):
            j, force = run.forces(frame)
            on_plate = -force[j >= plate[0]].sum(axis=0)
            ratios.append((-on_plate[0], on_plate[1]))
            heights.append(run.position[frame][run.mobile, 1])
            speeds.append(run.velocity[frame][run.mobile, 0])
            tops.append(run.position[frame][plate[0], 1] - run.radius[plate[0]])
        height, speed, top = numpy.concatenate(heights), numpy.concatenate(speeds), numpy.mean(tops)
        inner = (height > 0.2 * top) & (height < 0.8 * top)
        rate = slope_with_error(height[inner], speed[inner])[0]
        stress = numpy.array(ratios)
        blocks = [abs(b[:, 0].mean() / b[:, 1].mean()) for b in numpy.array_split(stress, 10)]
        pressure = abs(stress[:, 1].mean()) / run.length
        number = rate * 2 * run.radius[run.mobile].mean() * (run.key("density") / pressure) ** 0.5
        area = numpy.pi * (run.radius[run.mobile] ** 2).sum()
        print(number, numpy.mean(blocks), numpy.std(blocks) / 10 ** 0.5,
              area / (run.length * top), sep="\t")


def column(paths):
    """Aspect ratio H/L0 of the deposited column, its width L0 in diameters, and run-out (x_99 - L0)/L0,
    x_99 the distance within which 99 % of the mass lies once all is at rest."""
    print("aspect_ratio\twidth\trun_out")
    for path in paths:
        run = Run(path)
        width = run.key("column-width")
        start = run.position[0][run.mobile]
        height = 2 * numpy.average(start[:, 1], weights=run.mass[run.mobile])
        x = run.position[-1][run.mobile, 0]
        order = numpy.argsort(x)
        mass = numpy.cumsum(run.mass[run.mobile][order])
        reach = x[order][numpy.searchsorted(mass, 0.99 * mass[-1])]
        print(height / width, width / run.key("small-diameter"), (reach - width) / width, sep="\t")


def hopper(paths):
    """Outlet over the mean diameter and discharge, solid area per time over sqrt(g) d^(3/2), while
    15 to 50 % of the grains leave; error of the mean over five parts of that time."""
    print("outlet\tdischarge\terror")
    for path in paths:
        run = Run(path)
        diameter = 2 * run.radius[run.mobile].mean()
        area = numpy.pi * run.radius[run.mobile] ** 2
        left = numpy.array([area[p[run.mobile, 1] < 0].sum() for p in run.position])
        steady = numpy.flatnonzero((left > 0.15 * area.sum()) & (left < 0.5 * area.sum()))
        edges = numpy.linspace(steady[0], steady[-1], 6).astype(int)
        rates = numpy.diff(left[edges]) / numpy.diff(run.time[edges])
        unit = run.key("gravity") ** 0.5 * diameter ** 1.5
        print(run.key("outlet") / diameter, numpy.mean(rates) / unit,
              numpy.std(rates, ddof=1) / 5 ** 0.5 / unit, sep="\t")


def drum(paths):
    """Time in turns, and the index of radial segregation (<r^2>_L - <r^2>_S)/(its value if all small
    grains were nearest to the drum's axis), r the distance from it: 0 mixed, 1 a core of small grains."""
    print("turns\tindex")
    run = Run(paths[0])
    turns = abs(run.key("drum-rate")) / (2 * numpy.pi) * run.time
    axis = run.file["parameters/drum_centre"][:]
    small, area = run.species[run.mobile] == 0, run.radius[run.mobile] ** 2
    share = area[small].sum() / area.sum()

    def apart(square, inside):
        """Difference of the area-weighted means, `inside` the fraction of each grain that counts as small."""
        return (numpy.average(square, weights=area * (1 - inside))
                - numpy.average(square, weights=area * inside))

    for time, position in zip(turns, run.position):
        square = ((position[run.mobile] - axis) ** 2).sum(axis=1)
        order = numpy.argsort(square)
        inside = numpy.empty(len(area))
        inside[order] = numpy.cumsum(area[order]) <= share * area.sum()
        print(time, apart(square, small) / apart(square, inside), sep="\t")


def intruder(paths):
    """Per run, separated by two empty lines: time and height of the large grain, in small diameters,
    and twice the mean height of all grains; above them, when the large grain first was at a quarter and
    at three quarters of that height."""
    for path in paths:
        run = Run(path)
        d = run.key("small-diameter")
        large = numpy.flatnonzero(run.species == 1)[0]
        height = run.position[:, large, 1] / d
        weight = run.mass[run.mobile]
        bed = numpy.array([2 * numpy.average(p[run.mobile, 1], weights=weight) / d
                           for p in run.position])
        typical = numpy.median(bed)
        first = [run.time[height > part * typical][0] if (height > part * typical).any()
                 else numpy.nan for part in (0.25, 0.75)]
        print(f"# bed {typical:.1f} d_S; quarter at {first[0]:.2f} s, three quarters at {first[1]:.2f} s")
        print("# time\theight\tbed")
        for row in zip(run.time, height, bed):
            print(*row, sep="\t")
        print("\n")


if __name__ == "__main__":
    scenes = {"shear": shear, "column": column, "hopper": hopper, "drum": drum, "shaken-box": intruder,
              "intruder": intruder}
    if len(sys.argv) < 3 or sys.argv[1] not in scenes:
        sys.exit(__doc__)
    scenes[sys.argv[1]](sys.argv[2:])
