#!/usr/bin/python3
"""Every example in the --help of a program runs as printed, in a folder that contains the files it names.

Usage: examples_test.py SOURCE BIN PROGRAM
"""
import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile

SOURCE, BIN, PROGRAM = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]
INPUTS = SOURCE + "/tests/inputs"
CHUTE = f"{SOURCE}/sim/scenes/chute.ini --depth 14dS --length 5dL --frame-interval 0.1 --duration 45 --quiet"
SMALL = {"depth": "4dS", "length": "4dL", "duration": "2", "frame-interval": "1", "accuracy": "draft"}
SCENE = f"sed '{'; '.join(f's/^{key} = .*/{key} = {value}/' for key, value in SMALL.items())}' {SOURCE}/sim/scenes/chute.ini"
SUMS = "grseg-stress {} --quiet -o {}"
SPLIT = """awk '/^ITEM: TIMESTEP/ {{ getline step; print "ITEM: TIMESTEP\\n" step > "{0}." step; next }} {{ print > "{0}." step }}' {0}.dump
           gzip {0}.[0-9]*"""


def columns_of(path, kept):
    """Text of a dump in tests/inputs with these columns of its contacts, numbered from 1."""
    text, rows = "", False
    for line in open(f"{INPUTS}/{path}"):
        words = line.split()
        if words[0] == "ITEM:":
            rows = words[1] == "ENTRIES"
        if rows:
            line = " ".join([*words[:2], *(f"c{k}" for k in kept)] if words[0] == "ITEM:" else [words[k - 1] for k in kept]) + "\n"
        text += line
    return text


# Files that examples name, each with the command that makes it from other files of this list, or with its text.
MADE = {
    "run.h5": f"grseg-sim {CHUTE} --phi-large 0.4 -o run.h5",
    "a.h5": f"grseg-sim {CHUTE} -o a.h5",
    "b.h5": f"grseg-sim {CHUTE} --seed 2 -o b.h5",
    "c.h5": f"grseg-sim {CHUTE} --phi-large 0.75 -o c.h5",
    "d.h5": f"grseg-sim {CHUTE} --phi-large 0.75 --seed 2 -o d.h5",
    "drum.h5": f"grseg-sim {SOURCE}/sim/scenes/drum.ini --drum-diameter 14dS --duration 4 --quiet -o drum.h5",
    "chute.ini": f"{SCENE} >chute.ini",
    "sim/scenes/chute.ini": f"mkdir -p sim/scenes; {SCENE} >sim/scenes/chute.ini",
    "run.chk": "grseg-sim chute.ini --duration 60 --checkpoint run.chk --checkpoint-every 0 --quiet -o ended.h5 & "
               "until [ -e run.chk ]; do sleep 0.1; done; kill -INT $!; ! wait $!",
    "sums.tsv": SUMS.format("run.h5", "sums.tsv"),
    "a.tsv": SUMS.format("a.h5", "a.tsv"),
    "thick.tsv": SUMS.format("a.h5", "thick.tsv") + " --layer 4dS",
    "thin.tsv": SUMS.format("a.h5", "thin.tsv") + " --layer 2dS",
    "b.tsv": SUMS.format("b.h5", "b.tsv"),
    "seed1.tsv": SUMS.format("a.h5", "seed1.tsv"),
    "seed2.tsv": SUMS.format("b.h5", "seed2.tsv"),
    "phi*/*.tsv": "mkdir phi30 phi75; " + "; ".join(
        SUMS.format(run, table) for run, table in (("a.h5", "phi30/1.tsv"), ("b.h5", "phi30/2.tsv"),
                                                   ("c.h5", "phi75/1.tsv"), ("d.h5", "phi75/2.tsv"))),
    "kinetic.tsv": "grseg-kinetic run.h5 --quiet -o kinetic.tsv",
    "micro.tsv": "grseg-micro run.h5 --quiet -o micro.tsv",
    "*.segregation.tsv": "grseg-segregation run.h5 --quiet -o run.segregation.tsv",
    "*.stress.tsv": SUMS.format("run.h5", "run.stress.tsv"),
    "atoms.dump": f"cp {INPUTS}/lammps/atoms.dump .",
    "contacts.dump": columns_of("lammps/contacts.dump", [1, 2, 3, *range(6, 14)]),
    "atoms.*.gz": SPLIT.format("atoms"),
    "contacts.*.gz": SPLIT.format("contacts"),
    "atoms_*": f"cp {INPUTS}/liggghts/atoms.dump atoms_1",
    "contacts_*": columns_of("liggghts/contacts-full35.dump", [*range(1, 7), *range(13, 19), 32]),
    "run.hdf5": f"cp {INPUTS}/siconos/discs.hdf5 run.hdf5",
}
# Archives unlike any small file in the repository: their examples may only complain that these files are missing.
MISSING = "spheres.dump", "run.restart", "run.data", "grains.csv", "grains_*.csv", "lmgc90.h5"


def examples():
    """Commands below "Examples:", without the explanations after two blanks or far to the right."""
    text = subprocess.run([f"{BIN}/{PROGRAM}", "--help"], capture_output=True, check=True, text=True).stdout
    text = text.split("\nExamples:\n")[1].split("\n\n")[0]
    lines = re.sub(r"\\\n\s*", "", text).split("\n")
    return [line.strip().split("  ")[0] for line in lines if re.match(r"  \S", line)]


def run(command, folder):
    environment = dict(os.environ, PATH=f"{BIN}:{os.environ['PATH']}")
    return subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, env=environment, capture_output=True, text=True)


def files_in(command):
    """Files that the command reads: names in MADE, except after an option that names an output."""
    words = [word.strip("'") for word in re.sub(r"(-o|--checkpoint) \S+", "", command).split()]
    return [name for name in MADE if name in words]


def make(name, folder):
    """Makes the file `name` in `folder`, and the files that it is made of."""
    if glob.glob(name, root_dir=folder):
        return
    if MADE[name].startswith("ITEM:"):
        with open(f"{folder}/{name.replace('*', '1')}", "w") as out:
            out.write(MADE[name])
        return
    for other in files_in(MADE[name]):
        if other != name:
            make(other, folder)
    done = run(MADE[name], folder)
    assert done.returncode == 0, (name, MADE[name], done.stderr)


def try_example(command, store):
    """True if the command could be tried, in a folder with all files of `store` except the command's own outputs."""
    if command.endswith(".mp4") and shutil.which("ffmpeg") is None:
        print("not tried, since ffmpeg is not installed:", command)
        return False
    outputs = re.findall(r"(?:-o|--checkpoint) (\S+)", command)
    with tempfile.TemporaryDirectory() as folder:
        for name in set(os.listdir(store)) - set(outputs):
            os.symlink(f"{store}/{name}", f"{folder}/{name}")
        done = run(command, folder)
        if any(name in command for name in MISSING):
            assert done.returncode == 2 and re.search("no (such file|file matches)", done.stderr), (command, done.stderr)
            return False
        assert done.returncode == 0, (command, done.returncode, done.stderr)
        for output in outputs:
            assert os.path.exists(os.path.join(folder, output)), (command, output)
        assert outputs or done.stdout, command
    return True


def main():
    tried = 0
    with tempfile.TemporaryDirectory() as store:
        for command in examples():
            for name in files_in(command):
                make(name, store)
            tried += try_example(command, store)
    assert tried > 1, f"{tried} examples tried"


main()
