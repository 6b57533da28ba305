#!/bin/bash
# scripts/reproduce, on one small flow and its control: a second call does nothing; a campaign killed
# while it simulates and while it makes tables goes on and leaves the same bytes; another partition redoes
# the fits alone; another command its table, but no simulation unless it is asked for. Usage: reproduce_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
campaign() {
  PWD=$folder make --no-print-directory -C "$source/scripts" reproduce BIN="$bin" MIXTURES=0.45 SLOPES=23 SEEDS=1 \
    CONTROL_SEEDS=0 DURATION=2 DEPTH=12dS LENGTH=16dS ACCURACY=draft WINDOW=0.25 BOOTSTRAP=0 FIGURES=no CHECKPOINT_EVERY=0.05 "$@"
}
# did COMMAND NUMBER: how often the last call called it.
did() { [ "$(grep -c "^[^#]*$1" log)" = "$2" ] || fail "$1 was to be called $2 times: $(cat log)"; }
# killed_at FILE: the campaign killed, with all it started, when that file of the run is there.
killed_at() {
  set -m
  campaign OUT=killed >log 2>&1 &
  set +m
  while [ ! -e "killed/phi0.45-s23-seed1/$1" ] && kill -0 $! 2>/dev/null; do sleep 0.01; done
  kill -9 -- -$!
  wait $! 2>/dev/null || true
  [ ! -e killed/phi0.45-s23-seed1/checksums ] || fail "the campaign was done before it was killed"
}
tables() { (cd "$1" && find . -name '*.tsv' ! -name 'cost*.tsv' -exec sha256sum {} + | sort); }

campaign OUT=whole >log 2>&1 || fail "$(cat log)"
did reproduce/simulate 1
[ ! -e whole/phi0.45-s23-seed1/run.h5 ] || fail "the trajectory is still there"
(cd whole/phi0.45-s23-seed1 && sha256sum --quiet -c checksums) || fail "checksums do not hold"
campaign OUT=whole >log 2>&1
did grseg- 0

killed_at run.chk
killed_at kinetic.tsv
h5dump -d /parameters/history killed/phi0.45-s23-seed1/run.h5 | grep -q 'restart run.chk' ||
  fail "the simulation began anew: $(cat killed/phi0.45-s23-seed1/run.log)"
campaign OUT=killed >log 2>&1 || fail "$(cat log)"
did reproduce/simulate 0
did grseg-stress 0
[ "$(tables whole)" = "$(tables killed)" ] || fail "kills changed: $(diff <(tables whole) <(tables killed))"
[ -z "$(find killed -name '*.part' -o -name 'run.*' ! -name run.log)" ] || fail "something was left behind: $(ls killed/*)"

campaign OUT=whole PARTITION=uniform:0.8 >log 2>&1
did reproduce/ 0
did ./fits 1
grep -q 'uniform:0.8' whole/rules.tsv || fail "another partition is not in the fits: $(cat log)"

# refused TABLES WORDS: the campaign stops for want of the trajectory, and leaves what is there.
refused() {
  campaign OUT=whole PARTITION=uniform:0.8 "${@:2}" >log 2>&1 && fail "made without a trajectory: $(cat log)"
  grep -q "phi0.45-s23-seed1: $1: not there, or made by another.*AGAIN=yes" log || fail "not told: $(cat log)"
  did reproduce/simulate 0
}
refused 'check.tsv stress.tsv .*' WINDOW=0.5
(cd whole/phi0.45-s23-seed1 && sha256sum --quiet -c checksums) || fail "a refusal changed tables"
rm whole/phi0.45-s23-seed1/micro.tsv
refused micro.tsv
campaign OUT=whole PARTITION=uniform:0.8 AGAIN=yes KEEP=1 >log 2>&1
did reproduce/simulate 1
(cd whole/phi0.45-s23-seed1 && sha256sum --quiet -c checksums) || fail "a table that was lost came back different"
sed -i 's/--assign branch/--assign grain/' whole/phi0.45-s23-seed1/stress-branch.tsv
campaign OUT=whole PARTITION=uniform:0.8 KEEP=1 >log 2>&1
did reproduce/simulate 0
did 'reproduce/table' 1
did 'table stress-branch.tsv' 1
[ "$(tables whole | grep -v rules.tsv)" = "$(tables killed | grep -v rules.tsv)" ] || fail "a table by another command did not come back"
campaign OUT=whole PARTITION=uniform:0.8 KEEP=1 WINDOW=0.5 >log 2>&1
did reproduce/simulate 0
did 'grseg-.*--window 0.5' 17

code=0
make -C "$source/scripts/reproduce" run NAME=phi0.45-s23-seed9 BIN="$bin" OUT="$folder/whole" >log 2>&1 || code=$?
{ [ $code = 2 ] && grep -q "phi0.45-s23-seed9: there is no such run; make names lists them" log; } || fail "an unknown run: $(cat log)"
"$source/scripts/reproduce/scene" phi0.45-x3 1 1 1 1 1 >log 2>&1 && fail "an unknown word in a name: $(cat log)"
grep -q "scene: phi0.45-x3: 'x3' is no part of the name of a run" log || fail "$(cat log)"
