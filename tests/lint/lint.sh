#!/bin/sh
# clang-format and clang-tidy over all sources. Usage: lint.sh SOURCE-FOLDER BUILD-FOLDER
set -eu
cd "$1"
sources=$(git ls-files '*.cpp' '*.hpp' | grep -v '^tests/lint/')
# shellcheck disable=SC2086
clang-format --dry-run --Werror $sources
git ls-files '*.cpp' | grep -v '^tests/' |
  xargs -P "$(nproc)" -n 1 clang-tidy --quiet -p "$2"
