#!/bin/sh
# A run that is interrupted or killed and then restarted ends like an uninterrupted one; other runs
# begin new trajectories; what is impossible is refused in one sentence. Usage: restart_test.sh SOURCE BIN
set -eu
bin=$2 chute="$1/sim/scenes/chute.ini --depth 10dS --length 10dL --phi-large 0.5 --accuracy draft --frame-interval 0.02"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }
# Frames and observables: everything but the history.
content() { h5dump -d /grseg/digest -g /observables "$1" | sed 1d; }
numbers() { h5dump -y -w 1 -d "$1" "$2" | grep '^ *[0-9.-]' | tr -d ', '; }
# refused CODE SENTENCE OPTIONS...
refused() {
  expected=$1 sentence=$2 code=0
  shift 2
  "$bin/grseg-sim" --quiet "$@" 2>words || code=$?
  [ "$code" = "$expected" ] || fail "exit code $code where $expected is expected: $*: $(cat words)"
  [ "$(cat words)" = "grseg-sim: $sentence" ] || fail "$* says: $(cat words)"
}

# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 5 -o whole.h5
content whole.h5 >whole

# stopped SIGNAL CHECKPOINT SECONDS OPTIONS...: a run that gets SIGNAL some time after its first
# checkpoint; its exit code is left in $code, its messages in the file words.
stopped() {
  signal=$1 checkpoint=$2 wait=$3 code=0
  shift 3
  "$bin/grseg-sim" --quiet --checkpoint "$checkpoint" "$@" 2>words &
  while [ ! -e "$checkpoint" ] && kill -0 $! 2>/dev/null; do sleep 0.01; done
  sleep "$wait"
  # The run may have ended by itself; then there is nothing to kill.
  kill -s "$signal" $! 2>/dev/null || true
  wait $! || code=$?
}

# A signal that asks the run to end: it says how to continue, and continues that way.
for pair in INT:130 TERM:143 HUP:129 USR1:138 USR2:140 XCPU:152; do
  signal=${pair%:*}
  # shellcheck disable=SC2086
  stopped $signal run$signal.chk 0.1 $chute --duration 5 -o $signal.h5
  [ $code = "${pair#*:}" ] || fail "exit code $code after SIG$signal"
  grep -q "the frames so far are in $signal.h5.part, --restart run$signal.chk continues$" words || fail "$(cat words)"
  $bin/grseg-sim --restart run$signal.chk --quiet -o $signal.h5
  content $signal.h5 | cmp - whole || fail "SIG$signal and a restart changed the run"
done
mv runTERM.chk run.chk

# One command begins a run, continues it after a kill, and leaves it alone when it is finished.
# shellcheck disable=SC2086
stopped KILL on.chk 0.05 $chute --duration 5 --continue -o on.h5
# shellcheck disable=SC2086
refused 2 "on.chk and on.h5.part belong to an interrupted run: --continue continues it, --overwrite begins again" \
  $chute --duration 5 --checkpoint on.chk -o on.h5
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 5 --checkpoint on.chk --continue -o on.h5
content on.h5 | cmp - whole || fail "--continue changed the run"
before=$(cksum on.h5)
# shellcheck disable=SC2086
$bin/grseg-sim $chute --duration 5 --checkpoint on.chk --continue -o on.h5 2>words
grep -q '^grseg-sim: on.h5 is finished$' words && [ "$(cksum on.h5)" = "$before" ] || fail "a finished run: $(cat words)"
# A finished run of another scene is not replaced, whether the duration changes as well or not.
other="on.chk is of a run in which KEY: give this value to continue it, or choose other names for --output and --checkpoint to begin another run"
# shellcheck disable=SC2086
refused 2 "$(echo "$other" | sed 's/KEY/seed is 1/')" $chute --duration 5 --seed 2 --checkpoint on.chk --continue -o on.h5
# shellcheck disable=SC2086
refused 2 "$(echo "$other" | sed 's/KEY/slope is 23/'); --restart on.chk with another --output, instead of --continue, continues with the change" \
  $chute --duration 7 --slope 20 --checkpoint on.chk --continue -o on.h5
[ "$(cksum on.h5)" = "$before" ] || fail "another scene changed a finished run"
mv on.chk away.chk
rm on_prev.chk
# shellcheck disable=SC2086
refused 2 "on.h5 exists, but not its checkpoint on.chk, from which it could be continued: name it with --checkpoint, or choose another name for --output" \
  $chute --duration 5 --checkpoint on.chk --continue -o on.h5
# shellcheck disable=SC2086
refused 2 "--estimate covers a whole run; leave out --restart and --continue" \
  $chute --duration 5 --checkpoint on.chk --continue --estimate -o on.h5
# shellcheck disable=SC2086
refused 2 "--continue needs --checkpoint FILE, and cannot be combined with --restart" $chute --continue -o other.h5

# Killed while it records its deposition, before the first checkpoint, it begins again, but not with
# another key; and it leaves no other file.
early="$1/sim/scenes/chute.ini --depth 30dS --length 20dL --phi-large 0.5 --keep-deposition --frame-interval 0.01 --duration 0.05"
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $early -o undisturbed.h5
# shellcheck disable=SC2086
"$bin/grseg-sim" --quiet $early --checkpoint early.chk --continue -o early.h5 &
while [ ! -s early.h5.part ]; do sleep 0.01; done
kill -9 $!
wait $! || true
[ ! -e early.chk ] || fail "the kill came too late"
before=$(cksum early.h5.part)
# shellcheck disable=SC2086
refused 2 "early.h5.part is of another scene, in which slope is 23: choose another name for --output, or give this value to begin that run again" \
  $early --checkpoint early.chk --continue -o early.h5 --slope 20
[ "$(cksum early.h5.part)" = "$before" ] || fail "another scene changed the deposition of a killed run"
# shellcheck disable=SC2086
$bin/grseg-sim $early --checkpoint early.chk --continue -o early.h5 2>words
grep -q '^grseg-sim: begins again, because early.h5.part has no frame of the flow$' words || fail "$(cat words)"
content undisturbed.h5 >undisturbed
content early.h5 | cmp - undisturbed || fail "a run that began again is another"
case $(echo early*) in "early.chk early.h5" | "early.chk early.h5 early_prev.chk") ;; *) fail "left behind: $(echo early*)" ;; esac

# With another duration an interrupted run goes on, and says from where.
# shellcheck disable=SC2086
stopped KILL other.chk 0.05 $chute --duration 10 --checkpoint-every 0 --continue -o other.h5
# shellcheck disable=SC2086
$bin/grseg-sim $chute --duration 5 --checkpoint other.chk --continue -o other.h5 2>words
grep -q '^grseg-sim: continues other.chk from t = [0-9.]* s$' words || fail "$(cat words)"
content other.h5 | cmp - whole || fail "another duration changed the run"

# Prolonged, it is the run that was longer from the beginning; killed on the way, nothing of it is lost.
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 2 --checkpoint long.chk --continue -o long.h5
cp long.h5 short.h5
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 5 --checkpoint long.chk --checkpoint-every 0.05 --continue -o long.h5 &
while [ ! -s long.h5.part ]; do sleep 0.01; done
sleep 0.15
kill -9 $! || true
wait $! || true
cmp long.h5 short.h5 || fail "a prolongation that was killed changed the run"
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 5 --checkpoint long.chk --continue -o long.h5
content long.h5 | cmp - whole || fail "a run that is prolonged is another"
[ "$(h5dump -d /parameters/scene long.h5 | grep -c 'duration = 5$')" = 1 ] || fail "a run that is prolonged states its old length"
# Another run of the same bed is not replaced by it.
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --slope 20 --duration 2 -o steep.h5
# shellcheck disable=SC2086
refused 2 "steep.h5 already exists; choose another name, remove it, or pass --overwrite" \
  $chute --duration 7 --checkpoint long.chk --continue -o steep.h5

# nohup keeps SIGHUP from the run.
( trap '' HUP
  # shellcheck disable=SC2086
  stopped HUP nohup.chk 0.05 $chute --duration 5 -o nohup.h5
  [ $code = 0 ] ) || fail "a run that ignores SIGHUP ended by it"
content nohup.h5 | cmp - whole || fail "SIGHUP changed a run that ignores it"

# A terminal that is closed sends SIGHUP, and takes no more words.
/usr/bin/python3 - "$bin/grseg-sim" --checkpoint gone.chk $chute --duration 5 -o gone.h5 <<'CLOSED' ||
import os, pty, sys, time
child, terminal = pty.fork()
if child == 0:
    os.execv(sys.argv[1], sys.argv[1:])
while not os.path.exists("gone.chk"):
    time.sleep(0.01)
time.sleep(0.4)
os.close(terminal)
code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
sys.exit(f"exit code {code}" if code not in (0, 129) else 0)
CLOSED
  fail "a closed terminal ended the run otherwise than SIGHUP"
[ -e gone.h5 ] || $bin/grseg-sim --restart gone.chk --quiet -o gone.h5
content gone.h5 | cmp - whole || fail "a closed terminal and a restart changed the run"

# Killed again and again at any moment, also while it writes a frame or a checkpoint.
# shellcheck disable=SC2086
stopped KILL killed.chk 0.12 $chute --duration 5 --checkpoint-every 0 -o killed.h5
for wait in 0.13 0.07 0.21 0.18; do
  [ ! -e killed.h5 ] || break
  stopped KILL killed.chk $wait --restart killed.chk --checkpoint-every 0 -o killed.h5
done
[ -e killed.h5 ] || $bin/grseg-sim --quiet --restart killed.chk --checkpoint killed.chk -o killed.h5
content killed.h5 | cmp - whole || fail "kills and restarts changed the run"
[ "$(h5dump -d /parameters/history killed.h5 | grep -c 'grseg-sim.*killed.h5')" -ge 2 ] ||
  fail "the history does not list the restarts"

# The checkpoint before the last one, which takes over where the last one is damaged.
# shellcheck disable=SC2086
stopped INT old.chk 0.1 $chute --duration 5 --checkpoint-every 0 -o old.h5
head -c 20000 old.chk >torn
mv torn old.chk
refused 3 "old.chk: is not a checkpoint, or is truncated or damaged; old_prev.chk is the previous checkpoint" \
  --restart old.chk -o old.h5
"$bin/grseg-sim" --quiet --restart old_prev.chk --checkpoint old.chk --overwrite -o old.h5
content old.h5 | cmp - whole || fail "a restart from the checkpoint before the last one changed the run"

# In single precision, compressed at the end, with the deposition before it.
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 6 --store float32 --compression 1 --keep-deposition -o single.h5
# shellcheck disable=SC2086
stopped KILL single.chk 0.1 $chute --duration 6 --store float32 --compression 1 --keep-deposition -o parted.h5
$bin/grseg-sim --quiet --restart single.chk -o parted.h5
content single.h5 >single
content parted.h5 | cmp - single || fail "a restart changed the run in single precision"

# A run without its .part begins a new trajectory; a finished run is prolonged. Both have the frames
# of one long run.
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 2 --checkpoint two.chk -o two.h5
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 3 -o three.h5
$bin/grseg-sim --restart two.chk --duration 3 --quiet -o more.h5
for of in /particles/grains/position/step /particles/grains/velocity/value /observables/sweeps/value \
  /observables/base_force_y/value; do
  numbers $of three.h5 >long
  numbers $of two.h5 >short
  numbers $of more.h5 >>short
  cmp long short || fail "the prolonged run differs in $of"
done
# With the same command line again, scene file and all.
# shellcheck disable=SC2086
$bin/grseg-sim --quiet $chute --duration 3 --restart two.chk -o again.h5
content again.h5 >again
content more.h5 | cmp - again || fail "the scene file beside --restart changed the run"

# Perturbed copies of one state diverge, and their files record how they were made.
for seed in 1 2; do
  $bin/grseg-sim --restart two.chk --duration 3 --perturb 1e-6 --seed-perturbation $seed --quiet -o copy$seed.h5
  content copy$seed.h5 >copy$seed
done
cmp -s copy1 copy2 && fail "two seeds gave the same copy"
cmp -s copy1 again && fail "the perturbation changed nothing"
h5dump -d /parameters/seed_perturbation copy2.h5 | grep -q '(0): 2' || fail "the seed is not recorded"
h5dump -d /parameters/restart_time copy2.h5 | grep -q '(0): 2' || fail "the time is not recorded"

# Another time step: the time continues.
$bin/grseg-sim --restart two.chk --duration 3 --accuracy standard --quiet -o fine.h5
first=$(numbers /particles/grains/position/time fine.h5 | head -n 1)
case $first in 2.000*) ;; *) fail "with another step the run continues at t = $first" ;; esac

refused 2 "nowhere.chk: no such file" --restart nowhere.chk -o x.h5
refused 3 "whole.h5: is a run, not a checkpoint: grseg-stress makes a table of it" \
  --restart whole.h5 -o x.h5
head -c 20000 two.chk >torn.chk
refused 3 "torn.chk: is not a checkpoint, or is truncated or damaged" --restart torn.chk -o x.h5
refused 2 "phi-large differs from the checkpoint's: it belongs to the bed, which a restart cannot change; leave it out, or begin a new run without --restart" \
  --restart two.chk --phi-large 0.3 -o x.h5
refused 2 "two.chk is at t = 2 s, and the run ends at 2 s; choose a larger --duration" --restart two.chk -o x.h5
refused 2 "--perturb is 0.5: it must lie between 0 and 0.01 d_S" --restart two.chk --perturb 0.5 -o x.h5
refused 2 "--perturb displaces the grains of a checkpoint; name one with --restart" --perturb 1e-6 -o x.h5
refused 2 "two.chk already exists; choose another name, remove it, or pass --overwrite" \
  --restart run.chk --checkpoint two.chk -o x.h5
refused 2 "checkpoint and trajectory cannot be the same file; choose another name for --checkpoint" \
  --restart run.chk --checkpoint x.h5 -o x.h5

# A .part of another run stays as it is.
cp two.h5 x.h5.part
refused 2 "x.h5.part does not contain the frames of run.chk; move it away to begin a new trajectory, or choose another name for --output" \
  --restart run.chk -o x.h5
refused 2 "x.h5.part already exists; choose another name, remove it, or pass --overwrite" \
  --restart run.chk --slope 22 -o x.h5
cmp two.h5 x.h5.part || fail "the .part of another run was touched"
head -c 20000 two.h5 >x.h5.part
refused 3 "x.h5.part: is not an HDF5 file, or is truncated or damaged; move it away to begin a new trajectory at the checkpoint" \
  --restart run.chk -o x.h5
[ "$(wc -c <x.h5.part)" = 20000 ] || fail "a torn .part was touched"
for left in *.part.part *.chk.part; do [ ! -e "$left" ] || fail "$left was left behind"; done
