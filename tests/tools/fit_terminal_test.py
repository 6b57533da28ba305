#!/usr/bin/python3
"""grseg-fit prints a short table on a terminal, and the whole one into pipes and files.
Usage: fit_terminal_test.py GRSEG-FIT SUMS"""
import os
import pty
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scripts"))
import sealed_tables  # noqa: E402

program, sums = sys.argv[1:]
options = [sums, "--heights", "all", "--bootstrap", "100", "--partition", "size,half"]


def on_terminal(*more):
    """Standard output of grseg-fit where that is a terminal; exit code 0."""
    leader, follower = pty.openpty()
    process = subprocess.Popen([program, *options, *more], stdout=follower, stderr=subprocess.PIPE)
    os.close(follower)
    text = b""
    while True:
        try:
            part = os.read(leader, 4096)
        except OSError:  # closed at the other end
            break
        if not part:
            break
        text += part
    error = process.stderr.read().decode()
    assert process.wait() == 0, error
    return text.decode().replace("\r\n", "\n"), error


def in_pipe(*more):
    done = subprocess.run([program, *options, *more], capture_output=True, check=True, text=True)
    return done.stdout, done.stderr


def made_with(table, words, more):
    """The table as made with more words on the command line, which is part of its history."""
    return sealed_tables.sealed(sealed_tables.unsealed(table).replace(words, words + more))


def main():
    whole, doubts = in_pipe()
    assert whole.startswith("# program: grseg-fit "), whole
    assert "doubt" not in whole.split("\n")[0] and doubts, "three layers of one window are too few"

    short, error = on_terminal()
    assert short.startswith("B of the contact stress (yy)") and "\nsize " in short, short
    assert "\nhalf " in short and "\nB = 0 where" in short and "\ndoubt: size" in short, short
    assert "\t" not in short and "#" not in short, short
    assert error == "", error  # the doubts are in the table
    assert in_pipe("--short")[0] == short

    assert on_terminal("-o", "-")[0] == made_with(whole, "--partition size,half", " -o -")
    assert on_terminal("--json")[0].startswith("{")
    with tempfile.TemporaryDirectory() as folder:
        path = folder + "/fit.tsv"
        assert on_terminal("-o", path)[0] == ""
        text = open(path).read()
        assert text == made_with(whole, "--partition size,half", f" -o {path}"), text
        os.remove(path)
        assert in_pipe("-o", path, "--short")[0] == short
        assert open(path).read().startswith("# program: grseg-fit ")


main()
