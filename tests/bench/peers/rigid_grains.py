"""Runs of grseg-sim: makes the common state, a checkpoint, and continues from it."""
import math
import os
import re
import shlex
import sys

import h5py
import numpy as np

from . import process
from .state import read_run, WRITERS

STATE_STEP = 1e-4  # s; with it, overlaps of discs in the state are about those of soft ones with kn 1e5
FRAME_INTERVAL = 0.05  # s, as in the scene; grseg-sim fits its step into it, so that another value gives another run


def make_state(program, scene, dimension, flow, folder, core):
    """Writes the state after `flow` seconds in all formats that the programs read; existing files are kept.

    The state for other programs is the one after the first step beyond the checkpoint, because frames are at mid-step.
    """
    run = os.path.join(folder, "state.h5")
    checkpoint = checkpoint_of(folder)
    if not os.path.exists(run):
        way = os.path.join(folder, "way.h5")
        process.run([program, scene, "--step", repr(STATE_STEP), "--duration", repr(flow),
                     "--overwrite", "--checkpoint", checkpoint, "-o", way],
                    os.path.join(folder, "state"), core)
        os.remove(way)
        process.run([program, "--restart", checkpoint, "--step", repr(STATE_STEP),
                     "--duration", repr(flow + STATE_STEP), "-o", run],
                    os.path.join(folder, "state"), core)
    state, units, time = read_run(run)
    if abs(time - flow - STATE_STEP) > STATE_STEP / 2:
        sys.exit(f"compare-peers: {run} is of {time:g} s of flow, not of {flow:g} s; remove it, "
                 "or choose another folder")
    if state.dimension != dimension:
        sys.exit(f"compare-peers: {run} has {state.dimension} dimensions, not {dimension}; remove it, "
                 "or choose another folder")
    data = {"state": state, "units": units, "flow": flow, "folder": folder}
    for form, write in WRITERS.items():
        data[form] = os.path.join(folder, "state." + form)
        with open(data[form], "w") as out:
            write(state, out)
    return data


def checkpoint_of(folder):
    return os.path.join(folder, "state.chk")


class RigidGrains:
    """Runs grseg-sim with given options."""
    trial = 0.5  # flow of a trial, s, that shows how much fills the requested time

    def __init__(self, program, options):
        self.program, self.options = program, options
        self.name = "grseg " + re.sub(r"^--accuracy ", "", options)
        self.method = "contact dynamics, e 0.25"

    def missing(self):
        return None

    def run(self, folder, data, flow, core):
        """Simulates `flow` seconds from the state into run.h5 in `folder`; returns the cost."""
        return process.run(self.command(data, data["flow"] + flow), folder, core)

    def command(self, data, until):
        """Command line; `until` is the time since the tilt, s."""
        return [self.program, "--restart", checkpoint_of(data["folder"]), *shlex.split(self.options),
                "--duration", f"{until:.10g}", "-o", "run.h5", "--overwrite"]

    def sample(self, folder, data, flow, core):
        """Times `flow` seconds of flow; overlaps are means over the second half."""
        flow = math.ceil(flow / FRAME_INTERVAL) * FRAME_INTERVAL
        cost = self.run(folder, data, flow, core)
        path = os.path.join(folder, "run.h5")
        seen = observables(path, data["units"], since=data["flow"] + flow / 2)
        _, velocity = mean_velocities(path, data["units"])
        os.remove(path)
        return process.Sample(
            command=self.command_line(data, flow), cost=cost, wall=cost.wall,
            steps=round(flow / seen["step"]), velocity=velocity[-1], flow=flow, **seen)

    def command_line(self, data, flow):
        return process.in_words(self.command(data, data["flow"] + flow), None,
                                [(data["folder"], "."), (self.program, "grseg-sim")])


def mean_velocities(path, units):
    """Time in s and mean velocity of the mobile grains in sqrt(g d_S), by frame."""
    with h5py.File(path, "r") as run:
        grains = run["particles/grains"]
        mobile = grains["fixed"][:] == 0
        speed = [float(frame[mobile, 0].mean()) / units.velocity
                 for frame in grains["velocity/value"]]
        return grains["position/time"][:], np.array(speed)


def observables(path, units, since):
    """Means of the run's observables over the steps after `since` (s); mobile overlaps are those of its frames."""
    with h5py.File(path, "r") as run:
        time = run["particles/grains/position/time"][:]
        of = {name: run[f"observables/{name}/value"][:][time > since] for name in
              ("steps", "touching", "contacts", "mean_overlap", "largest_overlap", "mean_gap")}
        if not of["steps"].sum() > 0:
            sys.exit(f"compare-peers: {path}: holds no frame after {since:g} s; allow more --seconds")
        offset = run["grseg/contacts/offset"][:]
        shown = slice(offset[:-1][time > since][0], offset[-1])
        j, gap = (run[f"grseg/contacts/{name}"][shown] for name in ("j", "gap"))
        mobile = (j >= 0) & (run["particles/grains/fixed"][:][j] == 0)  # i is always mobile
        mean = lambda values, weight: float((values * weight).sum() / weight.sum())
        d = units.length
        return {
            "step": float(run["parameters/step"][()]),
            "mean_overlap": mean(of["mean_overlap"], of["steps"] * of["touching"]) / d,
            "mobile_overlap": -float(gap[mobile & (gap <= 0)].mean()) / d,
            "mean_gap": mean(of["mean_gap"], of["steps"] * of["contacts"]) / d,
            "largest_overlap": float(of["largest_overlap"].max()) / d,
            "contacts": mean(of["contacts"], of["steps"]),
        }
