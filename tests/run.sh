#!/usr/bin/env bash
# Every check of the project: C++ tests and a sample of mutated inputs under sanitizers, style and
# types, Python tests on all cores. Arguments go to pytest:
#   bash tests/run.sh
#   bash tests/run.sh -m slow
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../cases/environment.sh"

install_environment test
cd "$root"

note "building and running the C++ tests"
build_preset tests
ctest --preset tests -j "$(nproc)"
.venv/bin/python python/bindings/scene_stub.py python/hydrodae/case/scene.pyi # for mypy
# mypy has one process, and so have the checks up to the program that uses the library.
.venv/bin/mypy >build/mypy.log 2>&1 &
types=$!
note "a sample of mutated inputs"
.venv/bin/python tests/fuzz/run.py --seconds 15 --seed 1

note "style"
.venv/bin/ruff check .
.venv/bin/ruff format --check .
.venv/bin/python -m tests.lint
find cpp python/bindings tests \( -name '*.h' -o -name '*.cpp' \) -print0 |
  xargs -0 .venv/bin/clang-format --dry-run -Werror

note "a C++ program that uses the installed library"
bash tests/package/run.sh

note "types"
wait "$types" || { cat build/mypy.log; fail "mypy found errors"; }
cat build/mypy.log

note "Python tests"
# worksteal: neighbours stay in one process, so that few fixtures are made twice
.venv/bin/pytest -n "$(nproc)" --dist worksteal "$@"
