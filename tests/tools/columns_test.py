#!/usr/bin/python3
"""Every column that a program prints is defined by its --columns, and every definition is of a column that some program
prints: of discs and spheres, two and three species, with the options that add columns.

Usage: columns_test.py SOURCE BIN
"""
import collections
import os
import re
import runpy
import subprocess
import sys
import tempfile

SOURCE, BIN = (os.path.abspath(word) for word in sys.argv[1:])
sys.path.insert(0, f"{SOURCE}/scripts")
definitions = runpy.run_path(f"{SOURCE}/scripts/columns")["definitions"]
SAMPLE = f"{SOURCE}/data/sample/chute.h5"
SPECIES = r"(?:S|L|c[123])"  # c1, c2, c3: of --classes 3
MARKS = {"{k}": SPECIES, "{j}": SPECIES, "{pair}": "(?:SS|LS|LL|Sb|Lb)", "{pairs}": "(?:SS|LS|LL|Sb|Lb|all)", "{ab}": "[xyz][xyz]",
         "{a}": "[xyz]", "{f}": "[xyzr]", "{rule}": "[a-z-]+(?::[0-9.]+)?", "{table}": r"[\w.-]+", "{x}": r"\w+", "[{unit}]": r"(?:\[[^]]*\])?",
         "{term}": "(?:kinetic_push|kinetic_spread|inertia)", "{law}": "(?:closure|trewhela|trewhela_intruder|unchanged)"}
printed = collections.defaultdict(set)  # (tool, dimension): names of columns, and of rows as "quantity NAME"


def call(tool, *words):
    done = subprocess.run([f"{BIN}/grseg-{tool}", *words], capture_output=True, text=True, check=False)
    assert done.returncode == 0 or tool == "check", (tool, words, done.stderr)
    return done.stdout


def collect(tool, dimension, *words, file=None):
    """Runs a tool and stores the names in its table; the table is also written to `file`."""
    text = call(tool, *words, "--quiet")
    if file:
        with open(file, "w", encoding="utf-8") as table:
            table.write(text)
    note(tool, dimension, text)


def note(tool, dimension, text):
    head, *rows = [line.split("\t") for line in text.splitlines() if not line.startswith("#")]
    names = printed[tool, dimension]
    if "degrees_of_freedom" in head:  # then come settings in which flows differ
        head = [*head[:head.index("degrees_of_freedom") + 1], *["{setting}"] * (head[-1] != "degrees_of_freedom")]
    names.update(head)
    if "quantity" in head:
        names.update("quantity " + row[head.index("quantity")] for row in rows)


def tabulate(run, d, *window):
    """Makes the tables of all tools: first from runs, then from other tables."""
    sums = "--assign", "grain", "--partition", "power:2"
    for classes in (), ("--classes", "3"):
        name = f"stress{len(classes)}-{d}.tsv"
        collect("stress", d, run, *window, *sums, *classes, file=name)
        collect("merge", d, name)
        collect("fit", d, name, "--heights", "all", "--fit", "paper", "--partition", "size,half")
        collect("kinetic", d, run, *window, *classes)
        collect("balance", d, run, *window, "--partition", "half,drop", *classes)
        for bins in ("xy", "xz", "rz") if d == 3 else ("xy",):
            collect("stress", d, run, *window, "--bins", bins, "--layer", "20mm", *classes)
            collect("kinetic", d, run, *window, "--bins", bins, "--layer", "20mm", "--mean", "profile-unbiased", *classes)
    collect("micro", d, run, *window, file="micro.tsv")
    collect("derive", d, "micro.tsv")
    for bins in ("xy", "xz") if d == 3 else ("xy",):
        collect("micro", d, run, *window, "--bins", bins, "--layer", "20mm")
    collect("forces", d, run, *window)
    collect("segregation", d, run, *window, file=f"segregation-{d}.tsv")
    collect("segregation", d, run, *window, "--summary")
    collect("check", d, run, "--physics", "--deep")
    collect("fit", d, f"stress0-{d}.tsv", "--heights", "all", "--scan", "0.5:0.8:0.1")
    collect("fit", d, f"stress0-{d}.tsv", "--heights", "all", "--series")


def compare_and_close():
    """Numbers that need several tables: differences, flows, closure and prediction."""
    collect("stress", 2, SAMPLE, "--window", "1", file="thick.tsv")
    collect("stress", 2, SAMPLE, "--window", "1", "--layer", "2dS", file="thin.tsv")
    collect("fit", 2, "thick.tsv", "--minus", "thin.tsv", "--heights", "all")
    collect("fit", 2, "thick.tsv", "stress0-2.tsv", "--heights", "all")
    collect("segregation", 2, SAMPLE, "--window", "1", file="sample.tsv")
    # A closure holds for one density, and a prediction is of another run.
    call("sim", f"{SOURCE}/sim/scenes/chute.ini", "--length", "8dL", "--depth", "16dS", "--duration", "2", "--accuracy", "draft",
         "--quiet", "-o", "light.h5")
    collect("segregation", 2, "light.h5", "--window", "0.5", file="light.tsv")
    collect("closure", 2, "sample.tsv", "thick.tsv", "--heights", "all", "--partition", "half", "--profiles", "profiles.tsv",
            "--predict", "light.tsv")
    with open("profiles.tsv", encoding="utf-8") as table:
        note("closure", 2, table.read())


def pattern(name):
    text = re.escape(name)
    for mark, regex in MARKS.items():
        text = text.replace(re.escape(mark), regex)
    return re.compile(text)


def names_of(definition):
    """Dimension (None: any) and name of each alternative that a definition names."""
    for part in definition.split(", "):
        dimension = int(part[0]) if part[:3] in ("2D ", "3D ") else 2 if ", 3D " in definition else None
        for name in part[3 * (part[:3] in ("2D ", "3D ")):].split(" or "):
            yield dimension, name


def faults(tool):
    """Sentences on columns without definition and definitions without column."""
    defined = [each for name, _ in definitions(f"{BIN}/grseg-{tool}")[1] for each in names_of(name)]
    # --help of grseg-check lists the checks of --physics.
    listed = re.findall(r"^  ([a-z_]+) +\S", call("check", "--help"), re.MULTILINE) if tool == "check" else []
    for (of, dimension), names in printed.items():
        for name in sorted(names) if of == tool else ():
            if not any(d in (None, dimension) and pattern(each).fullmatch(name) for d, each in defined) and name.split()[-1] not in listed:
                yield f"grseg-{tool}, {dimension}D: {name} is not defined"
    for dimension, name in defined:
        found = [n for (of, d), names in printed.items() if of == tool and dimension in (None, d) for n in names]
        if not any(map(pattern(name).fullmatch, found)):
            yield f"grseg-{tool}: {name} is defined, but never printed"


def main():
    common = "--density-ratio", "2", "--accuracy", "draft", "--frame-interval", "0.05", "--quiet", "-o"
    call("sim", f"{SOURCE}/sim/scenes/chute.ini", "--length", "8dL", "--depth", "16dS", "--duration", "2", *common, "discs.h5")
    call("sim", f"{SOURCE}/sim/scenes/drum.ini", "--dimension", "3", "--width", "6dL", "--drum-diameter", "16dS", "--duration", "0.4",
         *common, "spheres.h5")
    tabulate("discs.h5", 2, "--window", "0.5")
    tabulate("spheres.h5", 3, "--window", "0.1")
    compare_and_close()
    found = [fault for tool in sorted({tool for tool, _ in printed}) for fault in faults(tool)]
    print("\n".join([*found, f"{sum(map(len, printed.values()))} columns, {len(found)} faults"]))
    sys.exit(1 if found else 0)


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    main()
