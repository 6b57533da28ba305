#!/bin/sh
# Where a write is refused (here: by a limit on file sizes) a program says so, ends with exit code 1,
# and an export leaves nothing; the same where the folder goes away. Usage: full_disk_test.sh SOURCE BIN
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
# At every kind of output, with what is left.
"$source/scripts/full-disk-trials" --bin "$bin" --only quota,removed >table || { cat table >&2; exit 1; }
ulimit -f 40
fails() {
  "$@" 2>said
  code=$?
  [ $code = 1 ] || { echo "$*: exit code $code: $(cat said)" >&2; exit 1; }
  grep -q "File too large; is there a limit (ulimit -f, quota)?" said || { echo "$*: $(cat said)" >&2; exit 1; }
  rm said
}
rm table
fails "$bin/grseg-export" "$source/data/sample/chute.h5" --to extxyz -o run.xyz.gz --quiet
[ -z "$(ls)" ] || { echo "a packed export leaves $(ls)" >&2; exit 1; }
# One frame packed fits into the buffers: only when the file is closed does it reach the disk.
fails "$bin/grseg-export" "$source/data/sample/chute.h5" --begin 19.85 --to extxyz -o run.xyz.gz --quiet
[ -z "$(ls)" ] || { echo "a small packed export leaves $(ls)" >&2; exit 1; }
fails "$bin/grseg-sim" "$source/sim/scenes/chute.ini" --depth 6dS --length 6dL --accuracy draft \
  --duration 5 --quiet -o run.h5
