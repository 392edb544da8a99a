"""Chambers of air: given motion of the column against other integrations and closed forms."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.verification import chambers
from tests.verification.chambers import AREA, DENSITY, EXPONENT, OUTSIDE, TIGHT, VOLUME, integral

import hydrodae
from hydrodae.linear import LinearModel

METHODS = ["ida", "radau", "explicit_rk"]
WELLS: dict[str, Any] = {"diameter": 0.75, "speed": 100.0, "flow_slope": 0.775}
ORIFICE: dict[str, Any] = {"coefficient": 0.62, "area": 0.12}


def add_outlet(scene: hydrodae.Scene, kind: str) -> None:
    if kind == "wells":
        scene.outlet.wells("out", chamber="air", **WELLS)
    elif kind == "orifice":
        scene.outlet.orifice("out", chamber="air", **ORIFICE)


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize(
    ("name", "kind", "size"),
    [
        ("closed_1m", "", 1.0),
        ("wells_01m", "wells", 0.1),
        ("wells_1m", "wells", 1.0),
        ("orifice_1m", "orifice", 1.0),
    ],
)
def test_pressure_above_a_given_column(
    reference: Path, method: str, name: str, kind: str, size: float
) -> None:
    """scipy's own integration of the same equations."""
    file = reference / "owc" / "driven_chamber" / "pressures.csv"
    table = np.genfromtxt(file, delimiter=",", names=True)
    scene = chambers.plant()
    add_outlet(scene, kind)
    scene.output(step=0.5)
    run = chambers.run_driven(scene, chambers.column(size), 120.0, method=method)
    expected = table[f"p_{name}_Pa"]
    error = np.abs(run["chambers/air/pressure"].values - expected).max()
    assert error < 1e-6 * np.ptp(expected)


@pytest.mark.parametrize("method", METHODS)
def test_shut_air_keeps_its_isentrope(method: Any) -> None:
    """A column bounces 1000 times on a shut chamber."""
    rate = np.sqrt(EXPONENT * OUTSIDE * AREA**2 / VOLUME / 1000.0)
    scene = chambers.plant(velocity=0.5 * rate)
    scene.solver(end_time=1000.0 * 2.0 * np.pi / rate, method=method, rtol=1e-7, accuracy="none")
    run = hydrodae.run(scene)
    p, v = run["chambers/air/pressure"].values, run["chambers/air/volume"].values
    kept = (OUTSIDE + p) * v**EXPONENT / (OUTSIDE * VOLUME**EXPONENT)
    assert np.ptp(v) > 10.0
    assert np.abs(kept - 1.0).max() < 1e-9


def test_bounce() -> None:
    """w^2 = (k + n p_a S^2 / V0) / M as an eigenvalue and as a run."""
    mass, spring = 5e4, 1.4e5
    expected = np.sqrt((spring + EXPONENT * OUTSIDE * AREA**2 / VOLUME) / mass)
    small = 1e-5
    scene, rest = chambers.plant(mass, velocity=small * expected), chambers.plant(mass)
    for one in (scene, rest):
        one.force.pto_linear("water", joint="column", stiffness=spring)
        one.solver(end_time=20.0, **TIGHT)
    run = hydrodae.run(scene)
    rise = run["joints/column/displacement"].values
    np.testing.assert_allclose(rise, small * np.sin(expected * run.time), atol=1e-5 * small)
    periods = [mode.period for mode in LinearModel(rest).modes()]
    assert periods == pytest.approx([2.0 * np.pi / expected], rel=1e-6)


@pytest.mark.parametrize("exponent", [1.0, 1.2, 1.4])
def test_small_motion(exponent: float) -> None:
    """p = i w S x / (k / rho_a + i w V0 / (n p_a))."""
    w, x, k = 0.6, 1e-4, 5.8e-3
    scene = chambers.plant(exponent=exponent)
    scene.outlet.porous_plug("out", chamber="air", conductance=k)
    period = 2.0 * np.pi / w
    chambers.drive(scene, amplitude=x, period=period)
    scene.solver(end_time=12.0 * period, **TIGHT)
    scene.output(step=period / 64.0)
    run = hydrodae.run(scene)
    last = slice(-1 - 2 * 64, -1)
    t, p = run.time[last], run["chambers/air/pressure"].values[last]
    found = 2.0 * np.mean(p * np.exp(-1j * w * t)) * 1j  # of x sin(w t)
    expected = 1j * w * AREA * x / (k / DENSITY + 1j * w * VOLUME / (exponent * OUTSIDE))
    assert abs(found / expected - 1.0) < 2e-6


@pytest.mark.parametrize("exponent", [1.0, 1.4])
@pytest.mark.parametrize("kind", ["wells", "orifice"])
def test_what_the_column_does_is_taken_or_stored(kind: str, exponent: float) -> None:
    scene = chambers.plant(exponent=exponent)
    add_outlet(scene, kind)
    scene.output(step=0.01)
    run = chambers.run_driven(scene, chambers.column(1.0), 60.0)
    put_in = integral(run, run["chambers/air/power_absorbed"].values)
    taken = integral(run, run["outlets/out/power"].values)
    stored = run["chambers/air/energy"].values
    assert stored.min() > -1e-6 * stored.max()
    assert put_in - taken - stored[-1] + stored[0] == pytest.approx(0.0, abs=1e-6 * put_in)


def test_a_tank_blows_off() -> None:
    """A tank at 3 bar blows off through an orifice: choked at first, with a closed form.

    Choked m = C A sqrt(2 (1 - r) P rho), isothermal: M' = -c M, the pressure falls exponentially.
    """
    scene = hydrodae.Scene("a tank")
    scene.environment(gravity=0.0, air_density=DENSITY)
    chambers.add_column(scene, "column")
    scene.chamber("air", volume=10.0, exponent=1.0, pressure=2e5)
    scene.outlet.orifice("out", chamber="air", coefficient=0.62, area=0.02)
    scene.solver(end_time=4.0, **TIGHT)
    scene.output(step=0.02)
    run = hydrodae.run(scene)
    pressure = OUTSIDE + run["chambers/air/pressure"].values
    ratio = 1.2**-3.5
    rate = 0.62 * 0.02 * np.sqrt(2.0 * (1.0 - ratio) * OUTSIDE / DENSITY) / 10.0
    choked = pressure * ratio > OUTSIDE
    assert choked.any()
    assert not choked.all()
    expected = (OUTSIDE + 2e5) * np.exp(-rate * run.time)
    np.testing.assert_allclose(pressure[choked], expected[choked], rtol=1e-8)


def test_the_chamber_names_itself_where_no_air_is_left() -> None:
    scene = chambers.plant()
    add_outlet(scene, "orifice")
    with pytest.raises(hydrodae.SolverError, match="no air is left in chamber 'air'") as error:
        chambers.run_driven(scene, lambda t: (0.8 * t, 0.8, 0.0), 20.0)
    assert error.value.time == pytest.approx(VOLUME / AREA / 0.8, abs=0.05)


def test_the_roof_ends_a_run() -> None:
    scene = hydrodae.Scene("a low roof")
    scene.environment(gravity=0.0)
    chambers.add_column(scene, "column")
    scene.chamber("air", volume=VOLUME)
    scene.piston("water", chamber="air", joint="column", area=AREA, roof=2.0)
    add_outlet(scene, "orifice")
    with pytest.raises(
        hydrodae.SolverError, match="piston 'water' of chamber 'air' is at the roof"
    ):
        chambers.run_driven(scene, lambda t: (0.8 * t, 0.8, 0.0), 20.0)


def test_a_volume_of_zero_at_the_start_is_refused() -> None:
    with pytest.raises(hydrodae.CaseError, match="chamber 'air': no air at the start"):
        chambers.run_driven(chambers.plant(), lambda t: (8.0, 0.0, 0.0), 1.0)
