#!/bin/sh
# A scene gives the same bytes on every day. File systems without locks, links or renaming are served or refused
# before the work; a file that the system refuses to open is never called damaged.
# Usage: other_machines_test.sh SOURCE BIN PRELOADED
set -eu
source=$1 bin=$2 preloaded=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export ASAN_OPTIONS=verify_asan_link_order=0
fail() { echo "$1" >&2; exit 1; }
# where VARIABLES... COMMAND...: on a machine with these variables (other_machine.c).
where() { env LD_PRELOAD="$preloaded" "$@"; }
# refused CODE SENTENCE COMMAND...
refused() {
  expected=$1 sentence=$2 code=0
  shift 2
  where "$@" >table 2>said || code=$?
  [ $code = "$expected" ] || fail "exit code $code: $*: $(cat said)"
  grep -q -- "$sentence" said || fail "$* says: $(cat said)"
}
run() { "$@" "$bin/grseg-sim" "$source/sim/scenes/chute.ini" --depth 8dS --length 6dL --accuracy draft --duration 0.2 \
  --quiet --checkpoint run.chk -o run.h5; }

run env
mv run.h5 good.h5
rm run*
for seconds in 1 86400 900000000; do
  run where SHIFT=$seconds
  cmp run.h5 good.h5 || fail "other bytes $seconds s later"
  rm run*
done

for error in 37 38 95 524; do
  where FLOCK=$error "$bin/grseg-check" good.h5 --quiet >/dev/null || fail "errno $error: not read"
  where FLOCK=$error PYTHONPATH="$source/analysis/python" /usr/bin/python3 -B -c 'import grseg; grseg.Run("good.h5")' ||
    fail "errno $error: not read by Python"
  run where FLOCK=$error
  cmp run.h5 good.h5 || fail "errno $error: other bytes"
  rm run*
done
refused 1 "good.h5: cannot be opened: No locks available; set HDF5_USE_FILE_LOCKING=FALSE" \
  FLOCK=37 HDF5_USE_FILE_LOCKING=TRUE "$bin/grseg-check" good.h5

refused 1 "good.h5: cannot be opened: Too many open files; raise the limit (ulimit -n)" OPEN=24 "$bin/grseg-check" good.h5
refused 1 "good.h5: cannot be opened: Stale file handle; mount its file system again" OPEN=116 "$bin/grseg-check" good.h5
refused 1 "good.h5.* cannot be .*: Input/output error; does its disk" READ=5 "$bin/grseg-check" good.h5
refused 2 "good.h5.part: no such file" "$bin/grseg-check" good.h5.part
refused 2 ".: is a folder" "$bin/grseg-check" .
for error in 5 24 116; do
  where OPEN=$error PYTHONPATH="$source/analysis/python" /usr/bin/python3 -B -c 'import grseg; grseg.Run("good.h5")' 2>said &&
    fail "read by Python"
  ! grep -q damaged said || fail "Python says: $(cat said)"
done

# Published under free names, but nothing is replaced.
run where NO_LINK=1
cmp run.h5 good.h5
echo "another's" >taken
for output in stress.tsv taken; do
  where NO_LINK=1 "$bin/grseg-stress" good.h5 --window all -o $output --quiet 2>said || [ $output = taken ] || fail "$(cat said)"
done
[ "$(cat taken)" = "another's" ] || fail "it was replaced"
rm run* stress.tsv
for program in "grseg-sim $source/sim/scenes/chute.ini" "grseg-stress good.h5 --window all" "grseg-export good.h5 --to extxyz"; do
  # shellcheck disable=SC2086
  refused 1 "cannot create x: its file system renames no files" NO_RENAME=1 "$bin"/$program -o x
done
[ "$(ls)" = "$(printf '%s\n' good.h5 said table taken)" ] || fail "left behind: $(ls)"
