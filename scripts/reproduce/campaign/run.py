"""One run of the campaign, in its folder: scene, simulation, tables and their cost."""
import fcntl
import glob
import itertools
import os
import re
import resource
import signal
import subprocess
import sys
import time

# Settings by the words of a run's name; the first matching pattern is used.
WORDS = [(r"phi(.*)", "phi-large = {}"), (r"seed(.*)", "seed = {}"), (r"step(.*)", "step = {}"), (r"s(\d.*)", "slope = {}"),
         (r"e(\d.*)", "restitution = {}"), (r"ratio(.*)", "size-ratio = {}"), (r"density(.*)", "density-ratio = {}"),
         (r"mu(.*)", "friction = {}"),
         (r"irregular()", "base-height-spread = 0.5dS\nbase-diameter-spread = 0.3\nbase-spacing-spread = 0.2"),
         (r"spaced()", "base-spacing = 1.2dL"), (r"mixed()", "initial = mixed"), (r"above()", "initial = large-above"),
         (r"finer()", "step = 5e-5\ntolerance = 0.01\nmax-sweeps = 5000")]
# Words that replace settings which all runs have in common.
COMMON = {r"cell(.*)": "length", r"depth(.*)": "depth", r"t(\d.*)": "duration", r"(draft|standard|reference)": "accuracy"}


def scene(options):
    """Prints the scene of a run. Each word between hyphens in the run's name sets one key. All other keys are as in sim/scenes/chute.ini."""
    lines = [f"# {options.name}: of scripts/reproduce; all else is as in sim/scenes/chute.ini."]
    common = {key: getattr(options, key.replace("-", "_")) for key in ("duration", "depth", "length", "accuracy", "frame-interval")}
    for word in options.name.split("-"):
        of_word = [line.format(found[1]) for pattern, line in WORDS if (found := re.fullmatch(pattern, word))]
        replaced = {key: found[1] for pattern, key in COMMON.items() if (found := re.fullmatch(pattern, word))}
        if not of_word and not replaced:
            sys.exit(f"scene: {options.name}: '{word}' is not a part of a run's name")
        lines += of_word[:1]
        common.update({"accuracy": "reference"} if word == "finer" else replaced)
    print("\n".join(lines + [f"{key} = {value}" for key, value in common.items()]))


def timed(command, stderr=None, **how):
    """Runs the command with its messages in the file `stderr` (None: on standard error); returns its exit code and
    "processor U + S s" (user, system)."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code = subprocess.run(command, stderr=stderr, **how).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return code, f"processor {after.ru_utime - before.ru_utime:.3f} + {after.ru_stime - before.ru_stime:.3f} s"


def is_newer(path, other):
    return os.path.exists(path) and os.path.getmtime(path) > os.path.getmtime(other)


def simulate(options):
    """Makes run.h5 from the scene.ini in this folder, with a checkpoint every EVERY seconds. Continues from a checkpoint if
    there is one. The simulator's messages are appended to run.log."""
    def run(*words):
        with open("run.log", "a") as log:
            code, processor = timed([options.simulator, *words, "--checkpoint", "run.chk", "--checkpoint-every", options.every,
                                     "--overwrite", "-o", "run.h5"], log, pass_fds=[lock.fileno()])
            log.write(processor + "\n")
        if code != 0:
            with open("run.log") as log:
                print(*[line for line in log if line.startswith("grseg-sim: ")][-1:], end="", file=sys.stderr)
        return code if code >= 0 else 128 - code

    # A simulator may still be running after its make was killed; it has the lock, so wait for it.
    lock = open("run.lock", "w")
    fcntl.flock(lock, fcntl.LOCK_EX)
    signal.signal(signal.SIGINT, lambda *_: None)  # the simulator receives the signal, too, and ends with a message
    if is_newer("run.h5", "scene.ini"):
        return
    if is_newer("run.chk", "scene.ini") and os.path.exists("run.h5.part") and os.path.getsize("run.h5.part"):
        with open("run.log", "a") as log:
            log.write("restart\n")
        code = run("--restart", "run.chk")
        if code != 3:
            sys.exit(code)
        trouble = "simulate: the interrupted run cannot be continued; starting from the beginning\n"
        with open("run.log", "a") as log:
            log.write(trouble)
        sys.stderr.write(trouble)
    for path in ["run.chk", "run_prev.chk", "run.h5", *glob.glob("run.h5.part*")]:
        if os.path.exists(path):
            os.remove(path)
    sys.exit(run("scene.ini"))


def without_restarts(text):
    """A table, or any other text, without the history lines of restarts."""
    # Imported here to save time, since make calls this module for every run.
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
    import shared
    return shared.changed(text, "(?m)^# history: grseg-sim --restart run.chk .*\n", "")


def table(options):
    """Writes the output of the command to FILE, completely or not at all. Exit code 4, a failed check, is a valid result.

    A restarted run equals an uninterrupted one bit for bit (tests/tools/restart_test.sh). Restarts are recorded in run.log and
    removed from the history of the table, so that tables are identical, too.
    """
    begin = time.time()
    part = f"{options.file}.{os.getpid()}.part"
    with open(part, "w+") as out:
        code, processor = timed(options.made_by, stdout=out)
        if code not in (0, 4):
            sys.exit(code if code >= 0 else 128 - code)
        out.seek(0)
        text = without_restarts(out.read())
        out.seek(0)
        out.truncate()
        out.write(text)
    os.replace(part, options.file)
    with open("run.log", "a") as log:
        log.write(f"{options.file} made in {time.time() - begin:.3f} s, {processor}\n")


def is_made_by(name, command):
    """True if the last line of a table's history is the command. A page has it among its data."""
    with open(name) as lines:
        if name.endswith(".html"):
            return command in lines.read()
        head = itertools.takewhile(lambda line: line.startswith("#"), lines)
        return [line for line in head if line.startswith("# history: ")][-1:] == [f"# history: {command}\n"]


def of_fits(name):
    return name.endswith(("page.html", "-summary.tsv"))


def outdated(options):
    """Prints the names of outdated tables and pages of the run in this folder. COMMAND did not make them. Pages and
    summaries, which have options of the fits, are not outdated once the trajectory is deleted, except with AGAIN.

    If the run is finished and its trajectory deleted, missing or outdated tables require another simulation. Then it prints
    "gone" and these tables or, with AGAIN, all tables, because the present program may give another run."""
    names, old, missing = [], [], []
    for wanted in options.wanted:
        name, _, command = wanted.partition(": ")
        names.append(name)
        if not os.path.exists(name):
            missing.append(name)
        elif command and (options.again or not of_fits(name) or os.path.exists("run.h5")) and not is_made_by(name, command):
            old.append(name)
    if (old or missing) and os.path.exists("checksums") and not os.path.exists("run.h5") and not is_newer("scene.ini", "checksums"):
        print(*(names if options.again else ["gone", *old, *missing]))
    else:
        print(*old)


def cost(_):
    """Prints the cost of the run in this folder, from run.log: wall times of the simulation, including restarts, and of the
    tables; processor times, without killed processes; size of the trajectory."""
    with open("run.log") as log:
        text = log.read()
    simulation = re.findall(r"(?m)^.* s simulated (?:.* )?in (\S+) s", text)[-1:]
    used = [float(a) + float(b) for a, b in re.findall(r"(?m)^processor (\S+) \+ (\S+) s", text)]
    made = {name: (float(wall), float(a) + float(b))
            for name, wall, a, b in re.findall(r"(?m)^(\S+) made in (\S+) s, processor (\S+) \+ (\S+) s", text)}
    print("simulation[s]\tits_processor[s]\ttables[s]\ttheir_processor[s]\ttrajectory[bytes]\trestarts")
    print(f"{sum(map(float, simulation)):.1f}\t{sum(used):.1f}", *(f"{sum(part[k] for part in made.values()):.1f}" for k in (0, 1)),
          os.path.getsize("run.h5") if os.path.exists("run.h5") else "nan", len(re.findall("(?m)^restart$", text)), sep="\t")
