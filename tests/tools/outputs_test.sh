#!/bin/sh
# No program replaces an input, or anything without --overwrite; it says so before it works. Usage:
# outputs_test.sh SOURCE BIN
set -eu
bin=$2 source=$1 folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
cp "$source/data/sample/chute.h5" run.h5
cp "$source/tests/inputs/neutral-sums.tsv" sums.tsv
cp -r "$source/tests/inputs/lammps" archive
"$bin/grseg-micro" run.h5 --window 5 --quiet >micro.tsv
"$bin/grseg-sim" "$source/sim/scenes/chute.ini" --depth 6dS --length 6dL --accuracy draft --duration 0.01 --quiet \
  --checkpoint run.chk -o short.h5
cp "$source/sim/scenes/chute.ini" scene.ini
import="--format lammps --grains archive/atoms.dump --contacts archive/contacts.dump --step 1e-5 --gravity 9.8
  --slope 23 --boundary 3 --units si --columns i=2,j=3,dist=6,force=7,tangential=10"

# refused PATTERN OUTPUT COMMAND...: exit code 2, one sentence that PATTERN is in; OUTPUT stays as it is.
refused() {
  pattern=$1 output=$2
  shift 2
  before=$(cksum "$output" 2>&1 || true) code=0
  "$@" >said 2>&1 || code=$?
  [ $code = 2 ] || fail "$*: exit code $code: $(cat said)"
  [ "$(wc -l <said)" = 1 ] || fail "$*: $(cat said)"
  grep -q "$pattern" said || fail "$*: $(cat said)"
  [ "$(cksum "$output" 2>&1 || true)" = "$before" ] || fail "$*: $output has changed"
}
is_input="is an input and cannot be the output"
other_name="is the input .* under another name and cannot be the output"

# keeps INPUT COMMAND...: no name of INPUT can be the output of COMMAND, nor a file that is there.
keeps() {
  input=$1
  shift
  ln -s "$input" soft
  ln "$input" hard
  refused "$is_input" "$input" "$@" -o "$input"
  refused "$is_input" "$input" "$@" -o "$input" --overwrite
  refused "$other_name" "$input" "$@" -o soft --overwrite
  refused "$other_name" "$input" "$@" -o hard --overwrite
  rm soft hard
  echo kept >old
  refused "old already exists; choose another name, remove it, or pass --overwrite" old "$@" -o old
}
for tool in stress kinetic micro balance segregation check; do keeps run.h5 "$bin/grseg-$tool" run.h5; done
keeps sums.tsv "$bin/grseg-fit" sums.tsv
keeps sums.tsv "$bin/grseg-merge" sums.tsv
keeps micro.tsv "$bin/grseg-derive" micro.tsv
for form in extxyz lammps h5md3d; do keeps run.h5 "$bin/grseg-export" run.h5 --to $form; done
# shellcheck disable=SC2086
keeps archive/atoms.dump "$bin/grseg-import" $import
# shellcheck disable=SC2086
keeps archive/contacts.dump "$bin/grseg-import" $import
keeps scene.ini "$bin/grseg-sim" scene.ini
keeps run.chk "$bin/grseg-sim" --restart run.chk --duration 0.02
keeps scene.ini "$bin/grseg-sim" scene.ini --checkpoint new.chk

# The folder of an export that holds the run.
"$bin/grseg-export" run.h5 --to vtp --begin 19 --quiet -o view
mkdir view/in
cp run.h5 view/in
refused "view already exists" view/in/run.h5 "$bin/grseg-export" run.h5 --to vtp -o view
refused "the input view/in/run.h5 lies in the folder view" view/in/run.h5 \
  "$bin/grseg-export" view/in/run.h5 --to vtp -o view --overwrite
cp run.h5 run.contacts.dump
refused "run.contacts.dump is an input" run.contacts.dump \
  "$bin/grseg-export" run.contacts.dump --to lammps -o run.dump --overwrite

# The files of a run.
refused "$is_input" scene.ini "$bin/grseg-sim" scene.ini --checkpoint scene.ini -o x.h5 --overwrite
ln -s run.chk soft.h5.part
refused "soft.h5.part is the input" run.chk "$bin/grseg-sim" --restart run.chk --duration 1 -o soft.h5 --overwrite
for checkpoint in ./x.h5 x.h5.part; do
  refused "cannot be the same file" x.h5 "$bin/grseg-sim" scene.ini --checkpoint $checkpoint -o x.h5
done
refused "cannot be the same file" x_prev.h5 "$bin/grseg-sim" scene.ini --checkpoint x.h5 -o x_prev.h5
echo kept >new_prev.chk
refused "new_prev.chk already exists" new_prev.chk "$bin/grseg-sim" scene.ini --checkpoint new.chk -o x.h5

# What may be replaced is; devices and pipes are written to.
echo old >old
"$bin/grseg-fit" sums.tsv --quiet -o old --overwrite
grep -q '^# program: grseg-fit' old || fail "--overwrite does not replace a table"
"$bin/grseg-fit" sums.tsv --quiet -o /dev/null
[ -c /dev/null ] || fail "/dev/null was replaced"
"$bin/grseg-fit" sums.tsv --quiet -o /dev/stdout | grep -q '^# program' || fail "no table in the pipe"
"$bin/grseg-fit" sums.tsv --quiet -o /dev/stdout --overwrite >redirected.tsv
grep -q '^# program' redirected.tsv || fail "no table where standard output is redirected to a file"
[ -L /dev/stdout ] || fail "/dev/stdout was replaced"
for file in said.* *.tmp.* *.lock; do [ ! -e "$file" ] || fail "$file was left behind"; done

# A run of no frame.
refused "duration is 1e-15 s, less than a step of .* s: the run would have no frame; choose a longer one" x.h5 \
  "$bin/grseg-sim" scene.ini --duration 1e-15 -o x.h5
refused "duration is 0 s" x.h5 "$bin/grseg-sim" scene.ini --duration 0 -o x.h5
refused "duration is 1e+12 s: that is more than 1e+15 steps" x.h5 "$bin/grseg-sim" scene.ini --duration 1e12 -o x.h5
