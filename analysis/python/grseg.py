# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of grseg in Python: frames, contacts, sums, partial stresses and B(p), on h5py and numpy.

    import grseg

    with grseg.Run("run.h5") as run:
        for frame in run.frames(begin=5):
            print(frame.time, frame.contacts.force.shape)
        sums = run.contact_sums(layer="4dS", window=1.25)
        own = grseg.fit(run, lambda r_large, r_small: r_large**3 / (r_large**3 + r_small**3))
    print(grseg.fit(sums, "size").B, own.B)

Units are SI, also those of arguments: a length is a number in m or text with a unit, a time is in s. x points
down the slope, y up from the base, z across; D is 2 (discs) or 3 (spheres); stress is in N/m or Pa, positive in
compression (formats/README.md). Words: docs/glossary.md. Sums agree to round-off with grseg-stress and
grseg-kinetic with their default --assign, estimates with grseg-fit.

This module does NOT verify the digests of runs (use grseg-check RUN.h5) or the checksum in the last line
of a table. It has no intervals over several flows (grseg-fit has) and no --assign, --bins or --group.

A file that is damaged, unfinished or not made by grseg raises grseg.Error, a wrong argument ValueError.
"""
import collections
import dataclasses
import errno
import functools
import inspect
import itertools
import json
import math
import os
import pathlib
import re
import subprocess
import types
import zlib
from numbers import Real

import h5py
import numpy as np

__all__ = ["Run", "Frame", "Contacts", "Species", "Window", "Table", "Points", "Fit", "Error",
           "read_table", "partial_stress", "fit", "verdict"]


class Error(Exception):
    """Raised for a file that cannot be used; the message names file, place, fault and remedy."""


Species = collections.namedtuple("Species", "name diameter")
Species.__doc__ = "Name and nominal diameter (m; 0: unknown) of a mobile species."

Window = collections.namedtuple("Window", "begin end frames")
Window.__doc__ = "Frames that are averaged together: begin and end (s) of the window, and the numbers of its frames."


# -------------------------------------------------------------------------------------- reading

_FOREIGN = "not a run of grseg, or damaged; grseg-import converts archives of other programs"
_UNFINISHED = ("the run has not ended, or its end was lost: pass unfinished=True to read the frames that it has "
               "(grseg-check reports whether they are intact)")
# Exceptions that h5py raises for damaged files.
_OF_DAMAGE = (OSError, RuntimeError, KeyError, ValueError, TypeError, AttributeError, MemoryError)
_ROWS_OF_BLOCK = 1 << 16  # number of contacts or grains that are read at a time


class Run:
    """A trajectory file of version 1.0, open for reading.

    path         name of the file
    version      version of the file format, "1.0"
    finished     True if the program that wrote the file reached its end and closed it
    dimension    D, 2 or 3
    species      mobile Species in order of size; a grain of kind k belongs to species[k]
    radius, mass, id [N]    radius (m), mass (kg) and name of each grain, the same in all frames
    kind [N]     index of each grain's species; len(species) for boundary grains
    mobile [N]   True for grains of the flow, False for fixed grains and the boundary
    length, width           lengths of the cell along x and z (m); width is None in two dimensions
    periodic [D] True for each axis along which the cell is periodic
    steps, times [F]        numbers of the time steps of the frames, and times of the frames (s)
    step         length of a time step (s)
    gravity [D]  gravity at t = 0 (m/s^2); see `gravity_at` for a slope that changes
    small_diameter, large_diameter    nominal diameters of the first and the last species (m)
    parameters   all entries of /parameters by name: float, array or text
    history      one line per program that wrote or changed the data
    observables  names that `observable` accepts
    has_force    True if frames include the force on each grain
    has_images   True if frames tell how often grains have crossed a period; False for some imports
    digest       content digest of the run, as in tables; it is not verified here

    A run that still goes on, or was killed, raises Error. With `unfinished` its complete frames are
    read instead. (If such a file is also damaged, HDF5 may wait for ever for its writer: check it
    with grseg-check first.) Close a run with a `with` statement, or with `close`.
    """

    def __init__(self, path, unfinished=False):
        self.path = str(path)
        self._file = self._open(unfinished)
        self._datasets = {}
        try:
            self._read_head()
            if not self.finished and not unfinished:
                self._fail(_UNFINISHED)
        except BaseException as error:
            self.close()
            if isinstance(error, _OF_DAMAGE):
                self._fail(f"{_FOREIGN} ({error})")
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __len__(self):
        """Number of frames."""
        return len(self._offset) - 1

    def __iter__(self):
        return self.frames()

    def __getitem__(self, number):
        """The Frame with this number; negative numbers count from the end."""
        if not -len(self) <= number < len(self):
            raise IndexError(f"{self.path}: frame {number} of {len(self)}")
        number %= len(self)
        return Frame(_Block(self, number, number + 1), 0)

    def close(self):
        self._file.close()

    def frames(self, begin=None, end=None, stride=1):
        """Yields the frames with begin <= t < end (s; None: no limit), every `stride`-th one.

        A field is read when it is first used, for a few frames at a time, so that memory does not grow
        with the length of the run."""
        for block in self._blocks(self._numbers(begin, end, stride)):
            for k in range(block.last - block.first):
                yield Frame(block, k)

    def gravity_at(self, time):
        """Gravity [D] at `time` (s), m/s^2; constant if the slope is fixed."""
        angle = math.radians(self.parameters.get("slope_rate", 0.0)) * max(time, 0.0)
        turned = self.gravity.copy()
        turned[0] = math.cos(angle) * self.gravity[0] - math.sin(angle) * self.gravity[1]
        turned[1] = math.sin(angle) * self.gravity[0] + math.cos(angle) * self.gravity[1]
        return turned

    def observable(self, name):
        """The observable `name`: one number per frame [F], in SI units."""
        if name not in self.observables:
            raise KeyError(f"{self.path}: no observable {name}; it has {', '.join(self.observables)}")
        return self._read(f"observables/{name}/value", 0, len(self))

    def metres(self, text):
        """A length in m, given as text with a unit, "0.02m", "20mm", "2cm", "4dS" or "2dL" (nominal diameters), or as
        a number, which is in m: 0.02."""
        return _metres(text, self.small_diameter, self.large_diameter)

    def windows(self, length=1.25, begin=None, end=None, stride=1):
        """A list of the Windows that the tools use. They have the `length` (s) and follow one another from
        `begin` (default: t = 0, or the first frame if that is later) to `end`; windows that the run does not
        fill are left out. length="all" is one window over all frames used."""
        return _cut_into_windows(self, length, begin, end, stride)[1]

    def contact_sums(self, layer="4dS", window=1.25, begin=None, end=None, stride=1, power=None, rule=None):
        """Sums of force (x) branch, the tensor product, by layer, window and pair of species. The Table
        has the columns of grseg-stress: areas or volumes of the grains, numbers of contacts, and tensors
        (N m), all as means per frame. A contact is counted in the layer of its contact point.

        layer     thickness of the layers: text with a unit (`metres`), or a number in m
        window    length of the windows, s; begin, end: times, s; stride: use every stride-th frame (`windows`)
        power     the Q of a rule power:Q: the Table has Mpower, too
        rule      a rule of your own (`fit`): the Table has Mrule, too, and keeps the rule as `rule`. A rule by name
                  that needs sums of its own, "power:Q", sets `power`."""
        if isinstance(rule, str):
            word, number = _parse_rule(rule)
            power, rule = number if word == "power" else power, None
        shares = _shares(power, rule)
        table = self._tabulate(functools.partial(_contact_sums, self, shares=shares), _stress_columns(self, shares), layer,
                               (window, begin, end, stride), _stress_header(power))
        table.rule = rule
        return table

    def kinetic_sums(self, layer="4dS", window=1.25, begin=None, end=None, stride=1, mean="profile"):
        """Sums of m dv (x) dv by layer, window and species, as a Table with columns of grseg-kinetic:
        masses, mean flow, K (J), Kr of rotation (J), numbers of grains. dv is the velocity minus a mean
        velocity: a fine profile over height (mean="profile") or the mean of the layer (mean="layer").
        Both means are over the window, whose frames are read twice. The other arguments are those of
        `contact_sums`: `layer` is text with a unit or a number in m, times are in s."""
        if mean not in ("profile", "layer"):
            raise ValueError(f"mean = {mean!r}: write profile or layer; grseg-kinetic has more choices")
        return self._tabulate(functools.partial(_kinetic_sums, self, mean=mean), _kinetic_columns(self), layer,
                              (window, begin, end, stride), {"mean": mean})

    # Functions below are used in this file only.

    def _thickness(self, layer):
        """`layer` in m. A number that is larger than the cell was rather meant in diameters."""
        if isinstance(layer, Real) and layer > self.length:
            raise ValueError(f"layer = {layer} is {layer} m, more than the {self.length:g} m of the cell: write \"{layer}dS\" "
                             f"for small diameters, or \"{layer}m\"")
        return self.metres(layer)

    def _fail(self, why):
        raise Error(f"{self.path}: {why}")

    def _open(self, unfinished):
        try:
            with open(self.path, "rb") as file:
                head = file.read(12)
        except OSError as error:
            self._fail(error.strerror)
        # The superblock has this mark while a program writes the file in SWMR mode, and after that program was killed.
        has_writer = head[:9] == b"\x89HDF\r\n\x1a\n\x03" and head[11:] != b"" and head[11] & 5 == 5
        if has_writer and not unfinished:
            self._fail(_UNFINISHED)
        for locking in (None, False):  # many file systems of clusters have no locks, and reading needs none
            try:
                return h5py.File(self.path, "r", swmr=has_writer, locking=locking)
            except _OF_DAMAGE as error:
                refusal = error
            if getattr(refusal, "errno", None) == errno.EWOULDBLOCK:
                self._fail("is being written by a run; wait until it has ended, or read a copy")
        self._fail_of_system(refusal)
        return self._fail("is not an HDF5 file, or is truncated or damaged; use an intact copy")

    def _fail_of_system(self, error):
        """Fails with the system's reason if `error` has one: then the file is not damaged."""
        if isinstance(error, MemoryError):
            self._fail("needs more memory than is free, unless grseg-check --deep finds damage; use a shorter window")
        if getattr(error, "errno", None):
            self._fail(f"cannot be read: {os.strerror(error.errno)}")

    def _dataset(self, path, rank, kinds="f"):
        """The dataset at `path`. Fails unless it has `rank` dimensions and one of numpy's type `kinds`."""
        try:
            dataset = self._file[path]
        except _OF_DAMAGE:
            dataset = None
        if not isinstance(dataset, h5py.Dataset):
            self._fail(f"/{path} is missing: {_FOREIGN}")
        if dataset.ndim != rank or dataset.dtype.kind not in kinds:
            self._fail(f"/{path} has {dataset.ndim} dimensions of type {dataset.dtype}, which "
                       "formats/README.md does not list; grseg-check --deep reports more")
        return dataset

    def _read(self, path, first, last):
        """Rows [first, last) of a dataset: real numbers as float64, integers as int64."""
        try:
            if path not in self._datasets:
                self._datasets[path] = self._file[path]
            rows = self._datasets[path][first:last]
        except _OF_DAMAGE as error:
            self._fail_of_system(error)
            rows = ()
        if len(rows) != last - first:
            self._fail(f"/{path}: rows {first} to {last - 1} cannot be read: the file is damaged; use an "
                       "intact copy, or leave their frames out with begin or end")
        rows = rows.astype(np.float64 if rows.dtype.kind == "f" else np.int64, copy=False)
        rows.flags.writeable = False
        return rows

    def _constant(self, path, count, kinds="f"):
        dataset = self._dataset(path, 1, kinds)
        if len(dataset) != count:
            self._fail(f"/{path} has {len(dataset)} entries instead of {count}; the file is damaged")
        return self._read(path, 0, count)

    def _read_head(self):
        self._read_version()
        self._come_and_go = "come_and_go" in self._file["particles/grains"].attrs
        self._read_parameters()
        self._offset = self._read("grseg/contacts/offset", 0,
                                  len(self._dataset("grseg/contacts/offset", 1, "u")))
        if len(self._offset) == 0 or self._offset[0] != 0 or (np.diff(self._offset) < 0).any():
            self._fail("/grseg/contacts/offset does not increase from 0; the file is damaged")
        self._read_box()
        self._read_species()
        self._read_grains()
        self._require_shapes()
        self.observables = sorted(self._file.get("observables", ()))
        self._read_times()
        self._read_end()

    def _read_version(self):
        try:
            major, minor = self._file["h5md/modules/grseg"].attrs["version"]
        except _OF_DAMAGE:
            self._fail(f"/h5md/modules/grseg has no version: {_FOREIGN}")
        self.version = f"{major}.{minor}"
        if self.version != "1.0":
            self._fail(f"/h5md/modules/grseg has version {self.version}, and this grseg.py reads 1.0; use the "
                       "grseg.py of the grseg that wrote the file")

    def _read_parameters(self):
        self.parameters = {}
        for name in self._file.get("parameters", ()):
            value = self._file[f"parameters/{name}"]
            if isinstance(value, h5py.Dataset):
                value = value[()]
                self.parameters[name] = _text(value) if isinstance(value, bytes) else (
                    float(value) if np.ndim(value) == 0 else np.asarray(value, dtype=float))
        for name in ("small_diameter", "large_diameter", "step", "gravity"):
            if name not in self.parameters:
                self._fail(f"/parameters/{name} is missing: {_FOREIGN}")
            setattr(self, name, self.parameters[name])
        self.history = self.parameters.get("history", "").splitlines()
        if not 0 < self.step < math.inf:
            self._fail(f"/parameters/step is {self.step}; it should be positive")

    def _read_box(self):
        box = self._file.get("particles/grains/box")
        self.dimension = 3 if box is not None and box.attrs.get("dimension") == 3 else 2
        edges = self._constant("particles/grains/box/edges", self.dimension)
        self.length = float(edges[0])
        self.width = float(edges[2]) if self.dimension == 3 else None
        self.periodic = tuple(_text(word) == "periodic" for word in box.attrs["boundary"])
        if len(self.gravity) != self.dimension:
            self._fail(f"/parameters/gravity should be {self.dimension} numbers; the file is damaged")

    def _read_species(self):
        names = [_text(name) for name in self._dataset("grseg/species/name", 1, "S")]
        if len(names) < 2 or names[-1] != "boundary":
            self._fail("/grseg/species/name should list mobile species and, last, the boundary")
        diameters = self._constant("grseg/species/diameter", len(names))
        self.species = tuple(Species(name, float(d)) for name, d in zip(names[:-1], diameters))

    def _read_grains(self):
        count = len(self._dataset("particles/grains/radius", 1))
        self.radius = self._constant("particles/grains/radius", count)
        self.mass = self._constant("particles/grains/mass", count)
        self.id = self._constant("particles/grains/id", count, "iu")
        self.kind = self._constant("particles/grains/species", count, "iu")
        fixed = self._constant("particles/grains/fixed", count, "iu")
        if not ((self.radius > 0) & (self.mass > 0) & np.isfinite(self.radius * self.mass)).all():
            self._fail("/particles/grains: a radius or mass is not positive; the file is damaged")
        if not ((self.kind >= 0) & (self.kind <= len(self.species))).all():
            self._fail("/particles/grains/species names a species that is not listed; the file is damaged")
        self.mobile = (self.kind < len(self.species)) & (fixed == 0)
        # Kind and radius of the second grain of a contact by row; the last entry (index -1) is for straight walls.
        self._partner_kind = np.append(np.where(self.mobile, self.kind, len(self.species)), len(self.species))
        self._partner_radius = np.append(self.radius, np.nan)

    def _require_shapes(self):
        d, grains, frames, contacts = self.dimension, len(self.radius), len(self), int(self._offset[-1])
        self.has_force = "force" in self._file["particles/grains"]
        self.has_images = (not any(self.periodic) or "import_format" not in self.parameters
                           or self.parameters.get("import_images") == "known")
        of_grains = ["position", "velocity", "image"] + ["force"] * self.has_force
        rows = {f"particles/grains/{name}/value": (frames, (grains, d)) for name in of_grains}
        rows["particles/grains/angular_velocity/value"] = frames, (grains,) if d == 2 else (grains, 3)
        for name, shape in {"i": (), "j": (), "force": (d,), "branch": (d,), "gap": ()}.items():
            rows[f"grseg/contacts/{name}"] = (contacts, shape)
        for path, (count, shape) in rows.items():
            integers = path.rsplit("/")[-1] in "ij" or "image" in path
            found = self._dataset(path, 1 + len(shape), "iu" if integers else "f").shape
            if found[0] < count or found[1:] != shape:
                self._fail(f"/{path} has the shape {found} and should have {(count, *shape)}; the file is damaged")

    def _read_times(self):
        self.steps = self._read("particles/grains/position/step", 0, len(self))
        self.times = self._read("particles/grains/position/time", 0, len(self))
        if (np.diff(self.steps) <= 0).any() or not (np.diff(self.times) > 0).all():
            self._fail("/particles/grains/position: steps or times do not increase; the file is damaged")

    def _read_end(self):
        """Reads the digest, and the seal, which only a run that was closed has."""
        digests = self._dataset("grseg/digest", 1, "u")
        if len(digests) < len(self):
            self._fail(f"/grseg/digest has no entry for frame {len(self) - 1}; the file is damaged")
        last = int(digests[len(self) - 1]) if len(self) else 0
        self.digest = f"{last:016x}"
        seal = [int(number) for number in self._dataset("grseg/seal", 1, "u")[:]]
        self.finished = any(seal)
        if self.finished and seal[:3] != [len(self), int(self._offset[-1]), last]:
            self._fail("/grseg/seal does not agree with the frames: the file is damaged; use an intact copy")

    def _numbers(self, begin, end, stride):
        if stride < 1:
            raise ValueError(f"stride = {stride}: write 1 or more")
        first = 0 if begin is None else np.searchsorted(self.steps, _whole_steps(begin, self.step))
        last = len(self) if end is None else np.searchsorted(self.steps, _whole_steps(end, self.step))
        return range(int(first), int(last), stride)

    def _blocks(self, numbers):
        """Yields blocks of consecutive frames with at most _ROWS_OF_BLOCK rows, or of a single frame."""
        numbers = iter(numbers)
        first = next(numbers, None)
        while first is not None:
            last, number = first + 1, next(numbers, None)
            while number == last and (self._offset[last + 1] - self._offset[first] <= _ROWS_OF_BLOCK) and (
                    (last + 1 - first) * len(self.radius) <= _ROWS_OF_BLOCK):
                last, number = last + 1, next(numbers, None)
            yield _Block(self, first, last)
            first = number

    def _tabulate(self, sums_of_window, columns, layer, window, settings):
        np.empty(1 << 21)  # after this, glibc reuses freed memory up to 16 MB for temporaries: twice as fast
        layers = _Layers(self._thickness(layer), self.length, self.width, self.path)
        length, windows = _cut_into_windows(self, *window)
        rows = []
        for begin, end, frames in windows:
            for n, values in enumerate(sums_of_window(layers, frames)):
                key = (begin, end, layers.bottom(n), layers.bottom(n + 1), len(frames), layers.volume)
                rows.append((*key, *values))
        header = _run_header(self, layers, length, window[3]) | settings
        keys = ("t0[s]", "t1[s]", "y0[m]", "y1[m]", "frames", f"V[m^{self.dimension}]")
        source = _Source(header["input"], _parse_bed(header["bed"]), tuple(self.history))
        return Table(self.path, header, self.history, (*keys, *columns), np.array(rows), [source])


def _text(value):
    return value.split(b"\0")[0].decode("utf-8", "replace")


def _metres(text, small_diameter, large_diameter):
    if isinstance(text, Real):
        return float(text)
    units = {"m": 1, "mm": 1e-3, "cm": 1e-2, "dS": small_diameter, "dL": large_diameter}
    number = str(text).rstrip("mcdSL")
    try:
        value = float(number)
        if number != text or value == 0:
            return value * units[text[len(number):] or "m"]
    except (ValueError, KeyError):
        raise ValueError(f"{text!r} is not a length: give a number with a unit, as in 0.02m, 20mm, 4dS, 2dL") from None
    raise ValueError(f"{text!r} has no unit: {text}dS, {text}dL or {text}m?")


class _Block:
    """Frames [first, last) of a run. A field is read and checked when it is first used, and stored read-only."""

    def __init__(self, run, first, last):
        self.run, self.first, self.last = run, first, last
        offset = run._offset[first:last + 1]
        self.rows = slice(int(offset[0]), int(offset[-1]))
        self.offset = offset - offset[0]
        self._kept = {}

    def grains(self, name):
        """A field of the grains [F, N, ...]."""
        if name == "force" and not self.run.has_force:
            self.run._fail("/particles/grains/force/value is missing: this run was imported without it")
        return self._field(f"particles/grains/{name}/value", self.first, self.last, self._require_finite_grains)

    def contacts(self, name):
        """A field of the contacts [C, ...], in the order of frames."""
        return self._field(f"grseg/contacts/{name}", self.rows.start, self.rows.stop,
                           self._require_rows if name in ("i", "j") else self._require_finite)

    def _field(self, path, first, last, require):
        if path not in self._kept:
            values = self.run._read(path, first, last)
            require(values, path)
            self._kept[path] = values
        return self._kept[path]

    @functools.cached_property
    def frame_of_contact(self):
        """Index of each contact's frame in the block [C]."""
        return np.repeat(np.arange(self.last - self.first), np.diff(self.offset))

    @functools.cached_property
    def heights(self):
        """Heights y of all grains [F N], m, in the order of frames."""
        return self.grains("position")[..., 1].ravel()

    @functools.cached_property
    def present(self):
        """True for mobile grains that are present [F, N]."""
        return self.run.mobile & ~np.isnan(self.grains("position")[..., 1])

    @functools.cached_property
    def below(self):
        """True for mobile grains that have left the bed through its base, as out of a hopper, and belong to no layer
        (analysis/frames/grains_below.hpp) [F, N]."""
        y, mobile = self.grains("position")[..., 1], self.run.mobile
        boundary = np.nan_to_num(y[:, ~mobile]).min(axis=1, initial=0.0)
        return mobile & (y < np.minimum(boundary, -2 * self.run.radius[mobile].max(initial=0.0))[:, None])

    @functools.cached_property
    def counted(self):
        """True for mobile grains that are present and not below the bed [F, N]."""
        return self.present & ~self.below

    @functools.cached_property
    def mobile_grains(self):
        """Indices in `heights` and rows of all grains that are `counted`, in the order of frames."""
        place = np.flatnonzero(self.counted)
        return place, np.tile(np.arange(len(self.run.radius)), self.last - self.first).take(place)

    def _place(self, contact):
        """Name of a contact of the block: "contact 3 of frame 17"."""
        frame = np.searchsorted(self.offset, contact, side="right") - 1
        return f"contact {contact - self.offset[frame]} of frame {self.first + frame}"

    def _require_finite(self, values, path):
        good = np.isfinite(values)
        if not good.all():
            self._fail_at(self._place(np.argwhere(~good)[0][0]), path)

    def _require_finite_grains(self, values, path):
        """Fails if a value is not finite; absent grains may have NaN in all components."""
        good = np.isfinite(values).reshape(*values.shape[:2], -1)
        if good.all():
            return
        bad = ~(good.all(axis=2) | (self.run._come_and_go & np.isnan(values).reshape(good.shape).all(axis=2)))
        if bad.any():
            frame, grain = np.argwhere(bad)[0]
            self._fail_at(f"grain {grain} of frame {self.first + frame}", path)

    def _fail_at(self, place, path):
        self.run._fail(f"/{path} is not a finite number in {place}; the frame is damaged: use an intact "
                       "copy, or leave the frame out with begin or end")

    def _require_rows(self, values, path):
        grains = len(self.run.radius)
        bad = values >= grains
        if path.endswith("i"):
            bad |= values < 0
            bad |= ~self.run.mobile[np.where(bad, 0, values)]
        if self.run._come_and_go:
            place = self.frame_of_contact * grains + np.where(bad, 0, values)
            bad |= (values >= 0) & np.isnan(self.heights[place])
        if bad.any():
            contact = np.flatnonzero(bad)[0]
            self.run._fail(f"/{path} is {values[contact]} in {self._place(contact)}, which is not the row of a grain "
                           "that can have a contact; the frame is damaged")


class Frame:
    """A frame: the state of a run at one time. Time, positions and contacts are those in the middle of a
    time step, velocities those at its end. In an imported run all are of one instant. Arrays are read-only.

    number, step, time          number of the frame in the run, number of its time step, time (s)
    position [N, D]             positions of the centres, wrapped into the cell, m
    image [N, D]                number of cell lengths to add to the position along each axis; masked if the run
                                does not tell it (Run.has_images)
    velocity [N, D]             velocities, m/s
    angular_velocity [N], in three dimensions [N, 3]    1/s, counter-clockwise, right-handed
    force [N, D]                contact forces + weight, m (v_after - v_before)/h, N; not in all imported runs
    present [N]                 True for mobile grains that exist in this frame: all, unless grains come and go
    contacts                    Contacts of the frame
    coordination() [N]          number of force-bearing contacts of each grain, base and walls included
    """

    def __init__(self, block, k):
        self._block, self._k = block, k
        self.number = block.first + k
        self.step = int(block.run.steps[self.number])
        self.time = float(block.run.times[self.number])

    position = property(lambda self: self._block.grains("position")[self._k])
    image = property(lambda self: np.ma.array(self._block.grains("image")[self._k], mask=not self._block.run.has_images))
    velocity = property(lambda self: self._block.grains("velocity")[self._k])
    angular_velocity = property(lambda self: self._block.grains("angular_velocity")[self._k])
    force = property(lambda self: self._block.grains("force")[self._k])
    present = property(lambda self: self._block.present[self._k])
    contacts = property(lambda self: Contacts(self._block, self._k))

    def coordination(self):
        contacts = self.contacts
        rows = np.concatenate([contacts.i[contacts.pushing], contacts.j[contacts.pushing]])
        return np.bincount(rows[rows >= 0], minlength=len(self._block.run.radius))


class Contacts:
    """The contacts of a frame. Some bear no force, and runs of contact dynamics also list pairs that may soon
    touch: take means over the contacts with `pushing` True.

    i [C]            row of the first grain, which is mobile
    j [C]            row of the second grain; j < 0: straight wall number -j-1
    force [C, D]     force ON i FROM j, N
    branch [C, D]    x_i - x_j, nearest image, m; at a wall x_i minus the contact point
    gap [C]          distance of the two surfaces, m; negative if they overlap
    pushing [C]      True if the contact bears a force; the tools use only these contacts
    kind_i, kind_j [C]    species indices of the two grains; len(species) for base and walls
    share_i [C]      fraction of the branch between the centre of i and the contact point; 1 at a wall
    point [C, D]     contact point x_i - share_i branch, m

    sigma = (1/V) sum of force (x) branch is positive in compression.
    """

    def __init__(self, block, k):
        self._block, self._k = block, k
        self._rows = slice(block.offset[k], block.offset[k + 1])

    def __len__(self):
        return int(self._rows.stop - self._rows.start)

    i = property(lambda self: self._block.contacts("i")[self._rows])
    j = property(lambda self: self._block.contacts("j")[self._rows])
    force = property(lambda self: self._block.contacts("force")[self._rows])
    branch = property(lambda self: self._block.contacts("branch")[self._rows])
    gap = property(lambda self: self._block.contacts("gap")[self._rows])
    pushing = property(lambda self: self.force.any(axis=1))
    kind_i = property(lambda self: self._block.run.kind[self.i])
    kind_j = property(lambda self: self._block.run._partner_kind[np.maximum(self.j, -1)])
    share_i = property(lambda self: _share_of_first(self._block.run, self.i, self.j, self.gap))

    @property
    def point(self):
        return self._block.grains("position")[self._k][self.i] - self.share_i[:, None] * self.branch


def _share_of_first(run, i, j, gap):
    r_i, r_j = run.radius[i], run._partner_radius[np.maximum(j, -1)]
    return np.where(j < 0, 1.0, (r_i + gap / 2) / (r_i + r_j + gap))


# ----------------------------------------------------------------------------- windows and layers

def _whole_steps(time, step):
    """The number of steps nearest to `time`; rounding keeps frames on their side of a limit despite round-off."""
    return int(math.copysign(math.floor(abs(time / step) + 0.5), time))


def _longest_interval(run, gaps):
    """Largest number of steps that a frame represents; as longest_interval() of analysis/frames/windows.cpp."""
    gaps = sorted((int(gap) for gap in gaps), reverse=True)
    interval = 0
    if "import_format" not in run.parameters:  # the interval of imported runs is only a mean
        interval = _whole_steps(run.parameters.get("frame_interval", 0.0), run.step)
    if interval > 0:
        found = next((gap for gap in gaps if gap <= interval), 0)
        return found if 2 * found >= interval else interval
    regular = (gap for k, gap in enumerate(gaps[:-2]) if 2 * gaps[k + 2] >= gap)
    return next(regular, gaps[0] if gaps else 1)


def _empty_part(steps, longest, begin, length):
    """Number of steps in a window that no frame represents; the time before the first frame counts as represented."""
    before, inside = steps[steps <= begin], steps[(steps > begin) & (steps < begin + length)]
    filled = np.append(before[-1] + longest if len(before) else steps[0], inside + longest)
    return np.maximum(np.append(inside, begin + length) - np.maximum(filled, begin), 0).sum()


def _cut_into_windows(run, length, begin, end, stride):
    """Length of the windows and list of windows, as in cut_into_windows() of analysis/frames/windows.cpp."""
    length = math.inf if length == "all" else length
    if not (length > 0 and stride >= 1):
        raise ValueError(f"a window of {length} s, stride {stride}: both must be positive")
    steps = run.steps
    if len(steps) == 0:
        run._fail("the run has no frames")
    gaps = np.diff(steps)
    longest = _longest_interval(run, gaps)
    within = np.minimum(gaps, longest)
    used = max([longest] if len(gaps) == 0 else [within[k:k + stride].sum() for k in range(max(1, len(gaps) - stride + 1))])
    if begin is None:
        first = int(steps[0]) if steps[-1] < 0 else max(0, int(steps[0]))
    else:
        first = _whole_steps(begin, run.step)
    last = int(steps[-1]) + longest
    if end is not None:
        last = min(last, _whole_steps(end, run.step))
    if not ((steps >= first) & (steps < last)).any():
        run._fail(f"no frame lies between begin and end; the run goes from {steps[0] * run.step:g} s to "
                  f"{steps[-1] * run.step:g} s")
    if length == math.inf:
        first = max(first, int(steps[0]))
    whole = last - first if length == math.inf else _whole_steps(length, run.step)
    if whole < used and length < math.inf:
        raise ValueError(f"a window of {length} s is shorter than the {used * run.step:g} s between the "
                         f"frames of {run.path} that are used; choose at least this length, or \"all\"")
    exact = whole * run.step
    width = length if abs(exact - length) < 1e-9 * exact else exact
    origin = begin if begin is not None and _whole_steps(begin, run.step) == first else first * run.step
    frames_of = collections.defaultdict(list)
    for k in range(int(np.searchsorted(steps, first)), len(steps), stride):
        n = (int(steps[k]) - first) // whole
        if first + (n + 1) * whole > last:
            break
        frames_of[n].append(k)
    frames_of = {n: frames for n, frames in frames_of.items()
                 if first + n * whole > steps[0] - longest  # otherwise the run begins inside it
                 and (length == math.inf or _empty_part(steps, longest, first + n * whole, whole) <= 0.1 * whole)}
    if not frames_of:
        run._fail(f"no window of {length} s is filled: the frames used are from {origin:g} s to {last * run.step:g} s; "
                  "choose a shorter window, \"all\", or another begin and end")
    return width, [Window(origin + n * width, origin + (n + 1) * width, frames) for n, frames in frames_of.items()]


class _Layers:
    """Layers of thickness h: layer n is [n h, (n+1) h). The first layer includes what dips below y = 0, and the
    last layer of a frame everything above it (analysis/frames/layers.hpp)."""

    def __init__(self, thickness, length, width, path):
        if not 0 < thickness < math.inf:
            raise ValueError(f"a layer of {thickness} m has no thickness; write e.g. 4dS")
        self.h, self.path = thickness, path
        self.volume = thickness * length * (1.0 if width is None else width)

    def bottom(self, n):
        return n * self.h

    def at(self, y):
        """Indices of the layers that contain the heights `y`."""
        y = np.maximum(y, 0)
        n = np.floor(y * (1 / self.h))
        # The product may be rounded to the wrong side of an edge.
        n -= y < n * self.h
        n += y >= (n + 1) * self.h
        return n.astype(np.int64)

    def counts(self, block):
        """Number of layers up to the top of the highest mobile grain of each frame, at least 1."""
        top = block.grains("position")[..., 1] + block.run.radius
        highest = np.where(block.present, top, 0.0).max(axis=1, initial=0.0)
        if not (highest < 100000 * self.h).all():
            frame = np.argmax(highest)
            raise Error(f"{self.path}: in frame {block.first + frame} a grain is {highest[frame]:.3g} m above the base, "
                        "more than 100000 layers; is it lost, or are the layers too thin?")
        n = self.at(highest)
        return np.where(highest > n * self.h, n + 1, np.maximum(n, 1))


def _grow(sums, layers):
    """`sums`, an array by layer, extended to at least `layers` layers with zeros."""
    missing = layers - len(sums)
    return sums if missing <= 0 else np.concatenate([sums, np.zeros((missing, *sums.shape[1:]))])


def _book(sums, place, components):
    """Adds components[c][k] (None: 1) for all k to sums [layers, bins, components], at the flat index place[k] of
    (layer, bin)."""
    for c, values in enumerate(components):
        added = np.bincount(place, values, minlength=sums[..., c].size)
        sums[..., c] += added.reshape(sums.shape[:2])


# ------------------------------------------------------------------------------------------- sums

class _Names:
    """Names of columns by species and pair: S and L if there are two species, otherwise the species' names."""

    def __init__(self, species, dimension):
        self.two = len(species) == 2
        self.words = ("S", "L") if self.two else tuple(one.name for one in species)
        self.axes = "xyz"[:dimension]
        self.contents = [("volume_" if dimension == 3 else "area_") + word for word in self.words]

    def inside(self, k):
        return f"A_{self.words[k]}{self.words[k]}" if self.two else f"A_{self.words[k]}"

    def halves(self, k):
        return f"H{self.words[k]}{self.words[k]}" if self.two else f"H_{self.words[k]}"

    def base(self, stem, k):
        return f"{stem}_{self.words[k]}{'' if self.two else '+'}b"

    def pair(self, stem, a, b):
        return stem if self.two else f"{stem}_{self.words[a]}+{self.words[b]}"

    def numbers(self):
        """Names of the columns with numbers of contacts, in the order of _code."""
        count = len(self.words)
        pairs = [self.words[b] + self.words[a] if self.two else
                 self.words[a] if a == b else f"{self.words[a]}+{self.words[b]}"
                 for b in range(count) for a in range(b + 1)]
        return [f"n_{pair}" for pair in pairs] + [self.base("n", k) for k in range(count)]


def _code(a, b):
    """Index of a pair of species a <= b: SS, LS, LL, ... Pairs with the base follow all pairs of species."""
    return b * (b + 1) // 2 + a


def _pairs(species):
    return [(a, b) for b in range(species) for a in range(b)]


def _with_components(stems, axes, unit):
    return [f"{stem}_{a}{b}[{unit}]" for stem in stems for a in axes for b in axes]


def _stress_columns(run, shares):
    names, count = _Names(run.species, run.dimension), len(run.species)
    own = range(count)
    stems = [names.inside(k) for k in own]
    for stem in ("M", "Msize", "Mcp"):
        stems += [names.pair(stem, a, b) for a, b in _pairs(count)]
    stems += [names.base("A", k) for k in own] + [names.base("F", k) for k in own]
    for stem in shares:
        stems += [names.pair(f"M{stem}", a, b) for a, b in _pairs(count)]
    contents = [f"{name}[m^{run.dimension}]" for name in names.contents]
    word = "volume" if run.dimension == 3 else "area"
    motion = [f"{word}_u[m^{run.dimension + 1}/s]", f"{word}_v2[m^{run.dimension + 2}/s^2]"]
    return contents + motion + names.numbers() + _with_components(stems, names.axes, "N m")


def _stress_header(power):
    header = {"assign": "contact-point", "composition": "clipped", "partition": "size", "base": "contact-point"}
    return header if power is None else header | {"partition": f"power:{power:g}", "power": f"{power:.17g}"}


def _contact_sums(run, layers, frames, shares):
    """Values of _stress_columns [layers, columns]; `shares`: rules that need sums of their own (_shares)."""
    species = len(run.species)
    bins = _code(0, species) + species
    content, motion, number = np.zeros((0, species, 1)), np.zeros((0, 1, 2)), np.zeros((0, bins, 1))
    # Sums of force (x) a part of the branch. whole: the whole branch. cut: from the centre of the larger grain, or of
    # the grain at the base, to the contact point. Others: the larger grain's share by a rule.
    shares = {"size": _power_share(1)} | shares
    sums = {name: np.zeros((0, bins, run.dimension**2)) for name in ("whole", "cut", *shares)}
    for block in run._blocks(frames):
        counts = layers.counts(block)
        most = counts.max(initial=1)
        content, motion, number = (_grow(values, most) for values in (content, motion, number))
        sums = {name: _grow(values, most) for name, values in sums.items()}
        _add_contents(run, layers, block, counts, content, motion)
        _add_contacts(run, layers, block, counts, number, sums, shares)
    own, base = [_code(k, k) for k in range(species)], [_code(k, species) for k in range(species)]
    mixed = [_code(a, b) for a, b in _pairs(species)]
    parts = [content, motion, number, sums["whole"][:, own], sums["whole"][:, mixed], sums["size"][:, mixed],
             sums["cut"][:, mixed], sums["cut"][:, base], sums["whole"][:, base]]
    parts += [sums[name][:, mixed] for name in shares if name != "size"]
    return np.concatenate([part.reshape(len(part), -1) for part in parts], axis=1) / len(frames)


def _part_below(dimension, r, height):
    """Area of a disc, or volume of a sphere, below a level `height` above its centre."""
    d = np.clip(height, -r, r)
    if dimension == 3:
        return math.pi / 3 * (r + d) * (r + d) * (2 * r - d)
    return r * r * (math.pi / 2 + np.arcsin(d / r)) + d * np.sqrt(r * r - d * d)


def _add_contents(run, layers, block, counts, content, motion):
    """Adds areas or volumes of the grains to `content`, cut at the edges of layers, and to `motion` these areas or volumes
    times the velocity along x and times the square of the velocity."""
    place, grain = block.mobile_grains
    velocity = block.grains("velocity").reshape(block.heights.size, -1).take(place, axis=0)
    u, square = velocity[:, 0], (velocity**2).sum(axis=1)
    y, r, kind = block.heights.take(place), run.radius.take(grain), run.kind.take(grain)
    last = np.repeat(counts - 1, block.counted.sum(axis=1))
    n, last = np.minimum(layers.at(y - r), last), np.minimum(layers.at(y + r), last)
    whole = math.pi * r * r if run.dimension == 2 else 4 * math.pi / 3 * r * r * r
    below = np.zeros_like(r)
    while len(n):
        cut = np.flatnonzero(n < last)
        here = whole.copy()
        here[cut] = _part_below(run.dimension, r.take(cut), layers.bottom(n.take(cut) + 1) - y.take(cut))
        _book(content, n * len(run.species) + kind, [here - below])
        _book(motion, n, [(here - below) * u, (here - below) * square])
        n, last, y, r, kind, whole, u, square, below = (
            values.take(cut) for values in (n + 1, last, y, r, kind, whole, u, square, here))


def _add_contacts(run, layers, block, counts, number, sums, shares):
    """Adds numbers and force (x) branch of force-bearing contacts to the layers of their contact points."""
    force, branch = block.contacts("force"), block.contacts("branch")
    i, j, frame = block.contacts("i"), block.contacts("j"), block.frame_of_contact
    fields = [*force.T, *branch.T, block.contacts("gap"), i, j, frame]
    pushing = sum(component != 0 for component in force.T) > 0
    if block.below.any():
        pushing &= ~(block.below[frame, i] | ((j >= 0) & block.below[frame, np.maximum(j, 0)]))
    rows = np.flatnonzero(pushing)
    if len(rows) < len(force):
        fields = [field.take(rows) for field in fields]
    force, branch, (gap, i, j, frame) = fields[:run.dimension], fields[run.dimension:-4], fields[-4:]
    share_i = _share_of_first(run, i, j, gap)
    y = block.heights.take(frame * len(run.radius) + i) - share_i * branch[1]
    layer = np.minimum(layers.at(y), counts.take(frame) - 1)
    kind_i, kind_j = run.kind.take(i), run._partner_kind[np.maximum(j, -1)]
    # The base has the highest number, so that codes of base contacts follow the codes of pairs.
    place = layer * number.shape[1] + _code(np.minimum(kind_i, kind_j), np.maximum(kind_i, kind_j))
    stress = [f * b for f in force for b in branch]
    _book(number, place, [None])
    _book(sums["whole"], place, stress)

    unlike = np.flatnonzero(kind_i != kind_j)
    place, i, j, kind_i, kind_j, share_i, gap, *vectors = (
        values.take(unlike) for values in (place, i, j, kind_i, kind_j, share_i, gap, *force, *branch))
    cut = np.where((kind_i > kind_j) | (kind_j == len(run.species)), share_i, 1 - share_i)
    force, branch = vectors[:run.dimension], vectors[run.dimension:]
    _book(sums["cut"], place, [cut * f * b for f in force for b in branch])

    mixed = np.flatnonzero(kind_j < len(run.species))
    place, i, j, kind_i, kind_j, gap, *vectors = (
        values.take(mixed) for values in (place, i, j, kind_i, kind_j, gap, *force, *branch))
    force, branch = vectors[:run.dimension], vectors[run.dimension:]
    if len(gap) == 0:
        return
    contacts = _MixedContacts(run, i, j, kind_i, kind_j, gap, force, branch)
    for name, share in shares.items():
        by_rule = _share_by(share, contacts, len(gap))
        _book(sums[name], place, [by_rule * f * b for f in force for b in branch])


class _MixedContacts:
    """Contacts between mobile grains of two species, whose fields are what a rule may ask for (`fit`). Force and branch
    are given by component, force on i from j."""

    def __init__(self, run, i, j, kind_i, kind_j, gap, force, branch):
        i_is_larger = kind_i > kind_j
        r_i, r_j = run.radius.take(i), run.radius.take(j)
        diameters = np.array([one.diameter for one in run.species])
        self.r_large, self.r_small = np.where(i_is_larger, r_i, r_j), np.where(i_is_larger, r_j, r_i)
        self.d_large, self.d_small = (diameters[end(kind_i, kind_j)] for end in (np.maximum, np.minimum))
        self.gap = gap
        self._sign, self._force, self._branch = np.where(i_is_larger, 1.0, -1.0), force, branch

    force = property(lambda self: np.stack(self._force, axis=1) * self._sign[:, None])
    branch = property(lambda self: np.stack(self._branch, axis=1) * self._sign[:, None])


def _kinetic_columns(run):
    names = _Names(run.species, run.dimension)
    return ([f"mass_{word}[kg]" for word in names.words] + ["u[m/s]", "v[m/s]", "du_dy[1/s]"]
            + _with_components([f"K_{word}" for word in names.words], names.axes, "J")
            + [f"Kr_{word}[J]" for word in names.words] + [f"grains_{word}" for word in names.words]
            + ([] if _has_one_density(run) else [f"{name}[m^{run.dimension}]" for name in names.contents]))


def _content(run):
    """Area or volume of each grain [N], m^2 or m^3."""
    return math.pi * run.radius**2 if run.dimension == 2 else 4 * math.pi / 3 * run.radius**3


def _has_one_density(run):
    """True if all mobile grains have one density, to the precision of archives (1e-5)."""
    density = (run.mass / _content(run))[run.mobile]
    return density.max(initial=0) <= density.min(initial=math.inf) * (1 + 1e-5)


def _moving(run, block):
    """Rows, heights, and components of velocity and spin of the mobile grains of a block."""
    place, grain = block.mobile_grains
    velocity, spin = block.grains("velocity"), block.grains("angular_velocity")
    fields = [field.reshape(block.heights.size, -1).take(place, axis=0).T for field in (velocity, spin)]
    return grain, block.heights.take(place), np.concatenate(fields)


def _kinetic_sums(run, layers, frames, mean):
    """Values of _kinetic_columns [layers, columns]."""
    d, species = run.dimension, len(run.species)
    content_of = _content(run)
    mean_at = (_profile if mean == "profile" else _mean_of_layers)(run, layers, frames)
    sums, flow = np.zeros((0, species, 4 + d * d)), np.zeros((0, 1, 6))
    for block in run._blocks(frames):
        most = layers.counts(block).max(initial=1)
        sums, flow = _grow(sums, most), _grow(flow, most)
        grain, y, motion = _moving(run, block)
        n, m = layers.at(y), run.mass[grain]
        above = y - layers.bottom(n)
        _book(flow, n, [m, m * above, m * above**2, m * motion[0], m * motion[1], m * motion[0] * above])
        excess = motion - mean_at(y)
        inertia = (0.5 if d == 2 else 0.4) * m * run.radius[grain]**2
        products = [m * excess[a] * excess[b] for a in range(d) for b in range(d)]
        rotation = inertia * (excess[d:]**2).sum(axis=0)
        _book(sums, n * species + run.kind[grain], [m, np.ones_like(m), rotation, content_of[grain], *products])
    sums /= len(frames)
    mass, grains, rotation, content, kinetic = *(sums[..., k] for k in range(4)), sums[..., 4:]
    return np.concatenate([mass, _mean_flow(flow[:, 0], layers.h), kinetic.reshape(len(sums), -1), rotation, grains]
                          + ([] if _has_one_density(run) else [content]), axis=1)


def _mean_flow(flow, h):
    """u, v (m/s) and du/dy (1/s), the slope of the least-squares line u(y), by layer; NaN without enough grains."""
    mass, my, myy, mu, mv, muy = flow.T
    with np.errstate(invalid="ignore", divide="ignore"):
        y, u = my / mass, mu / mass
        variance, covariance = myy / mass - y * y, muy / mass - y * u
        slope = np.where(variance > 1e-12 * h * h, covariance / variance, np.nan)
        return np.column_stack([u, mv / mass, slope])


def _mean_motion(run, layers, frames):
    """Mass-weighted means of height, velocity and spin, by layer; NaN without grains."""
    sums = np.zeros((0, 1, 2 + (3 if run.dimension == 2 else 6)))
    for block in run._blocks(frames):
        sums = _grow(sums, layers.counts(block).max(initial=1))
        grain, y, motion = _moving(run, block)
        m = run.mass[grain]
        _book(sums, layers.at(y), [m, m * y, *(m * motion)])
    with np.errstate(invalid="ignore", divide="ignore"):
        return sums[:, 0, 1:] / sums[:, 0, :1]


def _mean_of_layers(run, layers, frames):
    means = _mean_motion(run, layers, frames)[:, 1:].T
    return lambda y: means[:, layers.at(y)]


def _profile(run, layers, frames):
    """Mean velocity and spin as a function of height: straight lines between the means of bins, which are at most
    half a small diameter high. Beyond the outer bins the lines are continued (analysis/frames/mean_velocity.hpp)."""
    bins = max(math.ceil(layers.h / (run.small_diameter / 2) - 1e-9), 1)
    means = _mean_motion(run, _Layers(layers.h / bins, run.length, run.width, run.path), frames)
    means = means[~np.isnan(means[:, 0])]
    heights, motion, count = means[:, 0], means[:, 1:].T, len(means)

    def at(y):
        above = np.searchsorted(heights, y, side="right")
        a = np.clip(above - 1, 0, count - 1)
        b = np.where(above == 0, min(2, count - 1), np.where(above == count, max(count - 3, 0), above))
        with np.errstate(invalid="ignore", divide="ignore"):
            part = np.where(a == b, 0.0, (y - heights[a]) / (heights[b] - heights[a]))
        return motion[:, a] + (motion[:, b] - motion[:, a]) * part

    return at


# ----------------------------------------------------------------------------------------- tables

def _run_header(run, layers, length, stride):
    """Header of a table, as grseg-stress writes it."""
    numbers = {"small_diameter": run.small_diameter, "large_diameter": run.large_diameter}
    numbers |= {f"gravity_{axis}": value for axis, value in zip("xyz", run.gravity)}
    numbers |= {"step": run.step, "length": run.length}
    if run.width is not None:
        numbers["length_z"] = run.width
    numbers |= {"layer": layers.h, "window": length, "stride": stride}
    numbers |= {key: run.parameters[key] for key in ("density", "friction", "restitution")
                if isinstance(run.parameters.get(key), float)}
    if not _has_one_density(run):
        mass, content = np.where(run.mobile, run.mass, 0), np.where(run.mobile, _content(run), 0)
        numbers["mean_density"] = mass.sum() / content.sum()
        for k, word in enumerate(_Names(run.species, run.dimension).words):
            numbers[f"density_{word}"] = mass[run.kind == k].sum() / max(content[run.kind == k].sum(), 1e-300)
    scene = {"scene": "; ".join(run.parameters["scene"].split("\n")).rstrip("; ")} if run.parameters.get("scene") else {}
    header = {"program": "grseg.py", "input": f"xxh3 {run.digest}", "bed": _bed_line(run),
              "verified": "no, grseg.py has no digests"}
    if run.dimension == 3:
        header["dimension"] = "3"
    if [one.name for one in run.species] != ["small", "large"]:
        header["species"] = ", ".join(f"{one.name} {one.diameter!r}" for one in run.species)
    return header | {key: f"{value:.17g}" for key, value in numbers.items()} | scene


class Table:
    """Sums by layer and window, one row each, means per frame. A row has begin t0 and end t1 of the window (s),
    bottom y0 and top y1 of the layer (m), the number of `frames`, V (area or volume of the layer, m^2 or m^3, voids
    included), then the columns of grseg-stress or grseg-kinetic.

    name       name of the file or run
    header     settings, text by key
    history    one line per command that led to the table
    columns    names of the columns without units; `units` has the units by name
    values     numbers [rows, columns]
    dimension, species    D and mobile Species of the run
    rule       the rule of your own for which Run.contact_sums made the column Mrule; otherwise None

    table["A_SS_yy"] is a column [rows], table.tensor("A_SS") a tensor [rows, D, D], table.to_pandas() a DataFrame.
    """

    def __init__(self, name, header, history, columns, values, sources=()):
        self.name, self.header, self.history, self.values = name, header, list(history), values
        self._sources = list(sources) or [_Source("", None, ())]  # runs from which the table was made
        self.columns = [column.split("[")[0] for column in columns]
        self.units = {column.split("[")[0]: column.partition("[")[2].rstrip("]") for column in columns}
        self._place = {column: k for k, column in enumerate(self.columns)}
        self.dimension = int(header.get("dimension", "2"))
        self.species = self._species()
        self.rule = None

    def __len__(self):
        return len(self.values)

    def __contains__(self, column):
        return column in self._place

    def __getitem__(self, column):
        if column not in self._place:
            raise Error(f"{self.name}: no column {column!r}; it has {', '.join(self.columns[6:10])} ...; grseg-stress "
                        "makes tables of contacts, grseg-kinetic tables of fluctuations")
        return self.values[:, self._place[column]]

    def tensor(self, stem):
        """A tensor [rows, D, D]; off-diagonal components that the table left out are NaN."""
        def component(a, b):
            name = f"{stem}_{a}{b}"
            return self[name] if name in self or a == b else np.full(len(self), np.nan)
        axes = "xyz"[:self.dimension]
        return np.stack([np.stack([component(a, b) for b in axes], axis=-1) for a in axes], axis=-2)

    def number(self, key):
        """The positive number `key` of the header."""
        try:
            value = float(self.header[key])
        except (KeyError, ValueError):
            value = math.nan
        if not 0 < value < math.inf:
            raise Error(f"{self.name}: the header needs a positive number '# {key}: ...'; make the table again")
        return value

    def to_pandas(self):
        """A pandas.DataFrame with the rows and columns of the table. Its `attrs` contain the header by key, all commands
        as "history", and the units of the columns as "units"."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("Table.to_pandas needs pandas, which is not installed: install Debian's python3-pandas, "
                              "or pip install pandas") from error
        frame = pandas.DataFrame(self.values, columns=self.columns, copy=True)
        frame.attrs = self.header | {"history": list(self.history), "units": dict(self.units)}
        return frame

    def _species(self):
        text = self.header.get("species")
        if text is None:
            if "small_diameter" not in self.header:
                return ()
            return Species("small", self.number("small_diameter")), Species("large", self.number("large_diameter"))
        try:
            words = [one.split() for one in text.split(",")]
            return tuple(Species(name, float(diameter)) for name, diameter in words)
        except ValueError:
            raise Error(f"{self.name}: '# species: {text}' should list names and diameters") from None


def read_table(path):
    """Reads a Table of grseg-stress, grseg-kinetic or another tool from the file `path`. The number of rows is
    compared with the last line of the file; the checksum in that line is not verified."""
    def fail(why):
        raise Error(f"{path}: {why}")
    try:
        raw = pathlib.Path(path).read_bytes()
    except OSError as error:
        fail(error.strerror)
    if raw.startswith(b"\x89HDF"):
        fail("is an HDF5 file, not a table; open a run with grseg.Run")
    try:
        lines = raw.decode().split("\n")
    except UnicodeDecodeError:
        fail("is not plain text, so it is not a table")
    if lines.pop() != "":
        fail("the last line is incomplete: the table is truncated; make it again")
    head = list(itertools.takewhile(lambda line: line.startswith("#"), lines))
    rows = lines[len(head) + 1:]
    pairs = [line[2:].partition(": ")[::2] for line in head]
    header = dict(reversed(pairs))
    if rows and rows[-1].startswith("# end: "):
        if rows.pop().split()[2] != str(len(rows)):
            fail(f"has {len(rows)} rows, but its last line states another number: it is damaged; make it again")
    elif "program" in header:
        fail("does not end with the line '# end: ...' of every table: it is truncated; make it again")
    columns = lines[len(head)].split("\t") if len(lines) > len(head) else []
    try:
        values = np.array([[float(cell) for cell in row.split("\t")] for row in rows])
        values = values.reshape(len(rows), len(columns))
    except ValueError:
        fail("has a row without a number in each column; to read a table with words, as grseg-fit makes it, use "
             "pandas.read_table(path, comment='#')")
    history = [value for key, value in pairs if key == "history"]
    return Table(str(path), header, history, columns, values, _sources_of(pairs))


# ------------------------------------------------------------------------------- tables of one run

# A run from which a table was made: its digest, its _Bed, and its history up to the making of the table.
_Source = collections.namedtuple("_Source", "input bed history")
_Bed = collections.namedtuple("_Bed", "grains varied come_and_go seed flow")
# Keys of a scene that are not compared between flows: they do not change the flow, or the composition or other lines
# of the header include their numbers.
_NO_OTHER_FLOW = {"seed", "duration", "frame-interval", "burst", "keep-deposition", "compression", "store", "small-diameter",
                  "size-ratio", "density", "friction", "restitution", "gravity", "slope", "step", "length", "phi-large", "large-grains"}
_OF_NO_EFFECT = {"duration", "frame-interval", "burst", "keep-deposition", "compression", "store", "threads", "isa",
                 "restart", "checkpoint", "output", "checkpoint-every", "strict", "overwrite", "quiet"}


def _bed_line(run):
    """The line "bed" of a table's header (formats/cli/bed.hpp)."""
    crc = zlib.crc32(run.id.astype("<i4").tobytes(), zlib.crc32(run.radius.astype("<f8").tobytes()))
    text = f"grains {len(run.radius)}, sizes {len(np.unique(run.radius))}, crc32 {crc:08x}"
    if run._come_and_go:
        text += ", come and go"
    if "seed" in run.parameters:
        text += f", seed {run.parameters['seed']:.17g}"
    scene = run.parameters.get("scene", "")
    if not scene:
        return text
    acting = "".join(line + "\n" for line in scene.splitlines() if line.split(" ")[0] not in _OF_NO_EFFECT)
    acting += "".join(_acting_options(line) for line in run.history if " --restart" in line)
    return f"{text}, flow {zlib.crc32(acting.encode()):08x}"


def _acting_options(command):
    """Options of a restart that change the motion, with their values, and the time from which they do."""
    words = re.findall(r"(?<!\S)(--([^\s=]*)\S*)(?:\s+(?!--)(\S+))?", command)
    acting = "".join(f"{option} {value} " if value else f"{option} " for option, name, value in words if name not in _OF_NO_EFFECT)
    since = command.find(" (from t = ")
    return acting and acting + (command[since:] if since >= 0 else "") + "\n"


def _parse_bed(text):
    found = re.fullmatch(r"(grains (\d+), sizes (\d+), [^,]*)(, come and go)?(?:, seed ([^,]*))?(?:, flow ([^,]*))?", text)
    if not found:
        return None
    grains, number, sizes, come_and_go, seed, flow = found.groups("")
    return _Bed(grains, 2 * int(sizes) > int(number), come_and_go != "", seed, flow)


def _sources_of(pairs):
    """The _Sources of a table, several if it was merged, from the keys and values of its header in order."""
    sources = [["", None, []]]
    for key, value in pairs:
        if key in ("history", "input") and sources[-1][0]:
            sources.append(["", None, []])
        if key == "history":
            sources[-1][2].append(value)
        elif key == "input":
            sources[-1][0] = value
        elif key == "bed":
            sources[-1][1] = _parse_bed(value)
    if len(sources) > 1 and not sources[-1][0]:
        sources.pop()
    return [_Source(name, bed, tuple(history[:-1])) for name, bed, history in sources]


_NO_KIN, _UNTOLD, _SAME_GRAINS, _ONE_BED, _SAME_MOTION = range(5)


def _seed_of(source):
    if source.bed:
        return source.bed.seed
    found = re.search(r" --seed[ =](\S+)", source.history[0]) if source.history else None
    return found[1] if found else ""


def _goes_on(a, b):
    """True if one history is the beginning of the other, or both continue a common beginning by restarts."""
    common = sum(1 for _ in itertools.takewhile(lambda pair: pair[0] == pair[1], zip(a, b)))
    ends = [common == len(one) for one in (a, b)]
    restarts = [not end and " --restart" in one[common] for end, one in zip(ends, (a, b))]
    return common > 0 and not all(ends) and all(end or restart for end, restart in zip(ends, restarts))


def _kinship(a, b):
    """Kinship of two _Sources, one of the five constants above (analysis/frames/runs_of_tables.hpp)."""
    if a.input and a.input == b.input:
        return _SAME_MOTION
    seeds = _seed_of(a), _seed_of(b)
    if a.bed and b.bed:
        if a.bed.grains == b.bed.grains:
            if all(seeds) and seeds[0] != seeds[1]:
                return _NO_KIN
            if not all(seeds):
                return _SAME_GRAINS if a.bed.varied else _UNTOLD
            return _SAME_MOTION if a.bed.flow and a.bed.flow == b.bed.flow else _ONE_BED
        if not a.bed.come_and_go and not b.bed.come_and_go:
            return _NO_KIN
    if _goes_on(a.history, b.history):
        return _ONE_BED
    return _NO_KIN if all(seeds) and seeds[0] != seeds[1] else _UNTOLD


def _overlap(a, b):
    """Begin, s, of the first window of table a that overlaps one of b by more than round-off; None if none does."""
    spans = [np.unique(np.column_stack([table["t0"], table["t1"]]), axis=0) for table in (a, b)]
    for begin, end in spans[0]:
        common = np.minimum(end, spans[1][:, 1]) - np.maximum(begin, spans[1][:, 0])
        if (common > 1e-6 * (end - begin)).any():
            return begin
    return None


def _find_runs(tables):
    """The run number of each table, and the indices of tables that may or may not share a run with another table."""
    first, untold = [], []
    for k, table in enumerate(tables):
        first.append(k)
        for earlier, other in enumerate(tables[:k]):
            kin = max(_kinship(a, b) for a in other._sources for b in table._sources)
            time = _overlap(other, table) if kin in (_SAME_GRAINS, _SAME_MOTION) else None
            if kin == _SAME_GRAINS:
                kin = _ONE_BED if time is None else _UNTOLD
            if kin == _SAME_MOTION and time is not None:
                raise Error(f"{other.name} and {table.name} both contain the time from {time:g} s of the same run; "
                            "leave one of them out")
            if kin == _UNTOLD:
                untold.append((earlier, k))
            if kin >= _ONE_BED:
                low, high = sorted((first[earlier], first[k]))
                first = [low if number == high else number for number in first]
    numbers = {number: n for n, number in enumerate(dict.fromkeys(first))}
    return [numbers[number] for number in first], sorted({k for pair in untold for k in pair
                                                          if first[pair[0]] != first[pair[1]]})


# --------------------------------------------------------------------------- partition and estimates

def _parse_rule(rule):
    """Word and number of a rule: ("power", 2.0) for "power:2"; the number is None for rules without one. For a rule of
    one's own the word is "own", and the function takes the place of the number."""
    if callable(rule):
        return "own", rule
    word, colon, text = str(rule).partition(":")
    try:
        if word in ("uniform", "power") and colon:
            number = float(text)
            if math.isfinite(number) and (word == "power" or 0 <= number <= 1):
                return word, number
        elif word in ("size", "contact-point", "half", "drop") and not colon:
            return word, 0.5 if word == "half" else None
    except ValueError:
        pass
    raise ValueError(f"{rule!r} is not a rule: size, contact-point, half, drop, uniform:P (0 to 1), power:Q or a function")


# Arguments that a function as rule may have: numbers of the two species, and numbers of a contact.
_OF_SPECIES, _OF_CONTACTS = ("d_large", "d_small"), ("r_large", "r_small", "gap", "force", "branch")


def _name_of(rule):
    return getattr(rule, "__name__", repr(rule)) if callable(rule) else rule


def _arguments(rule):
    """Names of the arguments that a rule of one's own asks for."""
    asked = inspect.signature(rule).parameters.values()
    names = [one.name for one in asked if one.name in _OF_SPECIES + _OF_CONTACTS or one.default is one.empty]
    for name in names:
        if name not in _OF_SPECIES + _OF_CONTACTS:
            raise ValueError(f"the rule {_name_of(rule)} has the argument {name!r}; grseg knows "
                             f"{', '.join(_OF_SPECIES + _OF_CONTACTS)}")
    return names


def _share_by(rule, contacts, count):
    """The larger grain's share of each of `count` contacts by a rule of one's own, whose arguments are fields of `contacts`;
    one number if the rule returns one."""
    share = np.asarray(rule(**{name: getattr(contacts, name) for name in _arguments(rule)}), float)
    if share.shape not in ((), (count,)):
        raise ValueError(f"the rule {_name_of(rule)} returns an array of shape {share.shape} for {count} contacts; it should "
                         "return one number, or one for each contact")
    if not np.isfinite(share).all():
        raise ValueError(f"the rule {_name_of(rule)} returns {share[~np.isfinite(share)][0]} for a contact; a share should be "
                         "a finite number")
    return share


def _power_share(exponent):
    """The rule power:Q as a function; Q = 1 is the rule by size."""
    return lambda r_large, r_small: 1 / (1 + (r_small / r_large)**exponent)


def _shares(power, rule):
    """Rules that need a sum over contacts of their own, as functions by the name of the sum."""
    return ({} if power is None else {"power": _power_share(power)}) | ({} if rule is None else {"rule": rule})


def _share_of_pair(table, rule, number, a, b):
    """The share of every contact between species a < b, if the rule gives all of them one share; otherwise None."""
    if not callable(number) or table.rule is number:
        return number if rule in ("half", "uniform") else None
    asked = [name for name in _arguments(number) if name in _OF_CONTACTS]
    if asked:
        raise ValueError(f"{table.name}: the rule {_name_of(number)} asks for {asked[0]} of each contact, and the table has only "
                         "sums over contacts: give the run, grseg.fit(run, rule), or make the table with contact_sums(rule=rule)")
    pair = types.SimpleNamespace(d_large=table.species[b].diameter, d_small=table.species[a].diameter)
    return float(_share_by(number, pair, 1))


def _parts_of(table, names, rule, number, a, b):
    """Parts of the sum over mixed contacts of species a < b that the larger and the smaller grains get by the rule,
    N m; both are 0 for drop."""
    of = lambda stem: table.tensor(names.pair(stem, a, b))
    if rule == "drop":
        return 0, 0
    share = _share_of_pair(table, rule, number, a, b)
    if share is not None:
        at_centres = names.pair("ML", 0, 1) + "_xx" in table  # --assign grain: each part is counted at its grain
        return share * of("ML" if at_centres else "M"), (1 - share) * of("MS" if at_centres else "M")
    if rule == "power" and float(table.header.get("power", "nan")) != number:
        raise Error(f"{table.name}: its column Mpower_* was not made with power:{number:g}; make the table with "
                    f"--partition power:{number:g}, or contact_sums(power={number:g})")
    larger = of({"size": "Msize", "contact-point": "Mcp", "power": "Mpower", "own": "Mrule"}[rule])
    return larger, of("M") - larger


def partial_stress(table, rule="size", base=None):
    """Stress of each of K species and total stress by a rule, (of_species [rows, K, D, D], total [rows, D, D]), N/m or
    Pa. sigma^nu = (A + parts of mixed contacts + part of contacts with the base)/V, with A the sum over contacts inside
    the species. The species' stresses add up to the total for every rule except drop.

    rule    rule for the larger grain's share of a mixed contact: "size", "contact-point", "half", "drop", "uniform:P",
            "power:Q" or a function of your own (`fit`); power:Q needs a table made with the same Q
    base    part of a contact with base or walls that its grain gets: "contact-point", "half" or "none"; default: as in
            the table
    """
    names, count = _Names(table.species, table.dimension), len(table.species)
    rule, number = _parse_rule(rule)
    base = base or table.header.get("base", "contact-point")
    if base not in ("contact-point", "half", "none"):
        raise ValueError(f"base = {base!r}: contact-point, half or none")
    at_centres = (names.pair("ML", 0, 1) + "_xx" in table and rule != "drop"
                  and _share_of_pair(table, rule, number, 0, 1) is not None)
    own = [table.tensor(names.halves(k) if at_centres else names.inside(k)) for k in range(count)]
    dropped = np.zeros_like(own[0])
    for a, b in _pairs(count):
        larger, smaller = _parts_of(table, names, rule, number, a, b)
        own[b] += larger
        own[a] += smaller
        if rule == "drop":
            dropped += table.tensor(names.pair("M", a, b))
    for k in range(count):
        if base == "contact-point":
            own[k] += table.tensor(names.base("A", k))
        elif base == "half":
            own[k] += 0.5 * table.tensor(names.base("F", k))
    volume = table["V"][:, None, None]
    return np.stack(own, axis=1) / volume[:, None], (sum(own) + dropped) / volume


@dataclasses.dataclass
class Fit:
    """Estimates for two species by a rule, whose name is `rule`. The segregation strength B of psi_L = phi_L (1 + B phi_S) is a mean over
    layers and frames with the weight phi_L phi_S. Names and definitions agree with grseg-fit; NaN means undefined.

    An interval is (low, high), 95 %, as in grseg-fit over the windows of one run or the runs of one flow; it is NaN
    for several flows. grseg-fit also has intervals over flows and for the fits of Staron & Phillips (2015), and warns
    if an interval is doubtful, for instance because few windows are independent; here `doubt` is about p_zero alone.
    """

    rule: str
    points: int      # number of points: layers x windows
    B: float         # sum f (psi_L - phi_L) / sum f phi_L phi_S, f: number of frames
    share: float     # share p at which uniform:p gives the same B
    p_zero: float    # share p at which uniform:p gives B = 0; the same for every rule
    dB_dp: float     # slope of B(p) at p_zero
    paper_s: float   # s of the fit sigma^S/sigma^L = s phi_S/phi_L of Staron & Phillips, as a mean of logarithms
    paper_B: float   # half the sum of 1 - s and (1 - s)/s
    paper_k: float   # k of sigma^S/sigma^L = k (phi_S/phi_L)^a, by weighted least squares of the logarithms
    paper_a: float   # a of the same fit
    B_interval: tuple
    p_zero_interval: tuple
    dB_dp_interval: tuple
    over: str        # population of the intervals: "windows" or "runs"; "" for several flows
    degrees_of_freedom: float

    @property
    def doubt(self):
        """The reason why p_zero is not determined, as grseg-fit prints it; "" if there is none. The share of a mixed
        contact lies between 0 and 1 for every rule that splits its stress."""
        low, high = self.p_zero_interval
        if high < 0 or low > 1:
            return f"p* = {self.p_zero:.3g} lies outside 0 to 1: no rule that splits mixed contacts makes B zero"
        if low < 0 or high > 1:
            return (f"the interval of p*, [{low:.3g}, {high:.3g}], reaches beyond 0 to 1, where the shares of all rules lie: "
                    "these data do not determine p*")
        return ""


def _has_annuli(table):
    return table.header.get("bins", "").startswith("radius")


def _weight_in_layers(table):
    """Mean height less the middle, and second moment about the mean, of the weight in the means of each layer [rows], in
    units of its thickness and of the square of it (analysis/fit/row_neighbours.hpp)."""
    if _has_annuli(table):
        with np.errstate(invalid="ignore", divide="ignore"):
            n = (table["y0"] + table["y1"]) / 2 / (table["y1"] - table["y0"])
            return 1 / (12 * n), 1 / 12 - 1 / (144 * n**2)
    variance = {"gauss": 1, "lucy": 2 / 21, "heaviside": 1 / 3}.get(table.header.get("assign"))
    spread = 1 / 12 + (variance * (table.number("width") / table.number("layer")) ** 2 if variance else 0)
    return np.zeros(len(table["y0"])), np.full(len(table["y0"]), spread)


class Points:
    """Points of a fit: layers and windows, selected as by grseg-fit with the same options. Methods return their
    stresses and estimates by rule.

    tables         one Table or several
    quantity       "contact" for tables of contact sums, "kinetic" for tables of kinetic sums
    component      component of the stress: "yy", or "pressure", the trace divided by D
    base           part of contacts with the base that its grain gets; default: as in the first table
    pair           names of the two species, if the tables have more
    ratio_range    range of phi_S/phi_L
    heights        range of the layers: "inside" (without 4 d_S at the base and under the surface; of annuli: without 4 d_S
                   at the wall and, off the axis, at the surface), "all", or text with units, "4dS:56dS", "0.02m:" or ":120mm"
    min_solid      least solid fraction of a layer, over the median of the run
    begin, end     range of the windows, s
    thickness      part of B that gradients inside the layers add: "removed" or "kept" (grseg-fit --thickness)

    Fields of each point [n]: x = phi_S/phi_L, phi_large, weight (frames times grains of the rarer species), number of
    frames, size_ratio d_L/d_S, table (index), row (index in that table), run (index).

    Tables of one bed, such as a run and its continuation, are one run; if two contain the same time of the run, Error
    is raised. `untold` lists names of tables that may or may not share a run with another table. `over` is the
    population of the intervals: "windows" of one run, "runs" of one flow, "" for several flows.
    """

    def __init__(self, tables, quantity="contact", component="yy", base=None, pair=None, ratio_range=(0.01, 100.0),
                 heights="inside", min_solid=0.5, begin=-math.inf, end=math.inf, thickness="removed"):
        self.tables = [tables] if isinstance(tables, Table) else list(tables)
        if not self.tables or quantity not in ("contact", "kinetic") or component not in ("yy", "pressure"):
            raise ValueError("Points needs tables, quantity contact or kinetic, component yy or pressure")
        self.quantity, self.component = quantity, component
        self.base = base or self.tables[0].header.get("base", "contact-point")
        self.pair = self._find_pair(pair)
        self._ratio_range, self._heights = ratio_range, heights
        self._min_solid = min_solid
        self._times = begin, end
        self._removed = {"removed": 1.0, "kept": 0.0}[thickness]
        runs, untold = _find_runs(self.tables)
        self.untold = [self.tables[k].name for k in untold]
        chosen = [self._select(table) for table in self.tables]
        self.table = np.repeat(np.arange(len(chosen)), [len(one["row"]) for one in chosen])
        self.run = np.array(runs)[self.table]
        for name in ("row", "phi_large", "weight", "frames", "size_ratio", "_below", "_above", "_slope"):
            setattr(self, name, np.concatenate([one[name] for one in chosen]))
        if len(self.run) == 0:
            raise Error(f"{self.tables[0].name}: no layer and window passes the filters; B needs layers that contain "
                        "both species; grseg-fit reports how many rows each filter removed")
        self.x = (1 - self.phi_large) / self.phi_large
        self._b_weight = self.frames * self.phi_large * (1 - self.phi_large)
        one_flow = self._is_one_flow([self.tables[k] for k in np.unique(self.table)])
        self.over = "" if not one_flow else "runs" if len(set(self.run)) > 1 else "windows"

    def __len__(self):
        return len(self.run)

    def stresses(self, rule="size"):
        """Stresses of the smaller species, of the larger species, and of both [n], N/m or Pa; kinetic stress is K/V."""
        small, large, total = (np.empty(len(self)) for _ in range(3))
        for number, table in enumerate(self.tables):
            own, rows = self.table == number, self.row[self.table == number]
            of_species, of_all = self._stresses_of(table, rule)
            small[own], large[own] = (of_species[rows, species] for species in self.pair)
            total[own] = of_all[rows] if len(table.species) == 2 else small[own] + large[own]
        if not np.isfinite(small + large + total).all():
            raise Error(f"{self.tables[0].name}: a stress by {_name_of(rule)} is not finite; make the table again")
        return small, large, total

    def _resolved(self, rule):
        """stresses(), where the large grains' stress [n] is without the part that gradients inside the layers add."""
        small, large, total = self.stresses(rule)
        for number, table in enumerate(self.tables):
            own = self.table == number
            of_species, of_all = self._stresses_of(table, rule)
            sums = of_all if len(table.species) == 2 else sum(of_species[:, species] for species in self.pair)
            large[own] -= self._slope[own] * (sums[self._above[own]] - sums[self._below[own]])
        return small, large, total

    def fit(self, rule="size"):
        """The Fit under a rule (`partial_stress`); for kinetic stress it is the same for every rule."""
        small, large, total = self.stresses(rule)
        paper = _fits_of_the_paper(self.x, small, large, self.weight)
        small, large, total = self._resolved(rule)
        adds_up = self.quantity == "kinetic" or rule != "drop"
        excess = self._excess(large, total)
        b = self._strength(large, total) if adds_up else math.nan
        share = zero = slope = math.nan
        of_b = of_zero = of_slope = (math.nan, math.nan), math.nan
        if adds_up:
            of_b = self._interval(b, excess, self._b_weight[total > 0].sum())
        if self.quantity == "contact" and len(self.tables[0].species) == 2:
            zero, at_zero, change = self._share_with(0)
            weight, gain = self._b_weight[np.isfinite(at_zero)].sum(), np.nansum(self.frames * change)
            slope = float(gain / weight) if gain else math.nan
            if gain:
                of_zero = self._interval(zero, at_zero, -gain)
                of_slope = self._interval(slope, change, weight)
            if adds_up:
                share = self._share_with(b)[0]
        if not adds_up:
            paper["paper_B"] = math.nan
        return Fit(_name_of(rule), len(self), b, share, zero, slope, **paper, B_interval=of_b[0], p_zero_interval=of_zero[0],
                   dB_dp_interval=of_slope[0], over=self.over, degrees_of_freedom=of_b[1])

    def _b_at(self, share):
        """B if the larger grain of every mixed contact gets this share."""
        _, large, total = self._resolved(f"uniform:{float(share)!r}")
        return self._strength(large, total)

    def b_of_p(self, shares):
        """B [n] if the larger grain of every mixed contact gets these shares [n]."""
        return np.array([self._b_at(share) for share in np.asarray(shares, float).tolist()])

    def _find_pair(self, pair):
        names = [one.name for one in self.tables[0].species]
        if pair is None:
            if len(names) != 2:
                raise ValueError(f"pair: name two of {', '.join(names)}")
            return 0, 1
        try:
            a, b = sorted(names.index(name) for name in pair)
        except ValueError:
            raise ValueError(f"pair = {pair!r}: name two of {', '.join(names)}") from None
        return a, b

    def _contents(self, table):
        """Areas, volumes or masses of the species [rows, K]."""
        names = _Names(table.species, table.dimension)
        one_density = f"mass_{names.words[0]}" not in table or names.contents[0] not in table
        if self.quantity == "kinetic" and one_density:
            return np.stack([table[f"mass_{word}"] for word in names.words], axis=1)
        return np.stack([table[name] for name in names.contents], axis=1)

    def _select(self, table):
        """Fields of the points of one table, selected as in select_fit_data() of analysis/fit/fit_data.cpp."""
        if table.header.get("bins", "layers").split(" ")[0] in ("xy", "xz", "rz"):
            raise Error(f"{table.name}: a map, whose rows are cells, not layers; use grseg-fit, or make the table without --bins")
        contents = self._contents(table)
        small, large = (contents[:, k] for k in self.pair)
        solid = contents.sum(axis=1) / table["V"]
        slack = 1e-9 * (1 + abs(table["t0"]) + abs(table["t1"]))
        in_times = (table["t0"] >= self._times[0] - slack) & (table["t1"] <= self._times[1] + slack)
        filled = in_times & (solid > 0)
        median = np.median(solid[filled]) if filled.any() else 0
        with np.errstate(invalid="ignore", divide="ignore"):
            ratio = small / large
            use = in_times & self._in_heights(table, in_times, solid, median) & (small > 0) & (large > 0) & (table["frames"] > 0)
            use &= (ratio >= self._ratio_range[0]) & (ratio <= self._ratio_range[1])
        use &= solid >= self._min_solid * median
        d_small, d_large = (table.species[k].diameter for k in self.pair)
        power = table.dimension
        rarer = np.minimum(small / d_small**power, large / d_large**power)[use]
        frames, row = table["frames"][use], np.flatnonzero(use)
        with np.errstate(invalid="ignore"):
            phi = large / (small + large)
        below, above = self._neighbours(table, (small + large > 0) & (solid >= self._min_solid * median))
        below, above = (np.where(next_row < 0, row, next_row) for next_row in (below[row], above[row]))
        mean, spread = _weight_in_layers(table)
        layers = (below != row).astype(int) + (above != row)
        distance = np.where(layers > 0, layers + mean[above] - mean[below], 1)
        slope = self._removed * spread[row] * (phi[above] - phi[below]) / distance**2
        return {"row": row, "phi_large": phi[row], "weight": frames * rarer, "frames": frames,
                "size_ratio": np.full(len(frames), d_large / d_small), "_below": below, "_above": above, "_slope": slope}

    @staticmethod
    def _neighbours(table, filled):
        """Rows of the next layers below and above in the same window [rows]; -1 where they are not `filled`."""
        t0, t1, y0, y1 = (table[name] for name in ("t0", "t1", "y0", "y1"))
        order = np.lexsort((y0, t1, t0))
        low, high = order[:-1], order[1:]
        adjacent = (t0[low] == t0[high]) & (t1[low] == t1[high]) & (np.abs(y0[high] - y1[low]) < 1e-6 * (y1 - y0)[low])
        below, above = np.full(len(t0), -1), np.full(len(t0), -1)
        below[high] = np.where(adjacent & filled[low], low, -1)
        above[low] = np.where(adjacent & filled[high], high, -1)
        return below, above

    def _in_heights(self, table, in_times, solid, median):
        """True for rows inside the range of heights [rows]."""
        y0, y1 = table["y0"], table["y1"]
        low, high = self._height_range(table, in_times, solid, median)
        slack = 1e-9 * (y1 - y0)
        return (y0 >= low - slack) & (y1 <= high + slack)

    def _height_range(self, table, in_times, solid, median):
        """The range of heights, m, as in parse_heights() of analysis/frames/layer_key.hpp, from the rows in_times [rows]."""
        sizes = table.number("small_diameter"), table.number("large_diameter")
        if self._heights == "all":
            return -math.inf, math.inf
        if self._heights != "inside":
            low, colon, high = self._heights.partition(":")
            if not colon:
                raise ValueError(f"heights = {self._heights!r}: write inside, all, or low:high, e.g. 4dS:56dS or 4dS:")
            return _metres(low, *sizes) if low else -math.inf, _metres(high, *sizes) if high else math.inf
        bottoms, layer = np.unique(table["y0"], return_inverse=True)
        weight = in_times * table["frames"]
        frames = np.bincount(layer, weight)
        with np.errstate(invalid="ignore", divide="ignore"):
            filled = np.nan_to_num(np.bincount(layer, weight * np.nan_to_num(solid)) / frames / median)
        if not (filled >= 0.5).any():
            return math.inf, -math.inf
        tops = np.zeros(len(bottoms))
        tops[layer] = table["y1"]
        base = bottoms[filled >= 0.5].min()
        if _has_annuli(table):  # annuli_inside() of analysis/fit/cells_inside.cpp
            last = np.flatnonzero(filled)[-1]
            part = min(1, filled[last] / filled[last - 1]) if last > 0 and filled[last - 1] > 0 else 1
            surface = base + 4 * sizes[0] if base > 0 else 0.0
            return surface, bottoms[last] + part * (tops - bottoms)[last] - 4 * sizes[0]
        return base + 4 * sizes[0], base + (filled * (tops - bottoms)).sum() - 4 * sizes[0]

    def _stresses_of(self, table, rule):
        """The chosen component of the stress of each species [rows, K] and of all species [rows]."""
        if self.quantity == "kinetic":
            words = _Names(table.species, table.dimension).words
            of_species = np.stack([table.tensor(f"K_{word}") for word in words], axis=1) / table["V"][:, None, None, None]
            of_all = of_species.sum(axis=1)
        else:
            of_species, of_all = partial_stress(table, rule, self.base)
        if self.component == "yy":
            return of_species[..., 1, 1], of_all[..., 1, 1]
        return (np.trace(tensor, axis1=-2, axis2=-1) / table.dimension for tensor in (of_species, of_all))

    def _strength(self, large, total):
        ok = total > 0
        phi, f = self.phi_large[ok], self.frames[ok]
        product = (f * phi * (1 - phi)).sum()
        return float((f * (large[ok] / total[ok] - phi)).sum() / product) if ok.any() else math.nan

    def _excess(self, large, total):
        """psi_L - phi_L of each point; NaN unless the total stress is positive."""
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(total > 0, large / total - self.phi_large, math.nan)

    def _share_with(self, b):
        """The share p at which B(p) = b by Newton's method, which needs one step if B is linear in p; and, at p,
        psi_L - phi_L of each point and its derivative with respect to p."""
        none, everything = self._resolved("uniform:0"), self._resolved("uniform:1")
        change = [all_to - none_to for none_to, all_to in zip(none, everything)]
        share = 0.5
        for _ in range(8):
            _, large, total = (at + share * of for at, of in zip(none, change))
            excess = self._excess(large, total)
            by_share = (change[1] - (excess + self.phi_large) * change[2]) / np.where(total > 0, total, math.nan)
            gain = np.nansum(self.frames * by_share)
            if not gain:
                return math.nan, excess, by_share
            step = (np.nansum(self.frames * excess) - b * self._b_weight[np.isfinite(excess)].sum()) / gain
            share -= step
            if abs(step) < 1e-14:
                break
        return float(share), excess, by_share

    def _is_one_flow(self, tables):
        """True if all tables agree in composition and in all recorded settings of the flow (analysis/fit/flows.cpp)."""
        def near(a, b, part):
            try:
                return a == b or abs(float(a) - float(b)) <= part * max(abs(float(a)), abs(float(b)))
            except ValueError:
                return False

        def composition(table):
            content = table["frames"] @ self._contents(table)
            return content / content.sum()

        def scene(table):
            pairs = (word.split(" = ", 1) for word in table.header.get("scene", "").split("; ") if " = " in word)
            return {key: value for key, value in pairs if key not in _NO_OTHER_FLOW}

        def same_scene(a, b):
            return all(near(a[key], b[key], 1e-6) for key in a.keys() & b.keys())
        first, facts = tables[0], ("dimension", "density", "friction", "restitution", "gravity_x", "gravity_y", "gravity_z",
                                   "step", "length", "length_z")
        return all([one.name for one in table.species] == [one.name for one in first.species]
                   and all(near(one.diameter, other.diameter, 0.01) for one, other in zip(table.species, first.species))
                   and all(near(*(t.header.get(key, "unknown") for t in (table, first)), 1e-6) for key in facts)
                   and same_scene(scene(table), scene(first))
                   and (abs(composition(table) - composition(first)) <= 0.02).all() for table in tables[1:])

    @functools.cached_property
    def _observation(self):
        """Index of each point's window [n], in order of time. Windows of one run that overlap, or between which no
        grain moved, count as one (analysis/frames/runs_of_tables.cpp)."""
        spans = [(self.tables[k]["t0"][row], self.tables[k]["t1"][row], k) for k, row in zip(self.table, self.row)]
        number, count, last = {}, 0, None
        for span in sorted(set(spans)):
            if last is None or not _is_again(self.tables, last, span):
                last, count = span, count + 1
            number[span] = count - 1
        return np.array([number[span] for span in spans])

    def _noise(self, excess):
        """By window: noise of the sum of frames * excess, the part that composition does not explain; weight in B; and
        the part that composition takes."""
        ok = np.isfinite(excess)
        weight, window, count = self._b_weight[ok], self._observation[ok], self._observation.max() + 1
        fit = _CompositionFit(self.phi_large[ok], weight)
        noise = weight * fit.noise(self.frames[ok] * excess[ok] / weight)
        return np.bincount(window, noise, count), np.bincount(window, weight, count), fit.taken(window, count)

    def _interval(self, value, excess, per):
        """Interval and degrees of freedom of a number to which each point contributes frames * excess / per."""
        error, degrees, ok = math.nan, math.nan, np.isfinite(excess)
        if self.over == "windows" and ok.any():
            noise, weight, taken = self._noise(excess)
            error, degrees = _error_over_windows(noise / per, weight, taken)
        elif self.over == "runs":
            parts = np.bincount(self.run[ok], (self.frames * excess)[ok]) / per
            error, degrees = _error_over_runs(parts, np.bincount(self.run[ok], self._b_weight[ok]))
        reach = _student(degrees) * error if degrees >= 0.5 else math.nan
        return (value - reach, value + reach), degrees


def fit(source, rule="size", layer=None, window=None, stride=None, begin=None, end=None, **selection):
    """The Fit by a rule to a run, to a table of contact sums, or to a list of both.

        grseg.fit(run, "size", window=2.5, begin=10)
        grseg.fit(run, lambda r_large, r_small: r_large**2 / (r_large**2 + r_small**2))
        grseg.fit(grseg.read_table("sums.tsv"), lambda d_large, d_small: d_large / (d_large + d_small))

    source       Run, Table, or a list of these
    rule         name of a rule, as for `partial_stress`, or a function that returns the share of the stress of a mixed
                 contact that its larger grain gets. The smaller grain gets the rest
    layer, window, stride    for runs, as for `Run.contact_sums`: layer is text with a unit, or a number in m; window is in s
    begin, end   times, s, between which windows are used
    selection    other arguments of `Points`: component, heights, ...

    A function has some of these arguments, under these names. They are arrays over the mixed contacts of a few frames; a
    function returns a number for each, or one number for all. "Larger" is the grain of the larger species.

    r_large, r_small [n]     radii of the two grains, m
    d_large, d_small [n]     nominal diameters of their species, m
    gap [n]                  distance of the two surfaces, m; negative if they overlap
    force [n, D]             force on the larger grain from the smaller one, N
    branch [n, D]            centre of the larger grain minus that of the smaller one, nearest image, m

    A share may lie outside 0 to 1, but has to be finite. A table has no contacts, only sums over them: it needs a function of
    d_large and d_small alone, numbers then, or to be made by `Run.contact_sums` with the same rule.
    """
    of_sums = {name: value for name, value in (("layer", layer), ("window", window), ("stride", stride)) if value is not None}
    tables = []
    for one in source if isinstance(source, (list, tuple)) else [source]:
        if isinstance(one, Run):
            one = one.contact_sums(begin=begin, end=end, rule=rule, **of_sums)
        elif not isinstance(one, Table):
            raise ValueError(f"fit: {one!r} is neither a Run nor a Table; open it with grseg.Run or grseg.read_table")
        elif of_sums:
            raise ValueError(f"{next(iter(of_sums))}: {one.name} is a table, which has its layers and windows; leave it out")
        tables.append(one)
    times = {name: value for name, value in (("begin", begin), ("end", end)) if value is not None}
    return Points(tables, **times, **selection).fit(rule)


def verdict(tables, *options):
    """Verdict and doubts on the flow of tables, two lists of sentences: if it flows, since when it is steady, if B
    changes, and how long a run gives B +- 0.01. They come from grseg-fit, which must be installed.

        sentences, doubts = grseg.verdict("stress.tsv", "--begin", "5")

    tables     path of a table of grseg-stress or grseg-kinetic, or a list of paths
    options    options of grseg-fit, each word by itself
    """
    paths = [tables] if isinstance(tables, (str, os.PathLike)) else tables
    try:
        run = subprocess.run(["grseg-fit", *map(os.fspath, paths), *map(str, options), "--json", "--quiet"],
                             capture_output=True, text=True)
    except FileNotFoundError:
        raise Error("grseg-fit: not found; install the programs of grseg, or add their folder to PATH") from None
    if run.returncode:
        raise Error(run.stderr.strip())
    result = json.loads(run.stdout)
    return result["verdict"], result["doubts"]


# -------------------------------------------------------------------------------------- intervals

def _is_again(tables, last, window):
    """True if `window` (t0, t1, table) overlaps the earlier window `last`, or if no grain moved in between: areas or
    volumes and stresses agree to a millionth (analysis/frames/runs_of_tables.cpp)."""
    if min(last[1], window[1]) - max(last[0], window[0]) > 1e-6 * min(last[1] - last[0], window[1] - window[0]):
        return True
    a, b = (tables[k] for _, _, k in (last, window))
    rows = [t.values[(t["t0"] == t0) & (t["t1"] == t1)] for t, (t0, t1, _) in ((a, last), (b, window))]
    if len(rows[0]) != len(rows[1]):
        return False
    columns = {unit: [name for name in a.columns if name in b and name != "V" and a.units[name] == unit]
               for unit in ("N m", "m^2", "m^3")}
    for names in filter(None, columns.values()):
        x, y = (own[:, [t._place[name] for name in names]] for t, own in zip((a, b), rows))
        largest = np.fmax.reduce(np.fmax(abs(x), abs(y)), axis=1)
        if (np.fmax.reduce(abs(x - y), axis=1) > 1e-6 * largest).any():
            return False
    return any(columns.values())


class _CompositionFit:
    """The weighted fit a + b ln(phi_S/phi_L) + c phi_L (analysis/statistics/composition_fit.hpp)."""

    def __init__(self, phi, weight):
        self.weight, self.strength = weight, min(max((len(phi) - 10) / 20, 0), 1)
        terms = []
        for term in (np.log((1 - phi) / phi), phi):
            term = term - term @ weight / weight.sum()
            for _ in range(2):
                for other in terms:
                    term = term - (weight @ (term * other)) * other
            norm = math.sqrt(weight @ term**2)
            if norm > 1e-6 * math.sqrt(weight.sum()):
                terms.append(term / norm)
        self.terms = np.array(terms).reshape(-1, len(phi)).T

    def noise(self, value):
        """`value` minus its fit."""
        rest = value - value @ self.weight / self.weight.sum()
        return rest - self.strength * self.terms @ (self.terms.T @ (self.weight * rest))

    def taken(self, window, count):
        """The part that the fit takes of a number by window."""
        sums = [np.bincount(window, self.weight * term, count) for term in self.terms.T]
        return math.sqrt(self.strength * (2 - self.strength)) * np.array(sums).reshape(-1, count).T


def _neighbours(series):
    """Correlation of neighbours, at least 0, corrected for its bias (analysis/statistics/correlated_windows.hpp)."""
    n, rest = len(series), series - series.mean()
    if n < 4 or not rest @ rest > 0:
        return 0.0
    return max(0.0, min((n * (rest[:-1] @ rest[1:]) / (rest @ rest) + 1) / (n - 3), 1 - 2 / n))


def _error_over_windows(parts, weight, taken):
    """Standard error and degrees of freedom of a sum over the windows of one run, from slow cosine waves
    (deviation_of_windows in analysis/statistics/correlated_windows.hpp)."""
    n, whole, rho = len(parts), weight.sum(), _neighbours(parts)
    if n < 2:
        return math.nan, 0
    wanted, phase = max(2, (whole**2 / (weight**2).sum())**(2 / 3) / 4), math.pi * (np.cumsum(weight) - weight / 2) / whole
    rest, left, of_left, squares, kept = parts - parts.sum() / whole * weight, 0.0, 0.0, 0.0, 0.0
    for number in range(1, n):
        wave = np.cos(number * phase)
        about = wave - weight @ wave / whole
        part = max(1e-3, 1 - ((taken.T @ about)**2).sum() / (weight @ about**2))
        count = min(1, (wanted - left) / part)
        left += count * part
        of_left += (count * part)**2
        squares += count * (rest @ wave)**2
        kept += count * part * (1 - rho)**2 / (1 - 2 * rho * math.cos(math.pi * number / n) + rho**2)
        if left >= wanted:
            break
    return math.sqrt(2 * squares / kept), left**2 / of_left


def _error_over_runs(parts, weight):
    """Standard error and degrees of freedom of a sum over independent runs (analysis/statistics/confidence.hpp)."""
    runs = weight.sum()**2 / (weight**2).sum()
    rest = parts - parts.sum() / weight.sum() * weight
    return math.sqrt(runs / (runs - 1) * (rest @ rest)) if runs > 1 else math.nan, runs - 1


@functools.lru_cache
def _student(degrees):
    """The 97.5 % quantile of Student's t: sqrt(degrees) tan(angle). The density of the angle is proportional to
    cos^(degrees - 1), and 0.475 of it lies between 0 and the quantile's angle."""
    nodes, weights = np.polynomial.legendre.leggauss(200)
    factor = math.exp(math.lgamma((degrees + 1) / 2) - math.lgamma(degrees / 2)) / math.sqrt(math.pi)
    low, high = 0.0, math.pi / 2
    for _ in range(60):
        half = (low + high) / 4
        below = factor * half * (weights * np.cos(half * (1 + nodes))**(degrees - 1)).sum()
        low, high = (2 * half, high) if below < 0.475 else (low, 2 * half)
    return math.sqrt(degrees) * math.tan(low)


def _fits_of_the_paper(x, small, large, weight):
    """Fits of Staron & Phillips (2015) to points with both stresses positive, as in estimators_of() of
    analysis/fit/estimators.cpp."""
    ok = (small > 0) & (large > 0)
    log_slope = prefactor = exponent = math.nan
    if ok.any():
        ln_x, ln_y, w = np.log(x[ok]), np.log(small[ok] / large[ok]), weight[ok] / weight[ok].sum()
        log_slope = float((w * (ln_y - ln_x)).sum())
        if len(w) > 1 and ((ln_x - ln_x[0])**2).sum() / (len(w) - 1) > 1e-12:
            dx, dy = ln_x - (w * ln_x).sum(), ln_y - (w * ln_y).sum()
            exponent = float((w * dx * dy).sum() / (w * dx * dx).sum())
            prefactor = math.exp((w * ln_y).sum() - exponent * (w * ln_x).sum())
    s = math.exp(log_slope)
    return {"paper_s": s, "paper_B": (1 - s + (1 - s) / s) / 2, "paper_k": prefactor, "paper_a": exponent}
