"""Labels `<body>.<motion>` of the coordinates of a database."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Self

from hydrodae.errors import DatabaseError

DOFS = ("surge", "sway", "heave", "roll", "pitch", "yaw")


@dataclass(frozen=True)
class Label:
    """A coordinate: a rigid motion of a body about its reference point, or one of its modes.

    Attributes
    ----------
    body : str
    motion : str
        One of `DOFS`, or the name of a mode.
    """

    body: str
    motion: str

    @classmethod
    def read(cls, text: str) -> Self:
        """Read `<body>.<motion>`.

        Raises
        ------
        DatabaseError
            The text is not of that form.
        """
        body, _, motion = text.rpartition(".")
        if not body or not motion:
            raise DatabaseError(
                f"{text!r} is not <body>.<dof> ({', '.join(DOFS)}, or a mode)"
            ).about("label", text)
        return cls(body, motion)

    def __str__(self) -> str:
        return f"{self.body}.{self.motion}"

    @property
    def dof(self) -> int:
        """Number of the rigid motion, 0..5; 6 of every mode."""
        return len(DOFS) if self.is_mode else DOFS.index(self.motion)

    @property
    def is_mode(self) -> bool:
        """Whether this is no rigid motion."""
        return self.motion not in DOFS

    @property
    def is_translation(self) -> bool:
        """Whether the body moves along an axis [m]."""
        return self.motion in DOFS[:3]

    @property
    def is_rotation(self) -> bool:
        """Whether the body turns about an axis [rad]; modes are in metres."""
        return self.motion in DOFS[3:]


def read_labels(texts: Iterable[str]) -> list[Label]:
    """Read labels, in their order."""
    return [Label.read(text) for text in texts]


def six_of_each(bodies: Iterable[str]) -> tuple[str, ...]:
    """Return the labels of all rigid motions, body by body."""
    return tuple(f"{body}.{motion}" for body in bodies for motion in DOFS)


def modes_of(body: str, labels: Iterable[str]) -> tuple[str, ...]:
    """Return the names of the modes of a body, in the order of the labels."""
    return tuple(c.motion for c in read_labels(labels) if c.body == body and c.is_mode)


def rigid(labels: Iterable[str]) -> list[str]:
    """Return the labels that are no modes."""
    return [str(label) for label in read_labels(labels) if not label.is_mode]


def bodies_of(labels: Iterable[str]) -> tuple[str, ...]:
    """Return the body names in order of first appearance."""
    return tuple(dict.fromkeys(label.body for label in read_labels(labels)))
