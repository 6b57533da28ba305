#!/bin/sh
# Where the disk is full (here: no file may be larger than 20 kB) a program says so, ends with exit
# code 1, and an export leaves nothing. Usage: full_disk_test.sh SOURCE BIN
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
trap - XFSZ
ulimit -f 40
fails() {
  "$@" 2>said
  code=$?
  [ $code = 1 ] || { echo "$*: exit code $code: $(cat said)" >&2; exit 1; }
  grep -q "is the disk full?\|File too large; is there a limit (ulimit -f, quota)?" said || { echo "$*: $(cat said)" >&2; exit 1; }
  rm said
}
for export in "vtp -o view" "extxyz -o run.xyz" "extxyz -o run.xyz.gz" "lammps -o run.dump" "h5md3d -o run.h5md"; do
  fails "$bin/grseg-export" "$source/data/sample/chute.h5" --to $export --quiet
  [ -z "$(ls)" ] || { echo "$export leaves $(ls)" >&2; exit 1; }
done
# One frame packed fits into the buffers: only when the file is closed does it reach the disk.
fails "$bin/grseg-export" "$source/data/sample/chute.h5" --begin 19.85 --to extxyz -o run.xyz.gz --quiet
[ -z "$(ls)" ] || { echo "a small packed export leaves $(ls)" >&2; exit 1; }
fails "$bin/grseg-sim" "$source/sim/scenes/chute.ini" --depth 6dS --length 6dL --accuracy draft \
  --duration 5 --quiet -o run.h5
