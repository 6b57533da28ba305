#!/usr/bin/env bash
# lammps_stress_test.sh SOURCE BIN: grseg-stress --assign grain of an import against compute stress/atom
# in the archive, layer by layer; and grseg-fit --partition half --base-part half of either.
set -euo pipefail
source=$1 bin=$2
at=$source/tests/inputs/lammps
cd "$(mktemp -d)"
trap 'rm -r "$PWD"' EXIT

zcat "$at/elastic-atoms.dump.gz" >atoms.dump
"$bin/grseg-import" --format lammps --grains atoms.dump --contacts "$at/elastic-contacts.dump.zst" --step 1e-5 \
  --columns i=2,j=3,dist=6,force=7,tangential=10 --units si --gravity 9.8 --slope 23 --boundary 3 -o run.h5 2>/dev/null

# compare LAYER: both tables and what the script says of them.
compare() {
  "$bin/grseg-stress" run.h5 --assign grain --window 0.03 --layer "$1" --quiet -o "sums-$1.tsv"
  /usr/bin/python3 "$source/scripts/archives/stress-atom" run.h5 "sums-$1.tsv" atoms.dump --printed "printed-$1.tsv" |
    tee "layers-$1.tsv"
}
compare 3mm # most pairs that touch lie in different layers
awk 'function off(a, b, difference) { return a == 0 && b == 0 ? 0 : difference^2 > 1e-24 }
     NR > 1 { wrong += off($3, $4, $5) + off($6, $7, $8); with_large += $3 > 0; with_small += $6 > 0 }
     END { exit wrong > 0 || with_large < 1 || with_small < 6 }' layers-3mm.tsv

compare 2dS # one layer holds both species
for table in sums printed; do
  "$bin/grseg-fit" $table-2dS.tsv --partition half --base-part half --heights all --min-solid 0 --quiet |
    awk -F'\t' '$5 == "B" { printf "%.12g\n", $7 }' | tee $table.slope
done
[ -s sums.slope ] && cmp sums.slope printed.slope

# A scan takes its shares at the grains, too.
fit() { "$bin/grseg-fit" sums-2dS.tsv --base-part half --heights all --min-solid 0 --quiet "$@" | grep -v '^#'; }
b=$(fit --partition half | awk -F'\t' '$5 == "B" { print $7 }')
[ "$(fit --scan 0.5:0.6:0.1 | awk 'NR == 2 { print $2 }')" = "$b" ]
