#!/usr/bin/env bash
# A sweep that is killed twice and continued gives the files of an undisturbed one, byte for byte; a further call simulates
# nothing; what cannot be is refused before anything runs. Usage: sweep_test.sh SOURCE BUILD [KEYS]
set -euo pipefail
source=$1 build=$2 keys=${3:-slope=23,25 phi-large=0.4 seed=1:2}
folder=$(mktemp -d)
running=
trap '[ -z "$running" ] || kill -9 -- "-$running" 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
printf '%s\n' "duration = 12" "depth = 14dS" "length = 20dS" "accuracy = draft" >chute.ini
sweep() {
  local out=$1
  shift
  PATH="/usr/bin:$PATH" make -s -C "$source/scripts" sweep HERE="$folder" BIN="$build/bin" SCENE=chute.ini KEYS="$keys" OUT="$out" \
    WINDOW=0.25 HEIGHTS=4dS:12dS CHECKPOINT_EVERY=0.1 -j2 "$@"
}
fail() {
  echo "sweep_test: $1" >&2
  exit 1
}
# All files but the pages, which show the history of a run, and costs.
sums_of() { (cd "$1" && find . \( -name '*.tsv' ! -name cost.tsv -o -name checksums -o -name scene.ini -o -name sweep.txt \) -print0 | sort -z | xargs -0 sha256sum); }

sweep undisturbed >undisturbed.log 2>&1 || { cat undisturbed.log; fail "the sweep failed"; }
runs=$(grep -c . undisturbed/runs.tsv)
runs=$((runs - 1))
for kill in 1 2; do
  setsid bash -c "$(declare -f sweep); source='$source' build='$build' folder='$folder' keys='$keys'; sweep killed" >>killed.log 2>&1 &
  running=$!
  # Also until setsid has made the group that is killed.
  until kill -0 -- "-$running" 2>/dev/null && [ "$(find killed -name checksums 2>/dev/null | wc -l)" -ge $((kill * runs / 3)) ] && compgen -G 'killed/*/run.chk' >/dev/null; do
    kill -0 "$running" 2>/dev/null || { cat killed.log; fail "the sweep ended before it could be killed"; }
    sleep 0.02
  done
  kill -9 -- "-$running"
  wait "$running" 2>/dev/null || true
  running=
  echo "killed with $(find killed -name checksums | wc -l) of $runs runs done"
done
sweep killed >>killed.log 2>&1 || { cat killed.log; fail "the killed sweep does not continue"; }
diff <(sums_of undisturbed) <(sums_of killed) || fail "files differ"
echo "the same $(sums_of killed | wc -l) files; simulations that continued: $(cat killed/*/run.log | grep -c '^restart' || true)"
[ -z "$(find killed -name 'run.h5*' -o -name '*.new' -o -name '*.part' -o -name run.chk)" ] || fail "trajectories or temporary files remain"

# The page of the sweep and those of its runs, the figures, and a table with a row for each flow.
for name in index.html b-of-slope.png b-of-slope.pdf; do [ -s "killed/$name" ] || fail "no $name"; done
[ "$(find killed -name page.html | wc -l)" = "$runs" ] || fail "a run has no page"
[ "$(grep -c '^ ' killed/sweep.txt)" = "$(cut -f 2 killed/runs.tsv | tail -n +2 | sort -u | wc -l | awk '{ print $1 }')" ] || fail "sweep.txt: rows"

grep -q '^# heights: 4dS:12dS' killed/sweep.tsv && grep -q '^heights 4dS:12dS; begin 0 s' killed/sweep.txt || fail "the settings are not said"
grep -Eq ' runs +windows +points .* verdict$' killed/sweep.txt || fail "sweep.txt does not say on how many points B rests"
! grep -E '^ .* -$' killed/sweep.txt || fail "a flow without a verdict"
grep -q '^# windows: ' killed/sweep.tsv && grep -q '"verdict": "[a-z]' killed/index.html || fail "windows or verdict are missing"
# Summaries and pages are of the heights and windows of the fits.
for run in killed/*/; do
  grep -q '^# heights: 4dS:12dS' "$run/segregation-summary.tsv" && grep -q '^# window: 0.25' "$run/segregation-summary.tsv" || fail "$run: another summary"
  grep -q -- '--window 0.25 --heights 4dS:12dS --begin 0 ' "$run/page.html" || fail "$run: another page"
done
grep -q '^doubt of . of . flows: few runs show little' killed/sweep.txt || fail "two seeds without a doubt"
! sweep killed BEGIN=20 >late.log 2>&1 || fail "times after the end have a B"
grep -q 'there is no B for any flow' late.log && ! grep -q Traceback late.log || fail "$(cat late.log)"
sweep killed BEGIN=4 >log 2>&1 || fail "$(cat log)"
# Another rule repeats the fits alone; a further key value adds runs; another scene is refused.
sweep killed PARTITION=uniform:0.6 >again.log 2>&1
! grep -q 'is finished\|to simulate' again.log || fail "another rule simulated"
grep -q 'B uniform:0.6' killed/sweep.txt || fail "another rule is not in the table"
# Without the trajectory other heights reach the fits, and no summary of the old heights stands beside them.
sweep killed HEIGHTS=all >heights.log 2>&1 || fail "$(cat heights.log)"
grep -q 'segregation-summary.tsv is of the heights 4dS:12dS' heights.log && ! grep -q 'D_S' killed/sweep.tsv || fail "a summary of other heights is shown"
sed -i 's/duration = 12/duration = 13/' chute.ini
! sweep killed >other.log 2>&1 || fail "a finished sweep took another scene"
grep -q 'this run is finished, but the scene .*chute.ini has changed; choose another OUT, or simulate the run again with AGAIN=yes' other.log || fail "$(cat other.log)"
keys="slope=99 seed=1"
! sweep impossible >impossible.log 2>&1 || fail "a slope of 99 degrees was taken"
grep -q 'slope is 99: it must lie between' impossible.log && [ ! -e impossible ] || fail "$(cat impossible.log)"
