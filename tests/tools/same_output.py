#!/usr/bin/python3
"""Compares two texts word by word: numbers to 1e-12 (the last digit of a logarithm depends on the
processor), everything else to the letter. Usage: same_output.py ACTUAL EXPECTED"""
import re
import sys

actual, expected = (re.split(r"([\s,]+)", open(path).read()) for path in sys.argv[1:])
if len(actual) != len(expected):
    sys.exit(f"{len(actual)} words where {len(expected)} are expected")
for a, e in zip(actual, expected):
    if a == e:
        continue
    try:
        if abs(float(a) - float(e)) <= 1e-12 * (1 + abs(float(e))):
            continue
    except ValueError:
        pass
    sys.exit(f"'{a}' where '{e}' is expected")
