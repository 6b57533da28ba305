#!/usr/bin/python3
"""Maps in HDF5 contain the numbers of the table, with coordinates, as h5py reads them. Impossible names and
settings are refused.
Usage: map_files_test.py GRSEG-STRESS GRSEG-KINETIC GRSEG-MICRO GRSEG-FIT RUN.h5
"""
import os
import re
import subprocess
import sys
import tempfile

import h5py
import numpy as np

stress, merge, kinetic, micro, fit, run = sys.argv[1:]
folder = tempfile.TemporaryDirectory()  # removed at the end of the script
os.chdir(folder.name)
MAP = ["--bins", "xy", "--layer", "6dS", "--window", "4", "--quiet"]


def call(*words):
    return subprocess.run(words, capture_output=True, text=True)


def table_of(tool):
    """Header, columns by name, and the line of column names."""
    text = subprocess.run([tool, run, *MAP], check=True, capture_output=True, text=True).stdout
    lines = text.splitlines()
    header = {}
    for line in lines:
        if line.startswith("# "):
            key, _, value = line[2:].partition(": ")
            header.setdefault(key, []).append(value)
    rows = [line.split("\t") for line in lines if not line.startswith("#")]
    return header, dict(zip(rows[0], np.array(rows[1:], float).T)), rows[0]


def written(tool, name):
    done = call(tool, run, *MAP, "-o", name)
    assert done.returncode == 0 and not done.stderr, done.stderr
    return name


def same(a, b, what):
    assert np.array_equal(np.asarray(a), np.asarray(b), equal_nan=True), what


def stored(column):
    """Name in the file: in HDF5 a / would begin a group."""
    return column.replace("/", "_per_")


def check_hdf5(tool, name):
    header, columns, names = table_of(tool)
    nx, ny = map(int, header["cells"][0].split())
    windows = len(set(columns["t0[s]"]))
    assert windows > 1 and nx > 1 and ny > 1
    shape = windows, ny, nx
    assert names[:8] == ["t0[s]", "t1[s]", "x0[m]", "x1[m]", "y0[m]", "y1[m]", "frames", "V[m^2]"]
    with h5py.File(written(tool, name)) as file:
        assert set(file) == ({stored(n.partition("[")[0]) for n in names[8:]} |
                             {"time", "t0", "t1", "frames", "V", "x", "y", "x_edges", "y_edges"})
        for column in names[8:]:
            plain, _, unit = column.partition("[")
            field = file[stored(plain)]
            same(field, columns[column].reshape(shape), column)
            assert field.attrs.get("units", b"").decode() == unit.rstrip("]"), column
            assert [field.dims[k][0].name for k in range(3)] == ["/time", "/y", "/x"], column
        first = columns["x0[m]"].reshape(shape)[0, 0], columns["x1[m]"].reshape(shape)[0, 0]
        same(file["x"], (first[0] + first[1]) / 2, "x")
        same(file["x_edges"], [*first[0], first[1][-1]], "x_edges")
        second = columns["y0[m]"].reshape(shape)[0, :, 0], columns["y1[m]"].reshape(shape)[0, :, 0]
        same(file["y"], (second[0] + second[1]) / 2, "y")
        same(file["y_edges"], [*second[0], second[1][-1]], "y_edges")
        for key in "t0", "t1":
            same(file[key], columns[f"{key}[s]"].reshape(shape)[:, 0, 0], key)
        same(file["time"], (file["t0"][:] + file["t1"][:]) / 2, "time")
        same(file["frames"], columns["frames"].reshape(shape)[:, 0, 0], "frames")
        same(file["V"], columns["V[m^2]"].reshape(shape)[0], "V")
        for key in "program", "input", "verified", "bins", "window":
            assert file.attrs[key].decode() == "\n".join(header[key]), key
        assert file.attrs["history"].decode().splitlines()[:-1] == header["history"][:-1]
    bytes_once = open(name, "rb").read()
    assert call(tool, run, *MAP, "--threads", "2", "-o", "again.h5").returncode == 0
    with h5py.File("again.h5") as a, h5py.File(name) as b:
        for key in b:
            same(a[key], b[key], key)
    refused = call(tool, run, *MAP, "-o", name)
    assert refused.returncode == 2 and "already exists" in refused.stderr, refused.stderr
    assert open(name, "rb").read() == bytes_once
    assert call(tool, run, *MAP, "--overwrite", "-o", name).returncode == 0
    os.remove("again.h5")


def check_refusals():
    def refused(words, code, sentence):
        done = call(*words)
        assert done.returncode == code and sentence in done.stderr, (words, done)

    refused([stress, run, "-o", "sums.h5"], 2, "only a map can be written as such a file; use --bins xy")
    for bins in "xz", "rz:0.1m,0.1m":
        refused([stress, run, "--bins", bins], 2, "the run has two dimensions; use --bins xy")
    refused([stress, run, "--bins", "yx"], 2, "unknown --bins 'yx'")
    refused([stress, run, "--bins", "xy:1,2"], 2, "unknown --bins 'xy:1,2'")
    for assign in "branch", "gauss":
        refused([stress, run, "--bins", "xy", "--assign", assign], 2,
                "spreads contacts over layers, not over the cells of a map")
    refused([stress, run, "--bins", "xy", "--composition", "clipped"], 2, "use centre")
    refused([micro, run, "--bins", "xy", "--composition", "clipped"], 2, "use centre")
    refused([micro, run, "--bins", "radius:0,0"], 2, "grseg-micro has layers, xy and xz")
    for mean in "profile-unbiased", "layer", "instant", "instant-unbiased", "species":
        subprocess.run([kinetic, run, *MAP, "--mean", mean], check=True, capture_output=True)
    assert not re.search("radius:|rz", subprocess.run([micro, "--help"], check=True, capture_output=True, text=True).stdout)
    refused([stress, run, "--bins", "xy", "--layer", "1e-6m"], 1, "the cells are too small")
    refused([stress, run, "--bins", "xy", "--json", "-o", "map.h5"], 2, "--json writes text")
    assert call(stress, run, *MAP, "-o", "map.tsv").returncode == 0
    assert call(stress, run, *MAP[2:], "-o", "layers.tsv").returncode == 0
    refused([fit, "map.tsv", "layers.tsv"], 3, "map.tsv has the cells of a map (xy) and layers.tsv has layers; fit them")
    refused([fit, "map.tsv", "--min-shear", "1"], 2, "use it with --quantity kinetic")
    refused([fit, "map.tsv", "--heights", "1000m:"], 1, "outside --heights")
    refused([merge, "map.tsv"], 3, "map.tsv: the table is a map (bins: xy)")
    refused([stress, run, *MAP, "-o", "map.pvd"], 2, "maps are written as .h5, which xarray and h5py read, or as .tsv")
    assert sorted(os.listdir()) == ["flow.h5", "layers.tsv", "map.tsv", "micro.h5", "stress.h5"], os.listdir()


def check_sums():
    """A map of contacts, summed over each layer, equals the table by layer."""
    _, columns, names = table_of(micro)
    text = subprocess.run([micro, run, *MAP[2:], "--composition", "centre"], check=True,
                          capture_output=True, text=True).stdout
    rows = [line.split("\t") for line in text.splitlines() if not line.startswith("#")]
    layers = dict(zip(rows[0], np.array(rows[1:], float).T))
    inside = ~np.isnan(layers["y0[m]"])
    summed = [name for name in names[8:] if name in layers and not name.startswith("n_strong")]
    assert len(summed) > 50
    for name in summed:
        a, b = columns[name].sum(), layers[name][inside].sum()
        assert abs(a - b) <= 1e-11 * np.abs(layers[name][inside]).sum(), (name, a, b)


def component(columns, name, pressure):
    of = [columns[column] for column in columns if re.match(rf"{name}_(xx|yy)\[", column)]
    return sum(of) / 2 if pressure else of[1]


def by_hand(columns, quantity, removed, pressure=False):
    """B over the cells of a table with half the median solid fraction or more, and the number of these cells."""
    small, large = (columns[f"area_{k}[m^2]"] if quantity == "contact" else columns[f"mass_{k}[kg]"] for k in "SL")
    if quantity == "contact":
        of_large = sum(component(columns, name, pressure) for name in ("A_LL", "Msize", "A_Lb"))
        whole = sum(component(columns, name, pressure) for name in ("A_SS", "A_LL", "M", "A_Sb", "A_Lb"))
    else:
        of_large = component(columns, "K_L", pressure)
        whole = component(columns, "K_S", pressure) + of_large
    solid = (small + large) / columns["V[m^2]"]
    full = solid >= 0.5 * np.median(solid[solid > 0])
    with np.errstate(all="ignore"):
        ratio, phi = small / large, large / (small + large)
    # Cells by window, column and row; columns repeat after a period of the chute.
    i, j = (np.round((columns[f"{name}0[m]"] - columns[f"{name}0[m]"].min()) / (columns[f"{name}1[m]"] - columns[f"{name}0[m]"])[0])
            for name in "xy")
    row_at = {place: row for row, place in enumerate(zip(columns["t0[s]"], i, j))}
    excess = weight = cells = 0
    for row, (t, x, y) in enumerate(row_at):
        if not (full[row] and 0.01 <= ratio[row] <= 100 and whole[row] > 0):
            continue
        within = 0
        for ends in [((x + step) % (i.max() + 1), y) for step in (1, -1)], [(x, y + step) for step in (1, -1)]:
            near = [row_at.get((t, *end), row) for end in ends]
            near = [r if full[r] else row for r in near]
            steps = sum(r != row for r in near)
            if removed and steps:
                within += (phi[near[0]] - phi[near[1]]) * (whole[near[0]] - whole[near[1]]) / steps**2 / 12 / whole[row]
        excess += columns["frames"][row] * (of_large[row] / whole[row] - within - phi[row])
        weight += columns["frames"][row] * phi[row] * (1 - phi[row])
        cells += 1
    return excess / weight, cells


def check_b():
    """B over cells equals B by hand, of contact and kinetic stress, with and without the part that gradients add."""
    for tool, quantity in (stress, "contact"), (kinetic, "kinetic"):
        name = written(tool, f"{quantity}.tsv")
        columns = table_of(tool)[1]
        for thickness in "kept", "removed":
            for part in "yy", "pressure":
                printed = call(fit, name, "--quantity", quantity, "--thickness", thickness, "--component", part, "--heights",
                               "all", "--quiet").stdout
                number = {line.split("\t")[4]: float(line.split("\t")[6]) for line in printed.splitlines()
                          if re.match("size|kinetic|-\t", line)}
                b, cells = by_hand(columns, quantity, thickness == "removed", part == "pressure")
                assert cells > 10 and number["points"] == cells, (cells, number)
                assert abs(number["B"] - b) < 1e-12, (quantity, thickness, part, number["B"], b)
    shear = table_of(kinetic)[1]["shear_rate[1/s]"]
    printed = call(fit, "kinetic.tsv", "--quantity", "kinetic", "--heights", "all", "--min-shear", str(np.nanmedian(shear)),
                   "--quiet").stdout
    left_out = int(re.search("([0-9]+) below --min-shear", printed)[1])
    assert 0 < left_out <= (shear < np.nanmedian(shear)).sum(), printed


check_hdf5(stress, "stress.h5")
check_hdf5(kinetic, "flow.h5")
check_hdf5(micro, "micro.h5")
check_refusals()
check_sums()
check_b()
