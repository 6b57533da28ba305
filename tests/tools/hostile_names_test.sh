#!/bin/sh
# Names of files and values of variables never run anything: make takes a value as one word, refuses names
# that it cannot take with one sentence, and figures take the name of a folder as it is.
# Usage: hostile_names_test.sh SOURCE BIN
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
nothing_ran() { [ -z "$(find "$folder" "$source/scripts" -name '*pwned*' -type f)" ] || fail "$1 ran: $(cat log)"; }
cp "$source/tests/inputs/three-grains-1.0.h5" run.h5

# refused SENTENCE MAKE-ARGUMENTS: make ends with this sentence and no other.
refused() {
  sentence=$1
  shift
  ! env PWD="$folder" make --no-print-directory "$@" >log 2>&1 || fail "$*: accepted: $(cat log)"
  nothing_ran "$*"
  sed -i '/^make: .* Error 2$/d' log # of the make that called the one which refused
  [ "$(wc -l <log)" = 1 ] && grep -q "$sentence" log || fail "$*: expected '$sentence': $(cat log)"
}
advice='\(make cannot use that in names; choose another\|write it without\)'
line_break='x
touch pwned'
for bad in 'a`touch pwned`.h5' 'x;touch pwned' '$(touch pwned)' '$(shell touch pwned)' "it's" 'say "x"' 'a|b' \
  'a#b' 'a:b' 'a%b' 'a*' "$line_break"; do
  for variable in RUNS OUT BIN; do
    refused "$variable contains .*; $advice" -C "$source/scripts" reanalysis RUNS=run.h5 "$variable=$bad"
  done
  for variable in OUT SEEDS MIXTURES NAME WINDOW; do
    refused "$variable contains .*; $advice" -C "$source/scripts" reproduce "$variable=$bad"
  done
  for variable in TABLES WORK; do
    refused "$variable contains .*; $advice" -C "$source/scripts/reproduce" -f document.mk reproduction.md "$variable=$bad"
  done
done
# A folder of that name: make would expand it where it is called.
! env PWD="$folder/\$(shell touch $folder/pwned)" make --no-print-directory -C "$source/scripts" reanalysis RUNS=run.h5 >log 2>&1 || fail "$(cat log)"
nothing_ran "the name of the folder"
grep -q 'the folder where make was called contains \$' log || fail "$(cat log)"
refused 'OUT contains a blank; ' -C "$source/scripts" reanalysis RUNS=run.h5 OUT='my folder'
for bad in '$(shell touch pwned)' '`touch pwned` $(touch pwned)' "$line_break"; do
  for variable in PARTITION LAYER WINDOW BEGIN ASSIGN MEAN SCAN HEIGHTS; do
    refused "$variable contains .*write it without" -C "$source/scripts" reanalysis RUNS=run.h5 "$variable=$bad"
  done
  refused 'RUN contains .*write it without' -C "$source/scripts" reproduce RUN="$bad"
done

# What make can pass on, the tools refuse: here the value is one of their words.
for bad in '`touch pwned`' 'x;touch pwned' "x';touch pwned;'" 'x" | touch pwned "' '> pwned' '-o pwned'; do
  for variable in LAYER WINDOW BEGIN ASSIGN; do
    PWD=$folder make -C "$source/scripts" reanalysis BIN="$bin" RUNS=run.h5 WINDOW=1e-4 "$variable=$bad" >log 2>&1 &&
      fail "$variable=$bad: accepted: $(cat log)"
    nothing_ran "$variable=$bad"
    grep -q "^grseg-[a-z]*: .*--" log || fail "$variable=$bad: no tool was asked: $(cat log)"
  done
done
for bad in '`touch pwned`' 'x;touch pwned' "x';touch pwned;'"; do
  # RUN is put before commands, whose words it cannot end.
  PWD=$folder make -C "$source/scripts" reproduce BIN="$bin" SEEDS=1 FIGURES=no RUN="echo $bad" DURATION="$bad" >log 2>&1 || true
  nothing_ran "RUN=$bad"
  PWD=$folder make -C "$source/scripts" "figures/$bad.png" WORK="$folder/work" >log 2>&1 && fail "figures/$bad.png: $(cat log)"
  nothing_ran "figures/$bad.png"
done

# A folder of tables by a name that gnuplot or its shell could run.
for bad in "it's;touch pwned;'" '<touch pwned;' '|touch pwned;' '`touch pwned`'; do
  mkdir -p "$bad"
  $bin/grseg-fit "$source/tests/inputs/neutral-sums.tsv" --scan 0.4:0.9:0.1 --quiet -o "$bad/scan.tsv"
  gnuplot -c "$source/scripts/figures/b-of-p.gp" "$bad" >log 2>&1 || fail "$bad: $(cat log)"
  nothing_ran "$bad"
  [ -s "$bad/b-of-p.png" ] || fail "$bad: no figure: $(cat log)"
  gnuplot -c "$source/scripts/figures/b-of-p.gp" "$bad" "$bad/b.pdf" >log 2>&1 || fail "$bad/b.pdf: $(cat log)"
  nothing_ran "$bad/b.pdf"
  [ "$(head -c 5 "$bad/b.pdf")" = %PDF- ] || fail "$bad/b.pdf: no PDF: $(cat log)"
done
