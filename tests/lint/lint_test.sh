#!/bin/sh
# Shows that the rules of .clang-tidy fire: each one named in mistakes.cpp must be reported there, also
# where that file is checked together with another one; and that only what has passed unchanged is
# skipped. Usage: lint_test.sh, in the source folder
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mistakes=tests/lint/mistakes.cpp
tidy=$PWD/tests/lint/tidy.py
echo 'int none() { return 0; }' >"$folder/clean.cpp"
cat >"$folder/compile_commands.json" <<JSON
[{"directory": "$PWD", "file": "$PWD/$mistakes", "command": "c++ -std=c++20 -o m.o -c $PWD/$mistakes"},
 {"directory": "$PWD", "file": "$folder/clean.cpp", "command": "c++ -std=c++20 -o c.o -c $folder/clean.cpp"}]
JSON

failed=0
wrong() { echo "$1"; failed=1; }
# all_fire WHERE REPORT
all_fire() {
  for rule in $(grep -o '// [a-z]*-[A-Za-z.-]*$' "$mistakes" | cut -c4-); do
    case $2 in
      *"[$rule"*) ;;
      *) wrong "$rule did not fire $1" ;;
    esac
  done
}
code=0
report=$($tidy "$folder" "$folder/clean.cpp" $mistakes 2>&1) || code=$?
[ $code = 1 ] || wrong "exit code $code where there are mistakes"
all_fire "in its file" "$report"
case $report in *"$mistakes:5:"*) ;; *) wrong "file and line are not named: $report" ;; esac
# Nothing else shows whether a rule fires in a text of several files. clang-tidy fails, as it is meant to find mistakes.
both=$(clang-tidy --quiet --config-file=.clang-tidy -p "$folder/lint" "$folder/lint/0.cpp" 2>/dev/null || true)
all_fire "in a text of two files" "$both"

# What has passed is skipped, what has not is not, and --all skips nothing.
[ "$($tidy "$folder" "$folder/clean.cpp" 2>&1)" = "" ] || wrong "a file that has passed is checked again"
code=0
$tidy "$folder" "$folder/clean.cpp" $mistakes >/dev/null 2>"$folder/words" || code=$?
[ "$code $(cat "$folder/words")" = "1 lint: clang-tidy checks 1 of 2 files" ] || wrong "the second time: $code $(cat "$folder/words")"
case $($tidy --all "$folder" "$folder/clean.cpp" 2>&1) in *"checks 1 of 1 files"*) ;; *) wrong "--all skips files" ;; esac

# Fingerprints are those of the content: the same in two checkouts and with other lines of comment,
# others where a header, a rule or a compiler option is another.
# checkout FOLDER OPTION: one of a source and its header.
checkout() {
  mkdir -p "$folder/$1/formats" "$folder/$1/build"
  cp .clang-tidy "$folder/$1"
  printf '#include "formats/clean.hpp"\nint none() { return 0; }\n' >"$folder/$1/formats/clean.cpp"
  echo 'int none();' >"$folder/$1/formats/clean.hpp"
  at=$folder/$1
  cat >"$at/build/compile_commands.json" <<JSON
[{"directory": "$at/build", "file": "$at/formats/clean.cpp",
  "command": "$3c++ -I$at -I$at/build/formats $2 -std=c++20 -o formats/clean.o -c $at/formats/clean.cpp"}]
JSON
}
fingerprint() { (cd "$folder/$1" && $tidy build formats/clean.cpp 2>/dev/null && cat build/lint/passed.txt); }
checkout one -O3 ''
first=$(fingerprint one)
case $first in *"  formats/clean.cpp") ;; *) wrong "a clean file does not pass: $first" ;; esac
checkout two '-O3 -Werror' '/usr/bin/ccache '
[ "$(fingerprint two)" = "$first" ] || wrong "another checkout has other fingerprints"
checkout three -O0 ''
[ "$(fingerprint three)" != "$first" ] || wrong "a compiler option is not noticed"
printf '// A line of comment decides nothing.\nint none();\n' >"$folder/one/formats/clean.hpp"
[ "$(fingerprint one)" = "$first" ] || wrong "a line of comment is noticed"
printf '// NOLINTNEXTLINE\nint none();\n' >"$folder/one/formats/clean.hpp"
[ "$(fingerprint one)" != "$first" ] || wrong "a comment that silences a rule is not noticed"
echo 'int none(); // none' >"$folder/one/formats/clean.hpp"
[ "$(fingerprint one)" != "$first" ] || wrong "a changed header is not noticed"
echo '# a rule' >>"$folder/two/.clang-tidy"
[ "$(fingerprint two)" != "$first" ] || wrong "a changed rule is not noticed"
exit $failed
