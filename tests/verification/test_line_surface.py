"""Lines, loads and points at the surface of the water: what is above it has its dry weight."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table, body, case
from tests.python.moordyn_decks import FLOAT, PLATFORM
from tests.verification.blocks import case_of, run_tables

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel

RHO_G = 1025.0 * 9.81


@pytest.mark.parametrize("kind", ["catenary", "line", "without dry weights"])
def test_a_float_between_two_chains_stays_at_the_surface(kind: str, tmp_path: Path) -> None:
    """MoorPy 1.3: 391516 N at the fairlead, 266701 N at the anchor."""
    deck = tmp_path / "deck.txt"
    deck.write_text(FLOAT)
    made = hydrodae.mooring.read_moordyn(deck, type="line" if kind == "line" else "catenary")
    if kind == "without dry weights":
        del made.forces[0]["dry_weight"], made.forces[0]["dry_loads"]
    text = PLATFORM.replace("1025.0", "1025.0\nwater_depth = 150.0") + made.to_toml()
    simulation = hydrodae.Simulation(hydrodae.Case.from_text(text))
    read = [
        float(simulation.read(f"forces/line1_2_3/{key}")) for key in ("tension", "tension_anchor")
    ]
    assert read == pytest.approx([391516.0, 266701.0], rel=2e-3)


def hung(x: float, z: float, **more: Any) -> hydrodae.Catenary:
    """Two parts of 60 m with a load of a displacement of 5 m3 between them."""
    given: dict[str, Any] = {"weight": [870.0, -20.0], "loads": [2e4], "dry_weight": [1000.0, 30.0]}
    given |= {"dry_loads": [2e4 + 5.0 * RHO_G], "seabed": False}
    return hydrodae.catenary(x, z, [60.0, 60.0], stiffness=[1e7, 1e7], **(given | more))


@pytest.mark.parametrize("surface", [-200.0, 200.0])
def test_out_of_the_water_a_line_has_its_dry_weights_and_deep_in_it_the_others(
    surface: float,
) -> None:
    dry: dict[str, Any] = (
        {"weight": [1000.0, 30.0], "loads": [2e4 + 5.0 * RHO_G]} if surface < 0.0 else {}
    )
    found, alone = hung(90.0, 10.0, surface=surface), hung(90.0, 10.0, **dry)
    assert found.tension == pytest.approx(alone.tension, rel=1e-12)
    assert found.stiffness == pytest.approx(alone.stiffness, rel=1e-9)


def test_a_load_that_is_half_in_the_water_has_half_of_its_buoyancy() -> None:
    """Vertical balance of a load at the surface by the forces on both ends."""
    free: dict[str, Any] = {"weight": [1e-3, 1e-3], "dry_weight": [1e-3, 1e-3]}
    line = hung(0.0, 119.0, surface=59.2, **free)
    at = float(np.interp(60.0, line.s, line.z))
    radius = (0.75 * 5.0 / math.pi) ** (1.0 / 3.0)
    below = radius - (at - 59.2)  # height of the cap in the water
    cap = math.pi * below**2 * (3.0 * radius - below) / 3.0
    pull = line.vertical - math.copysign(line.tension_anchor, line.z[1] - line.z[0])
    assert 0.0 < below < 2.0 * radius
    weight = 2e4 + (5.0 - cap) * RHO_G + 120.0 * 1e-3
    assert pull == pytest.approx(weight, rel=1e-6)


def test_a_part_that_floats_on_the_surface_is_refused() -> None:
    with pytest.raises(CaseError, match=r"lies on the surface.*type 'line'"):
        hung(110.0, 0.0, weight=[-20.0, -20.0], loads=[0.0], dry_loads=[0.0], surface=0.0)
    with pytest.raises(CaseError, match=r"0.5 N/m out of the water, 870 N/m in it"):
        hung(110.0, 0.0, dry_weight=[0.5, 30.0])


@pytest.mark.parametrize("method", ["radau", "explicit_rk"])
def test_a_line_through_the_surface_between_two_bodies_keeps_the_energy(method: str) -> None:
    low, high = [0.0, 0.0, -30.0], [60.0, 5.0, 30.0]
    line = dict(type="catenary", name="line", body_a="low", body_b="high", seabed=False)
    line |= dict(point_a=low, point_b=high, length=[40.0, 45.0], stiffness=[2e6, 2e6])
    line |= dict(weight=[200.0] * 2, dry_weight=[600.0] * 2, loads=[-2e4], dry_loads=[1e4])
    bodies = [body("low", ["surge", "heave"], 3e4, low), body("high", "point", 5e4, high)]
    run = run_tables(case(bodies, 15.0, gravity=0.0, forces=[line]), method=method, rtol=1e-8)
    total, kinetic = run["energy/total"].values, run["energy/kinetic"].values
    assert np.ptp(total) < 1e-6 * kinetic.max()


def test_a_point_with_a_volume_is_a_sphere_that_floats() -> None:
    """Half in the water: the heave period of a sphere of radius R is 2 pi sqrt(2 R / (3 g))."""
    volume = 4.0

    def floating(z: float) -> hydrodae.Case:
        ball = body("float", "point", 512.5 * volume, [0, 0, z], displacement=[0.0, 0.0, 6.0])
        stay = dict(type="mooring_matrix", name="stay", body="float", stiffness=[1, 1, 0, 0, 0, 0])
        water: Table = {"environment": {"water_density": 1025.0}}
        tables = case([ball | {"volume": volume}], 4.0, forces=[stay], **water)
        return case_of(tables, rtol=1e-8)

    dropped = floating(-0.3)
    assert hydrodae.equilibrium(dropped).offsets["float"][2] == pytest.approx(0.3, abs=1e-8)
    radius = (0.75 * volume / math.pi) ** (1.0 / 3.0)
    period = min(mode.period for mode in LinearModel(floating(0.0)).modes())
    assert period == pytest.approx(2.0 * math.pi * math.sqrt(2.0 * radius / (3.0 * 9.81)), rel=1e-6)
    run = hydrodae.run(dropped)  # from the air
    assert np.ptp(run["energy/total"].values) < 1e-6 * run["energy/kinetic"].values.max()
