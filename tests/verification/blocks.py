"""A block on a slide, and point masses that heave: what the laws of forces are tried on."""

from __future__ import annotations

import numpy as np
from tests.scenes import slide

import hydrodae

METHODS = ["ida", "radau", "explicit_rk"]
G = 9.81


def on_a_slide(mass: float = 2.0, start: float = 0.0, speed: float = 0.0) -> str:
    """Return a block on a slide."""
    return slide("block", mass=mass, displacement=[start, 0.0, 0.0], velocity=[speed, 0.0, 0.0])


def block(
    forces: str,
    end: float,
    *,
    mass: float = 2.0,
    start: float = 0.0,
    speed: float = 0.0,
    method: str = "radau",
    rtol: float = 1e-8,
    step: float = 0.01,
    extra: str = "",
) -> hydrodae.Results:
    """Run a block on a slide under these forces."""
    text = on_a_slide(mass, start, speed)
    text += forces + f'[solver]\nend_time = {end}\nmethod = "{method}"\nrtol = {rtol}\n{extra}\n'
    return hydrodae.run(hydrodae.Case.from_text(text + f"[output]\nstep = {step}\n"))


def heaving(masses: dict[str, tuple[float, tuple[float, float, float]]]) -> str:
    """Point masses that can only heave."""
    out = f"[environment]\ngravity = {G}\n"
    for name, (mass, place) in masses.items():
        out += f'[[body]]\nname = "{name}"\nmotion = "heave"\nmass = {mass}\n'
        out += f"center_of_gravity = {list(place)}\n"
    return out


def run_text(
    text: str, end: float, *, method: str = "radau", rtol: float = 1e-9, step: float = 0.01
) -> hydrodae.Results:
    """Run a case of this text."""
    text += (
        f'[solver]\nend_time = {end}\nmethod = "{method}"\nrtol = {rtol}\n[output]\nstep = {step}\n'
    )
    return hydrodae.run(hydrodae.Case.from_text(text))


def height_of(run: hydrodae.Results, body: str) -> np.ndarray:
    """How far a body has risen."""
    z = np.asarray(run[f"bodies/{body}/position"].values[:, 2], dtype=float)
    return z - float(z[0])
