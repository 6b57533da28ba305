#!/usr/bin/env bash
# From the installed files alone, as of the unpacked tarball: a sweep, the same as a job array with Slurm's environment, and
# without gnuplot; names that do not exist are refused. Usage: installed_sweep_test.sh BUILD
set -euo pipefail
build=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() {
  echo "installed_sweep_test: $1" >&2
  exit 1
}
cmake --install "$build" --prefix "$folder/grseg" >"$folder/installed.log"
mkdir "$folder/tools"
ln -s /usr/bin/* "$folder/tools"
rm -f "$folder"/tools/gnuplot* "$folder/tools/srun"
printf '%s\n' '#!/bin/sh' 'while [ "${1#--}" != "$1" ]; do shift; done' 'exec "$@"' >"$folder/tools/srun"
chmod +x "$folder/tools/srun"
printf '%s\n' "duration = 4" "depth = 14dS" "length = 20dS" "accuracy = draft" >"$folder/chute.ini"
cd "$folder/grseg/share/grseg"
export PATH="$folder/tools"
common=(HERE="$folder" SCENE=chute.ini WINDOW=0.25 KEYS="slope=23,25 seed=1")

make -C scripts sweep "${common[@]}" OUT=sweep -j2 >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
[ -s "$folder/sweep/index.html" ] || fail "no page"
grep -q 'gnuplot is missing' "$folder/log" || fail "no word about gnuplot"
for task in 1 2; do
  SLURM_ARRAY_TASK_ID=$task bash scripts/reproduce/array.sbatch "${common[@]}" OUT=array >"$folder/log" 2>&1 || fail "$(cat "$folder/log")"
done
for run in slope-23_seed-1 slope-25_seed-1; do cmp "$folder/sweep/$run/stress.tsv" "$folder/array/$run/stress.tsv"; done

# refused SENTENCE COMMAND ...
refused() {
  local sentence=$1
  shift
  ! "$@" >"$folder/log" 2>&1 && grep -q "$sentence" "$folder/log" || fail "$* says: $(cat "$folder/log")"
}
refused "task 3 has no run: there are 2" env SLURM_ARRAY_TASK_ID=3 bash scripts/reproduce/array.sbatch "${common[@]}" OUT=array
refused "there is no scripts/reproduce in" env CAMPAIGN=reproduce SLURM_ARRAY_TASK_ID=1 bash scripts/reproduce/array.sbatch
refused "NAME is 'nothing', which is no run" make -s -C scripts/sweep run "${common[@]}" OUT=array NAME=nothing
refused "unknown key 'slop', did you mean 'slope'" make -s -C scripts/sweep scenes "${common[@]}" KEYS="slop=23 seed=1" OUT=other
# A computer without libxxhash checks the number of rows alone.
python3 - scripts "$folder/sweep/slope-23_seed-1/stress.tsv" <<'END'
import sys
sys.path.insert(0, sys.argv[1])
import shared
shared.XXHASH = None
text = open(sys.argv[2]).read()
assert shared.unsealed(text) and shared.changed(text, "grseg-stress", "x") == text
lines = text.split("\n")
del lines[-3]  # a row
try:
    shared.unsealed("\n".join(lines))
except SystemExit:
    sys.exit(0)
sys.exit("a table without a row was read")
END
