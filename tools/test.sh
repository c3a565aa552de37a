#!/usr/bin/env bash
# Checks everything: format, layers, both builds with their tests, clang-tidy.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tools/test.sh [--quick] [--slow] [--help]

Installs what is missing, then checks in this order:
  format      clang-format would change no file
  layers      the #includes run one way
  citations   every document and section that is cited exists
  includes    each file includes what it uses of the standard library (cpplint)
  release     release build without warnings, and its tests
  tidy        clang-tidy has no finding (with --slow its path analysis, too)
  asan-ubsan  build with the address and undefined-behaviour sanitizers, and its tests

  --quick  only the release build and its tests
  --slow   runs the slow tests of the release build and clang-tidy's path analysis, too

A step that fails does not keep the others from running. Exit status: 0 = all passed, 1 = not.
TEXT
}

quick=no
slow=no
for argument in "$@"; do
  case "$argument" in
    --quick) quick=yes ;;
    --slow) slow=yes ;;
    --help | -h) usage; exit 0 ;;
    *) echo "test: unknown argument $argument" >&2; usage >&2; exit 2 ;;
  esac
done

cd "$(dirname "${BASH_SOURCE[0]}")/.."
jobs="$(nproc)"
# Real recordings and other people's cases are not part of the repository, but may lie beside it; the
# tests that need them skip without.
if [ -z "${DHCAL_SHARED:-}" ] && [ -d ../shared ]; then
  DHCAL_SHARED="$(cd ../shared && pwd)"
fi
if [ -z "${DHCAL_DATA:-}" ] && [ -d "${DHCAL_SHARED:-}/data" ]; then
  DHCAL_DATA="$DHCAL_SHARED/data"
fi
export DHCAL_DATA="${DHCAL_DATA:-}" DHCAL_SHARED="${DHCAL_SHARED:-}"
logs="$(mktemp -d)"
trap 'rm -rf "$logs"' EXIT

durations=()
summaries=()
failed=()

# step <name> <command>...: runs a step, remembers how long it took and whether it failed.
step() {
  local name="$1" start=$SECONDS result=passed
  shift
  echo
  echo "== $name"
  if ! "$@"; then
    result=FAILED
    failed+=("$name")
  fi
  durations+=("$(printf '%-18s %4d s  %s' "$name" $((SECONDS - start)) "$result")")
  [ "$result" = passed ]
}

# configure <preset>: its lines are shown only if it fails.
configure() {
  local log="$logs/configure-$1"
  cmake --preset "$1" -DDHCAL_WERROR=ON >"$log" 2>&1 || { cat "$log"; return 1; }
}

build() {
  configure "$1" && cmake --build --preset "$1" -j "$jobs"
}

# tidy: the release build compiles in batches, so the commands of single files are those of `dev`.
tidy() {
  local options=(--no-analyzer)
  [ "$slow" = no ] || options=()
  configure dev && python3 tools/tidy.py --build build/dev --jobs "$jobs" "${options[@]}"
}

# run_tests <test preset>: runs the tests and keeps CTest's summary for the end.
run_tests() {
  local log="$logs/tests-$1" status=0
  ctest --preset "$1" -j "$jobs" 2>&1 | tee "$log" || status=$?
  local summary
  summary="$(grep -E 'tests passed, [0-9]+ tests failed out of [0-9]+' "$log" || true)"
  summaries+=("$1:" "${summary:-no test ran}")
  return "$status"
}

# build_and_test <build preset> [<test preset>...]: tests only what could be built.
build_and_test() {
  local preset="$1"
  shift
  step "$preset build" build "$preset" || return 0
  for tests in "$@"; do
    step "$tests tests" run_tests "$tests" || true
  done
}

release_tests=(release)
[ "$slow" = no ] || release_tests+=(slow)

step setup bash tools/setup.sh || true
if [ "$quick" = no ]; then
  step format bash tools/format.sh --check || true
  step layers python3 tools/check_layers.py || true
  step citations python3 tools/check_citations.py || true
  step includes cpplint --quiet --recursive --filter=-,+build/include_what_you_use \
    core residuals problems tools tests || true
fi
build_and_test release "${release_tests[@]}"
if [ "$quick" = no ]; then
  step tidy tidy || true
  build_and_test asan-ubsan asan-ubsan
fi

echo
echo "== how long each step took ($SECONDS s in all)"
printf '%s\n' "${durations[@]}"
echo
echo "== what CTest said"
printf '%s\n' "${summaries[@]:-no test ran}"
echo
if [ "${#failed[@]}" -gt 0 ]; then
  printf -v names '%s, ' "${failed[@]}"
  echo "Not all is well: ${names%, } failed; see its lines above."
  exit 1
fi
echo "All steps passed."
