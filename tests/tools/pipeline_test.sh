#!/bin/sh
# The whole way on a small chute: scene, run, sums, B. The same input gives the same bytes; an
# interrupted run keeps its frames. Usage: pipeline_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
small="$source/sim/scenes/chute.ini --depth 10dS --length 10dL --phi-large 0.5 --accuracy draft --quiet"

# shellcheck disable=SC2086
$bin/grseg-sim $small --duration 3 -o a.h5
# shellcheck disable=SC2086
$bin/grseg-sim $small --duration 3 -o b.h5
$bin/grseg-stress a.h5 --window 0.5 --quiet | grep -v '^# \(history\|end\)' >a.tsv
$bin/grseg-stress b.h5 --window 0.5 --quiet | grep -v '^# \(history\|end\)' >b.tsv
cmp a.tsv b.tsv || fail "the same scene gave different runs"
grep -q '^# input: xxh3 [0-9a-f]\{16\}$' a.tsv || fail "no content digest"

# Standard input and a file give the same B.
$bin/grseg-stress a.h5 --window 0.5 -o sums.tsv --quiet
$bin/grseg-fit sums.tsv --heights all --quiet | grep -v '^#' >file.txt
$bin/grseg-stress a.h5 --window 0.5 --quiet | $bin/grseg-fit - --heights all --quiet | grep -v '^#' >pipe.txt
cmp file.txt pipe.txt || fail "a pipe and a file differ"

# The tables of all tools have the same windows and layers, so that their rows can be joined.
$bin/grseg-kinetic a.h5 --window 0.5 --quiet | grep -v '^#' | cut -f 1-6 >keys-kinetic
grep -v '^#' a.tsv | cut -f 1-6 >keys-stress
cmp keys-kinetic keys-stress || fail "grseg-kinetic and grseg-stress have different rows"
$bin/grseg-balance a.h5 --window 0.5 -o balance.tsv 2>words
grep -v '^#' balance.tsv | cut -f 1-6 >keys-balance
cmp keys-balance keys-stress || fail "grseg-balance and grseg-stress have different rows"

# A tolerance of the solver that a draft misses is said to be that of another preset.
! $bin/grseg-check a.h5 --physics --largest-overlap 1e-9 --quiet -o check.tsv 2>/dev/null || fail "an overlap above its tolerance passes"
grep -q '^overlap_largest.*failed.*the tolerance is for --accuracy standard, and this run is a draft' check.tsv || fail "no preset is named: $(grep overlap check.tsv)"

# In a true run every momentum balance closes to round-off.
closes=$(sed -n 's/^grseg-balance: .*the balances close to \([0-9.e-]*\) of .*/\1/p' words)
awk -v r="$closes" 'BEGIN {exit !(r != "" && r < 1e-10)}' || fail "the balances do not close: $(cat words)"
"$source/scripts/profile" --balance balance.tsv >profile.tsv
[ "$(wc -l <profile.tsv)" -gt 3 ] || fail "no profile of the balance"

# SIGINT: exit code 130; the frames so far are readable as NAME.part, and NAME does not exist.
# (A background job of a script ignores SIGINT, so `timeout` sends it.)
# On a busy machine two seconds end before the first frame, so it may try again for longer.
for seconds in 2 8 32; do
  code=0
  rm -f long.h5.part
  # shellcheck disable=SC2086
  timeout --preserve-status -s INT $seconds $bin/grseg-sim $small --duration 1000 -o long.h5 2>words || code=$?
  ! $bin/grseg-stress long.h5.part --window 0.1 --quiet >/dev/null 2>&1 || break
done
[ "$code" = 130 ] || fail "exit code $code after SIGINT"
grep -q 'interrupted at t = .*; the frames so far are in long.h5.part' words || fail "$(cat words)"
[ ! -e long.h5 ] || fail "an unfinished run has the name of a finished one"
$bin/grseg-stress long.h5.part --window 0.1 --quiet >/dev/null
code=0
# shellcheck disable=SC2086
$bin/grseg-sim $small --duration 1 -o long.h5 2>words || code=$?
[ "$code" = 2 ] || fail "the frames of an interrupted run were overwritten"

# A tolerance that cannot be met: exit code 0, or 4 with --strict, and the file is written.
# shellcheck disable=SC2086
$bin/grseg-sim $small --duration 0.2 --tolerance 1e-9 --max-sweeps 2 -o loose.h5
code=0
# shellcheck disable=SC2086
$bin/grseg-sim $small --duration 0.2 --tolerance 1e-9 --max-sweeps 2 --strict -o strict.h5 2>words || code=$?
[ "$code" = 4 ] || fail "exit code $code where --strict missed its tolerance"
$bin/grseg-stress strict.h5 --window 0.1 --quiet >/dev/null

# The deposition, where it is kept, has negative times.
# shellcheck disable=SC2086
$bin/grseg-sim $small --duration 0.2 --keep-deposition -o deposition.h5
first=$(h5dump -d /particles/grains/position/time -s 0 -c 1 deposition.h5 | sed -n 's/.*(0): //p')
case $first in -*) ;; *) fail "the first frame of the deposition is at t = $first" ;; esac
# Elastic grains without friction do not come to rest by themselves. The file says from when on they were slowed down.
h5dump -d /parameters/deposition_slowed_from deposition.h5 >/dev/null 2>&1 && fail "a bed at rest was slowed down"
# shellcheck disable=SC2086
$bin/grseg-sim $small --friction 0 --restitution 1 --duration 0.1 -o elastic.h5
slowed=$(h5dump -d /parameters/deposition_slowed_from elastic.h5 | sed -n 's/.*(0): //p')
case $slowed in -*) ;; *) fail "grains were slowed down from t = $slowed on" ;; esac

# A burst consists of consecutive steps, and the narrowest instructions give the same bytes as the widest.
# shellcheck disable=SC2086
narrowest=$($bin/grseg-sim $small --isa none -o never.h5 2>&1 | sed -n 's/.*this machine has.*[, ]\([a-z0-9_]*\)$/\1/p')
# shellcheck disable=SC2086
$bin/grseg-sim $small --duration 0.1 --burst 3 --isa "$narrowest" -o burst.h5
# shellcheck disable=SC2086
$bin/grseg-sim $small --duration 0.1 --burst 3 -o same-burst.h5
steps=$(h5dump -d /particles/grains/position/step -s 0 -c 3 -y burst.h5 | grep -A1 'DATA {' | tail -1 | tr -d ' ')
[ "$steps" = 0,1,2 ] || fail "the first burst has the steps $steps"
h5diff burst.h5 same-burst.h5 /grseg/digest || fail "bytes differ between instruction sets"
