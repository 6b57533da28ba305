"""A run as arrays: one frame per step (formats/README.md)."""
import functools

import h5py
import numpy as np

LAST_DIGIT = 2.2e-16  # of a velocity


class Trajectory:
    """F frames, N grains, C contacts of all frames. A divided step shows its last part alone."""

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
        self.part = self.observables["frame_step"]  # s, what the frame shows of its step
        # Of numbers in the file; of what follows from a few hundred of them.
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
        """Frames of steps that were taken whole."""
        return np.abs(self.part / self.number("step") - 1) < 1e-6

    @functools.cached_property
    def follows(self):
        """Frames of whole steps right after the frame before."""
        return self.whole & (np.diff(self.step, prepend=self.step[0]) == 1)

    @functools.cached_property
    def gravity(self):
        """Gravity in each frame's step, m/s^2."""
        g = self.number("gravity") if self.keys["geometry"] != "shear" else 0
        later = np.maximum(self.time, 0)
        slope = np.radians(np.where(self.time > 0, self.number("slope") + self.number("slope-rate") * later, 0))
        return g * np.stack([np.sin(slope), -np.cos(slope)], axis=1)

    @functools.cached_property
    def size(self):
        """m, of the cell or of what the grains have crossed."""
        return max(self.width, self.height, np.abs(self.position).max())

    @functools.cached_property
    def frame_of(self):
        """The frame of each contact."""
        return np.repeat(np.arange(self.frames), np.diff(self.offset))

    @functools.cached_property
    def before(self):
        """Velocities at the beginning of each frame's step, m/s: `force` is m (v - v_before)/h, of boundary grains too."""
        return self.velocity - self.force / self.mass[:, None] * self.part[:, None, None]

    @functools.cached_property
    def normal(self):
        return self.branch / np.linalg.norm(self.branch, axis=1)[:, None]

    @functools.cached_property
    def tangent(self):
        return np.stack([-self.normal[:, 1], self.normal[:, 0]], axis=1)

    @functools.cached_property
    def arm(self):
        """Distance of the contact point over the radius, of both grains."""
        reach = self.radius[self.i] + np.where(self.j >= 0, self.radius[self.j], 0)
        return np.where(self.j >= 0, np.linalg.norm(self.branch, axis=1) / reach, 1)

    def separation(self, velocity):
        """The relative velocity of each contact along its normal, m/s; a wall stands still."""
        relative = velocity[self.frame_of, self.i]
        relative[self.j >= 0] -= velocity[self.frame_of, self.j][self.j >= 0]
        return np.einsum("ca,ca->c", relative, self.normal), relative

    def sliding(self, velocity, spin):
        """The relative velocity of each contact along its tangent, m/s."""
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
        """1/s, what the contacts of each frame's step do to spins: I = m r^2/2."""
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
        """N, of each frame: a contact's, one on a grain, a weight, or what the last digits of velocities amount to."""
        largest = np.linalg.norm(self.force[:, self.mobile], axis=2).max(axis=1)
        np.maximum.at(largest, self.frame_of, np.linalg.norm(self.contact_force, axis=1))
        heaviest = self.mass[self.mobile].max()
        fastest = np.abs(self.velocity).max(axis=(1, 2))
        # Each sweep adds to velocities.
        rounded = LAST_DIGIT * (4 + self.observables["sweeps"])
        digits = rounded / self.round_off * heaviest * fastest / self.part
        return largest + heaviest * np.linalg.norm(self.gravity, axis=1) + digits + 1e-300

    def sum_of_contacts(self, values):
        """The sum over the contacts of each frame."""
        return np.bincount(self.frame_of, weights=values, minlength=self.frames).astype(float)  # whole numbers of none

    @functools.cached_property
    def kinetic(self):
        """J, of mobile grains at the end of each frame's step: of translation, of rotation."""
        mass, radius = self.mass[self.mobile], self.radius[self.mobile]
        return ((self.velocity[:, self.mobile] ** 2).sum(axis=2) @ mass / 2,
                (self.spin[:, self.mobile] ** 2) @ (mass * radius**2) / 4)

    @functools.cached_property
    def unit_of_energy(self):
        """J, that lifts all grains by d_S; in a shear cell, the plate."""
        small = self.number("small-diameter")
        if self.keys["geometry"] == "shear":
            return self.number("plate-pressure") * self.width * small
        return self.mass[self.mobile].sum() * self.number("gravity") * small
