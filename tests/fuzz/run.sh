#!/usr/bin/env bash
# Mutated case files, command lines, hydrodynamic databases, results files and runs of WEC-Sim,
# under sanitizers:
#   bash tests/fuzz/run.sh [--seconds 600] [--seed 1] [--inputs 10000]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../cases/environment.sh"

install_environment test
cd "$root"
build_preset tests hydrodae-fuzz
.venv/bin/python tests/fuzz/run.py "$@"
