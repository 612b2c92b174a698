#!/usr/bin/env bash
# Fails on a C++ source that clang-format would change; with --fix, changes it.
# Version 14 is Debian 12's; others lay out differently.
set -euo pipefail
cd "$(dirname "$0")/.."

mapfile -t files < <(git ls-files '*.cpp' '*.hpp' 2>/dev/null)
if ((${#files[@]} == 0)); then  # not a repository: a source archive
  mapfile -t files < <(find meniscus tests bench examples -name '*.[ch]pp')
fi
if [[ ${1:-} == --fix ]]; then
  exec clang-format-14 -i "${files[@]}"
fi
clang-format-14 --dry-run -Werror "${files[@]}" || {
  echo "format: run make format" >&2
  exit 1
}
echo "format: ${#files[@]} files as clang-format writes them"
