"""The 4N3LA device ("Squid") of the InWave+H paper: four floating nodes joined by three arms.

python cases/4n3la/four_nodes.py database    # hydro.h5, not in the repository
python cases/4n3la/four_nodes.py cases       # regular.toml and irregular.toml
python cases/4n3la/four_nodes.py checks      # what the README states
python cases/4n3la/four_nodes.py pictures    # regular.png, irregular.png
"""

from __future__ import annotations

import sys
from pathlib import Path

import parts

if __name__ == "__main__":
    sys.exit(parts.main(parts.SQUID, Path(__file__).resolve().parent))
