#!/bin/sh
# scripts/assignment-convergence on the sample: one row per setting, the reference equals itself, and a
# kernel as wide as the bed smooths the profile of the species away.
# Usage: assignment_convergence_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
out=$(mktemp)
trap 'rm -f "$out"' EXIT
"$source/scripts/assignment-convergence" "$source/data/sample/chute.h5" --bin "$bin" --window 2 \
  --stride 5 --blocks 4 --layers 4 --deviations 8 --heights 2,18 -o "$out" >/dev/null
[ "$(grep -vc '^#' "$out")" = 10 ] || { cat "$out" >&2; exit 1; }
awk -F '\t' '
  $1 == "branch" { if ($7 != 0 || $8 != 0) exit 1; sharp = $21 - $22 }
  $1 == "gauss 8" { if ($7 == 0 || $8 == 0) exit 1; smoothed = $21 - $22 }
  END { if (!(sharp > 0.3 && smoothed < 0.6 * sharp)) { print sharp, smoothed; exit 1 } }' "$out" || {
  cat "$out" >&2
  exit 1
}
