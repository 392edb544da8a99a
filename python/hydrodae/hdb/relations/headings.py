"""Interpolation over headings by the rule of runs, and how a table of headings tests itself.

The kernel has the same rule for runs (cpp/hydrodae/hydro/headings.h, where its reasons stand).
Databases are judged without the kernel; a test holds both against each other.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from hydrodae.support.arrays import Array

#: Two ends of a circle, or two steps, that differ by less are equal [rad].
SAME = 1e-6
TURN = 2.0 * np.pi


@dataclass(frozen=True)
class Headings:
    """A table of headings.

    Harmonics of the heading are fitted to the forces by least squares, as many as the widest gap
    resolves; a cubic spline goes through what they leave.

    Attributes
    ----------
    heading : (nh,) array
        Ascending [rad], at least two. The last may be the first, a full turn on: a circle.
    """

    heading: Array

    @property
    def round(self) -> bool:
        """Whether the headings close a circle."""
        return bool(abs(np.ptp(self.heading) - TURN) < SAME)

    @property
    def count(self) -> int:
        """Number of different headings: without the last of a circle."""
        return self.heading.size - self.round

    def weights(self, heading: Array) -> Array:
        """What each heading of the table counts (m, nh) at headings (m,) within it [rad]."""
        own = self.heading[: self.count]
        values, one = self._basis(own), np.eye(self.count)
        harmonics = np.linalg.lstsq(values, one, rcond=None)[0]
        rest = one - values @ harmonics
        if self.round:
            spline = CubicSpline(self.heading, np.vstack([rest, rest[:1]]), bc_type="periodic")
        else:
            spline = CubicSpline(own, rest, bc_type="natural")
        found = self._basis(heading) @ harmonics + spline(heading)
        return np.pad(found, ((0, 0), (0, self.heading.size - self.count)))

    def _basis(self, heading: Array) -> Array:
        """1, cos b, sin b, cos 2 b ... (m, n), and cos(count b / 2) for an even circle."""
        steps, count = np.diff(self.heading), self.count
        resolved = int(np.ceil(np.pi / steps.max() - 1e-6)) - 1
        order = min((count - 1) // 2, resolved if self.round else 1)
        angle = heading - 0.5 * (self.heading[0] + self.heading[-1])
        columns = [np.ones_like(angle)]
        for k in range(1, order + 1):
            columns += [np.cos(k * angle), np.sin(k * angle)]
        if self.round and count % 2 == 0 and order == count // 2 - 1 and np.ptp(steps) < SAME:
            columns.append(np.cos(0.5 * count * angle))
        return np.stack(columns, axis=1)

    @cached_property
    def misses(self) -> Array:
        """What every other heading, left out, misses: rows (n, nh) that multiply the forces.

        Of four headings all round the amplitude of their one spare harmonic, cos 2 b. No rows for
        fewer headings and for a fan of three, which say nothing about themselves.
        """
        size = self.heading.size
        if self.round and self.count == 4:
            return np.array([[0.25, -0.25, 0.25, -0.25, 0.0]])
        kept = np.unique(np.r_[0 : self.count : 2, size - 1])
        if kept.size < 3 + self.round:
            return np.empty((0, size))
        left_out = np.arange(1, self.count if self.round else size - 1, 2)
        out = np.zeros((left_out.size, size))
        out[:, kept] = Headings(self.heading[kept]).weights(self.heading[left_out])
        out[np.arange(left_out.size), left_out] -= 1.0
        return out

    def doubt(self, miss: float) -> float:
        """The share of the largest force by which forces between headings may be off.

        Parameters
        ----------
        miss : float
            Largest of `misses`, likewise a share [-]. Half the step leaves a quarter of it (natural
            spline) down to its square (harmonics). Of two headings the straight line between them
            misses 1 - cos(gap / 2).
        """
        if self.count == 2:
            return float(1.0 - np.cos(0.5 * (self.heading[1] - self.heading[0])))
        if self.misses.size == 0:
            return 0.0
        if self.round and self.count == 4:
            return 2.0 * miss  # largest where cos 2 b is aliased to another sign
        return miss * max(1.0 / 3.0, min(1.0, 2.0 * miss))
