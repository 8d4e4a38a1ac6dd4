#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian 12 packages that semview needs. Asks nothing; does nothing when all are there.
#
#   tools/install_deps.sh --build     what compiling needs (the default)
#   tools/install_deps.sh --test      that, and what the tests need
#   tools/install_deps.sh --bench     that of --build, the benchmarks, and what they compare with
#   tools/install_deps.sh --runtime   only the libraries that the installed programs need
set -euo pipefail

# OpenVDB's headers include those of Boost, which its package does not bring.
build=(
  cmake ninja-build g++ pkg-config
  libembree-dev libeigen3-dev libtinygltf-dev nlohmann-json3-dev
  cppzmq-dev libzmq3-dev libprotobuf-dev protobuf-compiler
  liblmdb-dev libzstd-dev libxxhash-dev libhwy-dev
  libyaml-cpp-dev libpng-dev libjpeg-dev libcairo2-dev
  libopencv-core-dev libopencv-imgproc-dev libopencv-dnn-dev
  libopenvdb-dev libboost-dev
  libspdlog-dev libfmt-dev libcli11-dev libexpected-dev
  ca-certificates
)
# The fresh Debian has no Python; the demo's pictures and programs need none.
test=(
  libgtest-dev libgmock-dev librapidcheck-dev libbenchmark-dev
  python3 python3-numpy python3-zmq python3-protobuf
  libopenvdb-tools
  clang-format git
)
# Open3D brings fifty libraries; without it `semview bench` says so in its rows.
bench=(libbenchmark-dev libopen3d-dev python3 python3-numpy)
runtime=(
  libembree3-3 libzmq5 libprotobuf32 liblmdb0 libzstd1 libxxhash0 libhwy1
  libyaml-cpp0.7 libpng16-16 libjpeg62-turbo libcairo2 libopencv-dnn406 libspdlog1.10 libfmt9
  libopenvdb10.0 libtbb12 libimath-3-1-29
  ca-certificates
)

say() { printf '%s\n' "install_deps: $*"; }
die() { printf '%s\n' "install_deps: $*" >&2; exit 1; }

wanted=()
case "${1:---build}" in
  --build) wanted=("${build[@]}") ;;
  --test) wanted=("${build[@]}" "${test[@]}") ;;
  --bench) wanted=("${build[@]}" "${bench[@]}") ;;
  --runtime) wanted=("${runtime[@]}") ;;
  *) sed -n '3,9p' "$0" | cut -c3-; exit 2 ;;
esac
# npm only where no npm is: a Node.js from elsewhere conflicts with Debian's package.
if [[ "${1:-}" == --test ]] && ! command -v npm >/dev/null; then
  wanted+=(npm)
fi

command -v dpkg-query >/dev/null ||
  die "this is not Debian; install the equivalents of: ${wanted[*]}"

missing=()
for package in "${wanted[@]}"; do
  state=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ "$state" == installed ]] || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  say "all ${#wanted[@]} packages are installed"
  exit 0
fi

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo >/dev/null ||
    die "not root, and there is no sudo; as root run: apt-get install --no-install-recommends ${missing[*]}"
  sudo -n true 2>/dev/null ||
    die "sudo wants a password; run once yourself: sudo apt-get install --no-install-recommends ${missing[*]}"
  as_root=(sudo -n)
fi

say "installing ${#missing[@]} packages: ${missing[*]}"
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 \
    -o Acquire::Retries=3 "$@"
}
apt update >/dev/null ||
  die "apt-get update failed: is there a network, and are the sources in /etc/apt right?"
output=$(mktemp)
trap 'rm -f "$output"' EXIT
apt install --no-install-recommends "${missing[@]}" >"$output" 2>&1 || {
  tail -n 20 "$output" >&2
  die "apt-get install failed, for the reason above; mend it and run this again"
}
say "done"
