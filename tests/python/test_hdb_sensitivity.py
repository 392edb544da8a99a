"""`hydrodae hdb sensitivity`: what a result owes to the database."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae import hdb
from hydrodae.commands.cli import main
from hydrodae.study.sensitivity import sensitivity
from hydrodae.study.sensitivity.variants import cut_memory, every, fitted, up_to


@pytest.fixture(scope="module")
def sphere(repository: Path) -> hdb.HydroDatabase:
    return hdb.read(repository / "cases" / "sphere" / "hydro.h5")


@pytest.fixture(scope="module")
def flaps(repository: Path) -> hydrodae.Case:
    return hydrodae.Case.read(repository / "cases" / "f3of" / "flap_decay.toml")


def heave(database: hdb.HydroDatabase) -> tuple[np.ndarray, np.ndarray]:
    i = database.index("sphere.heave")[0]
    return database.added_mass[:, i, i], database.radiation_damping[:, i, i]


def test_a_long_memory_is_the_table_itself(sphere: hdb.HydroDatabase) -> None:
    a, b = heave(sphere)
    long_a, long_b = heave(cut_memory(sphere, 60.0))
    inside = slice(2, 60)
    np.testing.assert_allclose(long_b[inside], b[inside], atol=2e-3 * b.max())
    np.testing.assert_allclose(long_a[inside], a[inside], rtol=2e-3)


def test_a_cut_memory_against_quadrature(sphere: hdb.HydroDatabase) -> None:
    time = np.linspace(0.0, 4.0, 2001)
    i = sphere.index("sphere.heave")[0]
    kernel = sphere.radiation_kernel(time)[:, i, i]
    _, b = heave(cut_memory(sphere, 4.0))
    for k in (5, 20, 60):
        exact = np.trapezoid(kernel * np.cos(sphere.omega[k] * time), time)
        assert b[k] == pytest.approx(exact, abs=1e-5 * b.max())


def test_thinned_and_shortened_tables(sphere: hdb.HydroDatabase) -> None:
    thin = every(sphere, 4)
    assert thin.omega[1] == sphere.omega[4]
    assert thin.omega[-1] == sphere.omega[-1]
    short = up_to(sphere, 0.5)
    assert short.omega[-1] == pytest.approx(0.5 * sphere.omega[-1], rel=0.02)
    i = sphere.index("sphere.surge")[0]
    # Ogilvie's relation on half the table: a few percent off in surge
    off = short.added_mass_inf[i, i] / sphere.added_mass_inf[i, i] - 1.0
    assert 1e-4 < abs(off) < 0.2


def test_a_fit_stands_for_its_own_a_and_b(sphere: hdb.HydroDatabase) -> None:
    a, b = heave(sphere)
    fit_a, fit_b = heave(fitted(sphere, sphere.memory["heave"]))
    inside = (sphere.omega > 0.3) & (sphere.omega < 3.0)
    np.testing.assert_allclose(fit_b[inside], b[inside], atol=1e-3 * b.max())
    np.testing.assert_allclose(fit_a[inside], a[inside], rtol=1e-3)


def test_periods_of_f3of(flaps: hydrodae.Case) -> None:
    """The memory rings for minutes: a cut or dropped coupling moves the periods, a fit does not."""
    rows = sensitivity(flaps, "period")
    change = {row.variant: row.change for row in rows if row.result.startswith("mode 1")}
    period = {
        row.variant: row.change
        for row in rows
        if row.result.startswith("mode 1") and "period" in row.result
    }
    assert set(period) == set(change)
    assert period["base: tables as stored"] == 0.0
    assert abs(period["every 2. frequency"]) < 0.01
    assert abs(period["fit 'flaps_planar', 63 states"]) < 0.02
    assert period["no coupling of bodies"] == pytest.approx(-1.6, abs=0.1)
    cut = [value for name, value in period.items() if name.startswith("memory cut")]
    assert abs(cut[0]) < 1.0 < 2.0 < abs(cut[-1])


def test_without_coupling_the_flaps_are_twins(flaps: hydrodae.Case) -> None:
    rows = sensitivity(flaps, "period")
    twins = [
        row.value
        for row in rows
        if row.variant == "no coupling of bodies" and "period" in row.result
    ]
    assert twins[0] == pytest.approx(twins[1], rel=1e-6)


def test_blocks_between_bodies_are_zero(flaps: hydrodae.Case) -> None:
    database = hdb.read(flaps.scene.database_path)
    alone = database.without_coupling()
    base, flap = database.index("base.surge")[0], database.index("flap1.surge")[0]
    assert not alone.added_mass[:, base, flap].any()
    assert not alone.radiation_damping[:, flap, base].any()
    assert not alone.added_mass_inf[base, flap]
    np.testing.assert_array_equal(
        alone.added_mass[:, base, base], database.added_mass[:, base, base]
    )
    assert not alone.memory
    assert alone.repairs[-1].startswith("coupling")


def test_command(repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    case = str(repository / "cases" / "sphere" / "wave.toml")
    base = str(tmp_path / "sphere")
    command = ["hdb", "sensitivity", case, "--result", "rao", "--periods", "4.4,6", "-o", base]
    assert main([*command, "--channel", "bodies/sphere/heave"]) == 0
    out = capsys.readouterr().out
    assert "bodies/sphere/heave at 4.4 s [m/m]" in out
    rows = json.loads((tmp_path / "sphere.json").read_text())["rows"]
    assert rows[0]["value"] == pytest.approx(1.874, rel=0.015)
    assert rows[0]["change"] == 0.0
    assert (tmp_path / "sphere.png").stat().st_size > 5000


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--result", "rao"], "give --periods"),
        (["--result", "rao", "--periods", "x"], "expected numbers > 0"),
        (["--result", "rao", "--periods", "5", "--channel", "y"], "no response 'y'"),
        (["--result", "rao", "--periods", "0.5"], "outside the database"),
        (["--result", "power"], "no damper"),
        (["--result", "period", "--band", "1"], "expected LO,HI"),
    ],
)
def test_bad_arguments(
    repository: Path, capsys: pytest.CaptureFixture[str], options: list[str], message: str
) -> None:
    case = str(repository / "cases" / "sphere" / "wave.toml")
    assert main(["hdb", "sensitivity", case, *options]) == 2
    assert message in capsys.readouterr().err
