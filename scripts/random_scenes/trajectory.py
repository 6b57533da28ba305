"""A run as arrays: one frame per step (formats/README.md)."""
import functools

import h5py
import numpy as np

LAST_DIGIT = 2.2e-16  # relative round-off of a velocity


class Trajectory:
    """Arrays of F frames, N grains, and C contacts of all frames. If a step was divided into parts, the frame has only the
    last part."""

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
        self.width, self.height = grains["box/edges"][()]
        self.time, self.step = grains["position/time"][()], grains["position/step"][()]
        self.position = grains["position/value"][()] + grains["image/value"][()] * np.array([self.width, 0])
        self.velocity, self.force = grains["velocity/value"][()], grains["force/value"][()]
        self.spin = grains["angular_velocity/value"][()]
        self.i, self.j = contacts["i"][()], contacts["j"][()]
        self.contact_force, self.branch = contacts["force"][()], contacts["branch"][()]
        self.gap, self.offset = contacts["gap"][()], contacts["offset"][()].astype(int)
        self.observables = {name: item["value"][()] for name, item in file["observables"].items()}
        self.part = self.observables["frame_step"]  # duration of each frame's step, or of its last part, s
        # round_off: accepted relative error of a result that is computed from a few hundred numbers of the file.
        self.single = self.keys["store"] == "float32"
        self.round_off = 1e-4 if self.single else 1e-9

    def number(self, key):
        return float(self.keys[key])

    @property
    def periodic(self):
        return self.keys["lateral"] == "periodic"

    @property
    def frames(self):
        return len(self.time)

    @functools.cached_property
    def whole(self):
        """True for frames whose step was not divided [F]."""
        return np.abs(self.part / self.number("step") - 1) < 1e-6

    @functools.cached_property
    def follows(self):
        """True for frames whose step was not divided and follows directly on the step of the frame before [F]."""
        return self.whole & (np.diff(self.step, prepend=self.step[0]) == 1)

    @functools.cached_property
    def gravity(self):
        """Gravity in each frame's step, m/s^2 [F, 2]."""
        g = self.number("gravity") if self.keys["geometry"] != "shear" else 0
        later = np.maximum(self.time, 0)
        slope = np.radians(np.where(self.time > 0, self.number("slope") + self.number("slope-rate") * later, 0))
        return g * np.stack([np.sin(slope), -np.cos(slope)], axis=1)

    @functools.cached_property
    def size(self):
        """Largest length of the cell or of the region that the grains have visited, m."""
        return max(self.width, self.height, np.abs(self.position).max())

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
    def tangent(self):
        return np.stack([-self.normal[:, 1], self.normal[:, 0]], axis=1)

    @functools.cached_property
    def arm(self):
        """Distance between centre and contact point over the radius, the same for both grains of a contact [C]."""
        reach = self.radius[self.i] + np.where(self.j >= 0, self.radius[self.j], 0)
        return np.where(self.j >= 0, np.linalg.norm(self.branch, axis=1) / reach, 1)

    def separation(self, velocity):
        """Relative velocity of each contact along its normal [C], and as a vector [C, 2], m/s; walls do not move."""
        relative = velocity[self.frame_of, self.i]
        relative[self.j >= 0] -= velocity[self.frame_of, self.j][self.j >= 0]
        return np.einsum("ca,ca->c", relative, self.normal), relative

    def sliding(self, velocity, spin):
        """Relative velocity of the two surfaces along the tangent of each contact [C], m/s."""
        rims = (spin * self.radius)[self.frame_of, self.i]
        rims[self.j >= 0] += (spin * self.radius)[self.frame_of, self.j][self.j >= 0]
        _, relative = self.separation(velocity)
        return np.einsum("ca,ca->c", relative, self.tangent) - self.arm * rims

    @functools.cached_property
    def normal_force(self):
        return np.einsum("ca,ca->c", self.contact_force, self.normal)

    @functools.cached_property
    def tangential_force(self):
        return np.einsum("ca,ca->c", self.contact_force, self.tangent)

    @functools.cached_property
    def spin_change(self):
        """Change of spins by the contacts of each frame's step, 1/s, with I = m r^2/2."""
        change = np.zeros_like(self.spin)
        if self.keys["rotation"] == "off":
            return change
        impulse = 2 * self.arm * self.tangential_force * self.part[self.frame_of]
        both = self.j >= 0
        inertia = self.mass * self.radius
        np.add.at(change, (self.frame_of, self.i), -impulse / inertia[self.i])
        np.add.at(change, (self.frame_of[both], self.j[both]), -impulse[both] / inertia[self.j[both]])
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
                (self.spin[:, self.mobile] ** 2) @ (mass * radius**2) / 4)

    @functools.cached_property
    def unit_of_energy(self):
        """Energy that lifts all grains by d_S, or, in a shear cell, the plate, J."""
        small = self.number("small-diameter")
        if self.keys["geometry"] == "shear":
            return self.number("plate-pressure") * self.width * small
        return self.mass[self.mobile].sum() * self.number("gravity") * small
