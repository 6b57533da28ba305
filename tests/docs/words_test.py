#!/usr/bin/python3
"""Comments of production code begin with their noun or verb, and no document is longer than lengths.tsv allows.

Usage: words_test.py SOURCE [--counts]    --counts prints the words of each document instead
"""
import pathlib
import re
import sys

OPENINGS = re.compile(r"(Of|The same|Whether|Those|What|That|By how much|So that)\b")
UNCLEAR = r"anew|hangs? on|goes before|blind to|what \w+( \w+){0,3} is what"
IN_COMMENTS = re.compile(rf"\b(those (that|of|which)|that of|by how much|{UNCLEAR})\b", re.IGNORECASE)
IN_DOCUMENTS = re.compile(rf"\b({UNCLEAR})\b", re.IGNORECASE)


def comments(text):
    """Comments with the numbers of their first lines; consecutive comment lines are one comment."""
    block, first = [], 0
    for number, line in enumerate(text.split("\n"), 1):
        whole = re.match(r"\s*(///?|/\*\*?|\*(?!/))(?!\s*SPDX)\s?(.*)", line)
        if whole:
            first = first if block else number
            block.append(whole[2])
            continue
        if block:
            yield first, " ".join(block)
            block = []
        behind = re.search(r"\S.*?\s//\s([^\"]+)$", line)
        if behind:
            yield number, behind[1]


def findings_in_comments(source):
    for room in ("formats", "sim", "analysis"):
        for path in sorted(p for p in (source / room).rglob("*") if p.suffix in (".cpp", ".hpp", ".js")):
            for line, text in comments(path.read_text(encoding="utf-8")):
                found = OPENINGS.match(text) or IN_COMMENTS.search(text)
                if found:
                    yield f"{path.relative_to(source)}:{line}: '{found[0]}' in a comment; begin with the noun or the verb, and name the thing"


def documents(source):
    """Every page with its text, except in builds and runs."""
    for path in [source / "README.md", *(p for room in ("docs", "formats", "scripts", "tests", "data") for p in sorted((source / room).rglob("*.md")))]:
        yield str(path.relative_to(source)), path.read_text(encoding="utf-8")


def findings_in_documents(source):
    lines = (source / "tests/docs/lengths.tsv").read_text(encoding="utf-8").splitlines()
    allowed = dict(line.split("\t") for line in lines if not line.startswith("#"))
    for name, text in documents(source):
        words = len(text.split())
        if words > int(allowed.get(name, 0)):
            yield f"{name}: {words} words, and tests/docs/lengths.tsv allows {allowed.get(name, 0)}; shorten a page"
        for number, line in enumerate(text.split("\n"), 1):
            if found := IN_DOCUMENTS.search(line):
                yield f"{name}:{number}: '{found[0]}'; say it in plain words"


def main():
    source = pathlib.Path(sys.argv[1])
    if "--counts" in sys.argv:
        print("\n".join(f"{name}\t{len(text.split())}" for name, text in documents(source)))
        return
    found = [*findings_in_comments(source), *findings_in_documents(source)]
    print("\n".join([*found, f"{len(found)} findings"]))
    sys.exit(1 if found else 0)


main()
