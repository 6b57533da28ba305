"""A copy of the sources in which faults are made, and the results of its test programs."""
import contextlib
import hashlib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys

FOLDERS = ["analysis", "data", "docs", "formats", "scripts", "sim", "tests"]


def run_quietly(command, **options):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False, **options)


def mirror(source, copy):
    """Makes the copy of a file or folder equal to its source. Compares contents, not times: a file may have been edited
    while an earlier copy of it was compiled or broken. Equal files keep their times."""
    if os.path.isdir(source):
        os.makedirs(copy, exist_ok=True)
        names = [name for name in os.listdir(source) if name != "__pycache__"]
        for name in set(os.listdir(copy)) - set(names):
            left = os.path.join(copy, name)
            shutil.rmtree(left) if os.path.isdir(left) else os.remove(left)
        for name in names:
            mirror(os.path.join(source, name), os.path.join(copy, name))
        return
    with open(source, "rb") as file:
        content = file.read()
    if os.path.exists(copy):
        with open(copy, "rb") as file:
            if file.read() == content:
                return
    with open(copy, "wb") as file:
        file.write(content)
    shutil.copymode(source, copy)


class Copy:
    """The present sources, copied to WORK/tree and built there with `options` of CMake."""

    def __init__(self, work, jobs, options=()):
        self.work, self.tree, self.jobs, self.options = work, f"{work}/tree", jobs, options
        self.bin = f"{self.tree}/build/bin"
        self.commit = run_quietly(["git", "rev-parse", "--short=7", "HEAD"]).stdout.strip()
        os.makedirs(self.tree, exist_ok=True)
        for part in [*FOLDERS, "CMakeLists.txt"]:
            mirror(part, f"{self.tree}/{part}")
        done = run_quietly(["cmake", "-S", self.tree, "-B", f"{self.tree}/build", "-G", "Ninja",
                            "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=ON", "-DBUILD_SHARED_LIBS=ON",
                            "-DGRSEG_JOIN_SOURCES=OFF",  # a fault costs the compilation of one file, not of a folder
                            "-DCMAKE_LINK_DEPENDS_NO_SHARED=ON", *self.options])
        if done.returncode != 0:
            raise SystemExit(done.stdout)

    def build(self, targets):
        return run_quietly(["cmake", "--build", f"{self.tree}/build", "-j", str(self.jobs), "--target", *targets])

    def must_build(self, targets, what=""):
        done = self.build(targets)
        if done.returncode != 0:
            raise SystemExit(f"{what}: {done.stdout}")

    def failures(self, name, seconds=20, only="*"):
        """Names of the tests of one program that fail; a sentence about the program if it crashes or hangs."""
        results = self.results(name, seconds, only)
        if isinstance(results, str):
            return [results]
        return sorted({test for test, failed, _ in results if failed})

    def results(self, name, seconds, only):
        """Triples of a test's name, True if it fails, and its time in s; a sentence if the program crashes or hangs."""
        report = f"{self.work}/{name}.json"
        if os.path.exists(report):
            os.remove(report)
        done = run_quietly([f"{self.bin}/{name}", "--gtest_brief=1", f"--gtest_output=json:{report}",
                            f"--gtest_filter={only}"],
                           preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1)))
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return f"{name} does not end"
        if not os.path.exists(report):
            return f"{name} crashes"
        with open(report, encoding="utf-8") as file:
            suites = json.load(file)["testsuites"]
        return [(f"{suite['name'].split('/')[-1]}.{test['name'].split('/')[0]}", bool(test.get("failures")),
                 float(test["time"].rstrip("s"))) for suite in suites for test in suite["testsuite"]]


def kept_result(path, fault):
    """The result of an earlier run, if it was for this fault and some test detected the fault."""
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        result = json.load(file)
    return result if result.get("fault") == mark_of(fault) and result["noticed"] else None


def mark_of(fault):
    return hashlib.sha256("\n".join(fault).encode()).hexdigest()[:16]


@contextlib.contextmanager
def broken(copy, part, path, text):
    """Writes `text` into the file and compiles it. Afterwards restores file, object and library with their times, so
    that nothing must be compiled again. Objects that a header, a source of another library or a program of the page broke
    are compiled again by the next build."""
    source = f"{copy.tree}/{path}"
    build = f"{copy.tree}/build/{part.FOLDER}"
    made = [f"{build}/CMakeFiles/{part.LIBRARY}.dir/{os.path.relpath(path, part.FOLDER)}.o",
            f"{build}/lib{part.LIBRARY}.so"] if path.endswith(".cpp") and path.startswith(f"{part.FOLDER}/") else []
    compiled = path.endswith((".cpp", ".hpp", ".js"))
    for sound in [source, *made]:
        shutil.copy2(sound, sound + ".sound")
    try:
        with open(source, "w", encoding="utf-8") as file:
            file.write(text)
        if compiled:
            copy.must_build([part.LIBRARY], path)
        yield
    finally:
        for sound in [source, *made]:
            os.replace(sound + ".sound", sound)
        if compiled and not made:
            os.utime(source)


def inject(copy, part, fault):
    """Results of the tests on the copy with one fault."""
    what, path, old, new = fault
    kept = f"{copy.work}/{re.sub('[^a-z]+', '-', what.lower())}.json"
    result = kept_result(kept, fault)
    if result:
        return result
    text = open(f"{copy.tree}/{path}", encoding="utf-8").read()
    if text.count(old) != 1:
        raise SystemExit(f"{path} must contain this code exactly once: {old}")
    with broken(copy, part, path, text.replace(old, new)):
        groups = part.noticed(copy, path)
    result = {"what": what, "file": path, "fault": mark_of(fault), "commit": copy.commit,
              "noticed": sum(map(len, groups.values())), **groups}
    with open(kept, "w", encoding="utf-8") as file:
        json.dump(result, file, indent=1)
    print(f"{what}: " + ", ".join(f"{len(names)} {group}" for group, names in groups.items()),
          file=sys.stderr, flush=True)
    return result
