#!/usr/bin/python3
"""Opens a trajectory with h5py and h5dump alone and finds in it what formats/README.md promises.

Usage: h5py_test.py RUN.h5 SPECIFICATION.md    (three grains by hand, 4 frames)
"""
import re
import subprocess
import sys

import h5py
import numpy as np

run, specification = sys.argv[1:]
f = h5py.File(run, "r")

# H5MD 1.1
assert list(f["h5md"].attrs["version"]) == [1, 1]
assert f["h5md/modules/units"].attrs["system"].decode() == "SI"
assert list(f["h5md/modules/grseg"].attrs["version"]) == [1, 0]
box = f["particles/grains/box"]
assert box.attrs["dimension"] == 2
assert [b.decode() for b in box.attrs["boundary"]] == ["periodic", "none"]
position = f["particles/grains/position"]
for element in ("velocity", "angular_velocity", "force", "image"):
    for name in ("step", "time"):
        assert f[f"particles/grains/{element}/{name}"] == position[name], "not a hard link"
for path, unit in (("position", b"m"), ("velocity", b"m s-1"), ("force", b"N")):
    assert f[f"particles/grains/{path}/value"].attrs["unit"] == unit

# Three grains by hand.
assert position["value"].shape == (4, 3, 2)
assert list(position["step"]) == [0, 500, 1000, 1500]
assert np.allclose(position["time"], (np.arange(4) * 500 + 0.5) * 1e-4, rtol=1e-15)
assert list(f["particles/grains/species"]) == [1, 0, 2]
assert list(f["grseg/contacts/offset"]) == [0, 2, 4, 6, 8]
contacts = f["grseg/contacts"]
stress = np.einsum("ka,kb->ab", contacts["force"][0:2], contacts["branch"][0:2])
assert np.allclose(stress, [[0, -0.75e-6 - 3e-6], [0, 1.5e-6 + 10e-6]], rtol=1e-14, atol=1e-20)
assert np.allclose(f["parameters/gravity"], [3.8, -9.0])

# Plain types and deflate and shuffle only, and every dataset is in the specification.
text = open(specification).read()
known = set(re.findall(r"`([A-Za-z_0-9]+)`", text)) | {
    part for path in re.findall(r"`(/[^`]+)`", text) for part in path.split("/")}


def check(name, item):
    if not isinstance(item, h5py.Dataset):
        return
    assert item.dtype.kind in "iufS", f"{name}: {item.dtype}"
    create = item.id.get_create_plist()
    for k in range(create.get_nfilters()):
        assert create.get_filter(k)[0] in (h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_SHUFFLE), name
    if name.startswith(("particles", "grseg")):
        assert name.split("/")[-1] in known, f"{name} is not in the specification"


f.visititems(check)

dump = subprocess.run(["h5dump", "-d", "/grseg/contacts/j", run], capture_output=True, text=True,
                      check=True).stdout
assert "(0): 1, 2, 1, 2, 1, 2, 1, 2" in dump, dump
