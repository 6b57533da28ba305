"""The campaign's runs and the tables of grseg, as read by the scripts of this folder."""
import glob
import math
import os
import re
import statistics
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
import fit_numbers  # noqa: E402
import sealed_tables  # noqa: E402

# Name of a run: phi0.30-s23-seed1, phi0.45-s23-e0.5-seed2. Its tables are NAME/QUANTITY.tsv.
NAME = re.compile(r"phi(?P<phi>[\d.]+)-s(?P<slope>[\d.]+)(?:-(?P<variant>.+?))?-seed(?P<seed>\d+)$")
CONTROL = "ratio1"  # the variant with equal grains
EARLY, LATE = 60, 100  # s: the early stage ends, the late one begins
STUDENT = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 5: 2.571, 6: 2.447, 7: 2.365, 8: 2.306, 9: 2.262,
           10: 2.228, 15: 2.131, 20: 2.086, 30: 2.042, 60: 2.000, 10**9: 1.960}


def student(freedom):
    """Student's 97.5 % quantile; between the listed degrees of freedom linear in their inverse, off by 3 % at most."""
    above = min((n for n in STUDENT if n >= freedom), default=max(STUDENT))
    below = max((n for n in STUDENT if n <= freedom), default=min(STUDENT))
    if above == below:
        return STUDENT[below]
    part = (1 / freedom - 1 / above) / (1 / below - 1 / above)
    return STUDENT[above] + part * (STUDENT[below] - STUDENT[above])


def welch(*estimates):
    """Standard error and degrees of freedom of a sum or difference of independent (error, degrees of freedom)."""
    variance = sum(error**2 for error, _ in estimates)
    if not variance > 0:
        return math.sqrt(variance), 1e9
    return math.sqrt(variance), variance**2 / sum(error**4 / freedom for error, freedom in estimates)


class Run:
    def __init__(self, folder, name, match):
        self.folder, self.name = folder, name
        self.flow = name[:name.rindex("-seed")]
        self.phi, self.slope = float(match["phi"]), float(match["slope"])
        self.variant, self.seed = match["variant"] or "", int(match["seed"])

    def path(self, quantity):
        return os.path.join(self.folder, self.name, f"{quantity}.tsv")


def runs_in(folder):
    """All finished runs, in order of mixture, slope, variant and seed."""
    found = []
    for path in glob.glob(os.path.join(glob.escape(folder), "*", "checksums")):
        name = os.path.basename(os.path.dirname(path))
        match = NAME.match(name)
        if match:
            found.append(Run(folder, name, match))
    if not found:
        sys.exit(f"{folder}: no finished run, such as phi0.30-s23-seed1/checksums; "
                 "give the folder that make reproduce filled")
    return sorted(found, key=lambda run: (run.phi, run.slope, run.variant, run.seed))


def number(text):
    try:
        return float(text)
    except ValueError:
        return text


def numbers(cells):
    """The cells of a row, as numbers where they are numbers."""
    try:
        return [float(cell) for cell in cells]
    except ValueError:
        return [number(cell) for cell in cells]


def parse(text, columns=None, path="table"):
    """Lines '# key: value' (the first of each key) and rows by column name without unit, of all columns or
    those named. Exits where the table is not as it was written."""
    header, names, rows = {}, None, []
    for line in sealed_tables.unsealed(text, path).splitlines():
        if line.startswith("# "):
            key, _, value = line[2:].partition(": ")
            header.setdefault(key, value)
        elif names is None:
            names = [name.split("[")[0] for name in line.split("\t")]
            wanted = [names.index(name) for name in columns] if columns else range(len(names))
            names = [names[k] for k in wanted]
        else:
            cells = line.split("\t")
            rows.append(dict(zip(names, numbers([cells[k] for k in wanted]))))
    return header, rows


def read(path, columns=None):
    with open(path) as table:
        return parse(table.read(), columns, path)


def program(options, name, *words, columns=None):
    """The table printed by one of grseg's programs."""
    done = subprocess.run([os.path.join(options.bin, name), *map(str, words)], capture_output=True,
                          text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return parse(done.stdout, columns, name)


def fits(options, *words):
    """What grseg-fit prints, its fit of the paper too: one dictionary per rule and flow (fit_numbers.py)."""
    _, rows = program(options, "grseg-fit", *words, "--fit", "paper")
    return fit_numbers.by_rule(rows)


def mean_and_half_width(values):
    """Mean and half the width of its 95 % interval, by Student's t over independent values; both are
    nan where one of the values is."""
    n = len(values)
    mean = statistics.fmean(values)
    if n < 2 or math.isnan(mean):
        return mean, math.nan
    return mean, student(n - 1) * statistics.stdev(values) / math.sqrt(n)


def write(path, command, names, rows):
    """Writes a table, complete or not at all; cells are strings or numbers."""
    cell = lambda value: value if isinstance(value, str) else f"{value:.8g}"
    with open(path + ".part", "w") as out:
        out.write(f"# {command}\n" + "\t".join(names) + "\n")
        for row in rows:
            out.write("\t".join(cell(row[name]) for name in names) + "\n")
    os.replace(path + ".part", path)
