"""Mechanisms that lock, nearly lock, or only seem to, over masses and lengths."""

from __future__ import annotations

import contextlib
import itertools
import math

import numpy as np
import pytest
from tests.errors import wrong

import hydrodae

MASSES = (1e-3, 1.0, 1e6)
LENGTHS = (1e-2, 1.0, 1e3)
SIZES = list(itertools.product(MASSES, MASSES, LENGTHS))


def body(name: str, mass: float, length: float, centre: tuple[float, float], motion: str) -> str:
    inertia = mass * length**2 / 12.0
    return (
        f'[[body]]\nname = "{name}"\nmotion = "{motion}"\nmass = {mass}\n'
        f"center_of_gravity = [{centre[0]}, 0.0, {centre[1]}]\n"
        f"inertia = [{inertia}, {inertia}, {inertia}]\n"
    )


def hinge(name: str, a: str, b: str, x: float, z: float) -> str:
    return (
        f'[[joint]]\nname = "{name}"\ntype = "revolute"\nbody_a = "{a}"\nbody_b = "{b}"\n'
        f"point = [{x}, 0.0, {z}]\naxis = [0, 1, 0]\n"
    )


def motor(rate: float) -> str:
    return (
        '[[constraint]]\ntype = "coordinate"\nname = "motor"\njoint = "drive"\n'
        f'level = "velocity"\ndrive = {{ constant = {rate} }}\n'
    )


def triangle(slider: float, rod: float, length: float, angle: float) -> str:
    """A mass on a vertical guide, held by a bar to the ground beside it: nothing can move."""
    z = length * math.sin(angle)
    x = length * math.cos(angle)
    return (
        body("slider", slider, length, (0.0, z), "heave")
        + body("rod", rod, length, (0.5 * x, 0.5 * z), "rigid")
        + hinge("pin", "slider", "rod", 0.0, z)
        + hinge("pivot", "ground", "rod", x, 0.0)
        + '[[force]]\ntype = "constant_load"\nname = "push"\nbody = "slider"\n'
        + f"force = [0.0, 0.0, {20.0 * (slider + rod)}]\n"
    )


def run_of(text: str, end: float, **solver: object) -> hydrodae.Results:
    lines = "".join(f"{key} = {value}\n" for key, value in solver.items())
    return hydrodae.run(
        hydrodae.Case.from_text(
            f"{text}[solver]\nend_time = {end}\n{lines}[output]\nstep = {end / 20}\n"
        )
    )


@pytest.mark.parametrize(("slider", "rod", "length"), SIZES)
def test_a_flat_triangle_is_refused_whatever_its_masses_and_lengths(
    slider: float, rod: float, length: float
) -> None:
    """Its reactions would be infinite: the load is across the bar."""
    with wrong("joint.pivot"):
        run_of(triangle(slider, rod, length, 0.0), math.sqrt(length))


@pytest.mark.parametrize(("slider", "rod", "length"), SIZES)
@pytest.mark.parametrize("misfit", [1e-8, 1e-3])
def test_a_flat_triangle_is_refused_beside_a_door_whose_hinges_are_out_of_line(
    slider: float, rod: float, length: float, misfit: float
) -> None:
    """Each mechanism is judged by itself: the door closes by least squares only."""
    door = body("door", 20.0, 2.0, (5.0, 0.0), "rigid") + "".join(
        f'[[joint]]\nname = "{name}"\ntype = "revolute"\nbody_a = "ground"\nbody_b = "door"\n'
        f"point = [{4.5 + shift}, 0.0, {z}]\naxis = [0, 0, 1]\n"
        for name, z, shift in (("upper", 1.0, 0.0), ("lower", -1.0, misfit))
    )
    with wrong("joint.pivot"):
        run_of(
            triangle(slider, rod, length, 0.0) + door,
            math.sqrt(length),
            tolerance_assembly=0.01,
        )


@pytest.mark.parametrize(("slider", "rod", "length"), SIZES)
@pytest.mark.parametrize("angle", [0.01, 0.5])
def test_a_triangle_stands_still_and_its_bar_bears_the_load(
    slider: float, rod: float, length: float, angle: float
) -> None:
    """Moments about the pivot, and what the slider takes of the load across its guide."""
    text, end = triangle(slider, rod, length, angle), math.sqrt(length)
    if angle < 0.1 and slider > 1e8 * rod:  # beyond what double precision solves: no wrong motion
        with pytest.raises(hydrodae.SolverError, match="no accelerations"):
            run_of(text, end)
        return
    run = run_of(text, end)
    for path in ("joints/pin/angle", "joints/pivot/angle"):
        assert abs(run[path].values).max() < 1e-9
    up = 20.0 * (slider + rod) - 9.81 * slider - 0.5 * 9.81 * rod
    along = up / math.tan(angle)  # force on the rod along x at the pin
    found = run["joints/pin/reaction_force"].values[-1]
    expected = math.hypot(along, 20.0 * (slider + rod) - 9.81 * slider)
    assert math.hypot(*found) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("beam", "bar", "length"), SIZES)
def test_a_beam_on_three_equal_bars_swings_as_on_two(
    beam: float, bar: float, length: float
) -> None:
    """Rows that follow from others in all poses are left out: w^2 = g (m + n/2) / (l (m + n/3))."""
    text = body("beam", beam, 2.0 * length, (0.0, -length), "rigid")
    for k, x in enumerate((-length, 0.0, length)):
        text += body(f"bar{k}", bar, length, (x, -0.5 * length), "rigid")
        text += hinge(f"top{k}", "ground", f"bar{k}", x, 0.0)
        text += hinge(f"low{k}", f"bar{k}", "beam", x, -length)
    rate = 0.01
    text = text.replace(
        'name = "top0"\ntype = "revolute"',
        f'name = "top0"\ninitial = {{ angle_rate = {rate} }}\ntype = "revolute"',
    )
    w = math.sqrt(9.81 * (beam + 1.5 * bar) / (length * (beam + bar)))
    run = run_of(text, 1.0 / w)
    largest = rate / w * math.sin(1.0)
    assert abs(run["joints/top0/angle"].values[-1]) == pytest.approx(largest, rel=1e-3)


@pytest.mark.parametrize(("heavy", "light", "length"), SIZES)
def test_a_braced_frame_stands_still(heavy: float, light: float, length: float) -> None:
    """A square of pinned bars with two diagonals, one more than it needs: w on each support."""
    corners = {"a": (0.0, 0.0), "b": (length, 0.0), "c": (length, length), "d": (0.0, length)}
    text = ""
    for bar in ("bc", "cd", "da", "ac", "bd"):
        (x0, z0), (x1, z1) = (corners[c] for c in bar)
        mass = heavy if bar == "cd" else light
        text += body(bar, mass, length, (0.5 * (x0 + x1), 0.5 * (z0 + z1)), "rigid")
    for name, bars in {
        "a": ("da", "ac"),
        "b": ("bc", "bd"),
        "c": ("bc", "cd", "ac"),
        "d": ("cd", "da", "bd"),
    }.items():
        first = "ground" if name in "ab" else bars[0]
        for other in bars if name in "ab" else bars[1:]:
            text += hinge(f"{name}_{other}", first, other, *corners[name])
    run = run_of(text, math.sqrt(length))
    for name in ("cd", "bd"):
        moved = run[f"bodies/{name}/position"].values
        assert abs(moved - moved[0]).max() < 1e-9 * length
    held = [run[f"joints/{j}/reaction_force"].values[-1] for j in ("a_da", "a_ac", "b_bc", "b_bd")]
    up = np.linalg.norm(sum(held))
    assert up == pytest.approx(9.81 * (heavy + 4.0 * light), rel=1e-6)


@pytest.mark.parametrize(("crank", "slider", "length"), SIZES)
def test_a_slider_crank_leaves_its_dead_point(crank: float, slider: float, length: float) -> None:
    """x = r cos a + sqrt(l^2 - r^2 sin^2 a), from a = 0 by one and a half turns."""
    radius, w = 0.4 * length, 3.0 / math.sqrt(length)
    text = (
        "environment.gravity = 0.0\n"
        + body("crank", crank, radius, (0.5 * radius, 0.0), "planar")
        + body("rod", 0.5 * (crank + slider), length, (radius + 0.5 * length, 0.0), "planar")
        + body("slider", slider, length, (radius + length, 0.0), "surge")
        + hinge("drive", "ground", "crank", 0.0, 0.0)
        + hinge("elbow", "crank", "rod", radius, 0.0)
        + hinge("pin", "rod", "slider", radius + length, 0.0)
        + motor(w)
    )
    run = run_of(text, 3.0 * math.pi / w)
    angle = w * run.time
    exact = radius * np.cos(angle) + np.sqrt(length**2 - (radius * np.sin(angle)) ** 2)
    assert run["bodies/slider/position"].values[:, 0] == pytest.approx(exact, abs=1e-5 * length)


def test_a_hinge_that_only_measures_does_not_drive() -> None:
    """A free lever behind a driven one starts as a struck one does: its end moves back."""
    text = (
        body("crank", 1.0, 1.0, (0.5, 0.0), "planar")
        + body("lever", 2.0, 1.0, (1.5, 0.0), "planar")
        + hinge("drive", "ground", "crank", 0.0, 0.0)
        + hinge("knee", "crank", "lever", 1.0, 0.0)
        + motor(1.0)
    )
    run = run_of(text, 0.1)
    # v of its centre and w from momentum about the knee: I w + m v l / 2 = 0, v = 1 + w l / 2.
    inertia, half = 2.0 / 12.0, 0.5
    w = -2.0 * half * 1.0 / (inertia + 2.0 * half**2)
    assert abs(run["joints/knee/angle_rate"].values[0]) == pytest.approx(abs(w - 1.0), abs=1e-6)


def test_a_load_that_sets_in_at_rest_moves_a_body() -> None:
    """Before it nothing gives the tolerance a size."""
    text = (
        "environment.gravity = 0.0\n"
        + body("block", 2.0, 1.0, (0.0, 0.0), "surge")
        + '[[joint]]\nname = "slide"\ntype = "prismatic"\nbody_a = "ground"\nbody_b = "block"\n'
        + "point = [0, 0, 0]\naxis = [1, 0, 0]\n"
        + '[[force]]\ntype = "python_load"\nname = "kick"\njoint = "slide"\n'
    )
    loads = {"auto": (1e-3, 1e3, 1e6), "ida": (1e-3, 10.0)}
    for method in ("auto", "radau", "explicit_rk", "ida"):
        for load in loads.get(method, (1e-3, 1e3)):
            case = hydrodae.Case.from_text(
                text + f'[solver]\nend_time = 79.31\nmethod = "{method}"\n[output]\nstep = 79.31\n'
            )

            def kick(t: float, s: float, v: float, load: float = load) -> float:
                return load if t > 77.31 else 0.0

            run = hydrodae.run(case, forces={"kick": kick})
            assert run["joints/slide/displacement"].values[-1] == pytest.approx(load, rel=1e-4)


@pytest.mark.parametrize(
    "method", ["gauss", "radau", "lobatto_iiic", "explicit_rk", "generalized_alpha"]
)
def test_a_first_step_that_fails_ends_the_run(method: str) -> None:
    """A top that turns by 1.5 rad in a step of 0.01 s: nothing reads a step that was not made."""
    text = (
        '[[body]]\nname = "top"\nmotion = "rigid"\nmass = 15.0\ncenter_of_gravity = [0, 1, 0]\n'
        "inertia = [0.234375, 0.46875, 0.234375]\n"
        "initial = { velocity = [4.61538, 0, 0], angular_velocity = [0, 150, -4.61538] }\n"
        '[[joint]]\nname = "ball"\ntype = "spherical"\nbody_a = "ground"\nbody_b = "top"\n'
        "point = [0, 0, 0]\n"
    )
    orders = {"generalized_alpha": [0], "explicit_rk": [5, 8], "radau": range(1, 21, 2)}
    for order in orders.get(method, range(2, 19, 2)):
        for step in (0.01, 0.2):
            with contextlib.suppress(hydrodae.SolverError):
                run_of(text, 2.0, method=f'"{method}"', step=step, order=order)
