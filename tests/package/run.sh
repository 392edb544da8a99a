#!/usr/bin/env bash
# The library for C++ programs: installs a build into a folder of its own, builds the program beside
# this file with find_package(hydrodae), and runs it on a case.
#   bash tests/package/run.sh [BUILD]     default: what `pip install .` has left in build/
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
build=${1:-$(find "$root/build" -maxdepth 1 -name 'cp3*' -print -quit)}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake --install "$build" --prefix "$work/prefix" --component development >/dev/null
cmake -S "$here" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Debug
cmake --build "$work/build"
cp "$root"/python/hydrodae/starters/flap/{case.toml,hydro.h5} "$work"
"$work/build/energy" "$work/case.toml" "$work/case.h5" | tee "$work/told"
grep -q '^pto: [0-9]' "$work/told"
"$work/prefix/bin/hydrodae-solve" --version
