#!/bin/sh
# Shows that the rules of .clang-tidy fire: each one named in mistakes.cpp must be reported there, and, but for
# those of the analyzer, also where CMake has joined that file with others. Usage: lint_test.sh, in the source folder
set -eu
folder=$(mktemp -d -p .)
trap 'rm -rf "$folder"' EXIT
mistakes=tests/lint/mistakes.cpp
echo "#include \"$PWD/$mistakes\"" >"$folder/joined.cpp"
failed=0
for file in "$mistakes" "$folder/joined.cpp"; do
  # clang-tidy fails, as it is meant to find mistakes.
  report=$(clang-tidy --quiet "$file" -- -std=c++20 2>&1 || true)
  for rule in $(grep -o '// [a-z]*-[A-Za-z.-]*$' "$mistakes" | cut -c4-); do
    case $file:$report in
      *joined*) case $rule in clang-analyzer-*) continue ;; esac ;;
    esac
    case $report in
      *"$mistakes:"*"[$rule"*) ;;
      *) echo "$rule did not fire in $file"; failed=1 ;;
    esac
  done
done
exit $failed
