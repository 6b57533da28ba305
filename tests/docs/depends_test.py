#!/usr/bin/python3
"""Checks that every number with an interval in docs/studies/depends.md also occurs, digit by digit, where it was measured: in a section
to which its line (in running text, its paragraph) links. Usage: depends_test.py SOURCE [PAGE]"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
from links_test import LINK, slug  # noqa: E402

NUMBER = re.compile(r"−?\d\.\d+ \[−?\d\.\d+, −?\d\.\d+\]")
ROWS = 15


def section(page, anchor):
    """Text under a heading, up to the next heading of the same or a higher level."""
    lines, level = [], None
    for line in page.read_text().splitlines():
        head = re.match(r"(#+)\s+(.*)", line)
        if head and level and len(head[1]) <= level:
            break
        if head and not level and slug(head[2]) == anchor:
            level = len(head[1])
        if level:
            lines.append(line)
    return "\n".join(lines)


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    page = root / (sys.argv[2] if len(sys.argv) > 2 else "docs/studies/depends.md")
    wrong, rows, numbers = [], 0, 0
    table = re.findall(r"^\|.*", page.read_text(), re.MULTILINE)[2:]
    for part in table + re.sub(r"^\|.*", "", page.read_text(), flags=re.MULTILINE).split("\n\n"):
        found = NUMBER.findall(part)
        numbers, rows = numbers + len(found), rows + (part in table)
        if part in table and len(found) < 2:
            wrong.append(f"a row without a number on both sides: {part[:60]}")
        places = [target.split("#") for target in LINK.findall(part) if "#" in target]
        measured = "\n".join(section(page.parent / name, anchor) for name, anchor in places)
        wrong += [f"{number}: in no section that its line links: {part[:60]}" for number in found if number not in measured]
    print("\n".join(wrong + [f"{rows} rows, {numbers} numbers, {len(wrong)} wrong"]))
    sys.exit(1 if wrong or rows < ROWS else 0)


if __name__ == "__main__":
    main()
