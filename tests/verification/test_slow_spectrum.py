"""Slow loads and slow motion of `rao` and `spectral`: own values, closed forms, invariance."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.errors import wrong
from tests.python.test_hdb_second_order import floating
from tests.verification.test_second_order_loads import OMEGA, WAVES, made_up, write

import hydrodae
from hydrodae import hdb
from hydrodae.commands import cli
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.linear import LinearModel
from hydrodae.study.slow import SlowMotion, slow_motion
from hydrodae.study.slow.loads import SlowLoads

SEA = """type = "jonswap"
significant_height = 4.0
peak_period = 8.0
frequency_range = [0.55, 2.0]"""


def case(
    folder: Path,
    load: str,
    wave: str,
    *,
    hydro: str = "float",
    mass: float = 1.0e6,
    spring: tuple[float, float] = (7.0e4, 1.0e5),
    cog: tuple[float, ...] = (0.0, 0.0, 0.0),
) -> hydrodae.Case:
    """A body that surges on a spring, with the tables of `hydro.h5`."""
    return hydrodae.Case.from_text(
        f"""
[hydro]
database = "hydro.h5"
radiation = "none"
[second_order]
loads = ["{load}"]
[[body]]
name = "body"
hydro = "{hydro}"
motion = "surge"
mass = {mass}
inertia = [1e9, 1e9, 1e9]
center_of_gravity = {list(cog)}
[[force]]
name = "mooring"
type = "mooring_matrix"
body = "body"
stiffness = [{spring[0]}, 0, 0, 0, 0, 0]
damping = [{spring[1]}, 0, 0, 0, 0, 0]
[[wave]]
name = "sea"
{wave}
[solver]
start = "equilibrium"
end_time = 10.0
""",
        directory=folder,
    )


def components(waves: list[tuple[float, float, float]]) -> str:
    w, a, phase = (list(column) for column in zip(*waves, strict=True))
    return f'type = "components"\nomega = {w}\namplitude = {a}\nphase = {phase}'


def slow(case: hydrodae.Case) -> SlowMotion:
    found = slow_motion(LinearModel(case))
    assert found is not None
    return found


def constant_drift(drift: float) -> SecondOrderTable:
    """Mean drift in surge that is the same at all frequencies."""
    omega, one = np.linspace(0.3, 2.4, 8), np.zeros(1)
    values, all_of = np.full((8, 1, 1), drift, dtype=complex), np.ones((8, 1, 1), bool)
    return SecondOrderTable(
        "mean", ("float.surge",), ("momentum",), omega, one, one, values, all_of
    )


@pytest.fixture(scope="module")
def oc4(reference: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the tables of the semisubmersible, which has no waves of first order."""
    folder = tmp_path_factory.mktemp("oc4")
    source = reference / "second_order" / "qtf_oc4_wamit" / "marin_semi.1"
    db, _ = hdb.import_database(source, depth=200.0, rho=1025.0, gravity=9.81)
    statics = Hydrostatics(13917.0, np.array([0.0, 0.0, -13.15]), 372.0, np.zeros(5))
    calm = np.zeros((db.omega.size, 1, 6), dtype=complex)
    bodies = {"marin_semi": Body("marin_semi", np.zeros(3), statics)}
    db = replace(db, bodies=bodies, heading=np.zeros(1), froude_krylov=calm, diffraction=calm)
    db.write(folder / "hydro.h5")
    return folder


def test_own_values_of_the_semisubmersible(oc4, reference):
    """Mean and spectrum of the load within 1 %; surge by a quadrature over these own values."""
    own = reference / "second_order" / "own_values" / "slow_spectrum.csv"
    known = np.genfromtxt(own, delimiter=",", skip_header=1)
    mass, k, c = 14.265e6, 7.0e4, 1.0e5
    found = slow(case(oc4, "difference", SEA, hydro="marin_semi", mass=mass, spring=(k, c)))
    assert found.mean == pytest.approx([86160.0], rel=2e-3)
    spectrum = np.interp(known[:, 0], found.omega, found.spectrum[:, 0])
    np.testing.assert_allclose(spectrum, known[:, 1], rtol=1e-2)
    assert found.offset["bodies/body/surge"] == pytest.approx(86160.0 / k, rel=2e-3)
    db = hdb.HydroDatabase.read(oc4 / "hydro.h5")
    w = np.linspace(1e-4, 0.3, 30001)
    added = np.interp(w, db.omega, db.added_mass[:, 0, 0])
    damping = c + np.interp(w, db.omega, db.radiation_damping[:, 0, 0])
    square = np.abs(k - w**2 * (mass + added) + 1j * w * damping) ** 2
    rms = np.sqrt(np.trapezoid(np.interp(w, known[:, 0], known[:, 1]) / square, w))
    assert found.standard_deviation["bodies/body/surge"] == pytest.approx(rms, rel=1e-2)


def test_offset_of_the_moored_hemisphere(reference, tmp_path):
    """F A^2 / K in a regular wave, with the mean drift as it stands in the file of WAMIT."""
    folder = reference / "second_order" / "wecsim_mean_drift_sphere"
    db, _ = hdb.import_database(folder / "sphere.out")
    name = next(iter(db.bodies))
    db.write(tmp_path / "hydro.h5")
    rows = [line.split() for line in (folder / "sphere.7").read_text().splitlines()]
    numbers = [list(map(float, row)) for row in rows if len(row) == 8 and row[0][0].isdigit()]
    period, *_, per_unit, _ = min(
        (row for row in numbers if row[3] == 1), key=lambda row: abs(row[0] - 1.9)
    )
    drift = db.rho * db.gravity * per_unit
    wave = f'type = "regular"\nperiod = {period}\nheight = 0.1'
    cog = tuple(map(float, db.reference_point(name)))
    moored = case(tmp_path, "mean", wave, hydro=name, mass=2094.4, spring=(500.0, 1e3), cog=cog)
    found = slow(moored)
    assert found.offset["bodies/body/surge"] == pytest.approx(drift * 0.05**2 / 500.0, rel=1e-6)
    assert found.standard_deviation["bodies/body/surge"] == 0.0


def test_constant_drift_in_a_sea(tmp_path):
    """Newman's load D |A|^2 has the mean 2 m0 D and the same standard deviation."""
    write(tmp_path, constant_drift(1.0e3))
    found = slow(case(tmp_path, "newman", SEA))
    m0 = LinearModel(case(tmp_path, "newman", SEA)).irregular()[0]["sea/elevation"] ** 2
    assert found.mean == pytest.approx([2.0e3 * m0], rel=1e-3)
    assert found.load_deviation == pytest.approx([2.0e3 * m0], rel=1e-3)


@pytest.mark.parametrize("place", [0.0, 40.0])
def test_two_waves(tmp_path, place):
    """A line at the difference: a1 a2 sqrt 2 |T / Z|, wherever the body stands."""
    write(tmp_path, made_up(), owner=floating((place, 0.0, 0.0)))
    waves = [WAVES[0], WAVES[1]]
    moored = case(tmp_path, "difference", components(waves), cog=(place, 0.0, 0.0))
    found = slow(moored)
    table = made_up().values[:, :, 0, 0]
    (w1, a1, _), (w2, a2, _) = waves
    i, j = (int(np.abs(OMEGA - w).argmin()) for w in (w2, w1))
    assert found.mean == pytest.approx([(a1**2 * table[j, j] + a2**2 * table[i, i]).real], rel=1e-9)
    pairs = SlowLoads(LinearModel(moored), "difference").pairs(np.array([1]), np.array([0]))
    assert pairs[0, 0] == pytest.approx(table[i, j], rel=1e-9)  # phases are at the origin
    load = np.sqrt(2.0) * a1 * a2 * abs(table[i, j])
    assert found.load_deviation == pytest.approx([load], rel=1e-9)
    w, db = w2 - w1, hdb.HydroDatabase.read(tmp_path / "hydro.h5")
    mass = 1.0e6 + db.added_mass[0, 0, 0]
    z = 7.0e4 - w**2 * mass + 1j * w * (1.0e5 + db.radiation_damping[0, 0, 0] * (w / 0.5) ** 3)
    motion = found.standard_deviation["bodies/body/surge"]
    assert motion == pytest.approx(load / abs(z), rel=1e-6)


def test_many_components_agree_with_the_continuous_sea(tmp_path, monkeypatch):
    write(tmp_path, constant_drift(1.0e3))
    one = slow(case(tmp_path, "newman", SEA))
    monkeypatch.setattr("hydrodae.study.slow.sea._is_continuous", lambda *_: False)
    other = slow(case(tmp_path, "newman", SEA + "\ncomponents = 800"))
    assert other.omega.size == 0
    for name, value in one.standard_deviation.items():
        assert other.standard_deviation[name] == pytest.approx(value, rel=0.02)


def test_what_is_reported(tmp_path, capsys):
    """Text and JSON of both commands; a free body has no offset; waves outside are refused."""
    write(tmp_path, constant_drift(1.0e3))
    path = tmp_path / "case.toml"
    path.write_text(case(tmp_path, "newman", SEA).text)
    for command in ("rao", "spectral"):
        assert cli.main([command, str(path)]) == 0
        assert "slow motion about it" in capsys.readouterr().out
        assert cli.main([command, str(path), "--json"]) == 0
        told = json.loads(capsys.readouterr().out)["slow_motion"]
        assert told["offset"]["bodies/body/surge"] == pytest.approx(told["mean_load"][0] / 7e4)
    free = slow(case(tmp_path, "newman", SEA, spring=(0.0, 1e5)))
    assert not free.offset
    assert not free.standard_deviation
    assert "nothing holds" in free.notes[0]
    write(tmp_path, made_up())
    with wrong("second_order.loads"):
        slow(case(tmp_path, "difference", components([(1.8, 0.1, 0.0)])))
