"""Drift for people, and as CSV."""

from __future__ import annotations

import csv
import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hydrodae.support import outputs
from hydrodae.support.arrays import Array

if TYPE_CHECKING:
    from hydrodae.study.drift.far_field import Drift

#: Lines of a printed table.
MOST_LINES = 16
#: The Maruo inequality is broken if the drift is below P k / w by more of the largest drift than
#: this, the noise of a mesh: see `hydrodae.hdb.checks.drift`.
NOISE = 0.02


def table(found: Drift) -> str:
    """Return drift, its error and the power for some frequencies of each heading."""
    lines = [
        f"mean drift of all bodies over the square of the wave amplitude; yaw about the centre of "
        f"gravity of {found.carrier.body}"
    ]
    pick = np.unique(np.linspace(0, found.omega.size - 1, MOST_LINES).round().astype(int))
    for h, heading in enumerate(found.heading):
        lines.append(
            f"heading {np.degrees(heading):g} deg: surge, sway, drift along the waves by energy "
            f"and its least value P k/w [kN/m2]; yaw [kN m/m2]; power P [kW/m2]"
        )
        lines.append(
            f"  {'rad/s':>8} {'period':>8} {'surge':>10} {'sway':>10} {'by energy':>10} "
            f"{'P k/w':>10} {'yaw':>10} {'power':>10}"
        )
        largest = float(np.abs(found.by_power).max())
        for i in pick:
            fx, fy, m = found.load[i, h].real
            row = (fx, fy, found.by_power[i, h], found.least[i, h], m, found.power[i, h])
            cells = " ".join(f"{_rounded(1e-3 * value, 1e-3 * largest):>10}" for value in row)
            period = 2.0 * np.pi / found.omega[i]
            lines.append(f"  {found.omega[i]:8.4g} {period:6.4g} s {cells}")
    lines.append(verdict(found))
    return "\n".join(lines)


def verdict(found: Drift) -> str:
    """Return the error of the drift and whether it keeps the law of Maruo."""
    at = np.unravel_index(int(np.abs(found.gap).argmax()), found.gap.shape)
    kept = (
        f"Maruo's inequality F >= P k/w holds, least margin {found.margin:.2g} of the largest drift"
        if found.margin >= -NOISE
        else f"Maruo's inequality F >= P k/w is broken by {-found.margin:.2g} of the largest drift"
    )
    between = ""
    if found.computed.any() and found.error_computed < 0.5 * found.error > NOISE:
        between = (
            f" ({found.error_computed:.2g} at the frequencies of the database: compute it for "
            f"closer ones)"
        )
    return (
        f"error: momentum and energy differ by at most {found.error:.2g} of the largest drift, at "
        f"{found.omega[at[0]]:.4g} rad/s{between}\n{kept}"
    )


def _rounded(value: float, largest: float) -> str:
    return f"{0.0 if abs(value) < 1e-9 * largest else value:.4g}"


def write_csv(path: str | os.PathLike[str], found: Drift) -> Path:
    """Write a line for each frequency and pair of headings.

    Raises
    ------
    CaseError
        A file of another kind is there.
    """
    path = outputs.claim(path, outputs.CSV)
    with outputs.whole(path) as beside, beside.open("w", newline="") as file:
        rows = csv.writer(file)
        head = ["omega [rad/s]", "heading 1 [deg]", "heading 2 [deg]"]
        for name, unit in (("surge", "N/m2"), ("sway", "N/m2"), ("yaw", "N m/m2")):
            head += [f"{name} real [{unit}]", f"{name} imaginary [{unit}]"]
        by_force = [f"{name} mean power [W/m2]" for name in found.by_force]
        rows.writerow([*head, "along [N/m2]", "by energy [N/m2]", "power [W/m2]", *by_force])
        degrees = np.degrees(found.heading)
        for i, omega in enumerate(found.omega):
            for m, (one, other) in enumerate(found.pairs):
                load = found.load[i, m]
                row = [omega, degrees[one], degrees[other]]
                row += np.stack([load.real, load.imag], axis=1).ravel().tolist()
                cells = [f"{x:.9g}" for x in row]
                own = (found.along, found.by_power, found.power, *found.by_force.values())
                cells += [f"{x[i, one]:.9g}" if one == other else "" for x in own]
                rows.writerow(cells)
    return path


def columns(found: Drift, omega: Array, h: int = 0) -> dict[str, tuple[str, Array]]:
    """Return unit and values (nw,) of the drift in waves of one heading, by name.

    Parameters
    ----------
    found : Drift
    omega : (nw,) array
        Frequencies among those of the drift, in any order [rad/s].
    h : int
        Place of the heading.
    """
    rows = np.searchsorted(found.omega, omega)
    surge, sway, yaw = found.load[rows, h].real.T
    return {
        "drift surge": ("N/m2", surge),
        "drift sway": ("N/m2", sway),
        "drift yaw": ("N m/m2", yaw),
        "drift by energy": ("N/m2", found.by_power[rows, h]),
    }


def beside_motions(found: Drift, periods: Array) -> str:
    """Return a line for each load of one heading: peak, its period, values at periods [s]."""
    lines = ["mean drift of all bodies over the square of the wave amplitude"]
    head = " ".join(f"{f'{period:.4g} s':>10}" for period in periods)
    lines.append(f"  {'':16} {'':9} {'peak':>10} {'period':>9}  {head}")
    largest = float(np.abs(found.by_power).max())
    omega = 2.0 * np.pi / periods
    for name, (unit, values) in columns(found, found.omega).items():
        top = int(np.abs(values).argmax())
        if np.abs(values[top]) < 1e-9 * largest:
            continue
        at = [values[int(np.abs(found.omega - w).argmin())] for w in omega]
        numbers = " ".join(f"{_rounded(1e-3 * value, 1e-3 * largest):>10}" for value in at)
        peak = _rounded(1e-3 * values[top], 1e-3 * largest)
        period = 2.0 * np.pi / found.omega[top]
        lines.append(f"  {name:16} {'k' + unit:9} {peak:>10} {period:7.3f} s  {numbers}")
    return "\n".join([*lines, verdict(found)])
