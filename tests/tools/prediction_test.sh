#!/bin/sh
# prediction_test.sh GRSEG-CLOSURE SOURCE: coefficients from kept runs of one mixture predict a run of another mixture far
# better than no change does, and the profiles are written; a run of the fit is refused, and nothing is written then.
set -eu
closure=$1 source=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
tar -xjf "$source/data/reproduction/questions.tar.bz2" --wildcards 'phi0.30-s23-e0.25-seed*/s*.tsv' 'phi0.60-s23-e0.25-seed1/s*.tsv'
fail() { echo "$1" >&2; exit 1; }
fit="phi0.30-s23-e0.25-seed1/segregation.tsv phi0.30-s23-e0.25-seed1/stress.tsv
     phi0.30-s23-e0.25-seed2/segregation.tsv phi0.30-s23-e0.25-seed2/stress.tsv"
options="--begin 10 --heights 12dS:56dS --partition size --quiet"
other=phi0.60-s23-e0.25-seed1/segregation.tsv

$closure $fit $options -o numbers.tsv --profiles profiles.tsv --predict $other
number() { awk -F '\t' -v name="$1@$other" '$1 == name || $1 == name "[m]" {print $2}' numbers.tsv; }
awk "BEGIN {exit !($(number rms_phi_L_of_closure) < 0.3 * $(number rms_phi_L_of_unchanged))}" || fail "$(cat numbers.tsv)"
awk "BEGIN {exit !($(number y_L_last_of_closure) > $(number y_L_first))}" || fail "$(cat numbers.tsv)"
grep -q '^# predicted: phi0.60' profiles.tsv || fail "the profiles do not name their run"
tail -n 1 profiles.tsv | grep -q '^# end: ' || fail "the profiles are not whole"

same=phi0.30-s23-e0.25-seed1/segregation.tsv
$closure $fit $options -o more.tsv --profiles more-profiles.tsv --predict $same 2>said && fail "predicts a run of its fit"
grep -q "$same" said || fail "$(cat said)"
[ ! -e more.tsv ] && [ ! -e more-profiles.tsv ] || fail "a refusal leaves a file"
