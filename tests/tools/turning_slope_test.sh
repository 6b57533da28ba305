#!/bin/sh
# A slope that becomes steeper during the run: the file records it, and tools that need gravity
# use it. Usage: turning_slope_test.sh SOURCE BIN
set -eu
bin=$2 chute="$1/sim/scenes/chute.ini --depth 8dS --length 8dL --accuracy draft --slope 10 --frame-interval 0.02"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
verdict() { awk -F'\t' -v line="$1" '$1 == line { print $7 }' checked; }

# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --slope-rate 30 --duration 1 -o run.h5
h5dump -y -d /parameters/slope_rate run.h5 | grep -q '^ *30$' || fail "the file does not state the rate"
"$bin/grseg-check" --physics run.h5 >checked
for line in force_balance total_momentum energy_defect; do
  [ "$(verdict $line)" = passed ] || fail "$line: $(verdict $line)"
done
for line in weight slope; do
  [ "$(verdict $line)" = skipped ] || fail "$line: $(verdict $line)"
done
grep -q 'the slope turns' checked || fail "no reason is given for the skipped lines"

# The balances close, and no longer do so when the file states another rate.
closed() {
  "$bin/grseg-balance" --trust --window 0.25 "$1" -o /dev/null 2>words
  sed -n 's/.*close to \(.*\) of the largest.*/\1/p' words
}
awk "BEGIN { exit !($(closed run.h5) < 1e-10) }" || fail "$(cat words)"
/usr/bin/python3 - <<'PY'
import h5py
with h5py.File("run.h5", "r+") as run:
    run["parameters/slope_rate"][()] = 29.0
PY
awk "BEGIN { exit !($(closed run.h5) > 1e-3) }" || fail "another rate is not noticed: $(cat words)"
if "$bin/grseg-check" --physics run.h5 >checked 2>words; then fail "grseg-check passes a wrong rate"; fi
grep -q force_balance words || fail "$(cat words)"

# A slope that turns too fast is refused.
# shellcheck disable=SC2086
if $bin/grseg-sim --quiet $chute --slope-rate 1e4 --duration 1 -o fast.h5 2>words; then fail "a slope that turns by more than a degree per step was simulated"; fi
grep -q 'slope-rate turns gravity by .* degrees per step, above 1; choose a smaller' words || fail "$(cat words)"
