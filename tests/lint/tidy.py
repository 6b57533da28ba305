#!/usr/bin/python3
"""clang-tidy over the sources of programs and libraries, many files at a time.

Usage: tidy.py BUILD-FOLDER SOURCE.cpp ...

Nearly all that clang-tidy does for one file it does for the standard library and Eigen. Files that
are compiled alike are therefore put together into one text, for which it is done once. Where such a
text does not pass, each of its files is looked at alone, and what is reported is what is found then:
a text that does not even compile (two files give one name to different things) costs time, no more.
What has passed, with the headers and rules it passed with, is remembered in BUILD-FOLDER/lint.
"""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

MOST_LINES = 2000  # of a text: several of them share the processors out evenly
NOT_FOR_CLANG = re.compile(r" -o \S+ -c \S+| -Winvalid-pch| -include \S+/cmake_pch\.hxx")  # gcc's own
CONSTANT = re.compile(r"^constexpr \S+ \w+ = .*;$", re.MULTILINE)


def names_of(file):
    """Names that a file gives at the left margin, where clang-format puts those of namespaces, with
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
    """The file and all of ours that it includes."""
    if file in seen or not os.path.exists(file):
        return
    seen.add(file)
    for header in re.findall(r'^#include "([^"]+)"', pathlib.Path(file).read_text(), re.MULTILINE):
        closure(header, seen)


def group(files, command_of):
    """Lists of files that go into one text: compiled alike, no name for two things, be it a file's own
    or one of the headers that another includes."""
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
    """The files one after the other, constants that several of them have only once."""
    seen = set()

    def once(constant):
        new = constant[0] not in seen
        seen.add(constant[0])
        return constant[0] if new else ""

    return "\n".join(CONSTANT.sub(once, pathlib.Path(f).read_text()) for f in files)


def fingerprint(files, command):
    seen = {".clang-tidy"}
    for file in files:
        closure(file, seen)
    texts = [command] + [name + "\0" + pathlib.Path(name).read_text() for name in sorted(seen)]
    return hashlib.sha256("\0".join(texts).encode()).hexdigest()


def clang_tidy(folder, file):
    return subprocess.run(["clang-tidy", "--quiet", "--config-file=.clang-tidy", "-p", folder, file],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def look(lint, text, files, mark):
    """What clang-tidy says of these files, or "" where it has nothing to say."""
    if mark.exists():
        return ""
    found = ""
    if len(files) == 1 or clang_tidy(lint, text).returncode != 0:
        results = [clang_tidy(lint, os.path.abspath(file)) for file in files]
        found = "".join(r.stdout for r in results if r.returncode != 0)
        if len(files) > 1 and not found:
            print("lint: passed alone, but not together:", *files, file=sys.stderr)
    if not found:
        mark.touch()
    return found


def main():
    build, *files = sys.argv[1:]
    lint = pathlib.Path(build) / "lint"
    lint.mkdir(exist_ok=True)
    entries = {e["file"]: e for e in json.load(open(f"{build}/compile_commands.json"))}
    entry_of = {f: entries[os.path.abspath(f)] for f in files}
    command_of = {f: NOT_FOR_CLANG.sub("", entry_of[f]["command"]) for f in files}
    database = [{"directory": entry_of[f]["directory"], "file": os.path.abspath(f),
                 "command": f"{command_of[f]} -c {os.path.abspath(f)}"} for f in files]
    groups, work = group(files, command_of), []
    for number, members in enumerate(groups):
        text = (lint / f"{number}.cpp").absolute()
        text.write_text(together(members))
        command = command_of[members[0]]
        database.append({"directory": entry_of[members[0]]["directory"], "file": str(text),
                         "command": f"{command} -c {text}"})
        work.append((str(lint), str(text), members, lint / fingerprint(members, command)))
    (lint / "compile_commands.json").write_text(json.dumps(database, indent=1))
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        found = list(pool.map(lambda w: look(*w), work))
    print("".join(found), end="")
    sys.exit(1 if any(found) else 0)


if __name__ == "__main__":
    main()
