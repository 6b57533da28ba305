#!/usr/bin/python3
"""grseg.py compared with the tools: tables of sums and results under rules, to 1e-12 of the largest number from
which a column is computed, and intervals, to 1e-9. Then faults are put into grseg.py; each must be detected.
Usage: tools_test.py SOURCE BIN SYNTHETIC_RUN

Runs: the sample of discs; imports of spheres and of discs; three grains in a file that was closed and in one that was not; runs without
symmetries in two and three dimensions, of two and three species, in some of which grains come and go.
"""
import collections
import contextlib
import csv
import math
import os
import re
import shutil
import subprocess
import sys
import tempfile
from unittest import mock

import h5py
import numpy as np

sys.dont_write_bytecode = True
source, programs, synthetic = sys.argv[1:]
sys.path.insert(0, os.path.join(source, "analysis", "python"))
import grseg

TOLERANCE = 1e-12
RULES = ("size", "contact-point", "half", "drop", "uniform:0.7", "power:2")
compared, largest = 0, 0.0


class Difference(Exception):
    pass


def agree(what, mine, tools, scale=0.0, tolerance=TOLERANCE):
    """Compares to `tolerance` times the largest of these numbers, or times `scale` if they are differences of larger numbers."""
    global compared, largest
    mine, tools = np.asarray(mine, float), np.asarray(tools, float)
    if mine.shape != tools.shape or (np.isnan(mine) != np.isnan(tools)).any():
        raise Difference(f"{what}: {mine} and, by the tool, {tools}")
    compared += mine.size
    off, scale = (np.nanmax(np.append(np.abs(a), 0.0)) for a in (mine - tools, np.append(tools, scale)))
    if off > tolerance * scale:
        raise Difference(f"{what}: {mine} and, by the tool, {tools}: {off / scale:.2g} apart")
    if tolerance == TOLERANCE:
        largest = max(largest, off / scale if scale else 0.0)


def run_tool(tool, *arguments):
    subprocess.run([os.path.join(programs, f"grseg-{tool}"), *map(str, arguments), "--quiet", "--overwrite"], check=True,
                   stderr=subprocess.DEVNULL)


def table_of(tool, path, window, *options):
    """Table of the tool, with options as for grseg.py: {"layer": "3dS"}."""
    words = [word for name, value in window.items() for word in (f"--{name}", value)]
    run_tool(tool, path, *words, *options, "-o", f"{tool}.tsv")
    return grseg.read_table(f"{tool}.tsv")


def compare_tables(what, mine, tools, scale_of=lambda column: 0.0):
    """Compares all columns of `mine` with the tool's table, which has the same names and units."""
    for column in ("t0", "t1", "y0", "y1", "frames", "V", *mine.columns):
        if mine.units[column] != tools.units[column]:
            raise Difference(f"{what}: {column}[{mine.units[column]}], [{tools.units[column]}] by the tool")
        agree(f"{what}, {column}", mine[column], tools[column], scale_of(column))


def check_contact_sums(run, window):
    tools = table_of("stress", run.path, window, "--partition", "power:1.5")
    mine = run.contact_sums(power=1.5, **window)
    if mine.columns != tools.columns:
        raise Difference(f"{run.path}: columns {mine.columns} and, by the tool, {tools.columns}")
    largest_of = {column.rsplit("_", 1)[0]: 0.0 for column in mine.columns}
    for column in tools.columns:  # a tensor has one scale, and numbers of grains scale with the volume of the layer
        stem = column.rsplit("_", 1)[0]
        largest_of[stem] = max(largest_of[stem], abs(tools[column]).max())
    largest_of |= dict.fromkeys(("area", "volume"), tools["V"].max())
    compare_tables(run.path, mine, tools, lambda column: largest_of[column.rsplit("_", 1)[0]])
    for key in ("small_diameter", "large_diameter", "dimension", "species", "step", "length", "length_z", "layer",
                "window", "gravity_x", "gravity_y", "gravity_z", "input", "bed", "partition", "power", "base", "density",
                "friction", "restitution"):
        if mine.header.get(key, "unknown") != tools.header.get(key, "unknown"):
            raise Difference(f"{run.path}: '{key}: {mine.header.get(key)}', by the tool {tools.header.get(key)}")


def check_kinetic_sums(run, window):
    for mean in ("profile", "layer"):
        tools, mine = table_of("kinetic", run.path, window, "--mean", mean), run.kinetic_sums(mean=mean, **window)
        speed = max(abs(frame.velocity[frame.present]).max() for frame in run.frames())
        spin = max(abs(frame.angular_velocity[frame.present]).max() for frame in run.frames()) * run.radius.max()
        mass = max(abs(mine[column]).max() for column in mine.columns if column.startswith("mass"))
        # Relative to a mean flow little is left of these.
        compare_tables(f"{run.path} about the {mean}", mine, tools, lambda column: {
            "K": mass * speed**2, "Kr": mass * spin**2, "u": speed, "v": speed, "du": speed / run.small_diameter,
        }.get(column.split("_")[0], 0.0))


def check_contacts(run):
    """Compares contacts per frame of the smallest species and of the others, and all forces, for the whole bed."""
    grouped = ("--group", "S=1", "--group", "L=2,3") if len(run.species) > 2 else ()
    tools = table_of("micro", run.path, {"window": "all", "layer": "2dS"}, *grouped)
    bed = dict(zip(tools.columns, tools.values[-1]))
    ends, sums, frames = np.zeros(2), np.zeros(2), 0
    for frame in run.frames():
        contacts, there = frame.contacts, frame.present
        ends += np.bincount(np.minimum(run.kind[there], 1), frame.coordination()[there], minlength=2)
        sums += contacts.pushing.sum(), np.linalg.norm(contacts.force[contacts.pushing], axis=1).sum()
        frames += 1
    agree(f"{run.path}, contact ends", ends / frames, [bed[name] for name in ("ends_S", "ends_L")])
    pairs = [name.removeprefix("sum_f_") for name in bed if name.startswith("sum_f_")]
    agree(f"{run.path}, contacts and forces", sums / frames, [sum(bed[f"{what}_{pair}"] for pair in pairs) for what in ("n", "sum_f")])


def rows_of(path):
    """Rows of a table of grseg-fit, and its header."""
    with open(path) as file:
        lines = file.read().splitlines()
    header = dict(line[2:].split(": ", 1) for line in lines if line.startswith("# "))
    return list(csv.DictReader((line for line in lines if not line.startswith("#")), delimiter="\t")), header


def numbers_of(path):
    """{rule: {quantity: value}} of all flows together; numbers without a rule are added to every rule."""
    found = collections.defaultdict(dict)
    for row in rows_of(path)[0]:
        found[row["rule"]][row["quantity"]] = float(row["value"])  # for several flows, the rows of all flows are last
    common = found.pop("-")
    return {rule: {**common, **numbers} for rule, numbers in found.items()}


def check_fits(paths, options=None, **filters):
    """Compares every number of every rule, B(p) and p*; OPTIONS are the filters of grseg-fit."""
    tables, options = [grseg.read_table(path) for path in paths], options or []
    points = grseg.Points(tables, **filters)
    fit = [*paths, *options, "-o", "fit.tsv"]
    run_tool("fit", *fit, "--partition", ",".join(RULES), "--fit", "paper")
    for rule, numbers in numbers_of("fit.tsv").items():
        mine, what = points.fit(rule), f"fit of {paths} {options} by {rule}"
        for name, value in vars(mine).items():
            if isinstance(value, (int, float)) and name != "degrees_of_freedom":
                agree(f"{what}, {name}", value, numbers.get(name, math.nan), 1.0 if name in ("B", "paper_B") else 0.0)
    if len(tables[0].species) > 2:
        return
    run_tool("fit", *fit, "--partition", "size")  # p* is the same whichever rules are asked for
    agree(f"p* of {paths} beside one rule", points.fit().p_zero, numbers_of("fit.tsv")["size"]["p_zero"])
    run_tool("fit", *fit, "--scan", "0:1:0.125")
    rows, header = rows_of("fit.tsv")
    shares = [float(row["p"]) for row in rows]
    agree(f"B(p) of {paths}", points.b_of_p(shares), [float(row["B"]) for row in rows], 1.0)
    found = points.fit()
    agree(f"p* of {paths}", [found.p_zero, found.dB_dp], [float(header["p_zero"]), float(header["dB_dp"])])


def check_kinetic_fit(path):
    run_tool("fit", path, "--quantity", "kinetic", "--fit", "paper", "--heights", "all", "-o", "fit.tsv")
    mine = grseg.Points(grseg.read_table(path), quantity="kinetic", heights="all").fit()
    numbers = numbers_of("fit.tsv")["kinetic"]
    for name in ("points", "B", "paper_s", "paper_B", "paper_k", "paper_a"):
        agree(f"kinetic fit of {path}, {name}", vars(mine)[name], numbers[name])


def by_hand(path, name, *changes):
    """A copy of a table without the final line of a tool, with some words of its header changed."""
    with open(path) as file:
        text = "".join(line for line in file if not line.startswith(("# program: ", "# end: ")))
    for pattern, to in changes:
        text, count = re.subn(pattern, to, text)
        assert count, f"{path} has no {pattern}"
    with open(name, "w") as file:
        file.write(text)


def make_tables_for_intervals(sample):
    """Two halves of the sample as if from two runs, or two flows; windows that overlap; windows without motion."""
    run_tool("stress", sample, "--window", "0.1", "--end", "10", "-o", "short.tsv")
    run_tool("stress", sample, "--window", "1", "--begin", "10.5", "-o", "between.tsv")
    run_tool("stress", "spheres.h5", "--window", "0.4", "--layer", "2dS", "-o", "of-spheres.tsv")
    another_input = r"input: xxh3 \w+", "input: xxh3 0123456789abcdef"
    another_run = another_input, (r"crc32 \w+, seed 1,", "crc32 01234567, seed 2,")
    by_hand("first.tsv", "run-1.tsv")
    by_hand("second.tsv", "run-2.tsv", *another_run)
    by_hand("second.tsv", "flow-2.tsv", *another_run, (r"friction: \S+", "friction: 0.4"))
    by_hand("between.tsv", "twin.tsv", another_input, (r", flow \w+", ", flow 01234567"))
    by_hand("first.tsv", "still.tsv")
    with open("still.tsv", "r+") as file:
        last = [line.split("\t", 2)[2] for line in file if line.startswith("9\t")]
        file.writelines(f"{t}\t{t + 1}\t{rest}" for t in (10, 11, 12) for rest in last)


# Tables and options of grseg.py, with the expected word for what the interval of B is over.
INTERVALS = (
    (["short.tsv"], {}, "windows"),
    (["first.tsv", "second.tsv"], {"component": "pressure"}, "windows"),
    (["first.tsv"], {"end": 2}, "windows"),
    (["first.tsv"], {"end": 1}, "windows"),  # one window is too few
    (["kinetic.tsv"], {"quantity": "kinetic", "heights": "all"}, "windows"),
    (["classes.tsv"], {"pair": "c1,c3"}, "windows"),
    (["grain.tsv"], {}, "windows"),
    (["of-spheres.tsv"], {"heights": "all"}, "windows"),
    (["second.tsv", "twin.tsv"], {}, "windows"),
    (["still.tsv"], {}, "windows"),
    (["run-1.tsv", "run-2.tsv"], {}, "runs"),
    (["run-1.tsv", "flow-2.tsv"], {}, ""),
)


def intervals_of_tool():
    """The cases, each with the rows of grseg-fit."""
    cases = []
    for paths, filters, over in INTERVALS:
        words = [word for name, value in filters.items() for word in (f"--{name}", value)]
        rules = () if "quantity" in filters else ("--partition", ",".join(rule for rule in RULES if rule != "power:2"))
        run_tool("fit", *paths, *words, *rules, "-o", "fit.tsv")
        cases.append((paths, filters, over, rows_of("fit.tsv")[0]))
    return cases


def check_intervals(cases):
    for paths, filters, over, rows in cases:
        how = filters | ({"pair": filters["pair"].split(",")} if "pair" in filters else {})
        points = grseg.Points([grseg.read_table(path) for path in paths], **how)
        if points.over != over:
            raise Difference(f"{paths} {filters}: intervals are over {points.over!r}, not {over!r}")
        if not over:
            if not np.isnan(points.fit().B_interval).all():
                raise Difference(f"{paths}: there is an interval over several flows")
            continue
        for row in rows:
            name, rule = row["quantity"], "size" if row["rule"] in ("-", "kinetic") else row["rule"]
            if name not in ("B", "p_zero", "dB_dp") or row["over"] not in (over, "-"):
                continue
            mine, tools = points.fit(rule), [float(row[column]) for column in ("low", "high")]
            what = f"interval of {name} by {rule}, {paths} {filters}"
            agree(what, getattr(mine, f"{name}_interval"), tools, tolerance=1e-9)
            if name == "B" and not np.isnan(tools).any():
                agree(what, mine.degrees_of_freedom, float(row["degrees_of_freedom"]), tolerance=1e-9)


def make_imports():
    sample, inputs = (os.path.join(source, *folder) for folder in (("data", "sample"), ("tests", "inputs")))
    run_tool("import", "--format", "lammps", "--grains", f"{sample}/spheres/atoms.dump.gz", "--contacts",
             f"{sample}/spheres/contacts.dump.gz", "--units", "0.005:0.0225762:3.125e-4", "--step", 8.8e-4, "--gravity",
             "0.4383711467890774,0,-0.898794046299167", "--axes", "xz", "--boundary", 1, "-o", "spheres.h5")
    run_tool("import", "--format", "lammps", "--grains", f"{inputs}/lammps/elastic-atoms.dump.gz", "--contacts",
             f"{inputs}/lammps/elastic-contacts.dump.zst", "--step", 1e-5, "--columns",
             "i=2,j=3,dist=6,force=7,tangential=10", "--units", "si", "--gravity", 9.8, "--slope", 23, "--boundary", 3,
             "-o", "discs.h5")


def make_synthetic():
    """Makes the runs; returns their names, the most difficult last."""
    for number, words in enumerate((("2", "small,large"), ("3", "small,large"), ("2", "fine,middle,coarse"),
                                    ("3", "fine,middle,coarse", "changing"))):
        subprocess.run([synthetic, f"synthetic-{number}.h5", *words], check=True)
    return [f"synthetic-{number}.h5" for number in range(4)]


def check_run(path, *windows, unfinished=False):
    with grseg.Run(path, unfinished=unfinished) as run:
        for window in windows:
            check_contact_sums(run, window)
            check_kinetic_sums(run, window)
        check_contacts(run)


def check_hopper():
    """Grains that have left a hopper, which are in no layer."""
    run_tool("sim", os.path.join(source, "sim", "scenes", "hopper.ini"), "--dimension", 3, "--width", "8dS", "--length", "12dS",
             "--depth", "8dS", "--outlet", "5dS", "--duration", 0.5, "--frame-interval", 0.05, "-o", "hopper.h5")
    with grseg.Run("hopper.h5") as run:
        if run[-1].position[run.mobile, 1].min() > -2 * run.large_diameter:
            raise Difference("no grain has left the hopper")
        check_contact_sums(run, {"window": 0.2})
        check_kinetic_sums(run, {"window": 0.2})


def by_power(r_large, r_small, power=3):
    return r_large**power / (r_large**power + r_small**power)


# Rules of grseg as functions of one's own.
OWN_RULES = {
    "size": lambda r_large, r_small: r_large / (r_large + r_small),
    "contact-point": lambda r_large, r_small, gap: (r_large + gap / 2) / (r_large + r_small + gap),
    "half": lambda: 0.5,
    "power:3": by_power,
}


def check_own_rules(path, **how):
    """Compares every number of a fit by a function with those by the name of the rule."""
    with grseg.Run(path) as run:
        for name, rule in OWN_RULES.items():
            named, own = (vars(grseg.fit(run, choice, heights="all", **how)) for choice in (name, rule))
            for quantity in named.keys() - {"rule", "over"}:
                agree(f"{quantity} of {path} by {name} as a function", own[quantity], named[quantity], tolerance=1e-9)
        agree(f"sum of forces on larger grains of {path}", *forces_on_larger_grains(run), scale=sum_of_forces(run))


def sum_of_forces(run):
    return sum(abs(frame.contacts.force).sum() for frame in run.frames())


def forces_on_larger_grains(run):
    """Sum over mixed contacts of the force on the larger grain and of branches to it, as a rule and as frames give them."""
    by_rule, by_frames = np.zeros((2, run.dimension)), np.zeros((2, run.dimension))

    def record(force, branch):
        by_rule[:] += force.sum(axis=0), branch.sum(axis=0)
        return 0
    run.contact_sums(window="all", rule=record)
    for window in run.windows("all"):
        for number in window.frames:
            contacts = run[number].contacts
            a, b = contacts.kind_i, contacts.kind_j
            mixed = contacts.pushing & (a != b) & (b < len(run.species))
            sign = np.where(a > b, 1, -1)[mixed, None]
            by_frames += (sign * contacts.force[mixed]).sum(axis=0), (sign * contacts.branch[mixed]).sum(axis=0)
    return by_rule, by_frames


def check_all_fits(sample):
    stress = ("--partition", "power:2", "--window", "1")
    run_tool("stress", sample, *stress, "--end", "10", "-o", "first.tsv")
    run_tool("stress", sample, *stress, "--begin", "10", "-o", "second.tsv")
    check_fits(["first.tsv"])
    check_fits(["first.tsv", "second.tsv"], ["--component", "pressure", "--base-part", "half"], component="pressure",
               base="half")
    check_fits(["second.tsv"], ["--heights", "4dS:16dS", "--ratio-range", "0.2:5", "--min-solid", "0.8", "--begin", "12"],
               heights="4dS:16dS", ratio_range=(0.2, 5), min_solid=0.8, begin=12)
    check_fits(["second.tsv"], ["--heights", "all"], heights="all")
    check_fits(["first.tsv", "second.tsv"], ["--begin", "5", "--end", "15"], begin=5, end=15)
    run_tool("stress", sample, *stress, "--assign", "grain", "-o", "grain.tsv")
    check_fits(["grain.tsv"])
    run_tool("stress", sample, *stress, "--classes", "3", "-o", "classes.tsv")
    check_fits(["classes.tsv"], ["--pair", "c1,c3"], pair=("c3", "c1"))
    run_tool("stress", "synthetic-1.h5", "--partition", "power:2", "--window", "0.04", "--layer", "2dS", "-o", "spheres.tsv")
    check_fits(["spheres.tsv"], ["--heights", "all"], heights="all")
    run_tool("sim", os.path.join(source, "sim", "scenes", "drum.ini"), "--drum-diameter", "30dS", "--duration", 1, "--accuracy", "draft",
             "-o", "drum.h5")
    run_tool("stress", "drum.h5", "--bins", "radius", "--layer", "2dS", "--window", "0.25", "--partition", "power:2", "-o", "drum.tsv")
    check_fits(["drum.tsv"])
    check_kinetic_fit("kinetic.tsv")
    check_verdict("first.tsv")
    check_runs()
    make_tables_for_intervals(sample)
    cases = intervals_of_tool()
    check_intervals(cases)
    require_that_faults_show("intervals", FAULTS_OF_INTERVALS, lambda: check_intervals(cases))


def check_verdict(table):
    """Sentences on the flow are lines of grseg-fit; other files raise what it says of them."""
    with mock.patch.dict(os.environ, PATH=f"{programs}:{os.environ['PATH']}"):
        sentences, doubts = grseg.verdict(table, "--begin", 3)
        try:
            grseg.verdict("absent.tsv")
            raise Difference("grseg.verdict reads a file that does not exist")
        except grseg.Error as error:
            if "absent.tsv" not in str(error):
                raise Difference(f"grseg.verdict: {error}") from error
    run_tool("fit", table, "--begin", 3, "-o", "verdict.tsv")
    with open("verdict.tsv") as file:
        lines = [line.partition(": ")[::2] for line in file.read().splitlines() if line.startswith("# ")]
    for key, own in (("# verdict", sentences), ("# doubt", doubts)):
        if [text for name, text in lines if name == key] != own:
            raise Difference(f"grseg.verdict: {own} are not the lines '{key}' of {table}")
    if not sentences[0].startswith("flows: "):
        raise Difference(f"grseg.verdict: {sentences}")


def check_runs():
    """Groups of tables of one run, as grseg-fit finds them."""
    names = ["first.tsv", "second.tsv"]
    if set(grseg.Points([grseg.read_table(name) for name in names]).run) != {0}:
        raise Difference("first.tsv and second.tsv are of one run")
    run_tool("fit", *names, "-o", "fit.tsv")
    if rows_of("fit.tsv")[1]["runs"] != "1":
        raise Difference("grseg-fit counts first.tsv and second.tsv as two runs")


def check_beds(sample):
    """The line "bed" of a run that was restarted with these options."""
    shutil.copyfile(sample, "restarted.h5")
    for options in ("--perturb 1e-6 --threads 2", "-- 3 --perturb 1e-6", "--=x --seed-perturbation=2 4 5"):
        with h5py.File("restarted.h5", "r+") as file:
            del file["parameters/history"]
            file["parameters/history"] = np.bytes_(f"grseg-sim chute.ini\ngrseg-sim --restart run.chk {options} (from t = 2 s)\n")
        tools = table_of("stress", "restarted.h5", {"window": 5}, "--trust")
        with grseg.Run("restarted.h5") as run:
            mine = grseg._bed_line(run)
        if mine != tools.header["bed"]:
            raise Difference(f"a restart with {options}: {mine} and, by the tool, {tools.header['bed']}")


def no_shares(run, i, j, gap):
    return np.full(len(i), 0.5)


def all_contacts(contacts):
    return np.ones(len(contacts), bool)


def edges_moved(layers, y, at=grseg._Layers.at):
    return at(layers, y + 1e-4)


def transposed(block, name, contacts=grseg._Block.contacts):
    return contacts(block, {"force": "branch", "branch": "force"}.get(name, name))


def largest_first(run, read_grains=grseg.Run._read_grains):
    read_grains(run)
    run.kind = np.where(run.mobile, len(run.species) - 1 - run.kind, run.kind)


FAULTS = {
    "contact points in the middle of the branch": ("_share_of_first", no_shares),
    "edges of layers moved by a tenth of a millimetre": ("_Layers.at", edges_moved),
    "force and branch exchanged": ("_Block.contacts", transposed),
    "contacts without force counted": ("Contacts.pushing", property(all_contacts)),
    "the largest species first": ("Run._read_grains", largest_first),
    "grains not cut by layers": ("_part_below", lambda dimension, r, height: 0 * r),
    "a profile that is flat beyond its ends": ("_profile", grseg._mean_of_layers),
}


def mean_alone(fit, value):
    return value - value @ fit.weight / fit.weight.sum()


def runs_of_equal_weight(parts, weight, error=grseg._error_over_runs):
    return error(parts, np.ones_like(weight))


FAULTS_OF_INTERVALS = {
    "windows taken for independent": ("_neighbours", lambda series: 0.0),
    "drift of composition taken from the noise without a trace": (
        "_CompositionFit.taken", lambda fit, window, count: np.zeros((count, 0))),
    "drift of composition counted as noise": ("_CompositionFit.noise", mean_alone),
    "windows that overlap, or in which nothing moves, counted": ("_is_again", lambda *_: False),
    "a normal distribution in Student's place": ("_student", lambda degrees: 1.959963984540054),
    "runs of equal weight": ("_error_over_runs", runs_of_equal_weight),
    "flows taken for one": ("Points._is_one_flow", lambda *_: True),
}


def require_that_faults_show(where, faults, check):
    for what, (place, fault) in faults.items():
        with mock.patch(f"grseg.{place}", fault), contextlib.suppress(Difference):
            check()
            sys.exit(f"{where}: {what}: no number differs")


def main():
    sample = os.path.join(source, "data", "sample", "chute.h5")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        make_imports()
        runs = make_synthetic()
        try:
            for name in ("1.0", "closed"):
                check_run(os.path.join(source, "tests", "inputs", f"three-grains-{name}.h5"), {"window": 0.1},
                          unfinished=name == "1.0")
            for path in runs:
                check_run(path, {"layer": "2dS", "window": 0.04}, {"layer": "7mm", "window": 0.03, "stride": 2},
                          {"layer": "3dS", "window": "all", "begin": 0.01})
            check_run("spheres.h5", {"layer": "3dS", "window": 0.4})
            check_run("discs.h5", {"layer": "2dS", "window": 0.03})
            check_hopper()
            check_run(sample, {"window": 5, "begin": 3.3, "end": 14}, {"layer": "1.5dS", "window": 2.5, "stride": 3})
            check_all_fits(sample)
            check_own_rules(sample, window=2.5)
            check_own_rules("spheres.h5", window=0.4, layer="3dS")
            check_beds(sample)
        except (Difference, grseg.Error) as error:
            sys.exit(str(error))
        for path in runs[1:3]:
            require_that_faults_show(path, FAULTS, lambda: check_run(path, {"layer": "2dS", "window": 0.04}))
    print(f"{compared} numbers agree to {largest:.2g}, and {len(FAULTS) + len(FAULTS_OF_INTERVALS)} faults show")


main()
