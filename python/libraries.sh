#!/usr/bin/env bash
# What the kernel is linked with, inside a manylinux_2_34 container (AlmaLinux 9), which has no
# packages of SUNDIALS 6 and toml++; cibuildwheel calls it (pyproject.toml):
#   bash python/libraries.sh
set -euo pipefail
sundials=6.7.0
tomlplusplus=3.4.0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

dnf install -y epel-release dnf-plugins-core
dnf config-manager --set-enabled crb
dnf install -y eigen3-devel minizip-compat-devel pugixml-devel suitesparse-devel zlib-devel
bash "$(dirname "${BASH_SOURCE[0]}")/hdf5.sh" /opt/hdf5

# fetch URL SHA256: unpacks an archive that is what it was when this was written.
fetch() {
  curl -sSfL "https://github.com/$1" -o "$work/archive.tar.gz"
  sha256sum --check --quiet - <<<"$2  $work/archive.tar.gz"
  tar xzf "$work/archive.tar.gz" -C "$work"
}
install_cmake() {
  local name=$1
  shift
  cmake -S "$work/$name" -B "$work/build-$name" -DCMAKE_BUILD_TYPE=Release "$@"
  cmake --build "$work/build-$name" --parallel "$(nproc)"
  cmake --install "$work/build-$name"
  install -D -m 644 -t "/usr/local/share/licenses/$name" "$work/$name/LICENSE"
}
fetch "LLNL/sundials/releases/download/v$sundials/sundials-$sundials.tar.gz" \
  5f113a1564a9d2d98ff95249f4871a4c815a05dbb9b8866a82b13ab158c37adb
install_cmake "sundials-$sundials" -DENABLE_KLU=ON -DKLU_INCLUDE_DIR=/usr/include/suitesparse \
  -DKLU_LIBRARY_DIR=/usr/lib64 -DBUILD_STATIC_LIBS=OFF -DEXAMPLES_ENABLE_C=OFF
fetch "marzer/tomlplusplus/archive/refs/tags/v$tomlplusplus.tar.gz" \
  8517f65938a4faae9ccf8ebb36631a38c1cadfb5efa85d9a72e15b9e97d25155
install_cmake "tomlplusplus-$tomlplusplus"
