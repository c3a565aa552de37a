#!/usr/bin/env bash
# Installs what is missing, builds the release program and runs the KUKA KR 15/2 case with it.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tools/run.sh [ceres_dhcal arguments]

Installs what is missing, builds ceres_dhcal and runs
  ceres_dhcal --problem problems/cases/kr15.yaml [ceres_dhcal arguments]
in the current directory. Another case instead: tools/run.sh --problem my_robot.yaml
TEXT
}

if [ "${1:-}" = --help ] || [ "${1:-}" = -h ]; then
  usage
  exit 0
fi

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
program="$root/build/release/bin/ceres_dhcal"

bash "$root/tools/setup.sh" --run
echo "run: building $program"
log="$(mktemp)"
trap 'rm -f "$log"' EXIT
# The program alone, without what only tests need; a folder that has them already keeps them.
tests=OFF
grep -qsx 'DHCAL_BUILD_TESTS:BOOL=ON' "$root/build/release/CMakeCache.txt" && tests=ON
if ! (cd "$root" && cmake --preset release -DDHCAL_BUILD_TESTS="$tests") >"$log" 2>&1 ||
  ! cmake --build "$root/build/release" --target ceres_dhcal -j "$(nproc)"; then
  # What configuring said is of interest only when something went wrong.
  cat "$log" >&2
  echo "The program could not be built; the lines above say why." >&2
  exit 1
fi

# A problem among the arguments takes the place of the paper's experiment.
problem=(--problem "$root/problems/cases/kr15.yaml")
for argument in "$@"; do
  case "$argument" in
    --problem | --problem=* | *.yaml | --help | --version) problem=() ;;
  esac
done
status=0
"$program" "${problem[@]}" "$@" || status=$?
if [ "$status" -eq 0 ]; then
  echo "Done: ceres_dhcal ran to its end; the lines above say what it found and where its report is."
else
  echo "ceres_dhcal ended with exit status $status; the lines above say why." >&2
fi
exit "$status"
