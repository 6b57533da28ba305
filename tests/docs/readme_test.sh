#!/bin/sh
# Runs the four commands of README.md in an empty folder and looks at what they leave. Usage:
# readme_test.sh SOURCE BUILD
set -eu
source=$1 build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/build"
ln -s "$source/data" "$source/scripts" "$folder"
ln -s "$build/bin" "$folder/build/bin"
commands=$(sed -n '/^<!-- these commands are a test/,/^```$/p' "$source/README.md" | grep -v '^<!--\|^```')
[ "$(echo "$commands" | wc -l)" = 4 ]
cd "$folder"
sh -euc "$commands"
[ "$(grep -vc '^#' scan.tsv)" = 102 ]
[ "$(head -c 4 b-of-p.png | tail -c 3)" = PNG ]
[ "$(head -c 15 explore.html)" = '<!DOCTYPE html>' ]
