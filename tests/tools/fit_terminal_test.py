#!/usr/bin/python3
"""grseg-fit prints a short table on a terminal, and the whole table into pipes and files.
Usage: fit_terminal_test.py GRSEG-FIT SUMS"""
import os
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scripts"))
import shared  # noqa: E402
import terminal  # noqa: E402

program, sums = sys.argv[1:]
options = [sums, "--heights", "all", "--partition", "size,half"]


def on_terminal(*more):
    return terminal.on_terminal([program, *options, *more])


def in_pipe(*more):
    return terminal.in_pipe([program, *options, *more])


def made_with(table, words, more):
    """The table as it would be with more words on the command line, which its history contains."""
    return shared.sealed(shared.unsealed(table).replace(words, words + more))


def main():
    whole, doubts = in_pipe()
    assert whole.startswith("# program: grseg-fit "), whole
    assert "doubt" not in whole.split("\n")[0] and doubts, "three layers of one window are too few"

    short, error = on_terminal()
    assert short.startswith("B of the contact stress (yy)") and "\nsize " in short, short
    assert "\nhalf " in short and "\nB = 0 if" in short and "\ndoubt: size" in short, short
    assert "\t" not in short and "#" not in short, short
    assert error == "", error  # doubts are printed in the table
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
