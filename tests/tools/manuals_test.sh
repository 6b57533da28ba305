#!/bin/sh
# manuals_test.sh BUILD: manual pages and completions are installed of the programs that there are, and of no others,
# which an earlier build may have left; a page is named by what its program does and defines its columns; the Debian
# package suggests what makes films, figures and reads runs in Python.
set -eu
build=$1
folder=$(mktemp -d)
left="$build/completions/bash/grseg-gone $build/completions/zsh/_grseg-gone $build/man/grseg-gone.1"
trap 'rm -rf "$folder" $left' EXIT
touch $left

cmake --install "$build" --component manuals --prefix "$folder" >"$folder/said"
cd "$folder/share"
for file in bash-completion/completions/grseg- zsh/site-functions/_grseg- zsh/vendor-completions/_grseg- man/man1/grseg-; do
  # Without help2man there are no pages.
  [ $file = man/man1/grseg- ] && ! command -v help2man >"$folder/said" && continue
  ls $file* | grep -q 'grseg-stress\(\.1\)\?$'
  ls $file* | grep 'grseg-gone' && exit 1
done

for page in man/man1/*.1; do
  [ -e "$page" ] || continue
  program=$(basename "$page" .1)
  says=$("$build/bin/$program" --help | sed 's/: / - /; s/\.$//; q')
  if command -v lexgrog >"$folder/said"; then
    named=$(lexgrog "$page" | sed 's/^[^"]*"//; s/"$//')
  else
    named=$(sed -n '/^\.SH NAME/ { n; s/\\//g; p; q }' "$page")
  fi
  grep -q '^\.SH BUGS' "$page" && grep -q '^Report faults' "$page" && grep -q '^\.BR grseg\\*-import (1)' "$page" || {
    echo "$page: no BUGS or no SEE ALSO" >&2
    exit 1
  }
  [ "$named" = "$says" ] || { echo "$page: '$named', not '$says'" >&2; exit 1; }
done

page=man/man1/grseg-stress.1
[ ! -e $page ] || sed -n '/^\.SH COLUMNS/,$p' $page | grep -A 1 '^\.B M_{ab}\[N m\] or ' | grep -q '^the same sum over mixed contacts'

for package in ffmpeg gnuplot-nox python3-h5py; do
  grep -q "CPACK_DEBIAN_PACKAGE_SUGGESTS .*[\" ]$package[\",]" "$build/CPackConfig.cmake"
done
