"""Large motions of dynamic lines: a measured chain, a rope that whirls."""

from __future__ import annotations

import hashlib
import json
import math
import pickle
from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from tests.verification.line_scenes import IDLE, PERIOD, case, line, round_chain, span

import hydrodae
from hydrodae._core import State


@pytest.mark.slow
def test_measured_tension_of_a_chain_whose_top_runs_round_a_circle(reference: Path) -> None:
    """Slack to taut once a turn, with touchdown; rms over the range, at the best phase.

    Coefficients of the experiment's authors, for the diameter of the steel; links 3.35 bars wide.
    MoorDyn 2.7.2 with as many segments, its load on the fairlead taken in the same way: 2.70 %.
    """
    measured = np.loadtxt(
        reference / "chain_tension" / "tension_3.5s.csv", delimiter=",", skiprows=1
    )
    turns = 8
    run = hydrodae.run(
        case(round_chain(40, 1.505, 0.096), f"end_time = {turns * PERIOD}\nrtol = 1e-3", 0.01)
    )
    tension = run["forces/line/tension"].values
    times = measured[:, 0] + 2.0 * PERIOD
    errors = [
        float(np.sqrt(np.mean((np.interp(times + late, run.time, tension) - measured[:, 1]) ** 2)))
        for late in np.arange(2.9, 3.0, 0.001)
    ]
    assert min(errors) < 0.0261 * np.ptp(measured[:, 1])
    assert tension[run.time > 2.0 * PERIOD].max() == pytest.approx(measured[:, 1].max(), rel=0.01)


def moved(state: State, y: np.ndarray) -> State:
    """The same state with other unknowns."""
    raw = bytes(state.__getstate__())  # type: ignore[call-overload]
    at = raw.index(state.y.tobytes())
    body = raw[:at] + y.tobytes() + raw[at + y.nbytes : -64]
    new = body + hashlib.sha256(body).hexdigest().encode()
    changed: State = pickle.loads(pickle.dumps(state).replace(raw, new))
    return changed


@pytest.mark.slow
def test_a_whirling_rope_keeps_its_shape_for_five_turns(reference: Path) -> None:
    """A rope that turns about the vertical through its pin, at 1.2 times its first frequency."""
    truths = json.loads((reference / "rope" / "swing.json").read_text())["whirling"]
    rope, truth, n = truths["L"], truths["cases"][1], 80
    keys = span(None, rope, n, truths["mu"], truth["EA"])
    turning = truth["Omega"]
    options = f'end_time = {10.0 * math.pi / turning!r}\nmethod = "radau"\nrtol = 1e-7'
    simulation = hydrodae.Simulation(case(IDLE + line(keys), options))
    radius, height = (
        CubicSpline(truth["s"], truth[key])(rope * np.arange(1, n + 1) / n) for key in "rz"
    )
    state = simulation.state()
    nodes = np.zeros((n, 6))  # place and velocity
    nodes[:, 0], nodes[:, 2], nodes[:, 4] = radius, height, turning * radius
    simulation.restore(moved(state, np.concatenate([state.y[: -6 * n], nodes.ravel()])))
    while not simulation.finished:
        simulation.advance()
    x, y, z = simulation.state().y[-6:-3]
    assert math.hypot(x, y) == pytest.approx(truth["tip_radius"], abs=1e-4 * rope)
    assert z == pytest.approx(truth["tip_z"], abs=1e-4 * rope)
    assert abs(math.atan2(y, x)) < 2e-3
    held = float(np.asarray(simulation.read("forces/line/tension_anchor")))
    assert held == pytest.approx(truth["T_top"], rel=1e-3)
