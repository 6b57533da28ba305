#!/bin/bash
# scripts/reproduce on one small flow: a second call does nothing; a campaign that is killed while it
# simulates and again while it makes tables continues and leaves bitwise identical tables; another partition
# repeats only the fits; another command only its table, and no simulation unless AGAIN=yes asks for it.
# Usage: reproduce_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'kill $(jobs -p) 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
campaign() {
  PWD=$folder make --no-print-directory -C "${scripts:-$source/scripts}" reproduce BIN="$bin" MIXTURES=0.45 SLOPES=23 SEEDS=1 \
    CONTROL_SEEDS=0 DURATION=2 DEPTH=12dS LENGTH=16dS ACCURACY=draft WINDOW=0.25 FIGURES=no CHECKPOINT_EVERY=0.05 "$@"
}
# did COMMAND NUMBER: the last call ran the command that many times.
did() { [ "$(grep -c "^[^#]*$1" log)" = "$2" ] || fail "$1 should run $2 times: $(cat log)"; }
# killed_at FILE: kills the campaign, and all that it started, once that file of the run exists.
killed_at() {
  set -m
  campaign OUT=killed >log 2>&1 &
  set +m
  while [ ! -e "killed/phi0.45-s23-seed1/$1" ] && kill -0 $! 2>/dev/null; do sleep 0.01; done
  kill -9 -- -$!
  wait $! 2>/dev/null || true
  [ ! -e killed/phi0.45-s23-seed1/checksums ] || fail "the campaign ended before it was killed"
}
tables() { (cd "$1" && find . -name '*.tsv' ! -name 'cost*.tsv' -exec sha256sum {} + | sort); }

# The uninterrupted campaign runs beside the one that is killed.
campaign -j2 OUT=whole >whole.log 2>&1 &
whole=$!
killed_at run.chk
killed_at kinetic.tsv
h5dump -d /parameters/history killed/phi0.45-s23-seed1/run.h5 | grep -q 'restart run.chk' ||
  fail "the simulation started from the beginning: $(cat killed/phi0.45-s23-seed1/run.log)"
wait $whole || fail "$(cat whole.log)"
cp whole.log log
did 'campaign simulate' 1
[ ! -e whole/phi0.45-s23-seed1/run.h5 ] || fail "the trajectory was not deleted"
(cd whole/phi0.45-s23-seed1 && sha256sum --quiet -c checksums) || fail "the checksums are wrong"
campaign OUT=whole >log 2>&1
did grseg- 0

campaign OUT=killed >log 2>&1 || fail "$(cat log)"
did 'campaign simulate' 0
did grseg-stress 0
[ "$(tables whole)" = "$(tables killed)" ] || fail "tables differ after kills: $(diff <(tables whole) <(tables killed))"
[ -z "$(find killed -name '*.part' -o -name 'run.*' ! -name run.log)" ] || fail "temporary files remain: $(ls killed/*)"

campaign OUT=whole PARTITION=uniform:0.8 >log 2>&1
did 'campaign table' 0
did 'campaign fits' 1
grep -q 'uniform:0.8' whole/rules.tsv || fail "the new partition is missing from the fits: $(cat log)"

# refused TABLES WORDS: the campaign stops because the trajectory is missing, and changes nothing.
refused() {
  campaign OUT=whole PARTITION=uniform:0.8 "${@:2}" >log 2>&1 && fail "tables were made without a trajectory: $(cat log)"
  grep -q "phi0.45-s23-seed1: $1: missing, or made by another.*AGAIN=yes" log || fail "the reason is not given: $(cat log)"
  did 'campaign simulate' 0
}
refused 'check.tsv stress.tsv .*' WINDOW=0.5
(cd whole/phi0.45-s23-seed1 && sha256sum --quiet -c checksums) || fail "a refusal changed tables"
rm whole/phi0.45-s23-seed1/micro.tsv
refused micro.tsv
campaign -j2 OUT=whole PARTITION=uniform:0.8 AGAIN=yes KEEP=1 >log 2>&1
did 'campaign simulate' 1
(cd whole/phi0.45-s23-seed1 && sha256sum --quiet -c checksums) || fail "a table that was lost is different after it was made again"
sed -i 's/--assign branch/--assign grain/' whole/phi0.45-s23-seed1/stress-branch.tsv
campaign OUT=whole PARTITION=uniform:0.8 KEEP=1 >log 2>&1
did 'campaign simulate' 0
did 'campaign table' 1
did 'table stress-branch.tsv' 1
[ "$(tables whole | grep -v rules.tsv)" = "$(tables killed | grep -v rules.tsv)" ] || fail "a table made by another command was not made again"
campaign -j2 OUT=whole PARTITION=uniform:0.8 KEEP=1 WINDOW=0.5 >log 2>&1
did 'campaign simulate' 0
did "grseg-.*'--window' '0.5'" 17

code=0
make -C "$source/scripts/reproduce" run NAME=phi0.45-s23-seed9 BIN="$bin" OUT="$folder/whole" >log 2>&1 || code=$?
{ [ $code = 2 ] && grep -q "phi0.45-s23-seed9: unknown run; make names lists the runs" log; } || fail "an unknown run: $(cat log)"
/usr/bin/python3 "$source/scripts/reproduce/campaign" scene phi0.45-x3 1 1 1 1 1 >log 2>&1 && fail "an unknown word in a name: $(cat log)"
grep -q "scene: phi0.45-x3: 'x3' is not a part of a run's name" log || fail "$(cat log)"

# A command that fails ends the campaign; it changes no scene, and nothing is simulated again.
cp -r "$source/scripts" broken
scene=$(cksum whole/phi0.45-s23-seed1/scene.ini)
for command in scene outdated; do
  sed "s/^def $command(options):/&\n    sys.exit('$command: out of order')/" "$source/scripts/reproduce/campaign/run.py" >broken/reproduce/campaign/run.py
  scripts=$folder/broken campaign OUT=whole PARTITION=uniform:0.8 KEEP=1 WINDOW=0.5 >log 2>&1 && fail "$command fails, and the campaign goes on: $(cat log)"
  grep -q "^$command: out of order" log || fail "$(cat log)"
  did 'campaign simulate' 0
  did 'campaign table' 0
  [ "$(cksum whole/phi0.45-s23-seed1/scene.ini)" = "$scene" ] || fail "$command fails, and the scene is changed: $(cat log)"
done
grep -q 'phi0.45-s23-seed1: which tables are outdated is unknown' log || fail "no reason is given: $(cat log)"

# A run of the control, whose labels are drawn anew after it, has all tables of a question.
PWD=$folder make --no-print-directory -C "$source/scripts/reproduce" run NAME=phi0.45-s23-ratio1-t60-seed1 BIN="$bin" OUT=control \
  DEPTH=12dS LENGTH=16dS ACCURACY=draft >log 2>&1 || fail "the control was not reduced: $(cat log)"
grep -q '^# verified: no (--trust)' control/phi0.45-s23-ratio1-t60-seed1/stress-random.tsv || fail "drawn labels break the seal"
