"""The 9N9LA device ("Hex") of the InWave+H paper: nine nodes, nine arms, six of each in a ring.

    python cases/9n9la/nine_nodes.py database    # hydro.h5, not in the repository
    python cases/9n9la/nine_nodes.py cases       # regular.toml and irregular.toml
    python cases/9n9la/nine_nodes.py checks      # what the README states
    python cases/9n9la/nine_nodes.py pictures    # regular.png, irregular.png

Three devices of the kind in cases/4n3la that share every second node of the ring: C are the nodes
with three arms, D those that two devices share, S the outer ones.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "4n3la"))

import parts  # noqa: E402

ARM = 1.4  # m, between centres of nodes


def place(distance: float, degrees: float) -> tuple[float, float]:
    """Place at a distance from the middle [m] in a direction."""
    angle = math.radians(degrees)
    return round(distance * math.cos(angle), 12), round(distance * math.sin(angle), 12)


OUTWARDS = {1: 120.0, 2: 0.0, 3: -120.0}  # deg, of each C and its S

LAYOUT = parts.Layout(
    "9N9LA: nine nodes, nine arms",
    nodes={f"C{i}": place(ARM, angle) for i, angle in OUTWARDS.items()}
    | {f"S{i}": place(2.0 * ARM, angle) for i, angle in OUTWARDS.items()}
    | {f"D{i}": place(ARM, angle) for i, angle in {1: 180.0, 2: 60.0, 3: -60.0}.items()},
    arms={
        "LA1": ("C1", "S1"),
        "LA2": ("C1", "D1"),
        "LA3": ("C1", "D2"),
        "LA4": ("C2", "D2"),
        "LA5": ("C2", "S2"),
        "LA6": ("C2", "D3"),
        "LA7": ("C3", "D3"),
        "LA8": ("C3", "D1"),
        "LA9": ("C3", "S3"),
    },
    moored=("S1", "S2", "S3"),
)

if __name__ == "__main__":
    sys.exit(parts.main(LAYOUT, HERE))
