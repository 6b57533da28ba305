"""Tables of grseg-stress: sums by name, in two and three dimensions, of any species."""
import itertools
import os
import sys

import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import sealed_tables  # noqa: E402

BETWEEN = ("M", "Msize", "Mcp", "Mpower", "ML", "MS")


def read_table(path):
    """Lines of the header, names of the columns, and rows."""
    with open(path) as table:
        lines = sealed_tables.unsealed(table.read(), path).splitlines()
    header = [line for line in lines if line.startswith("#")]
    names, *rows = lines[len(header):]
    return header, names.split("\t"), np.array([row.split("\t") for row in rows], float)


class Sums:
    """A table of grseg-stress, made with --assign ASSIGN."""

    def __init__(self, path, assign):
        self.header, self.head, self.rows = read_table(path)
        self.names = [name.split("[")[0] for name in self.head]
        if f"# assign: {assign}" not in self.header:
            sys.exit(f"{path}: was not made with --assign {assign}")
        self.axes = "xyz" if "# dimension: 3" in self.header else "xy"
        self.two = "M_yy" in self.names
        listed = [line.removeprefix("# species: ") for line in self.header if line.startswith("# species: ")]
        self.species = ["S", "L"] if self.two else [one.rsplit(" ", 1)[0] for one in listed[0].split(", ")]

    def __getitem__(self, name):
        return self.rows[:, self.names.index(name)]

    def components(self):
        return list(itertools.product(range(len(self.axes)), repeat=2))

    def suffix(self, component):
        return "_" + "".join(self.axes[k] for k in component)

    def own(self, sum_, k):
        """The name of a sum of species k: A or H inside it, F or A with the base."""
        name = self.species[k]
        if sum_ == "H":
            return f"H{name}{name}" if self.two else f"H_{name}"
        if sum_ == "A":
            return f"A_{name}{name}" if self.two else f"A_{name}"
        return f"{sum_[0]}_{name}b" if self.two else f"{sum_[0]}_{name}+b"

    def pair(self, sum_, a, b):
        return sum_ if self.two else f"{sum_}_{self.species[a]}+{self.species[b]}"

    def pairs(self, k):
        """Pairs of species k and another: (a, b), a smaller."""
        return [(min(k, other), max(k, other)) for other in range(len(self.species)) if other != k]

    def by_contact_point(self, k, component):
        """The stress of species k, N m, by contact-point, also with the base."""
        suffix = self.suffix(component)
        total = self[self.own("A", k) + suffix] + self[self.own("A base", k) + suffix]
        for a, b in self.pairs(k):
            of_larger = self[self.pair("Mcp", a, b) + suffix]
            total = total + (of_larger if k == b else self[self.pair("M", a, b) + suffix] - of_larger)
        return total

    def by_half(self, k, component):
        """The stress of species k, N m, by halves at the grains, also with the base."""
        suffix = self.suffix(component)
        total = self[self.own("H", k) + suffix] + self[self.own("F base", k) + suffix] / 2
        for a, b in self.pairs(k):
            total = total + self[self.pair("ML" if k == b else "MS", a, b) + suffix] / 2
        return total

    def write_with(self, stress, path):
        """stress: of each species, by component."""
        rows = self.rows.copy()
        of_pairs = {self.pair(sum_, a, b) + self.suffix(c) for sum_ in BETWEEN for c in self.components()
                    for a, b in itertools.combinations(range(len(self.species)), 2)}
        of_base = {self.own(sum_, k) + self.suffix(c) for sum_ in ("A base", "F base")
                   for k in range(len(self.species)) for c in self.components()}
        for column, name in enumerate(self.names):
            if name in of_pairs or name in of_base:
                rows[:, column] = 0
        for k, by_component in enumerate(stress):
            for component, values in by_component.items():
                for sum_, either in itertools.product("AH", {component, component[::-1]}):
                    rows[:, self.names.index(self.own(sum_, k) + self.suffix(either))] = values
        lines = [*self.header, "\t".join(self.head),
                 *("\t".join(f"{value:.17g}" for value in row) for row in rows)]
        with open(path, "w") as out:
            out.write(sealed_tables.sealed("".join(line + "\n" for line in lines)))
