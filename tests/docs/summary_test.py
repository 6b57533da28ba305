#!/usr/bin/python3
"""The summary that a page quotes equals the program's output: runs the page's first command, and compares its output
with the block after "The first prints:", except for the elapsed seconds.

Usage: summary_test.py SOURCE BUILD
"""
import os
import re
import subprocess
import sys
import tempfile

source, build = (os.path.abspath(word) for word in sys.argv[1:])
page = open(os.path.join(source, "docs", "guide", "simulate.md"), encoding="utf-8").read()
command = re.search(r"```sh\n(build/bin/grseg-sim .*)\n", page)[1]
quoted = re.search(r"The first prints:\n\n((?:    .*\n)+)", page)[1]
quoted = re.sub("^    ", "", quoted, flags=re.MULTILINE)
with tempfile.TemporaryDirectory() as folder:
    os.symlink(os.path.join(source, "sim"), os.path.join(folder, "sim"))
    words = command.replace("build/bin", os.path.join(build, "bin")).split()
    printed = subprocess.run(words, cwd=folder, stderr=subprocess.PIPE, text=True, check=True).stderr
took = re.compile(r"in [\d.e+]+ s \([\d.e+]+ s per second\)")
if took.sub("", printed) != took.sub("", quoted):
    sys.exit(f"docs/guide/simulate.md quotes\n{quoted}and the program prints\n{printed}")
