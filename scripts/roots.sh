# shellcheck shell=bash
# Functions for scripts that make minimal Debian systems in folders with mmdebstrap and run commands there as root.

# fail MESSAGE [CODE]: prints the message and ends the script with the exit code (default 1).
fail() {
  echo "$(basename "$0"): $1" >&2
  exit "${2:-1}"
}

# needs_mmdebstrap: ends the script unless it runs as root and mmdebstrap is installed.
needs_mmdebstrap() {
  [ "$(id -u)" = 0 ] || fail "run this script as root: it makes and enters a Debian system" 2
  command -v mmdebstrap >/dev/null || fail "mmdebstrap is missing; apt-get install mmdebstrap" 2
}

# keep_or_remove: removes $folder, unless $keep is set.
keep_or_remove() {
  if [ -n "$keep" ]; then echo "kept: $folder"; else rm -rf --one-file-system "$folder"; fi
}

# make_root ROOT SUITE [OPTION ...]: makes the Debian SUITE in the folder ROOT, with OPTIONs of mmdebstrap. If this
# machine runs SUITE, too, packages come from its mirrors. Proxy and name servers are always those of this machine.
make_root() {
  local root=$1 suite=$2 mirrors=() file
  shift 2
  rm -rf --one-file-system "$root"
  if grep -q "^VERSION_CODENAME=$suite\$" /etc/os-release; then
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources; do
      [ ! -s "$file" ] || mirrors+=("$file")
    done
  fi
  mmdebstrap --variant=minbase --dpkgopt=force-unsafe-io "$@" "$suite" "$root" "${mirrors[@]}" || return
  apt-config dump --format '%F "%v";%n' | grep '^Acquire::https\?::proxy' >"$root/etc/apt/apt.conf.d/99proxy" || true # grep fails if there is no proxy
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
}

# in_root ROOT FOLDER COMMAND: runs the shell command in FOLDER of the system in ROOT. Mounts and processes are in separate
# name spaces, so they end with the command, even if it is killed.
in_root() {
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child --propagation private sh -euc '
    mount -t proc proc "$1/proc"
    mount --rbind /dev "$1/dev"
    exec chroot "$1" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
      sh -euc "cd $2 && $3"' sh "$1" "$2" "$3"
}

# clone_into ROOT: clones the last commit of this repository into /grseg of the system in ROOT.
clone_into() {
  rm -rf "$1/grseg"
  git clone --quiet --no-hardlinks "$source" "$1/grseg" || return
  git -C "$1/grseg" log -1 --format='commit %h of %ci: %s'
}

# packages: prints the packages of the system in $root and their sizes, kB.
packages() { dpkg-query --admindir="$root/var/lib/dpkg" -W -f='${Package} ${Installed-Size}\n' | sort; }

# step NAME COMMAND...: runs the command, unless $folder/NAME.passed shows that it has passed before, and prints the time
# it took. set -e has no effect inside the command, so functions that are steps need `|| return`.
step() {
  local name=$1 began=$SECONDS before after
  shift
  if [ -e "$folder/$name.passed" ]; then
    echo "$name: passed before: $(cat "$folder/$name.passed")"
    return
  fi
  before=$([ ! -e "$root/var/lib/dpkg/status" ] || packages)
  if ! "$@" >"$folder/$name.log" 2>&1; then
    tail -n 30 "$folder/$name.log" >&2
    fail "$name: failed; its whole output is in $folder/$name.log"
  fi
  after=$(packages)
  {
    awk -v s=$((SECONDS - began)) 'BEGIN { printf "%.1f min", s / 60 }'
    comm -13 <(echo "$before") <(echo "$after") |
      awk '{ n += 1; kb += $2 } END { if (n) printf ", %d packages installed, %.0f MB", n, kb / 1024 }'
    grep -h 'tests passed\|files (.* differences' "$folder/$name.log" | sed 's/^/, /' | tr -d '\n' || true # grep fails for steps without such a line
    echo
  } >"$folder/$name.passed"
  echo "$name: passed: $(cat "$folder/$name.passed")"
}

