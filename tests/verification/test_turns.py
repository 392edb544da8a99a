"""Springs on rotation vectors beyond half a turn against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.verification.blocks import METHODS, run_text

import hydrodae
from hydrodae.errors import SolverError

INERTIA, STIFF = 2.0, 8.0  # of the torsional oscillator: 2 rad/s
OMEGA = math.sqrt(STIFF / INERTIA)
AXES = {"x": [1.0, 0.0, 0.0], "y": [0.0, 1.0, 0.0], "z": [0.0, 0.0, 1.0], "skew": [2.0, -3.0, 6.0]}
KINDS = ["mooring_matrix", "bushing", "pto_rotary"]


def spring(kind: str, axis: np.ndarray, ends: tuple[str, str] = ("ground", "wheel")) -> str:
    """A torsion spring about one axis, by any of the elements."""
    k = np.zeros((6, 6))
    k[3:, 3:] = STIFF * np.outer(axis, axis)
    between = f'body_a = "{ends[0]}"\nbody_b = "{ends[1]}"\n'
    keys = {
        "mooring_matrix": f'body = "wheel"\nstiffness = {k.tolist()}\n',
        "bushing": f"{between}point = [0, 0, 0]\nstiffness = {k.tolist()}\n",
        "pto_rotary": f"{between}axis = {axis.tolist()}\nstiffness = [0, 0, {STIFF}]\n",
    }
    return f'[[force]]\ntype = "{kind}"\nname = "spring"\n{keys[kind]}'


def wheel(
    spin: np.ndarray, motion: str = '"rigid"', name: str = "wheel", inertia: float = INERTIA
) -> str:
    return (
        f'[[body]]\nname = "{name}"\nmotion = {motion}\nmass = 1.0\n'
        f"center_of_gravity = [0, 0, 0]\ninertia = {[inertia] * 3}\n"
        f"initial = {{ angular_velocity = {spin.tolist()} }}\n"
    )


def oscillator(kind: str, axis: np.ndarray, amplitude: float, motion: str = '"rigid"') -> str:
    still = "[environment]\ngravity = 0.0\n"
    return still + wheel(amplitude * OMEGA * axis, motion) + spring(kind, axis)


def turned(run: hydrodae.Results, axis: np.ndarray, body: str = "wheel") -> np.ndarray:
    return np.asarray(run[f"bodies/{body}/rotation"].values @ axis)


@pytest.mark.parametrize("where", AXES)
@pytest.mark.parametrize("kind", KINDS)
def test_a_free_body_swings_by_six_radians(kind: str, where: str) -> None:
    """I a'' = -k a from a = 0: a = A sin(w t), about any axis, as with one free rotation."""
    axis = np.array(AXES[where]) / np.linalg.norm(AXES[where])
    run = run_text(oscillator(kind, axis, 6.0), 10.0)
    exact = 6.0 * np.sin(OMEGA * run.time)
    assert np.abs(turned(run, axis) - exact).max() < 1e-5
    assert run["energy/potential"].values == pytest.approx(0.5 * STIFF * exact**2, abs=1e-4 * STIFF)
    assert np.abs(np.cross(run["bodies/wheel/rotation"].values, axis)).max() < 1e-9
    if where != "skew":
        one = {"x": "roll", "y": "pitch", "z": "yaw"}[where]
        same = run_text(oscillator(kind, axis, 6.0, f'["{one}"]'), 10.0)
        assert np.abs(turned(same, axis) - exact).max() < 1e-5


@pytest.mark.parametrize("method", [*METHODS, "generalized_alpha", "gauss"])
@pytest.mark.parametrize("kind", KINDS)
def test_springs_wind_up_by_many_turns(kind: str, method: str) -> None:
    """Three turns to each side, by every method."""
    axis, amplitude = np.array(AXES["skew"]) / 7.0, 20.0
    extra = "" if method in METHODS else "step = 0.002"
    text = oscillator(kind, axis, amplitude) + f"[solver]\nend_time = 4.0\n{extra}\n"
    text += f'method = "{method}"\nrtol = 1e-9\n[output]\nstep = 0.01\n'
    run = hydrodae.run(hydrodae.Case.from_text(text))
    exact = amplitude * np.sin(OMEGA * run.time)
    assert np.abs(turned(run, axis) - exact).max() < (1e-4 if not extra else 1e-2)


@pytest.mark.parametrize("kind", ["bushing", "pto_rotary"])
def test_two_free_bodies_wind_up_a_spring_between_them(kind: str) -> None:
    """Both turn from rest against each other: a'' = -k a (1 / I + 1 / J); their sum is free."""
    axis, other = np.array(AXES["skew"]) / 7.0, 3.0
    omega = math.sqrt(STIFF * (1.0 / INERTIA + 1.0 / other))
    bodies = wheel(10.0 * omega * axis) + wheel(0.0 * axis, name="drum", inertia=other)
    text = "[environment]\ngravity = 0.0\n" + bodies + spring(kind, axis, ("drum", "wheel"))
    run = run_text(text, 5.0)
    along = [0.0, 0.0, 1.0] if kind == "pto_rotary" else axis  # in the axes of its marker
    twist = run["forces/spring/rotation"].values @ along
    assert twist == pytest.approx(10.0 * np.sin(omega * run.time), abs=1e-4)
    both = INERTIA * turned(run, axis) + other * turned(run, axis, "drum")
    assert both == pytest.approx(INERTIA * 10.0 * omega * run.time, abs=1e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_a_hinged_body_counts_its_turns(kind: str) -> None:
    """The axis is that of the hinge, which the solver meets to its tolerance."""
    axis = np.array(AXES["skew"]) / 7.0
    hinge = (
        '[[joint]]\nname = "hinge"\ntype = "revolute"\nbody_a = "ground"\nbody_b = "wheel"\n'
        f"point = [0, 0, 0]\naxis = {axis.tolist()}\n"
    )
    run = run_text(oscillator(kind, axis, 20.0) + hinge, 10.0, method="ida", rtol=1e-6)
    angle = np.asarray(run["joints/hinge/angle"].values)
    assert np.abs(angle - 20.0 * np.sin(OMEGA * run.time)).max() < 0.05
    assert turned(run, axis) == pytest.approx(angle, abs=1e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_a_run_goes_on_from_a_state_beyond_half_a_turn(kind: str) -> None:
    axis = np.array(AXES["skew"]) / 7.0
    text = oscillator(kind, axis, 10.0) + "[solver]\nend_time = 3.0\n"
    simulation = hydrodae.Simulation(hydrodae.Case.from_text(text))

    def until(time: float) -> np.ndarray:
        while simulation.time < time:
            simulation.advance(time)
        return np.asarray(simulation.read("bodies/wheel/rotation"))

    assert until(0.7) @ axis > math.pi
    state = simulation.state()
    first = until(2.0)
    simulation.restore(state)
    assert np.array_equal(first, until(2.0))
    assert first @ axis == pytest.approx(10.0 * math.sin(OMEGA * 2.0), abs=1e-2)


@pytest.mark.parametrize("kind", KINDS)
def test_a_tumbling_body_ends_the_run_at_half_a_turn(kind: str) -> None:
    """Without an axis of its own the spring has no meaning there, and the run says so."""
    axis = np.array(AXES["z"])
    text = "[environment]\ngravity = 0.0\n" + wheel(np.array([1.0, 0.0, 12.0]))
    with pytest.raises(SolverError, match=f"{kind} 'spring'.*has no meaning") as found:
        run_text(text + spring(kind, axis), 10.0)
    assert "body 'wheel' has turned" in str(found.value)
    assert (found.value.reason, found.value.subject) == ("range", "forces/spring")
    angle = 6.0 * math.sin(OMEGA * found.value.time)
    assert math.pi - 0.02 < angle < 3.6


def test_a_tumbling_body_with_dampers_alone_goes_on() -> None:
    """A ball joint that is damped follows no rotation vector."""
    damper = (
        '[[force]]\ntype = "pto_rotary"\nname = "damper"\nbody_a = "ground"\nbody_b = "wheel"\n'
        "damping = [0.5, 0.5, 0.5]\n"
    )
    text = "[environment]\ngravity = 0.0\n" + wheel(np.array([1.0, 0.0, 12.0]))
    run = run_text(text + damper, 5.0)
    spin = np.linalg.norm(run["bodies/wheel/angular_velocity"].values, axis=1)
    assert spin == pytest.approx(math.sqrt(145.0) * np.exp(-0.25 * run.time), rel=1e-6)
