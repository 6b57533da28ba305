"""Functions for all scripts: tables of grseg as text, the tools that print them, intervals, and Markdown.

Every table of grseg ends with a line '# end: 3 rows, xxh3 0123456789abcdef': the number of rows, and the hash xxh3 (64
bit) of all bytes before this line. Tables are checked against this line when they are read here, and the line is renewed
if a table is changed. analysis/python/grseg.py reads tables that include only numbers, as arrays; it checks only the
number of rows, so scripts read arrays with table().
"""
import ctypes
import ctypes.util
import math
import os
import re
import statistics
import subprocess
import sys

SCRIPTS = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(SCRIPTS)
BIN = os.path.join(ROOT, "build", "bin")
sys.path.append(os.path.join(ROOT, "analysis", "python"))  # folder of grseg.py
MARK = "# end: "
XXHASH = ctypes.util.find_library("xxhash")  # name of the library, or None
# Tables without a line "# program:", made by hand, need no line "# end:".
WITH_END = re.compile(r"^# program: ", re.MULTILINE)


# ------------------------------------------------------------------------------------------ tables

def xxh3(data):
    """The hash xxh3 of bytes, 16 hexadecimal digits, by the same library as in grseg."""
    if not XXHASH:
        sys.exit("libxxhash is missing; install it (scripts/setup does)")
    digest = ctypes.CDLL(XXHASH).XXH3_64bits
    digest.argtypes, digest.restype = (ctypes.c_char_p, ctypes.c_size_t), ctypes.c_uint64
    return f"{digest(data, len(data)):016x}"


def rows_line(text):
    """The last line without the hash."""
    rows = sum(not line.startswith("#") for line in text.split("\n")[:-1]) - 1
    return f"{MARK}{rows} rows, xxh3 "


def end_line(text):
    return f"{rows_line(text)}{xxh3(text.encode())}\n"


def sealed(text):
    """The table with its last line "# end: ..." added."""
    return text + end_line(text)


def unsealed(text, name="table"):
    """The table without its last line "# end: ...". Exits if this line is missing or does not agree with the table."""
    at = text.rfind("\n") + 1 if not text.endswith("\n") else text.rfind("\n", 0, -1) + 1
    if not text.startswith(MARK, at):
        if WITH_END.search(text):
            sys.exit(f"{name}: does not end with the line '{MARK}...'; it is truncated or damaged, make it again")
        return text
    # Computers without libxxhash, such as nodes of a cluster, check the number of rows alone.
    if not text.startswith(end_line(text[:at]) if XXHASH else rows_line(text[:at]), at):
        sys.exit(f"{name}: does not agree with its last line, '{text[at:].strip()}'; it is damaged, make it again")
    return text[:at]


def changed(text, pattern, to):
    """The table with `to` in place of the pattern, and with a new line "# end: ..."; unchanged without libxxhash."""
    body = unsealed(text)
    new = re.sub(pattern, to, body)
    return text if new == body or not XXHASH else sealed(new)


def split(text, path="table"):
    """Header lines, names of the columns with units, and rows of words. Exits if the table is not as it was written."""
    lines = unsealed(text, path).splitlines()
    head = sum(line.startswith("#") for line in lines)
    return lines[:head], lines[head].split("\t"), [line.split("\t") for line in lines[head + 1:]]


def lines_of(path):
    with open(path) as table:
        return split(table.read(), path)


def numbers(cells):
    """The cells of a row; cells that contain numbers are converted to float."""
    try:
        return [float(cell) for cell in cells]
    except ValueError:
        return [numbers([cell])[0] for cell in cells] if len(cells) > 1 else cells


def parse(text, path="table"):
    """Header as {key: value} (the first line '# key: value' of each key), and rows as {column name without unit: cell}."""
    head, names, rows = split(text, path)
    names = [name.split("[")[0] for name in names]
    return dict(line[2:].partition(": ")[::2] for line in reversed(head)), [dict(zip(names, numbers(row))) for row in rows]


def read(path):
    with open(path) as table:
        return parse(table.read(), path)


def table(path):
    """The grseg.Table of a file, with arrays. Exits with one sentence if the table is not as it was written."""
    import grseg  # imported here to save time, since most scripts need no arrays
    try:
        found = grseg.read_table(path)
    except grseg.Error as error:
        sys.exit(str(error))
    with open(path) as file:
        unsealed(file.read(), path)
    return found


def save(path, text):
    """Writes a file completely or not at all."""
    with open(path + ".part", "w") as out:
        out.write(text)
    os.replace(path + ".part", path)


def cell(value):
    """Text of a cell: words unchanged, numbers with eight digits."""
    return value if isinstance(value, str) else f"{value:.8g}"


def write(path, comment, names, rows):
    lines = [f"# {comment}", "\t".join(names), *("\t".join(cell(row[name]) for name in names) for row in rows)]
    save(path, "\n".join(lines) + "\n")


# ------------------------------------------------------------------------------------------- tools

def tool(folder, name, *words):
    """Output of a program of grseg. Raises RuntimeError with the program's message if it fails."""
    done = subprocess.run([os.path.join(folder, name), *map(str, words)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return done.stdout


class Numbers(dict):
    def __missing__(self, name):
        return math.nan


def by_rule(rows):
    """The numbers of grseg-fit as one dictionary per rule, flow and pair; `rows` has a row per number. Keys: rule, flow,
    pair, and NAME, NAME_low, NAME_high for every quantity. B has the interval over the population of --over; B_OVER
    (B_windows, B_flows ...) has the interval over each known population. Numbers without a rule (p_zero, dB_dp,
    Phi_L ...) are added to all rules. degrees_of_freedom are those of B. A missing number is nan."""
    found, common = {}, {}
    for row in rows:
        flow = row["flow"], row["pair"]
        own = common.setdefault(flow, Numbers()) if row["rule"] == "-" else \
            found.setdefault((row["rule"], *flow), Numbers(rule=row["rule"], flow=row["flow"], pair=row["pair"]))
        three = {end: float(row[name]) for end, name in (("", "value"), ("_low", "low"), ("_high", "high"))}
        name = row["quantity"].split("[")[0]
        if name == "B":
            own.update({f"B_{row['over'].replace('-', '_')}{end}": value for end, value in three.items()})
            if "B" not in own:
                own["degrees_of_freedom"] = float(row["degrees_of_freedom"])
        for end, value in three.items():
            own.setdefault(name + end, value)
    for (rule, *flow), own in found.items():
        own.update(common.get(tuple(flow), {}))
    return list(found.values())


def fits(folder, *words):
    """The numbers that grseg-fit prints, as by_rule() returns them."""
    return by_rule(parse(tool(folder, "grseg-fit", *words))[1])


# --------------------------------------------------------------------------------------- intervals

STUDENT = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776, 5: 2.571, 6: 2.447, 7: 2.365, 8: 2.306, 9: 2.262,
           10: 2.228, 15: 2.131, 20: 2.086, 30: 2.042, 60: 2.000, 10**9: 1.960}


def student(freedom):
    """Student's 97.5 % quantile, interpolated linearly in 1/(degrees of freedom); its error is at most 3 %."""
    above = min((n for n in STUDENT if n >= freedom), default=max(STUDENT))
    below = max((n for n in STUDENT if n <= freedom), default=min(STUDENT))
    if above == below:
        return STUDENT[below]
    part = (1 / freedom - 1 / above) / (1 / below - 1 / above)
    return STUDENT[above] + part * (STUDENT[below] - STUDENT[above])


def mean_and_half_width(values):
    """Mean of independent values, and half the width of its 95 % interval by Student's t; both are nan if one of
    the values is nan."""
    n = len(values)
    mean = statistics.fmean(values)
    if n < 2 or math.isnan(mean):
        return mean, math.nan
    return mean, student(n - 1) * statistics.stdev(values) / math.sqrt(n)


# ---------------------------------------------------------------------------------------- Markdown

def markdown(heads, rows):
    head, *lines = ("| " + " | ".join(cells) + " |" for cells in [heads, *rows])
    return "\n".join([head, "|" + "---|" * len(heads), *lines])


def rewrite(command, paths, parts, optional=()):
    """Replaces generated parts, {name: text}, of documents: the text between <!-- NAME --> and <!-- /NAME -->. Each part
    must occur once in one of the documents; parts named in `optional` may be missing."""
    texts = {}
    for path in paths:
        with open(path) as document:
            texts[path] = document.read()
    for name, part in parts.items():
        marked = re.compile(f"(<!-- {name} -->\n).*?(<!-- /{name} -->)", re.DOTALL)
        places = [path for path, text in texts.items() for _ in marked.findall(text)]
        if not places and name in optional:
            continue
        if len(places) != 1:
            sys.exit(f"{command}: one of {', '.join(paths)} must have <!-- {name} --> and <!-- /{name} --> once")
        texts[places[0]] = marked.sub(lambda match: match[1] + part + "\n" + match[2], texts[places[0]])
    for path, text in texts.items():
        save(path, text)
