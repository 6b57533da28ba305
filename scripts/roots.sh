# shellcheck shell=bash
# Minimal Debian systems in folders, for scripts that source this file: made by mmdebstrap, entered as root.

# fail MESSAGE [CODE]
fail() {
  echo "$(basename "$0"): $1" >&2
  exit "${2:-1}"
}

# needs_mmdebstrap, and to be root
needs_mmdebstrap() {
  [ "$(id -u)" = 0 ] || fail "run me as root: a Debian is made and entered" 2
  command -v mmdebstrap >/dev/null || fail "mmdebstrap is missing; apt-get install mmdebstrap" 2
}

# keep_or_remove: $folder, by $keep.
keep_or_remove() {
  if [ -n "$keep" ]; then echo "kept: $folder"; else rm -rf --one-file-system "$folder"; fi
}

# make_root ROOT SUITE OPTION...: options of mmdebstrap. Where this machine runs SUITE too, packages come from
# the same mirrors; proxy and name servers are always this machine's.
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
  apt-config dump --format '%F "%v";%n' | grep '^Acquire::https\?::proxy' >"$root/etc/apt/apt.conf.d/99proxy" || true # grep fails where there is no proxy
  cp -L /etc/resolv.conf "$root/etc/resolv.conf"
}

# in_root ROOT FOLDER COMMAND. Mounts and processes are in name spaces of their own: they end with the command, however it ends.
in_root() {
  # shellcheck disable=SC2016
  unshare --mount --pid --fork --kill-child --propagation private sh -euc '
    mount -t proc proc "$1/proc"
    mount --rbind /dev "$1/dev"
    exec chroot "$1" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
      sh -euc "cd $2 && $3"' sh "$1" "$2" "$3"
}

# clone_into ROOT: the last commit of this repository, as /grseg.
clone_into() {
  rm -rf "$1/grseg"
  git clone --quiet --no-hardlinks "$source" "$1/grseg" || return
  git -C "$1/grseg" log -1 --format='commit %h of %ci: %s'
}

# The packages of the folder `root` and their sizes, kB.
packages() { dpkg-query --admindir="$root/var/lib/dpkg" -W -f='${Package} ${Installed-Size}\n' | sort; }

# step NAME COMMAND...: runs the command unless $folder/NAME.passed says that it has passed before; says how long it
# took. Within the command a failure does not end the shell (set -e), hence `|| return`.
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
    fail "$name: failed; all that it printed is in $folder/$name.log"
  fi
  after=$(packages)
  {
    awk -v s=$((SECONDS - began)) 'BEGIN { printf "%.1f min", s / 60 }'
    comm -13 <(echo "$before") <(echo "$after") |
      awk '{ n += 1; kb += $2 } END { if (n) printf ", %d packages installed, %.0f MB", n, kb / 1024 }'
    grep -h 'tests passed\|files (.* differences' "$folder/$name.log" | sed 's/^/, /' | tr -d '\n' || true # grep fails for steps that count nothing
    echo
  } >"$folder/$name.passed"
  echo "$name: passed: $(cat "$folder/$name.passed")"
}

