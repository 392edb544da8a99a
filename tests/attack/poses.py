"""Special poses: where a rotation has gone round, or a direction has no length."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack import truth
from tests.attack.family import family, log_uniform, neighbour
from tests.attack.parts import GRAVITY, ORIGIN, beside, body, case, position, spring

from hydrodae.results import Results
from hydrodae.study.stability import Scene

KIND = "special poses"


def _draw_vector(g: np.random.Generator) -> dict[str, Any]:
    axis = g.normal(size=3) if g.integers(2) else np.eye(3)[g.integers(3)]
    return {
        "how": ("mooring_matrix", "bushing", "pto_rotary")[g.integers(3)],
        "axis": tuple(float(x) for x in axis), "amplitude": log_uniform(g, 0.1, 100.0),
        "rate": log_uniform(g, 0.05, 20.0), "kind": neighbour(g),
    }  # fmt: skip


@family(
    KIND, _draw_vector,
    {"how": "mooring_matrix", "axis": (0.0, 0.0, 1.0), "amplitude": 6.0, "rate": 2.0},
    {"how": "bushing", "axis": (2.0, -3.0, 6.0), "amplitude": 3.2, "rate": 0.5},
    {"how": "pto_rotary", "axis": (1.0, 0.0, 0.0), "amplitude": 40.0, "rate": 1.0},
    {"how": "mooring_matrix", "axis": (1.0, 1.0, 0.0), "amplitude": 20.0, "rate": 5.0,
     "kind": "ship"},
)  # fmt: skip
def wound_vector(
    how: str, axis: tuple[float, ...], amplitude: float, rate: float, kind: str | None = None
) -> Scene:
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
            {"point": list(ORIGIN), "stiffness": stiffness.tolist()} if how == "bushing"
            else {"axis": e.tolist(), "stiffness": [0.0, 0.0, inertia * rate**2]}
        )  # fmt: skip
    wheel = body("wheel", "rigid", 1.0, inertia=[inertia] * 3,
                 angular_velocity=amplitude * rate * e)  # fmt: skip

    def angle(results: Results) -> Any:
        return np.asarray(results["bodies/wheel/rotation"].values @ e)[:, None]

    tables = case([wheel], 25.0 / rate, gravity=0.0, forces=[force], samples=200)
    scene = Scene(
        "", f"a rotation vector wound up by {amplitude:g} rad", tables, amplitude, 1.0 / rate,
        "closed form", truth.column(lambda t: amplitude * np.sin(rate * t)), angle, unit="rad",
    )  # fmt: skip
    return beside(scene, kind)


def _draw_place(g: np.random.Generator) -> dict[str, Any]:
    return {
        "speed": tuple(float(x) for x in g.normal(size=3)), "rate": log_uniform(g, 0.1, 20.0),
        "damping": float(g.choice([0.0, 0.1, 0.7])), "kind": neighbour(g),
    }  # fmt: skip


@family(
    KIND, _draw_place,
    {"speed": (1.0, -2.0, 0.5), "rate": 2.0},
    {"speed": (0.0, 0.0, 1.0), "rate": 0.5, "damping": 0.1, "kind": "barge"},
)  # fmt: skip
def spring_at_one_place(
    speed: tuple[float, ...], rate: float, damping: float = 0.0, kind: str | None = None
) -> Scene:
    """A spring without length leaves the place where its points coincide, and comes back to it."""
    mass, v = 2.0, np.asarray(speed)
    bob = body("bob", "point", mass, [1.0, 2.0, 3.0], velocity=v)
    force = spring("spring", "ground", "bob", [1.0, 2.0, 3.0], [1.0, 2.0, 3.0], mass * rate**2,
                   2.0 * damping * rate * mass)  # fmt: skip
    along = truth.oscillation(rate, damping, 0.0, 1.0)
    tables = case([bob], 20.0 / rate, gravity=0.0, forces=[force], samples=150)
    scene = Scene(
        "", "a spring whose points coincide", tables, float(np.linalg.norm(v)) / rate, 1.0 / rate,
        "closed form", lambda t: np.outer(np.asarray(along(t)), v),
        position("bob", 0, 1, 2, origin=(1.0, 2.0, 3.0)),
    )  # fmt: skip
    return beside(scene, kind)


def _draw_fold(g: np.random.Generator) -> dict[str, Any]:
    mu = g.uniform(0.02, 0.3)
    return {
        "mu": mu,
        "ratio": float(np.exp(mu * np.pi * g.uniform(1.3, 3.0))),
        "kind": neighbour(g),
    }


@family(KIND, _draw_fold, {"mu": 0.1, "ratio": 2.0}, {"mu": 0.2, "ratio": 4.0, "kind": "ship"})
def folded_rope(mu: float, ratio: float, kind: str | None = None) -> Scene:
    """Masses on a rope that turns back by 180 degrees exactly: a = g (r - E) / (r + E)."""
    light, grip = 10.0, np.exp(mu * np.pi)
    fall = GRAVITY * (ratio - grip) / (ratio + grip)
    end = float(np.sqrt(2.0 * 3.0 / fall))
    tension = light * (GRAVITY + fall)
    stiffness = 1e6 * tension
    bodies = [body("a", "heave", light, [0.0, 0.0, 0.0]),
              body("b", "heave", ratio * light, [0.0, 0.0, 0.0])]  # fmt: skip
    rope = {
        "type": "rope", "name": "rope", "bodies": ["a", "ground", "b"],
        "points": [[0.0, 0.0, 0.0], [0.0, 0.0, 10.0], [0.0, 0.0, 0.0]], "friction": [mu],
        "stiffness": stiffness, "damping": 1e-5 * stiffness, "pretension": tension,
    }  # fmt: skip
    tables = case(bodies, end, gravity=GRAVITY, forces=[rope], samples=60)
    scene = Scene(
        "", f"a rope folded over a bar with friction {mu:g}", tables, 3.0, end, "closed form",
        truth.column(lambda t: 0.5 * fall * t**2), position("a", 2),
    )  # fmt: skip
    return beside(scene, kind)
