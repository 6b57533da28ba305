#!/bin/bash
# One scene in odd environments: locales, variables, limits, names, closed streams. Each gives the table of a plain
# environment, or is refused with one sentence that names the cause. Usage: environments_test.sh SOURCE BIN
set -u
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
wrong=0
fail() { echo "$1" >&2; wrong=1; }
printf '%s\n' 'length = 8dL' 'depth = 16dS' 'duration = 0.4' 'accuracy = draft' >s.ini
rows() { "$bin/grseg-stress" "$1" --window 0.2 2>/dev/null | grep -v '^#' | md5sum; }
# same NAME COMMAND...: the run under COMMAND has the rows of the plain run.
same() {
  local name=$1
  shift
  rm -f r.h5*
  "$@" "$bin/grseg-sim" s.ini --quiet -o r.h5 >said 2>&1 || { fail "$name: exit code $?: $(head -1 said)"; return; }
  [ "$(rows r.h5)" = "$plain" ] || fail "$name: other numbers"
}
# refused NAME CODE SENTENCE COMMAND...
refused() {
  local name=$1 expected=$2 sentence=$3 code=0
  shift 3
  "$@" >said 2>&1 || code=$?
  [ $code = "$expected" ] && grep -q -- "$sentence" said || fail "$name: exit code $code: $(head -1 said)"
}
# limited LIMIT...: a command under ulimit LIMIT, without files that the caller has left open.
limited() { bash -c "for f in {3..20}; do eval \"exec \$f>&-\"; done; ulimit $1 $2; shift 2; \"\$@\"" x "$@"; }
masked() { bash -c 'umask $1; shift; "$@"' x "$@"; }
sim=("$bin/grseg-sim" s.ini --quiet)

"${sim[@]}" -o plain.h5 && plain=$(rows plain.h5)
mkdir locales
for name in de_DE tr_TR ar_EG hi_IN; do
  localedef -i $name -f UTF-8 "locales/$name.UTF-8" 2>/dev/null # without it the C locale is tried
  same "LC_ALL=$name" env LOCPATH="$PWD/locales" LC_ALL=$name.UTF-8 LANG=$name.UTF-8
done
same "empty environment" env -i ${ASAN_OPTIONS+ASAN_OPTIONS="$ASAN_OPTIONS"}
same "no HOME, TMPDIR, TERM" env HOME=/nonexistent TMPDIR=/nonexistent TERM=
for variable in OMP_NUM_THREADS=0 OMP_NUM_THREADS=abc OMP_NUM_THREADS=999 OMP_STACKSIZE=1 OMP_THREAD_LIMIT=1 \
  GOMP_CPU_AFFINITY=77 TZ=Mars/X HDF5_DRIVER=foo COLUMNS=-1; do
  same $variable env $variable
done
same "umask 0" masked 0
same "standard streams closed" bash -c '"$@" <&- >&- 2>&-' x
rm -f r.h5*
refused "ulimit -f" 1 "r.h5: File too large; is there a limit (ulimit -f, quota)?" \
  limited -f 200 "${sim[@]}" -o r.h5
refused "ulimit -n" 1 "Too many open files" limited -n 4 "${sim[@]}" -o r.h5

for name in $'a\nb.h5' $'caf\xe9.h5' ' .h5' '-.h5'; do
  "${sim[@]}" -o "./$name" && [ "$(rows "./$name")" = "$plain" ] || fail "$name: other numbers"
done
refused "long name" 1 "File name too long" "${sim[@]}" -o "$(printf 'x%.0s' {1..250}).h5"

table=("$bin/grseg-stress" plain.h5 --window 0.2)
"${table[@]}" >/dev/full 2>said
[ $? = 1 ] && grep -q "cannot write to standard output: No space left on device" said || fail "full device: $(cat said)"

mkdir scratch
ln -s scratch/x.h5 link.h5
refused "dangling link" 2 "link.h5 is a link to scratch/x.h5, which does not exist" "${sim[@]}" -o link.h5
"${sim[@]}" -o link.h5 --overwrite && [ -L link.h5 ] && [ "$(rows scratch/x.h5)" = "$plain" ] || fail "a link is not followed"
ln -s scratch/x.tsv link.tsv
"${table[@]}" -o link.tsv --overwrite --quiet && [ -L link.tsv ] && [ -s scratch/x.tsv ] || fail "a link is not followed by a table"
[ "$(echo *.part* *.tmp.* *.lock)" = '*.part* *.tmp.* *.lock' ] || fail "left behind: $(ls)"
ln plain.h5 hard.h5
refused "hard link to the input" 2 "under another name" "$bin/grseg-export" plain.h5 --to extxyz -o hard.h5 --overwrite

if [ "$(id -u)" = 0 ]; then # these need root: to become somebody else, to unmount
  chmod 755 . && mkdir -m 777 open
  refused "umask 777" 1 "Permission denied; is the umask too strict?" masked 777 \
    setpriv --reuid=65534 --regid=65534 --clear-groups "$bin/grseg-stress" plain.h5 --window all -o open/o.tsv
  unshare -m true 2>/dev/null && same "no /proc" unshare -m bash -c 'umount -l /proc; "$@"' x
fi
exit $wrong
