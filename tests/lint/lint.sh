#!/bin/sh
# clang-format over all sources, clang-tidy over those of programs and libraries.
# Usage: lint.sh SOURCE-FOLDER BUILD-FOLDER
set -eu
cd "$1"
sources=$(git ls-files '*.cpp' '*.hpp' | grep -v '^tests/lint/')
# shellcheck disable=SC2086
clang-format --dry-run --Werror $sources
git ls-files '*.cpp' | grep -v '^tests/' | xargs tests/lint/tidy.py "$2"
