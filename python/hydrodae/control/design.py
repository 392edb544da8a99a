"""Impedance matching: gains of a PI controller from the device's own impedance.

Along a joint the device is Z(w) s' = F(w) + u, Z from the frequency tables at its equilibrium. The
controller stands for the power take-off. So Z leaves out all take-offs along joints (types
``pto_...``), also those that a gear or another loop couples to this joint, unless one is kept.
Every other load counts. A load u = -Kp s' - Ki s with

    Kp = Re Z(w0),    Ki = w0 Im Z(w0)

makes Z + Kp + Ki / (iw) equal to 2 Re Z at w0, and takes |F|^2 / (8 Re Z) from a wave of frequency
w0, the most that can be taken.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hydrodae.control.plant import Plant
from hydrodae.errors import CaseError
from hydrodae.linear.sea import wave_components


@dataclass(frozen=True)
class Matching:
    """A PI controller of the rate of a joint, matched at one frequency.

    Attributes
    ----------
    omega : float
        w0 [rad/s].
    impedance : complex
        Z(w0) [N s/m, N m s/rad].
    gain_p, gain_i : float
        Keys of a `[[controller]]` of type ``pid`` whose input is the rate [N s/m, N/m; N m s/rad,
        N m/rad].
    excitation : float
        |F(w0)| per metre of amplitude [N/m, N]; NaN for a case without waves.
    left_out, counted : tuple of str
        Forces of the case: take-offs, which Z is without, and the others.
    """

    omega: float
    impedance: complex
    gain_p: float
    gain_i: float
    excitation: float
    left_out: tuple[str, ...] = ()
    counted: tuple[str, ...] = ()

    @property
    def power(self) -> float:
        """Most mean power from a regular wave of w0, per square metre of its amplitude [W/m2]."""
        return self.excitation**2 / (8.0 * self.impedance.real)

    @property
    def resistive(self) -> float:
        """The damper that takes most without a spring, |Z| [N s/m, N m s/rad]."""
        return abs(self.impedance)

    @property
    def resistive_power(self) -> float:
        """What that damper takes [W/m2]."""
        return self.excitation**2 / (4.0 * (abs(self.impedance) + self.impedance.real))


def energy_frequency(waves: np.ndarray) -> float:
    """Frequency of the energy period of wave components, 2 pi m_0 / m_-1 over 2 pi [rad/s].

    Parameters
    ----------
    waves : (n, 4) array
        As `hydrodae.linear.sea.wave_components`.
    """
    energy = waves[:, 2] ** 2
    return float(energy.sum() / (energy / waves[:, 0]).sum())


def match(
    plant: Plant,
    period: float | None = None,
    heading: float | None = None,
    keep: Sequence[str] = (),
) -> Matching:
    """Match a PI controller to a device.

    Parameters
    ----------
    plant : Plant
        The device along a joint. The power take-offs that the case has along joints are left out:
        where the controller writes the load of one, set its own damping and stiffness to zero.
    period : float, optional
        Of the wave to match [s]; by default the energy period of the sea of the case.
    heading : float, optional
        Of the waves [rad]; by default that of the case's first wave, else 0.
    keep : sequence of str, optional
        Take-offs that stay beside the controller, as the friction of a drive train.

    Raises
    ------
    CaseError
        Neither a period nor a sea is given, or the device gives energy at that frequency.
    DatabaseError
        The frequency is outside the database.
    """
    if period is not None and not 0.0 < period < np.inf:
        raise CaseError(f"the period of the wave is {period:g} s: expected > 0")
    waves = None
    if period is None or heading is None:
        try:
            waves = wave_components(plant.model.case)
        except CaseError:
            if period is None:
                raise CaseError(
                    "the case has no [[wave]]: say which period the controller is for"
                ) from None
    omega = energy_frequency(waves) if period is None and waves is not None else _rate(period)
    direction = heading if heading is not None else float(waves[0, 1]) if waves is not None else 0.0
    for name in keep:
        if name not in plant.take_offs:
            known = ", ".join(plant.take_offs) or "none"
            raise CaseError(
                f"keep {name!r}: no take-off along a joint has this name; there are: {known}"
            )
    left_out = tuple(name for name in plant.take_offs if name not in keep)
    counted = tuple(name for name in plant.loads if name not in left_out)
    z = complex(plant.without(left_out).impedance(omega)[0])
    if z.real <= 0.0:
        raise CaseError(
            f"the device has the resistance {z.real:.3g} at {omega:.4g} rad/s: nothing to match"
        )
    has_waves = plant.model.database is not None and plant.model.database.heading.size > 0
    force = abs(plant.excitation(omega, direction)[0]) if has_waves else np.nan
    return Matching(omega, z, z.real, omega * z.imag, float(force), left_out, counted)


def _rate(period: float | None) -> float:
    assert period is not None
    return 2.0 * np.pi / period
