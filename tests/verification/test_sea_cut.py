"""A spectrum that reaches beyond the frequencies of the database."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.errors import wrong

import hydrodae
from hydrodae import _core

CASE = """
[hydro]
database = "short.h5"

[[wave]]
name = "sea"
type = "jonswap"
significant_height = 1.0
peak_period = {period}
{more}

[[body]]
name = "sphere"
hydro = "sphere"
motion = "heave"
mass = 261.8e3
center_of_gravity = [0.0, 0.0, -2.0]

[solver]
end_time = 5.0
"""
LAST = 3.5  # rad/s, where the database ends


@pytest.fixture(scope="module")
def folder(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the sphere's database, cut at 3.5 rad/s."""
    from dataclasses import replace

    from hydrodae.hdb.database import HydroDatabase

    db = HydroDatabase.read(repository / "cases" / "sphere" / "hydro.h5")
    keep = db.omega <= LAST + 1e-9
    parts = ("omega", "added_mass", "radiation_damping", "froude_krylov", "diffraction")
    short = {name: getattr(db, name)[keep] for name in parts}
    path = tmp_path_factory.mktemp("cut")
    replace(db, **short).write(path / "short.h5")
    return path


def case(folder: Path, period: float, more: str = "") -> hydrodae.Case:
    return hydrodae.Case.from_text(CASE.format(period=period, more=more), directory=folder)


def variance_below(period: float, last: float) -> float:
    """Part of the variance of JONSWAP (gamma 3.3) below a frequency, by a sum on a fine grid."""
    w, step = np.linspace(0.02, 60.0, 600_000, retstep=True)
    peak = 2 * np.pi / period
    sigma = np.where(w <= peak, 0.07, 0.09)
    density = w**-5 * np.exp(-1.25 * (peak / w) ** 4)
    density *= 3.3 ** np.exp(-((w / peak - 1) ** 2) / (2 * sigma**2))
    return float(density[w <= last].sum() * step / (density.sum() * step))


def test_the_tail_beyond_the_table_is_cut_and_told(folder: Path) -> None:
    scene = case(folder, 5.0)
    results = hydrodae.run(scene)
    (note,) = (n for n in results.notes if "outside the database" in n)
    told = float(note.split("; ")[1].split(" %")[0]) / 100
    above = 1 - variance_below(5.0, LAST)  # of which 0.5 % are left out anyway
    assert told == pytest.approx(above - 0.005, abs=2e-4)
    waves = np.asarray(_core.wave_components(scene.scene))
    assert waves[:, 0].max() <= LAST * (1 + 1e-12)
    held = 0.5 * np.sum(waves[:, 2] ** 2) * 16  # of Hs^2 = 1 m2
    assert held == pytest.approx(1 - told - 0.006, abs=2e-4)
    assert note in results.summary()


def test_a_sea_inside_the_table_is_as_before(folder: Path, repository: Path) -> None:
    inside = case(folder, 9.0)
    whole = hydrodae.Case.from_text(
        CASE.replace("short.h5", "hydro.h5").format(period=9.0, more=""),
        directory=repository / "cases" / "sphere",
    )
    ours, theirs = (np.asarray(_core.wave_components(c.scene)) for c in (inside, whole))
    assert np.array_equal(ours, theirs)
    assert not any("outside the database" in note for note in hydrodae.run(inside).notes)


def test_too_much_beyond_the_table_is_refused(folder: Path) -> None:
    with wrong("wave.sea.lost_variance"):
        hydrodae.run(case(folder, 2.2))
    allowed = case(folder, 2.2, "lost_variance = 0.6")
    assert any("outside the database" in note for note in hydrodae.run(allowed).notes)
    with wrong("wave.sea.lost_variance"):
        hydrodae.run(case(folder, 5.0, "lost_variance = 0.001"))


def test_a_range_that_was_asked_for_is_not_cut(folder: Path) -> None:
    with wrong("wave.sea.frequency_range"):
        hydrodae.run(case(folder, 5.0, "frequency_range = [0.5, 4.5]"))


def test_a_regular_wave_outside_stays_an_error(folder: Path) -> None:
    text = CASE.format(period=5.0, more="")
    text = text.replace('"jonswap"', '"regular"').replace("significant_height", "height")
    text = text.replace("peak_period = 5.0", "period = 1.5")
    with wrong("wave.sea.period"):
        hydrodae.run(hydrodae.Case.from_text(text, directory=folder))


def test_the_frequency_domain_takes_the_same_sea(folder: Path) -> None:
    from hydrodae.linear import LinearModel

    deviation, _ = LinearModel(case(folder, 5.0)).irregular()
    assert deviation["sea/elevation"] == pytest.approx(
        0.25 * np.sqrt(variance_below(5.0, LAST) - 0.001), rel=1e-3
    )
