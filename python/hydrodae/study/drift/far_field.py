"""Mean drift of a device as it moves, in regular waves, by the momentum of its far field."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydrodae.case.case import CaseLike
from hydrodae.errors import CaseError
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.hdb.relations.far_field import SURGE, SWAY, YAW, carried, scattered
from hydrodae.linear import LinearModel, without_memory
from hydrodae.study.drift.carrier import Carrier, carrier_of
from hydrodae.study.drift.scene import Surroundings
from hydrodae.support.arrays import Array, Complex

#: Points about each natural period, over half widths of its resonance: the parabola through three
#: of them is right to 2 % of the peak.
ABOUT_A_PEAK = np.linspace(-4.0, 4.0, 17)
#: Least damping ratio whose resonance is resolved; a sharper one is no longer linear.
SHARPEST = 1e-4


@dataclass(frozen=True)
class Drift:
    """Mean drift of all bodies of a scene together, per square of wave amplitude.

    Printed, it is what the command `hydrodae drift` says.

    Attributes
    ----------
    title : str
    omega : (nw,) array
        [rad/s].
    heading : (nh,) array
        Directions of travel [rad].
    pairs : (m, 2) array of int
        Places of two waves among the headings; the first nh are each heading with itself.
    load : (nw, m, 3) complex array
        T of surge, sway [N/m2] and yaw [N m/m2], the moment about the centre of gravity of the
        carrier in the equilibrium.
    along : (nw, nh) array
        Drift along each wave, by momentum [N/m2].
    by_power : (nw, nh) array
        The same by energy: P k / w + c int |H|^2 (1 - cos) dtheta [N/m2].
    power : (nw, nh) array
        P, which the waves lose to the scene [W/m2].
    by_force : dict of (nw, nh) arrays
        Power of each damper and rotary take-off [W/m2].
    speed : (nw,) array
        Phase speed w / k [m/s].
    carrier : Carrier
        Body on which the table and the mean offset put the loads.
    computed : (nw,) array of bool
        Whether the database has the frequency; between its frequencies H is interpolated.
    """

    title: str
    omega: Array
    heading: Array
    pairs: NDArray[np.intp]
    load: Complex
    along: Array
    by_power: Array
    power: Array
    by_force: dict[str, Array]
    speed: Array
    carrier: Carrier
    computed: NDArray[np.bool_]

    @property
    def gap(self) -> Array:
        """Drift by momentum minus drift by energy, (nw, nh) [N/m2]: the error of the drift."""
        return self.along - self.by_power

    @property
    def error(self) -> float:
        """Largest gap over the largest drift [-]."""
        return self._error(np.ones(self.omega.size, dtype=bool))

    @property
    def error_computed(self) -> float:
        """The same at those frequencies alone that the database has."""
        return self._error(self.computed)

    def _error(self, rows: NDArray[np.bool_]) -> float:
        largest = float(np.abs(self.by_power).max())
        worst = float(np.abs(self.gap[rows]).max(initial=0.0))
        return worst / largest if largest > 0.0 else 0.0

    @property
    def least(self) -> Array:
        """Least drift along the waves of a scene that takes this power, P k / w [N/m2] (Maruo)."""
        return np.asarray(self.power / self.speed[:, None])

    @property
    def margin(self) -> float:
        """Least of drift minus P k / w, over the largest drift; below 0 it breaks the law [-]."""
        largest = float(np.abs(self.by_power).max())
        return float((self.along - self.least).min()) / (largest if largest > 0.0 else 1.0)


def drift(
    case: CaseLike | LinearModel,
    *,
    omega: Sequence[float] | Array | None = None,
    headings: Sequence[float] | Array | None = None,
    pairs: bool = False,
    set: Mapping[str, Any] | None = None,
) -> Drift:
    """Return the mean drift in surge, sway and yaw of a case as it moves.

    The motions are those of `hydrodae.rao`: of the whole scene with its power take-offs, joints and
    moorings, linearised about its static equilibrium. Sources: Maruo (J. Ship Res. 4 (1960) 1),
    Newman (J. Ship Res. 11 (1967) 51).

    Parameters
    ----------
    case : Case, Scene, path or LinearModel
    omega : (nw,) sequence of float, optional
        Frequencies [rad/s]; default: those of the database, closer about natural periods.
    headings : (nh,) sequence of float, optional
        Directions of travel [rad] of the Kochin functions of the database; default: all of them.
    pairs : bool
        Also of two waves of one frequency from different directions.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key; not for a LinearModel.

    Returns
    -------
    Drift

    Raises
    ------
    CaseError
        The case cannot be used, or no body of it is in the water.
    DatabaseError
        The database has no Kochin functions, or none of a frequency, heading or coordinate.
    """
    if isinstance(case, LinearModel):
        model = LinearModel.of(case, set)
    else:
        model = LinearModel(without_memory(case, set)[0])
    return drift_of(Surroundings(model), omega, headings, pairs=pairs)


def drift_of(
    water: Surroundings,
    omega: Sequence[float] | Array | None = None,
    headings: Sequence[float] | Array | None = None,
    *,
    pairs: bool = False,
) -> Drift:
    """Return `drift` of a case whose surroundings are known; parameters and errors as there."""
    model = water.model
    w = frequencies(water) if omega is None else np.atleast_1d(np.asarray(omega, dtype=float))
    angles = water.headings if headings is None else np.asarray(headings, dtype=float)
    if not w.size or not angles.size or not np.all(np.diff(w) > 0.0):
        raise CaseError("drift: expected ascending frequencies and at least one heading")
    found = water.leaving(w, angles)
    waves = np.repeat(np.arange(angles.size)[:, None], 2, axis=1)
    crossed = [(i, j) for i in range(angles.size) for j in range(angles.size) if i != j]
    if pairs and crossed:
        waves = np.concatenate([waves, np.array(crossed)])
    flow = carried(found.kochin, found.heading, w, water.water, waves)
    along = np.cos(found.heading) * flow[:, : angles.size, SURGE].real
    along += np.sin(found.heading) * flow[:, : angles.size, SWAY].real
    speed = w / wavenumber(w, water.water.depth, water.water.gravity)
    carrier = carrier_of(model)
    return Drift(
        title=model.case.title,
        omega=w,
        heading=angles,
        pairs=waves,
        load=_in_the_world(flow, water, carrier, angles[waves], w / speed),
        along=along,
        by_power=found.power / speed[:, None]
        + scattered(found.kochin, found.heading, w, water.water),
        power=found.power,
        by_force=found.by_force,
        speed=speed,
        carrier=carrier,
        computed=np.asarray(np.isclose(w[:, None], water.functions.omega, rtol=1e-9).any(axis=1)),
    )


def frequencies(water: Surroundings) -> Array:
    """Frequencies of the Kochin functions [rad/s], closer about the natural periods."""
    known = water.functions.omega
    w = known
    for mode in water.model.modes():
        own = 2.0 * np.pi / mode.period
        w = np.union1d(w, own * (1.0 + max(mode.damping_ratio, SHARPEST) * ABOUT_A_PEAK))
    return np.asarray(w[(w >= known[0]) & (w <= known[-1])])


def _in_the_world(
    flow: Complex, water: Surroundings, carrier: Carrier, headings: Array, k: Array
) -> Complex:
    """Return loads (nw, m, 3) in world axes, moments about the carrier, crests at the origin.

    Parameters
    ----------
    flow : (nw, m, 4) complex array
        In the axes of the database.
    headings : (m, 2) array
        Of the pairs of waves, world axes [rad].
    k : (nw,) array
        [rad/m].
    """
    c, s = np.cos(water.yaw), np.sin(water.yaw)
    x, y = flow[..., SURGE], flow[..., SWAY]
    fx, fy = c * x - s * y, s * x + c * y
    arm = carrier.place[:2] - water.shift
    moment = flow[..., YAW] - (arm[0] * fy - arm[1] * fx)
    ahead = np.stack([np.cos(headings), np.sin(headings)])  # (2, m, 2)
    apart = water.shift @ (ahead[..., 0] - ahead[..., 1])
    phase = np.exp(-1j * k[:, None] * apart)
    return np.asarray(np.stack([fx, fy, moment], axis=-1) * phase[..., None])
