"""Layer-by-layer means of stresses over windows, from one flow's tables of grseg-stress and grseg-kinetic."""
import math

import tables
from tables import shared

CONTACTS = ("A_SS", "A_LL", "M", "A_Sb", "A_Lb")


def contact(row, component):
    """Sum of force (x) branch over all contacts of the layer, J."""
    return sum(row[f"{part}_{component}"] for part in CONTACTS)


def kinetic(row, component, about="profile"):
    """The same for m dv (x) dv, about the profile of the mean velocity or the mean of the layer."""
    names = [f"K_{species}_{component}" for species in "SL"]
    if about == "layer":
        names += [f"layer_bias_{species}_{component}" for species in "SL"]
    return sum(row[name] for name in names)


def half_trace(tensor, *words):
    return lambda row: (tensor(row, "xx", *words) + tensor(row, "yy", *words)) / 2


def area(row):
    return row["area_S"] + row["area_L"]


def ratio(rows, above, below):
    """Ratio of two sums over the rows, and its standard error."""
    return shared.ratio([above(row) for row in rows], [below(row) for row in rows])


def last_third(path):
    """When the last third of a table's time begins, s."""
    return max(row["t1"] for row in tables.read(path)[1]) * 2 / 3


class Profile:
    """Layers of all windows between begin and end, of one flow's tables."""

    def __init__(self, stress, kinetic_tables=(), begin=-math.inf, end=math.inf):
        self.header, self.layers = None, {}
        for k, path in enumerate(stress):
            head, rows = tables.read(path)
            self.header = self.header or head
            moving = tables.read(kinetic_tables[k])[1] if kinetic_tables else []
            at = {(row["t0"], row["y0"]): row for row in moving}
            for row in rows:
                if row["t0"] >= begin - 1e-9 and row["t1"] <= end + 1e-9:
                    both = {**at.get((row["t0"], row["y0"]), {}), **row}
                    self.layers.setdefault(round(row["y0"], 9), []).append(both)
        if not self.layers:
            raise ValueError("no window lies between --begin and --end")
        self.with_kinetic = bool(kinetic_tables)
        self.gx, self.gy = (float(self.header[f"gravity_{axis}"]) for axis in "xy")
        self.d = float(self.header["small_diameter"])
        self.unit = math.hypot(self.gx, self.gy) * self.d  # rho g d_S, rho = 1 kg/m^2

    def height(self):
        """Of the bed: twice the mean height of the grains' area, m."""
        rows = [row for each in self.layers.values() for row in each]
        return sum(area(row) * (row["y0"] + row["y1"]) for row in rows) / sum(map(area, rows))

    def weights(self):
        """By layer, the weight of the grains above its middle, per length of the cell, N/m."""
        windows = max(map(len, self.layers.values()))
        above, found = 0, {}
        for y in sorted(self.layers, reverse=True):
            mass = sum(map(area, self.layers[y])) / windows
            found[y] = (above + mass / 2) * -self.gy / float(self.header["length"])
            above += mass
        return found

    def columns(self, y):
        """Triples of name, value and standard error of one layer, in units of rho g d_S."""
        rows, pressure, volume = self.layers[y], half_trace(contact), lambda row: row["V"]
        found = {"P": (pressure, volume), "P_solid": (pressure, area),
                 "syy": (lambda row: contact(row, "yy"), volume)}
        if self.with_kinetic:
            about_layer = half_trace(kinetic, "layer")
            found.update({"K": (half_trace(kinetic), volume), "K_solid": (half_trace(kinetic), area),
                          "K_layer": (about_layer, volume), "K_layer_solid": (about_layer, area)})
        columns = [(name, *(x / self.unit for x in ratio(rows, above, below)))
                   for name, (above, below) in found.items()]
        columns.append(("nu", *ratio(rows, area, volume)))
        columns.append(("phi_L", *ratio(rows, lambda row: row["area_L"], area)))
        if self.with_kinetic:
            columns.append(("Kyy/syy", *ratio(rows, lambda row: kinetic(row, "yy"),
                                              lambda row: contact(row, "yy"))))
        return columns

    def middle(self, y):
        """Height of a layer's middle, d_S."""
        return (y + self.layers[y][0]["y1"]) / 2 / self.d
