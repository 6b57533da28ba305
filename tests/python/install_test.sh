#!/bin/sh
# install_test.sh SOURCE BUILD: grseg.py goes where Debian's python3 looks under /usr/local and under /usr, and to the
# place that docs/guide/python.md names under another prefix, from which it is imported.
set -eu
source=$1 build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for prefix in /usr/local /usr; do
  DESTDIR="$folder/root" cmake --install "$build" --component python --prefix $prefix >>said
done
for place in $(/usr/bin/python3 -c 'import site; print(*site.getsitepackages()[:2])'); do
  cmp "$source/analysis/python/grseg.py" "root$place/grseg.py"
done

cmake --install "$build" --component python --prefix "$folder/own" >>said
PYTHONPATH="$folder/own/lib/python3/dist-packages" /usr/bin/python3 -B -c '
import sys, grseg
assert grseg.__file__.startswith(sys.argv[2]), grseg.__file__
with grseg.Run(sys.argv[1]) as run: assert len(run) == 200' "$source/data/sample/chute.h5" "$folder/own"
