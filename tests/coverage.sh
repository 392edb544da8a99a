#!/usr/bin/env bash
# Which lines of the Python package tests/python runs; arguments go to pytest:
#   bash tests/coverage.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../cases/environment.sh"

install_environment test
"$python" -m pip install -qq "pytest-cov>=7"
cd "$root"
.venv/bin/pytest -n "$(nproc)" --dist worksteal --cov=hydrodae --cov-report=term tests/python "$@"
