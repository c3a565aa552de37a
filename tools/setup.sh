#!/usr/bin/env bash
# Installs the packages that this machine lacks. Quick when it lacks none.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tools/setup.sh [--run] [--list] [--help]

Installs with apt-get what tools/packages.txt and tools/packages_test.txt list and this machine lacks.

  --run   only what building and running the program takes: tools/packages.txt
  --list  prints the packages' names and installs nothing
TEXT
}

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
lists=("$here/packages.txt" "$here/packages_test.txt")
list=no
for argument in "$@"; do
  case "$argument" in
    --run) lists=("$here/packages.txt") ;;
    --list) list=yes ;;
    --help | -h) usage; exit 0 ;;
    *) usage >&2; exit 2 ;;
  esac
done

mapfile -t wanted < <(sed -e 's/#.*//' -e 's/[[:space:]]//g' -e '/^$/d' "${lists[@]}")
if [ "$list" = yes ]; then
  printf '%s\n' "${wanted[@]}"
  exit 0
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup: this is no Debian system, so nothing was installed. The build needs what Debian calls:"
  printf '  %s\n' "${wanted[@]}"
  exit 0
fi

installed="$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null || true)"
missing=()
for package in "${wanted[@]}"; do
  grep -qxF "$package installed" <<<"$installed" || missing+=("$package")
done

if [ "${#missing[@]}" -eq 0 ]; then
  echo "setup: all ${#wanted[@]} packages are installed."
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup: missing ${missing[*]}; run tools/setup.sh as root, or install them by hand." >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "setup: installing ${missing[*]}"
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o Dpkg::Use-Pty=0 -qq)
"${apt[@]}" update || echo "setup: apt-get update failed; trying with the package lists at hand." >&2
if ! "${apt[@]}" install -y --no-install-recommends "${missing[@]}"; then
  echo "setup: apt-get could not install ${missing[*]}; its lines above say why." >&2
  exit 1
fi
echo "setup: installed ${#missing[@]} of ${#wanted[@]} packages; the others were there."
