"""Mean velocity of the mobile grains per half second, soft and rigid grains from the same state.

Each curve has its own file, NAME.tsv, written when its run has ended; existing curves are kept, so that
an interrupted comparison continues where it stopped.
"""
import os
import sys

import numpy as np

from .rigid_grains import FRAME_INTERVAL, mean_velocities, RigidGrains
from .soft_grains import Plan

INTERVAL = 0.5  # s


def curve(program, data, seconds, folder, core):
    """Rows (time since the state in s, mean velocity in sqrt(g d_S))."""
    if isinstance(program, RigidGrains):
        program.run(folder, data, seconds + FRAME_INTERVAL, core)
        time, velocity = mean_velocities(os.path.join(folder, "run.h5"), data["units"])
        since = time - data["flow"]
        instants = np.arange(0, seconds + INTERVAL / 2, INTERVAL)
        nearest = [int(np.abs(since - instant).argmin()) for instant in instants]
        return [(since[k], velocity[k]) for k in nearest]
    step = program.step * data["units"].time
    every = round(INTERVAL / step)
    plan = Plan(warm=0, timed=round(seconds / INTERVAL) * every, every=1, frames=1, slice=every)
    program.run(folder, data, plan, core)
    return [(n * step, v) for n, v in dict(program.velocities(folder)).items() if n % every == 0]


def compare(programs, data, seconds, folder, core):
    """Writes the curves, and returns them by name of program."""
    curves = {}
    for program in programs:
        name = program.name.replace(" ", "-")
        path = os.path.join(folder, name + ".tsv")
        if not os.path.exists(path):
            print(f"compare-peers: {program.name}: {seconds:g} s of flow", file=sys.stderr, flush=True)
            rows = curve(program, data, seconds, os.path.join(folder, name), core)
            with open(path + ".part", "w") as out:
                out.write("time[s]\tvelocity[sqrt(g d_S)]\n")
                out.writelines(f"{max(t, 0):.4f}\t{v:.6g}\n" for t, v in rows)
            os.rename(path + ".part", path)
        with open(path) as lines:
            next(lines)
            curves[program.name] = [tuple(map(float, line.split())) for line in lines]
    return curves
