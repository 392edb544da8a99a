"""Dynamic lines against closed forms, independent eigenvalues and equations of their own."""

from __future__ import annotations

import json
import math
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from tests.errors import wrong
from tests.scenes import driven
from tests.verification.line_scenes import (
    IDLE,
    WATER,
    WEIGHT,
    at_rest,
    case,
    chain,
    frequencies,
    line,
    moving,
    span,
)

import hydrodae


def test_the_static_shape_tends_to_the_catenary_as_h_squared() -> None:
    exact = hydrodae.catenary(80.0, 30.0, 100.0, 98.1, 1e6, seabed=False)
    errors = []
    for n in (20, 40, 80):
        keys = span([80.0, 0.0, 30.0], 100.0, n, 10.0, 1e6)
        errors.append(float(at_rest(IDLE + line(keys), "forces/line/tension")) / exact.tension - 1)
    assert abs(errors[-1]) < 3e-5
    assert np.diff(np.log2(np.abs(errors))) == pytest.approx([-2.0, -2.0], abs=0.05)


def test_frequencies_of_sagging_cables_of_as_many_masses(reference: Path) -> None:
    cases = json.loads((reference / "rope" / "cable_frequencies.json").read_text())["cases"]
    for c in cases:
        inside, across = frequencies(span([c["X"], 0.0, c["Z"]], c["L0"], 50, c["mu"], c["EA"]))
        lumped = c["lumped"]["50"]
        assert inside[:6] == pytest.approx(lumped["inplane"], rel=2e-6), c["name"]
        assert across[:6] == pytest.approx(lumped["out_of_plane"], rel=2e-6), c["name"]


def test_frequencies_of_a_hanging_chain_of_as_many_masses(reference: Path) -> None:
    d = json.loads((reference / "rope" / "hanging_chain.json").read_text())
    _, across = frequencies(span(None, 5.0, 20, 2.0, 1e8))
    assert across[:6] == pytest.approx(d["discrete_lumped"]["20"], rel=2e-6)


def test_frequencies_of_a_taut_string_of_as_many_masses(reference: Path) -> None:
    d = json.loads((reference / "rope" / "taut_string.json").read_text())
    keys = span([10.0, 0.0, 0.0], d["L0_unstretched"], 20, d["mu0_unstretched"], d["EA"])
    _, across = frequencies(keys, "[environment]\ngravity = 0.0\n")
    assert across[:8] == pytest.approx(d["transverse_omega_lumped"]["20"], rel=1e-9)


def test_a_stiff_line_bends_as_a_beam() -> None:
    """Simply supported: omega = (n pi / L)^2 sqrt(EI / m), and with the error of h^2."""
    errors = []
    for n in (20, 40):
        keys = span([10.0, 0.0, 0.0], 10.0, n, 3.0, 1e4, "bending_stiffness = [5e3]")
        _, across = frequencies(keys, "[environment]\ngravity = 0.0\n")
        exact = (np.arange(1, 4) * math.pi / 10.0) ** 2 * math.sqrt(5e3 / 3.0)
        errors.append(across[:3] / exact - 1.0)
    assert np.abs(errors[1]).max() < 5e-3
    assert errors[0] / errors[1] == pytest.approx([4.0] * 3, rel=0.05)


HANGING = """
[[body]]
name = "weight"
motion = ["heave"]
mass = 1000.0
center_of_gravity = [0.0, 0.0, -10.0]
initial = { displacement = [0.0, 0.0, -0.4] }
"""


def test_a_light_taut_line_is_a_rope() -> None:
    """A weight bounces on either; EA = 2e5 N, 10 m."""
    rope = """
[[force]]
type = "rope"
name = "line"
bodies = ["ground", "weight"]
points = [[0.0, 0.0, 0.0], [0.0, 0.0, -10.0]]
stiffness = 2e5
length = 10.0
"""
    keys = span([0.0, 0.0, -10.0], 10.0, 5, 0.001, 2e5, 'body_b = "weight"')
    options = 'end_time = 3.0\nmethod = "radau"\nrtol = 1e-6'
    a, b = (
        hydrodae.run(case(HANGING + force, options, 0.05))["bodies/weight/position"].values[:, 2]
        for force in (rope, line(keys))
    )
    assert np.ptp(a) > 0.1
    assert b == pytest.approx(a, abs=2e-5 * float(np.ptp(a)) + 1e-5)


def test_slow_motion_is_that_of_a_catenary() -> None:
    """Some metres in 600 s; the bed is stiff, the drag small."""
    keys = chain(40, "drag = [1.0]\nadded_mass = [1.0]\ndamping_ratio = [0.5]")
    text = WATER + moving(600.0) + line(keys)
    run = hydrodae.run(case(text, "end_time = 900.0", 5.0))
    surge = run["bodies/buoy/position"].values[:, 0]
    exact = [hydrodae.catenary(385.0 + x, 50.0, 400.0, WEIGHT, 5e7).tension for x in surge]
    assert np.ptp(exact) > 0.5 * min(exact)
    assert run["forces/line/tension"].values == pytest.approx(exact, rel=0.02)


@pytest.mark.parametrize("more", ["", "damps_slack = true\nseabed_damps_up = true\n"])
def test_what_goes_in_is_stored_or_spent(more: str) -> None:
    """Work on the line = change of what it stores + what water, damping and seabed take."""
    keys = chain(
        20,
        "drag = [1.2]\ndrag_axial = [0.1]\nadded_mass = [1.0]\ndamping_ratio = [0.5]\n"
        f"seabed_damping = 1e4\nseabed_friction = 0.4\n{more}",
    )
    text = WATER + moving(8.0) + line(keys)
    run = hydrodae.run(case(text, "end_time = 24.0\nrtol = 1e-5", 0.01))
    stored = run["forces/line/energy"].values
    powers = [run[f"forces/line/power_{k}"].values for k in ("water", "damping", "seabed")]
    power = np.sum(powers, axis=0)
    spent = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * 0.01)])
    given = -run["energy/work/line"].values
    size = np.abs(given).max()
    assert spent[-1] > 0.05 * size
    assert given == pytest.approx(stored - stored[0] + spent, abs=2e-3 * size)
    for part in ("damping", "seabed"):
        power = run[f"forces/line/power_{part}"].values
        assert power.min() >= -1e-12 * power.max()


def test_the_damping_of_the_seabed_carries_nothing_at_rest() -> None:
    text = WATER + moving(8.0)
    loads = [
        at_rest(text + line(chain(20, f"seabed_damping = {c}")), "forces/line/tension")
        for c in (0.0, 1e7)
    ]
    np.testing.assert_allclose(loads[0], loads[1], rtol=1e-12)


SNAP_N, SNAP_L, SNAP_M, SNAP_EA, SNAP_C = 12, 9.0, 20.0, 2e5, 900.0
SNAP_A, SNAP_T = 0.3, 0.8


@cache
def snap(damped_slack: bool) -> np.ndarray:
    """Tension at the moving end of a straight line that slackens and snaps, by steps of RK4 [N].

    T = EA max(0, strain) + C strain', as in MoorDyn, or without C where it is slack.
    """
    n, step = SNAP_N, SNAP_L / SNAP_N
    w, mass, h = 2.0 * math.pi / SNAP_T, SNAP_M * SNAP_L / SNAP_N, 5e-5

    def pulls(t: float, x: np.ndarray, v: np.ndarray) -> np.ndarray:
        ends = SNAP_A * math.sin(w * t), SNAP_A * w * math.cos(w * t)
        strain = np.diff(np.concatenate([[0.0], x, [ends[0]]])) / step
        rate = np.diff(np.concatenate([[0.0], v, [ends[1]]])) / step
        acts = np.ones(n) if damped_slack else strain > 0.0
        return SNAP_EA * np.maximum(strain, 0.0) + SNAP_C * rate * acts

    x, v = np.zeros(n - 1), np.linspace(0.0, SNAP_A * w, n + 1)[1:-1]
    out = []
    for k in range(round(2.0 / h) + 1):
        t = k * h
        if k % 100 == 0:
            out.append(pulls(t, x, v)[-1])
        a = np.diff(pulls(t, x, v)) / mass
        b = np.diff(pulls(t + 0.5 * h, x + 0.5 * h * v, v + 0.5 * h * a)) / mass
        x, v = x + h * v + 0.5 * h * h * a, v + h * b
    return np.array(out)


@pytest.mark.parametrize("damped_slack", [False, True])
def test_the_damping_of_slack_segments(damped_slack: bool) -> None:
    """Against the same law with a hard onset; the other law is far from it."""
    text = "environment.gravity = 0.0\n"
    text += driven("end", "surge", 1.0, [SNAP_L, 0.0, 0.0], amplitude=SNAP_A, period=SNAP_T)
    more = f'body_b = "end"\ndamping = [{SNAP_C}]\ndamps_slack = {str(damped_slack).lower()}'
    keys = span([SNAP_L, 0.0, 0.0], SNAP_L, SNAP_N, SNAP_M, SNAP_EA, more)
    run = hydrodae.run(case(text + line(keys), "end_time = 2.0\nrtol = 1e-5", 0.005))
    found = run["forces/line/tension_along"].values[:, -1]
    theirs, others = snap(damped_slack), snap(not damped_slack)
    size = theirs.max()
    assert np.abs(found - theirs).max() < 0.02 * size
    assert np.abs(others - theirs).max() > 0.1 * size


@pytest.mark.parametrize("up", [False, True])
def test_the_damping_of_the_seabed_on_the_way_up(up: bool) -> None:
    """What it takes is c v^2 of the nodes in contact, on the way down or both ways."""
    k, c, width = 2e4, 2e4, 0.15
    keys = chain(
        20,
        f"damping_ratio = [0.5]\nseabed_stiffness = {k}\nseabed_damping = {c}\n"
        f"seabed_damps_up = {str(up).lower()}",
    )
    text = WATER + moving(8.0) + line(keys)
    run = hydrodae.run(case(text, "end_time = 20.0\nrtol = 1e-5", 0.005))
    z = run["forces/line/position"].values.reshape(len(run.time), -1, 3)[:, 1:-1, 2]
    v = np.gradient(z, 0.005, axis=0)
    half_width = WEIGHT / (k * width)
    y = np.clip((-50.0 - z) / half_width, -1.0, 1.0)
    touch = 0.5 + 0.75 * y - 0.25 * y**3
    fast = np.abs(v) > 0.05  # the damping sets in within 0.01 m/s
    power = c * width * 20.0 * np.sum(touch * v**2 * (up | (v < 0.0)) * fast, axis=1)
    taken = run["forces/line/power_seabed"].values
    assert taken == pytest.approx(power, abs=0.03 * power.max())
    assert power.max() > 100.0


def test_the_summary_tells_that_a_breaking_load_is_exceeded() -> None:
    for strength, told in ((1e9, False), (1.5e5, True)):
        keys = chain(8, f"drag = [1.2]\nadded_mass = [1.0]\nbreaking_load = [{strength}]")
        run = hydrodae.run(case(WATER + moving(10.0) + line(keys), "end_time = 4.0"))
        ratio = run["forces/line/tension_ratio"].values
        assert bool(ratio.max() > 1.0) is told
        lines = [text for text in run.summary().splitlines() if "BREAKING LOAD" in text]
        assert len(lines) == told
        if told:
            first = float(run.time[np.argmax(ratio > 1.0)])
            assert f"line: BREAKING LOAD EXCEEDED from t = {first:.4g} s" in lines[0]
            assert f"{ratio.max():.3g} times" in lines[0]


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_methods_agree(method: str) -> None:
    keys = chain(8, "drag = [1.2]\nadded_mass = [1.0]\ndamping_ratio = [0.5]")
    text = WATER + moving(10.0) + line(keys)
    runs = [
        hydrodae.run(case(text, f'end_time = 4.0\nmethod = "{m}"\nrtol = 1e-6', 0.2))
        for m in ("radau", method)
    ]
    a, b = (run["forces/line/tension"].values for run in runs)
    assert b == pytest.approx(a, rel=1e-3)


def test_equilibrium_of_three_lines_includes_their_nodes() -> None:
    """A buoy with too little weight rises until dynamic lines hold it as catenaries do."""
    heave = []
    for kind in ("line", "catenary"):
        text = (
            WATER
            + """
[[body]]
name = "buoy"
motion = ["surge", "sway", "heave"]
mass = 2e5
center_of_gravity = [0.0, 0.0, 0.0]
[[force]]
type = "constant_load"
name = "lift"
body = "buoy"
force = [2e4, 0.0, 3.4e6]
[[force]]
type = "mooring_matrix"
name = "water"
body = "buoy"
stiffness = [0.0, 0.0, 5e5, 0.0, 0.0, 0.0]
"""
        )
        if kind == "catenary":
            text = text.replace(WATER, "")
        for k in range(3):
            c, s = 385.0 * math.cos(2 * math.pi * k / 3), 385.0 * math.sin(2 * math.pi * k / 3)
            if kind == "line":
                keys = chain(40).replace("-385.0, 0.0,", f"{c!r}, {s!r},")
                text += line(keys, f"line{k}")
            else:
                text += f"""
[[force]]
type = "catenary"
name = "line{k}"
body_b = "buoy"
point_a = [{c!r}, {s!r}, -50.0]
point_b = [0.0, 0.0, 0.0]
length = [400.0]
weight = [{WEIGHT!r}]
stiffness = [5e7]
"""
        simulation = hydrodae.Simulation(case(text, 'end_time = 1.0\nstart = "equilibrium"'))
        heave.append(np.asarray(simulation.read("bodies/buoy/position")))
        before = float(simulation.read("forces/line0/tension"))
        while not simulation.finished:
            simulation.advance()
        assert float(simulation.read("forces/line0/tension")) == pytest.approx(before, rel=1e-6)
    assert heave[0] == pytest.approx(heave[1], abs=0.01)


def test_lines_that_make_no_sense_are_refused() -> None:
    good = "point_a = [0.0, 0.0, 0.0]\npoint_b = [8.0, 0.0, 0.0]\nlength = [10.0]\nmass = [1.0]\n"
    good += "stiffness = [1e5]\n"
    for more, key in [
        ("segments = [2.5]", "segments"),
        ("drag = [1.0, 1.0]", "drag"),
        ("damping = [1.0]\ndamping_ratio = [1.0]", "damping_ratio"),
        ("attachment_at = [0.7]\nattachment_mass = [1.0]", "attachment_at"),
        ("diameter = [0.1]", "diameter"),  # without the density of the water
        ("free_end = true\npretension = 10.0", "pretension"),
        ('body_a = "buoyy"', "body_a"),
    ]:
        with wrong(f"force.line.{key}"):
            hydrodae.Simulation(case(IDLE + line(good + more)))


def test_a_line_takes_the_keys_of_a_line_type() -> None:
    """Steel and fibre have their densities in the volume that the keys tell."""
    kinds = hydrodae.mooring
    for kind, density in (
        (kinds.studless_chain(0.1), 7850.0),
        (kinds.polyester(0.2), 1380.0),
        (kinds.nylon(0.2), 1140.0),
    ):
        keys = kind.keys()
        area = 0.25 * math.pi * keys["diameter"] ** 2
        assert keys["mass"] / area == pytest.approx(density, rel=0.01)
        assert keys["drag"] > 0.0
        ends = "point_a = [0.0, 0.0, -20.0]\npoint_b = [8.0, 0.0, -10.0]\nlength = [12.7]\n"
        sea = "[environment]\nwater_density = 1025.0\nwater_depth = 30.0\n"
        text = ends + "".join(f"{key} = [{value}]\n" for key, value in keys.items())
        tension = hydrodae.Simulation(case(sea + IDLE + line(text))).read("forces/line/tension")
        assert tension > kind.weight() * 10.0
