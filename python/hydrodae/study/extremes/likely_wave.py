"""The most likely wave for a response: the mean sea about a peak of a given height.

A Gaussian sea, given that a linear response has a peak R at the time t0, is on average

    eta(t) = sum a_n cos(w_n (t - t0) - arg H_n),    a_n = R |H_n| E_n / sum_m |H_m|^2 E_m

with E_n = S(w_n) dw_n the energy of each component and H the transfer function (Tromans, Anaturk
and Hagemeijer, ISOPE 1991; Dietz, Friis-Hansen and Jensen, 2004: most likely response wave; WDRT:
most likely extreme response, MLER). H = 1 gives the NewWave.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hydrodae.case.case import Case, CaseLike
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.linear.sea import wave_components
from hydrodae.study.extremes.channels import Transfer
from hydrodae.study.extremes.rayleigh import Narrow, largest, once
from hydrodae.support.arrays import Array, Complex

#: Keys of waves that are a record or one wave: they have no spectrum.
WITHOUT_SPECTRUM = ("regular", "measured")
#: Samples of the shortest component's period: a parabola through three finds the crest to 1e-4.
SAMPLES = 20
#: Mean periods of the response before and after its peak in which crest and trough are looked for.
PERIODS = 20


def amplitudes(response: Complex, energy: Array, level: float) -> tuple[Array, Array]:
    """Amplitudes [m] and phases [rad] of the most likely wave, for a peak at t = 0, x = 0.

    Parameters
    ----------
    response : (n,) complex array
        H, transfer function of the response per metre of wave amplitude.
    energy : (n,) array
        E = S dw of each component [m2].
    level : float
        Height of the peak R, in the unit of the response; negative: of the trough.

    Returns
    -------
    amplitude, phase : (n,) arrays

    Raises
    ------
    CaseError
        The response is zero.
    """
    weight = float(np.sum(np.abs(response) ** 2 * energy))
    if not weight > 0.0:
        raise CaseError("the response is zero in this sea: no wave is the most likely one for it")
    turn = 0.0 if level >= 0.0 else math.pi
    return abs(level) * np.abs(response) * energy / weight, turn - np.angle(response)


@dataclass(frozen=True)
class LikelyWave:
    """The most likely wave for a response of a case; printed, what the command prints.

    Attributes
    ----------
    channel, unit : str
    level : float
        Response at its peak, about its value at rest [unit].
    at_rest : float
        Value of the channel at rest [unit].
    time : float
        Time of the peak [s].
    waves : (n, 4) array
        Frequency [rad/s], amplitude [m], phase [rad], heading [rad].
    response : (n,) complex array
        Transfer function at each component [unit per m].
    narrow : Narrow
        Deviation and rate of the response in the sea of the case.
    hours, exceedance : float or None
        Duration, and the probability that its largest response exceeds `level`; None where the
        level was given.
    notes : list of str
    """

    channel: str
    unit: str
    level: float
    at_rest: float
    time: float
    waves: Array
    response: Complex
    narrow: Narrow
    hours: float | None = None
    exceedance: float | None = None
    notes: list[str] = field(default_factory=list)

    def elevation(self, time: Array) -> Array:
        """Elevation at the origin at times (nt,) [s], (nt,) [m]."""
        return self._sum(time, np.ones(len(self.waves)))

    def motion(self, time: Array) -> Array:
        """Linear response at times (nt,) [s] about its value at rest, (nt,) [unit]."""
        return self._sum(time, self.response)

    def _sum(self, time: Array, factor: Complex | Array) -> Array:
        w, amplitude, phase, _ = self.waves.T
        turned = np.exp(1j * np.outer(np.asarray(time, dtype=float), w))
        return np.asarray((turned @ (factor * amplitude * np.exp(1j * phase))).real)

    @property
    def crest(self) -> float:
        """Highest elevation at the origin about the peak [m]."""
        return self._highest(1.0)

    @property
    def trough(self) -> float:
        """Lowest elevation at the origin about the peak [m]."""
        return -self._highest(-1.0)

    def _highest(self, sign: float) -> float:
        """Largest of sign x elevation, by the parabola through the three highest samples."""
        step = 2.0 * math.pi / float(self.waves[:, 0].max()) / SAMPLES
        count = max(1, math.ceil(PERIODS * self.narrow.period / step))
        time = self.time + step * np.arange(-count, count + 1, dtype=float)
        x = sign * self.elevation(time)
        k = int(np.clip(np.argmax(x), 1, len(x) - 2))
        before, middle, after = x[k - 1 : k + 2]
        curvature = before - 2.0 * middle + after
        return float(middle - 0.125 * (after - before) ** 2 / curvature if curvature else middle)

    def __str__(self) -> str:
        from hydrodae.study.extremes.text import likely_wave

        return likely_wave(self)


def likely_wave(
    case: CaseLike,
    channel: str,
    *,
    response: float | None = None,
    hours: float = 3.0,
    exceedance: float | None = None,
    least: bool = False,
    time: float | None = None,
    components: int = 500,
    set: Mapping[str, Any] | None = None,
) -> LikelyWave:
    """Return the most likely wave for a response in the sea of a case.

    Parameters
    ----------
    case : Case, Scene or path
        With irregular waves.
    channel : str
        Of the linear model, such as "bodies/float/heave", "joints/hinge/angle",
        "joints/hinge/reaction_force.x", "forces/pto/force", "forces/bow/tension".
    response : float, optional
        Height of the peak about the value at rest [unit of the channel]; negative: of the trough.
        Without it the most probable largest response of `hours`.
    hours : float
        Duration [h].
    exceedance : float, optional
        In place of the most probable value that which the largest of `hours` exceeds with this
        probability.
    least : bool
        The least response in place of the largest.
    time : float, optional
        Of the peak [s]; default: halfway between the end of the ramp and the end of the case.
    components : int
        Number of components of each wave.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.

    Raises
    ------
    CaseError
        There is no such channel, a wave has no spectrum, or a value cannot be used.
    DatabaseError
        Waves are outside the database.
    """
    model = LinearModel.of(case, set)
    transfer = Transfer(model)
    transfer.check(channel)
    waves = spectral_components(model.case, components)
    h, energy = transfer.in_waves(channel, waves), 0.5 * waves[:, 2] ** 2
    if not np.abs(h).max() > 0.0:
        raise CaseError(f"{channel}: the linear response is zero in this sea", key="channel")
    narrow = Narrow.of(waves[:, 0], np.abs(h) ** 2 * energy)
    if response is None:
        share = once() if exceedance is None else exceedance
        level = largest(narrow, hours, share) * (-1.0 if least else 1.0)
        said: tuple[float | None, float | None] = hours, share
    else:
        if not math.isfinite(response) or response == 0.0:
            raise CaseError(
                f"response {response:g}: expected a number other than 0", key="response"
            )
        if least or exceedance is not None:
            raise CaseError("response: a given level excludes exceedance and least", key="response")
        level, said = response, (None, None)
    a, phase = amplitudes(h, energy, level)
    at = _peak_time(model.case, time)
    table = np.column_stack([waves[:, 0], a, _turned(phase - waves[:, 0] * at), waves[:, 1]])
    return LikelyWave(
        channel,
        transfer.units[channel],
        level,
        transfer.at_rest.get(channel, 0.0),
        at,
        table[np.argsort(waves[:, 0], kind="stable")],
        h[np.argsort(waves[:, 0], kind="stable")],
        narrow,
        *said,
        model.notes,
    )


def spectral_components(case: Case, count: int) -> Array:
    """Components (n, 4) of the waves of a case, in bins of equal width in frequency.

    Raises
    ------
    CaseError
        There is no wave, one has no spectrum, or the number of components is wrong.
    """
    if not 2 <= count <= 100_000:
        raise CaseError(f"components {count}: expected 2 to 100000", key="components")
    waves = case_tables(case).get("wave", [])
    for wave in waves:
        if wave["type"] in WITHOUT_SPECTRUM:
            raise CaseError(
                f"wave {wave['name']!r} is of type {wave['type']}, without a spectrum: an extreme "
                "needs an irregular one, such as jonswap",
                key=f"wave.{wave['name']}.type",
            )
    values: dict[str, Any] = {}
    for wave in waves:
        key = f"wave.{wave['name']}"
        values |= {f"{key}.components": count, f"{key}.spacing": "frequency"}
    found = wave_components(case.with_values(values) if values else case)
    if not float(np.sum(found[:, 2] ** 2)) > 0.0:
        raise CaseError("the waves of the case have no height")
    return found


def _peak_time(case: Case, time: float | None) -> float:
    ramp = float(case_tables(case).get("sea", {}).get("ramp", 0.0))
    end = float(case.end_time)
    if time is None:
        return 0.5 * (ramp + end) if end > ramp else ramp
    if not ramp <= time <= end:
        raise CaseError(
            f"time {time:g} s: expected a time from the end of the ramp, {ramp:g} s, to the end of "
            f"the case, {end:g} s",
            key="time",
        )
    return time


def _turned(phase: Array) -> Array:
    """Phases from -pi to pi."""
    return np.asarray((phase + math.pi) % (2.0 * math.pi) - math.pi)
