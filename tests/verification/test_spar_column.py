"""The floating column of the starter: natural periods, two turbines, a held speed, powers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.case.case import to_toml
from hydrodae.linear import LinearModel
from hydrodae.starters import create

SPEED = "outlets/turbine/rotor_speed"
WINDAGE = 1e-3  # N m s2/rad2, of the starter
#: A Wells turbine of about the flow of the starter's turbine.
WELLS: dict[str, Any] = {
    "type": "wells",
    "diameter": 1.0,
    "speed": 300.0,
    "flow_slope": 0.6,
    "efficiency_at": [0.0, 0.05, 0.1, 0.2, 10.0],
    "efficiency": [0.0, 0.5, 0.6, 0.3, 0.0],
}


@pytest.fixture(scope="module")
def starter(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return create("spar_owc", tmp_path_factory.mktemp("spar") / "spar")


def wells(starter: Path, **more: Any) -> Path:
    """Return a case beside that of the starter with a Wells turbine and these keys."""
    text = starter.read_text()
    begin, end = text.index("[[outlet]]"), text.index("[[force]]")
    lines = [f"{key} = {to_toml(value, key)}" for key, value in {**WELLS, **more}.items()]
    table = "\n".join(['[[outlet]]\nname = "turbine"\nchamber = "air"', *lines])
    out = starter.with_name("wells.toml")
    out.write_text(text[:begin] + table + "\n\n" + text[end:])
    return out


def test_natural_periods(starter: Path) -> None:
    """Of heave and column with open air: the two equations with A at infinite frequency.

    Only the slow part of the memory is left out, so they agree within some per cent.
    """
    scene = wells(starter, speed=1e-3)  # the air goes through at once
    database = hydrodae.hdb.read(starter.parent / "hydro.h5")
    at = [database.coordinates.index(f"spar.{name}") for name in ("heave", "piston")]
    k = int(np.argmin(np.abs(database.omega - 0.55)))
    mass = database.added_mass[k][np.ix_(at, at)] + np.diag([2328.8e3, 1.0])
    whole, pool = np.pi * 8.0**2, 28.274
    stiffness = 1025.0 * 9.81 * np.array([[whole, pool], [pool, pool]])
    expected = np.sort(
        2.0 * np.pi / np.sqrt(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)
    )
    values = [mode.period for mode in LinearModel(hydrodae.Case(path=scene)).modes()]
    for period in expected:
        assert min(abs(np.array(values) / period - 1.0)) < 0.03


def balance(run: Any, name: str) -> None:
    """Check the powers at every instant: pistons give the change of the air's energy and the flow.

    The change is a difference of the samples, so the bound is that of such differences.
    """
    step = float(run.time[1] - run.time[0])
    flow = run[f"outlets/{name}/power"].values.ravel()
    put_in = run["chambers/air/power_absorbed"].values.ravel()
    change = np.gradient(run["chambers/air/energy"].values.ravel(), step)
    late = run.time > 20.0
    size = np.abs(put_in[late]).max()
    assert np.sqrt(np.mean((put_in - flow - change)[late] ** 2)) < 2e-3 * size
    shaft, turbine = (run[f"outlets/{name}/power_{k}"].values.ravel() for k in ("shaft", "turbine"))
    speed = run[f"outlets/{name}/rotor_speed"].values.ravel()
    stored = run[f"outlets/{name}/rotor_energy"].values.ravel()
    lost = WINDAGE * speed**3
    gained = np.trapezoid((turbine - shaft - lost), run.time)
    assert gained == pytest.approx(
        stored[-1] - stored[0], abs=1e-3 * np.trapezoid(turbine, run.time)
    )


def test_biradial_turbine_in_a_sea(starter: Path) -> None:
    values = {"solver.end_time": 150.0, "sea.ramp": 20.0, "output.step": 0.02}
    run = hydrodae.run(starter, set=values)
    assert run.status == "completed"
    assert np.ptp(run[SPEED].values) > 5.0
    balance(run, "turbine")


def test_a_controller_holds_the_speed_of_a_wells_turbine(starter: Path) -> None:
    """A proportional and integral torque, which brakes and drives, keeps the speed within 5 %."""
    free = wells(starter, inertia=60.0, windage=WINDAGE)
    control = {
        "name": "speed", "type": "pid", "inputs": [SPEED], "outputs": ["outlets/turbine/torque"],
        "period": 0.1, "gain_p": -100.0, "gain_i": -20.0, "target": 300.0,
    }  # fmt: skip
    rows = "\n".join(f"{key} = {to_toml(value, key)}" for key, value in control.items())
    held = free.with_name("held.toml")
    held.write_text(free.read_text() + f"\n[[controller]]\n{rows}\n")
    values = {"solver.end_time": 150.0, "sea.ramp": 20.0, "output.step": 0.02}
    run = hydrodae.run(held, set=values)
    late = run.time > 60.0
    speed = run[SPEED].values.ravel()[late]
    assert np.abs(speed / 300.0 - 1.0).max() < 0.05
    assert run["outlets/turbine/power_electric"].values[late].mean() > 1e3
    loose = hydrodae.run(free, set=values)[SPEED].values.ravel()[late]
    assert np.abs(loose / 300.0 - 1.0).max() > 0.1
    balance(run, "turbine")


@pytest.mark.slow
def test_mean_power_of_the_spectral_rung(starter: Path) -> None:
    """Within 5 % of ten runs of ten minutes, with the speed that the spectral rung keeps."""
    values = {
        "solver.end_time": 660.0,
        "solver.accuracy": "none",
        "wave.sea.significant_height": 1.0,
    }
    case = wells(starter)
    expected = hydrodae.spectral(hydrodae.Case(path=case, values=values)).power["air"]
    powers = []
    for seed in range(10):
        run = hydrodae.run(case, set={**values, "wave.sea.seed": seed})
        late = run.time > 60.0
        powers.append(run["chambers/air/power_absorbed"].values[late].mean())
    assert np.mean(powers) == pytest.approx(expected, rel=0.05)
