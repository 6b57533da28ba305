#!/usr/bin/python3
"""The scripts of --completion complete options, their words, and files in an interactive bash and zsh.

Usage: completion_test.py BIN; a shell that is missing is named, and the other tried; exit code 77 where both are.
"""
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time

programs = sys.argv[1]
SHELLS = "bash", "zsh"
TYPED = {
    "--partit": "--partition",
    "--colu": "--columns",
    "sums-o": "sums-of-a-run.tsv",
    "-o sums-o": "sums-of-a-run.tsv",
    "--over fl": "--over flows",
    "--partition size,contact-": "--partition size,contact-point",
    "--partition unif": "--partition uniform:",
}
# One option for each list of words, and one word of the list.
WORDS = {
    "grseg-balance": {"partition": "stock", "preset": "rigorous"},
    "grseg-closure": {"instruments": "previous"},
    "grseg-derive": {"force": "normal", "average": "ends", "pool": "windows", "partition": "uniform:"},
    "grseg-explore": {"partition": "contact-point", "rules": "stock", "component": "yy", "base-part": "half"},
    "grseg-export": {"to": "extxyz"},
    "grseg-fit": {"component": "pressure", "quantity": "kinetic", "fit": "paper", "completion": "zsh"},
    "grseg-forces": {"unit": "type"},
    "grseg-import": {"format": "siconos", "repeated": "last", "units": "cgs", "grains-are": "spheres", "origin": "centre"},
    "grseg-kinetic": {"mean": "profile-unbiased", "velocity": "middle", "bins": "radius:"},
    "grseg-micro": {"composition": "clipped"},
    "grseg-render": {"color": "pressure", "plane": "zx", "theme": "dark"},
    "grseg-sim": {"accuracy": "draft", "contact-law": "centred", "geometry": "drum", "rotation": "off"},
    "grseg-stress": {"assign": "branch", "composition": "kernel", "volume": "solid", "base-part": "half"},
}


def typed(shell, script, keys, folder, wanted):
    """Text that an interactive shell shows after these keys, with its completion loaded, until `wanted` appears."""
    words = {"bash": ["bash", "--norc", "--noprofile", "-i"], "zsh": ["zsh", "-f", "-i"]}[shell]
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.environ.update(PATH=programs + ":" + os.environ["PATH"], TERM="dumb", PS1="READY ", COLUMNS="200")
        os.execvp(words[0], words)
    load = f"source {script}" if shell == "bash" else f"fpath=({os.path.dirname(script)} $fpath); autoload -Uz compinit; compinit -u -D"
    seen = ""
    for line, last in ((f"PS1='READY '; {load}; echo lo''aded\r", "loaded"), (keys, wanted)):
        os.write(terminal, line.encode())
        until, part = time.monotonic() + 20, ""
        while time.monotonic() < until and last not in part:
            ready, _, _ = select.select([terminal], [], [], 20)
            if not ready:
                break
            part += os.read(terminal, 65536).decode(errors="replace")
        seen = part
    os.kill(child, 9)
    os.waitpid(child, 0)
    os.close(terminal)
    return seen


def main():
    missing = []
    for shell in SHELLS:
        if shutil.which(shell) is None:
            missing.append(shell)
            continue
        with tempfile.TemporaryDirectory() as work:
            open(os.path.join(work, "sums-of-a-run.tsv"), "w").close()
            script = os.path.join(work, "_grseg-fit" if shell == "zsh" else "grseg-fit")
            with open(script, "w") as out:
                subprocess.run([os.path.join(programs, "grseg-fit"), "--completion", shell], stdout=out, check=True)
            for keys, wanted in TYPED.items():
                shown = typed(shell, script, f"grseg-fit {keys}\t", work, wanted)
                assert wanted in shown, (shell, keys, shown)
    for program in sorted(os.listdir(programs)):
        if not program.startswith("grseg-"):
            continue
        for shell in SHELLS:
            text = subprocess.run([os.path.join(programs, program), "--completion", shell], capture_output=True, check=True,
                                  text=True).stdout
            for option, word in WORDS.get(program, {}).items():
                line = next(line for line in text.split("\n") if re.match(rf" +(\S+\|)?--{option}(\|\S+)?\) ", line))
                assert word in re.split(r"[ ()]", line), (program, shell, option, word, line)
            if shell not in missing:
                wrong = subprocess.run([shell, "-n"], input=text, capture_output=True, text=True)
                assert wrong.returncode == 0 and not wrong.stderr, (program, shell, wrong.stderr)
    if missing:
        print("not tried, since not installed:", *missing)
    if len(missing) == len(SHELLS):
        sys.exit(77)


main()
