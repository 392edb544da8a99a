"""Loads that depend on the past are as exact as the steps: the error falls with the tolerance.

A late damper and spring against the method of steps, radiation by convolution against the equations
whose kernel is the same exponential. Both by DOP853 at 1e-12.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import h5py
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from tests.scenes import run_for, slide, table
from tests.stability import water

import hydrodae
from hydrodae.support.arrays import Array

MASS, STIFFNESS, DAMPING, LATE, DELAY, END = 1000.0, 4000.0, 400.0, 1500.0, 5.0, 40.0
EXACT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}


def cart(start: float, speed: float, delay: float = DELAY) -> hydrodae.Case:
    title = "Cart on a spring, with a damper and a spring that act late"
    late = {"stiffness": LATE, "damping": DAMPING, "delay": delay}
    text = (
        slide(mass=MASS, title=title, displacement=[start, 0.0, 0.0], velocity=[speed, 0.0, 0.0])
        + table("force", type="pto_linear", name="spring", joint="slide", stiffness=STIFFNESS)
        + table("force", type="pto_linear", name="late", joint="slide", **late)
        + run_for(END, 0.1, length_scale=1.0, time_scale=0.5)
    )
    return hydrodae.Case.from_text(text)


def method_of_steps(time: Array, start: float, speed: float, delay: float = DELAY) -> Array:
    """x of m x'' + k x + k_l x(t - tau) + c x'(t - tau) = 0; x = start, at rest before t = 0."""
    out = np.empty_like(time)
    state, begin = np.array([start, speed]), 0.0
    before: Callable[[float], Array] = lambda _t: np.array([start, 0.0])  # noqa: E731
    while begin < time[-1]:

        def rates(t: float, y: Array, past: Callable[[float], Array] = before) -> list[float]:
            then = past(t - delay)
            return [y[1], -(STIFFNESS * y[0] + LATE * then[0] + DAMPING * then[1]) / MASS]

        part = solve_ivp(
            rates, (begin, begin + delay), state, dense_output=True, max_step=0.05, **EXACT
        )
        here = (time >= begin - 1e-9) & (time <= begin + delay + 1e-9)
        out[here] = part.sol(time[here])[0]
        before, state, begin = part.sol, part.y[:, -1], begin + delay
    return out


def settings(method: str, rtol: float) -> dict[str, object]:
    return {"solver.method": method, "solver.rtol": rtol}


@pytest.mark.parametrize("method", ["explicit_rk", "radau", "ida"])
@pytest.mark.parametrize(("start", "speed"), [(1.0, 0.0), (0.0, 2.0)])
def test_error_of_a_delay_falls_with_the_tolerance(method: str, start: float, speed: float) -> None:
    """From rest the second derivative of the past jumps, from a push the rate."""
    case = cart(start, speed)
    for rtol in (1e-4, 1e-6, 1e-8):
        results = hydrodae.run(case, set=settings(method, rtol))
        exact = method_of_steps(results.time, start, speed)
        error = np.abs(results["joints/slide/displacement"].values - exact).max()
        assert error <= 50.0 * rtol * np.abs(exact).max()


@pytest.mark.parametrize("delay", [0.7, 5.0])
def test_a_delay_fails_no_steps(delay: float) -> None:
    """Steps end where the past is not smooth: none is tried over it again and again."""
    results = hydrodae.run(cart(0.0, 2.0, delay), set=settings("explicit_rk", 1e-8))
    assert results.statistics["error_test_failures"] <= 0.05 * results.statistics["steps"]


def test_a_run_with_a_delay_goes_on_from_its_state(tmp_path: Path) -> None:
    """Also between a kink and where it comes up again."""
    times = [4.3, 5.0, 7.7, 20.0]
    case = cart(0.0, 2.0).with_values(settings("explicit_rk", 1e-8))
    run, other = hydrodae.Simulation(case), hydrodae.Simulation(case)
    for until in times:
        run.advance(until)
        other.restore(run.state())
        assert other.read("joints/slide/displacement") == run.read("joints/slide/displacement")
        run.advance(until + 1.1)
        other.advance(until + 1.1)
        assert other.read("joints/slide/displacement") == run.read("joints/slide/displacement")


RESIDUE, HEAVE_STIFFNESS = 4e4, 6e5  #: kernel residue exp(-t) [N/m]; of the water plane [N/m]

FLOAT = """
title = "Float that moves much faster than its kernel"

[[body]]
name = "float"
hydro = "float"
motion = "heave"
mass = {mass}
center_of_gravity = [0.0, 0.0, 0.0]
initial.displacement = [0.0, 0.0, 0.1]

[hydro]
database = "{database}"
radiation = "convolution"

[solver]
end_time = 6.0

[output]
step = 0.02
"""


def kernel_database(path: Path) -> Path:
    """Database of the float with the kernel on a grid of 0.02 s up to 25 s."""
    water.write(path, RESIDUE, water.ADDED_MASS)
    time = 0.02 * np.arange(1251)
    with h5py.File(path, "r+") as file:
        file["bodies/float/hydrostatic_stiffness"][2, 2] = HEAVE_STIFFNESS
        group = file.create_group("radiation_kernel")
        group["inputs"] = group["outputs"] = np.array([water.LABEL], dtype="S32")
        group["time"] = time
        group["kernel"] = RESIDUE * np.exp(water.POLE * time)[:, None, None]
        group["added_mass_inf"] = [[water.ADDED_MASS]]
    return path


@pytest.mark.parametrize("method", ["explicit_rk", "radau"])
def test_error_of_a_convolution_falls_with_the_tolerance(tmp_path: Path, method: str) -> None:
    """Of a float that moves 20 times as fast as the kernel."""
    text = FLOAT.format(mass=water.MASS, database=kernel_database(tmp_path / "float.h5"))
    inertia = water.MASS + water.ADDED_MASS
    system = np.array(
        [[0, 1, 0], [-HEAVE_STIFFNESS / inertia, 0, -1 / inertia], [0, RESIDUE, water.POLE]]
    )
    for rtol in (1e-4, 1e-6, 1e-8):
        results = hydrodae.run(hydrodae.Case.from_text(text), set=settings(method, rtol))
        exact = solve_ivp(
            lambda _t, y: system @ y, (0.0, 6.0), [0.1, 0.0, 0.0], t_eval=results.time, **EXACT
        ).y[0]
        error = np.abs(results["bodies/float/position"].values[:, 2] - exact).max()
        assert error <= 50.0 * rtol * 0.1
