#!/bin/sh
# make -C scripts reproduction.md three-dimensions.md: every generated number of these pages of docs/studies and of the annex, and
# every figure, follows from data/reproduction. Usage: reproduction_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
pages="reproduction reproduction-annex three-dimensions"
for page in $pages; do
  # A number that is not generated again keeps the changed digits.
  sed 's/0\.[0-9]*/0/g' "$source/docs/studies/$page.md" >"$folder/$page.md"
done
PWD=$folder make -j2 --no-print-directory -C "$source/scripts" reproduction.md BIN="$bin" WORK="$folder/work" \
  DOCUMENT="$folder/reproduction.md" ANNEX="$folder/reproduction-annex.md" PICTURES="$folder/figures" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
parts() { awk '/^<!-- \// { on = 0 } on; /^<!-- [a-z]/ { on = 1 }' "$1"; }
PWD=$folder make --no-print-directory -C "$source/scripts" three-dimensions.md BIN="$bin" WORK="$folder/work" \
  SPHERES="$folder/three-dimensions.md" >>"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
for page in $pages; do
  parts "$source/docs/studies/$page.md" >"$folder/kept"
  parts "$folder/$page.md" >"$folder/made"
  [ "$(wc -l <"$folder/made")" -gt 19 ]
  diff "$folder/kept" "$folder/made"
done
for picture in "$source"/docs/studies/figures/reproduction/*.png; do
  [ "$(head -c 4 "$folder/figures/$(basename "$picture")" | tail -c 3)" = PNG ]
done
# The same figure as a PDF.
PWD=$folder make --no-print-directory -C "$source/scripts" figures/step.pdf figures/kinetic-ratio.pdf BIN="$bin" WORK="$folder/work" >>"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
for name in step kinetic-ratio; do [ "$(head -c 5 "$folder/work/$name.pdf")" = %PDF- ]; done
! grep -q grseg-sim "$folder/log"
