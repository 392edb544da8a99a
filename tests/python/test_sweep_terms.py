"""Results of a study that are sums of channels, or ratios of results."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.python.test_sweep import CASE, write_study

import hydrodae
from hydrodae.study.sweep.problem import read_problem


def test_terms_add_up_and_over_divides(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(CASE)
    study = write_study(
        tmp_path,
        '[grid]\n"force.pto.damping" = [1.0, 2.0]\n'
        '[result.s]\nchannel = "joints/guide/displacement_rate"\nstatistic = "rms"\n'
        '[result.sum]\nunit = "W"\nterms = [{ factor = 3.0 }, '
        '{ channel = "joints/guide/displacement_rate", factor = -0.5, power = 2 }, '
        '{ channel = "forces/pto/power_absorbed" }]\n'
        '[result.ratio]\nchannel = "forces/pto/power_absorbed"\nover = "sum"\n'
        '[result.each]\nchannel = "forces/pto/power_absorbed"\nover = "s"\n',
    )
    found = hydrodae.sweep(study, tmp_path / "study.nc", jobs=1)
    square = found["s"].values ** 2
    power = np.array([1.0, 2.0]) * square
    np.testing.assert_allclose(found["sum"].values, 3.0 - 0.5 * square + power, rtol=1e-9)
    np.testing.assert_allclose(found["ratio"].values, power / found["sum"].values, rtol=1e-9)
    units = [found[name].attrs["units"] for name in ("sum", "ratio", "each")]
    assert units == ["W", "-", "W/(m/s)"]


@pytest.mark.parametrize("more", ['channel = "c"\nover = "y"\n', 'terms = [{ channel = "c" }]\n'])
def test_a_search_takes_one_channel(tmp_path: Path, more: str) -> None:
    study = write_study(
        tmp_path,
        f'[result.x]\n{more}[optimise]\nmaximise = "x"\n'
        '[optimise.parameter.c]\nkeys = ["force.pto.damping"]\nbounds = [1.0, 2.0]\n',
    )
    with pytest.raises(hydrodae.CaseError, match="which have no gradient; expected a result of"):
        read_problem(study)


def test_a_ratio_needs_the_rung_of_time(tmp_path: Path, repository: Path) -> None:
    case = repository / "cases" / "sphere" / "wave.toml"
    heave = 'channel = "bodies/sphere/position"\ncomponent = "z"\nstatistic = "std"\n'
    text = f'case = "{case}"\nrungs = ["frequency"]\n[grid]\n"wave.swell.height" = [0.2]\n'
    text += f"[result.a]\n{heave}"
    study = tmp_path / "study.toml"
    study.write_text(text)
    found = hydrodae.sweep(study, tmp_path / "study.nc", jobs=1)
    assert found["a"].values > 0.05
    study.write_text(f'{text}[result.b]\n{heave}over = "a"\n')
    with pytest.raises(hydrodae.CaseError, match=r"\[result\.b\]: no rung of the study knows it"):
        hydrodae.sweep(study, tmp_path / "ratio.nc", jobs=1)
