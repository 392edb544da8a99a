"""What `hydrodae new` writes runs at once, and says what it needs to say."""

from __future__ import annotations

from pathlib import Path

import pytest

import hydrodae
from hydrodae.commands import cli
from hydrodae.starters import KINDS, create
from hydrodae.study.sweep.plan import read_study


@pytest.mark.parametrize("kind", KINDS)
def test_a_starter_runs_and_absorbs_power(kind: str, tmp_path: Path) -> None:
    case = create(kind, tmp_path / "a" / kind)
    assert {f.name for f in case.parent.iterdir()} == {
        "README.md",
        "case.toml",
        "database.sh",
        "hydro.h5",
        "power_matrix.toml",
    }
    assert (case.parent / "hydro.h5").stat().st_size < 100_000
    results = hydrodae.run(case, set={"solver.end_time": 80.0})
    assert results.status == "completed"
    assert results.statistics["mean_power_absorbed"] > 1e3
    assert results.statistics["estimated_error"] < 1e-3
    assert results.statistics_of("sea/elevation").std > 0.2


@pytest.mark.parametrize("kind", KINDS)
def test_bodies_of_a_starter_float_where_they_are_drawn(kind: str, tmp_path: Path) -> None:
    rest = hydrodae.equilibrium(create(kind, tmp_path / kind))
    for offset in rest.offsets.values():
        assert abs(offset).max() < 0.3  # m


@pytest.mark.parametrize("kind", KINDS)
def test_study_of_a_starter_varies_keys_of_its_case(kind: str, tmp_path: Path) -> None:
    case = create(kind, tmp_path / kind)
    study = read_study(case.parent / "power_matrix.toml")
    assert study.case == case
    for point in study.points:
        hydrodae.Case(path=case, values=point).scene  # noqa: B018  (reads it)


@pytest.mark.parametrize("kind", KINDS)
def test_commands_that_make_a_database_name_its_bodies(kind: str, tmp_path: Path) -> None:
    text = (create(kind, tmp_path / kind).parent / "database.sh").read_text()
    database = hydrodae.hdb.read(tmp_path / kind / "hydro.h5")
    for name in database.bodies:
        point = ",".join(f"{x:g}" for x in database.reference_point(name))
        assert f"--body {name}=" in text
        assert f"--cog {name}={point} " in text
    assert set(database.memory) == {text.partition("hdb fit hydro.h5 ")[2].partition("=")[0]}


def test_command_lists_kinds_and_writes_a_folder(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["new"]) == 0
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == list(KINDS)
    assert cli.main(["new", "flap"]) == 0
    assert "next: hydrodae run flap/case.toml" in capsys.readouterr().out
    assert cli.main(["new", "flap"]) == 2
    assert "flap: is there already; name a new or empty folder" in capsys.readouterr().err
    assert cli.main(["new", "flab", "elsewhere"]) == 2
    assert "did you mean 'flap'?" in capsys.readouterr().err
    assert not Path("elsewhere").exists()
