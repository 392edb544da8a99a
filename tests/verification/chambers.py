"""Scenes with chambers of air that several tests share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.integrate import simpson

import hydrodae

#: Plant of the reference data: area [m2], volume [m3], density [kg/m3], exponent, pressure [Pa].
AREA, VOLUME, DENSITY, EXPONENT, OUTSIDE = 13.95, 97.65, 1.25, 1.4, 101325.0
TIGHT: dict[str, Any] = {"rtol": 1e-10, "accuracy": "none"}
Motion = Callable[[float], tuple[float, float, float]]


def column(size: float) -> Motion:
    """Return rise, velocity and acceleration of the column: two harmonics that start smoothly."""

    def motion(t: float) -> tuple[float, float, float]:
        tau, g = t / 8.0, np.exp(-((t / 8.0) ** 4))
        r = 1.0 - g, 4.0 * tau**3 / 8.0 * g, (12.0 * tau**2 - 16.0 * tau**6) / 64.0 * g
        x = v = a = 0.0
        for w, part, phase in ((0.6, 1.0, 0.0), (0.93, 0.4, 0.8)):
            s, c = part * np.sin(w * t + phase), part * np.cos(w * t + phase)
            x, v, a = x + s, v + w * c, a - w * w * s
        return (
            size * r[0] * x,
            size * (r[0] * v + r[1] * x),
            size * (r[0] * a + 2.0 * r[1] * v + r[2] * x),
        )

    return motion


def plant(mass: float = 1000.0, velocity: float = 0.0, **chamber: Any) -> hydrodae.Scene:
    """Return a water column as a piston on a slide, below the chamber `air`, without gravity."""
    scene = hydrodae.Scene("a chamber")
    scene.environment(gravity=0.0, air_density=DENSITY)
    add_column(scene, "column", mass, velocity)
    scene.chamber("air", **{"volume": VOLUME, **chamber})
    scene.piston("water", chamber="air", joint="column", area=AREA)
    return scene


def add_column(
    scene: hydrodae.Scene,
    name: str,
    mass: float = 1000.0,
    velocity: float = 0.0,
    carrier: str = "ground",
) -> None:
    """Add a body on a vertical slide of the same name."""
    start: Any = {"velocity": [0.0, 0.0, velocity]} if velocity else {}
    scene.body(name, motion="heave", mass=mass, center_of_gravity=[0.0, 0.0, 0.0], initial=start)
    point, axis = [0.0, 0.0, 0.0], [0.0, 0.0, 1.0]
    scene.joint.prismatic(name, body_a=carrier, body_b=name, point=point, axis=axis)


def drive(scene: hydrodae.Scene, name: str = "column", **given: Any) -> None:
    """Let a column follow a drive with these keys, by default a function of Python."""
    keys: Any = given or {"python": True}
    scene.constraint.coordinate(f"drives_{name}", joint=name, drive=keys)


def integral(run: Any, values: np.ndarray) -> float:
    """Return the integral over the time of a run, whose samples are equally far apart."""
    return float(simpson(values, x=run.time))


def run_driven(scene: hydrodae.Scene, motion: Motion, end: float, **solver: Any) -> Any:
    """Return the results where the column moves as given."""
    drive(scene)
    scene.solver(end_time=end, **{**TIGHT, **solver})
    return hydrodae.run(scene, drives={"drives_column": motion})
