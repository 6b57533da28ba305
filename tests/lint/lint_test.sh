#!/bin/sh
# Shows that the rules of .clang-tidy fire: each one named in mistakes.cpp must be reported there.
set -eu
source=$(dirname "$0")/mistakes.cpp
# Its exit code is that of a file with mistakes, as it should be; what counts is the report.
report=$(clang-tidy --quiet "$source" -- -std=c++20 2>/dev/null || true)
missing=0
for rule in $(grep -o '// [a-z]*-[A-Za-z.-]*$' "$source" | cut -c4-); do
  case $report in
    *"[$rule"*) ;;
    *) echo "$rule did not fire"; missing=1 ;;
  esac
done
exit $missing
