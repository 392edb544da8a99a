"""Numeric files of WAMIT: the columns of each, and what their keys and values mean.

Every line holds numbers only, but for one title line that the option NUMHDR writes first. The first
column of all but `.hst` is the period, or a frequency or wavenumber (option IPEROUT); zero and
negative values there stand for w = inf and w = 0, or the other way round.
"""

from __future__ import annotations

import numpy as np

from hydrodae.hdb.readers.rows import Columns
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.relations.dispersion import frequency
from hydrodae.support.arrays import Array

LOAD = "mode, modulus, phase, real and imaginary part"
FORCE = Columns(f"period, heading, {LOAD}", 1, 1, 1, 4, length=2.0)
DRIFT = Columns(f"period, two headings, {LOAD}", 1, 2, 1, 4, length=1.0)
PAIRS = Columns(f"two periods, two headings, {LOAD}", 2, 2, 1, 4, length=1.0)
#: What a line holds, by the suffix of the file.
COLUMNS = {
    ".1": Columns("period, I, J, A [, B]", 1, 0, 2, 2, 1, length=3.0, weight=False),
    **dict.fromkeys((".2", ".3", ".3fk", ".3sc"), FORCE),
    ".hst": Columns("I, J, C(I,J)", 0, 0, 2, 1, length=2.0),
    **dict.fromkeys((".7", ".8", ".9"), DRIFT),
    **dict.fromkeys((".10d", ".11d", ".12d", ".10s", ".11s", ".12s"), PAIRS),
}
#: What the first column may hold, by IPEROUT: w^2/g L in deep water and k L in the given depth.
FIRST = {1: "period", 2: "frequency", 3: "wavenumber of deep water", 4: "wavenumber"}


def to_omega(first: Array, setting: Setting) -> Array:
    """Turn what stands in the first column of a file (m,) into frequencies [rad/s].

    Parameters
    ----------
    first : (m,) array
    setting : Setting
        What the column holds, of `FIRST`, the length scale and the water.
    """
    option, omega, usual = setting.first_column, np.empty_like(first), first > 0.0
    if option == 1:
        omega[usual] = 2.0 * np.pi / first[usual]
        omega[~usual] = np.where(first[~usual] == 0.0, np.inf, 0.0)
        return omega
    omega[usual] = first[usual]
    if option > 2:
        depth = setting.depth if option == 4 else np.inf
        omega[usual] = frequency(first[usual] / setting.length, depth, setting.gravity)
    omega[~usual] = np.where(first[~usual] == 0.0, 0.0, np.inf)
    return omega


def unit(columns: Columns, setting: Setting, turns: Array) -> Array:
    """Unit of values of modes of which so many are rotations."""
    weight = setting.rho * setting.gravity if columns.weight else setting.rho
    return np.asarray(weight * setting.length ** (columns.length + turns))
