"""Return levels of years and contours: against closed forms, and coverage over known seas."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray
from scipy import stats
from tests.errors import wrong

from hydrodae.starters import create
from hydrodae.study.extremes import (
    JointModel,
    contour,
    likely_wave,
    linear_long_term,
    runs_long_term,
)
from hydrodae.study.extremes.contour import fit_joint_model
from hydrodae.study.extremes.scatter import ScatterTable, read_scatter

YEAR = 8766.0  # h
#: Joint model of DNV-RP-C205 with figures like those of the northern North Sea.
MODEL = JointModel(2.5, 1.4, 0.5, 0.9, 0.9, 0.3, 0.05, 0.2, -0.25)
STUDY = """
case = "case.toml"
[grid]
"wave.sea.significant_height" = [1.0, 2.0]
"wave.sea.peak_period" = [8.0]
"wave.sea.seed" = [1, 2]
[result.top]
channel = "joints/slide/displacement"
statistic = "max"
"""
CASE = "[solver]\nend_time = 1830.0\n[sea]\nramp = 30.0\n"


def write_sweep(path: Path, values: np.ndarray) -> Path:
    """The table of a sweep whose runs of 1800 s have these largest values (states, 1, seeds)."""
    keys = ("significant_height", "peak_period", "seed")
    data = xarray.Dataset(
        {"top": (keys, values, {"units": "m"})},
        {
            "significant_height": ("significant_height", [1.0, 2.0]),
            "peak_period": ("peak_period", [8.0]),
            "seed": ("seed", np.arange(values.shape[2])),
        },
        {"study": STUDY, "case": CASE, "overrides": ""},
    )
    for key in keys:
        data[key].attrs["key"] = f"wave.sea.{key}"
    data.to_netcdf(path)
    return path


def test_one_sea_state_all_year_is_the_closed_form(tmp_path: Path) -> None:
    """s sqrt(2 ln(nu T)): the same as the most probable largest of so many hours."""
    case = create("point_absorber", tmp_path / "case")
    table = ScatterTable(np.array([2.0]), np.array([9.0]), np.array([YEAR]))
    found = linear_long_term(case, "bodies/buoy/heave", table, years=[1.0, 20.0])
    sea = {"wave.sea.significant_height": 2.0, "wave.sea.peak_period": 9.0}
    for years, level in zip(found.years, found.levels, strict=True):
        wave = likely_wave(case, "bodies/buoy/heave", hours=years * YEAR, set=sea)
        assert level == pytest.approx(wave.level, rel=1e-9)
    assert np.isnan(found.intervals).all()


def test_two_sea_states_add_their_crossings(tmp_path: Path) -> None:
    case = create("point_absorber", tmp_path / "case")
    half = np.array([0.5 * YEAR] * 2)
    once = ScatterTable(np.array([2.0]), np.array([9.0]), np.array([YEAR]))
    twice = ScatterTable(np.array([2.0, 2.0]), np.array([9.0, 9.0]), half)
    mixed = ScatterTable(np.array([2.0, 3.0]), np.array([9.0, 9.0]), half)
    a, b, c = (
        linear_long_term(case, "forces/pto/force", table, years=10.0).levels[0]
        for table in (once, twice, mixed)
    )
    assert a == pytest.approx(b, rel=1e-12)
    higher = ScatterTable(np.array([3.0]), np.array([9.0]), half[:1])
    assert linear_long_term(case, "forces/pto/force", higher, years=10.0).levels[0] == (
        pytest.approx(c, rel=1e-5)
    )


LOC, SCALE = np.array([1.0, 1.7]), np.array([0.1, 0.2])


def exact_level(years: float) -> float:
    """Level of the Gumbel distributions of both sea states, by bisection."""
    low, high = 0.0, 20.0
    for _ in range(100):
        x = 0.5 * (low + high)
        crossings = float(np.sum(0.5 * YEAR * 2.0 * np.exp(-(x - LOC) / SCALE)))
        low, high = (x, high) if crossings > 1.0 / years else (low, x)
    return low


def test_intervals_of_years_cover_the_truth(tmp_path: Path) -> None:
    """Five seeds of each of two sea states; of 100 with 95 % each 90 to 99 (binomial)."""
    table = ScatterTable(np.array([1.0, 2.0]), np.array([8.0, 8.0]), np.array([0.5 * YEAR] * 2))
    random, truth, hits = np.random.default_rng(4), exact_level(50.0), 0
    for _ in range(100):
        values = random.gumbel(LOC[:, None, None], SCALE[:, None, None], (2, 1, 5))
        path = write_sweep(tmp_path / "sweep.nc", values)
        found = runs_long_term(path, "top", table, years=50.0, copies=200)
        hits += found.intervals[0, 0] <= truth <= found.intervals[0, 1]
    assert 90 <= hits <= 99


def test_many_seeds_give_the_level_of_the_distributions(tmp_path: Path) -> None:
    table = ScatterTable(np.array([1.0, 2.0]), np.array([8.0, 8.0]), np.array([0.5 * YEAR] * 2))
    random = np.random.default_rng(6)
    values = random.gumbel(LOC[:, None, None], SCALE[:, None, None], (2, 1, 20000))
    path = write_sweep(tmp_path / "sweep.nc", values)
    found = runs_long_term(path, "top", table, years=[1.0, 50.0], copies=20)
    assert found.levels == pytest.approx([exact_level(1.0), exact_level(50.0)], rel=0.01)
    assert found.states[1]["share"] > 0.999
    with wrong("seed"):
        runs_long_term(write_sweep(tmp_path / "few.nc", values[:, :, :4]), "top", table)


def test_contour_of_a_known_model_is_the_closed_form() -> None:
    """Highest: F_H(h) = 1 - D / T; at it the median of the period; each point at distance beta."""
    found = contour(MODEL, years=[1.0, 50.0], hours=3.0, points=72)
    for years, heights, periods in zip(found.years, found.heights, found.periods, strict=True):
        p = 3.0 / (years * YEAR)
        wanted = 0.5 + 2.5 * (-np.log(p)) ** (1.0 / 1.4)
        assert heights.max() == pytest.approx(wanted, rel=1e-12)
        assert periods[0] == pytest.approx(np.exp(0.9 + 0.9 * wanted**0.3), rel=1e-12)
        own = stats.weibull_min(1.4, 0.5, 2.5)
        u1 = np.where(
            heights > 2.0, -stats.norm.ppf(own.sf(heights)), stats.norm.ppf(own.cdf(heights))
        )
        deviation = 0.05 + 0.2 * np.exp(-0.25 * heights)
        u2 = (np.log(periods) - 0.9 - 0.9 * heights**0.3) / deviation
        assert np.hypot(u1, u2) == pytest.approx(np.full(72, -stats.norm.ppf(p)), rel=1e-5)


def test_model_is_found_again_from_its_scatter_table() -> None:
    """Bins of 0.5 m and 0.5 s; highest sea state of 50 years within 2 %."""
    height, period = np.meshgrid(np.arange(0.25, 20.0, 0.5), np.arange(0.75, 30.0, 0.5))
    own = stats.weibull_min(1.4, 0.5, 2.5)
    share = own.cdf(height + 0.25) - own.cdf(height - 0.25)
    mean, deviation = MODEL.mean(height), MODEL.deviation(height)
    of_period = [stats.norm.cdf((np.log(period + x) - mean) / deviation) for x in (0.25, -0.25)]
    hours = YEAR * share * (of_period[0] - of_period[1])
    seen = hours > 1e-6
    table = ScatterTable(height[seen], period[seen], hours[seen])
    found = fit_joint_model(table)
    assert contour(found).heights.max() == pytest.approx(contour(MODEL).heights.max(), rel=0.02)
    h = np.array([1.0, 3.0, 6.0])
    assert found.mean(h) == pytest.approx(MODEL.mean(h), rel=0.02)
    assert found.deviation(h) == pytest.approx(MODEL.deviation(h), rel=0.1)


def test_scatter_tables_that_cannot_be_used_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "scatter.csv"
    path.write_text("height,period,hours\n1.0,8.0,lots\n")
    with wrong("scatter"):
        read_scatter(path)
    with wrong("years"):
        contour(MODEL, years=-1.0)
