"""Which part of the world a picture shows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.hdb.database.coordinates import nearest
from hydrodae.support.arrays import Array
from hydrodae.viewer.stage import Body, Stage

#: Lines that reach farther than this many sizes of the bodies do not widen the picture.
FAR = 4.0
#: Samples that are looked at to find how far bodies go.
LOOKS = 60
#: Directions of looking: azimuth and elevation of the camera [deg].
VIEWS = {
    "oblique": (-62.0, 17.0),
    "side": (-90.0, 10.0),
    "front": (180.0, 10.0),
    "top": (-90.0, 89.9),
}


@dataclass(frozen=True)
class Frame:
    """Middle and sizes of a picture.

    Attributes
    ----------
    center : (3,) array
        Middle [m].
    half : (3,) array
        Half the sides of the box around what is shown [m].
    radius : float
        Half its diagonal [m].
    reach : float
        Likewise of everything, far lines included [m].
    water, bed : float
        Half the sides of the drawn sea and seabed [m].
    """

    center: Array
    half: Array
    radius: float
    reach: float
    water: float
    bed: float

    @property
    def views(self) -> dict[str, tuple[float, float, float]]:
        """Azimuth, elevation [deg] and zoom by name; `all` where lines reach far."""
        named = {name: (*angles, 1.0) for name, angles in VIEWS.items()}
        if self.reach > 1.2 * self.radius:
            named["all"] = (*VIEWS["oblique"], self.radius / self.reach)
        return named


def frame_of(stage: Stage) -> Frame:
    """Find the frame in which all bodies stay, and lines that do not reach far."""
    corners = [points for body in stage.bodies for points in _extremes(body)]
    if not corners:
        corners = [np.zeros((1, 3))]
    near = np.concatenate(corners)
    ends = [line.points.reshape(-1, 3) for line in stage.lines]
    everything = np.concatenate([near, *ends])
    if _size(everything) <= FAR * _size(near) or _size(near) == 0.0:
        near = everything
    center, half = 0.5 * (near.min(axis=0) + near.max(axis=0)), 0.5 * np.ptp(near, axis=0)
    if not half.any():
        half = np.full(3, 0.5)
    radius = float(np.linalg.norm(half))
    reach = float(np.linalg.norm(everything - center, axis=1).max(initial=radius))
    sides = np.abs(everything - center)[:, :2].max(initial=0.0)
    water = 2.2 * radius
    if stage.sea is not None and len(stage.sea.waves):
        main = stage.sea.waves[np.argmax(stage.sea.waves[:, 3])]
        water = max(water, min(1.5 * np.pi / float(main[1]), 3.5 * radius))
    return Frame(
        center, half, radius, max(reach, radius), water, float(max(1.3 * sides, 1.1 * water))
    )


def camera_of(text: str, frame: Frame) -> tuple[float, float, float]:
    """Azimuth and elevation [deg] and zoom, from a name or ``AZIMUTH,ELEVATION[,ZOOM]``.

    Raises
    ------
    CaseError
        It is neither.
    """
    views = {"all": frame.views["oblique"]} | frame.views  # where nothing reaches far
    if text in views:
        return views[text]
    try:
        numbers = [float(word) for word in text.split(",")]
    except ValueError:
        raise CaseError(f"camera {text!r}: no such view{nearest(text, views)}") from None
    if len(numbers) not in (2, 3) or not np.all(np.isfinite(numbers)):
        raise CaseError(f"camera {text!r}: expected AZIMUTH,ELEVATION[,ZOOM] in degrees")
    zoom = numbers[2] if len(numbers) == 3 else 1.0
    if not zoom > 0.0 or abs(numbers[1]) > 90.0:
        raise CaseError(f"camera {text!r}: zoom must be > 0, elevation within -90 to 90 deg")
    return numbers[0], float(np.clip(numbers[1], -89.9, 89.9)), zoom


def _extremes(body: Body) -> list[Array]:
    """Corners of the box around a body at some samples."""
    points = body.corners if len(body.corners) else body.center[None]
    most = np.abs(body.amplitudes).max(axis=0, initial=0.0)
    spread = sum(
        (q * np.abs(s).reshape(-1, 3) for q, s in zip(most, body.shapes, strict=True)), 0.0
    )
    box = np.stack([(points - spread).min(axis=0), (points + spread).max(axis=0)])
    corners = np.stack(np.meshgrid(*box.T, indexing="ij"), axis=-1).reshape(-1, 3)
    places = body.places(corners)
    kept = np.unique(np.linspace(0, len(places) - 1, LOOKS).astype(int))
    return [places[kept].reshape(-1, 3)]


def _size(points: Array) -> float:
    return float(np.linalg.norm(np.ptp(points, axis=0)))
