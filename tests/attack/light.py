"""Little or no inertia: points on hinges, and bobs on links that weigh nothing."""

from __future__ import annotations

from typing import Any

import numpy as np
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import GRAVITY, Table, body, case, joint, position
from tests.stability import Scene, truths

KIND = "little inertia"
SOURCE = "Jacobi elliptic functions"


def _scene(
    title: str, bodies: list[Table], joints: list[Table], length: float, rate: float, angle: float
) -> Scene:
    """Return the scene of a bob at `length`, let go at `angle` of a pendulum of `rate`."""

    def place(time: Any) -> Any:
        a = truths.pendulum_angle(time, rate, angle)
        return length * np.column_stack([np.sin(a), -np.cos(a)])

    tables = case(bodies, 20.0 / rate, joints=joints)
    return unnamed(title, tables, length, 1.0 / rate, SOURCE, place, position("bob", 0, 2))


def _draw_point(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 1e-2, 1e3),
        mass=log_uniform(g, 1e-3, 1e8),
        ratio=float(g.choice([0.0, log_uniform(g, 1e-13, 1.0)])),
        angle=g.uniform(0.1, 2.5),
    )


@family(KIND, _draw_point)
@chosen(length=10.0, mass=1e5, ratio=1e-8, angle=1.0)
@chosen(length=0.2, mass=1.0, ratio=7.5e-9, angle=1.0)
@chosen(length=10.0, mass=1e5, ratio=1e-12, angle=2.0, kind="ship")
@chosen(length=1.0, mass=1.0, ratio=0.0, angle=1.5)
def point_on_hinge(length: float, mass: float, ratio: float, angle: float) -> Scene:
    """A body of moment of inertia `ratio` m L^2 that turns freely but for its hinge."""
    at = length * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    bob = body("bob", "rigid", mass, at, [ratio * mass * length**2] * 3)
    rate = float(np.sqrt(GRAVITY / length / (1.0 + ratio)))
    hinge = joint("hinge", "revolute", "ground", "bob", axis=[0.0, 1.0, 0.0])
    title = f"a body of moment of inertia {ratio:g} m L2 on a hinge"
    return _scene(title, [bob], [hinge], length, rate, angle)


def _draw_link(g: np.random.Generator) -> dict[str, Any]:
    return dict(
        length=log_uniform(g, 0.1, 100.0),
        mass=log_uniform(g, 1e-2, 1e7),
        light=float(g.choice([0.0, log_uniform(g, 1e-12, 1e-3)])),
        angle=g.uniform(0.1, 2.0),
        n_links=int(g.integers(1, 3)),
    )


@family(KIND, _draw_link)
@chosen(length=4.0, mass=500.0, light=0.0, angle=1.2, n_links=1)
@chosen(length=4.0, mass=500.0, light=1e-6, angle=1.2, n_links=1)
@chosen(length=1.0, mass=1e6, light=1e-10, angle=0.5, n_links=1, kind="rotor")
@chosen(length=2.0, mass=80.0, light=0.0, angle=0.8, n_links=2)
@chosen(length=2.0, mass=80.0, light=1e-7, angle=0.8, n_links=2)
def bob_on_links(length: float, mass: float, light: float, angle: float, n_links: int) -> Scene:
    """A bob on one uniform link of `light` times its mass, or on two that keep it upright."""
    end = length * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    inertia = [light * mass * length**2 / 12.0] * 2 + [0.0]
    bodies = [body("bob", "rigid", mass, end, [0.1 * mass * length**2] * 3)]
    joints = []
    for k in range(n_links):
        x = np.array([0.0 if n_links == 1 else 0.5 * length * (2 * k - 1), 0.0, 0.0])
        name = f"link{k + 1}"
        bodies.append(body(name, "rigid", light * mass, x + 0.5 * end, inertia))
        joints.append(joint(f"top{k + 1}", "revolute", "ground", name, x, [0.0, 1.0, 0.0]))
        if n_links == 1:
            joints.append(joint("end1", "spherical", name, "bob", x + end))
        else:
            joints.append(joint(f"end{k + 1}", "revolute", name, "bob", x + end, [0.0, 1.0, 0.0]))
    # (m + n m_l / 3) L^2 th'' = -(m + n m_l / 2) g L sin(th), the moment of each link about its top
    all_links = n_links * light
    rate = float(np.sqrt(GRAVITY / length * (1.0 + all_links / 2.0) / (1.0 + all_links / 3.0)))
    title = f"a bob on {n_links} link of {light:g} of its mass"
    return _scene(title, bodies, joints, length, rate, angle)
