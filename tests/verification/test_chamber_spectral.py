"""Air of chambers linearised in a sea, against closed forms, runs and other derivatives."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.linear import LinearModel

AREA, VOLUME, DENSITY, OUTSIDE = 14.0, 100.0, 1.225, 101325.0
EFFICIENCY: dict[str, Any] = {
    "efficiency_at": [0.0, 0.02, 0.05, 0.1, 0.2, 10.0],
    "efficiency": [0.0, 0.2, 0.55, 0.7, 0.5, 0.4],
}
WELLS: dict[str, Any] = {"diameter": 0.75, "speed": 200.0, "flow_slope": 0.775}
BIRADIAL: dict[str, Any] = {"diameter": 1.0, "speed": 120.0}


def column(kind: str, sea: str = "jonswap", **outlet: Any) -> hydrodae.Scene:
    """Return a body as a piston of water with a spring rho g S, moved by waves, below air."""
    scene = hydrodae.Scene("a column in a sea")
    scene.environment(water_density=1000.0)
    center = [0.0, 0.0, -5.0]
    scene.body("column", motion="heave", mass=5e4, center_of_gravity=center)
    scene.force.constant_load("lift", body="column", force=[0.0, 0.0, 5e4 * 9.81])
    scene.joint.prismatic(
        "guide", body_a="ground", body_b="column", point=center, axis=[0.0, 0.0, 1.0]
    )
    scene.force.pto_linear("water", joint="guide", stiffness=1.4e5, damping=1e4)
    scene.morison(
        "flow", body="column", point=center, volume=50.0, added_mass_coefficient=0.5,
    )  # fmt: skip
    scene.chamber("air", volume=VOLUME)
    scene.piston("surface", chamber="air", joint="guide", area=AREA)
    getattr(scene.outlet, kind)("out", chamber="air", **outlet)
    if sea == "regular":
        scene.wave.regular("sea", height=1.0, period=6.0)
    else:
        scene.wave.jonswap("sea", significant_height=1.5, peak_period=6.5)
    scene.sea(ramp=50.0)
    scene.solver(end_time=600.0)
    scene.output(step=0.2)
    return scene


@pytest.mark.parametrize(
    ("kind", "outlet"),
    [
        ("wells", WELLS),
        ("wells", {**WELLS, "stall": 0.05, "stall_slope": 0.2}),
        ("biradial", BIRADIAL),
        ("impulse", {**BIRADIAL, "coefficient": 0.2, "exponent": 0.5}),
        ("orifice", {"coefficient": 0.62, "area": 0.1}),
        ("porous_plug", {"conductance": 1e-3}),
        ("turbine", {**BIRADIAL, "flow_at": [0.0, 0.1, 0.4, 9.0], "flow": [0.0, 0.04, 0.1, 0.5]}),
    ],
)
def test_slopes_at_rest_are_those_of_the_kernel(kind: str, outlet: dict[str, Any]) -> None:
    model = LinearModel(column(kind, **outlet))
    again = model.with_outlets({})
    for key in ("state_by_state", "state_by_xi"):
        np.testing.assert_allclose(again._model[key], model._model[key], rtol=1e-9)


def test_chambers_on_a_duct_share_their_air() -> None:
    """Two chambers and a duct: pressures against the equations of both masses."""
    scene = column("wells", **WELLS)
    scene.chamber("tank", volume=30.0)
    scene.outlet.porous_plug("duct", chamber="air", to="tank", conductance=4e-3)
    w = np.array([0.5, 1.0, 2.0])
    found = LinearModel(scene).response(w)
    rise = found["joints/guide/displacement"]
    wells, duct = 0.775 * 0.75 / 200.0, 4e-3
    for k, omega in enumerate(w):
        room = [1j * omega * v * DENSITY / (1.4 * OUTSIDE) for v in (VOLUME, 30.0)]
        matrix = np.array([[room[0] + wells + duct, -duct], [-duct, room[1] + duct]])
        p = np.linalg.solve(matrix, [1j * omega * DENSITY * AREA * rise[k], 0.0])
        assert found["chambers/air/pressure"][k] == pytest.approx(p[0], rel=1e-9)
        assert found["chambers/tank/pressure"][k] == pytest.approx(p[1], rel=1e-9)
        assert found["outlets/duct/mass_flow"][k] == pytest.approx(duct * (p[0] - p[1]), rel=1e-9)
        power = 0.5 * (wells * abs(p[0]) ** 2 + duct * abs(p[0] - p[1]) ** 2) / DENSITY
        assert found.power["air"][k] == pytest.approx(power, rel=1e-9)


def test_waves_give_what_is_radiated_absorbed_and_let_out() -> None:
    """The power of the waves is that of the damper and of the air, without any radiation."""
    response = LinearModel(column("wells", **WELLS)).response(np.linspace(0.5, 2.0, 9))
    out = response.power["water"] + response.power["air"]
    np.testing.assert_allclose(response.excitation_power, out, rtol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "outlet"), [("wells", WELLS), ("biradial", BIRADIAL)])
def test_mean_power_is_that_of_ten_runs(kind: str, outlet: dict[str, Any]) -> None:
    found = hydrodae.spectral(column(kind, **outlet, **EFFICIENCY))
    runs = found.time_domain(10, settle=100.0)
    for name in ("air", "outlets/out/power", "outlets/out/power_turbine"):
        assert found.power[name] == pytest.approx(runs.power[name].mean(), rel=0.05)


def test_orifice_in_one_wave() -> None:
    """The pressure of a run has the harmonic of the describing function within 5 %."""
    scene = column("orifice", sea="regular", coefficient=0.62, area=0.1)
    found = hydrodae.spectral(scene)
    run = hydrodae.run(scene, set={"solver.end_time": 200.0, "solver.accuracy": "none"})
    late = slice(-301, -1)  # ten periods
    p, t = run["chambers/air/pressure"].values[late], run.time[late]
    harmonic = abs(2.0 * np.mean(p * np.exp(-2j * np.pi * t / 6.0)))
    expected = 0.5 * abs(found.channel("chambers/air/pressure")[0])
    assert harmonic == pytest.approx(expected, rel=0.05)


@pytest.mark.parametrize("rung", ["frequency", "spectral"])
def test_gradients_of_power(rung: str) -> None:
    """Against central differences of a hundredth, with an error below 1e-3 of the slope."""
    kind, keys = ("wells", WELLS) if rung == "frequency" else ("biradial", BIRADIAL)
    scene = column(kind, **keys)
    names = ["outlet.out.speed", "outlet.out.diameter", "force.water.damping"]
    slopes = hydrodae.gradient(scene, "mean_power_absorbed.air", names, rung=rung).gradient

    def power(values: dict[str, float]) -> float:
        if rung == "spectral":
            return hydrodae.spectral(scene, set=values, tolerance=1e-10).power["air"]
        return hydrodae.rao(scene, set=values, periods=[6.0]).in_sea()[1]["air"]

    for name, slope in zip(names, slopes, strict=True):
        value = {**keys, "damping": 1e4}[name.rpartition(".")[2]]
        ends = [power({name: value * (1.0 + part)}) for part in (-0.01, 0.01)]
        assert slope == pytest.approx((ends[1] - ends[0]) / (0.02 * value), rel=2e-3)


def test_optimise_finds_the_speed(tmp_path: Path) -> None:
    """The best speed of a Wells turbine: no speed of a list has more power."""
    (tmp_path / "case.toml").write_text(column("wells", **WELLS, **EFFICIENCY).to_toml())
    (tmp_path / "study.toml").write_text(
        'case = "case.toml"\nrungs = ["spectral"]\n'
        '[result.power]\nchannel = "outlets/out/power_turbine"\n'
        'statistic = "mean"\n[optimise]\nmaximise = "power"\n'
        '[optimise.parameter.speed]\nkeys = ["outlet.out.speed"]\nbounds = [50.0, 400.0]\n'
    )
    best = hydrodae.optimise(tmp_path / "study.toml", tmp_path / "best.nc")
    scene = column("wells", **WELLS, **EFFICIENCY)
    powers = [
        hydrodae.spectral(scene, set={"outlet.out.speed": s}).power["outlets/out/power_turbine"]
        for s in np.linspace(50.0, 400.0, 15)
    ]
    assert best.value > 0.999 * max(powers)
    assert 51.0 < best.values["speed"] < 399.0


@pytest.mark.parametrize("opens_at", [0.0])
def test_a_valve_that_any_pressure_opens_is_refused(opens_at: float) -> None:
    scene = column("valve", coefficient=0.6, area=0.1, opens_at=opens_at)
    with pytest.raises(hydrodae.CaseError, match="'out': a valve that any pressure opens"):
        hydrodae.spectral(scene)
