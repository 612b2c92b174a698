#!/usr/bin/env bash
# clang-tidy over the rooms with the commands of a configured build tree; findings are errors (.clang-tidy).
#   scripts/check_tidy.sh BUILD [FILE-PATTERN]
set -euo pipefail
cd "$(dirname "$0")/.."

run-clang-tidy-16 -quiet -p "$1" -j "$(nproc)" "${2:-$PWD/meniscus/.*\.cpp}" 2> >(grep -v 'warnings\? generated' >&2)
echo "tidy: no findings"
