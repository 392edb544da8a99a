"""Measured seas, parts of the excitation, and phases that follow the bodies."""

from __future__ import annotations

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.hdb.database import HydroDatabase

BUOY = """
[hydro]
database = "hydro.h5"
{hydro}

[sea]
{sea}

[[body]]
name = "sphere"
hydro = "sphere"
motion = {motion}
mass = 261.8e3
center_of_gravity = [0.0, 0.0, -2.0]

[solver]
end_time = {end}
rtol = 1e-7

[output]
step = 0.1
"""


def buoy(
    waves: str, end: float = 100.0, *, sea: str = "", hydro: str = "", motion: str = '"heave"'
) -> str:
    return BUOY.format(end=end, sea=sea, hydro=hydro, motion=motion) + waves


@pytest.fixture
def sphere(repository: Path) -> Path:
    return repository / "cases" / "sphere"


def run(text: str, folder: Path) -> hydrodae.Results:
    return hydrodae.run(hydrodae.Case.from_text(text, directory=folder))


def regular(name: str, period: float, height: float, phase: float = 0.0) -> str:
    return (
        f'\n[[wave]]\nname = "{name}"\ntype = "regular"\nperiod = {period}\n'
        f"height = {height}\nphase_deg = {phase}\n"
    )


def write_record(path: Path, time: np.ndarray, elevation: np.ndarray) -> None:
    rows = "\n".join(f"{t:.3f},{e:.9g}" for t, e in zip(time, elevation, strict=True))
    path.write_text("time [s],elevation [m]\n" + rows + "\n")


def folder_with(sphere: Path, tmp_path: Path) -> Path:
    shutil.copy(sphere / "hydro.h5", tmp_path / "hydro.h5")
    return tmp_path


def test_record_of_regular_waves(sphere: Path, tmp_path: Path) -> None:
    """Measured 30 m down the waves, the same excitation as that of the waves themselves."""
    waves = [(5.3, 1.0, 20.0), (7.9, 1.6, -80.0), (12.0, 0.7, 140.0)]
    folder = folder_with(sphere, tmp_path)
    time = np.arange(0.0, 200.05, 0.1)
    elevation = np.full(time.size, 0.4)  # an offset of the gauge
    for period, height, phase in waves:
        w = 2 * np.pi / period
        k = w**2 / 9.81
        elevation += 0.5 * height * np.cos(w * (time - 50.0) - 30.0 * k + np.radians(phase))
    write_record(folder / "gauge.csv", time, elevation)
    measured = '\n[[wave]]\nname = "gauge"\ntype = "measured"\nfile = "gauge.csv"\npoint = [30.0, 7.0]\nstart = 50.0\ntaper = 35.0\n'  # noqa: E501
    ours = run(buoy(measured), folder)
    exact = run(buoy("".join(regular(f"w{k}", *w) for k, w in enumerate(waves))), folder)
    assert any(
        "of the record taken off" in note and "of its variance" in note for note in ours.notes
    )
    for channel in ("forces/excitation/sphere/force", "sea/elevation"):
        a, b = ours[channel].values, exact[channel].values
        np.testing.assert_allclose(a, b, atol=2e-4 * abs(b).max())


def test_record_of_our_own_sea_gives_the_same_motion(sphere: Path, tmp_path: Path) -> None:
    folder = folder_with(sphere, tmp_path)
    sea = '\n[[wave]]\nname = "wind"\ntype = "jonswap"\nsignificant_height = 2.0\npeak_period = 8.0\ncomponents = 100\nfrequency_range = [0.4, 2.5]\n'  # noqa: E501
    first = run(buoy(sea, 300.0), folder)
    write_record(folder / "gauge.csv", first.time, first["sea/elevation"].values)
    measured = '\n[[wave]]\nname = "gauge"\ntype = "measured"\nfile = "gauge.csv"\nstart = 20.0\n'
    second = run(buoy(measured, 260.0), folder)
    x, y = (r["bodies/sphere/position"].values[:, 2] + 2.0 for r in (first, second))
    # The free motion of either start has died out after 80 s.
    difference = y[800:] - x[1000:2801]
    assert np.std(difference) < 2e-3 * np.std(x[1000:2801])


@pytest.mark.parametrize(
    ("text", "more", "message"),
    [
        ("time,elevation\n0,0\n0.5,x\n", "", "gauge.csv:3:5: elevation must be a number, got 'x'"),
        ("time,eta\n0,0\n", "", "gauge.csv:1: expected the names of the columns"),
        (None, "start = 150.0", "the run needs it from 150 s to 250 s"),
        (None, "height = 1.0", "unknown key 'height'"),
        (None, "frequency_range = [0.1, 0.6]", "% of the variance lies outside"),
        (None, "frequency_range = [0.01, 1.0]", "is outside the database"),
        ("uneven", "", "the record must have equal steps of time"),
        (None, "time = [0.0, 1.0]", "give either 'file', or 'time' and 'elevation'"),
    ],
)
def test_bad_records(
    sphere: Path, tmp_path: Path, text: str | None, more: str, message: str
) -> None:
    folder = folder_with(sphere, tmp_path)
    time = np.arange(0.0, 200.05, 0.1)
    if text == "uneven":
        time[500:] += 0.05
    if text is None or text == "uneven":
        write_record(folder / "gauge.csv", time, np.cos(0.8 * time) + np.cos(0.05 * time))
    else:
        (folder / "gauge.csv").write_text(text)
    wave = f'\n[[wave]]\nname = "gauge"\ntype = "measured"\nfile = "gauge.csv"\nlost_variance = 0.6\n{more}\n'  # noqa: E501
    with pytest.raises(CaseError) as error:
        run(buoy(wave), folder)
    assert message in str(error.value)


def test_parts_of_the_excitation(sphere: Path, tmp_path: Path) -> None:
    """Froude-Krylov and diffraction are those of the database and add up, in work as well."""
    omega = 1.0
    results = run(buoy(regular("swell", 2 * np.pi / omega, 2.0), 20.0), sphere)
    parts = {
        name: results[f"forces/{name}/sphere/force"].values[:, 2]
        for name in ("excitation", "froude_krylov", "diffraction")
    }
    np.testing.assert_allclose(
        parts["froude_krylov"] + parts["diffraction"], parts["excitation"], rtol=0, atol=1e-6
    )
    db = HydroDatabase.read(sphere / "hydro.h5")
    (k,) = np.flatnonzero(np.isclose(db.omega, omega))
    i = db.index(["sphere.heave"])[0]
    for name in ("froude_krylov", "diffraction"):
        exact = (getattr(db, name)[k, 0, i] * np.exp(1j * omega * results.time)).real
        np.testing.assert_allclose(parts[name], exact, atol=1e-6 * abs(exact).max())
    work = {name: results[f"energy/work/{name}"].values for name in parts}
    np.testing.assert_allclose(
        work["froude_krylov"] + work["diffraction"],
        work["excitation"],
        atol=1e-9 * abs(work["excitation"]).max(),
    )
    assert results.statistics["relative_balance_error"] < 1e-5
    # A source that gives the sum alone has no parts.
    folder = folder_with(sphere, tmp_path)
    with h5py.File(folder / "hydro.h5", "r+") as file:
        file["excitation"].attrs["split"] = "total only"
    total = run(buoy(regular("swell", 2 * np.pi / omega, 2.0), 20.0), folder)
    assert "forces/froude_krylov/sphere/force" not in total
    np.testing.assert_array_equal(
        total["forces/excitation/sphere/force"].values[:, 2], parts["excitation"]
    )


def test_encounter_frequency_of_a_towed_body(sphere: Path) -> None:
    """At speed U along the waves the excitation has the frequency w - k U."""
    omega, speed = 1.0, 1.7
    tow = f'\n[[constraint]]\nname = "tow"\ntype = "coordinate"\nbody = "sphere"\ncoordinate = "surge"\ndrive = {{ rate = {speed} }}\n'  # noqa: E501
    wave = regular("swell", 2 * np.pi / omega, 2.0, 30.0)
    text = buoy(
        wave + tow,
        40.0,
        sea='phase = "moving"',
        hydro='radiation = "none"',
        motion='["surge", "heave"]',
    )
    results = run(text, sphere)
    db = HydroDatabase.read(sphere / "hydro.h5")
    (k,) = np.flatnonzero(np.isclose(db.omega, omega))
    force = db.excitation[k, 0, db.index(["sphere.surge", "sphere.heave"])]
    encounter = omega - omega**2 / 9.81 * speed
    exact = (force * np.exp(1j * (encounter * results.time[:, None] + np.radians(30.0)))).real
    found = results["forces/excitation/sphere/force"].values[:, [0, 2]]
    np.testing.assert_allclose(found, exact, atol=1e-6 * abs(exact).max())
    np.testing.assert_allclose(
        results["sea/elevation"].values, np.cos(omega * results.time + np.radians(30.0)), atol=1e-12
    )
    assert any("phase of the waves follows" in note for note in results.notes)


def test_phase_of_a_body_that_stays(sphere: Path) -> None:
    waves = regular("a", 6.0, 1.0) + regular("b", 9.0, 1.0, 45.0)
    fixed, moving = (
        run(buoy(waves, 50.0, sea=f'phase = "{phase}"'), sphere) for phase in ("fixed", "moving")
    )
    for channel in ("bodies/sphere/position", "forces/excitation/sphere/force"):
        np.testing.assert_allclose(
            fixed[channel].values, moving[channel].values, rtol=1e-6, atol=1e-4
        )
