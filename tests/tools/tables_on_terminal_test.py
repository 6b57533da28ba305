#!/usr/bin/python3
"""Every tool that prints a table prints a short table on a terminal, which fits 100 columns, and the whole table into pipes
and files; --digits sets the digits of both. Usage: tables_on_terminal_test.py SOURCE BIN"""
import os
import re
import sys
import tempfile

source, programs = sys.argv[1:]
sys.path.insert(0, source + "/scripts")
import shared  # noqa: E402
from terminal import in_pipe, on_terminal  # noqa: E402

run = f"{source}/data/sample/chute.h5"
COMMANDS = {
    "stress": [run, "--window", "5"],
    "kinetic": [run, "--window", "5"],
    "micro": [run, "--window", "1"],
    "balance": [run, "--window", "5"],
    "segregation": [run, "--summary"],
    "check": [run, "--physics"],
    "fit": [f"{source}/tests/inputs/neutral-sums.tsv", "--heights", "all", "--scan", "0.5:0.8:0.1", ],
}


def numbers(table):
    """Cells of the rows of a whole table; the table's last line must agree with the table."""
    rows = [line for line in shared.unsealed(table).splitlines() if not line.startswith("#")][1:]
    return [row.split("\t") for row in rows]


def digits_of(cell):
    """Significant digits of a number with a point, else 0."""
    digits = re.fullmatch(r"-?(\d*)\.?(\d*)(e.*)?", cell)
    return len((digits[1] + digits[2]).lstrip("0")) if digits and re.search("[.e]", cell) else 0


def check(tool, words, folder):
    command = [f"{programs}/grseg-{tool}", *words, "--quiet"]
    whole, _ = in_pipe(command)
    short, _ = on_terminal(command)
    assert in_pipe([*command, "--short"])[0] == short, tool
    assert "\t" not in short and "#" not in short and "nan" not in short, (tool, short)
    assert all(len(line) <= 100 and line == line.rstrip() for line in short.splitlines()), (tool, short)
    rows = numbers(whole)
    assert len(short.splitlines()) <= 45, (tool, short)
    columns = next(line for line in whole.splitlines() if not line.startswith("#")).split("\t")
    assert short.lstrip().startswith(columns[0]), (tool, short)
    if any(column not in short for column in columns):
        assert re.search(rf"\n\d+ of {len(columns)} columns and \d+ of {len(rows)} rows; -o FILE", short), (tool, short)

    path = f"{folder}/{tool}.tsv"
    rounded, _ = in_pipe([*command, "--digits", "3", "-o", path])
    assert rounded == "", rounded
    few = numbers(open(path).read())
    assert max(digits_of(cell) for row in rows for cell in row) > 10, tool
    assert max(digits_of(cell) for row in few for cell in row) == 3, (tool, few)
    assert on_terminal([*command, "-o", "-"])[0].count("\n") == whole.count("\n"), tool
    assert on_terminal([*command, "--json"])[0].startswith("{"), tool
    for wrong in ["--digits", "0"], ["--digits", "18"], ["--short", "--json"], ["--digits", "3", "--json"]:
        assert "--" + wrong[0][2:] in in_pipe([*command, *wrong], [2])[1], (tool, wrong)


def main():
    with tempfile.TemporaryDirectory() as folder:
        for tool, words in COMMANDS.items():
            check(tool, words, folder)
        # If not all columns fit, those are shown that most readers look for.
        sums = f"{folder}/sums.tsv"
        in_pipe([f"{programs}/grseg-micro", *COMMANDS["micro"], "--quiet", "-o", sums])
        derived, _ = on_terminal([f"{programs}/grseg-derive", sums, "--quiet"])
        assert {"phi_L", "z_S", "z_L", "f_S[N]"} <= set(derived.splitlines()[0].split()), derived


main()
