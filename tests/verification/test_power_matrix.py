"""A power matrix of RM3 with end stops, default settings: no cell stops, its power is possible."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae import _core
from hydrodae.errors import SolverError
from hydrodae.results.post import mean_absorbed_power

PERIODS = (6.0, 7.5, 9.0, 10.5, 12.0, 14.0)  # [s]
HEIGHTS = (1.0, 2.0, 3.0, 4.0, 5.0)  # [m]
RAMP = 30.0  # [s]
GAP = 1e-6  #: by which rtol may let a stop be passed, of a body about 10 m in size [m]
STROKE = 1.5  # [m]
STOP = """
[[constraint]]
name = "end_stops"
type = "stop"
joint = "slide"
lower = {lower}
upper = {upper}
restitution = {restitution}
"""


def cell(
    folder: Path,
    period: float,
    height: float,
    motion: str,
    stroke: float = STROKE,
    restitution: float = 0.3,
) -> hydrodae.Case:
    """cases/rm3/wave.toml with end stops, in an irregular sea for five minutes."""
    text = (folder / "wave.toml").read_text()
    if motion == "heave":
        text = text.replace("hydro.h5", "heave.h5").replace('"planar"', '"heave"')
    text += STOP.format(lower=-stroke, upper=stroke, restitution=restitution)
    wave = {"name": "sea", "type": "jonswap", "significant_height": height, "peak_period": period}
    values = {"wave": [wave], "sea.ramp": RAMP, "solver.end_time": 300.0, "output.step": 0.1}
    return hydrodae.Case.from_text(text, folder).with_values(values)


def most_power(case: hydrodae.Case) -> float:
    """What bodies of revolution can take in heave from the waves of the case, deep water [W].

    The waves carry rho g^2 a^2 / (4 w) along each metre of their crest, over a width of 1/k.
    """
    omega, _, amplitude, _ = np.asarray(_core.wave_components(case.scene)).T
    return float(np.sum(1000.0 * 9.81**3 * amplitude**2 / (4.0 * omega**3)))


def stroke_of(results: hydrodae.Results) -> float:
    return float(abs(results["joints/slide/displacement"]).max())


def test_power_grows_with_the_square_of_the_height_until_the_stops_are_met(rm3: Path) -> None:
    power, events = [], []
    for height in (1.0, 2.0, 5.0):
        case = cell(rm3, 9.0, height, "heave")
        results = hydrodae.run(case)
        assert results.status == "completed"
        assert stroke_of(results) <= STROKE + GAP
        power.append(mean_absorbed_power(results, "pto", 2.0 * RAMP))
        assert 0.0 < power[-1] < most_power(case)
        events.append(results.statistics["events"])
    assert power[1] == pytest.approx(4.0 * power[0], rel=1e-3)
    assert power[2] < 0.95 * 25.0 * power[0]
    assert events[:2] == [0, 0]
    assert events[2] > 0


SPHERE = """
[[joint]]
name = "slide"
type = "prismatic"
body_a = "ground"
body_b = "sphere"
point = [0.0, 0.0, -2.0]
axis = [0.0, 0.0, 1.0]
[[force]]
name = "pto"
type = "pto_linear"
joint = "slide"
damping = 1e5
"""


def test_power_of_the_sphere_grows_likewise(repository: Path) -> None:
    """The same with the database of cases/sphere, in a regular wave near its resonance."""
    folder, power, stroke = repository / "cases" / "sphere", [], 0.5
    stop = STOP.format(lower=-stroke, upper=stroke, restitution=0.3)
    text = (folder / "wave.toml").read_text() + SPHERE + stop
    for height in (0.2, 0.4, 2.0):
        values = {"wave.swell.height": height, "sea.ramp": 15.0, "solver.end_time": 60.0}
        results = hydrodae.run(hydrodae.Case.from_text(text, folder), set=values)
        assert stroke_of(results) <= stroke + GAP
        assert (results.statistics["events"] > 0) == (height == 2.0)
        power.append(mean_absorbed_power(results, "pto", 40.0))
        assert 0.0 < power[-1] < 1000.0 * 9.81**3 * (0.5 * height) ** 2 / (4.0 * (0.4 * np.pi) ** 3)
    assert power[1] == pytest.approx(4.0 * power[0], rel=1e-3)
    assert power[2] < 0.95 * 100.0 * power[0]


def check_all(
    folder: Path, motion: str, stroke: float, restitution: float, method: str = "ida"
) -> None:
    """Thirty cells: none stops, power is within what is possible.

    Without an impact it goes with the square of the height; stops that rebound may add to it.
    """
    stopped = []
    power = np.full((len(PERIODS), len(HEIGHTS)), np.nan)
    for i, period in enumerate(PERIODS):
        for k, height in enumerate(HEIGHTS):
            case = cell(folder, period, height, motion, stroke, restitution)
            try:
                results = hydrodae.run(case, set={"solver.method": method})
            except SolverError as error:
                stopped.append(f"Tp {period} s, Hs {height} m: {error}")
                continue
            power[i, k] = mean_absorbed_power(results, "pto", 2.0 * RAMP)
            assert 0.0 < power[i, k] < most_power(case)
            if results.statistics["events"] == 0:
                assert power[i, k] == pytest.approx(power[i, 0] * height**2, rel=0.03)
            assert stroke_of(results) <= stroke + GAP
    if stopped:
        pytest.fail("\n".join(stopped), pytrace=False)


HEAVE = [(1.5, 0.3), (0.75, 0.0), (0.75, 0.7)]


@pytest.mark.slow
@pytest.mark.parametrize(("stroke", "restitution"), HEAVE)
def test_no_cell_stops(rm3: Path, stroke: float, restitution: float) -> None:
    check_all(rm3, "heave", stroke, restitution)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("stroke", "restitution", "method"),
    [(2.5, 0.3, "ida"), (1.5, 0.3, "ida"), (0.75, 0.0, "ida"), (0.75, 0.0, "radau")],
)
def test_no_cell_stops_in_the_plane(
    rm3_planar: Path, stroke: float, restitution: float, method: str
) -> None:
    check_all(rm3_planar, "planar", stroke, restitution, method)


CONTACT = """
title = "Two bodies slide on each other in the plane, rest on a stop and lift off it again"

[[body]]
name = "spar"
motion = "planar"
mass = 886691.0
center_of_gravity = [0.0, 0.0, -21.29]
inertia = [9.4e7, 9.4e7, 2.9e7]

[[body]]
name = "float"
motion = "planar"
mass = 725834.0
center_of_gravity = [0.0, 0.0, -0.72]
inertia = [2.1e7, 2.1e7, 3.7e7]

[[joint]]
name = "slide"
type = "prismatic"
body_a = "spar"
body_b = "float"
point = [0.0, 0.0, -0.72]
axis = [0.0, 0.0, 1.0]

[[force]]
type = "mooring_matrix"
name = "spring"
body = "spar"
stiffness = [1.0e5, 0.0, 1.0e6, 0.0, 1.0e8, 0.0]
pretension = [0.0, 0.0, 15818870.25, 0.0, 0.0, 0.0]

[[force]]
type = "constant_load"
name = "shove"
body = "float"
force = [1.0e5, 0.0, 0.0]

[solver]
end_time = 20.0

[output]
step = 0.1
"""


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_lifting_off_a_stop_in_the_plane(method: str) -> None:
    text = CONTACT + STOP.format(lower=-0.5, upper=0.5, restitution=0.0)
    results = hydrodae.run(hydrodae.Case.from_text(text), set={"solver.method": method})
    load = results["constraints/end_stops/reaction"].to_numpy()
    assert abs(load).max() > 1e6
    assert 3 <= results.statistics["events"] <= 10
    assert results.statistics["relative_balance_error"] < 1e-5
