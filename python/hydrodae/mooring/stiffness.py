"""Loads and stiffness of the moorings of a case in its static equilibrium, body by body."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hydrodae.linear import LinearModel
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Hold:
    """A rope, a line, a spring between two points or a mooring matrix in the equilibrium.

    Attributes
    ----------
    name, type : str
        As in the case.
    bodies : tuple of (str or None)
        Body of each point, None for the ground; of a mooring matrix the moored body.
    places : (n, 3) array
        Of the points, or of the centre of gravity [m].
    load : array
        Forces on the points, one after the other (3 n,) [N]; of a mooring matrix force and moment.
    stiffness, damping : array
        -d load / d places, and over their rates; of a mooring matrix over the displacement from the
        reference pose.
    readings : dict of (float, str)
        What it reports beside its load, such as "tension", with the unit.
    """

    name: str
    type: str
    bodies: tuple[str | None, ...]
    places: Array
    load: Array
    stiffness: Array
    damping: Array
    readings: dict[str, tuple[float, str]]

    @property
    def has_moment(self) -> bool:
        """Whether it acts by force and moment on a body, as a matrix does, and not at points."""
        return len(self.load) > 3 * len(self.bodies)

    @property
    def held(self) -> list[str]:
        """Bodies that it acts on, each once."""
        return list(dict.fromkeys(body for body in self.bodies if body is not None))


def holds(model: LinearModel) -> list[Hold]:
    """All moorings of a linearised case, at its equilibrium."""
    names = list(model.offsets)
    return [
        Hold(
            at["name"],
            at["type"],
            tuple(None if k < 0 else names[k] for k in at["bodies"]),
            np.array(at["places"]).reshape(-1, 3),
            at["load"],
            at["stiffness"],
            at["damping"],
            {
                name: (float(value), unit)
                for name, value, unit in zip(at["channels"], at["values"], at["units"], strict=True)
            },
        )
        for at in model.moorings
    ]


@dataclass(frozen=True)
class MooringStiffness:
    """What moorings put on bodies together, to first order about the equilibrium.

    Attributes
    ----------
    bodies : tuple of str
        In the order of the case.
    load : (6 n,) array
        Force [N] and moment about the centre of gravity [N m] on each body, world axes.
    stiffness, damping : (6 n, 6 n) arrays
        -d load / d (displacement of the centre of gravity, turn), and over their rates; small turns
        about the world axes.
    """

    bodies: tuple[str, ...]
    load: Array
    stiffness: Array
    damping: Array

    def of(self, body: str) -> Array:
        """Stiffness (6, 6) of one body, the others at rest."""
        part = self.part(body)
        return self.stiffness[part, part]

    def load_of(self, body: str) -> Array:
        """Force and moment (6,) on one body."""
        return self.load[self.part(body)]

    def part(self, body: str) -> slice:
        """Rows and columns of one body."""
        first = 6 * self.bodies.index(body)
        return slice(first, first + 6)


def mooring_stiffness(model: LinearModel, moorings: Sequence[Hold]) -> MooringStiffness:
    """Loads and stiffness of these moorings of a case."""
    bodies = tuple(model.offsets)
    n = 6 * len(bodies)
    out = MooringStiffness(bodies, np.zeros(n), np.zeros((n, n)), np.zeros((n, n)))
    for hold in moorings:
        if hold.has_moment:
            _add_matrix(model, hold, out)
        else:
            _add_points(model, hold, out)
    return out


def cross(vector: Array) -> Array:
    """The matrix of v x."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def turn_by_vector(rotation: Array) -> Array:
    """Return d (small turn, world axes) / d (rotation vector): the left Jacobian of SO(3)."""
    angle = float(np.linalg.norm(rotation))
    k = cross(rotation)
    if angle < 1e-4:
        return np.asarray(np.eye(3) + k / 2.0 + k @ k / 6.0)
    first, second = (1.0 - np.cos(angle)) / angle**2, (angle - np.sin(angle)) / angle**3
    return np.asarray(np.eye(3) + first * k + second * k @ k)


def _add_matrix(model: LinearModel, hold: Hold, out: MooringStiffness) -> None:
    body = hold.held[0]
    part = out.part(body)
    by_turn = np.eye(6)
    by_turn[3:, 3:] = np.linalg.inv(turn_by_vector(model.rotations[body]))
    out.load[part] += hold.load
    out.stiffness[part, part] += hold.stiffness @ by_turn
    out.damping[part, part] += hold.damping


def _add_points(model: LinearModel, hold: Hold, out: MooringStiffness) -> None:
    """Force f at the place p of a body turns it by (p - r) x f, and p moves with it.

    W = T f,  dp = dr + turn x (p - r) = T^T (dr, turn),  dW = T df + (turn x (p - r)) x f
    """
    levers: list[tuple[slice, Array] | None] = []
    for body, place in zip(hold.bodies, hold.places, strict=True):
        if body is None:
            levers.append(None)
            continue
        arm = place - model.places[body]
        levers.append((out.part(body), np.vstack([np.eye(3), cross(arm)])))
    for i, on in enumerate(levers):
        if on is None:
            continue
        part, lever = on
        force = hold.load[3 * i : 3 * i + 3]
        out.load[part] += lever @ force
        turned = np.zeros((6, 6))
        turned[3:, 3:] = cross(force) @ lever[3:]
        out.stiffness[part, part] -= turned
        for j, moved in enumerate(levers):
            if moved is None:
                continue
            block = np.s_[3 * i : 3 * i + 3, 3 * j : 3 * j + 3]
            out.stiffness[part, moved[0]] += lever @ hold.stiffness[block] @ moved[1].T
            out.damping[part, moved[0]] += lever @ hold.damping[block] @ moved[1].T
