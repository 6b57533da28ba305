#!/usr/bin/python3
"""Runs of grseg-sim, written in the layouts of LMGC90, are imported with the same contacts and the same stress.

Usage: lmgc90_test.py FOLDER-OF-PROGRAMS

The layouts are those of lmgc90_user 2025 (mod_h5_interaction.f90, mod_a_DOF.f90). LMGC90 writes positions of the end
of a step and gaps expected in the next one; a run of grseg has both in the middle, where theta = 1/2 finds contacts.
"""
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

BIN = os.path.abspath(sys.argv[1])
DENSITY = 1000.0
DISCS = "length = 6dL\ndepth = 8dS\nslope = 23\n"
SPHERES = "dimension = 3\nlength = 12dS\nwidth = 8dS\ndepth = 6dS\nslope = 26\n"


def d14(number):
    """A number as Fortran's D14.7 writes it."""
    mantissa, exponent = f"{number:.6E}".split("E")
    digits = mantissa.replace("-", "").replace(".", "")
    power = 0 if number == 0 else int(exponent) + 1
    return f"{'-' if number < 0 else ' '}0.{digits}D{'-' if power < 0 else '+'}{abs(power):02d}"


def fields(letters, numbers):
    """Lines of three numbers, each behind its key of five characters."""
    words = [f"{key}{d14(x)}" for key, x in zip(letters, numbers)]
    return "".join(" " * 27 + "".join("  " + word for word in words[k:k + 3]) + "\n" for k in range(0, len(words), 3))


def keys(letter, count=3):
    return [f"{letter}({k + 1})=" for k in range(count)]


class Run:
    """A run of grseg, with three components in 3D and two in 2D."""

    def __init__(self, path):
        with h5py.File(path) as file:
            grains = file["particles/grains"]
            self.radius, self.mass = grains["radius"][:], grains["mass"][:]
            self.fixed = (grains["fixed"][:] != 0) | (grains["species"][:] == len(file["grseg/species/mobile"]) - 1)
            self.x, self.v, self.w = (grains[name + "/value"][:] for name in ("position", "velocity", "angular_velocity"))
            self.steps, self.step = grains["position/step"][:], file["parameters/step"][()]
            self.gravity, self.length = file["parameters/gravity"][:], grains["box/edges"][:]
            contacts, ends = file["grseg/contacts"], file["grseg/contacts/offset"][:]
            self.contacts = [{name: contacts[name][a:b] for name in ("i", "j", "force", "branch", "gap")}
                             for a, b in zip(ends, ends[1:])]
        self.d = self.x.shape[2]

    def bodies(self):
        """BODIES.DAT, BULK_BEHAV.DAT and DRV_DOF.DAT. Bodies have the size avrd of their mass."""
        text, driven = "! File BODIES\n!\n", "! DOF\n"
        for n, (r, m) in enumerate(zip(self.radius, self.mass), 1):
            size = (m / DENSITY / np.pi) ** 0.5 if self.d == 2 else (m / DENSITY / np.pi * 0.75) ** (1 / 3)
            text += (f"$bdyty\n RBDY{self.d}{n:9d}\n$blmty\n PLAIN      1  behav  TDURx  avrd={d14(size)}\n$nodty\n"
                     f" NO{3 * self.d - 3}xx      1                coo1={d14(0)}  coo2={d14(0)}  coo3={d14(0)}\n$tacty\n"
                     f" {'DISKx' if self.d == 2 else 'SPHER'}      1  color  BLEUx  byrd={d14(r)}\n$$$$$$\n\n")
            if self.fixed[n - 1]:
                driven += f"$bdyty\n RBDY{self.d}{n:9d}\n$nodty\n NO3xx      1\n$dofty\n"
                driven += "".join(f" vlocy{k:7d}  0.0000000E+00  0.0000000E+00  0.0000000E+00\n" for k in (1, 2, 3))
        g = [*self.gravity[:self.d], 0][:3]
        bulk = (f"$gravy\n                   grv1={d14(g[0])}  grv2={d14(g[1])}  grv3={d14(g[2])}\n$behav  lawty\n"
                f" TDURx  RIGID                           Umas={d14(DENSITY)}\n")
        return text, bulk, driven

    def frame(self, k):
        """Displacements (their reference is 0), velocities, spins; and for each contact axes, forces, gap and v_n."""
        contacts, axes = self.contacts[k], []
        for branch in contacts["branch"]:
            n = branch / np.linalg.norm(branch)
            if self.d == 2:
                axes.append([[n[1], -n[0]], n])
            else:
                t = np.cross(n, np.eye(3)[np.argmin(abs(n))])
                t /= np.linalg.norm(t)
                axes.append([t, n, np.cross(t, n)])
        axes = np.array(axes)
        forces = np.einsum("cad,cd->ca", axes, contacts["force"])
        i, j = contacts["i"], contacts["j"]
        speed = np.einsum("cd,cd->c", axes[:, 1], self.v[k][i] - self.v[k][j])
        return (self.x[k] + self.step / 2 * self.v[k], self.v[k], self.w[k].reshape(len(self.radius), -1), i + 1, j + 1,
                axes, forces, contacts["gap"] + self.step * speed, speed)


def write_hdf5(run, path):
    with h5py.File(path, "w") as file:
        file["version"] = np.array([0, 3], np.int32)
        simulation = file.create_group("Simulation")
        simulation["dimension"], simulation["MecaIntegrator"] = np.int32(run.d), np.int32(1)
        simulation["MecaIntegParam"] = 0.5
        for k, step in enumerate(run.steps):
            x, v, w, i, j, axes, forces, gap, speed = run.frame(k)
            group = file.create_group(f"Evolution/ID_{k + 1}")
            group["NStep"], group["TPS"], group["dt"] = np.int32(step + 1), (step + 1) * run.step, run.step
            none, count = np.zeros((len(x), 3)), len(i)
            body = [x, w * 0, v, w] if run.d == 2 else [x, none, v, w, np.tile(np.eye(3).ravel(), (len(x), 1))]
            group[f"RBDY{run.d}/rdata"], group[f"RBDY{run.d}/idata"] = np.hstack(body), np.ones((len(x), 1), np.int32)
            ids = np.ones((count, 22), np.int32)
            ids[:, 6], ids[:, 7] = i, j
            point, relative = np.zeros((count, run.d)), np.zeros((count, run.d))
            relative[:, 1] = speed
            frames = axes[:, 1] if run.d == 2 else axes.reshape(count, 9)
            group["VlocRloc/idata"] = ids
            group["VlocRloc/rdata"] = np.hstack([forces, relative, gap[:, None], point, frames])


def write_texts(run, folder):
    for k, step in enumerate(run.steps):
        x, v, w, i, j, axes, forces, gap, speed = run.frame(k)
        head = f"$steps{step + 1:9d}              time={d14((step + 1) * run.step)}\n \n!{'-' * 71}\n"
        dof, pairs = "     \n! DOF\n     \n" + head, "     \n! Vloc_Rloc\n      \n" + head
        for n in range(len(x)):
            dof += f"$bdyty\n RBDY{run.d}{n + 1:9d}\n$nodty\n"
            if run.d == 2:
                dof += fields(keys("X"), [*x[n], 0]) + fields(keys("V"), [*v[n], *w[n]])
            else:
                dof += fields(keys("X", 6), [*x[n], 0, 0, 0]) + fields(keys("V", 6), [*v[n], *w[n]])
                dof += "".join(fields(keys(letter), axis) for letter, axis in zip("abg", np.eye(3)))
            dof += "$$$$$$\n      \n"
        kind = "DISKx" if run.d == 2 else "SPHER"
        for c, (first, second) in enumerate(zip(i, j)):
            three = [[*axis, 0][:3] for axis in axes[c]]
            pairs += (f"$icdan  {'DKDKx' if run.d == 2 else 'SPSPx'}{c + 1:9d}\n cdbdy  numbr  cdtac  numbr\n"
                      f" RBDY{run.d}{first:7d}  {kind}      1  {'' if run.d == 2 else '       '}iqsc0"
                      f"  RBDY{run.d}{second:7d}  {kind}      1  stick{second:7d}\n")
            pairs += fields(["rlt/H", "rln/H", "rls/H"], [*forces[c], 0][:3])
            pairs += fields(["vlt =", "vln =", "vls ="], [0, speed[c], 0]) + fields(["gapTT"], [gap[c]])
            pairs += fields(keys("n"), three[1]) + fields(["coo1=", "coo2=", "coo3="], [0, 0, 0])
            if run.d == 3:
                pairs += fields(keys("t"), three[0]) + fields(keys("s"), three[2])
            pairs += " \n"
        for name, text in ("DOF", dof), ("Vloc_Rloc", pairs):
            with open(f"{folder}/{name}.OUT.{k + 1}", "w", encoding="ascii") as file:
                file.write(text)


def program(name, *arguments):
    done = subprocess.run([f"{BIN}/{name}", *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, (name, arguments, done.stderr)
    return done.stdout


def stress(contacts):
    """Sum of force (x) branch."""
    return np.einsum("ca,cb->ab", contacts["force"], contacts["branch"])


def compare(run, path, digits):
    """The import has the contacts, stress and velocities of the run, without its first step, to some digits."""
    imported = Run(path)
    force = max(abs(contacts["force"]).max() for contacts in run.contacts)
    assert len(imported.contacts) == len(run.contacts) - 1 > 1
    for k, (ours, theirs) in enumerate(zip(run.contacts[1:], imported.contacts)):
        kept = (np.linalg.norm(ours["force"], axis=1) > 0) | (ours["gap"] <= 0)
        assert np.array_equal(ours["i"][kept], theirs["i"]) and np.array_equal(ours["j"][kept], theirs["j"])
        assert np.allclose(ours["force"][kept], theirs["force"], rtol=0, atol=digits * force), k
        assert np.allclose(ours["branch"][kept], theirs["branch"], rtol=0, atol=digits * run.length[0]), k
        assert np.allclose(ours["gap"][kept], theirs["gap"], rtol=0, atol=digits * run.length[0]), k
        assert np.allclose(stress(ours), stress(theirs), rtol=0, atol=digits * abs(stress(ours)).max()), k
        assert np.allclose(run.v[k + 1], imported.v[k], rtol=0, atol=digits), k
        assert np.allclose(run.w[k + 1], imported.w[k], rtol=0, atol=digits * 1e3), k
    assert np.array_equal(run.fixed, imported.fixed) and np.allclose(run.mass, imported.mass, rtol=1e-6)


def main(scene):
    with open("scene.ini", "w", encoding="ascii") as file:
        file.write(scene)
    program("grseg-sim", "scene.ini", "--duration", "0.05", "--frame-interval", "0.05", "--burst", "4", "--quiet",
            "--overwrite", "-o", "own.h5")
    run = Run("own.h5")
    for folder in "DATBOX", "OUTBOX":
        os.makedirs(folder, exist_ok=True)
    for name, text in zip(("BODIES", "BULK_BEHAV", "DRV_DOF"), run.bodies()):
        with open(f"DATBOX/{name}.DAT", "w", encoding="ascii") as file:
            file.write(text)
    write_hdf5(run, "lmgc90.h5")
    write_texts(run, "OUTBOX")
    cell = ["--cell", f"x:0:{run.length[0]:.17g}:periodic"]
    if run.d == 3:
        cell += ["--cell", f"z:0:{run.length[2]:.17g}:periodic"]
    for grains, digits in ("lmgc90.h5", 1e-9), ("OUTBOX/DOF.OUT.*", 1e-5):
        program("grseg-import", "--format", "lmgc90", "--grains", grains, "--units", "si", *cell, "--overwrite", "-o",
                "imported.h5")
        compare(run, "imported.h5", digits)
        program("grseg-check", "imported.h5")


with tempfile.TemporaryDirectory() as place:
    os.chdir(place)
    main(DISCS)
    main(SPHERES)
