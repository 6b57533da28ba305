#!/bin/sh
# Shows that the rules of .clang-tidy fire: each one named in mistakes.cpp must be reported there, also
# where that file is looked at together with another one. Usage: lint_test.sh, in the source folder
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mistakes=tests/lint/mistakes.cpp
echo 'int none() { return 0; }' >"$folder/clean.cpp"
cat >"$folder/compile_commands.json" <<EOF
[{"directory": "$PWD", "file": "$PWD/$mistakes", "command": "c++ -std=c++20 -o m.o -c $PWD/$mistakes"},
 {"directory": "$PWD", "file": "$folder/clean.cpp", "command": "c++ -std=c++20 -o c.o -c $folder/clean.cpp"}]
EOF

# all_fire WHERE REPORT
all_fire() {
  for rule in $(grep -o '// [a-z]*-[A-Za-z.-]*$' "$mistakes" | cut -c4-); do
    case $2 in
      *"[$rule"*) ;;
      *) echo "$rule did not fire $1"; missing=1 ;;
    esac
  done
}
missing=0 code=0
report=$(tests/lint/tidy.py "$folder" "$folder/clean.cpp" $mistakes 2>&1) || code=$?
[ $code = 1 ] || { echo "exit code $code where there are mistakes"; missing=1; }
all_fire "in its file" "$report"
case $report in *"$mistakes:5:"*) ;; *) echo "file and line are not named: $report"; missing=1 ;; esac
# Nothing else tells whether a rule fires in a text of several files.
both=$(clang-tidy --quiet --config-file=.clang-tidy -p "$folder/lint" "$folder/lint/0.cpp" 2>/dev/null || true)
all_fire "in a text of two files" "$both"
[ "$(tests/lint/tidy.py "$folder" "$folder/clean.cpp" 2>&1)" = "" ] || { echo "a clean file fails"; missing=1; }
exit $missing
