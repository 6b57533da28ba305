#!/usr/bin/env bash
# lammps3d_stress_test.sh SOURCE BIN: six components of the stress of spheres of two sizes by
# grseg-stress --assign grain, against compute stress/atom in the archive, layer by layer.
set -euo pipefail
source=$1 bin=$2
at=$source/tests/inputs/lammps3d
cd "$(mktemp -d)"
trap 'rm -r "$PWD"' EXIT

"$bin/grseg-import" --format lammps --grains "$at/atoms.dump.gz" --contacts "$at/contacts.dump.gz" --axes xz \
  --units 1:1:1 --step 8.8e-4 --gravity 1 --slope 32 --boundary 1 --small 2 --large 3 -o run.h5 2>/dev/null

# differences LAYER: of all layers and components, relative to the species' pressure in the layer
differences() {
  "$bin/grseg-stress" run.h5 --assign grain --window 0.0088 --layer "$1" --quiet -o "sums-$1.tsv"
  /usr/bin/python3 "$source/scripts/archives/stress-atom" run.h5 "sums-$1.tsv" "$at/atoms.dump.gz" --axes xz |
    tee "layers-$1.tsv"
}
differences 0.6dS # most pairs that touch lie in different layers
differences 5dS   # one layer holds all grains
awk -F'\t' 'FNR == 1 { next }
     { for (k = 6; k <= 9; k += 3) wrong += $k != "nan" && $k^2 > 1e-20
       seen[$3] += ($4 != 0) * ($7 != 0) }
     END { exit wrong > 0 || length(seen) != 6 || !(seen["xx"] && seen["yy"] && seen["zz"] && seen["yx"] &&
           seen["yz"] && seen["zx"]) }' layers-0.6dS.tsv layers-5dS.tsv

# With the archive taken for one whose y is up, the components are others.
/usr/bin/python3 "$source/scripts/archives/stress-atom" run.h5 sums-5dS.tsv "$at/atoms.dump.gz" --axes xy >wrong-axes.tsv
awk -F'\t' 'NR > 1 && $6 != "nan" { wrong += $6^2 > 1e-4 } END { exit wrong == 0 }' wrong-axes.tsv
