#!/usr/bin/python3
"""Compares two texts word by word: numbers to 1e-12 (the last digit of a logarithm depends on the
processor), everything else exactly. The last line of a table must agree with its own table, since it
depends on these digits, too. Usage: same_output.py ACTUAL EXPECTED"""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"))
import shared  # noqa: E402

texts = [pathlib.Path(path).read_text() for path in sys.argv[1:]]
ends = [re.search(f"^{shared.MARK}.* xxh3 (?=[0-9a-f]{{16}}\n\\Z)", text, re.MULTILINE) for text in texts]
if None not in ends:
    shared.unsealed(texts[0], sys.argv[1])
    texts = [text[:end.end()] for text, end in zip(texts, ends)]
actual, expected = (re.split(r"([\s,]+)", text) for text in texts)
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
