#!/bin/sh
# make -C scripts reproduction.md: every number of docs/studies/reproduction.md, and every figure, follows from
# data/reproduction. Usage: reproduction_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$source/docs/studies/reproduction.md" "$folder"
# Numbers that would not be made again would stay.
sed -i 's/0\.[0-9]*/0/g' "$folder/reproduction.md"
PWD=$folder make --no-print-directory -C "$source/scripts" reproduction.md BIN="$bin" WORK="$folder/work" \
  DOCUMENT="$folder/reproduction.md" PICTURES="$folder/figures" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; exit 1; }
parts() { awk '/^<!-- \// { on = 0 } on; /^<!-- [a-z]/ { on = 1 }' "$1"; }
parts "$source/docs/studies/reproduction.md" >"$folder/there"
parts "$folder/reproduction.md" >"$folder/made"
[ "$(wc -l <"$folder/made")" -gt 80 ]
diff "$folder/there" "$folder/made"
for picture in "$source"/docs/studies/figures/reproduction/*.png; do
  [ "$(head -c 4 "$folder/figures/$(basename "$picture")" | tail -c 3)" = PNG ]
done
! grep -q grseg-sim "$folder/log"
