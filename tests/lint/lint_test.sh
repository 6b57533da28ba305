#!/bin/sh
# Shows that the rules of .clang-tidy fire: each one named in mistakes.cpp must be reported there.
set -eu
source=$(dirname "$0")/mistakes.cpp
report=$(clang-tidy --quiet "$source" -- -std=c++20 2>/dev/null || true)
missing=0
for rule in $(grep -o '// [a-z]*-[A-Za-z.-]*$' "$source" | cut -c4-); do
  case $report in
    *"[$rule"*) ;;
    *) echo "$rule did not fire"; missing=1 ;;
  esac
done
exit $missing
