#!/bin/sh
# make -C scripts reanalysis: another partition repeats the fits alone, another layer or window also the
# sums, and the run is never touched. Usage: reanalysis_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
$bin/grseg-sim "$source/sim/scenes/chute.ini" --depth 10dS --length 10dL --phi-large 0.5 \
  --accuracy draft --quiet --duration 3 -o run.h5
cp run.h5 twin.h5
digest=$(cksum run.h5)

again() { PWD=$folder make --no-print-directory -C "$source/scripts" reanalysis BIN="$bin" WINDOW=0.5 HEIGHTS=all RUNS=run.h5 "$@"; }
again >log
[ -s reanalysis/fit.tsv ] && [ -s reanalysis/run.stress.tsv ] || fail "$(cat log)"
grep -q '^rule  *B \[95 %\]  ' log && grep -q '^size  ' log && grep -q '^kinetic  ' log && grep -q '^B = 0 if' log ||
  fail "no short table: $(cat log)"
grep -q 'degrees_of_freedom' log && fail "the whole table is printed: $(cat log)"
head -c 9 reanalysis/fit.tsv | grep -q '# program' || fail "fit.tsv is not the whole table"
again >log
grep -q 'bin/grseg' log && fail "commands were run although nothing changed: $(cat log)"
again PARTITION=uniform:0.8 >log
[ "$(grep -c 'bin/grseg-' log)" = 1 ] && grep -q 'grseg-fit.*uniform:0.8' log ||
  fail "another partition: $(cat log)"
again PARTITION=uniform:0.8 LAYER=5dS >log
[ "$(grep -c 'grseg-stress\|grseg-kinetic\|grseg-micro' log)" = 3 ] || fail "another layer: $(cat log)"
cp reanalysis/fit.tsv before.tsv
! again LAYER=5dS PARTITION=nonsense >log 2>&1 || fail "an unknown rule was taken"
cmp -s reanalysis/fit.tsv before.tsv && [ -s reanalysis/fit.txt ] || fail "an unknown rule took the fit before with it: $(cat log)"
! again PARTITIONS=size >log 2>&1 || fail "an unknown variable was taken"
grep -q 'PARTITIONS is unknown here' log || fail "an unknown variable: $(cat log)"
PWD=$folder make --no-print-directory -C "$source/scripts" figure BIN="$bin" WINDOW=0.5 \
  LAYER=5dS RUNS=run.h5 HEIGHTS=5dS: >log 2>&1
[ "$(grep -c 'bin/grseg-' log)" = 2 ] && [ "$(head -c 4 reanalysis/b-of-p.png | tail -c 3)" = PNG ] ||
  fail "the figure: $(cat log)"
grep -q grseg-sim log && fail "the figure simulated again"
# A figure that is refused leaves an earlier picture as it is.
cp -r reanalysis refused
sed -i 's/^# input: /&0/' refused/stock.tsv
! gnuplot -c "$source/scripts/figures/b-of-p.gp" refused >log 2>&1 || fail "tables of different runs are drawn"
grep -q 'scan.tsv and stock.tsv of ./refused are of different runs' log || fail "$(cat log)"
cmp -s refused/b-of-p.png reanalysis/b-of-p.png || fail "a refused figure took the picture before with it"
mv refused/b-of-p.png refused/segregation.png
! gnuplot -c "$source/scripts/figures/segregation.gp" refused >log 2>&1 || fail "a missing table is drawn"
cmp -s refused/segregation.png reanalysis/b-of-p.png || fail "a missing table took the picture before with it"
[ "$(cksum run.h5)" = "$digest" ] || fail "the run was touched"
code=0
again RUNS="run.h5 $folder/other/run.h5" >log 2>&1 || code=$?
[ "$code" != 0 ] && grep -q 'the same name' log || fail "two runs of one name: $(cat log)"
