"""Special poses: where a rotation has gone round, or a direction has no length."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, ORIGIN, body, case, position, spring
from tests.stability import Scene

from hydrodae.results import Results

KIND = "special poses"


def _draw_vector(g: np.random.Generator) -> dict[str, Any]:
    axis = g.normal(size=3) if g.integers(2) else np.eye(3)[g.integers(3)]
    return dict(
        how=("mooring_matrix", "bushing", "pto_rotary")[g.integers(3)],
        axis=tuple(float(x) for x in axis),
        amplitude=log_uniform(g, 0.1, 100.0),
        rate=log_uniform(g, 0.05, 20.0),
    )


@family(KIND, _draw_vector)
@chosen(how="mooring_matrix", axis=(0.0, 0.0, 1.0), amplitude=6.0, rate=2.0)
@chosen(how="bushing", axis=(2.0, -3.0, 6.0), amplitude=3.2, rate=0.5)
@chosen(how="pto_rotary", axis=(1.0, 0.0, 0.0), amplitude=40.0, rate=1.0)
@chosen(how="mooring_matrix", axis=(1.0, 1.0, 0.0), amplitude=20.0, rate=5.0, kind="ship")
def wound_vector(how: str, axis: tuple[float, ...], amplitude: float, rate: float) -> Scene:
    """A free body on a torsion spring about one axis, by an element that sees rotation vectors."""
    e, inertia = np.asarray(axis) / np.linalg.norm(axis), 2.0
    stiffness = np.zeros((6, 6))
    stiffness[3:, 3:] = inertia * rate**2 * np.outer(e, e)
    force: dict[str, Any] = {"type": how, "name": "spring"}
    if how == "mooring_matrix":
        force |= {"body": "wheel", "stiffness": stiffness.tolist()}
    else:
        force |= {"body_a": "ground", "body_b": "wheel"}
        force |= (
            {"point": list(ORIGIN), "stiffness": stiffness.tolist()}
            if how == "bushing"
            else {"axis": e.tolist(), "stiffness": [0.0, 0.0, inertia * rate**2]}
        )
    wheel = body(
        "wheel", "rigid", 1.0, inertia=[inertia] * 3, angular_velocity=amplitude * rate * e
    )

    def angle(results: Results) -> Any:
        return np.asarray(results["bodies/wheel/rotation"].values @ e)[:, None]

    tables = case([wheel], 25.0 / rate, gravity=0.0, forces=[force], samples=200)
    return unnamed(
        title=f"a rotation vector wound up by {amplitude:g} rad",
        tables=tables,
        size=amplitude,
        time_scale=1.0 / rate,
        source="closed form",
        truth=truth.column(lambda t: amplitude * np.sin(rate * t)),
        measured=angle,
        unit="rad",
    )


def _draw_place(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        speed=tuple(float(x) for x in g.normal(size=3)),
        rate=log_uniform(g, 0.1, 20.0),
        damping=float(g.choice([0.0, 0.1, 0.7])),
    )


@family(KIND, _draw_place)
@chosen(speed=(1.0, -2.0, 0.5), rate=2.0)
@chosen(speed=(0.0, 0.0, 1.0), rate=0.5, damping=0.1, kind="barge")
def spring_at_one_place(speed: tuple[float, ...], rate: float, damping: float = 0.0) -> Scene:
    """A spring without length leaves the place where its points coincide, and comes back to it."""
    mass, v = 2.0, np.asarray(speed)
    bob = body("bob", "point", mass, [1.0, 2.0, 3.0], velocity=v)
    force = spring(
        "spring",
        "ground",
        "bob",
        [1.0, 2.0, 3.0],
        [1.0, 2.0, 3.0],
        mass * rate**2,
        2.0 * damping * rate * mass,
    )
    along = truth.oscillation(rate, damping, 0.0, 1.0)
    tables = case([bob], 20.0 / rate, gravity=0.0, forces=[force], samples=150)
    return unnamed(
        title="a spring whose points coincide",
        tables=tables,
        size=float(np.linalg.norm(v)) / rate,
        time_scale=1.0 / rate,
        source="closed form",
        truth=lambda t: np.outer(np.asarray(along(t)), v),
        measured=position("bob", 0, 1, 2, origin=(1.0, 2.0, 3.0)),
    )


def _draw_fold(g: np.random.Generator) -> dict[str, Any]:
    mu = g.uniform(0.02, 0.3)
    return {"mu": mu, "ratio": float(np.exp(mu * np.pi * g.uniform(1.3, 3.0)))}


@family(KIND, _draw_fold)
@chosen(mu=0.1, ratio=2.0)
@chosen(mu=0.2, ratio=4.0, kind="ship")
def folded_rope(mu: float, ratio: float) -> Scene:
    """Masses on a rope that turns back by 180 degrees exactly: a = g (r - E) / (r + E)."""
    light, grip = 10.0, np.exp(mu * np.pi)
    fall = GRAVITY * (ratio - grip) / (ratio + grip)
    end = float(np.sqrt(2.0 * 3.0 / fall))
    tension = light * (GRAVITY + fall)
    stiffness = 1e6 * tension
    bodies = [
        body("a", "heave", light, [0.0, 0.0, 0.0]),
        body("b", "heave", ratio * light, [0.0, 0.0, 0.0]),
    ]
    rope = dict(
        type="rope",
        name="rope",
        bodies=["a", "ground", "b"],
        points=[[0.0, 0.0, 0.0], [0.0, 0.0, 10.0], [0.0, 0.0, 0.0]],
        friction=[mu],
        stiffness=stiffness,
        damping=1e-5 * stiffness,
        pretension=tension,
    )
    tables = case(bodies, end, gravity=GRAVITY, forces=[rope], samples=60)
    return unnamed(
        title=f"a rope folded over a bar with friction {mu:g}",
        tables=tables,
        size=3.0,
        time_scale=end,
        source="closed form",
        truth=truth.column(lambda t: 0.5 * fall * t**2),
        measured=position("a", 2),
    )
