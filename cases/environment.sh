# shellcheck shell=bash
# What cases/quickstart.sh, tests/run.sh and tests/fuzz/run.sh need: Debian packages, .venv, the built package.
# Source it from bash; it leaves `root` (the repository) and `python` (that of .venv) behind.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
python=$root/.venv/bin/python
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_ROOT_USER_ACTION=ignore

debian_packages=(
  build-essential cmake ninja-build pkg-config git                     # tools
  libeigen3-dev libsundials-dev libsuitesparse-dev libtomlplusplus-dev # mathematics, case files
  libhdf5-dev libaec-dev zlib1g-dev                                    # results
  libminizip-dev libpugixml-dev                                        # FMUs
  python3 python3-venv python3-dev
)
test_packages=(doctest-dev)

note() { printf '== %s\n' "$*"; }

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

# install_debian_packages NAME...: installs those that are missing; asks the network only then.
install_debian_packages() {
  local missing=() name as_root=()
  if ! command -v dpkg-query >/dev/null; then
    note "not a Debian system: taking for granted what provides $*"
    return
  fi
  for name in "$@"; do
    dpkg-query -W -f='${db:Status-Status}' "$name" 2>/dev/null | grep -qx installed ||
      missing+=("$name")
  done
  ((${#missing[@]})) || return 0
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      fail "Missing Debian packages, and no sudo to install them: ${missing[*]}"
    as_root=(sudo)
  fi
  note "installing Debian packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -qq --yes --no-install-recommends "${missing[@]}" >/dev/null
}

# Makes .venv; anew when its Python is gone or the repository was moved (scripts keep the old path).
make_venv() {
  if "$python" -c 'import pip' 2>/dev/null &&
    grep -qsF -- "-m venv $root/.venv" "$root/.venv/pyvenv.cfg"; then
    return
  fi
  python3 -c 'import sys; sys.exit(sys.version_info < (3, 11))' ||
    fail "hydrodae needs Python 3.11 or later; python3 is $(python3 --version 2>&1)"
  note "making .venv"
  rm -rf "$root/.venv"
  python3 -m venv "$root/.venv"
}

# One hash of everything that the wheel is built from.
source_hash() {
  (
    cd "$root" || exit
    find CMakeLists.txt pyproject.toml README.md LICENSE cpp python \
      -type f ! -path '*/__pycache__/*' ! -name scene.pyi -print0 |
      LC_ALL=C sort -z | xargs -0 sha256sum | sha256sum | cut -d ' ' -f 1
  )
}

# install_package [EXTRA]: builds and installs hydrodae with the extra (bem, test), unless what is
# installed was built from the same sources. A stamp for each extra keeps the hash of the sources.
install_package() {
  local extra=${1:-} stamp=$root/.venv/hydrodae hash
  hash=$(source_hash)
  [[ $(cat "$stamp${extra:+-$extra}.sha256" 2>/dev/null) == "$hash" ]] && return
  note "building hydrodae${extra:+ with the extra $extra}"
  # Without build isolation CMake finds the same tools again and compiles only what changed.
  "$python" - "$root/pyproject.toml" <<'PYTHON' | xargs -d '\n' "$python" -m pip install -qq
import sys, tomllib
print("\n".join(tomllib.load(open(sys.argv[1], "rb"))["build-system"]["requires"]))
PYTHON
  "$python" -m pip install -qq --no-build-isolation "$root${extra:+[$extra]}"
  printf '%s\n' "$hash" | tee "$stamp.sha256" >"$stamp${extra:+-$extra}.sha256"
}

# build_preset PRESET [TARGET]: the C++ tests and the fuzz driver, with assertions and sanitizers
# (preset `tests`).
build_preset() {
  local preset=$1
  mkdir -p "$root/build"
  (cd "$root" && cmake --preset "$preset") >"$root/build/$preset.log" ||
    { cat "$root/build/$preset.log"; fail "CMake failed"; }
  cmake --build "$root/build/$preset" ${2:+--target "$2"} -- --quiet
}

# install_environment [EXTRA]: all of the above.
install_environment() {
  local packages=("${debian_packages[@]}")
  [[ ${1:-} == test ]] && packages+=("${test_packages[@]}")
  install_debian_packages "${packages[@]}"
  make_venv
  install_package "$@"
}
