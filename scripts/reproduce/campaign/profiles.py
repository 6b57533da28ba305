"""Means over windows by layer, from one flow's tables of grseg-stress and grseg-kinetic, or of grseg-balance."""
import itertools
import math

import numpy as np

import tables

CONTACTS = ("A_SS", "A_LL", "M", "A_Sb", "A_Lb")


def last_third(path):
    """Begin of the last third of a table's time, s."""
    return tables.table(path)["t1"].max() * 2 / 3


def ratio(above, below, layer):
    """Ratio of two sums over the rows of each layer, and its standard error: two arrays by layer."""
    n, total = np.bincount(layer), np.bincount(layer, below)
    with np.errstate(divide="ignore", invalid="ignore"):
        value = np.where(total != 0, np.bincount(layer, above) / total, np.nan)
        left = np.bincount(layer, (above - value[layer] * below) ** 2)
        return value, np.where(n > 1, np.sqrt(left * n / (n - 1)) / abs(total), np.nan)


class Layers:
    """Rows of tables whose windows are between begin and end (s) and whose columns `present` are not nan.

    `rows`: columns by name; `layer`: index of each row's layer. Arrays by layer: bottom y (m), middle height `middle` (d_S),
    number of windows `windows`. `beside`: further tables of the same windows and layers, whose columns are added.
    """

    def __init__(self, paths, beside=(), begin=-math.inf, end=math.inf, present=()):
        parts = []
        for path, other in itertools.zip_longest(paths, beside):
            table = tables.table(path)
            use = (table["t0"] >= begin - 1e-9) & (table["t1"] <= end + 1e-9)
            use &= ~np.isnan(sum((table[name] for name in present), np.zeros(len(table))))
            columns = {name: table[name][use] for name in table.columns}
            if other:
                more = tables.table(other)
                place = {key: k for k, key in enumerate(zip(more["t0"], more["y0"]))}
                rows = [place[key] for key in zip(columns["t0"], columns["y0"])]
                columns |= {name: more[name][rows] for name in more.columns if name not in columns}
            parts.append(columns)
            self.header = table.header if len(parts) == 1 else self.header
        self.rows = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
        if not len(self.rows["t0"]):
            raise ValueError(f"no window between --begin and --end has a layer{' with both species' if present else ''}")
        self.y, first, self.layer = np.unique(self.rows["y0"].round(9), return_index=True, return_inverse=True)
        self.d = float(self.header["small_diameter"])
        self.middle = (self.y + self.rows["y1"][first]) / 2 / self.d
        self.windows = np.bincount(self.layer)

    def inside(self):
        return (self.middle > tables.INSIDE[0]) & (self.middle < tables.INSIDE[1])


class Profile(Layers):
    """Stresses over height, and the weight that they support."""

    def __init__(self, stress, kinetic=(), begin=-math.inf, end=math.inf):
        super().__init__(stress, kinetic, begin, end)
        self.with_kinetic = bool(kinetic)
        self.gx, self.gy = (float(self.header[f"gravity_{axis}"]) for axis in "xy")
        self.unit = math.hypot(self.gx, self.gy) * self.d  # rho g d_S, rho = 1 kg/m^2
        self.area = self.rows["area_S"] + self.rows["area_L"]

    def contact(self, component):
        """Sum of force (x) branch over all contacts, by row, J."""
        return sum(self.rows[f"{part}_{component}"] for part in CONTACTS)

    def kinetic(self, component, stems=("K",)):
        """Sum of m dv (x) dv by row, J. dv is relative to the profile of the mean velocity, or to the mean velocity of the layer
        if stems are K and layer_bias."""
        return sum(self.rows[f"{stem}_{species}_{component}"] for stem in stems for species in "SL")

    def height(self):
        """Height of the bed, m: twice the mean height of the grains' area."""
        return (self.area * (self.rows["y0"] + self.rows["y1"])).sum() / self.area.sum()

    def weights(self):
        """Weight of the grains above the middle of each layer, per length of the cell, N/m."""
        mass = np.bincount(self.layer, self.area) / self.windows.max()
        above = mass[::-1].cumsum()[::-1]
        return (above - mass / 2) * -self.gy / float(self.header["length"])

    def columns(self):
        """Values and standard errors by layer, for each column name; stresses are in units of rho g d_S."""
        half_trace = lambda tensor, *stems: (tensor("xx", *stems) + tensor("yy", *stems)) / 2
        area, volume, pressure = self.area, self.rows["V"], half_trace(self.contact)
        parts = {"P": (pressure, volume), "P_solid": (pressure, area), "syy": (self.contact("yy"), volume)}
        if self.with_kinetic:
            for name, stems in (("K", ("K",)), ("K_layer", ("K", "layer_bias"))):
                pressure = half_trace(self.kinetic, stems)
                parts |= {name: (pressure, volume), f"{name}_solid": (pressure, area)}
        found = {name: [x / self.unit for x in ratio(*pair, self.layer)] for name, pair in parts.items()}
        found |= {"nu": ratio(area, volume, self.layer), "phi_L": ratio(self.rows["area_L"], area, self.layer)}
        if self.with_kinetic:
            found["Kyy/syy"] = ratio(self.kinetic("yy"), self.contact("yy"), self.layer)
        return found
