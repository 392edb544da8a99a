"""What a run of WAMIT or HAMS was asked for: frequencies and motions that its tables must hold."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.readers.text import NUMBER, number
from hydrodae.hdb.readers.wamit_tables import to_omega
from hydrodae.hdb.relations.dispersion import frequency
from hydrodae.support.arrays import Array

#: What the first column of the tables may hold, by IPEROUT; IPERIN likewise.
COLUMNS = {1: "period", 2: "frequency", 3: "wavenumber of deep water", 4: "wavenumber"}
#: HAMS: 1, 2 wavenumber in deep and finite depth, 3 frequency, 4 period (5 wavelength).
HAMS = {"1": 3, "2": 4, "3": 2, "4": 1}
WAVELENGTH = 5
#: Relative distance within which a frequency is one that was asked for, and share of a step.
SAME, QUARTER = 3e-3, 0.25
#: Share of the frequencies of a table that must have been asked for; by chance a half may be.
MOST = 0.8


@dataclass(frozen=True)
class Asked:
    """Frequencies, and motions of each body, of a control file.

    Attributes
    ----------
    where : Path
    values : (m,) array
        Periods, frequencies or wavenumbers.
    kind : int or None
        Which of them (IPERIN); None where no file says.
    modes : list of list of int
        1 (surge) to 6 (yaw) of each body; none: not said.
    """

    where: Path
    values: Array
    kind: int | None
    modes: list[list[int]]


def steps(count: int, numbers: list[float]) -> Array:
    """Values of a list, or -count of them from a first one by steps."""
    if count >= 0:
        return np.array(numbers[:count])
    if len(numbers) < 2:
        return np.zeros(0)
    return np.asarray(numbers[0] + numbers[1] * np.arange(-count, dtype=float))


def of_hams(path: Path, text: str) -> Asked | None:
    """Frequencies and motions that a ControlFile.in of HAMS asks for; it computes all six."""
    kind = re.search(r"Input_frequency_type\s+(\d)", text)
    count = re.search(rf"Number_of_frequencies\s+({NUMBER})(.*)", text)
    if kind is None or count is None or int(kind[1]) not in (*HAMS.values(), WAVELENGTH):
        return None
    wanted = int(number(count[1]))
    if wanted < 0:
        first = re.search(rf"Minimum_frequency_Wmin\s+({NUMBER})", text)
        step = re.search(rf"Frequency_step\s+({NUMBER})", text)
        if first is None or step is None:
            return None
        values = steps(wanted, [number(first[1]), number(step[1])])
    else:
        lines = text[count.end() :].splitlines()
        row = next((line.split("!")[0] for line in lines if line.strip()), "")
        values = np.array([number(word) for word in re.findall(NUMBER, row)])
    return Asked(path, values, HAMS.get(kind[1], WAVELENGTH), [list(range(1, 7))])


def asked_findings(
    asked: Asked | None,
    radiation: Path,
    omega: Array,
    modes: Array,
    names: list[str],
    constants: tuple[float, float, float],
    option: int,
) -> list[Finding]:
    """Compare the tables with what was asked for.

    Parameters
    ----------
    asked : Asked or None
        Nothing is reported without.
    radiation : Path
        The file of A and B.
    omega : (nw,) array
        Frequencies > 0 that it holds [rad/s].
    modes : (n,) array
        Modes that it holds, from 1.
    names : list of str
        The bodies.
    constants : tuple of float
        Length scale, depth, gravity [m, m, m/s2].
    option : int
        What the first column was taken as, of `COLUMNS`.

    Returns
    -------
    list of Finding
        Errors.
    """
    if asked is None:
        return []
    found = []
    kinds = list(COLUMNS) if asked.kind is None else [asked.kind]
    grids = [_omega(asked, kind, constants) for kind in kinds]
    if omega.size and all(g.size for g in grids) and not any(_within(omega, g) for g in grids):
        grid = grids[kinds.index(2)] if 2 in kinds else grids[0]
        text = (
            f"{asked.where.name} asks for {grid[0]:.4g}..{grid[-1]:.4g} rad/s; the first column of "
            f"{radiation.name}, read as the {COLUMNS[option]}, holds {omega[0]:.4g}.."
            f"{omega[-1]:.4g} rad/s: another unit, or files of different runs"
        )
        found.append(Finding("error", "frequencies asked for", text))
    lost = [
        f"{name}.{DOFS[mode - 1]}"
        for i, (name, wanted) in enumerate(zip(names, asked.modes, strict=False))
        if np.any((modes - 1) // 6 == i)
        for mode in wanted
        if 6 * i + mode not in modes
    ]
    if lost:
        text = (
            f"{asked.where.name} asks for {', '.join(lost)}, of which {radiation.name} holds "
            f"nothing: rows are missing"
        )
        found.append(Finding("error", "motions asked for", text))
    return found


def _omega(asked: Asked, kind: int, constants: tuple[float, float, float]) -> Array:
    """Frequencies that were asked for [rad/s], ascending; those of 0 and infinity left out."""
    values = asked.values[asked.values > 0.0]
    if kind == WAVELENGTH:
        found = np.asarray(frequency(2.0 * np.pi / values, constants[1], constants[2]))
    else:
        try:
            found = to_omega(asked.where, values, kind, *constants)
        except DatabaseError:
            return np.zeros(0)
    return np.unique(found)


def _within(omega: Array, grid: Array) -> bool:
    """Return whether most frequencies were asked for."""
    at = np.abs(omega[:, None] - grid).argmin(axis=1)
    step = np.gradient(grid)[at] if grid.size > 1 else np.full(at.size, np.inf)
    near = np.abs(omega - grid[at]) < np.minimum(SAME * omega, QUARTER * step)
    return bool(np.mean(near) > MOST)
