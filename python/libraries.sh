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

fetch() { curl -sSfL "https://github.com/$1/archive/refs/tags/v$2.tar.gz" | tar xz -C "$work"; }
install_cmake() {
  local name=$1
  shift
  cmake -S "$work/$name" -B "$work/build-$name" -DCMAKE_BUILD_TYPE=Release "$@"
  cmake --build "$work/build-$name" --parallel "$(nproc)"
  cmake --install "$work/build-$name"
  install -D -m 644 -t "/usr/local/share/licenses/$name" "$work/$name/LICENSE"
}
fetch LLNL/sundials "$sundials"
install_cmake "sundials-$sundials" -DENABLE_KLU=ON -DKLU_INCLUDE_DIR=/usr/include/suitesparse \
  -DKLU_LIBRARY_DIR=/usr/lib64 -DBUILD_STATIC_LIBS=OFF -DEXAMPLES_ENABLE_C=OFF
fetch marzer/tomlplusplus "$tomlplusplus"
install_cmake "tomlplusplus-$tomlplusplus"
