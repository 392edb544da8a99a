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
dnf install -y eigen3-devel hdf5-devel libaec-devel minizip-compat-devel pugixml-devel \
  suitesparse-devel zlib-devel

# An HDF5 that reads from S3 brings libcurl, OpenSSL and GnuTLS: 7 MB more in the wheel.
if ldd "$(ldconfig -p | sed -n 's/.*libhdf5\.so.* => //p' | head -n 1)" | grep -q libcurl; then
  printf 'libraries.sh: the HDF5 of this system is linked with libcurl; build one without the S3 driver\n' >&2
  exit 1
fi

fetch() { curl -sSfL "https://github.com/$1/archive/refs/tags/v$2.tar.gz" | tar xz -C "$work"; }
install_cmake() {
  local name=$1
  shift
  cmake -S "$work/$name" -B "$work/build-$name" -DCMAKE_BUILD_TYPE=Release "$@"
  cmake --build "$work/build-$name" --parallel "$(nproc)"
  cmake --install "$work/build-$name"
}
fetch LLNL/sundials "$sundials"
install_cmake "sundials-$sundials" -DENABLE_KLU=ON -DKLU_INCLUDE_DIR=/usr/include/suitesparse \
  -DKLU_LIBRARY_DIR=/usr/lib64 -DBUILD_STATIC_LIBS=OFF -DEXAMPLES_ENABLE_C=OFF
fetch marzer/tomlplusplus "$tomlplusplus"
install_cmake "tomlplusplus-$tomlplusplus"
