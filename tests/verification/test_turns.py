"""Springs on rotation vectors beyond half a turn; test_families winds them up by many turns."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import ORIGIN, Table, body, case, joint
from tests.verification.blocks import case_of, run_tables

import hydrodae
from hydrodae.errors import SolverError

INERTIA, STIFF = 2.0, 8.0  # of the torsional oscillator: 2 rad/s
OMEGA = math.sqrt(STIFF / INERTIA)
AXES = {"x": [1.0, 0.0, 0.0], "y": [0.0, 1.0, 0.0], "z": [0.0, 0.0, 1.0], "skew": [2.0, -3.0, 6.0]}
KINDS = ["mooring_matrix", "bushing", "pto_rotary"]
SKEW = np.array(AXES["skew"]) / 7.0
TIGHT: dict[str, Any] = {"method": "radau", "rtol": 1e-9}


def spring(kind: str, axis: np.ndarray, ends: tuple[str, str] = ("ground", "wheel")) -> Table:
    """A torsion spring about one axis, by any of the elements."""
    k = np.zeros((6, 6))
    k[3:, 3:] = STIFF * np.outer(axis, axis)
    keys: dict[str, Table] = {
        "mooring_matrix": {"body": "wheel", "stiffness": k.tolist()},
        "bushing": {"point": list(ORIGIN), "stiffness": k.tolist()},
        "pto_rotary": {"axis": axis.tolist(), "stiffness": [0, 0, STIFF]},
    }
    between = {} if kind == "mooring_matrix" else {"body_a": ends[0], "body_b": ends[1]}
    return {"type": kind, "name": "spring", **between, **keys[kind]}


def wheel(spin: Any, motion: Any = "rigid", name: str = "wheel", inertia: float = INERTIA) -> Table:
    return body(name, motion, 1.0, inertia=[inertia] * 3, angular_velocity=spin)


def free(end: float, *forces: Table, bodies: list[Table], **more: Any) -> Table:
    return case(bodies, end, gravity=0.0, forces=forces, output={"step": 0.01}, **more)


def oscillator(kind: str, axis: np.ndarray, amplitude: float, end: float, **more: Any) -> Table:
    motion = more.pop("motion", "rigid")
    bodies = [wheel(amplitude * OMEGA * axis, motion)]
    return free(end, spring(kind, axis), bodies=bodies, **more)


def turned(run: hydrodae.Results, axis: np.ndarray, body: str = "wheel") -> np.ndarray:
    return np.asarray(run[f"bodies/{body}/rotation"].values @ axis)


@pytest.mark.parametrize("where", AXES)
@pytest.mark.parametrize("kind", KINDS)
def test_a_free_body_swings_by_six_radians(kind: str, where: str) -> None:
    """I a'' = -k a from a = 0: a = A sin(w t), about any axis, as with one free rotation."""
    axis = np.array(AXES[where]) / np.linalg.norm(AXES[where])
    run = run_tables(oscillator(kind, axis, 6.0, 10.0), **TIGHT)
    exact = 6.0 * np.sin(OMEGA * run.time)
    assert np.abs(turned(run, axis) - exact).max() < 1e-5
    assert run["energy/potential"].values == pytest.approx(0.5 * STIFF * exact**2, abs=1e-4 * STIFF)
    assert np.abs(np.cross(run["bodies/wheel/rotation"].values, axis)).max() < 1e-9
    if where != "skew":
        one = {"x": "roll", "y": "pitch", "z": "yaw"}[where]
        same = run_tables(oscillator(kind, axis, 6.0, 10.0, motion=[one]), **TIGHT)
        assert np.abs(turned(same, axis) - exact).max() < 1e-5


@pytest.mark.parametrize("kind", ["bushing", "pto_rotary"])
def test_two_free_bodies_wind_up_a_spring_between_them(kind: str) -> None:
    """Both turn from rest against each other: a'' = -k a (1 / I + 1 / J); their sum is free."""
    axis, other = SKEW, 3.0
    omega = math.sqrt(STIFF * (1.0 / INERTIA + 1.0 / other))
    bodies = [wheel(10.0 * omega * axis), wheel(0.0 * axis, name="drum", inertia=other)]
    tables = free(5.0, spring(kind, axis, ("drum", "wheel")), bodies=bodies)
    run = run_tables(tables, **TIGHT)
    along = [0.0, 0.0, 1.0] if kind == "pto_rotary" else axis  # in the axes of its marker
    twist = run["forces/spring/rotation"].values @ along
    assert twist == pytest.approx(10.0 * np.sin(omega * run.time), abs=1e-4)
    both = INERTIA * turned(run, axis) + other * turned(run, axis, "drum")
    assert both == pytest.approx(INERTIA * 10.0 * omega * run.time, abs=1e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_a_hinged_body_counts_its_turns(kind: str) -> None:
    """The axis is that of the hinge, which the solver meets to its tolerance."""
    axis = SKEW
    hinge = [joint("hinge", "revolute", "ground", "wheel", axis=axis)]
    tables = oscillator(kind, axis, 20.0, 10.0, joints=hinge)
    run = run_tables(tables, method="ida", rtol=1e-6)
    angle = np.asarray(run["joints/hinge/angle"].values)
    assert np.abs(angle - 20.0 * np.sin(OMEGA * run.time)).max() < 0.05
    assert turned(run, axis) == pytest.approx(angle, abs=1e-3)


@pytest.mark.parametrize("kind", KINDS)
def test_a_run_goes_on_from_a_state_beyond_half_a_turn(kind: str) -> None:
    axis = SKEW
    simulation = hydrodae.Simulation(case_of(oscillator(kind, axis, 10.0, 3.0)))

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
    bodies = [wheel([1.0, 0.0, 12.0])]
    tables = free(10.0, spring(kind, np.array(AXES["z"])), bodies=bodies)
    with pytest.raises(SolverError, match=f"{kind} 'spring'.*has no meaning") as found:
        run_tables(tables, **TIGHT)
    assert "body 'wheel' has turned" in str(found.value)
    assert (found.value.reason, found.value.subject) == ("range", "forces/spring")
    angle = 6.0 * math.sin(OMEGA * found.value.time)
    assert math.pi - 0.02 < angle < 3.6


def test_a_tumbling_body_with_dampers_alone_goes_on() -> None:
    """A ball joint that is damped follows no rotation vector."""
    damper: Table = {"type": "pto_rotary", "name": "damper", "damping": [0.5, 0.5, 0.5]}
    damper |= {"body_a": "ground", "body_b": "wheel"}
    run = run_tables(free(5.0, damper, bodies=[wheel([1.0, 0.0, 12.0])]), **TIGHT)
    spin = np.linalg.norm(run["bodies/wheel/angular_velocity"].values, axis=1)
    assert spin == pytest.approx(math.sqrt(145.0) * np.exp(-0.25 * run.time), rel=1e-6)
