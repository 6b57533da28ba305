"""A few frames of a trajectory, read directly from the file; with faults, if requested."""
import math

import h5py
import numpy as np


class Run:
    """Species are numbered by size from 0, as in the file; the boundary has the number `species`."""

    def __init__(self, path, frames):
        with h5py.File(path, "r") as f:
            grains = f["particles/grains"]
            box = grains["box"]
            self.dimension = int(np.ravel(box.attrs["dimension"])[0])
            edges = box["edges"][:]
            self.length = float(edges[0])
            self.width = float(edges[2]) if self.dimension == 3 else 1.0
            listed = f["grseg/species"]
            self.names = [name.decode() for name, mobile in zip(listed["name"], listed["mobile"]) if mobile]
            self.species_count = len(self.names)
            self.nominal = [float(d) for d, mobile in zip(listed["diameter"], listed["mobile"]) if mobile]
            self.radius = grains["radius"][:].astype(float)
            self.mass = grains["mass"][:].astype(float)
            self.species = grains["species"][:].astype(int)
            self.mobile = (self.species != self.species_count) & (grains["fixed"][:] == 0)
            self.small_diameter = float(f["parameters/small_diameter"][()])
            self.interval = float(f["parameters/frame_interval"][()])
            self.step = float(f["parameters/step"][()])
            offset = f["grseg/contacts/offset"][:]
            self.begin = int(grains["position/step"][frames[0]]) * float(f["parameters/step"][()])
            self.frames = [self.read_frame(f, k, slice(int(offset[k]), int(offset[k + 1])))
                           for k in frames]

    @staticmethod
    def read_frame(f, k, rows):
        contacts = f["grseg/contacts"]
        frame = {name: contacts[name][rows].astype(float) for name in ("force", "branch", "gap")}
        frame["i"], frame["j"] = contacts["i"][rows], contacts["j"][rows]
        for name in ("position", "velocity"):
            frame[name] = f[f"particles/grains/{name}/value"][k].astype(float)
        frame["total_force"] = f["particles/grains/force/value"][k].astype(float)
        spin = f["particles/grains/angular_velocity/value"][k].astype(float)
        frame["spin"] = spin.reshape(len(spin), -1)  # one component about z, or three
        divided = f.get("observables/frame_step/value")  # length of a divided step, s; 0 if it was not divided
        frame["step"] = (float(divided[k]) if divided is not None else 0.0) or float(f["parameters/step"][()])
        frame["present"] = ~np.isnan(frame["position"]).any(axis=1)
        return frame

    axis = None  # x and y of the axis of annuli, m; None: layers

    def is_mobile(self, g):
        return g >= 0 and self.mobile[g]

    def height(self, x):
        """Height of a place, or its distance from the axis."""
        return x[1] if self.axis is None else math.hypot(*(x[:2] - self.axis))

    def turned(self, vector, x):
        """Components along (clockwise about the axis) and across the layer at a place."""
        if self.axis is None or len(vector) == 1:
            return vector
        arm = x[:2] - self.axis
        out = arm / math.hypot(*arm)
        return np.concatenate(([out[1] * vector[0] - out[0] * vector[1], out @ vector[:2]], vector[2:]))

    def remove_grains_below(self):
        """Makes those grains absent that have left the bed: their centres lie more than the largest diameter below
        y = 0, and below all boundary grains."""
        for frame in self.frames:
            y = frame["position"][:, 1]
            lowest = min(np.min(y[~self.mobile], initial=0), -2 * self.radius[self.mobile].max())
            frame["present"] &= ~(self.mobile & (y < lowest))

    def divide_by_size(self, edges):
        """Species c1, c2, ... between these diameters."""
        self.names = [f"c{k + 1}" for k in range(len(edges) + 1)]
        self.species_count = len(self.names)
        self.species = np.where(self.mobile, np.searchsorted(edges, 2 * self.radius, side="right"), len(self.names))

        of = [2 * self.radius[self.mobile & (self.species == s)] for s in range(self.species_count)]
        self.nominal = [np.sum(d**self.dimension) / np.sum(d**(self.dimension - 1)) if len(d) else 0.0 for d in of]

    def volume_of_layer(self, h, n=0):
        if self.axis is not None:
            return math.pi * h**2 * (2 * n + 1) * self.width
        return self.length * self.width * h

    def volume_of_grain(self, g):
        r = self.radius[g]
        return math.pi * r**2 if self.dimension == 2 else 4 / 3 * math.pi * r**3

    def volume_below(self, g, height, edge):
        """Part of a grain at this height that lies below an edge: area of a segment, volume of a cap, or area that a
        disc about the axis shares with the grain."""
        r = self.radius[g]
        if self.axis is not None:
            if not abs(r - edge) < height < r + edge:
                return 0.0 if height >= r + edge else math.pi * min(r, edge)**2
            to_chord = (height**2 + edge**2 - r**2) / (2 * height)  # from the axis
            return sum(a**2 * math.acos(c / a) - c * math.sqrt(a**2 - c**2)
                       for a, c in ((edge, to_chord), (r, height - to_chord)))
        y = min(max(edge - height, -r), r)
        if self.dimension == 2:
            half = math.sqrt((r - y) * (r + y))  # of the chord
            return r**2 * math.atan2(half, -y) + y * half
        return math.pi * (r + y)**2 * (2 * r - y) / 3

    def inertia(self, g):
        return (1 / 2 if self.dimension == 2 else 2 / 5) * self.mass[g] * self.radius[g]**2


def exchanged(name, a, b):
    """Exchanges the components a and b of a vector of grains or contacts."""
    def put_into(run):
        for frame in run.frames:
            frame[name][:, [a, b]] = frame[name][:, [b, a]]
    return put_into


def left_out(name, axis):
    def put_into(run):
        for frame in run.frames:
            frame[name][:, axis] = 0
    return put_into


def transposed(run):
    for frame in run.frames:
        frame["force"], frame["branch"] = frame["branch"], frame["force"]


def renumbered(number):
    """Mobile grains of species s are read as number(s, K)."""
    def put_into(run):
        k = run.species_count
        run.species[run.mobile] = [number(s, k) for s in run.species[run.mobile]]
    return put_into


def boundary_is_two(run):
    """Species are read as in files without lists of species."""
    run.mobile &= run.species != 2


def width_is_length(run):
    run.width = run.length


def inertia_of_discs(run):
    run.inertia = lambda g: run.mass[g] * run.radius[g]**2 / 2


def present_at_the_origin(run):
    """Absent grains, for which the file has NaN, are read as grains at rest at 0."""
    for frame in run.frames:
        frame["present"][:] = True
        for name in ("position", "velocity", "spin"):
            frame[name] = np.nan_to_num(frame[name])


# Possible errors of a reader, by dimension and for more than two species.
FAULTS = {
    "x and y of forces exchanged": exchanged("force", 0, 1),
    "x and y of branches exchanged": exchanged("branch", 0, 1),
    "x and y of velocities exchanged": exchanged("velocity", 0, 1),
    "x and y of positions exchanged": exchanged("position", 0, 1),
    "x and y of the forces on grains exchanged": exchanged("total_force", 0, 1),
    "force and branch exchanged": transposed,
    "the largest species first": renumbered(lambda s, k: k - 1 - s),
}
FAULTS_IN_SPACE = {
    "y and z of forces exchanged": exchanged("force", 1, 2),
    "x and z of forces exchanged": exchanged("force", 0, 2),
    "y and z of branches exchanged": exchanged("branch", 1, 2),
    "x and z of branches exchanged": exchanged("branch", 0, 2),
    "y and z of velocities exchanged": exchanged("velocity", 1, 2),
    "y and z of positions exchanged": exchanged("position", 1, 2),
    "z of forces left out": left_out("force", 2),
    "z of branches left out": left_out("branch", 2),
    "z of velocities left out": left_out("velocity", 2),
    "x of spins left out": left_out("spin", 0),
    "the width taken for the length": width_is_length,
    "the inertia of discs": inertia_of_discs,
}
FAULTS_OF_MANY = {
    "species moved on by one": renumbered(lambda s, k: (s + 1) % k),
    "two species exchanged": renumbered(lambda s, k: {0: 1, 1: 0}.get(s, s)),
    "number 2 taken for the boundary": boundary_is_two,
}


def faults_of(run):
    faults = dict(FAULTS)
    if run.dimension == 3:
        faults |= FAULTS_IN_SPACE
    if run.species_count > 2:
        faults |= FAULTS_OF_MANY
    if not all(frame["present"].all() for frame in run.frames):
        faults["absent grains counted"] = present_at_the_origin
    return faults
