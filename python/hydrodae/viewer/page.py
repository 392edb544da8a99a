"""A stage as one HTML file that needs neither network nor server."""

from __future__ import annotations

import base64
import html
import json
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.support import outputs
from hydrodae.support.version import version
from hydrodae.viewer.framing import Frame
from hydrodae.viewer.stage import Stage

#: Colours of bodies that move, one after the other, and of those that do not.
COLOURS = ("#f0b23a", "#d4574a", "#5fa777", "#8a6fb3", "#3f8f9b", "#c98a4b", "#d986a8", "#6f87c9")
FIXED = "#929ba3"


class Numbers:
    """One list of 32-bit numbers that the page holds; parts of it go by place and count."""

    def __init__(self) -> None:
        self._parts: list[bytes] = []
        self._count = 0

    def add(self, values: ArrayLike) -> list[int]:
        """Append an array, and return [place, count] of it."""
        flat = np.asarray(values, dtype="<f4").ravel()
        place = [self._count, len(flat)]
        self._parts.append(flat.tobytes())
        self._count += len(flat)
        return place

    def text(self) -> str:
        """Everything in base64."""
        return base64.b64encode(b"".join(self._parts)).decode("ascii")


def page_text(
    stage: Stage, frame: Frame, camera: tuple[float, float, float], begin: float | None = None
) -> str:
    """Return the HTML of a stage.

    Parameters
    ----------
    stage : Stage
    frame : Frame
        What is shown.
    camera : (azimuth, elevation, zoom)
        From where, first [deg].
    begin : float, optional
        Time at which it opens [s]; by default the first sample.
    """
    folder = files("hydrodae.viewer") / "page"
    # "<" does not stand in the data, so that nothing in it ends the script that holds it
    data = json.dumps(page_data(stage, frame, camera, begin), allow_nan=False).replace(
        "<", "\\u003c"
    )
    program = sorted(f.name for f in folder.iterdir() if f.name[0].isdigit())
    parts = {
        "version": html.escape(version()),
        "title": html.escape(stage.title),
        "style": _read(folder, "uplot.min.css") + "\n" + _read(folder, "style.css"),
        "licences": _read(folder, "libraries.LICENSE.txt"),
        "libraries": _read(folder, "libraries.min.js"),
        "data": data,
        "program": "\n".join(_read(folder, name) for name in program),
    }
    return _filled(_read(folder, "page.html"), parts)


def page_data(
    stage: Stage, frame: Frame, camera: tuple[float, float, float], begin: float | None = None
) -> dict[str, Any]:
    """Return what the program of the page reads: plain values, and places of numbers."""
    numbers = Numbers()
    data = {
        "title": stage.title,
        "state": stage.state,
        "notes": stage.notes,
        "time": numbers.add(stage.time),
        "bodies": _bodies(stage, numbers),
        "joints": [
            {
                "name": joint.name,
                "type": joint.type,
                "body": joint.body,
                "bodies": joint.bodies,
                "point": joint.point.tolist(),
                "axis": joint.axis.tolist(),
                "driven": joint.driven,
            }
            for joint in stage.joints
        ],
        "lines": [
            {
                "name": line.name,
                "kind": line.kind,
                "bodies": line.bodies,
                "count": line.points.shape[1],
                "points": numbers.add(line.points),
                "load": None if line.load is None else numbers.add(line.load),
            }
            for line in stage.lines
        ],
        "spots": [
            {
                "name": spot.name,
                "kind": spot.kind,
                "bodies": spot.bodies,
                "points": numbers.add(spot.points),
            }
            for spot in stage.spots
        ],
        "curves": [
            {
                "about": curve.about,
                "group": curve.group,
                "label": curve.label,
                "unit": curve.unit,
                "values": numbers.add(curve.values),
            }
            for curve in stage.curves
        ],
        "sea": None
        if stage.sea is None
        else {"waves": numbers.add(stage.sea.waves), "ramp": stage.sea.ramp},
        "bed": stage.bed,
        "home": {
            "center": frame.center.tolist(),
            "half": frame.half.tolist(),
            "radius": frame.radius,
            "water": frame.water,
            "bed": frame.bed,
        },
        "views": frame.views,
        "camera": camera,
        "begin": float(stage.time[0]) if begin is None else begin,
    }
    data["numbers"] = numbers.text()
    return data


def _bodies(stage: Stage, numbers: Numbers) -> list[dict[str, Any]]:
    found, count = [], 0
    for body in stage.bodies:
        colour = COLOURS[count % len(COLOURS)] if body.moves else FIXED
        count += body.moves
        found.append(
            {
                "name": body.name,
                "center": body.center.tolist(),
                "position": numbers.add(body.position),
                "orientation": numbers.add(body.orientation),
                "surface": numbers.add(body.surface),
                "above": numbers.add(body.above),
                "origin": body.origin,
                "cut": body.cut,
                "modes": len(body.shapes),
                "amplitudes": numbers.add(body.amplitudes),
                "shapes": numbers.add(body.shapes[:, : len(body.surface)]),
                "shapes_above": numbers.add(body.shapes[:, len(body.surface) :]),
                "colour": colour,
            }
        )
    return found


def _filled(template: str, parts: Mapping[str, str]) -> str:
    """Put the parts in place of their names, none of them searched for names again."""
    pieces = template.split("{{")
    text = pieces[0]
    for piece in pieces[1:]:
        name, _, rest = piece.partition("}}")
        text += parts[name] + rest
    return text


def _read(folder: Any, name: str) -> str:
    return str((folder / name).read_text(encoding="utf-8"))


def write_page(text: str, path: Path) -> Path:
    """Write the HTML to a file, whose folder is made."""
    outputs.write_text(outputs.claim(path, outputs.PAGE), text)
    return path
