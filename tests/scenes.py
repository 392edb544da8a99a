"""Scenes that several tests share: masses on a guide, a bouncing ball, a ball in dampers."""

from __future__ import annotations

import runpy
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

AXES = {"surge": [1.0, 0.0, 0.0], "heave": [0.0, 0.0, 1.0]}
ORIGIN = [0.0, 0.0, 0.0]


def toml(value: Any) -> str:
    """Return a value as TOML writes it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f'"{value}"'
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{k} = {toml(v)}" for k, v in value.items()) + " }"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(toml, value)) + "]"
    return repr(float(value)) if isinstance(value, float) else repr(value)


def four_bar_windows(count: int) -> str:
    """Return the case of a chain of so many four-bar windows."""
    writer = Path(__file__).resolve().parents[1] / "cases" / "benchmarks" / "four_bar.py"
    return str(runpy.run_path(str(writer))["four_bar"](count))


def table(kind: str, **keys: Any) -> str:
    """Return a table [[kind]] with these keys; those that are None are left out."""
    lines = [f"{key} = {toml(value)}\n" for key, value in keys.items() if value is not None]
    return f"[[{kind}]]\n" + "".join(lines)


def run_for(end_time: float, step: float, **keys: Any) -> str:
    """Return [solver] with these keys, and [output]."""
    solver = table("solver", end_time=end_time, **keys).replace("[[solver]]", "[solver]")
    return f"{solver}[output]\nstep = {step!r}\n"


def slide(
    body: str = "cart",
    *,
    joint: str = "slide",
    mass: float = 2.0,
    motion: str | Sequence[str] = "surge",
    axis: Sequence[float] = AXES["surge"],
    at: Sequence[float] = ORIGIN,
    point: Sequence[float] | None = None,
    inertia: Sequence[float] | None = None,
    gravity: float | None = 0.0,
    title: str = "",
    **initial: Any,
) -> str:
    """Return a body on a straight guide; further keywords are those of its start.

    `at` is its centre of gravity and, where `point` is not given, the point of the guide.
    The last table is the joint, and nothing follows it: more keys and tables can be appended.
    """
    head = f'title = "{title}"\n' if title else ""
    if gravity is not None:
        head += f"environment.gravity = {gravity!r}\n"
    mover = table(
        "body",
        name=body,
        motion=motion,
        mass=mass,
        center_of_gravity=at,
        inertia=inertia,
        initial=initial or None,
    )
    guide = table(
        "joint",
        name=joint,
        type="prismatic",
        body_a="ground",
        body_b=body,
        point=at if point is None else point,
        axis=axis,
    )
    return head + mover + guide


def pendulum(
    body: str,
    *,
    mass: float,
    at: Sequence[float],
    inertia: Sequence[float],
    motion: str = "planar",
    **initial: Any,
) -> str:
    """Return a body that hangs in `hinge`, about y through the origin.

    Further keywords are those of the start of the hinge, which is the last table.
    """
    bar = table("body", name=body, motion=motion, mass=mass, center_of_gravity=at, inertia=inertia)
    hinge = table(
        "joint",
        name="hinge",
        type="revolute",
        body_a="ground",
        body_b=body,
        point=ORIGIN,
        axis=[0.0, 1.0, 0.0],
        initial=initial or None,
    )
    return bar + hinge


def driven(
    body: str, coordinate: str, mass: float, at: Sequence[float] = ORIGIN, **drive: Any
) -> str:
    """Return a body whose one coordinate follows a drive with these keys."""
    mover = table("body", name=body, motion=[coordinate], mass=mass, center_of_gravity=at)
    return mover + table(
        "constraint", name="moves", type="coordinate", body=body, coordinate=coordinate, drive=drive
    )


def cart(
    pto: str,
    *,
    title: str = "Cart on a spring",
    body: str = "cart",
    mass: float = 2.0,
    motion: str = "surge",
    initial: Mapping[str, Any] | None = None,
    joint: str = "slide",
    name: str = "pto",
    more: str = "",
    solver: str = "end_time = 5.0\nrtol = 1e-9",
    step: float = 0.05,
) -> str:
    """Return a mass on a guide with a power take-off.

    `pto` are its keys, `name` its name, `more` further tables.
    """
    start = {"displacement": [0.5, 0.0, 0.0]} if initial is None else initial
    axis = AXES[motion]
    mover = slide(body, joint=joint, mass=mass, motion=motion, axis=axis, title=title, **start)
    machine = table("force", name=name, type="pto_linear", joint=joint)
    return f"{mover}{machine}{pto}\n{more}\n[solver]\n{solver}\n[output]\nstep = {step}\n"


def controlled_cart(
    type: str, keys: str = "", inputs: str = '"joints/slide/displacement_rate"', period: float = 0.1
) -> str:
    """Return a mass on a spring whose take-off `pto` a controller `pi` of this type loads."""
    return (
        slide(title="Cart on a spring", displacement=[0.5, 0.0, 0.0])
        + table("force", name="spring", type="pto_linear", joint="slide", stiffness=8.0)
        + table("force", name="pto", type="pto_general", joint="slide")
        + table("controller", name="pi", type=type)
        + f'inputs = [{inputs}]\noutputs = ["forces/pto/load"]\nperiod = {period}\n{keys}\n'
        + run_for(5.0, 0.05, method="radau", rtol=1e-9)
    )


def bouncing_ball(restitution: float, title: str = "") -> str:
    """Return a ball of 2 kg that falls 1 m onto a floor."""
    guide = slide(
        "ball",
        joint="guide",
        motion="heave",
        axis=AXES["heave"],
        at=[0.0, 0.0, 1.0],
        gravity=None,
        title=title,
    )
    floor = table(
        "constraint", name="floor", type="stop", joint="guide", lower=-1.0, restitution=restitution
    )
    return guide + floor


def damped_ball(damping: str) -> str:
    """Return a ball of 2 kg m2 that turns slowly about y in a rotary take-off; `damping`: its keys.

    The end of the text is the take-off.
    """
    ball = table(
        "body",
        name="ball",
        mass=1.0,
        inertia=[2.0, 2.0, 2.0],
        center_of_gravity=ORIGIN,
        initial={"angular_velocity": [0.0, 0.3, 0.0]},
    )
    joint = table(
        "joint", name="ball", type="spherical", body_a="ground", body_b="ball", point=ORIGIN
    )
    pto = table("force", type="pto_rotary", name="pto", body_a="ground", body_b="ball")
    return f"environment.gravity = 0.0\n{ball}{joint}{pto}{damping}\n"
