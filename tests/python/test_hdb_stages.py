"""Stages of an import, a fit and a computation: shown in their order, each with a docstring."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from hydrodae import hdb
from hydrodae.commands import cli
from hydrodae.hdb.bem import run
from hydrodae.hdb.preparation import pipeline


@pytest.mark.parametrize("stages", [pipeline.IMPORT, pipeline.FIT, pipeline.COMPUTE])
def test_each_stage_says_what_it_takes_and_adds(stages: pipeline.Stages) -> None:
    assert len(set(pipeline.names(stages))) == len(stages)
    for _, stage in stages:
        assert (stage.__doc__ or "").startswith("Take ")


def shown(text: str, title: str) -> list[str]:
    """Return the stages in what a command wrote on stderr."""
    return re.findall(rf"(?m)^{title}, \d+ s: (.*)$", text)


def test_the_command_import_shows_its_stages_and_those_of_its_fit(
    sphere_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = [sphere_file, "-o", tmp_path / "x.h5", "--fit", "again=sphere.heave"]
    assert cli.main(["hdb", "import", *map(str, words)]) == 0
    printed = capsys.readouterr()
    assert shown(printed.err, "import") == pipeline.names(pipeline.IMPORT)
    stages = pipeline.names(pipeline.FIT)
    assert [text for text in shown(printed.err, "fit again") if text in stages] == stages
    assert ", 0 s: " not in printed.out


def test_the_command_compute_shows_its_stages(
    sphere_file: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(run, "compute", lambda *_, **__: sphere_file)
    words = "--body sphere=sphere:radius=5 --cog sphere=0,0,-2 --omega 0.4,1.6,5".split()
    command = ["hdb", "compute", *words, "-o", str(tmp_path / "x.h5")]
    assert cli.main(command) == 0
    assert shown(capsys.readouterr().err, "compute") == pipeline.names(pipeline.COMPUTE)
    assert cli.main([*command, "--quiet"]) == 0
    assert capsys.readouterr().err == ""


def test_an_import_tells_its_stages(repository: Path) -> None:
    told: list[str] = []
    table, report = hdb.import_database(
        repository / "cases" / "sphere" / "hydro.h5", keep="sphere.heave", progress=told.append
    )
    assert told == pipeline.names(pipeline.IMPORT)
    assert table.coordinates == ("sphere.heave",)
    assert report.findings


def test_a_fit_tells_its_stages_and_its_search_between_them(repository: Path) -> None:
    table = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    told: list[str] = []
    made = hdb.fit(table, "sphere.heave", name="again", progress=told.append)
    stages = pipeline.names(pipeline.FIT)
    assert [text for text in told if text in stages] == stages
    between = told[told.index("search") + 1 : told.index("judge")]
    assert any("of the target error" in text for text in between)
    assert "again" in made.memory
    assert "again" not in table.memory
