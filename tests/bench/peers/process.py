"""Runs a program on one core and measures its cost."""
import dataclasses
import os
import shlex
import subprocess
import sys
import time


@dataclasses.dataclass
class Cost:
    wall: float       # wall time of the whole process, s
    cpu_share: float  # processor time over wall time; well below 1 if others used the core
    memory: float     # peak resident memory, MB


@dataclasses.dataclass
class Sample:
    """One timed run of one program, in the quantities of the table; lengths in d_S, times in s."""
    command: str
    cost: Cost
    wall: float           # wall time of the timed part
    steps: int            # number of steps in the timed part
    step: float
    mean_overlap: float   # mean overlap of overlapping pairs
    mobile_overlap: float  # the same, of pairs of mobile grains
    mean_gap: float       # mean |gap| of contacts with a force
    largest_overlap: float
    contacts: float       # number of contacts with a force
    velocity: float       # mean velocity of the mobile grains at the end, sqrt(g d_S)
    flow: float           # time of the flow from the state to the end

    @property
    def cpu(self):
        """Processor time of the timed part, s, assuming an even share of the core."""
        return self.wall * self.cost.cpu_share

    @property
    def flowed(self):
        """Flow in the timed part, s."""
        return self.steps * self.step


def in_words(command, environment, short):
    """A readable command line with its environment; `short` lists folders and their short names."""
    words = [f"{name}={value}" for name, value in (environment or {}).items()] + command
    text = shlex.join(words)
    for folder, name in short:
        text = text.replace(folder, name)
    return text


def run(command, folder, core, environment=None):
    """Runs `command` in `folder`, with its output in run.log there; exits with a message if it fails."""
    os.makedirs(folder, exist_ok=True)
    log = os.path.join(folder, "run.log")
    variables = dict(os.environ, OMP_NUM_THREADS="1", **(environment or {}))
    begin = time.perf_counter()
    with open(log, "w") as words:
        child = subprocess.Popen(command, cwd=folder, env=variables, stdin=subprocess.DEVNULL,
                                 stdout=words, stderr=subprocess.STDOUT,
                                 preexec_fn=lambda: os.sched_setaffinity(0, {core}))
        try:
            _, status, used = os.wait4(child.pid, 0)
        except BaseException:
            child.kill()
            raise
    wall = time.perf_counter() - begin
    if status != 0:
        tail = open(log).read().strip().splitlines()[-3:]
        sys.exit(f"compare-peers: {shlex.join(command)} failed in {folder}; run.log ends with\n  "
                 + "\n  ".join(tail))
    return Cost(wall, (used.ru_utime + used.ru_stime) / wall, used.ru_maxrss / 1024)
