"""Control variates: what a linear model absorbs in the very sea of a run.

The mean power of a run differs from that of its sea state by the luck of its phases. So does

    X = 1/T int v^2 dt - 1/2 sum_i |V_i|^2,    v = Re sum_i V_i exp(i (w_i t + phi_i)),

with v the rate of a take-off in a linear model, in the components of the run and over its time. The
phases are uniform and independent, so that the mean of X over all seas is zero, whatever V is. Of
many runs, the part of the scatter that goes with X is taken out (`hydrodae.study.sweep.estimate`).
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError, HydrodaeError
from hydrodae.linear.sea import wave_components
from hydrodae.study.spectral import spectral
from hydrodae.support.arrays import Array, Complex

#: What is controlled, and ".NAME" behind it for one take-off.
POWER = "mean_power_absorbed"
#: Sea states whose transfer functions a process keeps.
KEPT = 64


@dataclass(frozen=True)
class Transfer:
    """Rates of the take-offs of a sea state, linearised in it.

    Attributes
    ----------
    omega : (n,) array
        Ascending [rad/s].
    rates : dict of (n,) complex arrays
        Phasors per metre of wave amplitude, by take-off.
    factors : dict
        Mean power over mean square of the rate [N s/m, N m s].
    """

    omega: Array
    rates: dict[str, Complex]
    factors: dict[str, float]

    def at(self, name: str, omega: Array) -> Complex:
        """Phasors of a take-off between the frequencies: linear in both parts."""
        rate = self.rates[name]
        real, imaginary = (np.interp(omega, self.omega, x) for x in (rate.real, rate.imag))
        return np.asarray(real + 1j * imaginary)


def transfer_of(case: Case) -> Transfer:
    """Linearise a case in its sea (`hydrodae.study.spectral`).

    Raises
    ------
    CaseError
        There is no linear model, no take-off along a joint, or waves travel in several directions.
    """
    found = spectral(case)
    if len(np.unique(found.waves[:, 1])) > 1:
        raise CaseError("its waves travel in several directions")
    order = np.argsort(found.waves[:, 0], kind="stable")
    omega, half = found.waves[order, 0], 0.5 * found.waves[order, 2] ** 2
    rates, factors = {}, {}
    for force in case_tables(case).get("force", []):
        name = force.get("name", "")
        if not str(force.get("type", "")).startswith("pto_") or "joint" not in force:
            continue
        head = f"joints/{force['joint']}/{force.get('coordinate', '')}"
        channel = next((n for n in found.names if n.startswith(head) and "/reaction_" not in n), "")
        if not channel or not found.power.get(name, 0.0) > 0.0:
            continue
        rate = 1j * omega * found.channel(channel)[order]
        square = float(half @ np.abs(rate) ** 2)
        if square > 0.0:
            rates[name], factors[name] = rate, found.power[name] / square
    if not rates:
        raise CaseError("no take-off along a joint absorbs power in the linear model")
    return Transfer(omega, rates, factors)


def excess(transfer: Transfer, waves: Array, start: float, end: float) -> dict[str, float]:
    """Powers of the linear model over a time, less their means over all phases.

    Parameters
    ----------
    transfer : Transfer
    waves : (n, 4) array
        As `hydrodae.linear.sea.wave_components`.
    start, end : float
        [s].

    Returns
    -------
    dict
        Of `POWER`, and of `POWER`.NAME of each take-off [W]; expectation zero.
    """
    w, middle, length = waves[:, 0], 0.5 * (start + end), end - start
    # The mean of exp(i d t) over the time about its middle is sin(d T / 2) / (d T / 2).
    turn = length / (2.0 * np.pi)
    slow = np.sinc(turn * (w[:, None] - w))
    fast = np.sinc(turn * (w[:, None] + w))
    amplitude = waves[:, 2] * np.exp(1j * (waves[:, 3] + w * middle))
    out = {}
    for name, factor in transfer.factors.items():
        a = transfer.at(name, w) * amplitude
        mean = 0.5 * float((a.conj() @ (slow @ a)).real + (a @ (fast @ a)).real)
        out[f"{POWER}.{name}"] = factor * (mean - 0.5 * float(np.sum(np.abs(a) ** 2)))
    return {POWER: sum(out.values()), **out}


class Controls:
    """Control variates of the points of a study, by the keys of whose seeds the runs repeat.

    Parameters
    ----------
    case : Case
        Of the study.
    seeds : tuple of (str, value)
        For each key of a seed the value at which a sea state is linearised: the same in every
        process, so that the variates do not depend on which of them meets a sea state first.
    """

    def __init__(self, case: Case, seeds: tuple[tuple[str, Any], ...]) -> None:
        self._case, self._seeds = case, seeds
        self._known: dict[str, Transfer | str] = {}

    def serves(self, case: Case, seeds: tuple[tuple[str, Any], ...]) -> bool:
        """Return whether the variates are those of this case and these seeds."""
        return self._case is case and self._seeds == seeds

    def of(self, point: dict[str, Any], own: Case | None = None) -> dict[str, Any]:
        """Parts of a row: `control`, by name, or `uncontrolled`, why there is none.

        Parameters
        ----------
        point : dict
            Of a run that completed.
        own : Case, optional
            At the point, where it is known.
        """
        transfer = self._transfer({**point, **dict(self._seeds)})
        if isinstance(transfer, str):
            return {"uncontrolled": transfer}
        own = own or self._case.with_values(point)
        start = float(case_tables(own).get("sea", {}).get("ramp", 0.0))
        return {"control": excess(transfer, wave_components(own), start, own.scene.end_time)}

    def _check_phases(self, case: Case) -> None:
        """Raise CaseError for a wave whose phases are the same in all runs: they have no mean."""
        drawn = {key for key, _ in self._seeds}
        for wave in case.scene.wave_names:
            if f"wave.{wave}.seed" not in drawn:
                raise CaseError(f"wave {wave!r} has the same phases in all runs")

    def _transfer(self, point: dict[str, Any]) -> Transfer | str:
        key = json.dumps(point, sort_keys=True)
        if key not in self._known:
            if len(self._known) >= KEPT:
                self._known.pop(next(iter(self._known)))
            try:
                case = self._case.with_values(point)
                self._check_phases(case)
                self._known[key] = transfer_of(case)
            except HydrodaeError as error:
                self._known[key] = str(error).splitlines()[0]
        return self._known[key]
