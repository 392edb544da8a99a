"""Hydrostatics of a body in its mean position: volume, buoyancy centre, waterplane, stiffness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import DatabaseError
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Hydrostatics:
    """What the linear buoyancy stiffness about any point follows from.

    Attributes
    ----------
    displaced_volume : float
        V [m3].
    center_of_buoyancy : (3,) array
        World point [m].
    waterplane_area : float
        A_w [m2].
    waterplane_moments : (5,) array
        S_x, S_y [m3], S_xx, S_yy, S_xy [m4]: integrals of x, y, x^2, y^2, x y over the waterplane,
        x and y counted from the reference point of the body.
    """

    displaced_volume: float
    center_of_buoyancy: Array
    waterplane_area: float
    waterplane_moments: Array

    def __post_init__(self) -> None:
        for name, size in (("center_of_buoyancy", 3), ("waterplane_moments", 5)):
            value = np.array(getattr(self, name), dtype=float)
            if value.shape != (size,):
                raise DatabaseError(f"{name} needs {size} numbers, got {value.shape}").about(
                    "shape", name
                )
            object.__setattr__(self, name, value)
        numbers = [self.displaced_volume, self.waterplane_area]
        if not np.all(np.isfinite([*numbers, *self.center_of_buoyancy, *self.waterplane_moments])):
            raise DatabaseError("hydrostatics hold values that are not finite").about(
                "not_finite", "hydrostatics"
            )

    def stiffness(self, point: ArrayLike, rho: float, gravity: float) -> Array:
        """Buoyancy stiffness about the reference point, weight not included.

        Parameters
        ----------
        point : (3,) array
            The reference point [m] that `waterplane_moments` refer to.
        rho, gravity : float
            [kg/m3], [m/s2].

        Returns
        -------
        (6, 6) array
            rho g times: K33 = A_w, K34 = S_y, K35 = -S_x, K44 = S_yy + V (zB - z),
            K55 = S_xx + V (zB - z), K45 = -S_xy, K46 = -V (xB - x), K56 = -V (yB - y);
            K43 = K34, K53 = K35, K54 = K45, the rest 0 [N/m, N, N m].
        """
        sx, sy, sxx, syy, sxy = self.waterplane_moments
        lever = self.displaced_volume * (self.center_of_buoyancy - np.asarray(point, dtype=float))
        k = np.zeros((6, 6))
        k[2, 2] = self.waterplane_area
        k[2, 3] = k[3, 2] = sy
        k[2, 4] = k[4, 2] = -sx
        k[3, 3] = syy + lever[2]
        k[4, 4] = sxx + lever[2]
        k[3, 4] = k[4, 3] = -sxy
        k[3, 5] = -lever[0]
        k[4, 5] = -lever[1]
        return rho * gravity * k

    def moved(self, old: ArrayLike, new: ArrayLike) -> Hydrostatics:
        """Return the same waterplane with its moments about another reference point.

        Parameters
        ----------
        old, new : (3,) arrays
            Reference points [m]; only x and y matter.
        """
        dx, dy = (np.asarray(old, dtype=float) - np.asarray(new, dtype=float))[:2]
        sx, sy, sxx, syy, sxy = self.waterplane_moments
        area = self.waterplane_area
        moments = np.array(
            [
                sx + dx * area,
                sy + dy * area,
                sxx + 2.0 * dx * sx + dx**2 * area,
                syy + 2.0 * dy * sy + dy**2 * area,
                sxy + dx * sy + dy * sx + dx * dy * area,
            ]
        )
        return Hydrostatics(self.displaced_volume, self.center_of_buoyancy, area, moments)

    @classmethod
    def from_stiffness(
        cls,
        stiffness: ArrayLike,
        point: ArrayLike,
        volume: float,
        center_of_buoyancy: ArrayLike,
        rho: float,
        gravity: float,
    ) -> Hydrostatics:
        """Recover the waterplane from a buoyancy stiffness about `point` (inverse of `stiffness`).

        Parameters
        ----------
        stiffness : (6, 6) array
            [N/m, N, N m]; only the block of heave, roll and pitch is read.
        point : (3,) array
            Point that it refers to, and to which the returned moments refer [m].
        volume, center_of_buoyancy, rho, gravity
            [m3], (3,) [m], [kg/m3], [m/s2].
        """
        k = np.asarray(stiffness, dtype=float) / (rho * gravity)
        zb = float(np.asarray(center_of_buoyancy, dtype=float)[2])
        lever = volume * (zb - float(np.asarray(point, dtype=float)[2]))
        moments = np.array([-k[2, 4], k[2, 3], k[4, 4] - lever, k[3, 3] - lever, -k[3, 4]])
        return cls(float(volume), np.asarray(center_of_buoyancy), float(k[2, 2]), moments)
