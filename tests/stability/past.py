"""Hard scenes that depend on their past: a controller with a delay, radiation by convolution."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
from scipy.integrate import solve_ivp
from tests.stability import truths, water
from tests.stability.scene import Scene

from hydrodae.support.arrays import Array

MASS, STIFFNESS, DAMPING, DELAY, START = 2.0, 8.0, 0.4, 0.7, 0.3
RESIDUE = 800.0  #: kernel of the float: RESIDUE exp(-t) [N/m]


def scenes() -> list[Scene]:
    """Return the scenes with a past."""
    inertia = water.MASS + water.ADDED_MASS
    system = np.array([
        [0, 1, 0], [-water.STIFFNESS / inertia, 0, -1 / inertia], [0, RESIDUE, water.POLE],
    ])  # fmt: skip
    return [
        _late_damper(),
        _float("convolution", "float whose memory is a convolution (for comparison)", 20.0,
               source="closed form by eigenvectors", measured=water.heave,
               truth=truths.linear(system, [1.0, 0.0, 0.0], 0)),
        _float("short_memory", "radiation memory cut too short", 1.0,
               source="37 % of the kernel is cut off", measured=water.heave,
               impossible="more than a third of the memory is missing"),
    ]  # fmt: skip


def _late_damper() -> Scene:
    cart = {
        "name": "cart", "motion": "surge", "mass": MASS, "center_of_gravity": [0.0, 0.0, 0.0],
        "initial": {"displacement": [START, 0.0, 0.0]},
    }  # fmt: skip
    slide = {
        "name": "slide", "type": "prismatic", "body_a": "ground", "body_b": "cart",
        "point": [0.0, 0.0, 0.0], "axis": [1.0, 0.0, 0.0],
    }  # fmt: skip
    force = {"type": "pto_linear", "joint": "slide"}
    tables: dict[str, Any] = {
        "environment": {"gravity": 0.0},
        "body": [cart],
        "joint": [slide],
        "force": [
            {**force, "name": "spring", "stiffness": STIFFNESS},
            {**force, "name": "late", "damping": DAMPING, "delay": DELAY},
        ],
        "solver": {"end_time": 20.0, "length_scale": 0.1, "time_scale": 0.5},
        "output": {"step": 0.1},
    }
    return Scene(
        "late_damper", "a controller with a delay: a damper that acts late", tables, START, 0.5,
        "method of steps (DOP853)", late_damper,
        lambda results: np.asarray(results["bodies/cart/position"].values)[:, :1],
    )  # fmt: skip


def late_damper(time: Array) -> Array:
    """Return x (nt, 1) of m x'' + k x + c x'(t - tau) = 0, at rest before t = 0, m.

    By the method of steps: on each interval of length tau the delayed rate is known.

    Parameters
    ----------
    time : (nt,) array
        Times, s.
    """
    out = np.empty((len(time), 1))
    state, start = np.array([START, 0.0]), 0.0
    before: Any = None

    while start <= time[-1]:

        def rates(t: float, y: Array, last: Any = before) -> tuple[float, float]:
            delayed = 0.0 if last is None else float(last(t - DELAY)[1])
            return float(y[1]), float((-STIFFNESS * y[0] - DAMPING * delayed) / MASS)

        end = start + DELAY
        part = solve_ivp(rates, (start, end), state, method="DOP853", rtol=1e-11, atol=1e-12,
                         dense_output=True)  # fmt: skip
        now = (time >= start) & (time <= end)
        out[now, 0] = part.sol(time[now])[0]
        before, state, start = part.sol, part.y[:, -1], end
    return out


def _float(name: str, title: str, length: float, **how: Any) -> Scene:
    tables = water.float_tables() | {"hydro": {"radiation": "convolution", "memory_length": length}}
    return Scene(name, title, tables, 1.0, 0.5, database=_write, **how)


def _write(path: Path) -> None:
    """Write a database with the kernel RESIDUE exp(-t) on a grid of 0.05 s up to 20 s."""
    water.write(path, RESIDUE, water.ADDED_MASS)
    time = np.linspace(0.0, 20.0, 401)
    with h5py.File(path, "r+") as file:
        group = file.create_group("radiation_kernel")
        group["inputs"] = group["outputs"] = np.array([water.LABEL], dtype="S32")
        group["time"] = time
        group["kernel"] = RESIDUE * np.exp(water.POLE * time)[:, None, None]
        group["added_mass_inf"] = [[water.ADDED_MASS]]
