#!/bin/sh
# Runs chute.in once for every selection of columns.
set -eu
full="pos vel id force force_normal force_tangential torque history contactArea delta contactPoint"

run() { # name, keywords, numbers of columns
  columns=
  for k in $3; do columns="$columns c_cp[$k]"; done
  liggghts -in chute.in -log none -screen none -var name "$1" -var keywords "$2" -var columns "$columns"
}

run full35 "$full" "$(seq 35)"
run default25 "" "$(seq 25)"
run forcechain12 "pos id force" "$(seq 12)"
run part "$full" "32 14 13 16 17 18" # without positions and velocities, in another order
