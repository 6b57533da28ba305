#!/bin/sh
# unknown_images_test.sh SOURCE BIN: an archive that does not tell how often grains have crossed its
# periods. The run then has no images, for any reader.
set -eu
source=$1 bin=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$1" >&2; exit 1; }

sample=$source/data/sample/spheres
zcat "$sample/atoms.dump.gz" | sed '/^ITEM: ATOMS/ s/ ix iy iz/ v_a v_b v_c/' >atoms.dump
"$bin/grseg-import" --format lammps --grains atoms.dump --contacts "$sample/contacts.dump.gz" --units 1:1:1 --step 8.8e-4 \
  --gravity 1 --slope 26 --axes xz --boundary 1 --small 2 --large 3 --quiet -o run.h5
"$bin/grseg-export" run.h5 --to lammps --quiet -o out.dump
grep -q '^ITEM: ATOMS' out.dump || fail "no dump was written"
! grep -q '^ITEM: ATOMS.* ix' out.dump || fail "an export states images that nobody knows"
"$bin/grseg-check" run.h5 --physics --quiet >check.tsv
for drift in x_drift z_drift; do
  grep -q "^$drift.*skipped.*does not tell how often grains have crossed a period" check.tsv || fail "$(grep $drift check.tsv)"
done
PYTHONPATH=$source/analysis/python /usr/bin/python3 -c "
import grseg
run = grseg.Run('run.h5')
assert not run.has_images and run[3].image.mask.all()" || fail "grseg.py gives images that nobody knows"
