#!/usr/bin/env bash
# HDF5 for wheels: the C library with zlib alone. That of Debian reads from S3 too and brings libcurl,
# OpenSSL and GnuTLS, 7 MB of a wheel.
#   bash python/hdf5.sh PREFIX [SOURCE]
# PREFIX gets the library; SOURCE is an archive or folder of its sources, by default the release below.
set -euo pipefail
version=1.14.5
sha256=ec2e13c52e60f9a01491bb3158cb3778c985697131fc6a342262d32a26e58e44
prefix=$(realpath -m "${1:?usage: hdf5.sh PREFIX [SOURCE]}")
source=${2:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if [[ -z $source ]]; then
  source=$work/hdf5.tar.gz
  url=https://github.com/HDFGroup/hdf5/releases/download/hdf5_$version/hdf5-$version.tar.gz
  if ! curl -sSfL "$url" -o "$source"; then
    printf 'hdf5.sh: no download of %s\n' "$url" >&2
    printf 'set HDF5_SOURCE to an archive or folder of the sources of HDF5 (on Debian: apt-get source hdf5),\n' >&2
    printf 'or HDF5_ROOT to an installed HDF5 without the S3 driver\n' >&2
    exit 2
  fi
  sha256sum --check --quiet - <<<"$sha256  $source"
fi
if [[ -f $source ]]; then
  mkdir "$work/source"
  tar xf "$source" -C "$work/source" --strip-components 1
  source=$work/source
fi
cmake -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
  -DBUILD_STATIC_LIBS=OFF -DBUILD_TESTING=OFF -DHDF5_BUILD_TOOLS=OFF \
  -DHDF5_BUILD_EXAMPLES=OFF -DHDF5_BUILD_HL_LIB=OFF -DHDF5_ENABLE_ROS3_VFD=OFF \
  -DHDF5_ENABLE_Z_LIB_SUPPORT=ON -DHDF5_ENABLE_SZIP_SUPPORT=OFF >"$work/log" || { cat "$work/log" >&2; exit 1; }
cmake --build "$work/build" --target install --parallel "$(nproc)" >"$work/log" || { tail -n 50 "$work/log" >&2; exit 1; }
mkdir -p "$prefix/share/licenses/hdf5"
cp "$source"/COPYING* "$prefix/share/licenses/hdf5/"
