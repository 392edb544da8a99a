"""Gauges: the elevation at a place, now and ahead, as a channel that every controller can read."""

from __future__ import annotations

import math
import pickle
import threading
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table, X, body, joint
from tests.attack.parts import case as made
from tests.errors import wrong
from tests.python.doc_blocks import blocks
from tests.python.test_tcp import free_port
from tests.verification.blocks import case_of

import hydrodae
from hydrodae import Case, Simulation, tcp

AHEAD = "gauges/front/ahead_2"
REGULAR: Table = dict(name="swell", type="regular", height=1.2, period=5.0)
REGULAR |= dict(heading_deg=30.0, phase_deg=40.0)
IRREGULAR: Table = dict(name="storm", type="jonswap", significant_height=1.5, peak_period=4.0)
IRREGULAR |= dict(components=20, spreading=8.0)
FRONT = {"name": "front", "point": [-20.0, 5.0], "ahead": [0.5, 2.0]}
GAUGES: list[Table] = [
    {"name": "origin"},
    FRONT,
    {"name": "with", "marker": "nose", "ahead": [1.0]},
]


def law(kind: str, **keys: Any) -> list[Table]:
    """Return a controller that reads the forecast in front."""
    ends = dict(inputs=[AHEAD], outputs=["forces/pto/load"], period=0.25)
    return [{"name": "law", "type": kind, **ends, **keys}]


LINE = law("table", at=[-9.0, 9.0], value=[-9000.0, 9000.0])


def case(
    wave: Table | None = IRREGULAR,
    gauge: Sequence[Table] = GAUGES,
    controller: Sequence[Table] = (),
    folder: Path = Path(),
) -> Case:
    """Return a buoy that drifts along a slide with gauges beside it and on it."""
    at = [1.0, 0.0, 0.0]
    ball = dict(name="ball", body="buoy", point=at, diameter=1.0, drag_coefficient=0.6)
    tables = made(
        [body("buoy", ["surge"], 800.0, at, velocity=[1.5, 0.0, 0.0])],
        6.0,
        environment={"water_depth": 30.0, "water_density": 1025.0},
        joints=[joint("slide", "prismatic", "ground", "buoy", at, X)],
        marker=[dict(name="nose", body="buoy", point=[3.0, 2.0, 0.0])],
        morison=[ball | {"added_mass_coefficient": 0.5}],
        forces=[dict(name="pto", type="pto_general", joint="slide", stiffness=2000.0)],
        output={"step": 0.25},
    )
    if wave is not None:
        tables |= {"sea": {"ramp": 4.0}, "wave": [wave]}
    for key, entries in (("gauge", gauge), ("controller", controller)):
        if entries:
            tables[key] = list(entries)
    return case_of(tables, folder, method="radau")


def test_the_elevation_of_a_regular_wave_at_rest_and_on_a_body() -> None:
    results = hydrodae.run(case(REGULAR))
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
    run = Simulation(case())
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
    other = Simulation(case())
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

    own = hydrodae.run(case(controller=LINE))
    function = hydrodae.run(case(controller=law("python")), controllers={"law": follow})
    thread = threading.Thread(target=peer)
    thread.start()
    over = hydrodae.run(case(controller=law("tcp", port=port)))
    thread.join(10.0)
    assert hello == ["m"]
    held = own["controllers/law/output"].to_numpy()
    np.testing.assert_allclose(held[1:], 1000.0 * own[AHEAD].to_numpy()[:-1], rtol=1e-12, atol=1e-9)
    for name in (AHEAD, "controllers/law/output", "joints/slide/displacement"):
        np.testing.assert_allclose(function[name], own[name], rtol=1e-12, atol=1e-9)
        np.testing.assert_array_equal(over[name], function[name])


RECORD: Table = dict(name="buoy12", type="measured", taper=1.0, lost_variance=1.0)
RECORD["time"] = [0.5 * k for k in range(17)]
RECORD["elevation"] = [round(math.sin(1.5 * k), 3) for k in range(17)]


@pytest.mark.parametrize(
    ("wave", "gauge", "key"),
    [
        (None, {}, "gauge.g"),
        (REGULAR, {"marker": "nos"}, "gauge.g.marker"),
        (REGULAR, {"marker": "nose", "point": [1.0, 2.0]}, "gauge.g.marker"),
        (REGULAR, {"point": [1.0, 2.0, 3.0]}, "gauge.g.point"),
        (REGULAR, {"point": [0.0, -1e300]}, "gauge.g.point"),
        (REGULAR, {"ahead": [1.0, -0.5]}, "gauge.g.ahead"),
        (REGULAR, {"ahed": [1.0]}, "gauge.g.ahed"),
        (RECORD, {"ahead": [1.0, 3.0]}, "gauge.g.ahead"),
        (REGULAR, None, "gauge.g.name"),
        (REGULAR, FRONT | {"name": "frint"}, "controller.law.inputs"),
    ],
)
def test_what_cannot_be_is_told(wave: Table | None, gauge: Table | None, key: str) -> None:
    gauges = [{"name": "g"}] * 2 if gauge is None else [{"name": "g", **gauge}]
    laws = law("python") if "controller" in key else []
    with wrong(key) as caught:
        given = case(wave, gauges, laws)
        Simulation(given, controllers={"law": lambda t, x: 0.0} if laws else None)
    assert caught.value.file == "<case>"
    assert caught.value.line > 0


def test_the_case_of_the_page(repository: Path) -> None:
    (shown,) = (b for b in blocks(repository / "docs" / "control.md", "toml") if "[[gauge]]" in b)
    tables = tomllib.loads(shown)
    checked = hydrodae.check(case(REGULAR, tables["gauge"], tables["controller"]))
    assert "gauges/front/ahead_3 [m] -> forces/pto/load [N]" in checked


def test_a_record_is_known_to_its_end() -> None:
    given = case(RECORD, [{"name": "g", "ahead": [2.0]}])
    assert np.isfinite(hydrodae.run(given)["gauges/g/ahead_1"]).all()
