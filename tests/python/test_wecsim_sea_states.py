"""Imports of WEC-Sim in an irregular sea have a study of sea states beside the case."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.python.wecsim_files import write_one_body

from hydrodae import Case
from hydrodae.study.sweep.plan import read_study
from hydrodae.wecsim.case import convert

SEA = "waves = waveClass('{0}'); waves.height = 2; waves.period = 8; waves.spectrumType = 'PM';"


@pytest.mark.parametrize("kind", ["irregular", "regular"])
def test_a_sea_of_one_spectrum_has_a_power_matrix(tmp_path: Path, kind: str) -> None:
    write_one_body(tmp_path / "source", SEA.format(kind), "")
    case = convert(tmp_path / "source", tmp_path / "case").case
    file = case.with_name("power_matrix.toml")
    assert file.is_file() == (kind == "irregular")
    if kind == "regular":
        return
    study = read_study(file)
    assert study.over == ("wave.waves.seed",)
    assert len(study.points) == 3 * 4 * 8
    first = study.points[0]
    keys = ("wave.waves.significant_height", "wave.waves.peak_period", "wave.waves.seed")
    assert tuple(first[key] for key in keys) == (1.0, 6.0, 1)
    Case.read(study.case).with_values(first)  # the keys are those of the case
