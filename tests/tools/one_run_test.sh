#!/bin/sh
# A run, what continues it and what repeats it are one run for every tool that takes tables of several, and
# its tables merge whatever their times. Usage: one_run_test.sh SOURCE BIN
set -eu
bin=$2 chute="$1/sim/scenes/chute.ini --length 8dL --depth 16dS --accuracy draft"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
# has TABLE LINE: a line of its header.
has() { grep -q "^# $2$" "$1" || fail "$1 has no line '# $2': $(grep '^#' "$1")"; }
sums() { run=$1; shift; $bin/grseg-stress "$run.h5" --quiet --overwrite "$@"; }

# shellcheck disable=SC2086
$bin/grseg-sim $chute --duration 1 --frame-interval 0.02 --quiet --checkpoint run.chk -o run.h5
# shellcheck disable=SC2086
$bin/grseg-sim $chute --duration 1 --frame-interval 0.02 --quiet --seed 2 -o other.h5
# shellcheck disable=SC2086
$bin/grseg-sim $chute --duration 1 --frame-interval 0.04 --quiet --store float32 -o again.h5
$bin/grseg-sim --restart run.chk --duration 1.6 --quiet -o more.h5
$bin/grseg-sim --restart run.chk --duration 1.6 --quiet --perturb 1e-6 --seed-perturbation 2 -o twin.h5

# Times of run and more are no binary fractions; the window of all is as long as the run.
for window in 0.1 0.2 0.3 0.06; do
  for run in run more; do sums $run --window $window -o $run.tsv; done
  $bin/grseg-merge run.tsv more.tsv --overwrite -o merged.tsv || fail "--window $window does not merge"
  [ "$(grep -c . merged.tsv)" -gt "$(grep -c . run.tsv)" ] || fail "--window $window: $(cat merged.tsv)"
done
for run in run more; do sums $run --window all -o $run.tsv; done
$bin/grseg-merge run.tsv more.tsv --all-windows --overwrite -o merged.tsv
has merged.tsv 'window: 1\.6.*'

for run in run more twin other again; do sums $run --window 0.2 -o $run.tsv; done
$bin/grseg-fit run.tsv more.tsv --quiet --overwrite -o fit.tsv
has fit.tsv 'runs: 1'
has fit.tsv 'windows: 8'
has fit.tsv 'over: windows'
has fit.tsv 'one run: run.tsv more.tsv'
$bin/grseg-fit run.tsv more.tsv twin.tsv other.tsv --quiet --overwrite -o fit.tsv
has fit.tsv 'runs: 2'
has fit.tsv 'one run: run.tsv more.tsv twin.tsv'
grep -q '^# doubt: .*count as tables' fit.tsv && fail "what is known is doubted: $(grep doubt fit.tsv)"

# Half as many frames of the same motion, in single precision; as if a window of one were half that of another.
sums run --window 0.4 -o run.tsv
for command in "grseg-fit run.tsv again.tsv" "grseg-merge run.tsv again.tsv --all-windows"; do
  code=0
  # shellcheck disable=SC2086
  $bin/$command >table 2>words || code=$?
  [ $code = 2 ] && grep -q "both contain the time from 0 s of the same run (bed: grains [0-9]*, .*, seed 1, flow " words ||
    fail "$command: exit code $code: $(cat words)"
done

# Tables that say nothing of their runs are taken for different ones, with a doubt.
for run in run other; do
  sums $run --window 0.2 -o $run.tsv
  grep -v '^# \(bed\|history\|program\|end\)' $run.tsv >hand-$run.tsv
done
$bin/grseg-fit hand-run.tsv hand-other.tsv --quiet --overwrite -o fit.tsv
has fit.tsv 'runs: 2'
has fit.tsv 'doubt: hand-run.tsv, hand-other.tsv count as tables of different runs.*'
