"""A fixed strut in the water with gauges beside it: what the sea is, without a floating body."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from tests.attack.parts import Table, body
from tests.attack.parts import case as made
from tests.verification.blocks import case_of

import hydrodae
from hydrodae.linear.sea import wave_components

JONSWAP: Table = dict(name="storm", type="jonswap", significant_height=3.0, peak_period=9.0)
JONSWAP |= dict(components=60)


def strut(
    *waves: Table,
    sea: Table | None = None,
    gauges: list[list[float]] = [[0.0, 0.0]],  # noqa: B006
    depth: float | None = None,
    end: float = 10.0,
    step: float = 0.25,
    strut: Table | None = None,
    folder: Path = Path(),
) -> hydrodae.Case:
    """Return a case of waves past a slender strut that cannot move."""
    member = dict(name="strut", body="post", drag_coefficient=1.0, segments=1, diameter=0.1)
    member |= dict(point_a=[0.0, 0.0, -6.0], point_b=[0.0, 0.0, -4.0]) | (strut or {})
    environment: Table = {"water_density": 1025.0}
    if depth is not None:
        environment["water_depth"] = depth
    tables = made(
        [
            body("post", "fixed", 100.0, [0.0, 0.0, -5.0]),
            body("idle", ["surge"], 1.0, [0.0, 50.0, 0.0]),
        ],
        end,
        environment=environment,
        morison=[member],
        output={"step": step},
    )
    if sea:
        tables["sea"] = sea
    if waves:
        tables["wave"] = list(waves)
        tables["gauge"] = [{"name": f"g{k}", "point": place} for k, place in enumerate(gauges)]
    return case_of(tables, folder)


def gauge(results: hydrodae.Results, number: int = 0) -> np.ndarray:
    return results[f"gauges/g{number}/elevation"].to_numpy()


def elevation(case: hydrodae.Case, t: Any, x: float = 0.0, y: float = 0.0) -> np.ndarray:
    """Linear elevation (n_t,) of the components of a case in deep water."""
    return _sum(case, t, x, y).real


def rate(case: hydrodae.Case, t: Any, x: float = 0.0, y: float = 0.0) -> np.ndarray:
    w = wave_components(case)[:, 0]
    return _sum(case, t, x, y, 1j * w).real


def _sum(case: hydrodae.Case, t: Any, x: float, y: float, factor: Any = 1.0) -> np.ndarray:
    w, heading, a, phase = wave_components(case).T
    along = x * np.cos(heading) + y * np.sin(heading)
    angle = np.multiply.outer(np.asarray(t, dtype=float), w) - w**2 / 9.81 * along + phase
    return np.asarray(np.exp(1j * angle) @ (a * factor))
