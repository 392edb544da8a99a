"""Stages of an import and of a fit: told in their order, each with a docstring."""

from __future__ import annotations

from pathlib import Path

import pytest

from hydrodae import hdb
from hydrodae.hdb.preparation import pipeline


def names(stages: pipeline.Stages) -> list[str]:
    return [name for name, _ in stages]


@pytest.mark.parametrize("stages", [pipeline.IMPORT, pipeline.FIT, pipeline.COMPUTE])
def test_each_stage_says_what_it_takes_and_adds(stages: pipeline.Stages) -> None:
    assert len(set(names(stages))) == len(stages)
    for _, stage in stages:
        assert (stage.__doc__ or "").startswith("Take ")


def test_an_import_tells_its_stages(repository: Path) -> None:
    told: list[str] = []
    table, report = hdb.import_database(
        repository / "cases" / "sphere" / "hydro.h5", keep="sphere.heave", progress=told.append
    )
    assert told == names(pipeline.IMPORT)
    assert table.coordinates == ("sphere.heave",)
    assert report.findings


def test_a_fit_tells_its_stages_and_its_search_between_them(repository: Path) -> None:
    table = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    told: list[str] = []
    made = hdb.fit(table, "sphere.heave", name="again", progress=told.append)
    stages = names(pipeline.FIT)
    assert [text for text in told if text in stages] == stages
    between = told[told.index("search") + 1 : told.index("judge")]
    assert any("of the target error" in text for text in between)
    assert "again" in made.memory
    assert "again" not in table.memory
