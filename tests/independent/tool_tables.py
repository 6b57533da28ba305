"""Tables of the tools, and the names of their columns."""
import functools
import itertools
import subprocess
import sys

import numpy as np


@functools.lru_cache(maxsize=None)
def table(tool, path, options):
    """Rows of a tool's table as dictionaries, by window."""
    return rows_of(subprocess.run([tool, path, "--quiet", *options], check=True, capture_output=True,
                                  text=True).stdout, tool)


def rows_of(text, tool):
    """Rows of a table, by window."""
    end = text.splitlines()[-1]
    lines = [line.split("\t") for line in text.splitlines() if not line.startswith("# ")]
    if not end.startswith(f"# end: {len(lines) - 1} rows, xxh3 "):
        sys.exit(f"{tool}: the table ends with '{end}', and {len(lines) - 1} rows were read")
    names = [name.split("[")[0] for name in lines[0]]
    windows = {}
    for line in lines[1:]:
        row = dict(zip(names, map(float, line)))
        windows.setdefault(row["t0"], []).append(row)
    return [rows for _, rows in sorted(windows.items())]


class Columns:
    """Names of species in columns: letters for small and large grains, full names for all others."""

    def __init__(self, run):
        self.axes = "xyz"[:run.dimension]
        self.two = len(run.names) == 2
        self.names = ["S", "L"] if self.two else run.names
        self.content = "area" if run.dimension == 2 else "volume"

    def tensor(self, row, name):
        return np.array([[row[f"{name}_{a}{b}"] for b in self.axes] for a in self.axes])

    def sum(self, key):
        """Name of the column of a sum over contacts: ("A", 0), ("Msize", 0, 1), ("F_b", 1)."""
        kind, *species = key
        names = [self.names[s] for s in species]
        if kind in ("A_b", "F_b"):
            return f"{kind[0]}_{names[0]}b" if self.two else f"{kind[0]}_{names[0]}+b"
        if self.two:
            return {"A": f"A_{names[0] * 2}", "H": f"H{names[0] * 2}"}.get(kind, kind)
        return f"{kind}_{'+'.join(names)}"

    def pair(self, *species):
        """Name of a pair in grseg-micro; one species means a contact with the base if `base`."""
        names = [self.names[s] for s in species]
        if not self.two:
            return names[0] if len(set(species)) == 1 else "+".join(names)
        return names[0] * 2 if len(set(species)) == 1 else "LS"

    def with_base(self, species):
        return f"{self.names[species]}{'b' if self.two else '+b'}"

    def pairs_of(self, species):
        """All pairs to which a species belongs."""
        others = [self.pair(*sorted((species, s))) for s in range(len(self.names))]
        return others + [self.with_base(species)]


def keys(run, assignment):
    """Keys of all sums in a table."""
    species = range(run.species_count)
    single = ["A", "A_b", "F_b"] + ["H"] * (assignment == "grain")
    mixed = ["M", "Msize", "Mcp", "Mpower"] + ["ML", "MS"] * (assignment == "grain")
    return [(kind, s) for kind in single for s in species] + [
        (kind, a, b) for kind in mixed for a, b in itertools.combinations(species, 2)]
