"""Sampling intervals of runs against what is known exactly: coverage over many seas."""

from __future__ import annotations

import subprocess
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.linear import LinearModel
from hydrodae.results import sampling
from hydrodae.starters import create
from hydrodae.support.arrays import Array
from hydrodae.support.units import prefixed

STEP, PEAK = 0.5, 8.0  # s


def jonswap(frequency: Array, gamma: float) -> Array:
    """Shape of a JONSWAP spectrum over the frequency [Hz]."""
    x = np.maximum(frequency, 1e-9) * PEAK
    width = np.where(x <= 1.0, 0.07, 0.09)
    peak = gamma ** np.exp(-0.5 * ((x - 1.0) / width) ** 2)
    return np.where(frequency > 0.2 / PEAK, x**-5.0 * np.exp(-1.25 * x**-4.0) * peak, 0.0)


def gaussian_seas(gamma: float, periods: int, count: int) -> Array:
    """Records (count, n) of Gaussian seas of variance 1, of so many peak periods."""
    n = round(periods * PEAK / STEP)
    length = 2 ** int(np.ceil(np.log2(4 * n + 2048)))
    spectrum = jonswap(np.asarray(np.fft.rfftfreq(length, STEP), dtype=np.float64), gamma)
    spectrum /= 4.0 * spectrum.sum() / length**2  # of the variance of irfft
    random = np.random.default_rng(7)
    parts = random.standard_normal((2, count, len(spectrum)))
    return np.fft.irfft(np.sqrt(spectrum) * (parts[0] + 1j * parts[1]), length, axis=1)[:, :n]


def covered(intervals: list[sampling.Interval], truth: float) -> float:
    return float(np.mean([low <= truth <= high for low, high in intervals]))


@pytest.mark.parametrize(("gamma", "periods"), [(1.0, 20), (3.3, 20), (3.3, 100), (10.0, 100)])
def test_intervals_cover_moments_of_gaussian_seas(gamma: float, periods: int) -> None:
    """Of v with variance 1: power v^2 has the mean 1, v the deviation 1 and the mean 0."""
    seas = gaussian_seas(gamma, periods, 500)
    power = [sampling.INTERVALS["mean"](v**2) for v in seas]
    assert 0.90 <= covered(power, 1.0) <= 0.99
    assert 0.90 <= covered([sampling.INTERVALS["std"](v) for v in seas], 1.0) <= 0.99
    assert 0.90 <= covered([sampling.INTERVALS["rms"](v) for v in seas], 1.0) <= 0.99
    assert covered([sampling.INTERVALS["mean"](v) for v in seas], 0.0) >= 0.95


@pytest.mark.parametrize(("gamma", "periods"), [(3.3, 20), (3.3, 100), (10.0, 50)])
def test_intervals_cover_the_expected_extremes(gamma: float, periods: int) -> None:
    seas = gaussian_seas(gamma, periods, 500)
    largest, least = seas.max(axis=1).mean(), seas.min(axis=1).mean()
    assert 0.90 <= covered([sampling.INTERVALS["max"](v) for v in seas], largest) <= 0.99
    assert 0.90 <= covered([sampling.INTERVALS["min"](v) for v in seas], least) <= 0.99
    assert covered([sampling.INTERVALS["range"](v) for v in seas], largest - least) >= 0.95


def test_interval_of_white_noise_is_that_of_student() -> None:
    """Of independent values 95 % exactly, and a width that shrinks with the root of the number."""
    random = np.random.default_rng(3)
    noise = random.standard_normal((2000, 1000))
    share = covered([sampling.INTERVALS["mean"](x) for x in noise], 0.0)
    assert abs(share - 0.95) < 3.0 * np.sqrt(0.95 * 0.05 / 2000)
    short = np.mean([np.ptp(sampling.mean_interval(x[:250])) ** 2 for x in noise])
    whole = np.mean([np.ptp(sampling.mean_interval(x)) ** 2 for x in noise])
    assert short / whole == pytest.approx(4.0, rel=0.1)


def test_too_short_a_record_has_no_interval() -> None:
    for interval in sampling.INTERVALS.values():
        assert np.isnan(interval(np.arange(sampling.FEWEST - 1.0))).all()
    assert sampling.std_interval(np.full(100, 3.0)) == (0.0, 0.0)


def exact_power(case: hydrodae.Case) -> float:
    """Mean power of the linear device in the sea state: by 4000 components."""
    fine = case.with_values({"wave.sea.components": 4000})
    return LinearModel(fine).irregular()[1]["pto"]


def seeds_that_cover(kind: str, folder: Path, seeds: range) -> int:
    case = hydrodae.Case.read(create(kind, folder / kind))
    truth, hits = exact_power(case), 0
    for seed in seeds:
        known = hydrodae.run(case, set={"wave.sea.seed": seed, "output.step": 1.0}).statistics
        low, high = known["mean_power_low"], known["mean_power_high"]
        assert (low, high) == (known["mean_power_low.pto"], known["mean_power_high.pto"])
        hits += low <= truth <= high
    return hits


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["flap", "point_absorber"])
def test_interval_of_a_starter_covers_its_exact_mean_power(kind: str, tmp_path: Path) -> None:
    """Of 100 seeds with 95 % each at least 90 cover, in all but 1 % of such hundreds."""
    assert seeds_that_cover(kind, tmp_path, range(1, 101)) >= 90


def test_interval_of_a_starter_covers_its_exact_mean_power_in_a_few_seas(tmp_path: Path) -> None:
    """Of 12 seeds with 95 % each at least 9 cover, in all but 0.2 % of such dozens."""
    assert seeds_that_cover("point_absorber", tmp_path, range(1, 13)) >= 9


def test_interval_of_a_run_is_that_of_its_power(tmp_path: Path) -> None:
    """That of the file is from the work between samples, that here from samples of the power."""
    results = hydrodae.run(create("flap", tmp_path / "flap"), set={"output.step": 0.05})
    power = results["forces/pto/power_absorbed"].to_numpy()[results.time >= 30.0]
    known = results.statistics
    ends = known["mean_power_low"], known["mean_power_high"]
    assert ends == pytest.approx(sampling.mean_interval(power[1:]), rel=2e-3)
    assert results.settled == 30.0
    told = results.summary()
    factor, unit = prefixed(known["mean_power_absorbed"], "W")
    assert f" {unit} ({factor * ends[0]:.3g} to {factor * ends[1]:.3g}); in brackets: 95 % " in told
    assert "expected of such 170 s" in told


def test_interval_does_not_depend_on_how_coarse_the_output_is(tmp_path: Path) -> None:
    """The powers are exact means between samples: 2.5 s hold half a wave, 0.1 s follow it."""
    case = create("point_absorber", tmp_path / "buoy")
    fine, coarse = (hydrodae.run(case, set={"output.step": step}).statistics for step in (0.1, 2.5))
    for end in ("mean_power_low", "mean_power_high"):
        assert coarse[end] == pytest.approx(fine[end], rel=1e-9 + 0.03)


def test_energy_period_of_a_sea_is_that_of_its_components(tmp_path: Path) -> None:
    case = hydrodae.Case.read(create("point_absorber", tmp_path / "buoy"))
    waves = np.asarray(hydrodae._core.wave_components(case.scene))
    energy = waves[:, 2] ** 2
    period = 2.0 * np.pi * np.sum(energy / waves[:, 0]) / energy.sum()
    known = hydrodae.run(case, set={"solver.end_time": 40.0}).statistics
    assert known["sea_period"] == pytest.approx(period, rel=1e-12)


def test_too_short_a_run_says_so(tmp_path: Path, executable: str) -> None:
    case = create("point_absorber", tmp_path / "buoy")
    results = hydrodae.run(case, set={"solver.end_time": 100.0})
    known = results.statistics
    least = 20.0 * known["sea_period"]
    assert "mean_power_low" not in known
    reason = f"too short for an interval of the sea state, which needs {least:.3g} s"
    assert f"{reason} after the ramp" in results.summary()
    told = results.statistics_of("joints/slide/displacement")
    assert not told.intervals
    assert reason in str(told)
    out = ["-o", str(tmp_path / "buoy.h5"), "--set", "solver.end_time=100.0"]
    printed = subprocess.run([executable, str(case), *out], capture_output=True, text=True)
    assert f"{reason} after the ramp" in printed.stdout


def test_a_regular_wave_has_no_sampling_error(tmp_path: Path) -> None:
    wave = [{"name": "sea", "type": "regular", "height": 1.0, "period": 7.3}]
    case = create("point_absorber", tmp_path / "buoy")
    results = hydrodae.run(case, set={"wave": wave, "solver.end_time": 400.0})
    assert not {"sea_period", "mean_power_low"} & set(results.statistics)
    assert "interval" not in results.summary()
    assert "expected of such" not in results.summary()
    assert not results.statistics_of("joints/slide/displacement").intervals


def test_without_waves_there_is_no_interval(repository: Path) -> None:
    results = hydrodae.run(repository / "cases" / "sphere" / "decay.toml")
    assert not {"sea_period", "mean_power_low"} & set(results.statistics)
    assert "expected of such" not in results.summary()


def test_executable_prints_the_interval(executable: str, tmp_path: Path) -> None:
    case = create("point_absorber", tmp_path / "buoy")
    out = tmp_path / "buoy.h5"
    told = subprocess.run(
        [executable, str(case), "-o", str(out)], capture_output=True, text=True, check=True
    ).stdout
    known = hydrodae.Results.read(out).statistics
    power, low, high = (known[f"mean_power_{key}"] for key in ("absorbed", "low", "high"))
    factor, unit = prefixed(power, "W")
    line = next(line for line in told.splitlines() if line.startswith("mean absorbed power"))
    assert line == (
        f"mean absorbed power after 30 s: pto {factor * power:.4g} {unit} "
        f"({factor * low:.3g} to {factor * high:.3g}); "
        "in brackets: 95 % interval of the sea state"
    )


def test_rungs_of_motion_are_compared_over_the_same_record(tmp_path: Path) -> None:
    """A linear flap: linear theory meets the run to 1 %, though the sea state is off by more."""
    from hydrodae.study.ladder import ladder

    case = hydrodae.Case.read(create("flap", tmp_path / "flap"))
    made = ladder(case.with_values({"solver.end_time": 300.0}), repeat=1)
    linear, _, run = made.motion
    assert made.channel == "joints/hinge/angle"
    assert abs(linear.error) < 0.01
    assert 0.01 < abs(linear.deviation / run.deviation - 1.0)
    assert run.interval[0] < linear.deviation < run.interval[1]
    assert f"{run.interval[0]:.3g} to {run.interval[1]:.3g}" in str(made)
    assert not run.no_interval
    low, high = linear.error_interval
    assert low < linear.error < high
    assert high - low < 0.2 * (run.interval[1] - run.interval[0]) / run.deviation
    assert f"({100 * low:+.2f} to {100 * high:+.2f})" in str(made)


def test_ladder_of_too_short_a_run_says_so(tmp_path: Path) -> None:
    from hydrodae.study.ladder import ladder

    made = ladder(create("flap", tmp_path / "flap"), repeat=1)
    _, _, run = made.motion
    assert np.isnan(run.interval).all()
    assert "time domain: too short for an interval of the sea state, which needs 1" in str(made)


@pytest.mark.parametrize("bias", [0.0, 0.1])
def test_paired_interval_covers_the_difference_of_two_rungs(bias: float) -> None:
    """x = (1 + bias) y + 0.1 z with z another sea: deviations sqrt((1 + bias)^2 + 0.01) to 1."""
    from hydrodae.study.motion_rungs import paired_interval

    seas = gaussian_seas(3.3, 60, 800)
    y, z = seas[:400], seas[400:]
    found = [paired_interval((1.0 + bias) * a + 0.1 * b, a) for a, b in zip(y, z, strict=True)]
    truth = float(np.sqrt((1.0 + bias) ** 2 + 0.01) - 1.0)
    assert 0.90 <= covered(found, truth) <= 0.99
    alone = np.median([np.ptp(sampling.std_interval(a)) for a in y])
    assert np.median([np.ptp(ends) for ends in found]) < 0.2 * alone


MATRIX = """case = "case.toml"
[grid]
"wave.sea.significant_height" = [1.0, 2.0]
"wave.sea.peak_period" = [6.0, 8.0]
[result.stroke]
channel = "joints/slide/displacement"
statistic = "max"
[scatter]
file = "scatter.csv"
height = "wave.sea.significant_height"
period = "wave.sea.peak_period"
"""


def test_power_matrix_has_the_interval_of_each_run(tmp_path: Path) -> None:
    from hydrodae.study.sweep import text

    case = create("point_absorber", tmp_path / "buoy")
    study = case.parent / "matrix.toml"
    study.write_text(MATRIX)
    (case.parent / "scatter.csv").write_text("height,period,hours\n1.0,6.0,1000\n2.0,8.0,500\n")
    found = hydrodae.sweep(study, case.parent / "matrix.nc", jobs=1)
    power = found["mean_power_absorbed"]
    low, high = found["mean_power_absorbed_low"], found["mean_power_absorbed_high"]
    assert ((low < power) & (power < high)).all()
    np.testing.assert_allclose(low * high, power**2, rtol=1e-3)  # equal ratios to both sides
    assert (found["stroke_low"] < found["stroke_high"]).all()
    flux = power / found["capture_width"]
    np.testing.assert_allclose(found["capture_width_high"] * flux, high)
    half = 50.0 * (high - low) / power
    told = text(found)
    factor, _ = prefixed(float(power.max()), "W")
    assert f"95 % interval of one run at most {float(half.max()):.2g} % to each side" in told
    for value, near in zip(power.values.ravel(), half.values.ravel(), strict=True):
        assert f"{factor * value:.4g} +-{near:.2g} %" in told
    joules = [3600.0 * (1000.0 * float(p[0, 0]) + 500.0 * float(p[1, 1])) for p in (low, high)]
    ends = [float(found[f"annual_energy_{end}"]) for end in ("low", "high")]
    assert ends == pytest.approx(joules)
    assert f"(95 %: {ends[0] / 3.6e9:,.3g} to {ends[1] / 3.6e9:,.3g})" in told


def test_power_matrix_of_runs_that_are_too_short_says_so(tmp_path: Path) -> None:
    from hydrodae.study.sweep import text

    case = create("point_absorber", tmp_path / "buoy")
    study = case.parent / "matrix.toml"
    study.write_text(
        'case = "case.toml"\n[grid]\n"wave.sea.significant_height" = [1.0, 2.0]\n'
        '"wave.sea.peak_period" = [6.0, 12.0]\n'
    )
    found = hydrodae.sweep(study, case.parent / "matrix.nc", jobs=1)
    assert np.isfinite(found["mean_power_absorbed_low"].values).tolist() == [[True, False]] * 2
    assert "2 runs too short for an interval" in text(found)
