#!/usr/bin/env bash
# From a bare Debian 12 machine to the flap decay of the F3OF device and its picture:
#   bash cases/quickstart.sh
# Needs root or sudo when Debian packages are missing. Later runs build only what has changed.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/environment.sh"

install_environment

note "running cases/f3of/flap_decay.toml"
cd "$root"
.venv/bin/hydrodae run cases/f3of/flap_decay.toml -o build/f3of/flap_decay.h5
"$python" cases/f3of/figure.py build/f3of/flap_decay.h5
