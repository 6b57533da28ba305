#!/bin/sh
# clang-format over all sources, clang-tidy over those of programs and libraries that have not passed
# before. Usage: lint.sh SOURCE-FOLDER BUILD-FOLDER [--all]
set -eu
cd "$1"
build=$2
shift 2
git ls-files '*.cpp' '*.hpp' | grep -v '^tests/lint/' |
  xargs -P "$(nproc)" -n 40 clang-format --dry-run --Werror
if git grep -n 'include <hdf5.h>' -- '*.cpp' '*.hpp' ':!formats/trajectory/hdf5.hpp'; then
  echo 'include "formats/trajectory/hdf5.hpp", which chooses the version of the functions of HDF5' >&2
  exit 1
fi
# shellcheck disable=SC2046
tests/lint/tidy.py "$@" "$build" $(git ls-files '*.cpp' | grep -v -e '^tests/' -e '^docs/' -e '^scripts/')
