"""The quantities that the tools compute, by their definitions: one loop over contacts, one over grains,
slow and simple on purpose. All results are means per frame, by layer.

Species a and b of a mixed contact are numbered by size, so that a < b and b is the larger one.
"""
import collections
import math

import numpy as np

POWER = 2.0  # exponent Q of power:Q


def layer_of(y, h):
    """Number of the layer at height y: layer n is [n h, (n+1) h); the first layer includes what dips below y = 0."""
    return max(0, math.floor(y / h))


def layers_of(run, frames, h):
    """Number of layers up to the top of the highest grain."""
    top = max((run.height(f["position"][g]) + run.radius[g]
               for f in frames for g in np.flatnonzero(run.mobile & f["present"])), default=0)
    return max(1, math.ceil(top / h))


def by_layer(layers, *shape):
    return collections.defaultdict(lambda: np.zeros((layers, *shape)))


def shares_of_layers(low, high, h, layers):
    """Parts of a stretch between two heights that lie in each layer."""
    low, high = min(low, high), max(low, high)
    first, last = (min(layer_of(y, h), layers - 1) for y in (low, high))
    if first == last:
        return {first: 1.0}
    edges = [low] + [n * h for n in range(first + 1, last + 1)] + [high]
    return {first + k: (edges[k + 1] - edges[k]) / (high - low) for k in range(last - first + 1)}


def contacts_of(run, frame, across=False):
    """Contacts with a force, with the quantities that the definitions need. A contact with a grain that has left the
    bed is only included if `across`: the grain counts as part of the base then."""
    for force, branch, gap, i, j in zip(*(frame[name] for name in ("force", "branch", "gap", "i", "j"))):
        if not force.any():
            continue
        r_i, r_j = run.radius[i], run.radius[j] if j >= 0 else 0.0
        part_i = 1.0 if j < 0 else (r_i + gap / 2) / (r_i + r_j + gap)  # share of i by the contact point
        x_i = frame["position"][i]
        x_j, touch = x_i - branch, x_i - part_i * branch
        left_i, left_j = (g >= 0 and not frame["present"][g] for g in (i, j))
        if (left_i or left_j) and not (across and run.is_mobile(j if left_i else i) and left_i != left_j):
            continue
        if left_i:
            i, j, x_i, x_j, force, branch, part_i = j, i, x_j, x_i, -force, -branch, 1 - part_i
        whole = np.outer(run.turned(force, touch), run.turned(branch, touch))
        yield {"i": i, "j": -1 if left_i or left_j else j, "force": force, "whole": whole, "part_i": part_i,
               "y_i": run.height(x_i), "y_j": run.height(x_j), "y_contact": run.height(touch)}


def pieces(run, c, assignment):
    """(sum, from, to, weight): part of a contact's force (x) branch that is added to a sum, and the
    heights between which this part lies along the branch, starting at its grain."""
    i, j, y_i, y_j = c["i"], c["j"], c["y_i"], c["y_j"]
    a = run.species[i]
    if not run.is_mobile(j):
        yield ("A_b", a), y_i, c["y_contact"], c["part_i"]
        yield ("F_b", a), y_i, y_j, 1.0
        return
    b = run.species[j]
    part_i = c["part_i"]
    if a == b:
        if assignment != "grain":
            yield ("A", a), y_i, y_j, 1.0
            return
        yield ("A", a), y_i, y_j, part_i
        yield ("A", a), y_j, y_i, 1 - part_i
        yield ("H", a), y_i, y_j, 0.5
        yield ("H", a), y_j, y_i, 0.5
        return
    r_large, r_small = run.radius[i], run.radius[j]
    y_large, y_small, part = y_i, y_j, part_i
    if a < b:
        r_large, r_small, y_large, y_small, part = r_small, r_large, y_small, y_large, 1 - part_i
    pair = (min(a, b), max(a, b))
    by_size = r_large / (r_large + r_small)
    for name, share in (("Msize", by_size), ("Mcp", part)):
        yield (name, *pair), y_large, y_large + share * (y_small - y_large), share
    yield ("Mpower", *pair), y_large, y_small, r_large**POWER / (r_large**POWER + r_small**POWER)
    if assignment != "grain":
        yield ("M", *pair), y_large, y_small, 1.0
        return
    yield ("M", *pair), y_large, y_small, by_size
    yield ("M", *pair), y_small, y_large, 1 - by_size
    yield ("ML", *pair), y_large, y_small, 1.0
    yield ("MS", *pair), y_small, y_large, 1.0


def contact_sums(run, frames, h, layers, assignment):
    """Sums of force (x) branch, N m, and numbers of contacts, by layer of the contact point."""
    sums, numbers = by_layer(layers, run.dimension, run.dimension), by_layer(layers)
    for f in frames:
        count = layers_of(run, [f], h)
        for c in contacts_of(run, f):
            here = min(layer_of(c["y_contact"], h), count - 1)
            ends = sorted(run.species[g] for g in (c["i"], c["j"]) if run.is_mobile(g))
            numbers[tuple(ends)][here] += 1 / len(frames)
            for key, start, end, weight in pieces(run, c, assignment):
                shares = {here: 1.0}
                if assignment == "branch":
                    shares = shares_of_layers(start, end, h, count)
                elif assignment == "grain":
                    shares = {min(layer_of(start, h), count - 1): 1.0}
                for n, share in shares.items():
                    sums[key][n] += weight * share * c["whole"] / len(frames)
    return sums, numbers


def partial_stresses(run, sums, h, share_of_larger):
    """sigma^nu = (A + its shares of mixed contacts + A_b)/V, by species; `share_of_larger` is the name of
    the sum of the larger species' shares in mixed contacts."""
    stresses = []
    for s in range(run.species_count):
        total = sums[("A", s)] + sums[("A_b", s)]
        for other in range(run.species_count):
            if other == s:
                continue
            pair = (min(s, other), max(s, other))
            larger = sums[(share_of_larger, *pair)]
            total = total + (larger if s > other else sums[("M", *pair)] - larger)
        stresses.append(total / run.volume_of_layer(h))
    return stresses


def volumes(run, frames, h, layers, composition="clipped", of=lambda motion: 1.0):
    """Area or volume of the mobile grains of each species, times of(motion): clipped at the edges of layers, or whole in
    the layer of the centre."""
    content = np.zeros((run.species_count, layers))
    for g, y, motion in mobile_grains(run, frames):
        s, weight = run.species[g], of(motion) / len(frames)
        if composition == "centre":
            content[s, layer_of(y, h)] += run.volume_of_grain(g) * weight
            continue
        below = 0.0
        for n in range(layers):
            here = run.volume_of_grain(g) if n == layers - 1 else run.volume_below(g, y, (n + 1) * h)
            content[s, n] += (here - below) * weight
            below = here
    return content


def parts_of_kernel(y, h, layers, width):
    """Part of a Gaussian about height y that lies in each layer; the outer layers include the tails."""
    below = [0.5 * math.erfc((y - n * h) / width / math.sqrt(2)) for n in range(1, layers)]
    return np.diff([0.0, *below, 1.0])


def share_of_larger(rule, run, c):
    """Shares of a mixed contact by the definition of the rule; `drop` has none."""
    i, j, part = c["i"], c["j"], c["part_i"]
    r_large, r_small = run.radius[i], run.radius[j]
    if run.species[i] < run.species[j]:
        r_large, r_small, part = r_small, r_large, 1 - part
    return {"size": r_large / (r_large + r_small), "contact-point": part, "half": 0.5, "drop": None,
            f"power:{POWER:g}": r_large**POWER / (r_large**POWER + r_small**POWER)}[rule]


def forces_by_rule(run, frames, h, layers, rule, width):
    """Sums of force per frame, by species and layer: C = sum f [S(y) - S(cut)], beta = sum f S(cut) and
    N = sum f S(y) over contacts. The rule cuts mixed contacts; contacts with the base are cut where they touch."""
    shape = (run.species_count, layers, run.dimension)
    contact, interaction, at_centre = (np.zeros(shape) for _ in range(3))
    for f in frames:
        count = layers_of(run, [f], h)

        def booked(y, force):
            parts = np.zeros(layers)
            parts[:count] = parts_of_kernel(y, h, count, width)
            return np.outer(parts, force) / len(frames)

        for c in contacts_of(run, f, across=True):
            mobile = run.is_mobile(c["j"])
            mixed = mobile and run.species[c["i"]] != run.species[c["j"]]
            ends = [(c["i"], c["y_i"], c["force"])]
            if mobile:
                ends.append((c["j"], f["position"][c["j"]][1], -c["force"]))
            for g, y, force in ends:
                s, cut = run.species[g], c["y_contact"]
                if mixed:
                    p = share_of_larger(rule, run, c)
                    if p is None:
                        cut = y
                    else:
                        part = p if run.species[c["i"]] > run.species[c["j"]] else 1 - p
                        cut = c["y_i"] + part * (c["y_j"] - c["y_i"])
                at_centre[s] += booked(y, force)
                if mixed:
                    interaction[s] += booked(cut, force)
                if mixed or not mobile:
                    contact[s] -= booked(cut, force)
                contact[s] += booked(y, force)
    return contact, interaction, at_centre


def mobile_grains(run, frames):
    """Number of the grain, its height, and its velocity and spin as one vector."""
    for f in frames:
        for g in np.flatnonzero(run.mobile & f["present"]):
            x = f["position"][g]
            yield g, run.height(x), np.append(run.turned(f["velocity"][g], x), run.turned(f["spin"][g], x))


def mean_in_bins(run, frames, bin_height):
    """By bin: mass, mean height, mean motion; only bins that contain grains, from below."""
    sums = {}
    for g, y, motion in mobile_grains(run, frames):
        one = run.mass[g] * np.concatenate(([1.0, y], motion))
        n = layer_of(y, bin_height)
        sums[n] = sums.get(n, 0) + one
    return {n: s / s[0] for n, s in sorted(sums.items())}


def profile(run, frames, h):
    """Velocity profile: straight lines through one point per bin of at most half a d_S; beyond the outer
    points, the slope between the outer two bins."""
    bin_height = h / math.ceil(h / (run.small_diameter / 2) - 1e-9)
    points = np.array([m[1:] for m in mean_in_bins(run, frames, bin_height).values()])
    heights = points[:, 0]

    def line(a, b, y):
        return a[1:] + (b[1:] - a[1:]) * (y - a[0]) / (b[0] - a[0])

    def at(y):
        n = np.searchsorted(heights, y, side="right")
        if n == 0:
            return line(points[0], points[2], y)
        if n == len(points):
            return line(points[-1], points[-3], y)
        return line(points[n - 1], points[n], y)

    return at


def layer_mean(run, frames, h):
    means = mean_in_bins(run, frames, h)
    return lambda y: means[layer_of(y, h)][2:]


def in_mid_step(run, frames):
    """Velocities and spins half a step earlier: minus half the change due to the step's forces and torques."""
    middle = []
    for f in frames:
        torque = np.zeros_like(f["spin"])
        for force, branch, i, j in zip(f["force"], f["branch"], f["i"], f["j"]):
            length = np.linalg.norm(branch)
            arm = -branch / length * run.radius[i]  # from the centre of i to the contact
            if j >= 0:
                arm *= length / (run.radius[i] + run.radius[j])
                torque[j] += np.cross(arm * run.radius[j] / run.radius[i], force)
            torque[i] += np.cross(arm, force)
        one = dict(f, velocity=f["velocity"].copy(), spin=f["spin"].copy())
        for g in np.flatnonzero(run.mobile & f["present"]):
            one["velocity"][g] -= f["total_force"][g] / run.mass[g] * f["step"] / 2
            one["spin"][g] -= torque[g] / run.inertia(g) * f["step"] / 2
        middle.append(one)
    return middle


def fluctuations(run, frames, h, layers, mean_at):
    """sum m dv (x) dv and sum I dw^2, J; a grain belongs to the layer of its centre."""
    d = run.dimension
    kinetic, rotational = by_layer(layers, d, d), by_layer(layers)
    for g, y, motion in mobile_grains(run, frames):
        difference = motion - mean_at(y)
        dv, dw = difference[:d], difference[d:]
        n = layer_of(y, h)
        kinetic[run.species[g]][n] += run.mass[g] * np.outer(dv, dv) / len(frames)
        rotational[run.species[g]][n] += run.inertia(g) * dw @ dw / len(frames)
    return kinetic, rotational


def about_each_frame(run, frames, h, layers):
    """Fluctuations about the mean of the layer in each frame."""
    kinetic, rotational = by_layer(layers, run.dimension, run.dimension), by_layer(layers)
    for f in frames:
        of_frame = fluctuations(run, [f], h, layers, layer_mean(run, [f], h))
        for sums, more in zip((kinetic, rotational), of_frame):
            for s in more:
                sums[s] += more[s] / len(frames)
    return kinetic, rotational


def unbiased_fluctuations(run, frames, h, layers):
    """For each grain, the mean of (v - v_j) (x) (v - v_k) with weight m_j m_k over all pairs of two other
    grains of its layer and frame. Returns the sums of m and of I times this mean, the masses, and the
    number of grains without two others."""
    d = run.dimension
    kinetic, rotational = by_layer(layers, d, d), by_layer(layers)
    mass, left_out = by_layer(layers), by_layer(layers)
    for f in frames:
        members = collections.defaultdict(list)
        for g, y, motion in mobile_grains(run, [f]):
            members[layer_of(y, h)].append((g, motion))
        for n, grains in members.items():
            for g, motion in grains:
                s = run.species[g]
                others = [(run.mass[j], motion - theirs) for j, theirs in grains if j != g]
                if len(others) < 2:
                    left_out[s][n] += 1 / len(frames)
                    continue
                m = np.array([one for one, _ in others])
                away = np.array([one for _, one in others])
                mean = m @ away
                # All pairs j, k, except j = k.
                products = np.outer(mean, mean) - np.einsum("j,ja,jb->ab", m**2, away, away)
                products /= m.sum()**2 - (m**2).sum()
                kinetic[s][n] += run.mass[g] * products[:d, :d] / len(frames)
                rotational[s][n] += run.inertia(g) * np.trace(products[d:, d:]) / len(frames)
                mass[s][n] += run.mass[g] / len(frames)
    return kinetic, rotational, mass, left_out


def about_profile_of_others(run, frames, h, layers):
    """Fluctuations about the profile through the bins with at least three grains, each bin without the grain
    itself; minus the covariance of that mean, from the scatter in its bins about lines with the slope
    between neighbouring bins. Returns sums, masses and the number of grains left out, as above."""
    d = run.dimension
    kinetic, rotational = by_layer(layers, d, d), by_layer(layers)
    mass, left_out = by_layer(layers), by_layer(layers)
    bin_height = h / math.ceil(h / (run.small_diameter / 2) - 1e-9)
    members = collections.defaultdict(list)
    grains = list(mobile_grains(run, frames))
    for k, (_, y, _) in enumerate(grains):
        members[layer_of(y, bin_height)].append(k)
    full = sorted(b for b, of_bin in members.items() if len(of_bin) > 2)

    def line(b):
        """Mass, height and motion of the grains in a bin."""
        m = np.array([run.mass[grains[k][0]] for k in b])
        return m, np.array([grains[k][1] for k in b]), np.array([grains[k][2] for k in b])

    def means(b):
        m, heights, motions = line(b)
        return m @ heights / m.sum(), m @ motions / m.sum()

    slopes = {}
    for at, b in enumerate(full):
        (y0, v0), (y1, v1) = (means(members[full[min(max(k, 0), len(full) - 1)]]) for k in (at - 1, at + 1))
        slopes[b] = (v1 - v0) / (y1 - y0) if y1 > y0 else 0 * v0

    def point(b, without):
        others = [k for k in members[b] if k != without]
        y, v = means(others)
        m, heights, motions = line(others)
        away = motions - v - np.outer(heights - y, slopes[b])
        return y, v, np.einsum("j,ja,jb->ab", m**2, away, away) / (m.sum()**2 - (m**2).sum())

    for k, (g, y, motion) in enumerate(grains):
        n, s, own = layer_of(y, h), run.species[g], layer_of(y, bin_height)
        if not full:
            left_out[s][n] += 1 / len(frames)
            continue
        above = sum(b < own or (b == own and point(b, k)[0] <= y) for b in full)
        last = len(full) - 1
        a, b = (0, min(2, last)) if above == 0 else (last, max(last - 2, 0)) if above > last else (above - 1, above)
        (ya, va, ca), (yb, vb, cb) = point(full[a], k), point(full[b], k)
        part = (y - ya) / (yb - ya) if last else 0
        away = motion - va - part * (vb - va)
        products = np.outer(away, away) - (1 - part)**2 * ca - part**2 * cb
        kinetic[s][n] += run.mass[g] * products[:d, :d] / len(frames)
        rotational[s][n] += run.inertia(g) * np.trace(products[d:, d:]) / len(frames)
        mass[s][n] += run.mass[g] / len(frames)
    return kinetic, rotational, mass, left_out


def coordination_and_force(run, frames, h, layers):
    """z: contact ends per grain, both in the layer of the grain's centre. f: mean magnitude of the force of
    contacts with at least one grain of the species, in the layer of the contact point. The last entry is
    the whole bed."""
    shape = (run.species_count, layers)
    grains, ends, contacts, forces = (np.zeros(shape) for _ in range(4))
    for f in frames:
        for g, y, _ in mobile_grains(run, [f]):
            grains[run.species[g], layer_of(y, h)] += 1
        count = layers_of(run, [f], h)
        for c in contacts_of(run, f):
            on = [g for g in (c["i"], c["j"]) if run.is_mobile(g)]
            for g in on:
                ends[run.species[g], layer_of(f["position"][g][1], h)] += 1
            here = min(layer_of(c["y_contact"], h), count - 1)
            for species in {run.species[g] for g in on}:
                contacts[species, here] += 1
                forces[species, here] += np.linalg.norm(c["force"])

    def with_bed(a):
        return np.append(a, a.sum(axis=1)[:, None], axis=1)

    with np.errstate(invalid="ignore"):
        return with_bed(ends) / with_bed(grains), with_bed(forces) / with_bed(contacts)
