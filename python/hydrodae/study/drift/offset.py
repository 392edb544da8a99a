"""Mean offset of a moored case in its waves: drift and equilibrium in turn until they agree."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.case import CaseLike
from hydrodae.case.contents import overrides_of
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel, without_memory
from hydrodae.linear.sea import wave_components
from hydrodae.study.drift.carrier import carrier_of
from hydrodae.study.drift.far_field import drift_of
from hydrodae.study.drift.scene import Surroundings
from hydrodae.support.arrays import Array

#: Change of the offset, over the offset, at which it is converged.
TOLERANCE = 1e-3
#: A mooring that doubles its stiffness in a step halves the error each time: 1e-3 after ten.
MOST = 30
#: Name of the load that stands for the drift.
LOAD = "mean_drift"


@dataclass(frozen=True)
class Offset:
    """Where the mean drift of its waves holds a case.

    Attributes
    ----------
    load : (3,) array
        Mean drift in surge, sway [N] and yaw [N m] on the carrier, world axes.
    still, held : dict of (3,) arrays
        Offsets of each body from the reference pose in still water, and with the drift [m].
    turned : dict of (3,) arrays
        Rotation vector of each body with the drift [rad].
    steps : list of float
        Offset of the carrier from its place in still water after each iteration [m].
    carrier : str
        Body that carries the load.
    """

    load: Array
    still: dict[str, Array]
    held: dict[str, Array]
    turned: dict[str, Array]
    steps: list[float]
    carrier: str

    @property
    def offset(self) -> Array:
        """Offset (3,) of the carrier from its place in still water [m]."""
        return np.asarray(self.held[self.carrier] - self.still[self.carrier])

    def __str__(self) -> str:
        x, y, z = (value + 0.0 for value in np.round(self.offset, 9))
        fx, fy, m = (value + 0.0 for value in np.round(self.load, 6))
        lines = [
            f"mean drift in the waves of the case: surge {1e-3 * fx:.4g} kN, sway {1e-3 * fy:.4g} "
            f"kN, yaw {1e-3 * m:.4g} kN m, on {self.carrier}",
            f"mean offset of {self.carrier} after {len(self.steps)} iterations: {x:.4g}, {y:.4g}, "
            f"{z:.4g} m",
        ]
        for name, held in self.held.items():
            if name != self.carrier:
                moved = ", ".join(f"{value:.4g}" for value in held - self.still[name])
                lines.append(f"  {name:16} {moved} m")
        return "\n".join(lines)


def mean_offset(
    case: CaseLike, *, set: Mapping[str, Any] | None = None, still: LinearModel | None = None
) -> Offset:
    """Iterate mean drift and equilibrium of a case in its waves.

    The drift moves the equilibrium; the case is linearised again there, whose motions give another
    drift. Waves of equal frequency have random phases: each puts its own drift on the device.

    Parameters
    ----------
    case : Case, Scene or path
        A case with waves, regular or a sea.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.
    still : LinearModel, optional
        The case as it was linearised before.

    Raises
    ------
    CaseError
        The case has no waves, nothing holds it against the drift, or the offset does not settle.
    DatabaseError
        The waves are outside the Kochin functions of the database.
    """
    read = without_memory(case, set)[0]
    waves = wave_components(read)
    model = LinearModel(read) if still is None else still
    first, steps, load = model, [], np.zeros(3)
    carrier = carrier_of(model)
    place = model.places[carrier.body]
    for _ in range(MOST):
        load = mean_load(model, waves)
        model = LinearModel(pushed(read, carrier.body, load))
        moved = model.places[carrier.body]
        steps.append(float(np.linalg.norm(moved - first.places[carrier.body])))
        if np.linalg.norm(moved - place) <= TOLERANCE * steps[-1]:
            return Offset(load, first.offsets, model.offsets, model.rotations, steps, carrier.body)
        place = moved
    raise CaseError(
        f"the mean offset did not settle in {MOST} iterations; the last are "
        f"{', '.join(f'{step:.4g}' for step in steps[-3:])} m: run the case in the time domain"
    )


def mean_load(model: LinearModel, waves: Array) -> Array:
    """Return the mean drift (3,) [N, N, N m] of a linearised case in waves (n, 4).

    `waves` are as `hydrodae.linear.sea.wave_components`.
    """
    water = Surroundings(model)
    total = np.zeros(3)
    for heading in np.unique(waves[:, 1]):
        mine = waves[waves[:, 1] == heading]
        omega, place = np.unique(mine[:, 0], return_inverse=True)
        squares = np.bincount(place, weights=mine[:, 2] ** 2, minlength=omega.size)
        found = drift_of(water, omega, [float(heading)])
        total += squares @ found.load[:, 0].real
    return total


def pushed(case: Case, body: str, load: Array) -> Case:
    """Return the case with the mean drift as a constant load at the centre of gravity of a body."""
    fx, fy, moment = (float(value) for value in load)
    text = (
        f'\n\n[[force]]\nname = "{LOAD}"\ntype = "constant_load"\nbody = "{body}"\n'
        f"force = [{fx!r}, {fy!r}, 0.0]\nmoment = [0.0, 0.0, {moment!r}]\n"
    )
    return Case(
        case.text + text,
        directory=case.directory,
        values=overrides_of("\n".join(f"{k} = {v}" for k, v in case.overrides.items())),
        libraries=case.libraries,
    )
