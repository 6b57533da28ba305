#!/usr/bin/python3
"""Checks references from sources to equations: each numbered equation of Staron & Phillips in docs/equations.md is named ("eq. 3",
"eqs. 3 and 4") in a source that its row links, or in the header beside that source. Usage: equations_test.py SOURCE"""
import pathlib
import re
import sys


def numbers_named(text):
    """All numbers n in "eq. n", "eqs. n, m and k", "eq. (n)"."""
    found = set()
    for words in re.findall(r"\beqs?\.\s*((?:\(?\d+\)?(?:,\s*|\s+and\s+|\s+to\s+)?)+)", text):
        found |= {int(n) for n in re.findall(r"\d+", words)}
    return found


def main():
    page = pathlib.Path(sys.argv[1]).resolve() / "docs/equations.md"
    missing, rows = [], 0
    for line in page.read_text().splitlines():
        row = re.match(r"\| (\d+(?:, \d+)*) \|", line)
        if not row:
            continue
        rows += 1
        named = set()
        for link in re.findall(r"\]\(([^)#]+\.(?:cpp|hpp))\)", line):
            file = (page.parent / link).resolve()
            for path in {file, file.with_suffix(".hpp")}:
                if path.exists():  # a comment may be broken into lines
                    named |= numbers_named(re.sub(r"\s*\n\s*//+\s*", " ", path.read_text()))
        missing += [n for n in map(int, re.findall(r"\d+", row[1])) if n not in named]
    print("\n".join([f"eq. {n}: no linked source names it" for n in missing] + [f"{rows} rows, {len(missing)} missing"]))
    sys.exit(1 if missing or rows < 7 else 0)


if __name__ == "__main__":
    main()
