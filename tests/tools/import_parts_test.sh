#!/bin/sh
# An import in parts, by several processes, gives the bytes of one by one process; parts that are missing, of
# another command or of another archive are named. Usage: import_parts_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
inputs=$source/tests/inputs
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }

# in_parts COUNT OPTIONS ...
in_parts() {
  count=$1
  shift
  $bin/grseg-import "$@" --overwrite -o run.h5 2>whole.log || fail "$(cat whole.log)"
  mv run.h5 whole.h5
  for part in $(seq "$count" -1 1); do $bin/grseg-import "$@" --overwrite -o run.h5 --part "$part/$count" 2>part.log || fail "$(cat part.log)"; done
  $bin/grseg-import "$@" --overwrite -o run.h5 --join "$count" 2>joined.log || fail "$(cat joined.log)"
  cmp whole.h5 run.h5 || fail "$* in $count parts: another file"
  cmp whole.log joined.log || fail "$* in $count parts: another report"
  rm run.h5 run.part-*
}
spheres="--format lammps --grains $source/data/sample/spheres/atoms.dump.gz
  --contacts $source/data/sample/spheres/contacts.dump.gz --units 1:1:1 --step 8.8e-4 --gravity 1 --slope 26
  --axes xz --boundary 1 --small 2 --large 3"
# The balance that an import accepted is no fault of its run.
$bin/grseg-import $spheres --quiet --overwrite -o run.h5
$bin/grseg-check run.h5 --physics --quiet >check.tsv 2>&1 || fail "the run of an accepted import: $(grep failed check.tsv)"
in_parts 3 $spheres
in_parts 13 $spheres --compression 4 # more parts than frames
in_parts 2 $spheres --float32 --begin step:140000
in_parts 3 --format lammps --grains "$inputs/lammps/atoms.dump" --contacts "$inputs/lammps/contacts.dump" --units si \
  --step 1e-5 --gravity 9.8 --slope 23 --boundary 3 --columns i=2,j=3,dist=6,force=7,tangential=10

# A grain that is there for half of the time, falling, and a frame without contacts.
awk 'BEGIN { print "t,id,x,y,vx,vy,fx,fy,d,m" > "grains.csv"; print "t,i,j,fx,fy" > "contacts.csv"
  for (k = 0; k < 12; ++k) {
    t = k * 0.01
    print t ",1,0.5,0,0,0,0,0,0.1,1\n" t ",2,0.5,0.1,0,0,0,0,0.1,1" > "grains.csv"
    s = t - 0.03
    if (k >= 3 && k < 9) printf "%s,3,0.8,%.17g,0,%.17g,0,-10,0.1,1\n", t, 0.6 - 5 * s * s, -10 * s > "grains.csv"
    if (k != 5) print t ",2,1,0,10" > "contacts.csv"
  } }'
in_parts 4 --format csv --grains grains.csv --contacts contacts.csv --units si --step 1e-3 --gravity 10 --slope 0 \
  --boundary-ids 1 --split-diameter 0.2 --grains-are discs --cell x:0:1
grep -q '3 ids in all, between 2 and 3 in a frame' joined.log && grep -q '1 frames have grains but no contacts' joined.log ||
  fail "$(cat joined.log)"

PWD=$folder make --no-print-directory -j2 -C "$source/scripts" import BIN="$bin" SHARDS=2 RUN="env --" \
  IMPORT="$(echo $spheres --overwrite -o run.h5)" >log 2>&1 || fail "$(cat log)"
$bin/grseg-import $spheres --overwrite --quiet -o one.h5
[ "$(grep -c "^cd .*'env' '--' .*--part [12]/2" log)" = 2 ] && [ "$(stat -c %s one.h5)" = "$(stat -c %s run.h5)" ] ||
  fail "make import: $(cat log)"
rm run.h5 run.part-*

refused() {
  code=0
  $bin/grseg-import $spheres --quiet --overwrite -o run.h5 --join 2 "$@" 2>log || code=$?
  [ "$code" = "$expected" ] && grep -q "$sentence" log || fail "code $code, expected $expected: $(cat log)"
}
$bin/grseg-import $spheres --quiet --overwrite -o run.h5 --part 1/2
expected=2 sentence='^grseg-import: run.part-2-of-2.h5 is missing; write it with this command and --part 2/2' refused
$bin/grseg-import $spheres --quiet --overwrite -o run.h5 --part 2/2 --origin centre
expected=3 sentence="run.part-2-of-2.h5: is a part of another import, by '.*--origin centre'" refused
cp run.part-1-of-2.h5 run.part-2-of-2.h5
expected=3 sentence='run.part-2-of-2.h5: is part 1/2, not 2/2; write it with this command' refused
cp whole.h5 run.part-2-of-2.h5
expected=3 sentence='run.part-2-of-2.h5: is not a part of an import' refused
[ ! -e run.h5 ] || fail 'a refused output appeared'
