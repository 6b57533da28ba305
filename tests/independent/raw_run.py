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
            self.radius = grains["radius"][:].astype(float)
            self.mass = grains["mass"][:].astype(float)
            self.species = grains["species"][:].astype(int)
            self.mobile = (self.species != self.species_count) & (grains["fixed"][:] == 0)
            self.small_diameter = float(f["parameters/small_diameter"][()])
            self.interval = float(f["parameters/frame_interval"][()])
            self.step = float(f["parameters/step"][()])
            offset = f["grseg/contacts/offset"][:]
            self.begin = int(grains["position/step"][frames.start]) * float(f["parameters/step"][()])
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
        frame["present"] = ~np.isnan(frame["position"]).any(axis=1)
        return frame

    def is_mobile(self, g):
        return g >= 0 and self.mobile[g]

    def volume_of_layer(self, h):
        return self.length * self.width * h

    def volume_of_grain(self, g):
        r = self.radius[g]
        return math.pi * r**2 if self.dimension == 2 else 4 / 3 * math.pi * r**3

    def volume_below(self, g, height):
        """Part of a grain below a level `height` above its centre: area of a segment or volume of a cap."""
        r = self.radius[g]
        y = min(max(height, -r), r)
        if self.dimension == 2:
            return r**2 * math.acos(-y / r) + y * math.sqrt(r**2 - y**2)
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
