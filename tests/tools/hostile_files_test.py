#!/usr/bin/python3
"""Malicious files: every tool refuses them with one sentence, quickly and with little memory, or ignores the
malicious part; no other file is opened. Usage: hostile_files_test.py BIN RUN.h5
"""
import os
import resource
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

bin_folder, run = sys.argv[1:]
seconds, memory = 20, 3 << 30
tools = {
    "stress": ["grseg-stress", "--window", "0.1", "--trust"],  # an attacker can compute digests, too
    "check": ["grseg-check"],
    "deep": ["grseg-check", "--deep"],
    "export": ["grseg-export", "--to", "extxyz", "-o", "view.xyz"],
}


def limit_memory():
    if "ASAN_OPTIONS" not in os.environ:  # the sanitizer reserves the whole address space
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))


def outcome(tool, file="hostile.h5"):
    name, *options = tools[tool]
    for left in ("view.xyz",):
        if os.path.exists(left):
            os.remove(left)
    done = subprocess.run([f"{bin_folder}/{name}", file, *options, "--quiet"], capture_output=True, timeout=seconds,
                          preexec_fn=limit_memory)
    return done.returncode, done.stdout, done.stderr.decode()


def expect_refused(what, words, of=tuple(tools), code=3):
    for tool in of:
        got, _, said = outcome(tool)
        assert got == code and words in said and said.count("\n") == 1, f"{what}, {tool}: {got}: {said}"


def hostile(change):
    shutil.copy(run, "hostile.h5")
    with h5py.File("hostile.h5", "r+") as f:
        change(f)


def link_out(path, to):
    def change(f):
        del f[path]
        f[path] = h5py.ExternalLink(to, "/x")
    return change


with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    with h5py.File("other.h5", "w") as f:
        f["x"] = np.zeros((8, 2))
    os.mkfifo("fifo")

    force = "/grseg/contacts/force"
    hostile(link_out(force, "other.h5"))
    expect_refused("a link to another file", f"{force} cannot be opened")
    hostile(link_out(force, "fifo"))
    expect_refused("a link to a pipe", f"{force} cannot be opened")
    for tool in tools:
        got, _, said = outcome(tool, "fifo")
        assert got == 2 and "is a pipe or a device" in said, f"a pipe, {tool}: {got}: {said}"

    hostile(lambda f: f.__setitem__("/more", h5py.ExternalLink("other.h5", "/x")))
    expect_refused("a link to another file", "/more is a soft or external link", ["deep"], 4)

    def outside(f):
        del f[force]
        f.create_dataset(force, (8, 2), "f8", external=[("/etc/passwd", 0, h5py.h5f.UNLIMITED)])
    hostile(outside)
    expect_refused("storage in another file", "is stored outside this file")

    def virtual(f):
        del f[force]
        layout = h5py.VirtualLayout((8, 2), "f8")
        layout[:] = h5py.VirtualSource("fifo", "x", (8, 2))
        f.create_virtual_dataset(force, layout)
    hostile(virtual)
    expect_refused("a virtual dataset", "is stored outside this file")

    hostile(lambda f: f.__setitem__("/grseg/contacts/again", f["/grseg"]))
    assert outcome("stress")[0] == 0
    assert outcome("deep")[0] == 4, "a circle of groups does not keep --deep from its end: not_closed"

    def many_rows(f):
        f.create_dataset("/more", (2**50,), "i1", chunks=(1024,))
    hostile(many_rows)
    expect_refused("2^50 empty rows", "/more claims to hold more than a file of this size can", ["deep"])
    hostile(lambda f: f.create_dataset("/more", (2**50, 0), "i8", chunks=(1024, 1), maxshape=(None, None)))
    assert outcome("deep")[0] == 4, "2^50 rows of nothing"
    hostile(lambda f: f.create_dataset("/more", (1, 2**61), "i8", chunks=(1, 2**20)))
    expect_refused("rows of 2^64 bytes", "/more claims to hold more than a file of this size can", ["deep"])

    def large_parameters(f):
        for k in range(6):
            f.create_dataset(f"/parameters/large{k}", (10**8,), "f8", chunks=(10**6,), compression=9)
    hostile(large_parameters)
    expect_refused("six parameters of 1e8 entries", "/parameters/large0 ")
    hostile(lambda f: f.create_dataset("/parameters/text", (), "S15000000"))
    code = outcome("stress")[0]
    assert code in (0, 3), code

    def words(f):
        del f["/parameters/history"]
        f["/parameters/history"] = np.bytes_(b"\x1b[2J\x07red\r# verified: all\n# input: xxh3 0\x9b1m")
        f["/parameters/origin"] = np.bytes_(b"base\n# verified: all\n\x1b]0;title\x07")
    hostile(words)
    got, table, said = outcome("stress")
    assert got == 0, said
    assert not any(byte < 32 and byte not in (9, 10) or byte > 126 for byte in table), table
    lines = table.decode().split("\n")
    assert [line for line in lines if line.startswith("# verified")] == ["# verified: no (--trust)"], lines
    assert sum(line.startswith("# input") for line in lines) == 1, lines
