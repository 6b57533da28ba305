"""Invariants that are true to round-off for any step, tolerance and number of sweeps; no warning excuses a violation.

Each function yields Findings; the measured value must not exceed the bound. Bounds are Trajectory.round_off, or 0.
"""
import collections

import numpy as np

from random_scenes.trajectory import in_space

Finding = collections.namedtuple("Finding", "name measured bound place")


def worst(name, values, bound, run):
    """The Finding of the frame with the largest value; NaN counts as infinite."""
    values = np.where(np.isfinite(values), values, np.inf)
    if len(values) == 0:
        return Finding(name, 0.0, bound, "")
    k = int(np.argmax(values))
    return Finding(name, float(values[k]), bound, f"t = {run.time[k]:.6g} s")


def all_of(run):
    for invariant in (numbers, kinematics, momentum, spins, contact_law, energy_balance, energy_of_contacts, boundaries):
        yield from invariant(run)


def numbers(run):
    """Every number is finite."""
    fields = (run.position, run.velocity, run.force, run.spin)
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
    """The change of the angular velocity times the moment of inertia is the torque of the contacts; without rotation spins are 0."""
    if run.keys["rotation"] == "off":
        still = np.abs(run.spin[:, run.mobile]).max(axis=(1, 2))
        yield worst("no rotation", still, 0, run)
        return
    radius = run.radius[run.mobile, None]
    error = np.abs(np.diff(run.spin, axis=0) - run.spin_change[1:])[:, run.mobile] * radius
    rims = np.abs(run.spin[:, run.mobile] * radius).max(axis=(1, 2))
    unit = rims[1:] + rims[:-1] + (run.largest_force * run.part)[1:] / run.mass[run.mobile].min() + 1e-300
    error = error.max(axis=(1, 2)) / unit
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
    beyond = per_frame_largest(run, np.linalg.norm(run.tangential_force, axis=1) - friction * run.normal_force)
    yield worst("Coulomb's limit", beyond / run.largest_force, run.round_off * max(1, friction), run)
    # sim/contact/contact_law.hpp: |x_m + forecast h (v_i - v_j)| <= r_i + r_j + margin.
    law = run.keys["contact-law"]
    forecast = run.number("horizon") if law == "speculative" else {"touch": 0, "centred": 0.5, "predictive": 1}[law]
    along, relative = run.separation(run.before), run.relative(run.before)
    onward = (forecast * run.part)[run.frame_of]
    reach = np.linalg.norm(run.branch, axis=1) - run.gap
    then = np.where(run.j >= 0, np.linalg.norm(run.branch + onward[:, None] * relative, axis=1) - reach,
                    run.gap + onward * along)
    small = run.number("small-diameter")
    open_gap = (then - run.parameters["contact_margin"]) / small
    unit = 1 + run.size / small  # scale of the round-off of positions, d_S
    yield worst("no force across a gap", per_frame_largest(run, open_gap) / unit, run.round_off, run)


def works(run):
    """Two works in each frame's step, J, from the motion of both grains: of all contacts, and of moving boundaries; then the
    sum of absolute values of all terms, as a scale, and the error of works by the last digits of the file's numbers."""
    mean, spin = (run.before + run.velocity) / 2, run.spin - run.spin_change / 2
    sliding = np.einsum("ca,ca->c", run.tangential_force, run.sliding(mean, spin))
    duration = run.part[run.frame_of]
    parts = duration * np.stack([run.normal_force * run.separation(mean), sliding])
    total = run.sum_of_contacts(parts.sum(axis=0))
    by_boundary = (run.j >= 0) & run.fixed[run.j]
    surface = mean[run.frame_of, run.j] + run.rim(spin, run.j)
    work = duration * np.einsum("ca,ca->c", run.contact_force, surface)
    boundary = run.sum_of_contacts(np.where(by_boundary, work, 0))
    size = run.sum_of_contacts(np.abs(parts).sum(axis=0) + np.where(by_boundary, np.abs(work), 0))
    return total, boundary, size, run.last_digits * run.sum_of_contacts(duration * scale_of_power(run))


def scale_of_power(run):
    """Contact force times the speeds of both grains [C], W. A grain at rest has the speed that the sum of its impulses would
    give it if they did not cancel."""
    force = np.linalg.norm(run.contact_force, axis=1)
    sum_of_forces = np.zeros(run.velocity.shape[:2])
    both = run.j >= 0
    np.add.at(sum_of_forces, (run.frame_of, run.i), force)
    np.add.at(sum_of_forces, (run.frame_of[both], run.j[both]), force[both])
    speed = np.linalg.norm(run.velocity, axis=2) + np.linalg.norm(run.spin, axis=2) * run.radius
    speed += np.where(run.fixed, 0, sum_of_forces / run.mass) * run.part[:, None]
    return force * (speed[run.frame_of, run.i] + np.where(both, speed[run.frame_of, run.j], 0))


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
    total, boundary, size, digits = works(run)
    unit = size + digits / run.round_off + kinetic + still
    error = np.abs(total - seen["work_of_contacts"]) + np.abs(boundary - seen["work_of_boundaries"])
    yield worst("works", error / unit, run.round_off, run)
    missing = np.diff(kinetic) - (total + boundary + work_of_gravity(run))[1:]
    # The work of gravity may be small because some grains fall while others rise, so its scale is the sum of all momenta.
    speeds = np.linalg.norm(run.velocity + run.before, axis=2)[:, run.mobile] @ run.mass[run.mobile]
    unit = unit[1:] + kinetic[:-1] + (speeds * run.part * np.linalg.norm(run.gravity, axis=1))[1:]
    yield worst("energy changes by work", np.where(run.follows[1:], np.abs(missing) / unit, 0), run.round_off, run)


def work_of_gravity(run):
    """In each frame's step, J."""
    falling = run.part[:, None] * np.einsum("g,fga->fa", run.mass * run.mobile, run.velocity + run.before) / 2
    return (run.gravity * falling).sum(axis=1)


def given_away(run):
    """Energy in each frame's step, J, that contacts may give back in the next step. The speculative law slows down pairs
    that are still apart, and they rebound later: impulses of these pairs times their approach before the step."""
    if run.keys["contact-law"] != "speculative":
        return np.zeros(run.frames)
    approach = np.maximum(-run.separation(run.before), 0)
    return run.sum_of_contacts(np.where(run.gap > 0, run.part[run.frame_of] * run.normal_force * approach, 0))


def elastic_energy(run):
    """Energy in each frame's step, J, of contacts as soft springs. With N sweeps a step, a contact whose inverse masses have
    the sum W is as soft as a spring of stiffness N/(W h^2) (hard case H14), which an impulse p fills with W p^2/(2 N)."""
    inverse = np.where(run.fixed, 0, 1 / run.mass)
    inverse = inverse[run.i] + np.where(run.j >= 0, inverse[run.j], 0)
    impulse = run.part[run.frame_of] * run.normal_force
    return run.sum_of_contacts(inverse * impulse**2) / (2 * max(run.parameters["min_sweeps"], 1))


def free_work(run):
    """Largest work of contacts in each frame's step without rebounds, J.

    Contacts with impulses p, and relative velocities u before and u' after the step, do the work W = p.(u + u')/2. The
    velocity of a grain changes by g h + q, with m q the sum of impulses on it, and that of a boundary's surface by V' - V. So
    W = p.u' + sum of p.(V' - V)/2 - sum of m q.(g h + q)/2, less a positive term of rotation. Without rebounds p.u' <= 0,
    and -m q.(g h + q)/2 is at most m (g h)^2/8 for any q."""
    fall = np.linalg.norm(run.gravity, axis=1) * run.part
    work = run.mass[run.mobile].sum() * fall**2 / 8 + push_of_boundaries(run)
    if run.keys["geometry"] == "shear":  # the plate falls by its load
        work += (run.number("plate-pressure") * run.base_area * run.part) ** 2 / (8 * run.number("plate-mass"))
    return work


def push_of_boundaries(run):
    """The sum of p.(V' - V)/2 in each frame's step, J, if it is above 0; without the motion that a free plate has along y."""
    change = (run.velocity - run.before)[run.frame_of, run.j]
    if run.keys["geometry"] == "shear":
        change[:, 1] = 0
    push = run.part[run.frame_of] * np.einsum("ca,ca->c", run.contact_force, change) / 2
    return np.maximum(run.sum_of_contacts(np.where((run.j >= 0) & run.fixed[run.j], push, 0)), 0)


def tolerated(run):
    """Accepted error of the energies of a step, over their sum (round_off() of sim/step/energy_limit.cpp)."""
    return 1e-6 if run.keys["precision"] == "mixed" else 1e-12


def energy_of_contacts(run):
    """Contacts do at most the work that free_work() allows, and give back at most what they held after the step before."""
    total, boundary, size, digits = works(run)
    kinetic = sum(run.kinetic)
    energies = kinetic + np.append(0, kinetic[:-1]) + np.abs(work_of_gravity(run)) + np.abs(boundary)
    digits = digits + tolerated(run) * energies
    held = np.append(0, (given_away(run) + elastic_energy(run))[:-1])
    # The step before is known if both steps were whole.
    known = run.follows & np.append(True, run.whole[:-1])
    excess = np.maximum(total - free_work(run) - held - digits, 0) / (size + sum(run.kinetic) + 1e-300)
    yield worst("energy from contacts", np.where(known, excess, 0), run.last_digits, run)


def displaced(run, time):
    """Motion of the boundaries up to `time`, s: rotation about the centre of the drum [F, 3, 3] and shift, m [F, 3]."""
    later = np.maximum(time, 0)
    geometry = run.keys["geometry"]
    turn, shift = np.zeros((len(later), 3, 3)), np.zeros((len(later), 3))
    angle = run.number("drum-rate") * later if geometry == "drum" else 0 * later
    turn[:, 0, 0] = turn[:, 1, 1] = np.cos(angle)
    turn[:, 1, 0], turn[:, 0, 1] = np.sin(angle), -np.sin(angle)
    turn[:, 2, 2] = 1
    if geometry == "shear":
        shift[:, 0] = run.number("plate-speed") * later
    if geometry == "bed":
        phase = 2 * np.pi * run.number("shake-frequency") * later
        shift[:, 1] = run.number("shake-amplitude") * np.sin(phase)
    return turn, shift


def moving(run):
    """Rows of the boundary grains that move."""
    rows = np.flatnonzero(run.fixed)
    geometry = run.keys["geometry"]
    if geometry == "shear":
        return rows[len(rows) // 2:]
    driven = geometry == "drum" or (geometry == "bed" and run.number("shake-amplitude") > 0)
    return rows if driven else rows[:0]


def boundaries(run):
    """Boundary grains are where their motion puts them at the beginning and the end of each step; in between they move as
    grains do, half the step with the velocity before and half with that after it."""
    rows = moving(run)
    others = np.setdiff1d(np.flatnonzero(run.fixed), rows)
    if len(others):
        shift = np.abs(run.position[:, others] - run.position[0, others]).max(axis=(1, 2))
        speed = (np.abs(run.velocity[:, others]) + np.abs(run.spin[:, others])).max(axis=(1, 2))
        yield worst("boundaries stand still", shift + speed, 0, run)
    if len(rows) == 0:
        return
    centre = in_space(run.parameters["drum_centre"]) if run.keys["geometry"] == "drum" else 0
    half, end = run.part / 2, run.time + run.part / 2
    errors = []
    for time, velocity in ((end - run.part, -run.before), (end, run.velocity)):
        place = run.position[:, rows] + half[:, None, None] * velocity[:, rows] - centre
        turn, shift = displaced(run, time)
        begin = (place[0] - shift[0]) @ np.linalg.inv(turn[0]).T
        error = place - begin @ turn.transpose(0, 2, 1) - shift[:, None]
        if run.keys["geometry"] == "shear":  # the plate is free along y, as one body
            error[..., 1] -= error[:, :1, 1].copy()
        errors.append(np.abs(error).max(axis=(1, 2)))
    yield worst("boundaries where their motion puts them", np.maximum(*errors) / run.size, run.round_off / 10, run)
    rate = run.number("drum-rate") if run.keys["geometry"] == "drum" else 0
    spin = np.where(end > 0, rate, 0)[:, None] * np.array([0, 0, 1])
    turned = np.abs(run.spin[:, rows] - spin[:, None]).max(axis=(1, 2))
    yield worst("boundaries turn at their rate", turned / (abs(rate) + 1e-300), run.round_off, run)
