#!/usr/bin/env bash
# The checks of .clang-tidy over all C++ sources, or over those named:
#   bash tests/tidy.sh [FILE...]
# It only configures a build in build/tidy, for the flags of each file.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../cases/environment.sh"

install_debian_packages "${debian_packages[@]}" "${test_packages[@]}"
make_venv
"$python" -m pip install -qq "clang-tidy~=23.1" "pybind11>=3.0,<4"
cd "$root"
mkdir -p build

# Without precompiled headers: those of GCC mean nothing to clang-tidy.
cmake -S . -B build/tidy -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXPORT_COMPILE_COMMANDS=ON \
  -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DHYDRODAE_BUILD_TESTS=ON -DSKBUILD=ON \
  -Dpybind11_DIR="$("$python" -m pybind11 --cmakedir)" -DPython_EXECUTABLE="$python" \
  >build/tidy.log || { cat build/tidy.log; fail "CMake failed"; }

files=("$@")
if ((!$#)); then
  mapfile -t files < <("$python" -c '
import json
print(*sorted({entry["file"] for entry in json.load(open("build/tidy/compile_commands.json"))}), sep="\n")')
fi
note "clang-tidy: ${#files[@]} files"
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" .venv/bin/clang-tidy -p build/tidy --quiet
