#!/usr/bin/env bash
# From a bare Debian 12 machine to the F3OF device in waves and its decay test, with their pictures:
#   bash cases/quickstart.sh
# Needs root or sudo when Debian packages are missing. Later runs build only what has changed.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

install_environment

cd "$root"
note "running cases/f3of/waves.toml: two flaps with power take-offs in irregular waves"
.venv/bin/hydrodae run cases/f3of/waves.toml -o build/f3of/waves.h5
"$python" cases/f3of/waves_figure.py build/f3of/waves.h5

note "running cases/f3of/flap_decay.toml: the verification against other codes"
.venv/bin/hydrodae run cases/f3of/flap_decay.toml -o build/f3of/flap_decay.h5
"$python" cases/f3of/figure.py build/f3of/flap_decay.h5
