#!/bin/sh
# Sums made in parts by several processes are those of one process, byte for byte; a part that is missing
# or of another table is named. Usage: shards_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
cp "$source/data/sample/chute.h5" chute.h5
$bin/grseg-import --format lammps --grains "$source/data/sample/spheres/atoms.dump.gz" \
  --contacts "$source/data/sample/spheres/contacts.dump.gz" --units 1:1:1 --step 8.8e-4 --gravity 1 --slope 26 \
  --axes xz --boundary 1 --small 2 --large 3 --quiet -o spheres.h5

# in_parts COUNT COMMAND ...: as one process, and in parts whose order does not matter.
in_parts() {
  count=$1
  shift
  "$@" --quiet --overwrite -o sums.tsv
  mv sums.tsv whole.tsv
  for part in $(seq "$count" -1 1); do "$@" --quiet --overwrite -o sums.tsv --part "$part/$count"; done
  "$@" --quiet --overwrite -o sums.tsv --join "$count"
  cmp whole.tsv sums.tsv || fail "$* in $count parts"
  rm sums.tsv sums.part-*
}
for tool in stress kinetic micro; do
  in_parts 3 $bin/grseg-$tool chute.h5 --window 2
  in_parts 12 $bin/grseg-$tool chute.h5 --window 2 --threads 2 # more parts than windows
  in_parts 4 $bin/grseg-$tool spheres.h5 --window 8
done
in_parts 2 $bin/grseg-stress chute.h5 --bins xy --layer 4dS
in_parts 2 $bin/grseg-forces chute.h5 --window 5

refused() {
  code=0
  $bin/grseg-stress chute.h5 --quiet --overwrite -o sums.tsv --join 2 "$@" 2>log || code=$?
  [ "$code" = "$expected" ] && grep -q "$sentence" log || fail "code $code, expected $expected: $(cat log)"
}
$bin/grseg-stress chute.h5 --quiet --overwrite -o sums.tsv --part 1/2
expected=2 sentence='^grseg-stress: sums.part-2-of-2.tsv is missing; make it with this command and --part 2/2' refused
cp sums.part-1-of-2.tsv sums.part-2-of-2.tsv
expected=3 sentence="'# part: 1/2' instead of '# part: 2/2'" refused
expected=3 sentence="'# history: grseg-stress chute.h5 .* instead of '# history: .*--layer 2dS" refused --layer 2dS
[ ! -e sums.tsv ] || fail 'a refused output appeared'

again() { PWD=$folder make --no-print-directory -j2 -C "$source/scripts" reanalysis BIN="$bin" WINDOW=2 RUNS=chute.h5 "$@"; }
again >log
mv reanalysis whole
again SHARDS=10 RUN="env --" >log
[ "$(grep -c "^'env' '--' .*--part [01][0-9]/10" log)" = 30 ] || fail "not in 10 parts: $(cat log)"
for file in fit scan kinetic-fit chute.stress chute.kinetic chute.micro; do
  cmp "whole/$file.tsv" "reanalysis/$file.tsv" || fail "make with SHARDS=10: $file.tsv"
done
! again SHARDS=few >log 2>&1 && grep -q 'SHARDS must be a whole number' log || fail "$(cat log)"
