"""Moorings: lines at rest, line types by diameter, linear models, MoorDyn's input files."""

from __future__ import annotations

from hydrodae.mooring.imported import Imported
from hydrodae.mooring.line_at_rest import Catenary, catenary
from hydrodae.mooring.line_types import (
    LineType,
    chain,
    nylon,
    polyester,
    studless_chain,
    studlink_chain,
    wire,
)
from hydrodae.mooring.linear import LinearMooring, linearise
from hydrodae.mooring.moordyn import read_moordyn
from hydrodae.mooring.stiffness import Hold, MooringStiffness, holds

__all__ = [
    "Catenary",
    "Hold",
    "Imported",
    "LineType",
    "LinearMooring",
    "MooringStiffness",
    "catenary",
    "chain",
    "holds",
    "linearise",
    "nylon",
    "polyester",
    "read_moordyn",
    "studless_chain",
    "studlink_chain",
    "wire",
]
