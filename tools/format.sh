#!/usr/bin/env bash
# Formats every .h and .cc file of the project with clang-format; --check only says which differ.
set -euo pipefail

usage() {
  echo "usage: tools/format.sh [--check]"
  echo "Formats all .h and .cc files; with --check changes nothing and fails if one is not formatted."
}

mode=(-i)
case "${1:-}" in
  "") ;;
  --check) mode=(--dry-run --Werror) ;;
  --help | -h) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Versions of clang-format differ in details; 14 is the one that decides.
formatter="$(command -v clang-format-14 || command -v clang-format || true)"
if [ -z "$formatter" ]; then
  echo "format: clang-format is not installed; run tools/setup.sh." >&2
  exit 1
fi

folders=()
for folder in core residuals problems tools tests; do
  [ -d "$folder" ] && folders+=("$folder")
done
mapfile -d '' -t files < <(find "${folders[@]}" -type f \( -name '*.h' -o -name '*.cc' \) -print0)
if [ "${#files[@]}" -eq 0 ]; then
  echo "format: there is no .h or .cc file yet."
  exit 0
fi

if ! printf '%s\0' "${files[@]}" |
  xargs -0 -n 20 -P "$(nproc)" "$formatter" --style=file "${mode[@]}"; then
  echo "format: the files named above are not formatted; run tools/format.sh." >&2
  exit 1
fi
echo "format: ${#files[@]} files are formatted."
