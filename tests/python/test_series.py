"""Statistics of series against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from hydrodae.results import ChannelError, Results, ResultsError
from hydrodae.results.series import spectral_density, zero_crossing_waves

STEP = 0.1


def test_spectrum_of_a_sine_has_its_variance_and_its_peak():
    time = np.arange(0.0, 800.0, STEP)
    values = 5.0 + 2.0 * np.sin(2 * np.pi * time / 8.0)
    found = spectral_density(time, values)
    assert found.moment(0) == pytest.approx(2.0, rel=0.01)  # a^2 / 2
    assert found.peak_period == pytest.approx(8.0, rel=0.02)
    assert np.sqrt(found.moment(2) / found.moment(0)) == pytest.approx(2 * np.pi / 8.0, rel=0.02)


def test_spectrum_of_white_noise_is_flat_up_to_its_highest_frequency():
    values = np.random.default_rng(1).normal(size=40_000)
    found = spectral_density(STEP * np.arange(values.size), values)
    expected = 1.0 / (np.pi / STEP)  # variance over the band
    assert found.omega[-1] == pytest.approx(np.pi / STEP)
    assert found.density[5:-5].mean() == pytest.approx(expected, rel=0.05)


def test_waves_of_a_sine_about_its_mean():
    time = np.arange(0.0, 81.0, 0.01)
    found = zero_crossing_waves(time, 3.0 + 1.5 * np.sin(2 * np.pi * time / 8.0 + 0.3))
    assert found.periods == pytest.approx(np.full(9, 8.0), abs=1e-2)
    assert found.heights == pytest.approx(np.full(9, 3.0), rel=1e-4)
    assert found.significant_height == pytest.approx(3.0, rel=1e-4)


def test_waves_are_counted_one_by_one():
    values = [0, 2, -1, -2, 1, 0.5, -3, 4, 1, -4, 1.5]
    found = zero_crossing_waves(np.arange(11.0), values)  # the mean is zero
    assert found.heights == pytest.approx([4.0, 8.0])  # 1 to -3, 4 to -4
    assert found.periods[0] == pytest.approx(3.0 + 3 / 7 - 2 / 3)


def test_no_crossing_and_few_samples_are_no_error():
    assert len(zero_crossing_waves([0.0, 1.0], [1.0, 2.0]).heights) == 0
    assert np.isnan(zero_crossing_waves([], []).mean_period)
    assert np.isnan(spectral_density([0.0, 1.0], [1.0, 2.0]).peak_period)
    with pytest.raises(ValueError, match="evenly spaced"):
        spectral_density(np.arange(20.0) ** 2, np.zeros(20))


def test_statistics_of_a_channel_and_of_a_component(results_writer):
    time = np.linspace(0.0, 400.0, 4001)
    wave = np.sin(2 * np.pi * time / 10.0) * (time > 100.0)
    place = np.stack([0 * time, 0 * time, 3.0 + 0.5 * wave], axis=1)
    channels = {
        "sea/elevation": (wave, "m", "world"),
        "bodies/buoy/position": (place, "m", "world"),
    }
    results = Results.read(results_writer(time, channels=channels))
    found = results.statistics_of("sea/elevation", start=100.0)
    assert (found.unit, found.start, found.end) == ("m", 100.0, 400.0)
    assert found.std == pytest.approx(np.sqrt(0.5), rel=1e-3)
    assert (found.min, found.max) == pytest.approx((-1.0, 1.0), abs=1e-3)
    assert found.waves.mean_period == pytest.approx(10.0, rel=1e-3)
    assert results.statistics_of("sea/elevation").std < found.std
    assert results.statistics_of("bodies/buoy/position.z").mean == pytest.approx(3.0, abs=1e-3)
    assert "standard deviation 0.70699" in str(found)
    with pytest.raises(ChannelError, match=r"is not one series; there is bodies/buoy/position\.x"):
        results.statistics_of("bodies/buoy/position")
    with pytest.raises(ChannelError, match=r"bodies/buoy/position\.w is not one series"):
        results.statistics_of("bodies/buoy/position.w")
    with pytest.raises(ChannelError, match="nearest name is 'sea/elevation'"):
        results.statistics_of("sea/elevatio")
    with pytest.raises(ResultsError, match="no sample from 500 s on"):
        results.statistics_of("sea/elevation", start=500.0)
