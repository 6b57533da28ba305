#!/bin/sh
# Runs the three commands of README.md in an empty folder: table and page hold the same B by size, which README states.
# Usage: readme_test.sh SOURCE BUILD
set -eu
source=$1 build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/build"
ln -s "$source/data" "$source/scripts" "$folder"
ln -s "$build/bin" "$folder/build/bin"
commands=$(sed -n '/^<!-- these commands are a test/,/^```$/p' "$source/README.md" | grep -v '^<!--\|^```')
[ "$(echo "$commands" | wc -l)" = 3 ]
cd "$folder"
sh -euc "$commands"
[ "$(grep -vc '^#' scan.tsv)" = 102 ]
[ "$(head -c 4 b-of-p.png | tail -c 3)" = PNG ]
[ "$(head -c 15 explore.html)" = '<!DOCTYPE html>' ]
[ "$(wc -c <"$source/data/sample/paper-chute.h5")" -lt 4000000 ]
stated=$(awk -F '\t' '$1 == "size" && $5 == "B" { printf "B = %.3f [%.3f, %.3f]", $7, $8, $9 }' stock.tsv)
grep -qF "$stated by size" "$source/README.md"
# same QUANTITY RULE: value, low and high in the table are those of the page, to ten digits.
ten_digits='{ printf "%.10f %.10f %.10f", $(NF - 2), $(NF - 1), $NF }'
same() {
  in_table=$(awk -F '\t' -v rule="$2" -v quantity="$1" '$1 == rule && $5 == quantity' stock.tsv | cut -f 7-9 | awk "$ten_digits")
  in_page=$(grep -o "\"$1\":\[-\{0,1\}[0-9.]*,[-0-9.]*,[-0-9.]*" explore.html | head -n 1 | tr '[,' '  ' | awk "$ten_digits")
  [ "$in_table" = "$in_page" ] || { echo "$1: $in_table in the table, $in_page in the page" >&2; exit 1; }
}
same B size
same p_zero -
