#!/usr/bin/python3
"""Files that grseg-export writes contain the numbers of the run, array by array: they are read by h5py, by an
XML parser and as plain text; only one frame in 50, for speed. Usage: export_test.py GRSEG-EXPORT RUN.h5
"""
import gzip
import os
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import h5py
import numpy as np

tool, path = sys.argv[1:]
run = h5py.File(path, "r")
grains, contacts = run["particles/grains"], run["grseg/contacts"]
frames = range(0, grains["position/value"].shape[0], 50)
number = len(grains["id"])
length = grains["box/edges"][0]
folder = tempfile.TemporaryDirectory()  # removed at the end of the script
os.chdir(folder.name)


def export(form, name):
    subprocess.run([tool, path, "--to", form, "--stride", "50", "--quiet", "-o", name], check=True)


def same(a, b, what):
    assert np.array_equal(np.asarray(a, float), np.asarray(b, float)), what


def rows_of(k):
    return slice(contacts["offset"][k], contacts["offset"][k + 1])


def padded(vectors):
    return np.pad(vectors, [(0, 0)] * (vectors.ndim - 1) + [(0, 1)])


def poly_data(name):
    """Arrays of a .vtp by name, and the counts of its piece."""
    head, _, data = open(name, "rb").read().partition(b"\n_")
    tree = xml.etree.ElementTree.fromstring(head + b"</AppendedData></VTKFile>")
    assert tree.attrib == {"type": "PolyData", "version": "1.0", "byte_order": "LittleEndian",
                           "header_type": "UInt64"}
    piece = tree.find("PolyData/Piece")
    arrays = {}
    for section in piece:
        for entry in section:
            begin = int(entry.get("offset"))
            size = int(np.frombuffer(data, "<u8", 1, begin)[0])
            values = np.frombuffer(data[begin + 8:begin + 8 + size],
                                   {"Float32": "<f4", "Int32": "<i4"}[entry.get("type")])
            columns = int(entry.get("NumberOfComponents"))
            arrays[section.tag, entry.get("Name")] = values.reshape(-1, columns) if columns > 1 else values
    return arrays, {key: int(value) for key, value in piece.attrib.items()}


def check_vtp():
    export("vtp", "view")
    for what in ("grains", "contacts"):
        sets = xml.etree.ElementTree.parse(f"view/{what}.pvd").findall("Collection/DataSet")
        same([s.get("timestep") for s in sets], grains["position/time"][::50], "times")
        assert [s.get("file") for s in sets] == [f"{what}/{k:06}.vtp" for k in range(len(frames))]
    for n, k in enumerate(frames):
        a, counts = poly_data(f"view/grains/{n:06}.vtp")
        assert counts["NumberOfPoints"] == counts["NumberOfVerts"] == number
        single = np.float32
        same(a["Points", "Points"], padded(grains["position/value"][k].astype(single)), "positions")
        same(a["Verts", "offsets"], np.arange(1, number + 1), "vertices")
        same(a["PointData", "diameter"], (2 * grains["radius"][:]).astype(single), "diameters")
        same(a["PointData", "species"], grains["species"], "species")
        for name in ("velocity", "force"):
            same(a["PointData", name], padded(grains[name]["value"][k].astype(single)), name)
        a, counts = poly_data(f"view/contacts/{n:06}.vtp")
        rows = rows_of(k)
        assert counts["NumberOfLines"] == rows.stop - rows.start
        same(a["CellData", "force"], padded(contacts["force"][rows].astype(single)), "forces")
        same(a["CellData", "gap"], contacts["gap"][rows].astype(single), "gaps")
        ends = a["Points", "Points"].reshape(-1, 2, 3).astype(float)
        assert np.allclose(ends[:, 0, :2] - ends[:, 1, :2], contacts["branch"][rows], atol=1e-7)
        same(a["CellData", "i"], grains["id"][:][contacts["i"][rows]], "ids")
        f, n_hat = contacts["force"][rows].astype(float), contacts["branch"][rows].astype(float)
        n_hat /= np.linalg.norm(n_hat, axis=1)[:, None]
        normal, across = a["CellData", "normal_force"], a["CellData", "tangential_force"]
        assert np.allclose(normal, (f * n_hat).sum(axis=1), rtol=1e-6)
        assert np.allclose(normal**2 + across**2, (f**2).sum(axis=1), rtol=1e-5)


def check_extxyz():
    export("extxyz", "run.xyz.gz")
    lines = gzip.open("run.xyz.gz", "rt").read().splitlines()
    assert len(lines) == (number + 2) * len(frames)
    for n, k in enumerate(frames):
        block = lines[n * (number + 2):(n + 1) * (number + 2)]
        assert int(block[0]) == number
        assert float(block[1].split("Time=")[1]) == grains["position/time"][k]
        assert float(block[1].split('Lattice="')[1].split()[0]) == length
        values = np.array([line.split() for line in block[2:]], float)
        same(values[:, 0], grains["id"], "ids")
        same(values[:, 1], grains["species"][:] + 1, "types")
        same(values[:, 2:5], padded(grains["position/value"][k]), "positions")
        same(values[:, 5:8], padded(grains["velocity/value"][k]), "velocities")
        same(values[:, 8], grains["radius"], "radii")
        same(values[:, 9], grains["mass"], "masses")
        same(values[:, 12], grains["angular_velocity/value"][k], "spins")
        same(values[:, 13], grains["mass"], "masses")
        same(values[:, 14:17], padded(grains["mass"][:][:, None] * grains["velocity/value"][k].astype(float)), "momenta")
        same(values[:, 17:20], padded(grains["force/value"][k]), "forces")


def blocks_of(name):
    """(items, table by column) per block of a text dump."""
    items, lines = {}, iter(gzip.open(name, "rt").read().splitlines())
    for line in lines:
        words = line.split()
        if words[1] in ("ATOMS", "ENTRIES"):
            rows = [next(lines).split() for _ in range(int(items["NUMBER OF " + words[1]]))]
            yield dict(items), dict(zip(words[2:], np.array(rows, float).T))
        elif words[1] == "BOX":
            items["BOX"] = [words[3:]] + [[float(x) for x in next(lines).split()] for _ in "xyz"]
        else:
            items[line[6:]] = next(lines)


def check_lammps():
    export("lammps", "run.dump.gz")
    blocks = list(zip(blocks_of("run.dump.gz"), blocks_of("run.contacts.dump.gz")))
    assert len(blocks) == len(frames)
    for ((head, atoms), (contact_head, rows)), k in zip(blocks, frames):
        for items in (head, contact_head):
            assert items["UNITS"] == "si" and items["BOX"][:2] == [["pp", "ff", "pp"], [0, length]]
            assert float(items["TIME"]) == grains["position/time"][k]
            assert int(items["TIMESTEP"]) == grains["position/step"][k]
        for name, values in (("id", grains["id"]), ("type", grains["species"][:] + 1),
                             ("mass", grains["mass"]), ("radius", grains["radius"]),
                             ("omegaz", grains["angular_velocity/value"][k])):
            same(atoms[name], values, name)
        for names, element in ((("x", "y"), "position"), (("ix", "iy"), "image"),
                               (("vx", "vy"), "velocity"), (("fx", "fy"), "force")):
            same(np.stack([atoms[name] for name in names], 1), grains[element]["value"][k], element)
        take = rows_of(k)
        same(rows["batom1"], grains["id"][:][contacts["i"][take]], "i")
        same(rows["batom2"], grains["id"][:][contacts["j"][take]], "j")
        same(np.stack([rows["forcex"], rows["forcey"]], 1), contacts["force"][take], "force")
        same(np.stack([rows["branchx"], rows["branchy"]], 1), contacts["branch"][take], "branch")
        same(-rows["overlap"], contacts["gap"][take], "gap")
        total = np.stack([rows["fx"] + rows["p1"], rows["fy"] + rows["p2"]], 1)
        largest = np.abs(total).max()
        assert np.abs(total - contacts["force"][take]).max() < 1e-15 * largest
        across = rows["fx"] * rows["branchy"] - rows["fy"] * rows["branchx"]
        assert np.abs(across).max() < 1e-15 * largest * rows["dist"].max()


def check_h5md3d():
    export("h5md3d", "view.h5md")
    view = h5py.File("view.h5md", "r")
    assert list(view["h5md"].attrs["version"]) == [1, 1]
    assert list(view["particles"]) == ["trajectory"]
    all_of = view["particles/trajectory"]
    box = all_of["box"]
    assert box.attrs["dimension"] == 3
    assert [b.decode() for b in box.attrs["boundary"]] == ["periodic", "none", "none"]
    assert box["edges/value"].shape == (len(frames), 3, 3) and box["edges/value"][0, 0, 0] == length
    for name in ("position", "velocity", "force", "image"):
        same(all_of[name]["value"], padded(grains[name]["value"][::50]), name)
    for name in ("velocity", "force", "image", "angular_velocity", "box/edges"):
        for axis in ("step", "time"):
            assert all_of[name][axis] == all_of["position"][axis], "not a hard link"
    same(all_of["position/time"], grains["position/time"][::50], "times")
    same(all_of["angular_velocity/value"], grains["angular_velocity/value"][::50], "spins")
    for name in ("id", "species", "radius", "mass"):
        same(all_of[name], grains[name], name)
    for name in run["observables"]:
        same(view["observables"][name]["value"], run["observables"][name]["value"][::50], name)
    # MDAnalysis' reader refuses units that it does not know, such as m.
    assert not [name for name in ("position", "velocity", "force")
                if "unit" in all_of[name]["value"].attrs]


for check in (check_vtp, check_extxyz, check_lammps, check_h5md3d):
    check()
subprocess.run([tool, path, "--to", "vtp", "-o", "view", "--overwrite", "--begin", "19"], check=True)
assert len(os.listdir("view/grains")) == len(grains["position/time"][:][grains["position/time"][:] > 19])
