"""Elevation of an imported spectrum with phases, from its file."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from of_case import (  # type: ignore[import-not-found] # stands beside this file
    tables_of,
    time_of,
)
from scipy.io import loadmat

import hydrodae


def elevations(case: Path, file: Path) -> tuple[np.ndarray, np.ndarray]:
    """Elevation at the origin after the ramp [m]: of a run of the case, and of the file.

    Of rows f [Hz], S [m2/Hz], phase [rad] the sum of sqrt(2 S df) cos(2 pi f t + phase).
    """
    gauge = '\n[[gauge]]\nname = "origin"\npoint = [0.0, 0.0]\n'
    gauged = case.with_name("gauged.toml")
    gauged.write_text(case.read_text(encoding="utf-8") + gauge, encoding="utf-8")
    results = hydrodae.run(gauged)
    time = time_of(results)
    late = time >= tables_of(case)["sea"]["ramp"]
    rows = loadmat(file, simplify_cells=True)[file.stem.rstrip("0123456789")]
    rows = rows[rows[:, 0] > 0.0]
    width = np.gradient(rows[:, 0])
    size = np.sqrt(2.0 * rows[:, 1] * width)
    phase = 2.0 * math.pi * np.outer(time[late], rows[:, 0]) + rows[:, 2]
    ours = np.asarray(results["gauges/origin/elevation"])[late]
    return ours, np.cos(phase) @ size
