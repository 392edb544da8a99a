"""Wave markers of an input file as gauges of a case."""

from __future__ import annotations

import numpy as np

from hydrodae.wecsim.objects import InputFile
from hydrodae.wecsim.text import CaseText


def add_gauges(text: CaseText, read: InputFile, systems: int) -> None:
    """Add a [[gauge]] at each marker of the waves.

    Parameters
    ----------
    text : CaseText
    read : InputFile
    systems : int
        Number of wave systems of the case; without any there is no elevation to report.
    """
    places: list[tuple[float, float]] = []
    several = [waves for waves in read.of("waves") if "marker.location" in waves.entries]
    for waves in several:
        place = read.place(waves.line_of("marker.location"))
        value = waves.get("marker.location")
        table = np.atleast_2d(value) if isinstance(value, float | np.ndarray) else np.zeros((0, 0))
        if table.shape[1] != 2:
            read.remarks.left_out(place, f"{waves.title}.marker.location: not columns x and y")
            continue
        if not systems:
            read.remarks.left_out(place, f"{waves.title}: markers in still water")
            continue
        places += [(float(x), float(y)) for x, y in table]
    if (places and len(several) < len(read.of("waves"))) or len(several) > 1:
        read.remarks.assumed(
            read.path.name, "a gauge reports the sum of all wave systems, a marker those of its own"
        )
    for number, point in enumerate(dict.fromkeys(places), 1):
        comments = ["Markers of the waves."] if number == 1 else []
        text.table("[[gauge]]", {"name": f"marker{number}", "point": list(point)}, *comments)
