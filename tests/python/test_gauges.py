"""Gauges: the elevation at a place, now and ahead, as a channel that every controller can read."""

from __future__ import annotations

import math
import pickle
import threading
from pathlib import Path

import numpy as np
import pytest
from tests.errors import wrong
from tests.python.doc_blocks import blocks
from tests.python.test_tcp import free_port

import hydrodae
from hydrodae import Case, Simulation, tcp

BUOY = """
environment.water_depth = 30.0
environment.water_density = 1025.0
[sea]
ramp = 4.0
[[body]]
name = "buoy"
motion = ["surge"]
mass = 800.0
center_of_gravity = [1.0, 0.0, 0.0]
initial = {{ velocity = [1.5, 0.0, 0.0] }}
[[joint]]
name = "slide"
type = "prismatic"
body_a = "ground"
body_b = "buoy"
point = [1.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
[[marker]]
name = "nose"
body = "buoy"
point = [3.0, 2.0, 0.0]
[[morison]]
name = "ball"
body = "buoy"
point = [1.0, 0.0, 0.0]
diameter = 1.0
drag_coefficient = 0.6
added_mass_coefficient = 0.5
[[force]]
name = "pto"
type = "pto_general"
joint = "slide"
stiffness = 2000.0
{more}
[solver]
method = "radau"
end_time = 6.0
[output]
step = 0.25
"""
REGULAR = """
[[wave]]
name = "swell"
type = "regular"
height = 1.2
period = 5.0
heading_deg = 30.0
phase_deg = 40.0
"""
IRREGULAR = """
[[wave]]
name = "storm"
type = "jonswap"
significant_height = 1.5
peak_period = 4.0
components = 20
spreading = 8.0
"""
GAUGES = """
[[gauge]]
name = "origin"
[[gauge]]
name = "front"
point = [-20.0, 5.0]
ahead = [0.5, 2.0]
[[gauge]]
name = "with"
marker = "nose"
ahead = [1.0]
"""
LAW = """
[[controller]]
name = "law"
type = "{type}"
inputs = ["gauges/front/ahead_2"]
outputs = ["forces/pto/load"]
period = 0.25
{keys}
"""
AHEAD = "gauges/front/ahead_2"


def case(more: str) -> Case:
    text = BUOY.format(more=more)
    return Case.from_text(text if "[[wave]]" in more else text.replace("ramp = 4.0", ""))


def test_the_elevation_of_a_regular_wave_at_rest_and_on_a_body() -> None:
    results = hydrodae.run(case(REGULAR + GAUGES))
    time, w, depth = results.time, 2.0 * math.pi / 5.0, 30.0
    k = w**2 / 9.81
    for _ in range(200):
        k = w**2 / (9.81 * math.tanh(k * depth))

    def wave(t: np.ndarray, x: np.ndarray | float, y: np.ndarray | float) -> np.ndarray:
        s = np.clip(t / 4.0, 0.0, 1.0)
        growth = s**4 * (35.0 - 84.0 * s + 70.0 * s**2 - 20.0 * s**3)
        along = x * math.cos(math.pi / 6.0) + y * math.sin(math.pi / 6.0)
        return growth * 0.6 * np.cos(w * t - k * along + math.radians(40.0))

    nose = results["markers/nose/position"].to_numpy()
    assert np.ptp(nose[:, 0]) > 1.0  # it moves
    for name, expected in {
        "origin/elevation": wave(time, 0.0, 0.0),
        "front/elevation": wave(time, -20.0, 5.0),
        "front/ahead_1": wave(time + 0.5, -20.0, 5.0),
        "front/ahead_2": wave(time + 2.0, -20.0, 5.0),
        "with/elevation": wave(time, nose[:, 0], nose[:, 1]),
        "with/ahead_1": wave(time + 1.0, nose[:, 0], nose[:, 1]),
    }.items():
        np.testing.assert_allclose(results["gauges/" + name], expected, atol=1e-10)
        assert results["gauges/" + name].attrs["unit"] == "m"
    np.testing.assert_allclose(
        results["gauges/origin/elevation"], results["sea/elevation"], atol=1e-8
    )


def test_a_forecast_comes_true_and_is_the_same_after_a_restore() -> None:
    run = Simulation(case(IRREGULAR + GAUGES))
    names = [name for name in run.channels if name.startswith("gauges/")]

    def go(until: float) -> list[list[float]]:
        rows = []
        while run.time < until:
            rows.append([run.advance(until), *(float(run.read(name)) for name in names)])
        return rows

    go(2.0)
    saved, foretold = run.state(), run.read(AHEAD)
    rows = go(4.0)
    assert run.read("gauges/front/elevation") == pytest.approx(foretold, abs=1e-12)
    assert abs(float(foretold)) > 0.01
    run.restore(saved)
    assert run.read(AHEAD) == foretold
    assert go(4.0) == rows
    other = Simulation(case(IRREGULAR + GAUGES))
    other.restore(pickle.loads(pickle.dumps(saved)))
    assert other.read(AHEAD) == foretold


def test_controllers_of_every_kind_read_it(tmp_path: Path) -> None:
    def follow(_time: float, ahead: float) -> float:
        return 1000.0 * ahead

    port = free_port()
    hello: list[str] = []

    def peer() -> None:
        with tcp.connect(port=port, timeout=10.0) as run:
            for t, (ahead,) in run:
                run.answer(follow(t, ahead))
            assert isinstance(run, tcp.Numbered)
            hello.append(run.hello["inputs"][0]["unit"])

    table = LAW.format(type="table", keys="at = [-9.0, 9.0]\nvalue = [-9000.0, 9000.0]")
    own = hydrodae.run(case(IRREGULAR + GAUGES + table))
    python = LAW.format(type="python", keys="")
    function = hydrodae.run(case(IRREGULAR + GAUGES + python), controllers={"law": follow})
    thread = threading.Thread(target=peer)
    thread.start()
    over = hydrodae.run(case(IRREGULAR + GAUGES + LAW.format(type="tcp", keys=f"port = {port}")))
    thread.join(10.0)
    assert hello == ["m"]
    held = own["controllers/law/output"].to_numpy()
    np.testing.assert_allclose(held[1:], 1000.0 * own[AHEAD].to_numpy()[:-1], rtol=1e-12, atol=1e-9)
    for name in (AHEAD, "controllers/law/output", "joints/slide/displacement"):
        np.testing.assert_allclose(function[name], own[name], rtol=1e-12, atol=1e-9)
        np.testing.assert_array_equal(over[name], function[name])


RECORD = (
    '\n[[wave]]\nname = "buoy12"\ntype = "measured"\ntaper = 1.0\n'
    f"time = {[0.5 * k for k in range(17)]}\n"
    f"elevation = {[round(math.sin(1.5 * k), 3) for k in range(17)]}\nlost_variance = 1.0\n"
)


@pytest.mark.parametrize(
    ("more", "key"),
    [
        ('[[gauge]]\nname = "g"', "gauge.g"),
        (REGULAR + '[[gauge]]\nname = "g"\nmarker = "nos"', "gauge.g.marker"),
        (REGULAR + '[[gauge]]\nname = "g"\nmarker = "nose"\npoint = [1.0, 2.0]', "gauge.g.marker"),
        (REGULAR + '[[gauge]]\nname = "g"\npoint = [1.0, 2.0, 3.0]', "gauge.g.point"),
        (REGULAR + '[[gauge]]\nname = "g"\npoint = [0.0, -1e300]', "gauge.g.point"),
        (REGULAR + '[[gauge]]\nname = "g"\nahead = [1.0, -0.5]', "gauge.g.ahead"),
        (REGULAR + '[[gauge]]\nname = "g"\nahed = [1.0]', "gauge.g.ahed"),
        (REGULAR + 2 * '[[gauge]]\nname = "g"\n', "gauge.g.name"),
        (RECORD + '[[gauge]]\nname = "g"\nahead = [1.0, 3.0]', "gauge.g.ahead"),
        (
            REGULAR + GAUGES.replace("front", "frint") + LAW.format(type="python", keys=""),
            "controller.law.inputs",
        ),
    ],
)
def test_what_cannot_be_is_told(more: str, key: str) -> None:
    with wrong(key) as caught:
        Simulation(case(more), controllers={"law": lambda t, x: 0.0} if "law" in more else None)
    assert caught.value.file == "<case>"
    assert caught.value.line > 0


def test_the_case_of_the_page(repository: Path) -> None:
    (shown,) = (b for b in blocks(repository / "docs" / "control.md", "toml") if "[[gauge]]" in b)
    assert "gauges/front/ahead_3 [m] -> forces/pto/load [N]" in hydrodae.check(
        case(REGULAR + shown)
    )


def test_a_record_is_known_to_its_end() -> None:
    given = case(RECORD + '[[gauge]]\nname = "g"\nahead = [2.0]')
    assert np.isfinite(hydrodae.run(given)["gauges/g/ahead_1"]).all()
