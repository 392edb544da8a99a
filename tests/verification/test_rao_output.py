"""What `hydrodae rao` prints, writes and draws."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import xarray

from hydrodae.commands.cli import main
from hydrodae.linear import LinearModel, Response
from hydrodae.study.rao import output as rao_output
from hydrodae.study.rao.text import coordinates, short_name


@pytest.fixture(scope="module")
def path(repository: Path) -> str:
    return str(repository / "cases" / "f3of" / "rao.toml")


@pytest.fixture(scope="module")
def response(path: str) -> Response:
    return LinearModel(path).response(np.linspace(0.3, 1.2, 200))


def test_the_table_names_bodies_and_joints_once(
    path: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["rao", path, "--periods", "14,11,7"]) == 0
    out = capsys.readouterr().out
    rows = [line.split()[0] for line in out.splitlines() if line.startswith("  ") and line.strip()]
    for name in ("base.pitch", "flap1.pitch", "flap2.pitch", "hinge1.angle", "hinge2.angle"):
        assert rows.count(name) == 1
    assert not any(row in ("pitch", "surge", "angle") for row in rows)
    head = next(line for line in out.splitlines() if "peak" in line and "period" in line[2:])
    assert head
    assert max(map(len, out.splitlines())) <= 120


def test_the_values_are_those_of_the_linear_model(
    path: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["rao", path, "--periods", "14,7"]) == 0
    line = next(x for x in capsys.readouterr().out.splitlines() if x.startswith("  base.pitch"))
    model = LinearModel(path)
    exact = np.degrees(
        np.abs(model.response(2 * np.pi / np.array([7.0, 14.0]))["bodies/base/pitch"])
    )
    numbers = [float(word.rstrip("*")) for word in line.split()[2:] if word not in ("s", "s*")]
    top, period, at_short, at_long = numbers
    assert (at_short, at_long) == pytest.approx(tuple(exact), rel=1e-3)
    w = 2 * np.pi / np.linspace(period - 0.5, period + 0.5, 201)
    near = np.degrees(np.abs(model.response(w)["bodies/base/pitch"]))
    assert near.max() == pytest.approx(top, rel=2e-3)
    assert near[100] == pytest.approx(top, rel=2e-3)


def test_a_narrow_peak_is_not_missed(path: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The heave resonance at 9.0 s has a damping ratio of 0.007."""
    assert main(["rao", path]) == 0
    out = capsys.readouterr().out
    line = next(x for x in out.splitlines() if x.startswith("  base.heave"))
    model = LinearModel(path)
    fine = 2 * np.pi / np.linspace(8.8, 9.2, 4001)
    exact = np.abs(model.response(fine)["bodies/base/heave"])
    top, period = (float(word) for word in line.split()[2:4])
    assert top == pytest.approx(exact.max(), rel=5e-3)
    assert period == pytest.approx(2 * np.pi / fine[np.argmax(exact)], abs=0.01)


@pytest.mark.parametrize("ending", ["csv", "nc", "h5"])
def test_files_hold_all_responses(response: Response, tmp_path: Path, ending: str) -> None:
    path = rao_output.write(tmp_path / f"deep/er/rao.{ending}", response)
    name, k = "joints/hinge2/angle", 77
    if ending == "csv":
        head, *rows = path.read_text().splitlines()
        assert len(rows) == len(response.omega)
        columns = head.split(",")
        row = [float(x) for x in rows[k].split(",")]
        amplitude = row[columns.index(f"{name} amplitude [rad/m]")]
        phase = row[columns.index(f"{name} phase [rad]")]
    else:
        with xarray.open_dataset(path, engine="netcdf4") as data:
            one = data.sel(response=name).isel(omega=k)
            amplitude, phase = float(one.amplitude), float(one.phase)
            assert str(one.unit.item()) == "rad/m"
            assert set(data.response.values) == set(response.names)
            power = data.mean_power.sel(force="pto1").values
            assert power == pytest.approx(response.power["pto1"])
    assert amplitude * np.exp(1j * phase) == pytest.approx(response[name][k], rel=1e-6)


def test_an_unknown_ending_is_refused_before_the_work(
    path: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["rao", path, "-o", str(tmp_path / "rao.xls")]) == 2
    assert ".csv, .nc, .h5" in capsys.readouterr().err


def test_the_picture_has_all_that_moves(
    path: str, response: Response, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    figure = rao_output.draw(response, "F3OF")
    lines = {str(line.get_label()) for axes in figure.axes for line in axes.lines}
    moving = {short_name(name) for name in coordinates(response)}
    assert moving <= lines
    assert "pto1 mean power" in lines
    assert all("[" in axes.get_ylabel() for axes in figure.axes)
    picture = tmp_path / "rao.png"
    assert main(["rao", path, "--periods", "14", "--picture", str(picture)]) == 0
    assert picture.stat().st_size > 10_000
    assert str(picture) in capsys.readouterr().out


def test_the_sea_has_no_rounding_errors(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A flap on a hinge does not heave at first order: 0, not 1e-15."""
    text = (repository / "README.md").read_text().split("```toml\n")[1].split("```")[0]
    case = tmp_path / "flap.toml"
    case.write_text(text.replace('"cases/', f'"{repository}/cases/'))
    assert main(["rao", str(case)]) == 0
    sea = capsys.readouterr().out.partition("in the sea of the case")[2]
    assert "bodies/flap/heave                        0 m" in sea
