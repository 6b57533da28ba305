#!/usr/bin/python3
"""clang-tidy over the sources of programs and libraries, many files at a time.

Usage: tidy.py [--all] BUILD-FOLDER SOURCE.cpp ...

A file whose fingerprint is in tests/lint/passed.txt, or in BUILD-FOLDER/lint/passed.txt, is not
checked again. A fingerprint is a hash of all that decides the result: the file, our headers that it
includes, both without lines of comment, the rules, the compiler options and the version of clang-tidy,
but not where the checkout lies. What passes is added to BUILD-FOLDER/lint/passed.txt; scripts/lint makes tests/lint/passed.txt
of it. --all checks every file, listed or not.

Most of the time that clang-tidy spends on one file goes into the standard library and Eigen. Files
with the same compiler options are therefore joined into one text, for which these are read once.
Where such a text does not pass, each of its files is checked alone, and what is reported is what is
found then: a text that does not even compile (two files use one name for different things) costs
time, no more.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

LISTED = pathlib.Path("tests/lint/passed.txt")
MOST_LINES = 2000  # of a text: with several texts all processors stay busy to the end
# Output, what is gcc's own (precompiled headers, a warning), a compiler cache, and what is decided by
# .clang-tidy alone.
NOT_FOR_CLANG = re.compile(r"^\S*ccache | -Wno-subobject-linkage| -fpch-preprocess| -o \S+ -c \S+| -Winvalid-pch| -include \S+/cmake_pch\.hxx| -Werror(?=\s|$)")
# A line of comment, unless it speaks to clang-tidy.
COMMENT = re.compile(r"^[ \t]*//(?!.*NOLINT).*\n", re.MULTILINE)
CONSTANT = re.compile(r"^constexpr \S+ \w+ = .*;$", re.MULTILINE)


def names_of(file):
    """Names that a file declares at the left margin, where clang-format puts those of namespaces, with
    what they stand for: something of that file, or a constant of one line."""
    source = pathlib.Path(file).read_text()
    constants = {re.search(r"(\w+) =", line)[1]: line for line in CONSTANT.findall(source)}
    names = re.findall(r"^(?!namespace)(?:[\w:<>,&*]+ )+[&*]*(\w+)(?= ?[({;=\[])", source, re.MULTILINE)
    names += re.findall(r"^(?:struct|class|enum class|enum|using) (\w+)\b", source, re.MULTILINE)
    return {name: file for name in names} | constants


def stands_alone(source):
    """Programs, and what Highway compiles for several processors."""
    return "foreach_target.h" in source or re.search(r"^int main\(", source, re.MULTILINE)


def closure(file, seen):
    """Adds to SEEN the file and all of our headers that it includes."""
    if file in seen or not os.path.exists(file):
        return
    seen.add(file)
    for header in re.findall(r'^#include "([^"]+)"', pathlib.Path(file).read_text(), re.MULTILINE):
        closure(header, seen)


def group(files, command_of):
    """Lists of files that go into one text: the same compiler options, and no name that stands for two
    things, be it in the files or in their headers."""
    groups = []
    for file in files:
        source = pathlib.Path(file).read_text()
        headers = set()
        closure(file, headers)
        shared = {name for header in headers - {file} for name in names_of(header)}
        names = {name: what for name, what in names_of(file).items() if name not in shared}
        lines, alone = source.count("\n"), stands_alone(source)
        for g in groups:
            if (not alone and g["command"] == command_of[file] and g["lines"] + lines <= MOST_LINES
                    and not names.keys() & g["shared"] and not g["names"].keys() & shared
                    and all(g["names"].get(name, what) == what for name, what in names.items())):
                g["files"].append(file)
                g["names"] |= names
                g["shared"] |= shared
                g["lines"] += lines
                break
        else:
            groups.append({"files": [file], "command": None if alone else command_of[file],
                           "names": names, "shared": shared, "lines": lines})
    return [g["files"] for g in groups]


def together(files):
    """The files one after the other; a constant that several of them define is defined once."""
    seen = set()

    def once(constant):
        new = constant[0] not in seen
        seen.add(constant[0])
        return constant[0] if new else ""

    return "\n".join(CONSTANT.sub(once, pathlib.Path(f).read_text()) for f in files)


def fingerprint(file, command, version):
    seen = {".clang-tidy"}
    closure(file, seen)
    texts = [version, command] + [name + "\0" + COMMENT.sub("", pathlib.Path(name).read_text()) for name in sorted(seen)]
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()[:32]


def fingerprints(folder, command_of):
    """Of each file, the same in every checkout and build folder."""
    version = subprocess.run(["clang-tidy", "--version"], text=True, capture_output=True, check=True).stdout
    version = re.search(r"version (\S+)", version)[1]

    def anywhere(command):
        return command.replace(os.path.abspath(folder), "BUILD").replace(os.getcwd(), ".")

    return {file: fingerprint(file, anywhere(command), version) for file, command in command_of.items()}


def listed(*lists):
    """The fingerprints of these lists: the first word of each line."""
    return {line.split()[0] for path in lists if path.exists()
            for line in path.read_text().splitlines() if line and not line.startswith("#")}


def entries_of(build):
    """Compile commands by file, also those of files that are compiled as part of a joined one."""
    entries = {e["file"]: e for e in json.load(open(build / "compile_commands.json"))}
    for joined, entry in list(entries.items()):
        if "/Unity/unity_" in joined:
            for file in re.findall(r'^#include "([^"]+)"', pathlib.Path(joined).read_text(), re.MULTILINE):
                entries[file] = entry
    return entries


def clang_tidy(folder, file):
    return subprocess.run(["clang-tidy", "--quiet", "--config-file=.clang-tidy", "-p", folder, file],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def check(lint, text, files):
    """What clang-tidy reports for each of these files; empty where it passes."""
    if len(files) > 1 and clang_tidy(lint, text).returncode == 0:
        return {file: "" for file in files}
    reports = {file: clang_tidy(lint, os.path.abspath(file)) for file in files}
    reports = {file: r.stdout if r.returncode != 0 else "" for file, r in reports.items()}
    if len(files) > 1 and not any(reports.values()):
        print("lint: passed one by one, but not together:", *files, file=sys.stderr)
    return reports


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--all", action="store_true")
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("files", nargs="+")
    given = parser.parse_args()
    lint = given.build / "lint"
    lint.mkdir(exist_ok=True)
    entries = entries_of(given.build)
    entry_of = {f: entries[os.path.abspath(f)] for f in given.files}
    command_of = {f: NOT_FOR_CLANG.sub("", entry_of[f]["command"]) for f in given.files}
    print_of = fingerprints(given.build, command_of)
    known = set() if given.all else listed(LISTED, lint / "passed.txt")
    files = [f for f in given.files if print_of[f] not in known]
    if files:
        print(f"lint: clang-tidy checks {len(files)} of {len(given.files)} files", file=sys.stderr)

    database = [{"directory": entry_of[f]["directory"], "file": os.path.abspath(f),
                 "command": f"{command_of[f]} -c {os.path.abspath(f)}"} for f in files]
    work = []
    for number, members in enumerate(group(files, command_of)):
        text = (lint / f"{number}.cpp").absolute()
        text.write_text(together(members))
        database.append({"directory": entry_of[members[0]]["directory"], "file": str(text),
                         "command": f"{command_of[members[0]]} -c {text}"})
        work.append((str(lint), str(text), members))
    (lint / "compile_commands.json").write_text(json.dumps(database, indent=1))
    reports = {file: None for file in files}  # None: not checked yet

    def write_passed():
        """After every text: what has passed need not be checked again where the rest is interrupted."""
        passed = [f"{print_of[f]}  {f}\n" for f in sorted(given.files) if reports.get(f, "") == ""]
        (lint / "passed.txt").write_text("".join(passed))

    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for done in concurrent.futures.as_completed(pool.submit(check, *w) for w in work):
            reports |= done.result()
            write_passed()
    write_passed()
    print("".join(reports.values()), end="")
    sys.exit(1 if any(reports.values()) else 0)


if __name__ == "__main__":
    main()
