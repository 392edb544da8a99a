#!/usr/bin/env bash
# Every check of the project: C++ tests, style and types, Python tests. Arguments go to pytest:
#   bash tests/run.sh
#   bash tests/run.sh -m slow
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../cases/environment.sh"

install_environment test
cd "$root"

note "building and running the C++ tests"
mkdir -p build
# Optimised, but without NDEBUG: assertions stay on.
cmake -S . -B build/tests -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O2 \
  -DHYDRODAE_BUILD_TESTS=ON -DHYDRODAE_WARNINGS_AS_ERRORS=ON >build/tests.log ||
  { cat build/tests.log; fail "CMake failed"; }
cmake --build build/tests -- --quiet
ctest --test-dir build/tests --output-on-failure --no-tests=error -j "$(nproc)"

note "style and types"
.venv/bin/ruff check .
.venv/bin/ruff format --check .
find cpp python/bindings tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 .venv/bin/clang-format --dry-run -Werror
.venv/bin/mypy

note "Python tests"
.venv/bin/pytest "$@"
