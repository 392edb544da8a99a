"""What is drawn: bodies, joints, lines and sea over time, free of any way to draw it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Body:
    """A body: rigid, or bent by its modes before it moves.

    Attributes
    ----------
    name : str
    center : (3,) array
        Centre of gravity in the reference pose [m].
    position : (n, 3) array
        Centre of gravity over time, world [m].
    orientation : (n, 4) array
        Unit quaternion (w, x, y, z) of the rotation from the reference pose.
    surface : (m, 3, 3) array
        Triangles in the reference pose, world axes [m].
    above : (k, 3, 3) array
        Likewise what is drawn above the water line, which no file holds.
    origin : str
        Where the surface is from, in words.
    moves : bool
    cut : str
        Surface that bounds the wetted part on which the pressure acts: "waves" or "still" (z = 0);
        empty if the load of the body does not follow from its surface.
    amplitudes : (n, j) array
        Of the modes that bend its surface over time [m].
    shapes : (j, m + k, 3, 3) array
        Displacement of the corners of `surface` and `above` per unit of each of them [-], in the
        reference pose.
    """

    name: str
    center: Array
    position: Array
    orientation: Array
    surface: Array
    above: Array
    origin: str
    moves: bool
    cut: str = ""
    amplitudes: Array = field(default_factory=lambda: np.empty((0, 0)))
    shapes: Array = field(default_factory=lambda: np.empty((0, 0, 3, 3)))

    @property
    def corners(self) -> Array:
        """Corners (3 (m + k), 3) of `surface` and `above` in the reference pose [m]."""
        return np.concatenate([self.surface, self.above]).reshape(-1, 3)

    def at(self, sample: int) -> Body:
        """The body at one sample alone."""
        one = slice(sample, sample + 1)
        return replace(
            self,
            position=self.position[one],
            orientation=self.orientation[one],
            amplitudes=self.amplitudes[one],
        )

    def bent(self) -> Array:
        """World places (n, 3 (m + k), 3) over time of its corners, which its modes move."""
        if not len(self.shapes):
            return self.places(self.corners)
        moved = np.tensordot(self.amplitudes, self.shapes.reshape(len(self.shapes), -1, 3), 1)
        return self.places(self.corners + moved)

    def places(self, points: Array) -> Array:
        """World places (n, k, 3) over time of points (k, 3) or (n, k, 3) of the reference pose."""
        arms = np.asarray(points, dtype=float) - self.center
        w, v = self.orientation[:, None, :1], self.orientation[:, None, 1:]
        turned = arms + 2.0 * np.cross(v, np.cross(v, arms) + w * arms)
        return np.asarray(self.position[:, None, :] + turned, dtype=float)


@dataclass(frozen=True)
class Joint:
    """A joint as a symbol.

    Attributes
    ----------
    name, type : str
    body : str
        Body that carries it, or "ground".
    bodies : tuple of str
        Both bodies.
    point, axis : (3,) array
        Place and axis in the reference pose; the axis is z where the joint has none.
    driven : bool
        A power take-off works on it.
    """

    name: str
    type: str
    body: str
    bodies: tuple[str, str]
    point: Array
    axis: Array
    driven: bool


@dataclass(frozen=True)
class Line:
    """A rope, mooring line, spring or rod.

    Attributes
    ----------
    name, kind : str
    bodies : tuple of str
        What it is attached to.
    points : (n, k, 3) array
        Its shape over time, world [m].
    load : (n, 1) or (n, k - 1) array, or None
        Tension, or load, of all of it or of each piece [N]; None if the results lack it.
    arc : (k,) array or None
        Unstretched lengths from end A of the points of a mooring line [m], where they are known.
    """

    name: str
    kind: str
    bodies: tuple[str, ...]
    points: Array
    load: Array | None
    arc: Array | None = None


@dataclass(frozen=True)
class Spot:
    """A point with a symbol.

    Attributes
    ----------
    name : str
    kind : str
        buoy, clump, marker, gauge or mooring matrix.
    bodies : tuple of str
        What it belongs to.
    points : (n, 3) array
        Where it is over time, world [m].
    """

    name: str
    kind: str
    bodies: tuple[str, ...]
    points: Array


@dataclass(frozen=True)
class Sea:
    """The undisturbed water.

    Attributes
    ----------
    waves : (n, 5) array
        Frequency [rad/s], wavenumber [rad/m], heading [rad], amplitude [m], phase [rad].
    ramp : float
        Time over which the waves grow [s].
    depth : float
        Of the water [m]; may be infinite.
    """

    waves: Array
    ramp: float
    depth: float

    def elevation(self, time: float, x: Array, y: Array) -> Array:
        """Elevation [m] at places x, y of one shape: ramp sum a cos(wt - k.x + phase)."""
        total = np.zeros(np.shape(x))
        for w, k, heading, amplitude, phase in self.waves:
            along = np.cos(heading) * x + np.sin(heading) * y
            total += amplitude * np.cos(w * time - k * along + phase)
        return np.asarray(total * self.growth(time), dtype=float)

    def above(self, cut: str, time: float, places: Array) -> Array:
        """Heights (k,) [m] of places (k, 3) above the surface that cuts a body; see `Body.cut`."""
        x, y, z = np.asarray(places, dtype=float).T
        return np.asarray(z - self.elevation(time, x, y) if cut == "waves" else z)

    def elevations(self, times: Array, x: Array, y: Array) -> Array:
        """(n_times, n_places) elevations [m] at places x, y: one product of two matrices.

        cos(wt + b) = cos wt cos b - sin wt sin b with b = phase - k.x
        """
        w, k, heading, amplitude, phase = np.reshape(self.waves, (-1, 5)).T[:, :, None]
        place = phase - k * (np.cos(heading) * np.ravel(x) + np.sin(heading) * np.ravel(y))
        turned = np.outer(times, w)
        total = np.cos(turned) @ (amplitude * np.cos(place))
        total -= np.sin(turned) @ (amplitude * np.sin(place))
        growth = np.array([self.growth(float(time)) for time in times])
        return np.asarray(growth[:, None] * total, dtype=float)

    def growth(self, time: float) -> float:
        """Part of their height that the waves have: a polynomial of degree 7, then 1."""
        if self.ramp <= 0.0 or time >= self.ramp:
            return 1.0
        x = max(time / self.ramp, 0.0)
        return float(x**4 * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x))))


@dataclass(frozen=True)
class Curve:
    """A channel to be looked at.

    Attributes
    ----------
    name : str
        Of the channel; a component is ``bodies/float/position.z``.
    about : tuple of str
        Names of the bodies, joints and lines that it is about.
    group : str
        Curves of one group share a chart.
    label, unit : str
    values : (n,) array
    """

    name: str
    about: tuple[str, ...]
    group: str
    label: str
    unit: str
    values: Array


@dataclass(frozen=True)
class Stage:
    """A scene over time.

    Attributes
    ----------
    title, state : str
        Title of the case; how the run ended.
    time : (n,) array
        Samples [s].
    bodies, joints, lines, curves, spots : list
    sea : Sea or None
        None without water.
    bed : float or None
        Height of the seabed that is drawn, z [m].
    notes : list of str
        What a looker should know: what is drawn and in no file.
    """

    title: str
    state: str
    time: Array
    bodies: list[Body]
    joints: list[Joint]
    lines: list[Line]
    curves: list[Curve]
    sea: Sea | None
    bed: float | None
    notes: list[str] = field(default_factory=list)
    spots: list[Spot] = field(default_factory=list)

    def body(self, name: str) -> Body | None:
        """The body of this name; None for the ground."""
        return next((body for body in self.bodies if body.name == name), None)
