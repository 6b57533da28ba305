#!/bin/sh
# While a run lives no other one writes its files; one that was killed blocks nobody; and a file that
# appears during a run is not replaced. Usage: one_writer_test.sh SOURCE BIN
set -eu
bin=$2 small="$1/sim/scenes/chute.ini --depth 8dS --length 8dL --accuracy draft --quiet"
folder=$(mktemp -d) run=
trap 'kill -9 $run 2>/dev/null || true; rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
# begin OPTIONS...: a run in the background that has written its first checkpoint.
begin() {
  # shellcheck disable=SC2086
  "$bin/grseg-sim" $small --checkpoint run.chk --checkpoint-every 0 "$@" 2>words &
  run=$!
  while [ ! -e run.chk ]; do kill -0 $run || fail "$(cat words)"; sleep 0.01; done
}
# refused FILE COMMAND...: by the run that writes FILE.
refused() {
  file=$1 code=0
  shift
  "$bin/grseg-sim" "$@" 2>said || code=$?
  [ $code = 2 ] || fail "exit code $code: $*: $(cat said)"
  [ "$(cat said)" = "grseg-sim: $file is being written by process $run on $(uname -n); wait for it, or choose another name" ] ||
    fail "$* says: $(cat said)"
}
# With and without the locks of HDF5, which some file systems do not know.
for locking in TRUE FALSE; do
  export HDF5_USE_FILE_LOCKING=$locking
  begin --duration 1e6 --force -o run.h5
  refused run.h5 $small --overwrite -o run.h5
  refused ./run.h5 $small --overwrite -o ./run.h5 --checkpoint other.chk
  refused run.h5 --restart run.chk -o run.h5
  refused run.h5 --restart run.chk --checkpoint run.chk --overwrite -o run.h5
  refused run.chk $small --overwrite --checkpoint run.chk -o other.h5
  refused run.chk --restart run.chk --checkpoint run.chk --duration 2e6 --force -o other.h5
  kill -0 $run || fail "the run was disturbed: $(cat words)"
  kill -9 $run
  wait $run || true
  [ -e run.h5.lock ] || fail "there was no lock"
  code=0
  timeout --preserve-status -s INT 1 "$bin/grseg-sim" --quiet --force --restart run.chk -o run.h5 2>words || code=$?
  [ $code = 130 ] || fail "the restart of a killed run says: $(cat words)"
  [ ! -e run.h5.lock ] || fail "the lock outlived its run"
  rm run* other* 2>/dev/null || true
done

# A file that appears during the run.
for packed in 0 1; do
  begin --duration 4 --compression $packed -o run.h5
  echo "another's" >run.h5
  code=0
  wait $run || code=$?
  [ $code = 1 ] || fail "exit code $code where a file has appeared: $(cat words)"
  [ "$(cat words)" = "grseg-sim: run.h5 has appeared since this program began and is not replaced; all frames are in run.h5.part; rename it, as in: mv -n run.h5.part other.h5" ] ||
    fail "$(cat words)"
  [ "$(cat run.h5)" = "another's" ] || fail "it was replaced"
  mv -n run.h5.part other.h5
  "$bin/grseg-check" other.h5 --quiet >/dev/null || fail "the frames are not whole"
  [ -z "$(ls | grep -v '^run.h5$\|^run.chk$\|^run_prev.chk$\|^other.h5$\|^words$\|^said$')" ] || fail "left behind: $(ls)"
  rm run* other*
done
