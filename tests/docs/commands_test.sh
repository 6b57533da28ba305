#!/bin/sh
# Runs the commands of a page, in order, in an empty folder that looks like a clone after
# scripts/build: every ```sh block behind a line "<!-- these commands are a test". A command fails
# the page, and so does a file that -o, --output or --checkpoint names and that is not there in the
# end. Usage: commands_test.sh SOURCE BUILD PAGE [BLOCKS], PAGE from SOURCE, BLOCKS at least (1)
set -eu
source=$1 build=$2 page=$3 least=${4:-1}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/build"
for name in analysis data docs scripts sim tests; do ln -s "$source/$name" "$folder"; done
ln -s "$build/bin" "$folder/build/bin"
awk '/^<!-- these commands are a test/ { marked = 1; next }
     marked && /^```sh$/ { marked = 0; inside = 1; ++blocks; next }
     marked && NF { print "no ```sh block behind the mark above: " $0 >"/dev/stderr"; exit 1 }
     /^```$/ { inside = 0 }
     inside { print }
     END { print blocks + 0 >"'"$folder/blocks"'" }' "$source/$page" >"$folder/commands"
blocks=$(cat "$folder/blocks")
[ "$blocks" -ge "$least" ] || { echo "$page: $blocks blocks of commands, expected $least" >&2; exit 1; }
cd "$folder"
# BIN: for make, a build folder elsewhere; PATH: the Python whose packages scripts/setup installs
BIN="$build/bin" PATH="/usr/bin:$PATH" PYTHONDONTWRITEBYTECODE=1 sh -eu commands >said 2>&1 || {
  cat said >&2
  echo "$page: a command fails" >&2
  exit 1
}
tr -s ' \\\n' '\n' <commands | sed 's/#.*//' |
  awk '/^(-o|--output|--checkpoint)$/ { next_is = 1; next } next_is { print; next_is = 0 }' |
  sort -u | while read -r file; do
    [ -e "$file" ] || [ "$file" = /dev/null ] || { echo "$page: $file was not written" >&2; exit 1; }
  done
