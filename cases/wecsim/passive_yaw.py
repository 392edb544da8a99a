"""A body that is free in yaw in a regular wave: its equation of motion, without the kernel."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
from of_case import (  # type: ignore[import-not-found] # stands beside this file
    NoFigure,
    database_of,
    tables_of,
)
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline


def mean_yaw(case: Path, periods: int) -> float:
    """Mean yaw over the last periods of the wave [deg].

    (I + A) psi'' + (B + C) psi' = r(t) Re(a F(heading - psi) e^(iwt)), with A, B and F of the
    wave's frequency, a cubic spline of F over the headings, and the ramp r of `sea.ramp`.
    """
    tables, database = tables_of(case), database_of(case)
    wave, body = tables["wave"][0], next(b for b in tables["body"] if b.get("motion") != "fixed")
    if wave["type"] != "regular":
        raise NoFigure("no regular wave")
    omega, heading = 2.0 * math.pi / wave["period"], math.radians(wave["heading_deg"])
    label = database.index(f"{body['name']}.yaw")[0]

    def at(table: np.ndarray) -> np.ndarray:
        k = int(np.searchsorted(database.omega, omega))
        low, high = database.omega[k - 1 : k + 1]
        return np.asarray(table[k - 1] + (omega - low) / (high - low) * (table[k] - table[k - 1]))

    force = CubicSpline(database.heading, at(database.excitation[:, :, label]), bc_type="periodic")
    inertia = body["inertia"][2] + float(at(database.added_mass[:, label, label]))
    loss = float(at(database.radiation_damping[:, label, label]))
    loss += sum(item.get("damping", 0.0) for item in tables["force"])
    amplitude, end = 0.5 * wave["height"], tables["solver"]["end_time"]

    def rates(t: float, y: np.ndarray) -> list[float]:
        x = min(t / tables["sea"]["ramp"], 1.0)
        ramp = x**4 * (35.0 - 84.0 * x + 70.0 * x**2 - 20.0 * x**3)
        moment = amplitude * (force(heading - y[0]) * np.exp(1j * omega * t)).real
        return [y[1], (ramp * moment - loss * y[1]) / inertia]

    times = np.linspace(end - periods * wave["period"], end, 100 * periods + 1)[:-1]
    found = solve_ivp(rates, (0.0, end), [0.0, 0.0], "DOP853", times, rtol=1e-9, atol=1e-10)
    return float(np.degrees(found.y[0].mean()))
