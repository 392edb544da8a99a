"""Results: reading, labels, lazy access, runs that did not end well, errors."""

from __future__ import annotations

import pickle
from pathlib import Path

import h5py
import numpy as np
import pytest

from hydrodae import _core
from hydrodae.results import ChannelError, Results, ResultsError
from hydrodae.results.post import turning_points
from hydrodae.support.units import displayed


def test_scalar_channel_carries_time_unit_and_frame(results_file):
    angle = Results.read(results_file)["joints/hinge1/angle"]
    assert angle.dims == ("time",)
    assert angle.attrs["unit"] == "rad"
    assert angle.attrs["frame"] == "marker A of hinge1"
    assert angle.attrs["description"] == "joints/hinge1/angle."
    assert angle.coords["time"].attrs == {"unit": "s", "units": "s"}
    # closed form of the synthetic run at one full period
    expected = np.radians(10.0) * np.exp(-0.14)
    assert float(angle.sel(time=14.0, method="nearest")) == pytest.approx(expected, rel=1e-12)


def test_vectors_have_components_and_orientations_have_quaternion_labels(results_file):
    results = Results.read(results_file)
    position = results["bodies/flap1/position"]
    assert position.dims == ("time", "component")
    assert float(position.sel(component="x")[0]) == pytest.approx(-12.5 + 3.5 * np.sin(np.pi / 18))
    orientation = results["bodies/flap1/orientation"]
    assert orientation.dims == ("time", "quaternion")
    assert list(orientation["quaternion"].values) == ["w", "x", "y", "z"]
    assert np.allclose((orientation**2).sum("quaternion"), 1.0)


def test_mapping_of_channels(results_file):
    results = Results.read(results_file)
    assert results.channels("joints/*/angle") == ["joints/hinge1/angle", "joints/hinge2/angle"]
    assert set(results) == set(results.channels())
    assert len(results) == 17
    assert "time" not in results
    assert "joints/hinge9/angle" not in results
    assert results.get("joints/hinge9/angle") is None
    assert results == results
    assert results != Results.read(results_file)


def test_a_channel_is_read_once_and_only_when_asked_for(results_file, monkeypatch):
    opened = []
    results = Results(results_file, sound=True)  # without a child, whose calls are not seen
    original = _core.ResultsReader
    assert results.time[-1] == 100.0

    def noted(*arguments):
        opened.append(arguments)
        return original(*arguments)

    monkeypatch.setattr(_core, "ResultsReader", noted)
    assert results.time[-1] == 100.0
    assert opened == []
    first = results["joints/hinge1/angle"]
    assert results["joints/hinge1/angle"] is first
    assert len(opened) == 1


def test_header_and_statistics_are_plain_python(results_file):
    results = Results.read(results_file)
    assert results.status == "completed"
    assert results.title == "Flap decay"
    assert results.case_text == 'title = "Flap decay"\n'
    assert results.statistics == {
        "steps": 812,
        "residual_calls": 1204,
        "jacobian_calls": 41,
        "wall_time": 0.05,
    }
    assert {type(value) for value in results.statistics.values()} == {int, float}
    assert results.header["version"] == "0.1.0"


def test_to_dataset_joins_channels_on_the_time_axis(results_file):
    dataset = Results.read(results_file).to_dataset("bodies/*")
    assert dict(dataset.sizes) == {"time": 1001, "component": 3, "quaternion": 4}
    assert len(dataset) == 9
    assert dataset["bodies.flap2.rotation"].attrs["unit"] == "rad"


def test_summary_has_cost_and_extrema_in_degrees(results_file):
    lines = Results.read(results_file).summary().splitlines()
    assert lines[0] == "Flap decay: 100 s simulated"
    assert "812 steps" in lines[1]
    assert "2,000 times real time" in lines[1]
    assert (
        lines[2].split()
        == "joints/hinge1/angle -9.324 deg at 7.00 s to 10.000 deg at 0.00 s".split()
    )
    assert lines[-1].startswith("  energy balance: error at most ")


def test_summary_has_no_negative_zero(results_writer):
    path = results_writer()
    with h5py.File(path, "a") as file:
        file["joints/hinge1/angle"][...] = -1e-9
    (line,) = [text for text in Results.read(path).summary().splitlines() if "hinge1" in text]
    assert " 0.000 deg" in line
    assert "-0" not in line


def test_summary_names_the_mean_power_of_each_take_off(results_file):
    with h5py.File(results_file, "a") as file:
        solver = file["solver"].attrs
        solver["mean_power_absorbed.pto1"], solver["mean_power_absorbed.pto2"] = 1200.0, 34.0
        solver["mean_power_absorbed"], solver["mean_power_from"] = 1234.0, 50.0
        solver["damaged"] = 1.0  # a name that is no text comes as bytes
        h5py.h5a.rename(file["solver"].id, b"damaged", b"\xff\xfe")
    results = Results.read(results_file)
    assert "�" in "".join(results.statistics)
    line = next(line for line in results.summary().splitlines() if "mean absorbed" in line)
    assert line == "  mean absorbed power after 50 s: pto1 1.2 kW, pto2 34 W, in all 1.234 kW"


@pytest.mark.parametrize("status", ["interrupted", "failed"])
def test_summary_of_a_partial_run_says_so(results_writer, status):
    path = results_writer(np.linspace(0, 30, 301), status=status, message="hinge1 locked")
    first = Results.read(path).summary().splitlines()[0]
    assert first == f"Flap decay: {status}, 30 s simulated (hinge1 locked)"


def test_run_without_samples_is_readable(results_writer):
    results = Results.read(results_writer(np.empty(0), status="failed"))
    assert np.isnan(results.end_time)
    assert "no samples" in results.summary()
    assert results["joints/hinge1/angle"].shape == (0,)


def test_killed_run_keeps_the_samples_that_all_channels_have(results_writer):
    path = results_writer(status="running")
    with h5py.File(path, "a") as file:
        del file["joints/hinge2/angle"]
        file["joints/hinge2/angle"] = np.zeros(400)
    results = Results.read(path)
    assert len(results.time) == 400
    assert results["bodies/flap1/position"].shape == (400, 3)


def test_channel_of_another_length_is_an_error_in_a_completed_run(results_writer):
    path = results_writer()
    with h5py.File(path, "a") as file:
        file["joints/hinge1/torque"] = np.zeros(400)
    with pytest.raises(ResultsError, match=r"joints/hinge1/torque has shape \(400,\)"):
        Results.read(path)["joints/hinge1/torque"]


def test_missing_channel_names_the_nearest(results_file):
    results = Results.read(results_file)
    with pytest.raises(ChannelError, match="nearest name is 'joints/hinge1/angle'") as caught:
        results["joints/hinge1/angel"]
    assert not str(caught.value).startswith('"')
    with pytest.raises(ChannelError, match="it is a group of joints/hinge2/angle"):
        results["joints/hinge2"]
    with pytest.raises(ChannelError, match="there are channels in bodies, energy, joints, solver"):
        results["wholly other"]


def test_file_that_was_written_again_is_not_mixed_with_the_old_one(results_writer):
    results = Results.read(results_writer())
    before = results["joints/hinge1/angle"]
    results_writer(np.linspace(0, 100, 501))
    assert results["joints/hinge1/angle"] is before
    with pytest.raises(ResultsError, match="has changed since it was opened"):
        results["joints/hinge2/angle"]


def test_bad_files(tmp_path, results_writer):
    with pytest.raises(ResultsError, match="no such results file"):
        Results.read(tmp_path / "none.h5")
    text = tmp_path / "text.h5"
    text.write_text("hello")
    with pytest.raises(ResultsError, match="not a readable results file"):
        Results.read(text)
    with h5py.File(tmp_path / "other.h5", "w"):
        pass
    with pytest.raises(ResultsError, match="attribute format is None"):
        Results.read(tmp_path / "other.h5")
    with pytest.raises(ResultsError, match="format version 2; this hydrodae reads 1"):
        Results.read(results_writer(format_version=2))


def test_errors_survive_a_process_boundary():
    error = pickle.loads(pickle.dumps(ChannelError("no channel")))
    assert str(error) == "no channel"


def test_turning_points_of_a_damped_swing_are_exact_to_the_sampling():
    decay, omega = 0.02, 2 * np.pi / 14
    t = np.linspace(0, 60, 601)
    times, extrema = turning_points(t, np.exp(-decay * t) * np.cos(omega * t))
    # derivative zero: tan(omega t) = -decay / omega
    exact = (np.pi * np.arange(1, 9) - np.arctan(decay / omega)) / omega
    assert times == pytest.approx(exact, abs=1e-4)
    assert extrema == pytest.approx(np.exp(-decay * exact) * np.cos(omega * exact), abs=1e-7)


def test_turning_points_of_uneven_samples_of_a_parabola_are_exact():
    t = np.array([0.0, 0.3, 1.1, 1.7, 3.0])
    times, extrema = turning_points(t, 2 * (t - 1.3) ** 2 + 5)
    assert times == pytest.approx([1.3], abs=1e-14)
    assert extrema == pytest.approx([5.0], abs=1e-14)


def test_turning_points_of_a_rounded_series_count_a_plateau_once():
    times, extrema = turning_points(np.arange(7.0), [0, 1, 2, 2, 2, 1, 0])
    assert times == pytest.approx([3.0])
    assert extrema == pytest.approx([2.0])


@pytest.mark.parametrize(("time", "values"), [([0, 1], [0, 1, 2]), ([0, 2, 1], [0, 1, 2])])
def test_turning_points_reject_what_is_no_series(time, values):
    with pytest.raises(ValueError, match="time"):
        turning_points(time, values)


def test_series_without_turning_point():
    times, extrema = turning_points([0, 1, 2, 3], [0, 1, 2, 3])
    assert len(times) == len(extrema) == 0


def test_only_radians_are_shown_as_degrees():
    assert displayed("rad")[0] * np.pi == pytest.approx(180.0)
    assert [displayed(u)[1] for u in ("rad", "rad/s", "m", "N m s/rad")] == [
        "deg",
        "deg/s",
        "m",
        "N m s/rad",
    ]
    assert displayed("N m s/rad")[0] == 1.0


def test_repr_is_one_line(results_file: Path):
    assert repr(Results.read(results_file)) == (
        "<hydrodae.Results 'Flap decay': 17 channels, 1001 samples to t = 100 s, completed>"
    )
