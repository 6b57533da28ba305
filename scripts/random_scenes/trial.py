"""Runs a random scene and checks the invariants of exact.py and physical.py."""
import collections
import dataclasses
import os
import re
import shlex
import signal
import subprocess
import sys
import tempfile

import h5py

from random_scenes import exact, physical
from random_scenes.scenes import multiple, random_scene
from random_scenes.trajectory import Trajectory

LONGEST = 600  # most processor time of one program, s; nearly all take less than 1 s
OUTCOMES = {"held": "every invariant is satisfied", "reported": "the tolerance was missed, as exit code 4 reports",
            "doubted": "the summary has a line `doubt`", "stopped": "exit code 1 and one sentence",
            "refused": "exit code 2 and one sentence", "failed": "an invariant is violated without a warning, or a program failed"}
# Datasets that must have the same bytes.
COMPARED = ("particles/grains/position/value", "particles/grains/image/value", "particles/grains/velocity/value",
            "particles/grains/angular_velocity/value", "particles/grains/force/value")
OF_CONTACTS = ("i", "j", "force", "branch", "gap")


@dataclasses.dataclass
class Trial:
    number: int
    scene: object
    commands: list = dataclasses.field(default_factory=list)
    outcome: str = "held"
    sentence: str = ""
    broken: list = dataclasses.field(default_factory=list)  # findings (exact.py) above their bounds
    near: list = dataclasses.field(default_factory=list)  # all findings

    def fail(self, name, measured, bound, place=""):
        self.outcome = "failed"
        self.broken.append(exact.Finding(name, measured, bound, place))


class Ended(Exception):
    """Raised if the scene was refused or stopped, so that nothing is left to run."""


class Simulator:
    """Runs grseg-sim in the folder with one scene's files."""

    def __init__(self, program, folder, trial):
        self.program, self.folder, self.trial = program, folder, trial
        self.warned = False

    def run(self, arguments, output):
        """Runs grseg-sim; returns True if the run, or an earlier one of the scene, warns that it may be wrong."""
        words = [*arguments, "--strict", "-o", output]
        self.trial.commands.append(shlex.join(["grseg-sim", *words]))
        done = subprocess.run(["prlimit", f"--cpu={LONGEST}:{LONGEST + 10}", self.program, *words], cwd=self.folder, check=False,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if abs(done.returncode) % 128 == signal.SIGXCPU:
            self.trial.fail("time", f"above {LONGEST} s", LONGEST)
            raise Ended
        self.judge(done, output)
        missed, doubted = done.returncode == 4, bool(re.search(r"^  doubt ", done.stderr, re.MULTILINE))
        if missed and self.trial.outcome in ("held", "doubted"):
            self.trial.outcome = "reported"
        elif doubted and self.trial.outcome == "held":
            self.trial.outcome = "doubted"
        self.warned = self.warned or missed or doubted
        return self.warned

    def judge(self, done, output):
        """Checks that a run which did not finish ends with one sentence and leaves no file under its final name."""
        trial, code = self.trial, done.returncode
        there, part = (os.path.exists(f"{self.folder}/{name}") for name in (output, output + ".part"))
        # Sentences of the program, except its estimate "N grains, ..." and "continues CHECKPOINT from ...".
        said = [line for line in done.stderr.splitlines() if re.match(r"grseg-sim: (?!\d+ grains, |continues )", line)]
        if code in (0, 4):
            if not there or part:
                trial.fail("files at the end", f"{output}: {there}, {output}.part: {part}", "the trajectory alone")
                raise Ended
            return
        lines = [line for line in done.stderr.splitlines() if line.strip() and "\r" not in line]
        if code not in (1, 2):
            trial.fail("exit code", code, "0, 1, 2 or 4", (lines or [""])[-1])
        elif len(said) != 1 or there or (part and code == 2):
            trial.fail("one sentence and no file", f"{len(said)} sentences, {output}: {there}, {output}.part: {part}", "1 and none")
        if trial.outcome != "failed":
            trial.outcome = "stopped" if code == 1 else "refused"
        trial.sentence = said[-1].removeprefix("grseg-sim: ") if said else done.stderr[-200:]
        raise Ended

    def check(self, name, excused):
        """Checks the invariants of a run. A warning excuses some of physical.py, none of exact.py."""
        run = Trajectory(f"{self.folder}/{name}")
        findings = list(exact.all_of(run))
        if all(f.measured <= f.bound for f in findings):
            findings += physical.all_of(run, excused)
        self.trial.near += findings
        for finding in findings:
            if not finding.measured <= finding.bound:
                self.trial.fail(*finding[:3], f"{name}, {finding.place}")


def options(keys):
    return [word for key, value in keys.items() for word in ([f"--{key}"] if value is None else [f"--{key}", value])]


def same_bytes(trial, folder, part, whole, first):
    """Checks that the frames of `part` equal the frames of `whole` from number `first` on."""
    with h5py.File(f"{folder}/{part}") as a, h5py.File(f"{folder}/{whole}") as b:
        count = len(a[COMPARED[0]])
        different = [name for name in COMPARED if a[name][()].tobytes() != b[name][first:first + count].tobytes()]
        begin, end = (int(b["grseg/contacts/offset"][k]) for k in (first, first + count))
        for name in OF_CONTACTS:
            path = f"grseg/contacts/{name}"
            if a[path][:end - begin].tobytes() != b[path][begin:end].tobytes():
                different.append(path)
    if different:
        trial.fail("same bytes", f"{part} and {whole} differ in {len(different)} datasets", 0, different[0])


def simulate(simulator, scene):
    """Makes all runs of a scene and checks them. No scene file is needed, since every key is an option."""
    half = scene.frames // 2
    halved = dict(scene.keys) | {"duration": multiple(scene.interval, half)}
    to_half = ["/dev/null", *options(halved), "--checkpoint", "half.chk"]
    if scene.way == "changed":
        simulator.check("half.h5", simulator.run(to_half, "half.h5"))
        rest = ["--restart", "half.chk", "--duration", scene.keys["duration"], *options(scene.changes)]
        simulator.check("rest.h5", simulator.run(rest, "rest.h5"))
        return
    simulator.check("run.h5", simulator.run(["/dev/null", *options(scene.keys)], "run.h5"))
    if scene.way == "restart":
        simulator.run(to_half, "half.h5")
        simulator.run(["--restart", "half.chk", "--duration", scene.keys["duration"]], "rest.h5")
        with h5py.File(f"{simulator.folder}/half.h5") as file:
            frames = len(file["particles/grains/position/step"])
        same_bytes(simulator.trial, simulator.folder, "half.h5", "run.h5", 0)
        same_bytes(simulator.trial, simulator.folder, "rest.h5", "run.h5", frames)
    if scene.way == "twin":
        for index, words in enumerate(scene.twin):
            simulator.run(["/dev/null", *options(scene.keys), *words], f"twin{index}.h5")
            same_bytes(simulator.trial, simulator.folder, f"twin{index}.h5", "run.h5", 0)


def try_scene(seed, number, dimension, program, keep=None):
    trial = Trial(number, random_scene(seed, number, dimension))
    with tempfile.TemporaryDirectory(prefix="grseg-") as folder:
        if keep:
            folder = f"{keep}/{number}"
            os.makedirs(folder)
        try:
            simulate(Simulator(program, folder, trial), trial.scene)
        except Ended:
            pass
    return trial


def line_of(trial, finding):
    place = f" ({finding.place})" if finding.place else ""
    measured, bound = (f"{x:.3g}" if isinstance(x, float) else x for x in (finding.measured, finding.bound))
    return f"failed: scene {trial.number}: {finding.name}: {measured}, bound {bound}{place}: {' && '.join(trial.commands)}"


def without_numbers(sentence):
    """The sentence with # in place of numbers, so that sentences of one kind are equal."""
    return re.sub(r"-?\d[\d.]*(e[-+]?\d+)?", "#", sentence)


def print_totals(trials, seconds):
    counts = collections.Counter(trial.outcome for trial in trials)
    print(f"{len(trials)} scenes in {seconds:.0f} s, {seconds / max(1, len(trials)):.2f} s each")
    for outcome, meaning in OUTCOMES.items():
        print(f"  {outcome:9} {counts[outcome]:5}   {meaning}")
    ended = counts["stopped"] + counts["refused"]
    print(f"  {100 * ended / max(1, len(trials)):.0f} % stopped or refused, with these sentences:")
    kinds = collections.Counter((t.outcome, without_numbers(t.sentence)) for t in trials if t.sentence)
    for (outcome, sentence), count in kinds.most_common():
        print(f"  {outcome:9} {count:5}   {sentence}")
    print("Largest value of each invariant over its bound, if that is above 0, in scenes that did not fail:")
    near = {}
    for trial in trials:
        for f in trial.near:
            if trial.outcome != "failed" and isinstance(f.bound, float) and f.bound > 0:
                near[f.name] = max(near.get(f.name, (0, 0)), (f.measured / f.bound, trial.number))
    for name, (part, number) in sorted(near.items(), key=lambda item: -item[1][0]):
        print(f"  {100 * part:8.2g} %   {name} (scene {number})")


def try_all(seed, numbers, dimension, program, clock, keep=None, each=lambda trial: None):
    """Prints failures and totals. Returns True if no invariant is violated."""
    begin, trials = clock(), []
    for number in numbers:
        trial = try_scene(seed, number, dimension, program, keep)
        trials.append(trial)
        for finding in trial.broken:
            print(line_of(trial, finding), flush=True)
        each(trial)
    print_totals(trials, clock() - begin)
    sys.stdout.flush()
    return not any(trial.broken for trial in trials)
