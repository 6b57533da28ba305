#!/usr/bin/python3
"""The scripts of --completion complete options and files in an interactive bash and zsh.

Usage: completion_test.py BIN; a shell that is missing is named, and the other tried; exit code 77 where both are.
"""
import os
import pty
import select
import shutil
import subprocess
import sys
import tempfile
import time

programs = sys.argv[1]
SHELLS = "bash", "zsh"


def typed(shell, script, keys, folder):
    """What an interactive shell shows after these keys, its completion loaded."""
    words = {"bash": ["bash", "--norc", "--noprofile", "-i"], "zsh": ["zsh", "-f", "-i"]}[shell]
    child, terminal = pty.fork()
    if child == 0:
        os.chdir(folder)
        os.environ.update(PATH=programs + ":" + os.environ["PATH"], TERM="dumb", PS1="READY ", COLUMNS="200")
        os.execvp(words[0], words)
    load = f"source {script}" if shell == "bash" else f"fpath=({os.path.dirname(script)} $fpath); autoload -Uz compinit; compinit -u -D"
    seen = ""
    for line, wanted in ((f"PS1='READY '; {load}; echo lo''aded\r", "loaded"), (keys, None)):
        os.write(terminal, line.encode())
        until, part = time.monotonic() + 20, ""
        while time.monotonic() < until and (wanted is None or wanted not in part):
            ready, _, _ = select.select([terminal], [], [], 2 if wanted is None else 20)
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
            shown = typed(shell, script, "grseg-fit --partit\t", work)
            assert "--partition" in shown, (shell, shown)
            shown = typed(shell, script, "grseg-fit sums-o\t", work)
            assert "sums-of-a-run.tsv" in shown, (shell, shown)
            shown = typed(shell, script, "grseg-fit -o sums-o\t", work)
            assert "sums-of-a-run.tsv" in shown, (shell, shown)
    for program in sorted(os.listdir(programs)):
        if program.startswith("grseg-"):
            for shell in set(SHELLS) - set(missing):
                text = subprocess.run([os.path.join(programs, program), "--completion", shell], capture_output=True, check=True).stdout
                wrong = subprocess.run([shell, "-n"], input=text, capture_output=True)
                assert wrong.returncode == 0 and not wrong.stderr, (program, shell, wrong.stderr)
    if missing:
        print("not tried, since not installed:", *missing)
    if len(missing) == len(SHELLS):
        sys.exit(77)


main()
