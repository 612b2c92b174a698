#!/usr/bin/env bash
# Installs the Debian 12 packages that are missing for one purpose and does nothing when none is.
#   scripts/setup.sh bare|run|test|long|coverage|docs|deb|release
# `bare` is `run` without node and npm, whose reports have no pictures, and without the Python module.
set -euo pipefail

build=(make g++ cmake ninja-build pkgconf git ca-certificates python3 libpetsc-real-dev openmpi-bin
       libopenblas-dev libeigen3-dev libboost-dev libcgal-dev libtet1.5-dev libhdf5-openmpi-dev libvtk9-dev
       libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libspdlog-dev zlib1g-dev
       librsvg2-dev fonts-dejavu-core libmicrohttpd-dev)
# Pages and pictures: npm to build them, nodejs also for `meniscus report --svg`. Where node came from elsewhere, Debian's npm conflicts with it.
page=()
command -v npm >/dev/null || page=(nodejs npm)
# The Python module.
python=(python3-dev python3-numpy pybind11-dev)
test=(libgtest-dev clang-format-14 python3-matplotlib mypy)
browser=(chromium)
# clang 14, Debian's default, cannot read the ranges of libstdc++ 12.
long=(clang-tidy-16 libbenchmark-dev)
coverage=(gcovr)
docs=(python3 mkdocs mkdocs-material python3-pymdownx libjs-mathjax doxygen)
deb=(dpkg-dev file gzip)
release=(mmdebstrap libcgal-demo slurm-wlm munge)

case "${1:-}" in
  bare) wanted=("${build[@]}") ;;
  run) wanted=("${build[@]}" "${page[@]}" "${python[@]}") ;;
  test) wanted=("${build[@]}" "${page[@]}" "${python[@]}" "${test[@]}" "${browser[@]}") ;;
  long) wanted=("${build[@]}" "${page[@]}" "${python[@]}" "${test[@]}" "${browser[@]}" "${long[@]}") ;;
  coverage) wanted=("${build[@]}" "${test[@]}" "${coverage[@]}") ;;
  docs) wanted=("${docs[@]}") ;;
  deb) wanted=("${build[@]}" "${page[@]}" "${python[@]}" "${deb[@]}") ;;
  release) wanted=("${build[@]}" "${page[@]}" "${python[@]}" "${deb[@]}" "${release[@]}") ;;
  *) echo "usage: $0 bare|run|test|long|coverage|docs|deb|release" >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null; then
  echo "setup: no Debian packages here; this needs the equivalents of: ${wanted[*]}"
  exit 0
fi

missing=()
for package in "${wanted[@]}"; do
  dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
    missing+=("$package")
done
if ((${#missing[@]} == 0)); then
  exit 0
fi

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || {
    echo "setup: become root, or install sudo, to install: ${missing[*]}" >&2
    exit 1
  }
  as_root=(sudo)
fi
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=600)
echo "setup: installing ${missing[*]}"
"${apt[@]}" update
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" >/dev/null
echo "setup: done"
