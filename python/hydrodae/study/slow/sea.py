"""The sea of a case for sums over pairs of waves: bins of a continuous sea, or its components."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.linear.sea import wave_components
from hydrodae.support.arrays import Array

#: Least and largest number of bins of a continuous sea: the spectra of pairs cost its square.
BINS, MOST_BINS = 256, 1024
#: Components that are drawn to find the energy of the bins, at least 20 in each.
DRAWN = 20000
#: Waves without a spectrum that is drawn at random.
FIXED = ("regular", "measured", "new_wave", "components")


@dataclass(frozen=True)
class PairSea:
    """Waves, of which loads take pairs.

    Attributes
    ----------
    omega, heading, energy, phase : (n,) arrays
        Frequency [rad/s], direction of travel [rad], half the square of the amplitude [m2], phase
        [rad].
    width : float
        Of the bins [rad/s], whose middles are `omega`; 0 for components.
    lost : float
        Part of the variance that lies outside the frequencies asked for.
    """

    omega: Array
    heading: Array
    energy: Array
    phase: Array
    width: float
    lost: float = 0.0

    def between(self, low: float, high: float) -> PairSea:
        """Return the waves from one frequency to another, both included."""
        slack = 1e-9
        mine = (self.omega >= low * (1 - slack)) & (self.omega <= high * (1 + slack))
        return PairSea(
            self.omega[mine],
            self.heading[mine],
            self.energy[mine],
            self.phase[mine],
            self.width,
            float(self.energy[~mine].sum() / self.energy.sum()),
        )

    @property
    def lost_text(self) -> str:
        """Words for `lost`."""
        return (
            f"{100.0 * self.lost:.2g} % of the variance of the waves lies outside the "
            "frequencies of the table"
        )


def sea_of(case: Case, table: Array) -> PairSea:
    """Return the waves of a case within the frequencies (w,) [rad/s] of a table.

    Random long-crested waves of one direction are a continuous sea. Others are the components of
    the case. The bins are half as wide as the smallest step of the table, which is fine where loads
    have narrow peaks.

    Raises
    ------
    CaseError
        No wave lies between the frequencies.
    """
    low, high = float(table[0]), float(table[-1])
    drawn = wave_components(case)
    components = PairSea(drawn[:, 0], drawn[:, 1], 0.5 * drawn[:, 2] ** 2, drawn[:, 3], 0.0)
    inside = components.between(low, high)
    if inside.omega.size == 0:
        raise CaseError(
            f"no wave of the sea lies within the frequencies of the tables of second order, "
            f"{low:g} to {high:g} rad/s",
            key="second_order.loads",
        )
    if not _is_continuous(case, inside.heading):
        return inside
    names = [wave["name"] for wave in case_tables(case)["wave"]]
    fine: dict[str, Any] = {f"wave.{name}.components": DRAWN for name in names}
    fine |= {f"wave.{name}.spacing": "frequency" for name in names}
    waves = wave_components(case.with_values(fine))
    omega, energy = waves[:, 0], 0.5 * waves[:, 2] ** 2
    order = np.argsort(omega)
    omega, energy = omega[order], energy[order]
    low, high = max(low, float(omega[0])), min(high, float(omega[-1]))
    finest = 0.5 * float(np.diff(table).min(initial=high - low))
    count = int(np.clip(np.ceil((high - low) / finest), BINS, MOST_BINS))
    edges = np.linspace(low, high, count + 1)
    below = np.interp(edges, omega, np.cumsum(energy) - 0.5 * energy)
    middle = 0.5 * (edges[1:] + edges[:-1])
    return PairSea(
        middle,
        np.full(count, inside.heading[0]),
        np.diff(below),
        np.zeros(count),
        edges[1] - edges[0],
        1.0 - float((below[-1] - below[0]) / energy.sum()) if inside.lost > 0.0 else 0.0,
    )


def _is_continuous(case: Case, heading: Array) -> bool:
    waves = case_tables(case)["wave"]
    random = all(wave["type"] not in FIXED and "crest" not in wave for wave in waves)
    return random and float(np.ptp(heading)) < 1e-9
