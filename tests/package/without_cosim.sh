#!/usr/bin/env bash
# A build without FMUs and TCP/IP: it compiles, runs a case, and refuses by name the controllers that
# need them.
#   bash tests/package/without_cosim.sh [BUILD]     default: build/without_cosim
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${1:-$root/build/without_cosim}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_UNITY_BUILD=ON \
  -DHYDRODAE_FMU=OFF -DHYDRODAE_TCP=OFF
cmake --build "$build"
solve=$build/cpp/hydrodae-solve
cp "$root"/python/hydrodae/starters/flap/{case.toml,hydro.h5} "$work"
: >"$work/pi.fmu"
"$solve" "$work/case.toml" -o "$work/case.h5" --set solver.end_time=1 --quiet

# refused MESSAGE KEY...: a controller with these keys ends the run with exit code 2.
refused() {
  local message=$1 code=0
  shift
  {
    cat "$root/python/hydrodae/starters/flap/case.toml"
    printf '\n[[controller]]\nname = "other"\nperiod = 0.1\n'
    printf '%s\n' "$@"
  } >"$work/case.toml"
  "$solve" "$work/case.toml" -o "$work/refused.h5" --quiet 2>"$work/told" || code=$?
  cat "$work/told"
  [[ $code == 2 ]]
  grep -q "controller 'other': this build of hydrodae $message" "$work/told"
}

inputs='inputs = ["joints/hinge/angle_rate"]'
outputs='outputs = ["forces/pto/load"]'
refused "has no TCP" 'type = "tcp"' "$inputs" "$outputs" 'port = 50000'
refused "takes no FMU" 'type = "fmu"' "$inputs" "$outputs" 'file = "pi.fmu"' \
  'fmu_inputs = ["u"]' 'fmu_outputs = ["y"]'
