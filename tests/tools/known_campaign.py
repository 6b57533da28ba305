"""A campaign of runs whose tables are known in advance, with programs whose answers are prepared.

A script replaces grseg-fit, grseg-derive and grseg-closure and prints the answer that the test has prepared for its arguments.
So the tests check the questions to these programs and the use of their answers, not the programs.
"""
import json
import math
import os
import stat
import subprocess
import sys
import tempfile
import unittest

scripts = sys.argv.pop(1)
campaign = os.path.join(scripts, "reproduce", "campaign")
sys.path.insert(0, campaign)
import tables  # noqa: E402

D, G, SLOPE, RHO = 0.005, 9.8, math.radians(23), 1.0
UNIT = RHO * G * D  # unit of stress, N/m


# Prints the first answer in answers.json whose words are all among the arguments, or writes it into the file after -o, and logs
# the arguments.
STAND_IN = """#!/usr/bin/python3
import json, os, sys
here = os.path.dirname(os.path.abspath(__file__))
words = [os.path.basename(sys.argv[0])] + sys.argv[1:]
with open(os.path.join(here, "asked"), "a") as asked:
    asked.write(json.dumps(words) + "\\n")
for wanted, table in json.load(open(os.path.join(here, "answers.json"))):
    if all(any(each == word or each.endswith(word) for each in words) for word in wanted):
        out = open(words[words.index("-o") + 1], "w") if "-o" in words else sys.stdout
        out.write(table)
        break
else:
    sys.exit("no answer to " + " ".join(words))
"""
NAN = float("nan")


def fitted(rule="size", freedom=NAN, **numbers):
    """Rows of grseg-fit from {quantity: value or (value, low, high)}; B_windows is B with its interval over windows."""
    rows = []
    for name, number in numbers.items():
        quantity, _, over = name.partition("_") if name.startswith("B_") and name != "B_minus_size" else (name, "", "runs")
        value, low, high = number if isinstance(number, tuple) else (number, NAN, NAN)
        rows.append({"rule": rule, "flow": "one", "pair": "small+large", "quantity": quantity, "over": over.replace("_", "-"),
                     "value": value, "low": low, "high": high, "degrees_of_freedom": freedom})
    return rows


def text_of(rows, head=()):
    names = list(rows[0])
    cell = lambda value: value if isinstance(value, str) else f"{value:.17g}"
    lines = [f"# {key}: {value}" for key, value in head] + ["\t".join(names)]
    return "\n".join(lines + ["\t".join(cell(row[name]) for name in names) for row in rows]) + "\n"


HEAD = (("small_diameter", D), ("large_diameter", 2 * D), ("gravity_x", G * math.sin(SLOPE)),
        ("gravity_y", -G * math.cos(SLOPE)), ("length", 70 * D), ("step", 2.5e-4), ("window", 1))


class Campaign:
    """A folder of finished runs, and a folder of programs with prepared answers."""

    def __init__(self, folder):
        self.tables, self.bin = os.path.join(folder, "tables"), os.path.join(folder, "bin")
        os.makedirs(self.tables)
        os.makedirs(self.bin)
        self.folder, self.answers = folder, []
        for name in ("grseg-fit", "grseg-derive", "grseg-closure"):
            path = os.path.join(self.bin, name)
            with open(path, "w") as program:
                program.write(STAND_IN)
            os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)

    def run(self, name, **quantities):
        """Makes a finished run with these tables, each a list of rows."""
        folder = os.path.join(self.tables, name)
        os.makedirs(folder)
        for quantity, rows in {**quantities, "checksums": None}.items():
            path = os.path.join(folder, quantity if rows is None else quantity.replace("_", "-") + ".tsv")
            with open(path, "w") as table:
                table.write("" if rows is None else text_of(rows, HEAD))

    def answer(self, *words, rows, head=()):
        self.answers.append([list(words), text_of(rows, head)])

    def made_by(self, script, *words, table=None):
        """Rows of the table that the script makes from these answers; if it makes a folder, `table` names the table in it."""
        with open(os.path.join(self.bin, "answers.json"), "w") as file:
            json.dump(self.answers, file)
        made = os.path.join(self.folder, "made.tsv")
        done = subprocess.run(["/usr/bin/python3", "-B", campaign, script, self.tables,
                               *words, "-o", made, "--bin", self.bin], capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(done.stderr)
        return tables.read(os.path.join(made, table) if table else made)[1]

    def asked(self):
        with open(os.path.join(self.bin, "asked")) as file:
            return [json.loads(line) for line in file]


class Pipeline(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.campaign = Campaign(self.temporary.name)

    def tearDown(self):
        self.temporary.cleanup()
