"""Buoys, clumps, markers and gauges that `hydrodae view` draws."""

from __future__ import annotations

import numpy as np
import pytest
from tests.python.moored_scene import MOORED

import hydrodae
from hydrodae.viewer.page import page_data

HUNG = """
[[gauge]]
name = "front"
point = [-10.0, 2.0]
[[gauge]]
name = "above"
marker = "tip"
[[force]]
name = "hose"
type = "line"
body_b = "float"
point_a = [0.0, 30.0, -20.0]
point_b = [0.0, 1.0, -1.0]
length = [20.0, 17.0]
segments = [10]
mass = [20.0]
diameter = [0.08]
stiffness = [1e6]
damping_ratio = [0.8]
attachment_at = [10.0, 20.0]
attachment_mass = [100.0, 50.0]
attachment_volume = [0.01, 0.2]
"""


def test_buoys_clumps_markers_and_gauges_are_where_the_results_say(tmp_path):
    text = MOORED.replace("arm.1", "arm") + HUNG
    text = text.replace("pretension = 6000.0", "loads = [-1000.0]").replace(
        "[10.0, 30.0]", "[14.0, 30.0]"
    )
    path = tmp_path / "case.toml"
    path.write_text(text)
    results = hydrodae.run(path, set={"solver.end_time": 0.5})
    seen = hydrodae.view(results)
    spots = {spot.name: spot for spot in seen.stage.spots}
    kinds = {name: spot.kind for name, spot in spots.items()}
    assert kinds == {
        "water": "mooring matrix", "chain buoy 1": "buoy", "hose clump 1": "clump",
        "hose buoy 2": "buoy", "tip": "marker", "front": "gauge", "above": "gauge",
    }  # fmt: skip
    tip = results["markers/tip/position"].to_numpy()
    assert spots["tip"].points == pytest.approx(tip, abs=1e-9)
    assert spots["above"].points[:, :2] == pytest.approx(tip[:, :2], abs=1e-9)
    for name in ("front", "above"):
        height = results[f"gauges/{name}/elevation"].to_numpy()
        assert spots[name].points[:, 2] == pytest.approx(height, abs=1e-9)
    nodes = results["forces/hose/position"].to_numpy().reshape(len(results.time), -1, 3)
    assert spots["hose clump 1"].points == pytest.approx(nodes[:, 5], abs=1e-9)
    assert spots["hose buoy 2"].points == pytest.approx(nodes[:, 10], abs=1e-9)
    carrier = seen.stage.body("float")
    assert carrier is not None
    away = carrier.places(np.array([1.0, 0.0, -1.0]))[0, 0] - [40.0, 0.0, -20.0]
    weight, stiffness = [200.0, 200.0], [1e8, 1e8]
    shape = hydrodae.catenary(
        float(np.hypot(*away[:2])), float(away[2]), [14.0, 30.0], weight, stiffness,
        loads=[-1000.0], n=4401,
    )  # fmt: skip
    depth = float(np.interp(14.0, shape.s, shape.z)) - 20.0
    assert spots["chain buoy 1"].points[0, 2] == pytest.approx(depth, abs=0.05)
    assert [spot["name"] for spot in page_data(seen.stage, seen.frame, seen.camera)["spots"]] == [
        *spots
    ]
