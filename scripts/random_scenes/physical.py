"""Invariants that an exact solution satisfies, and that a solver which stops early may violate, if the run warns.

Sweeps end at a tolerance on their last change, and no theorem derives a bound on energy or overlap from it. The bounds
here are therefore coarse: no user would accept a larger error in a flow of rigid grains. A warning of the run (a missed
tolerance, a line `doubt` in its summary) excuses a violation, but for a rise of energy.
"""
import numpy as np

from random_scenes.exact import (Finding, elastic_energy, free_work, given_away, moving, tolerated, work_of_gravity, worst)

# Largest overlap that grseg-check accepts, over the smaller diameter (docs/studies/check.md).
MOST_OVERLAP = 0.1
# Created energy over the energy that lifts all grains by d_S. Hard case G14 allows 0.02, for a known scene
# (tests/hard_cases/rest_test.cpp).
MOST_CREATED = 0.05
PAIRS_AT_MOST = 5e6  # most pairs that are checked in all frames; acting pairs are checked in every frame
REST, STILL = 1e-12, 1e-10  # kinetic energy over the energy that lifts all grains by d_S


def all_of(run, excused):
    """Findings; of energy alone if a warning excuses the others."""
    for invariant in (undriven,) if excused else (undriven, overlaps, outside, rebounds, plate, rest):
        yield from invariant(run)


def overlaps(run):
    """No two grains overlap by more than their approach in a step plus MOST_OVERLAP, the error of the sweeps.

    A contact law that acts once discs touch stops them within a step (sim/contact/contact_law.hpp: overlap up to |u| h).
    Approaches in the deposition count, too: a fall from three times the depth of the bed."""
    fall = np.sqrt(6 * run.number("gravity") * run.number("depth"))
    fastest = np.maximum.accumulate(np.maximum(run.observables["fastest_approach"], fall))
    smallest = 2 * run.radius[run.mobile].min()
    approach = fastest * run.number("step") / smallest
    stride = int(np.ceil(run.frames * len(run.radius) ** 2 / PAIRS_AT_MOST))
    deepest = np.zeros(run.frames)
    both = run.j >= 0
    smaller = np.where(both, np.minimum(run.radius[run.i], run.radius[run.j]), run.radius[run.i])
    np.maximum.at(deepest, run.frame_of, -run.gap / (2 * smaller))
    for k in {*range(0, run.frames, stride), run.frames - 1}:
        deepest[k] = max(deepest[k], deepest_pair(run, run.position[k]))
    deepest = np.maximum(deepest, deepest_in_walls(run))
    k = int(np.argmax(deepest - approach))
    yield Finding("overlaps", float(deepest[k]), float(MOST_OVERLAP + approach[k]), f"t = {run.time[k]:.6g} s")


def deepest_pair(run, position):
    """The largest overlap over the smaller diameter, of all pairs with a mobile grain."""
    apart = position[:, None] - position[None, run.mobile]
    apart -= np.where(run.periodic, run.edges * np.round(apart / np.where(run.periodic, run.edges, 1)), 0)
    a, b = run.radius[:, None], run.radius[None, run.mobile]
    overlap = (a + b - np.linalg.norm(apart, axis=2)) / (2 * np.minimum(a, b))
    overlap[np.flatnonzero(run.mobile), np.arange(overlap.shape[1])] = 0
    return overlap.max()


def walls_of(run):
    """Planes that no grain may pass, each a point and a normal."""
    planes = []
    if run.keys["base"] == "wall":
        planes.append(((0, 0, 0), (0, 1, 0)))
    if run.keys["lateral"] == "walls" and run.keys["geometry"] != "drum":
        planes += [((0, 0, 0), (1, 0, 0)), ((run.number("length"), 0, 0), (-1, 0, 0))]
    if run.keys.get("sides") == "walls":
        planes += [((0, 0, 0), (0, 0, 1)), ((0, 0, run.number("width")), (0, 0, -1))]
    if run.keys["geometry"] == "hopper":
        planes.append(((0, -1.3 * run.number("depth"), 0), (0, 1, 0)))
    return planes


def deepest_in_walls(run):
    """The largest overlap with a wall in each frame, over the grain's diameter."""
    deepest = np.zeros(run.frames)
    radius = run.radius[run.mobile]
    for point, normal in walls_of(run):
        distance = (run.position[:, run.mobile] - point) @ np.array(normal, float)
        deepest = np.maximum(deepest, ((radius - distance) / (2 * radius)).max(axis=1))
    return deepest


def outside(run):
    """No centre of a grain lies below the lowest centre of the base, outside the ring of a drum, or above the plate."""
    x, geometry = run.position, run.keys["geometry"]
    if not run.fixed.any() or geometry == "hopper":
        return
    small = run.number("small-diameter")
    if geometry == "drum":
        away = np.linalg.norm(x[..., :2] - run.parameters["drum_centre"], axis=2)
        beyond = away[:, run.mobile].max(axis=1) - away[:, run.fixed].max(axis=1)
    else:
        # The lower half of the boundary grains of a shear cell are its base.
        beyond = x[:, run.fixed, 1].min(axis=1) - x[:, run.mobile, 1].min(axis=1)
    if geometry == "shear":
        beyond = np.maximum(beyond, x[:, run.mobile, 1].max(axis=1) - x[:, moving(run), 1].max(axis=1))
    yield worst("no grain passes a boundary", beyond / small, 0, run)


def kinetic_energy(run):
    """Kinetic energy in each frame, J, of the grains and of a plate, which is free along y."""
    energy = sum(run.kinetic)
    if run.keys["geometry"] == "shear":
        energy = energy + run.number("plate-mass") * run.velocity[:, moving(run)[0], 1] ** 2 / 2
    return energy


def rebounds(run):
    """No pair rebounds faster than with e times its approach.

    With impulses p and relative velocities u before and u' after a step, contacts do the work p.(u + u')/2. In an
    exact solution p_n (u'_n - rebound) = 0, rebound <= e times the approach, and p_t u'_t <= 0. Hence
    sum p_n (u'_n - e approach) + p_t u'_t <= 0 in each step, for any friction and e (docs/studies/accuracy.md).
    A positive value of this sum over a span of steps is what contacts held before it as soft springs, or an error of the
    solver. Its unit is the energy that lifts all grains by d_S plus the largest kinetic energy; 0.05 of the work of
    boundaries within the span is tolerated."""
    excess = run.sum_of_contacts(run.part[run.frame_of] * (
        run.normal_force * (run.separation(run.velocity) - run.number("restitution") * approaches(run))
        + np.einsum("ca,ca->c", run.tangential_force, run.sliding(run.velocity, run.spin))))
    excess -= MOST_CREATED * np.abs(run.observables["work_of_boundaries"])
    # The approach before the previous step is known if both steps were whole.
    known = run.follows & np.append(True, run.whole[:-1])
    held = elastic_energy(run)
    total = largest = 0.0
    least, place = held[0], 0
    for k in range(run.frames):
        if not known[k]:
            total, least = 0.0, held[k]
            continue
        total += excess[k]
        if total - least > largest:
            largest, place = total - least, k
        least = min(least, total + held[k])
    unit = run.unit_of_energy + kinetic_energy(run).max()
    yield Finding("rebounds", float(largest / unit), MOST_CREATED, f"until t = {run.time[place]:.6g} s")


def approaches(run):
    """Approach velocity of each contact, m/s, before its step, or before the previous step if that is larger and the
    speculative law remembers it."""
    now = np.maximum(-run.separation(run.before), 0)
    if run.keys["contact-law"] != "speculative":
        return now
    wide = len(run.radius) + 16
    key = (run.frame_of * wide + run.i) * wide + run.j + 8
    order = np.argsort(key)
    place = np.searchsorted(key[order], key - wide * wide)
    place = order[np.minimum(place, len(order) - 1)] if len(order) else place
    same = key[place] == key - wide * wide
    return np.where(same, np.maximum(now, now[place]), now)


def plate(run):
    """The momentum of a plate that is free along y follows from its load and its contacts. The solver computes it together
    with the contacts, to the tolerance; over a run the error must be below 0.05 of the load's impulse."""
    if run.keys["geometry"] != "shear" or not run.follows[1:].all():
        return
    rows = moving(run)
    mass, load = run.number("plate-mass"), -run.number("plate-pressure") * run.base_area
    on_plate = (run.j >= 0) & np.isin(run.j, rows)
    force = -run.sum_of_contacts(np.where(on_plate, run.contact_force[:, 1], 0)) + load
    gained = mass * (run.velocity[-1, rows[0], 1] - run.velocity[0, rows[0], 1])
    impulse = (force * run.part)[1:].sum()
    yield Finding("momentum of the plate", float(abs(gained - impulse) / (abs(load) * run.part[1:].sum())), 0.05, "the whole run")


def is_driven(run):
    """True if a boundary moves or gravity turns."""
    geometry = run.keys["geometry"]
    speed = {"drum": run.number("drum-rate"), "shear": run.number("plate-speed")}.get(geometry, 0)
    shaken = geometry == "bed" and len(moving(run)) > 0
    return speed != 0 or shaken or run.parameters["slope_rate"] != 0


def undriven(run):
    """If boundaries are at rest and gravity does not turn, energy rises from one frame to a later one at most by what contacts
    held after the first, as soft springs or for later rebounds, and by free_work() in each step between. The invariant
    energy_of_contacts() sees only steps that are frames. No warning excuses a rise."""
    if is_driven(run) or run.keys["geometry"] == "shear" or run.time[0] < 0:
        return
    kinetic = sum(run.kinetic)
    energy = kinetic + run.observables["potential_energy"]
    whole = run.number("step") / run.part
    allowed = (run.step - run.step[0]) * (free_work(run) * whole**2).max()
    held = given_away(run) + elastic_energy(run)
    gain = energy - allowed - np.minimum.accumulate(energy - allowed + held)
    # Between frames energies may be twice as large as in frames.
    moved = 2 * kinetic + np.abs(work_of_gravity(run))
    digits = 2 * tolerated(run) * moved.max() * (run.step[-1] - run.step[0]) + run.round_off * np.abs(energy).max()
    yield worst("energy never rises undriven", gain / run.unit_of_energy, digits / run.unit_of_energy, run)


def rest(run):
    """A bed that is at rest, and not driven, stays at rest. A bed is at rest if its kinetic energy is below 1e-12 of the
    energy that lifts all grains by d_S, for the time of a fall through d_S/2. Gravity tilts and gates open at t = 0."""
    if is_driven(run):
        return
    kinetic = sum(run.kinetic) / run.unit_of_energy
    fall = np.sqrt(run.number("small-diameter") / run.number("gravity"))
    loud = run.time[(kinetic >= REST) | (run.time < 0)]
    since = run.time - np.array([loud[loud <= t].max(initial=run.time[0]) for t in run.time])
    quiet = since > fall
    if not quiet.any():
        return
    first = int(np.argmax(quiet))
    k = first + int(np.argmax(kinetic[first:]))
    yield Finding("what rests stays at rest", float(kinetic[k]), STILL, f"t = {run.time[k]:.6g} s")
