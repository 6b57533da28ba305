"""Runs of other programs (peers), LAMMPS, LIGGGHTS and YADE: soft grains with linear springs, from one state.

Units d_S = g = rho = 1 throughout; kn is the normal stiffness, two small grains (mass pi/4 of a disc,
pi/6 of a sphere) collide for pi/(w sqrt(1 - z^2)), w^2 = kn/m, m half of their mass, and the step is
1/20 of that.
"""
import dataclasses
import math
import os
import re
import shutil
import sys

import numpy as np

from . import process
from .state import BASE, LARGE, SMALL

HERE = os.path.dirname(os.path.abspath(__file__))
RESTITUTION = 0.25
DAMPING_RATIO = -math.log(RESTITUTION) / math.hypot(math.pi, math.log(RESTITUTION))
MASS = {2: {BASE: math.inf, LARGE: math.pi, SMALL: math.pi / 4},
        3: {BASE: math.inf, LARGE: math.pi * 4 / 3, SMALL: math.pi / 6}}  # by dimension
SKIN = {2: 0.6, 3: 0.4}  # with which the peers are fastest, by dimension


def reduced_mass(a, b, dimension=2):
    return 1 / (1 / MASS[dimension][a] + 1 / MASS[dimension][b])


def damping(kn, a, b, dimension=2):
    """Damping gamma_n per unit of reduced mass that gives restitution e between nominal grains of types a and b."""
    return 2 * DAMPING_RATIO * math.sqrt(kn / reduced_mass(a, b, dimension))


def time_step(kn, dimension=2):
    w = math.sqrt(kn / reduced_mass(SMALL, SMALL, dimension))
    return math.pi / (w * math.sqrt(1 - DAMPING_RATIO**2)) / 20


def restitution_without_pull(zeta):
    """Restitution e of a spring and dashpot that separate when their force vanishes (Schwager & Poeschel 2007)."""
    w = math.sqrt(1 - zeta**2)
    return math.exp(-zeta / w * (math.pi - math.atan2(2 * zeta * w, w**2 - zeta**2)))


def restitution_with_pull():
    """Nominal e for which a contact that cannot pull has the requested actual e."""
    low, high = 0.0, 0.99
    while high - low > 1e-12:
        middle = (low + high) / 2
        if restitution_without_pull(middle) > RESTITUTION:
            low = middle
        else:
            high = middle
    return math.exp(-math.pi * low / math.sqrt(1 - low**2))


def tsuji_argument():
    """Nominal e for which LAMMPS's fit alpha(e) (Tsuji 1992, made for Hertz) equals the linear spring's 2 zeta."""
    fit = np.array([4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728])
    fit[-1] -= 2 * DAMPING_RATIO
    return min(r.real for r in np.roots(fit) if abs(r.imag) < 1e-9 and 0 < r.real < 1)


@dataclasses.dataclass
class Plan:
    """Lengths of the phases of a run, in steps."""
    warm: int = 3000
    timed: int = 1000
    every: int = 500    # steps between two lists of contacts, after the timed steps
    frames: int = 10
    slice: int = 10**9  # steps between two mean velocities in the log
    gravity: float = 1.0

    @property
    def steps(self):
        return self.warm + self.timed + self.every * self.frames


@dataclasses.dataclass
class Result:
    cost: process.Cost
    wall: float           # wall time of the timed steps, s
    end: np.ndarray       # rows id vx vy omega


class SoftGrains:
    """Runs one program with one stiffness."""
    trial = 1000  # steps of a trial that shows how many steps fill the requested time

    def __init__(self, kn, dimension=2):
        self.kn, self.dimension = kn, dimension
        self.step = time_step(kn, dimension)

    def missing(self):
        return None if shutil.which(self.executable) else self.package

    def sample(self, folder, data, steps, core):
        """Times `steps` steps, after a warm-up in which the contacts build their overlap."""
        plan = Plan(timed=round(steps))
        result = self.run(folder, data, plan, core)
        contacts = self.contacts(folder, data)
        contacts = contacts[contacts[:, 2] > 0]
        overlaps = contacts[:, 2]
        mobile = data["state"].mobile[contacts[:, :2].astype(int) - 1].all(axis=1)
        second = data["units"].time
        return process.Sample(
            command=self.command_line(data, plan), cost=result.cost, wall=result.wall,
            steps=plan.timed, step=self.step * second, mean_overlap=overlaps.mean(),
            mobile_overlap=overlaps[mobile].mean(), mean_gap=overlaps.mean(),
            largest_overlap=overlaps.max(), contacts=len(overlaps) / plan.frames,
            velocity=result.end[data["state"].mobile, 1].mean(),
            flow=plan.steps * self.step * second)

    def contacts(self, folder, data):
        """Rows id, id, overlap of every pair in every list of contacts."""
        return np.concatenate(read_rows(os.path.join(folder, "contacts.dump"), "ITEM: ENTRIES"))

    def command_line(self, data, plan):
        command, environment = self.command(data, plan)
        return process.in_words(command, environment,
                                [(data["folder"], "."), (HERE, "tests/bench/peers")])

    def run(self, folder, data, plan, core):
        command, environment = self.command(data, plan)
        cost = process.run(command, folder, core, environment)
        return Result(cost, self.timed_wall(folder),
                      read_rows(os.path.join(folder, "end.dump"), "ITEM: ATOMS")[-1])

    def command(self, data, plan):
        variables = dict(data=data[self.data], kn=repr(self.kn), dt=repr(self.step),
                         skin=SKIN[self.dimension], gravity=plan.gravity, warm=plan.warm,
                         steps=plan.timed, every=plan.every, frames=plan.frames, slice=plan.slice,
                         **self.damping_variables())
        if self.dimension == 3:
            variables.update(dimension=3, slope=data["state"].slope)
        return [self.executable, "-in", os.path.join(HERE, self.input), "-log", "log", "-screen",
                "none", *(word for name, value in variables.items()
                          for word in ("-var", name, str(value)))], None

    def timed_wall(self, folder):
        """Wall time, s: the second run of the input script is the timed one."""
        return float(re.findall(r"Loop time of ([0-9.e+-]+)", read(folder, "log"))[1])

    def velocities(self, folder):
        """(step, mean velocity of the mobile grains) from the log."""
        return [(int(step), float(v)) for step, v in
                re.findall(r"^ *(\d+) +(-?[0-9.e+-]+) *$", read(folder, "log"), re.M)]


class Lammps(SoftGrains):
    executable, package, input, data = "lmp", "lammps", "chute.lammps", "data"

    def __init__(self, kn, style="granular", dimension=2):
        super().__init__(kn, dimension)
        self.style = style
        self.name = f"LAMMPS {kn:.0e}".replace("e+0", "e") + (" hooke" if style == "hooke" else "")
        self.method = (f"soft, kn {kn:g}, e 0.25" if style == "granular" else
                       f"soft, kn {kn:g}, gran/hooke/history: e 0.25 small, "
                       f"{'0.01' if dimension == 2 else '0'} large")

    def damping_variables(self):
        return {"style": self.style,
                "damping": tsuji_argument() if self.style == "granular"
                else damping(self.kn, SMALL, SMALL, self.dimension)}

    def contacts(self, folder, data):
        rows = super().contacts(folder, data)[:, 1:]  # a list's first column counts, its last is a distance
        rows[:, 2] = data["state"].radius[rows[:, :2].astype(int) - 1].sum(axis=1) - rows[:, 2]
        return rows


class Liggghts(SoftGrains):
    executable, package, input, data = "liggghts", "liggghts", "chute.liggghts", "data"

    def __init__(self, kn):
        super().__init__(kn)
        self.name = f"LIGGGHTS {kn:.0e}".replace("e+0", "e")
        self.method = f"soft, kn {kn:g}, e 0.25"

    def damping_variables(self):
        pairs = {"SS": (SMALL, SMALL), "LS": (LARGE, SMALL), "LL": (LARGE, LARGE),
                 "BS": (BASE, SMALL), "BL": (BASE, LARGE)}
        return {"d" + name: repr(damping(self.kn, *pair)) for name, pair in pairs.items()}


class Yade(SoftGrains):
    executable, package, data = "yade", "yade", "text"

    def __init__(self, kn):
        super().__init__(kn)
        self.name = f"YADE {kn:.0e}".replace("e+0", "e")
        self.method = f"soft, kn {kn:g}, e 0.25"

    def command(self, data, plan):
        environment = dict(STATE=data["text"], KN=self.kn, EN=restitution_with_pull(),
                           DT=self.step, VERLET=0.15, GRAVITY=plan.gravity, WARM=plan.warm,
                           STEPS=plan.timed, EVERY=plan.every, FRAMES=plan.frames)
        return (["yade", "-x", "-n", "-j1", os.path.join(HERE, "chute_yade.py")],
                {name: str(value) for name, value in environment.items()})

    def timed_wall(self, folder):
        return float(re.search(r"TIMED ([0-9.e+-]+) s", read(folder, "run.log")).group(1))


def read(folder, name):
    with open(os.path.join(folder, name)) as text:
        return text.read()


def read_rows(path, head):
    """Blocks of numbers under the lines that begin with `head`."""
    blocks, rows = [], None
    with open(path) as text:
        for line in text:
            if line.startswith("ITEM"):
                rows = [] if line.startswith(head) else None
                if rows is not None:
                    blocks.append(rows)
            elif rows is not None:
                rows.append([float(word) for word in line.split()])
    if not blocks:
        sys.exit(f"compare-peers: {path}: holds no '{head}'")
    return [np.array(block) for block in blocks]
