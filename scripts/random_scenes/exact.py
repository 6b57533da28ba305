"""Invariants that are true to round-off for any step, tolerance and number of sweeps; no warning excuses a violation.

Each function yields Findings; the measured value must not exceed the bound. Bounds are Trajectory.round_off, or 0.
"""
import collections

import numpy as np

Finding = collections.namedtuple("Finding", "name measured bound place")


def worst(name, values, bound, run):
    """The Finding of the frame with the largest value; NaN counts as infinite."""
    values = np.where(np.isfinite(values), values, np.inf)
    if len(values) == 0:
        return Finding(name, 0.0, bound, "")
    k = int(np.argmax(values))
    return Finding(name, float(values[k]), bound, f"t = {run.time[k]:.6g} s")


def all_of(run):
    for invariant in (numbers, kinematics, momentum, spins, contact_law, energy_balance, boundaries):
        yield from invariant(run)


def numbers(run):
    """Every number is finite."""
    fields = (run.position, run.velocity, run.force, run.spin[..., None])
    bad = sum((~np.isfinite(field)).sum(axis=(1, 2)) for field in fields)
    yield worst("finite numbers", bad, 0, run)


def kinematics(run):
    """A mobile grain moves only with its velocity, from the middle of one step to the middle of the next."""
    duration = (run.part[:-1] + run.part[1:]) / 2
    moved = np.diff(run.position, axis=0) - duration[:, None, None] * run.velocity[:-1]
    error = np.abs(moved[:, run.mobile]).max(axis=(1, 2)) / run.size
    # Positions have single precision: 6e-8 of the cell.
    yield worst("positions follow velocities", np.where(run.follows[1:], error, 0), run.round_off / 100, run)


def momentum(run):
    """Newton's second law of each mobile grain: its force is the sum of contact forces and weight, and the force
    explains the change of velocity since the frame before."""
    balance = run.mass[:, None] * run.gravity[:, None, :] - run.force
    np.add.at(balance, (run.frame_of, run.i), run.contact_force)
    both = run.j >= 0
    np.add.at(balance, (run.frame_of[both], run.j[both]), -run.contact_force[both])
    error = np.linalg.norm(balance[:, run.mobile], axis=2).max(axis=1) / run.largest_force
    # During the sweeps impulses are up to `friction` times as large as their final values.
    yield worst("forces on a grain", error, run.round_off * max(1, run.number("friction")), run)
    jump = (run.before[1:] - run.velocity[:-1])[:, run.mobile]
    fastest = np.abs(run.velocity[:, run.mobile]).max(axis=(1, 2))
    # Scale of the round-off of velocities, and of a force over a step.
    unit = fastest[1:] + fastest[:-1] + (run.largest_force * run.part)[1:] / run.mass[run.mobile].min() + 1e-300
    error = np.abs(jump).max(axis=(1, 2)) / unit
    yield worst("velocities follow forces", np.where(run.follows[1:], error, 0), run.round_off, run)


def spins(run):
    """The change of the angular velocity times I = m r^2/2 is the torque of the contacts; without rotation spins are 0."""
    if run.keys["rotation"] == "off":
        still = np.abs(run.spin[:, run.mobile]).max(axis=1)
        yield worst("no rotation", still, 0, run)
        return
    error = np.abs(np.diff(run.spin, axis=0) - run.spin_change[1:])[:, run.mobile] * run.radius[run.mobile]
    rims = np.abs(run.spin * run.radius)[:, run.mobile].max(axis=1)
    unit = rims[1:] + rims[:-1] + (run.largest_force * run.part)[1:] / run.mass[run.mobile].min() + 1e-300
    error = error.max(axis=1) / unit
    yield worst("spins follow torques", np.where(run.follows[1:], error, 0), run.round_off, run)


def per_frame_largest(run, values):
    largest = np.zeros(run.frames)
    np.maximum.at(largest, run.frame_of, values)
    return largest


def contact_law(run):
    """No contact pulls, none exceeds Coulomb's limit, and none bears a force across a gap at which the contact law does
    not act."""
    friction = run.number("friction")
    pull = per_frame_largest(run, -run.normal_force) / run.largest_force
    yield worst("no tension", pull, run.round_off, run)
    beyond = per_frame_largest(run, np.abs(run.tangential_force) - friction * run.normal_force)
    yield worst("Coulomb's limit", beyond / run.largest_force, run.round_off * max(1, friction), run)
    # sim/contact/contact_law.hpp: |x_m + forecast h (v_i - v_j)| <= r_i + r_j + margin.
    forecast = {"touch": 0, "centred": 0.5, "predictive": 1, "speculative": run.number("horizon")}[run.keys["contact-law"]]
    along, relative = run.separation(run.before)
    onward = (forecast * run.part)[run.frame_of]
    reach = np.linalg.norm(run.branch, axis=1) - run.gap
    then = np.where(run.j >= 0, np.linalg.norm(run.branch + onward[:, None] * relative, axis=1) - reach,
                    run.gap + onward * along)
    small = run.number("small-diameter")
    open_gap = (then - run.parameters["contact_margin"]) / small
    unit = 1 + run.size / small  # scale of the round-off of positions, d_S
    yield worst("no force across a gap", per_frame_largest(run, open_gap) / unit, run.round_off, run)


def works(run):
    """Three works in each frame's step, J, from the motion of both grains: of all contacts; of moving boundaries; and the
    sum of absolute values of all terms, as a scale."""
    mean, spin = (run.before + run.velocity) / 2, run.spin - run.spin_change / 2
    along, _ = run.separation(mean)
    sliding = run.sliding(mean, spin)
    duration = run.part[run.frame_of]
    parts = duration * np.stack([run.normal_force * along, run.tangential_force * sliding])
    total = run.sum_of_contacts(parts.sum(axis=0))
    by_boundary = (run.j >= 0) & run.fixed[run.j]
    surface = mean[run.frame_of, run.j] + (run.arm * (spin * run.radius)[run.frame_of, run.j])[:, None] * run.tangent
    work = duration * np.einsum("ca,ca->c", run.contact_force, surface)
    boundary = run.sum_of_contacts(np.where(by_boundary, work, 0))
    size = run.sum_of_contacts(np.abs(parts).sum(axis=0) + np.where(by_boundary, np.abs(work), 0))
    return total, boundary, size


def energy_balance(run):
    """Energies and works in the file agree with the motion, and kinetic energy changes only by work."""
    seen = run.observables
    translation, rotation = run.kinetic
    kinetic = translation + rotation
    # The smallest velocities of a bed at rest have few correct digits.
    still = 1e-30 * run.unit_of_energy + 1e-300
    unit = kinetic + still
    error = np.abs(translation - seen["translational_energy"]) + np.abs(rotation - seen["rotational_energy"])
    yield worst("energies", error / unit, run.round_off, run)
    total, boundary, size = works(run)
    unit = size + kinetic + still
    error = np.abs(total - seen["work_of_contacts"]) + np.abs(boundary - seen["work_of_boundaries"])
    yield worst("works", error / unit, run.round_off, run)
    falling = run.part[:, None] * np.einsum("g,fga->fa", run.mass * run.mobile, run.velocity + run.before) / 2
    by_gravity = (run.gravity * falling).sum(axis=1)
    missing = np.diff(kinetic) - (total + boundary + by_gravity)[1:]
    # The work of gravity may be small because some grains fall while others rise, so its scale is the sum of all momenta.
    speeds = np.linalg.norm(run.velocity + run.before, axis=2)[:, run.mobile] @ run.mass[run.mobile]
    unit = unit[1:] + kinetic[:-1] + (speeds * run.part * np.linalg.norm(run.gravity, axis=1))[1:]
    yield worst("energy changes by work", np.where(run.follows[1:], np.abs(missing) / unit, 0), run.round_off, run)


def displaced(run, time):
    """Motion of the boundaries up to `time`, s: factor and shift (m) of positions x + iy about the centre of rotation."""
    later = np.maximum(time, 0)
    geometry = run.keys["geometry"]
    if geometry == "drum":
        return np.exp(1j * run.number("drum-rate") * later), 0 * later
    if geometry == "shear":
        return np.ones_like(later), run.number("plate-speed") * later + 0j
    phase = 2 * np.pi * run.number("shake-frequency") * later
    return np.ones_like(later), 1j * run.number("shake-amplitude") * np.sin(phase)


def moving(run):
    """Rows of the boundary grains that move."""
    rows = np.flatnonzero(run.fixed)
    geometry = run.keys["geometry"]
    if geometry == "shear":
        return rows[len(rows) // 2:]
    driven = geometry == "drum" or (geometry == "bed" and run.number("shake-amplitude") > 0)
    return rows if driven else rows[:0]


def boundaries(run):
    """Boundary grains have the positions that their motion prescribes: the middle of the chord of each step."""
    rows = moving(run)
    others = np.setdiff1d(np.flatnonzero(run.fixed), rows)
    if len(others):
        shift = np.abs(run.position[:, others] - run.position[0, others]).max(axis=(1, 2))
        speed = np.abs(run.velocity[:, others]).max(axis=(1, 2)) + np.abs(run.spin[:, others]).max(axis=1)
        yield worst("boundaries stand still", shift + speed, 0, run)
    if len(rows) == 0:
        return
    centre = complex(*run.parameters["drum_centre"]) if run.keys["geometry"] == "drum" else 0
    place = run.position[:, rows, 0] + 1j * run.position[:, rows, 1] - centre
    end = run.time + run.part / 2
    chord = [(a + b) / 2 for a, b in zip(displaced(run, end - run.part), displaced(run, end))]
    begin = (place[0] - chord[1][0]) / chord[0][0]
    error = place - chord[0][:, None] * begin - chord[1][:, None]
    if run.keys["geometry"] == "shear":  # the plate is free along y, as one body
        along = error.imag - error.imag[:, :1]
        error = error.real + 1j * along
    yield worst("boundaries where their motion puts them", np.abs(error).max(axis=1) / run.size, run.round_off / 10, run)
    rate = run.number("drum-rate") if run.keys["geometry"] == "drum" else 0
    turned = np.abs(run.spin[:, rows] - np.where(end > 0, rate, 0)[:, None]).max(axis=1)
    yield worst("boundaries turn at their rate", turned / (abs(rate) + 1e-300), run.round_off, run)
