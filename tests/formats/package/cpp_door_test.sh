#!/bin/sh
# cpp_door_test.sh SOURCE BUILD COMPILER: the example of docs/guide/cpp.md, built with what is installed, by CMake and
# with pkg-config, prints the mean forces that follow from the raw file.
set -eu
source=$1 build=$2 compiler=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cmake --install "$build" --component formats --prefix "$folder/first" >installed
mv first moved # nothing may name the place where it was

cmake -S "$source/docs/guide/cpp_door" -B door -DCMAKE_PREFIX_PATH="$folder/moved" -DCMAKE_CXX_COMPILER="$compiler" >configured
cmake --build door >built
PKG_CONFIG_PATH=$(dirname "$(find "$folder/moved" -name grseg-formats.pc)")
export PKG_CONFIG_PATH
# shellcheck disable=SC2046
"$compiler" -std=c++20 "$source/docs/guide/cpp_door/main.cpp" $(pkg-config --cflags --libs grseg-formats) -o mean_force

door/mean_force "$source/data/sample/chute.h5" >by_cmake.tsv
./mean_force "$source/data/sample/chute.h5" >by_pkg_config.tsv
cmp by_cmake.tsv by_pkg_config.tsv
/usr/bin/python3 - "$source/data/sample/chute.h5" by_cmake.tsv <<'END'
import sys
import h5py
import numpy as np

with h5py.File(sys.argv[1]) as run:
    names = np.array(["small", "large", "base"])[run["particles/grains/species"][:]]
    contacts = run["grseg/contacts"]
    force = np.linalg.norm(contacts["force"][:].astype(float), axis=1)
    pairs = ["-".join(sorted(pair)) for pair in zip(names[contacts["i"][:]], names[contacts["j"][:]])]
expected = {pair: force[np.array(pairs) == pair].mean() for pair in set(pairs)}
printed = {pair: float(mean) for pair, mean in (line.split() for line in open(sys.argv[2]))}
assert printed.keys() == expected.keys(), (printed, expected)
for pair, mean in printed.items():
    assert abs(mean - expected[pair]) < 1e-5 * mean, (pair, mean, expected[pair])
END

code=0
door/mean_force "$source/tests/inputs/truncated.h5" 2>said || code=$?
[ "$code" = 3 ] && grep -q "truncated.h5: is not an HDF5 file, or is truncated or damaged" said
