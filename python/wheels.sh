#!/usr/bin/env bash
# Wheels for every Python from 3.11 to 3.14 that is found here, each tried in an empty root:
#   bash python/wheels.sh [FOLDER] [PYTHON...]
# FOLDER (default dist) gets them; PYTHON are interpreters, by default python3.11 to python3.14 of PATH
# and of pyenv. With ccache in PATH the kernel compiles once.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=$(realpath -m "${1:-$root/dist}")
pythons=("${@:2}")
if ((${#pythons[@]} == 0)); then
  for minor in 11 12 13 14; do
    for python in "python3.$minor" ~/.pyenv/versions/"3.$minor".*/bin/python; do
      if "$python" -c '' 2>/dev/null; then
        pythons+=("$(command -v "$python")")
        break
      fi
    done
  done
fi
if command -v ccache >/dev/null; then
  export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_SLOPPINESS=pch_defines,time_macros
fi
mapfile -t needed < <("${pythons[0]}" -c '
import sys, tomllib
project = tomllib.load(open(sys.argv[1], "rb"))
print(*project["build-system"]["requires"], *project["project"]["optional-dependencies"]["wheel"], sep="\n")
' "$root/pyproject.toml")
for python in "${pythons[@]}"; do
  venv=$root/build/wheels/$("$python" -c 'import sys; print("cp%d%d" % sys.version_info[:2])')
  "$python" -m venv "$venv"
  "$venv/bin/python" -m pip install -q --disable-pip-version-check "${needed[@]}" cmake ninja
  PYTHON=$venv/bin/python bash "$root/python/wheel.sh" "$folder"
done
