"""Scenes in which nothing can move, or nothing does: the loads that hold them."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.attack.parts import Table, Z, body, case, joint
from tests.verification.blocks import case_of, run_tables

import hydrodae
from hydrodae import hdb
from hydrodae.commands import cli
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.pictures.panels import overview

G = 9.81
FIXED_STEPS = {"step": 0.05}
METHODS: dict[str, Any] = {name: {} for name in ("auto", "ida", "radau", "explicit_rk")}
METHODS |= dict.fromkeys(("generalized_alpha", "gauss", "lobatto_iiic"), FIXED_STEPS)
#: Of a cylinder that floats upright, without its mass [m].
RADIUS, DRAFT, CENTER, RHO, OMEGA, HEIGHT = 2.0, 3.0, -1.0, 1000.0, 1.2, 0.8
DISPLACED = RHO * np.pi * RADIUS**2 * DRAFT  # kg
SWELL = dict(name="swell", type="regular", height=HEIGHT, period=2.0 * np.pi / OMEGA)
DEPTH, DIAMETER, WAVE, PERIOD = 20.0, 3.0, 1.0, 7.0


def buoy(motion: str, end: float = 1.0) -> Table:
    """Return the cylinder of 0.6 of the mass that it displaces, fixed or, if rigid, welded."""
    held = body("buoy", motion, 0.6 * DISPLACED, [0.0, 0.0, CENTER], [1e5] * 3) | {"hydro": "buoy"}
    weld = joint("weld", "fixed", "ground", "buoy", [0.0, 0.0, 2.0], Z)
    tables = case([held], end, joints=[weld] if motion == "rigid" else [])
    water = {"database": "hydro.h5", "radiation": "none"}
    del tables["output"]
    return tables | {"hydro": water, "sea": {"ramp": 5.0}, "wave": [SWELL]}


def pile(*others: Table) -> Table:
    """Return a fixed pile in a wave."""
    ends = dict(point_a=[0.0, 0.0, -DEPTH], point_b=[0.0, 0.0, 5.0])
    member = dict(name="water", body="pile", diameter=DIAMETER, segments=400, **ends)
    tables = case([body("pile", "fixed", 1e5, [0.0, 0.0, -10.0]), *others], 14.0)
    del tables["output"]
    return tables | {
        "environment": {"water_density": RHO, "water_depth": DEPTH},
        "morison": [member | {"added_mass_coefficient": 1.0}],
        "wave": [dict(name="swell", type="regular", height=2.0 * WAVE, period=PERIOD)],
    }


@pytest.fixture
def water(tmp_path: Path) -> hdb.HydroDatabase:
    """Tables of the cylinder, in hydro.h5 of the folder."""
    sea = hdb.Water(np.linspace(0.6, 1.8, 7), 60.0, np.zeros(1), RHO)
    body = hdb.Cylinder(RADIUS, DRAFT, CENTER)
    database = hdb.cylinders({"buoy": (0.0, 0.0)}, body, sea, orders=2, modes=30)[0]
    database.write(tmp_path / "hydro.h5")
    return database


def of_wave(time: NDArray[np.float64], database: hdb.HydroDatabase) -> NDArray[np.float64]:
    """Surge and heave force, and pitch moment, on the fixed cylinder without ramp (n, 3)."""
    k = int(np.argmin(abs(database.omega - OMEGA)))
    assert database.omega[k] == pytest.approx(OMEGA)
    at = [database.coordinates.index(f"buoy.{dof}") for dof in ("surge", "heave", "pitch")]
    force = 0.5 * HEIGHT * database.excitation[k, 0, at]
    return np.asarray((np.exp(1j * OMEGA * time)[:, None] * force).real)


@pytest.mark.parametrize("method", METHODS)
def test_fixed_body_in_a_wave_reports_what_holds_it(
    method: str, tmp_path: Path, water: hdb.HydroDatabase
) -> None:
    tables = buoy("fixed", 20.0)
    results = run_tables(tables, tmp_path, method=method, **METHODS[method])
    assert results.status == "completed"
    late = results.time > 5.0
    exact = of_wave(results.time, water)
    force = results["bodies/buoy/support_force"].values
    moment = results["bodies/buoy/support_moment"].values
    atol = 1e-6 * abs(exact).max()
    np.testing.assert_allclose(force[late, 0], -exact[late, 0], atol=atol)
    weight = 0.4 * DISPLACED * G  # less than the buoyancy
    np.testing.assert_allclose(force[late, 2], -exact[late, 1] - weight, atol=atol, rtol=1e-9)
    np.testing.assert_allclose(moment[late, 1], -exact[late, 2], atol=atol)
    text = results.summary()
    assert "at rest: nothing has moved" in text
    mean = re.search(r"bodies/buoy/support_force.z +mean (\S+) N", text)
    assert mean
    assert float(mean[1]) == pytest.approx(force[late, 2].mean(), rel=1e-3)
    assert "bodies/buoy/support_moment.y" in text


@pytest.mark.parametrize("method", ["auto", "ida", "radau"])
def test_welded_body_in_a_wave_reports_its_reaction(
    method: str, tmp_path: Path, water: hdb.HydroDatabase
) -> None:
    """The same loads, about the weld 3 m above the centre of gravity."""
    results = run_tables(buoy("rigid", 20.0), tmp_path, method=method)
    late = results.time > 5.0
    exact = of_wave(results.time, water)
    force = results["joints/weld/reaction_force"].values
    moment = results["joints/weld/reaction_moment"].values
    axes = np.array([results["joints/weld/reaction_force"].attrs[f"axis_{c}"] for c in "xyz"])
    force, moment = force @ axes, moment @ axes
    atol = 1e-6 * abs(exact).max()
    np.testing.assert_allclose(force[late, 0], -exact[late, 0], atol=atol)
    np.testing.assert_allclose(force[late, 2], -exact[late, 1] - 0.4 * DISPLACED * G, rtol=1e-6)
    # M_weld = M_G + (r_G - r_weld) x F: -3 m times the surge force
    np.testing.assert_allclose(
        moment[late, 1], -exact[late, 2] + 3.0 * exact[late, 0], atol=10 * atol
    )
    text = results.summary()
    assert "at rest: nothing has moved" in text
    assert "joints/weld/reaction_force" in text


@pytest.mark.parametrize("motion", ["fixed", "rigid"])
def test_equilibrium_of_what_cannot_move_gives_its_reactions(
    motion: str, tmp_path: Path, water: hdb.HydroDatabase, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "case.toml"
    path.write_text(case_of(buoy(motion), tmp_path).text)
    found = hydrodae.equilibrium(path)
    held = -0.4 * DISPLACED * G
    if motion == "fixed":
        assert found.supports["bodies/buoy/support_force.z"] == pytest.approx(held, rel=1e-9)
        rest = [v for k, v in found.supports.items() if k != "bodies/buoy/support_force.z"]
    else:
        forces = [found.reactions[f"joints/weld/reaction_force.{c}"] for c in "xyz"]
        assert np.linalg.norm(forces) == pytest.approx(-held, rel=1e-9)
        rest = [v for k, v in found.reactions.items() if "moment" in k]
        assert not found.supports
    np.testing.assert_allclose(rest, 0.0, atol=1e-9 * abs(held))
    np.testing.assert_allclose(found.offsets["buoy"], 0.0, atol=1e-12)
    capsys.readouterr()
    assert cli.main(["equilibrium", str(path)]) == 0
    assert f"{abs(held):.1f}" in capsys.readouterr().out
    assert cli.main(["equilibrium", str(path), "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["supports"] == pytest.approx(found.supports)


def test_an_eccentric_fixed_body_is_held_against_its_moment() -> None:
    """Its centre of buoyancy lies 0.5 m ahead of the centre of gravity."""
    block = body("block", "fixed", 100.0, [1.0, 2.0, -3.0])
    block |= {"volume": 0.3, "center_of_buoyancy": [1.5, 2.0, -3.0]}
    tables = case([block], 1.0, environment={"water_density": RHO})
    held = hydrodae.equilibrium(case_of(tables)).supports
    lift = RHO * G * 0.3
    assert held["bodies/block/support_force.z"] == pytest.approx(100.0 * G - lift)
    assert held["bodies/block/support_moment.y"] == pytest.approx(0.5 * lift)  # bow up is < 0


@pytest.mark.parametrize("method", METHODS)
def test_monopile_alone_reports_the_load_of_the_wave(method: str) -> None:
    """Inertia of a pile in Airy waves: rho 2 A g a tanh(kh), at most, across it (Morison)."""
    results = run_tables(pile(), method=method, **METHODS[method])
    area = np.pi / 4.0 * DIAMETER**2
    omega = 2.0 * np.pi / PERIOD
    k = float(wavenumber(omega, DEPTH, G))
    most = 2.0 * RHO * area * G * WAVE * np.tanh(k * DEPTH)
    force = results["bodies/pile/support_force"].values
    exact = most * np.sin(omega * results.time)  # holds against -sin
    np.testing.assert_allclose(force[:, 0], exact, atol=2e-4 * most)
    arm = DEPTH - 1.0 / k * np.tanh(0.5 * k * DEPTH)  # of the force, above the bed
    moment = results["bodies/pile/support_moment"].values
    np.testing.assert_allclose(moment[:, 1], exact * (arm - 10.0), atol=2e-3 * most)
    text = results.summary()
    assert "at rest" in text
    shown = re.search(r"support_force.x .*?(-?\d\S*) at .* to (\S+) at", text)
    assert shown
    assert float(shown[2]) == pytest.approx(most, rel=1e-2)
    titles = [panel.quantity for panel in overview(results)]
    assert "support force" in titles
    assert "support moment" in titles


def test_states_of_what_cannot_move() -> None:
    """A step that is taken back leaves the loads as they were."""
    simulation = hydrodae.Simulation(case_of(pile()))
    while simulation.time < 5.0:
        simulation.advance()
    state = simulation.state()
    load = np.asarray(simulation.read("bodies/pile/support_force"))
    simulation.advance()
    simulation.restore(state)
    np.testing.assert_array_equal(np.asarray(simulation.read("bodies/pile/support_force")), load)


def test_what_moves_beside_a_fixed_body_leaves_its_loads_in_the_summary() -> None:
    other = body("other", "surge", 1.0, [0.0, 50.0, 0.0], velocity=[0.1, 0.0, 0.0])
    text = run_tables(pile(other)).summary()
    assert "at rest" not in text
    assert "bodies/pile/support_force.x" in text
    assert "bodies/other/support" not in text  # weight alone
