"""A run as arrays: one frame per step (formats/README.md)."""
import functools

import h5py
import numpy as np

LAST_DIGIT = 2.2e-16  # relative round-off of a velocity

INERTIA = {2: 1 / 2, 3: 2 / 5}  # moment of inertia over m r^2


def in_space(vectors):
    """Vectors of two dimensions as vectors in space."""
    return np.concatenate([vectors, np.zeros((*vectors.shape[:-1], 3 - vectors.shape[-1]))], axis=-1)


class Trajectory:
    """Arrays of F frames, N grains, and C contacts of all frames. If a step was divided into parts, the frame has only the
    last part. Vectors have three components in both dimensions: discs move in the plane z = 0 and turn about the z axis."""

    def __init__(self, path):
        with h5py.File(path) as file:
            self._read(file)

    def _read(self, file):
        grains, contacts = file["particles/grains"], file["grseg/contacts"]
        self.keys = dict(line.split(" = ") for line in file["parameters/scene"][()].decode().splitlines())
        self.parameters = {name: item[()] for name, item in file["parameters"].items()}
        self.radius, self.mass = grains["radius"][()], grains["mass"][()]
        self.fixed = grains["fixed"][()] != 0
        self.mobile = ~self.fixed
        edges = grains["box/edges"][()]
        self.dimension = len(edges)
        self.edges = in_space(edges)
        self.periodic = in_space(np.array([word == b"periodic" for word in grains["box"].attrs["boundary"]])) != 0
        self.time, self.step = grains["position/time"][()], grains["position/step"][()]
        self.position = in_space(grains["position/value"][()] + grains["image/value"][()] * edges)
        self.velocity, self.force = (in_space(grains[f"{name}/value"][()]) for name in ("velocity", "force"))
        spin = grains["angular_velocity/value"][()]
        self.spin = spin if spin.ndim == 3 else spin[..., None] * np.array([0, 0, 1])
        self.i, self.j = contacts["i"][()], contacts["j"][()]
        self.contact_force, self.branch = (in_space(contacts[name][()]) for name in ("force", "branch"))
        self.gap, self.offset = contacts["gap"][()], contacts["offset"][()].astype(int)
        self.observables = {name: item["value"][()] for name, item in file["observables"].items()}
        self.part = self.observables["frame_step"]  # duration of each frame's step, or of its last part, s
        # round_off: accepted relative error of a result that is computed from a few hundred numbers of the file.
        self.single = self.keys["store"] == "float32"
        self.round_off = 1e-4 if self.single else 1e-9
        # last_digits: relative error of a few operations on numbers of the file.
        self.last_digits = 1e-6 if self.single else 1e-12

    def number(self, key):
        return float(self.keys[key])

    @property
    def base_area(self):
        """Area of the base, m^2; of discs, its length, m."""
        return self.edges[0] * (self.edges[2] if self.dimension == 3 else 1)

    @property
    def frames(self):
        return len(self.time)

    @functools.cached_property
    def whole(self):
        """True for frames whose step was not divided [F]."""
        return np.abs(self.part / self.number("step") - 1) < 1e-6

    @functools.cached_property
    def follows(self):
        """True for frames whose step was not divided and follows directly on the step of the frame before, with the velocities
        of that frame [F]."""
        return self.whole & (np.diff(self.step, prepend=self.step[0]) == 1) & ~self.slowed

    @functools.cached_property
    def slowed(self):
        """True for frames of a deposition that begin with the velocities of the frame before after grains were slowed down: all
        velocities are halved but downward ones (sim/scene/deposition.hpp) [F]."""
        slowed = np.zeros(self.frames, bool)
        old = self.velocity[:-1][:, self.mobile]
        down = (old < 0) & (np.arange(3) == 1)
        left = np.abs(self.before[1:][:, self.mobile] - np.where(down, old, old / 2)).max(axis=(1, 2))
        told = self.time[1:] > self.parameters.get("deposition_slowed_from", 0)
        slowed[1:] = told & (self.time[1:] <= 0) & (left < 1e-9 * np.abs(old).max(axis=(1, 2)))
        return slowed

    @functools.cached_property
    def gravity(self):
        """Gravity in each frame's step, m/s^2 [F, 3]."""
        x, y = self.parameters["gravity"][:2]  # at t = 0
        turned = np.radians(self.parameters["slope_rate"] * self.time)
        flow = np.stack([x * np.cos(turned) - y * np.sin(turned), x * np.sin(turned) + y * np.cos(turned)], axis=1)
        deposition = np.array([0, -np.hypot(x, y)])
        return in_space(np.where(self.time[:, None] > 0, flow, deposition))

    @functools.cached_property
    def size(self):
        """Largest length of the cell or of the region that the grains have visited, m."""
        return max(self.edges.max(), np.abs(self.position).max())

    @functools.cached_property
    def frame_of(self):
        """Index of each contact's frame [C]."""
        return np.repeat(np.arange(self.frames), np.diff(self.offset))

    @functools.cached_property
    def before(self):
        """Velocities at the beginning of each frame's step, m/s. `force` is m (v - v_before)/h, for boundary grains, too."""
        return self.velocity - self.force / self.mass[:, None] * self.part[:, None, None]

    @functools.cached_property
    def normal(self):
        return self.branch / np.linalg.norm(self.branch, axis=1)[:, None]

    @functools.cached_property
    def arm(self):
        """Distance between centre and contact point over the radius, the same for both grains of a contact [C]."""
        reach = self.radius[self.i] + np.where(self.j >= 0, self.radius[self.j], 0)
        return np.where(self.j >= 0, np.linalg.norm(self.branch, axis=1) / reach, 1)

    def along_normal(self, vectors):
        """The part of a vector of each contact along its normal [C]."""
        return np.einsum("ca,ca->c", vectors, self.normal)

    def in_tangent_plane(self, vectors):
        """The part of a vector of each contact in its tangent plane [C, 3]."""
        return vectors - self.along_normal(vectors)[:, None] * self.normal

    def relative(self, velocity):
        """Relative velocity of the centres of each contact [C, 3], m/s; walls do not move."""
        relative = velocity[self.frame_of, self.i]
        relative[self.j >= 0] -= velocity[self.frame_of, self.j][self.j >= 0]
        return relative

    def separation(self, velocity):
        """Relative velocity of each contact along its normal [C], m/s."""
        return self.along_normal(self.relative(velocity))

    def rim(self, spin, grain):
        """Velocity by rotation, relative to a grain's centre, of the point that lies from there along the normal of each contact,
        at the distance of the contact point [C, 3], m/s."""
        return np.cross((spin * self.radius[:, None])[self.frame_of, grain], self.arm[:, None] * self.normal)

    def sliding(self, velocity, spin):
        """Relative velocity of the two surfaces in the tangent plane of each contact [C, 3], m/s."""
        rims = self.rim(spin, self.i)  # the contact point of i lies on the other side of its centre
        rims[self.j >= 0] += self.rim(spin, self.j)[self.j >= 0]
        return self.in_tangent_plane(self.relative(velocity)) - rims

    @functools.cached_property
    def normal_force(self):
        return self.along_normal(self.contact_force)

    @functools.cached_property
    def tangential_force(self):
        return self.in_tangent_plane(self.contact_force)

    @functools.cached_property
    def spin_change(self):
        """Change of spins by the torques of the contacts in each frame's step, 1/s [F, N, 3]."""
        change = np.zeros_like(self.spin)
        if self.keys["rotation"] == "off":
            return change
        turning = np.cross(self.normal, self.tangential_force) * (self.arm * self.part[self.frame_of])[:, None]
        inertia = (INERTIA[self.dimension] * self.mass * self.radius)[:, None]  # over the radius
        np.add.at(change, (self.frame_of, self.i), -turning / inertia[self.i])
        both = self.j >= 0
        np.add.at(change, (self.frame_of[both], self.j[both]), -turning[both] / inertia[self.j[both]])
        change[:, self.fixed] = 0
        return change

    @functools.cached_property
    def largest_force(self):
        """Scale of the forces in each frame, N: largest contact force + largest force on a grain + largest weight + force
        that corresponds to the round-off of velocities."""
        largest = np.linalg.norm(self.force[:, self.mobile], axis=2).max(axis=1)
        np.maximum.at(largest, self.frame_of, np.linalg.norm(self.contact_force, axis=1))
        heaviest = self.mass[self.mobile].max()
        fastest = np.abs(self.velocity).max(axis=(1, 2))
        # Each sweep adds to velocities, and so adds a round-off error.
        rounded = LAST_DIGIT * (4 + self.observables["sweeps"])
        digits = rounded / self.round_off * heaviest * fastest / self.part
        return largest + heaviest * np.linalg.norm(self.gravity, axis=1) + digits + 1e-300

    def sum_of_contacts(self, values):
        """Sum of values over the contacts of each frame [F]."""
        # Without any contact bincount returns integers.
        return np.bincount(self.frame_of, weights=values, minlength=self.frames).astype(float)

    @functools.cached_property
    def kinetic(self):
        """Kinetic energy of translation and of rotation of the mobile grains at the end of each frame's step, J."""
        mass, radius = self.mass[self.mobile], self.radius[self.mobile]
        return ((self.velocity[:, self.mobile] ** 2).sum(axis=2) @ mass / 2,
                (self.spin[:, self.mobile] ** 2).sum(axis=2) @ (mass * radius**2) * INERTIA[self.dimension] / 2)

    @functools.cached_property
    def unit_of_energy(self):
        """Energy that lifts all grains by d_S, or, in a shear cell, the plate, J."""
        small = self.number("small-diameter")
        if self.keys["geometry"] == "shear":
            return self.number("plate-pressure") * self.base_area * small
        return self.mass[self.mobile].sum() * self.number("gravity") * small
