"""Bodies of a case file, as joints, forces and markers name them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any


def bodies_and_attachments(tables: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Return the entries of all bodies, and the attachments as bodies without mass.

    Parameters
    ----------
    tables : mapping
        The case file.
    """
    places = [
        {"name": place["name"], "center_of_gravity": place["point"], "mass": 0.0}
        for place in tables.get("attachment", [])
    ]
    return [*tables.get("body", []), *places]


def shape_file(directory: Path, body: str) -> Path:
    """Return the file from which a body is drawn where it is there: shapes/BODY.stl.

    Parameters
    ----------
    directory : Path
        Folder of the case file.
    body : str
        Its surface is in world axes, in the reference pose [m].
    """
    return directory / "shapes" / f"{body}.stl"
