#!/bin/sh
# links_test.py names what is broken on a page, and nothing else. Usage: links_test_test.sh SOURCE
set -eu
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/docs" "$folder/sim"
echo 'int solve();' >"$folder/sim/solver.hpp"
cat >"$folder/README.md" <<'PAGE'
# A heading, with `code`
[good](docs) [good](#a-heading-with-code) [web](https://example.org) `sim/solver.hpp` `solver.hpp`
[bad](docs/none.md)
[bad](#no-such-heading)
`sim/none.hpp`
`none.hpp`
[solver](sim/solver.hpp) has `solve()`
[solver](sim/solver.hpp) has no `guess()`
PAGE
if said=$("$source/tests/docs/links_test.py" "$folder"); then
  echo "broken links pass" >&2
  exit 1
fi
lines=$(echo "$said" | sed -n 's/^README.md:\([0-9]*\):.*/\1/p' | tr '\n' ' ')
[ "$lines" = "3 4 5 6 8 " ] || { echo "$said" >&2; exit 1; }
