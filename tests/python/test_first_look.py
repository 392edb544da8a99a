"""What a newcomer's first look finds: overview picture, exchange with xarray, axes in the file."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray
from scipy.spatial.transform import Rotation

import hydrodae
from hydrodae.commands import cli
from hydrodae.pictures.panels import overview
from hydrodae.results import ChannelError, Results, ResultsError
from hydrodae.results.post import absorbed_power, mean_absorbed_power

CASE = """
title = "Arm on a turned hinge"

[[body]]
name = "base"
motion = "fixed"
mass = 10.0
center_of_gravity = [1.0, 0.0, 0.0]

[[body]]
name = "arm"
mass = 2.0
center_of_gravity = [2.0, 0.0, -1.0]
inertia = [0.2, 0.3, 0.4]
initial.angular_velocity = [0.0, 0.5, 0.0]
initial.velocity = [-0.5, 0.0, 0.0]

[[joint]]
name = "hinge"
type = "revolute"
body_a = "base"
body_b = "arm"
point = [2.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]

[[force]]
name = "pto"
type = "pto_linear"
joint = "hinge"
damping = 1.5

[[marker]]
name = "tip"
body = "arm"
point = [2.0, 0.0, -2.0]
axes = "body"

[solver]
end_time = 4.0
rtol = 1e-8

[output]
step = 0.01
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Results:
    path = tmp_path_factory.mktemp("look") / "run.h5"
    return hydrodae.run(hydrodae.Case.from_text(CASE), path)


def test_energy_lines_are_named(run: Results) -> None:
    panel = next(panel for panel in overview(run) if panel.quantity == "energy")
    labels = [line.label for line in panel.lines]
    assert "work of pto" in labels
    assert "kinetic" in labels
    assert len(set(labels)) == len(labels)
    assert panel.unit == "J"


def test_overview_has_elevation_coordinates_and_reactions(run: Results, results_writer) -> None:
    panels = {panel.quantity: panel for panel in overview(run)}
    assert {"joint angle", "reaction force", "energy"} <= set(panels)
    (force,) = panels["reaction force"].lines
    size = np.linalg.norm(run["joints/hinge/reaction_force"].to_numpy(), axis=1)
    assert force.label == "hinge"
    assert np.allclose(force.values, size)
    time = np.linspace(0, 10, 101)
    wave = np.sin(time)
    channels = {
        "sea/elevation": (wave, "m", "world"),
        "joints/ball/angle": (0.1 * wave, "rad", "marker A of ball"),
        "joints/ball/angle_2": (0.2 * wave, "rad", "marker A of ball"),
        "joints/ball/angle_rate": (0.2 * wave, "rad/s", "marker A of ball"),
        "joints/slide/displacement_3": (wave, "m", "marker A of slide"),
        "constraints/stop/reaction": (2e6 * wave, "N", "-"),
        "constraints/open/reaction": (0 * wave, "N", "-"),
    }
    made = {p.quantity: p for p in overview(Results.read(results_writer(time, channels=channels)))}
    assert [line.label for line in made["joint angle"].lines] == ["ball", "ball 2"]
    assert [line.label for line in made["joint displacement"].lines] == ["slide 3"]
    assert next(iter(made)) == "elevation"
    assert made["constraint load"].unit == "MN"
    assert [line.label for line in made["constraint load"].lines] == ["stop"]


def test_absorbed_power_is_that_of_the_damper(run: Results) -> None:
    rate = run["joints/hinge/angle_rate"].to_numpy()
    power = absorbed_power(run, "pto")
    assert power.attrs["unit"] == "W"
    assert np.allclose(power, 1.5 * rate**2, rtol=1e-9, atol=1e-12)
    mean = np.trapezoid(power.to_numpy()[100:], run.time[100:]) / 3.0
    assert mean_absorbed_power(run, "pto", 1.0) == pytest.approx(mean, rel=1e-4)
    with pytest.raises(ChannelError, match="forces/pt"):
        absorbed_power(run, "pt")
    with pytest.raises(ValueError, match="not before the end"):
        mean_absorbed_power(run, "pto", 4.0)


def test_xarray_opens_the_file_itself(run: Results) -> None:
    with xarray.open_datatree(run.path) as tree:
        angle = tree["joints/hinge/angle"]
        assert angle.dims == ("time",)
        assert np.array_equal(angle.time, run.time)
        force = tree["joints/hinge/reaction_force"]
        assert force.dims == ("time", "component")
        assert np.array_equal(force.coords["component"], ["x", "y", "z"])
        assert np.array_equal(force, run["joints/hinge/reaction_force"])
        turn = tree["bodies/arm/orientation"]
        assert np.array_equal(turn.coords["quaternion"], ["w", "x", "y", "z"])
        assert float(angle.sel(time=1.0, method="nearest")) == float(run["joints/hinge/angle"][100])


def test_labels_are_no_channels(run: Results) -> None:
    assert not {"component", "quaternion", "time"} & set(run)


@pytest.mark.parametrize("own", ["kernel", "written"])
def test_to_netcdf_and_back(own: str, run: Results, results_file: Path, tmp_path: Path) -> None:
    results = run if own == "kernel" else Results.read(results_file)
    path = results.to_netcdf(tmp_path / "a" / "copy.nc")
    with xarray.open_datatree(path, engine="netcdf4") as tree:
        for name in results:
            copy = tree[name]
            assert np.array_equal(copy, results[name])
            assert copy.dims == results[name].dims
            assert copy.attrs["unit"] == results[name].attrs["unit"]
        assert tree.attrs["title"] == results.title
    with pytest.raises(ResultsError, match="the results file itself"):
        results.to_netcdf(results.path)


def test_a_dataset_can_be_written(run: Results, tmp_path: Path) -> None:
    run.to_dataset("joints/*").to_netcdf(tmp_path / "flat.nc")
    with xarray.open_dataset(tmp_path / "flat.nc", engine="netcdf4") as copy:
        assert np.array_equal(copy["joints.hinge.angle"], run["joints/hinge/angle"])
        assert copy["joints.hinge.angle"].attrs["units"] == "rad"
        assert copy["time"].attrs["units"] == "s"
        assert copy["time"].dtype == float


def test_patterns(run: Results) -> None:
    with pytest.raises(ChannelError, match=r"pattern of 4 channels.*to_dataset\('joints/\*'\)"):
        run["joints/*"]
    for ask in (run.__getitem__, run.to_dataset, run.to_datatree):
        with pytest.raises(
            ChannelError, match=r"no channel matches the pattern 'joints/\*/torque'"
        ):
            ask("joints/*/torque")
    assert run.channels("nothing*") == []


def test_axes_of_joints_and_markers_stand_in_the_file(run: Results) -> None:
    """The hinge about +y: x ahead, y down, z across; on the base, at the hinge's point."""
    with h5py.File(run.path) as file:
        for name in ("joints/hinge/reaction_force", "joints/hinge/reaction_moment"):
            attributes = file[name].attrs
            assert attributes["axis_x"] == pytest.approx([1, 0, 0])
            assert attributes["axis_y"] == pytest.approx([0, 0, -1])
            assert attributes["axis_z"] == pytest.approx([0, 1, 0])
            assert attributes["origin"] == pytest.approx([2, 0, 0])
            assert "body base" in attributes["description"] or "force" in attributes["description"]
        tip = file["markers/tip/velocity"].attrs
        assert tip["origin"] == pytest.approx([2, 0, -2])
        assert tip["axis_z"] == pytest.approx([0, 0, 1])


def test_reactions_along_the_axes_that_are_stated_carry_the_weight(run: Results) -> None:
    """m a = weight + reaction, in world axes."""
    reaction = run["joints/hinge/reaction_force"]
    axes = np.stack([reaction.attrs[f"axis_{k}"] for k in "xyz"], axis=1)
    force = reaction.to_numpy() @ axes.T + 2.0 * np.array([0, 0, -9.81])
    assert np.allclose(force, 2.0 * run["bodies/arm/acceleration"].to_numpy(), atol=1e-4)


def test_reactions_on_a_body_that_moves_turn_with_it() -> None:
    """The hand of a turned arm in free fall on two hinges: R of body A times the axes stated."""
    hand = """
[[body]]
name = "hand"
mass = 1.0
center_of_gravity = [2.0, 0.3, -3.0]
inertia = [0.1, 0.1, 0.1]

[[joint]]
name = "wrist"
type = "revolute"
body_a = "arm"
body_b = "hand"
point = [2.0, 0.0, -2.0]
axis = [1.0, 0.0, 0.0]
initial.angle_deg = 20.0

[solver]
"""
    kept = [line for line in CASE.splitlines() if not line.startswith("initial.")]
    text = "\n".join(kept).replace("[solver]", hand)
    values = {"joint.hinge.initial.angle_deg": 50.0, "solver.end_time": 2.0}
    results = hydrodae.run(hydrodae.Case.from_text(text).with_values(values))
    reaction = results["joints/wrist/reaction_force"]
    axes = np.stack([reaction.attrs[f"axis_{k}"] for k in "xyz"], axis=1)
    w, *xyz = results["bodies/arm/orientation"].to_numpy().T
    turn = Rotation.from_quat(np.stack([*xyz, w], axis=1))
    force = turn.apply(reaction.to_numpy() @ axes.T) + np.array([0, 0, -9.81])
    assert np.ptp(results["bodies/arm/rotation"].to_numpy()[:, 1]) > 0.5
    np.testing.assert_allclose(force, results["bodies/hand/acceleration"], atol=1e-4)


def test_velocity_of_a_marker_along_the_axes_that_are_stated(run: Results) -> None:
    along = run["markers/tip/velocity"].to_numpy()
    angle = run["bodies/arm/rotation"].to_numpy()[:, 1]
    world = np.gradient(run["markers/tip/position"].to_numpy(), run.time, axis=0)
    c, s = np.cos(angle), np.sin(angle)
    turned = np.stack([c * along[:, 0] + s * along[:, 2], -s * along[:, 0] + c * along[:, 2]], 1)
    assert np.allclose(turned[2:-2], world[2:-2][:, [0, 2]], atol=1e-3)


def test_version_option(kernel, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        cli.main(["--version"])
    assert end.value.code == 0
    asked = capsys.readouterr().out
    assert cli.main(["version"]) == 0
    assert asked == capsys.readouterr().out


def test_figure_of_the_conventions(repository: Path, tmp_path: Path) -> None:
    import runpy

    script = repository / "docs" / "axes_figure.py"
    made = runpy.run_path(str(script))["draw"](tmp_path / "axes.png")
    assert made.stat().st_size > 20_000
    text = (repository / "docs" / "conventions.md").read_text()
    assert "axes.png" in text
    assert (repository / "docs" / "axes.png").is_file()


def test_pictures_of_the_quick_start(repository: Path, tmp_path: Path) -> None:
    """The first shows waves and power; its means stand in cases/f3of/README.md."""
    import runpy

    results = hydrodae.run(repository / "cases" / "f3of" / "waves.toml")
    script = runpy.run_path(str(repository / "cases" / "f3of" / "waves_figure.py"))
    assert script["draw"](results, tmp_path / "waves.png").stat().st_size > 20_000
    assert "flap 1 33.7 kW, flap 2 24.3 kW" in script["report"](results)
    told = (repository / "cases" / "f3of" / "README.md").read_text()
    assert "33.7 kW of flap 1 and 24.3 kW of flap 2" in told
    commands = (repository / "cases" / "quickstart.sh").read_text()
    assert commands.index("waves_figure.py") < commands.index("f3of/figure.py")
