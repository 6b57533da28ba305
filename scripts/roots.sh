# shellcheck shell=bash
# Minimal Debian systems in folders, for scripts that source this file: made by mmdebstrap, entered as root.

# fail MESSAGE [CODE]
fail() {
  echo "$(basename "$0"): $1" >&2
  exit "${2:-1}"
}

# make_root ROOT SUITE OPTION...: options of mmdebstrap. Where this machine runs SUITE too, packages come from
# the same mirrors; proxy and name servers are those of this machine anyway.
make_root() {
  local root=$1 suite=$2 mirrors=() file
  shift 2
  rm -rf --one-file-system "$root"
  if grep -q "^VERSION_CODENAME=$suite\$" /etc/os-release; then
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/debian.sources; do
      [ ! -s "$file" ] || mirrors+=("$file")
    done
  fi
  mmdebstrap --variant=minbase "$@" "$suite" "$root" "${mirrors[@]}"
  apt-config dump --format '%F "%v";%n' | grep '^Acquire::https\?::proxy' >"$root/etc/apt/apt.conf.d/99proxy" || true # none
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
