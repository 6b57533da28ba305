#!/usr/bin/python3
"""Runs the ```python blocks of a page, one after the other, in a temporary folder that looks like a clone after
scripts/build and the page's own commands. Usage: python_test.py SOURCE BUILD PAGE BLOCKS    (BLOCKS: smallest number)
"""
import os
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
source, build, page, least = sys.argv[1:]
sys.path.insert(0, os.path.join(source, "analysis", "python"))
with open(os.path.join(source, page)) as file:
    text = file.read()
blocks = re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)
assert len(blocks) >= int(least), f"{page}: {len(blocks)} blocks, expected {least}"
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    os.symlink(os.path.join(source, "data"), "data")
    os.makedirs("build")
    os.symlink(os.path.join(build, "bin"), "build/bin")
    for command in re.findall(r"^build/bin/.*$", text, re.MULTILINE):
        subprocess.run(command, shell=True, check=True, stderr=subprocess.DEVNULL)
    space = {}
    for number, block in enumerate(blocks, 1):
        exec(compile(block, f"{page}, block {number}", "exec"), space)
