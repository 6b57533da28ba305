#!/bin/sh
# pip_test.sh SOURCE BUILD: pip puts grseg.py into an environment, from the unpacked sources and from the archive that
# pip's tools make of analysis/python alone; there it has the version of CMakeLists.txt, and the sample the B of grseg-fit.
set -eu
source=$1 build=$2
unset PYTHONPATH
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# pip leaves files beside setup.py, so it gets a copy.
mkdir -p sources/analysis/python
cp "$source/CMakeLists.txt" sources
for file in grseg.py pyproject.toml setup.py; do cp "$source/analysis/python/$file" sources/analysis/python; done
version=$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")
"$build/bin/grseg-stress" "$source/data/sample/chute.h5" --window 2.5 --quiet -o sums.tsv
"$build/bin/grseg-fit" sums.tsv --quiet -o fit.tsv

quietly() {
  "$@" >"$folder/said" 2>&1 || {
    cat "$folder/said" >&2
    exit 1
  }
}

# try ENVIRONMENT WHAT: without a network; numpy and h5py are Debian's.
try() {
  /usr/bin/python3 -m venv --system-site-packages --without-pip "$1"
  quietly /usr/bin/python3 -m pip --python "$1/bin/python" install --no-index --no-build-isolation --no-deps "$2"
  "$1/bin/python" -B -c '
import csv, importlib.metadata, sys, grseg
folder, version, sample = sys.argv[1:]
assert grseg.__file__.startswith(folder), grseg.__file__
assert importlib.metadata.version("grseg") == version, importlib.metadata.version("grseg")
with grseg.Run(sample) as run:
    fit = grseg.Points(run.contact_sums(window=2.5)).fit()
rows = csv.DictReader((line for line in open("fit.tsv") if line[0] != "#"), delimiter="\t")
row = next(row for row in rows if row["quantity"] == "B")
for mine, tools in zip((fit.B, *fit.B_interval), ("value", "low", "high")):
    assert abs(mine - float(row[tools])) < 1e-9, (mine, tools, row)' "$folder/$1" "$version" "$source/data/sample/chute.h5"
}

try of-sources ./sources/analysis/python
cd sources/analysis/python
quietly /usr/bin/python3 -B -c 'from setuptools import build_meta; build_meta.build_sdist("../../..")'
cd "$folder"
try of-archive ./grseg-"$version".tar.gz
