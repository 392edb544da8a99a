"""Quasi-static mooring lines: the function, the force, and the statics of what they moor."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import ORIGIN, Table, Vector, body, case
from tests.errors import wrong
from tests.verification.blocks import case_of, run_tables

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel


def chain(x: float, z: float) -> hydrodae.Catenary:
    """400 m of chain of 1200 N/m, EA = 5e7 N, on the seabed."""
    return hydrodae.catenary(x, z, 400.0, 1200.0, 5e7)


def test_reference_lines(reference: Path) -> None:
    """47 lines solved with 40 digits: forces, stiffness, length on the bed, profile."""
    cases = json.loads((reference / "rope" / "catenary.json").read_text())["cases"]
    assert len(cases) == 47
    for c in cases:
        bed = c["type"] != "suspended"
        line = hydrodae.catenary(
            c["X"],
            c["Z"],
            c["L"],
            c["w"],
            c["EA"],
            seabed=bed,
            friction=c["CB"] or 0.0,
            n=len(c["profile_s_x_z_T"]),
        )
        size = np.max(np.abs(c["K_inplane"]))
        assert line.horizontal == pytest.approx(c["H"], rel=1e-10), c["name"]
        assert line.vertical == pytest.approx(c["V"], rel=1e-10), c["name"]
        assert line.stiffness == pytest.approx(np.array(c["K_inplane"]), abs=1e-9 * size)
        assert line.out_of_plane == pytest.approx(c["K_out_of_plane"], rel=1e-9)
        assert line.on_seabed == pytest.approx(c["L_on_bed"], abs=1e-8 * c["L"])
        lost = (c["CB"] or 0.0) * c["w"] * c["L_on_bed"]
        anchor = max(0.0, c["H"] - lost) if bed else c["T_anchor"]
        assert line.tension_anchor == pytest.approx(anchor, abs=1e-8 * line.tension)
        profile = np.array(c["profile_s_x_z_T"])
        assert line.s == pytest.approx(profile[:, 0], abs=1e-9 * c["L"])
        assert line.x == pytest.approx(profile[:, 1], abs=1e-8 * c["L"])
        assert line.z == pytest.approx(profile[:, 2], abs=1e-8 * c["L"])
        # At the anchor one of the stored tensions is not that of its own formula.
        assert line.tension_along[1:] == pytest.approx(profile[1:, 3], abs=1e-8 * line.tension)


def test_a_stiff_line_is_the_curve_of_the_textbook() -> None:
    """Inextensible and level: sag and tension of z = a cosh(x / a)."""
    a, half = 80.0, 50.0
    length = 2.0 * a * math.sinh(half / a)
    line = hydrodae.catenary(2.0 * half, 0.0, length, 50.0, 1e14, seabed=False)
    assert line.horizontal == pytest.approx(50.0 * a, rel=1e-8)
    assert -line.z.min() == pytest.approx(a * (math.cosh(half / a) - 1.0), rel=1e-8)


def test_bad_lines_are_refused() -> None:
    with pytest.raises(CaseError, match="as many numbers in 'weight'"):
        hydrodae.catenary(1.0, 1.0, [1.0, 2.0], 1.0, 1.0)
    with pytest.raises(CaseError, match="type 'rope'"):
        hydrodae.catenary(1.0, 1.0, 1.0, 0.0, 1.0)
    with pytest.raises(CaseError, match="down on the seabed"):
        hydrodae.catenary(40.0, 5.0, [30.0, 30.0], [-1.0, 10.0], [1e4, 1e4])
    with pytest.raises(CaseError, match="below the seabed"):
        hydrodae.catenary(1.0, -1.0, 1.0, 1.0, 1.0)


def line_to(name: str, x: float, y: float) -> Table:
    line: Table = dict(
        type="catenary", name=name, body_b="buoy", point_a=[x, y, -50.0], point_b=[0.0] * 3
    )
    return line | dict(length=[400.0], weight=[1200.0], stiffness=[5e7])


def moored(start: Vector = ORIGIN, end: float = 1.0, **line: Any) -> Table:
    """A point mass on three lines, its weight borne by a constant load."""
    lift = 2e5 * 9.81 + 3.0 * chain(385.0, 50.0).vertical
    water = dict(type="mooring_matrix", name="water", body="buoy", stiffness=[0, 0, 5e5, 0, 0, 0])
    forces = [dict(type="constant_load", name="lift", body="buoy", force=[0, 0, lift]), water]
    for k in range(3):
        angle = 2.0 * math.pi * k / 3.0
        forces.append(line_to(f"line{k}", 385.0 * math.cos(angle), 385.0 * math.sin(angle)) | line)
    buoy = body("buoy", ["surge", "sway", "heave"], 2e5, displacement=start)
    return case([buoy], end, forces=forces, output={"step": 0.1})


def test_three_lines_hold_a_buoy_with_the_stiffness_of_the_closed_form() -> None:
    """K_x = 3/2 (k + H / X), K_z = 3 k_zz + hydrostatics: the linear model's frequencies."""
    model = LinearModel(case_of(moored()))
    line = chain(385.0, 50.0)
    horizontal = 1.5 * (line.stiffness[0, 0] + line.out_of_plane)
    vertical = 3.0 * line.stiffness[1, 1] + 5e5
    expected = sorted([math.sqrt(horizontal / 2e5), math.sqrt(vertical / 2e5)])
    found = sorted(2.0 * math.pi / mode.period for mode in model.modes())
    assert found == pytest.approx([expected[0], expected[0], expected[1]], rel=1e-7)


@pytest.mark.parametrize("method", ["ida", "radau", "explicit_rk"])
def test_a_moored_buoy_keeps_its_energy(method: str) -> None:
    """From taut to slack and back, without damping."""
    tables = moored([8.0, 2.0, 0.0], 60.0)
    run = run_tables(tables, method=method, rtol=1e-8)
    total, kinetic = run["energy/total"].values, run["energy/kinetic"].values
    assert np.ptp(total) < 2e-6 * kinetic.max()
    tension = run["forces/line0/tension"].values
    place = run["bodies/buoy/position"].values
    for k in (0, 150, 300, 600):
        d = place[k] - np.array([385.0, 0.0, -50.0])
        line = chain(float(np.hypot(d[0], d[1])), float(d[2]))
        assert tension[k] == pytest.approx(line.tension, rel=1e-9)
        assert run["forces/line0/length_on_seabed"].values[k] == pytest.approx(
            line.on_seabed, abs=1e-6
        )


def test_pretension_gives_the_length() -> None:
    line = chain(385.0, 50.0)
    tables = moored(length=[430.0], pretension=line.tension)
    simulation = hydrodae.Simulation(case_of(tables))
    assert simulation.read("forces/line1/tension") == pytest.approx(line.tension, rel=1e-9)


def test_a_line_between_two_bodies_pulls_on_both() -> None:
    """A light line between two masses in the plane: total momentum changes by its weight alone."""
    end = [9.0, 0.0, 1.0]
    line: Table = dict(type="catenary", name="line", body_a="a", body_b="b", point_a=[0.0] * 3)
    line |= dict(point_b=end, length=[6.0, 6.0], weight=[3.0, 5.0], stiffness=[2e4, 2e4])
    line |= dict(loads=[10.0], seabed=False)
    plane = ["surge", "heave"]
    bodies = [body("a", plane, 100.0), body("b", plane, 50.0, end)]
    run = run_tables(case(bodies, 2.0, gravity=0.0, forces=[line]), method="radau", rtol=1e-9)
    v_a, v_b = run["bodies/a/velocity"].values, run["bodies/b/velocity"].values
    momentum = 100.0 * v_a + 50.0 * v_b
    assert momentum[:, 0] == pytest.approx(0.0 * run.time, abs=1e-8)
    weight = 6.0 * 3.0 + 6.0 * 5.0 + 10.0
    assert momentum[:, 2] == pytest.approx(-weight * run.time, abs=1e-6)


def test_a_seabed_needs_an_anchor_on_the_ground() -> None:
    tables = moored()
    tables["force"][3]["body_a"] = "buoy"
    with wrong("force.line1.seabed"):
        run_tables(tables)
