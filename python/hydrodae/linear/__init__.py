"""Frequency domain of a case: the same scene, linearised at its static equilibrium.

With virtual displacements xi (translations in world axes, rotations in body axes), the velocities
U = T xi' of the hydrodynamic coordinates and phasors x(t) = Re(X e^{+iwt}):

    [-w^2 (M + T^T A(w) T) + iw (C + T^T B(w) T) + K] xi - G^T lambda = T^T F(w),    G xi = 0

A(w), B(w) and F(w) come from the database itself, without any memory fit; F(w) is that of the
heading relative to the mean yaw of each body, with the phase of its place. A force along a joint
coordinate s that acts tau late enters exactly, as (k + iw c) e^{-iw tau} s.
"""

from __future__ import annotations

from hydrodae.linear.model import LinearModel
from hydrodae.linear.modes import Mode
from hydrodae.linear.reading import without_memory
from hydrodae.linear.response import Response

__all__ = ["LinearModel", "Mode", "Response", "without_memory"]
