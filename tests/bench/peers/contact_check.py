"""Collides pairs of grains in each program and reports the resulting restitution and inertia.

Five pairs, small-small, large-small, large-large, small-base, large-base, far apart and without
gravity, fly at each other with some sliding. From the velocities before and after:
    e          -(normal relative velocity after)/(before), requested: 0.25. At the step of the
               comparison it depends on the phase of the collision within a step; 1/20 of that step
               shows the contact law itself
    inertia    I/(m r^2) = (change of tangential velocity)/(r x change of spin), 0.5 for a disc, 0.4 for
               a sphere, whatever the contact law, as both changes come from one tangential impulse
               (1 to 3 % less because the pair turns during contact)
"""
import copy
import os

import numpy as np

from .soft_grains import Plan
from .state import BASE, LARGE, SMALL, State, WRITERS

PAIRS = {"SS": (SMALL, SMALL), "LS": (LARGE, SMALL), "LL": (LARGE, LARGE), "Sb": (SMALL, BASE),
         "Lb": (LARGE, BASE)}
APPROACH, SLIDING = 1.0, 0.3  # sqrt(g d_S)
CLEARANCE = 0.02              # d_S, before the collision


def pairs_state(dimension):
    """State with pairs of grains: the first above the second, falling on it and sliding along x."""
    type_, radius, position, velocity = [], [], [], []
    for k, (upper, lower) in enumerate(PAIRS.values()):
        r = [0.5 if kind == SMALL else 1.0 for kind in (upper, lower)]
        x = 6 + 12 * k
        type_ += [upper, lower]
        radius += r
        position += [[x - SLIDING * CLEARANCE / APPROACH, r[0] + r[1] + CLEARANCE], [x, 0]]
        velocity += [[SLIDING, -APPROACH], [0, 0]]
    position, velocity = (np.pad(np.array(field, float), ((0, 0), (0, dimension - 2)))
                          for field in (position, velocity))
    spin = np.zeros(len(type_) if dimension == 2 else (len(type_), 3))
    return State(70.0, np.array(type_), np.array(radius), position, velocity, spin,
                 width=1.0 if dimension == 2 else 10.0)


def collide(program, data, folder, core):
    """Restitution e and inertia factor of every pair."""
    # Long enough for the softest disc to separate, short enough that none flies far.
    plan = Plan(warm=1, timed=int(0.08 / program.step), every=1, frames=1, gravity=0.0)
    end = program.run(folder, data, plan, core).end
    found = []
    for k in range(len(PAIRS)):
        upper, lower = end[2 * k, 1:], end[2 * k + 1, 1:]
        radius = data["state"].radius[2 * k]
        found.append(((upper[1] - lower[1]) / APPROACH, (upper[0] - SLIDING) / (radius * upper[2])))
    return found


def check(programs, dimension, folder, core):
    """Rows (program, pair, e, e at 1/20 of the step, inertia factor)."""
    state = pairs_state(dimension)
    data = {"state": state, "folder": folder}
    os.makedirs(folder, exist_ok=True)
    for form, write in WRITERS.items():
        data[form] = os.path.join(folder, "pairs." + form)
        with open(data[form], "w") as out:
            write(state, out)
    rows = []
    for program in programs:
        fine = copy.copy(program)
        fine.step = program.step / 20
        within = os.path.join(folder, program.name.replace(" ", "-"))
        rows += [(program.name, pair, e, fine_e, inertia) for pair, (e, _), (fine_e, inertia) in
                 zip(PAIRS, collide(program, data, within, core), collide(fine, data, within, core))]
    return rows
