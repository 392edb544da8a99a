#!/usr/bin/env bash
# Which lines of the kernel the C++ tests run, and which of the Python package tests/python; arguments go
# to pytest:
#   bash tests/coverage.sh
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../cases/environment.sh"

install_environment test
"$python" -m pip install -qq "gcovr>=8" "pytest-cov>=7"
cd "$root"
note "lines of the kernel that the C++ tests run"
build_preset coverage
find build/coverage -name '*.gcda' -delete # counts of an earlier run
ctest --preset coverage -j "$(nproc)"
.venv/bin/gcovr --root . --filter cpp/hydrodae/ build/coverage
note "lines of the Python package that tests/python runs"
.venv/bin/pytest -n "$(nproc)" --dist worksteal --cov=hydrodae --cov-report=term tests/python "$@"
