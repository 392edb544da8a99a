"""Pictures: what is drawn, in which unit, with which label."""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from types import ModuleType

import h5py
import matplotlib
import numpy as np
import pytest

import hydrodae
from hydrodae import plot
from hydrodae.errors import CaseError
from hydrodae.pictures.curve import Curve, parse_curve, read_curve
from hydrodae.pictures.panels import MOST_LINES, Line, Panel, most_moving, overview, select, spectra
from hydrodae.results import Results
from hydrodae.results.post import turning_points


@pytest.fixture
def results(results_file) -> Results:
    return Results.read(results_file)


@pytest.fixture(scope="module")
def f3of_figure(repository) -> ModuleType:
    """cases/f3of/figure.py as a module."""
    path = repository / "cases" / "f3of" / "figure.py"
    spec = importlib.util.spec_from_file_location("f3of_figure", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_overview_shows_angles_in_degrees_and_leaves_out_what_rests(results):
    panels = {panel.label: panel for panel in overview(results)}
    assert list(panels) == [
        "joint angle [deg]",
        "body displacement\nfrom the start [m]",
        "body rotation [deg]",
        "energy [kJ]",
    ]
    angle = panels["joint angle [deg]"].lines[0]
    assert angle.label == "hinge1"
    assert angle.values[0] == pytest.approx(10.0)
    moving = [line.label for line in panels["body displacement\nfrom the start [m]"].lines]
    assert moving == ["flap1 x", "flap1 z", "flap2 x"]
    assert [line.label for line in panels["body rotation [deg]"].lines] == ["flap1 y", "flap2 y"]


def test_energies_share_a_scale_and_potential_counts_from_its_least(results):
    panel = overview(results)[-1]
    lines = {line.label: line.values for line in panel.lines}
    assert set(lines) == {"kinetic", "kinetic added mass", "potential from its least"}
    assert lines["potential from its least"].min() == 0.0
    largest = 3e6 * np.max(results["joints/hinge1/angle_rate"].to_numpy() ** 2) / 1e3
    assert lines["kinetic added mass"].max() == pytest.approx(largest)


def test_named_channels_have_prefixes_of_their_units_but_for_lengths_and_angles(results):
    names = ["energy/kinetic", "joints/hinge1/angle", "bodies/flap1/position"]
    kinetic, angle, position = plot.plot_channels(results, names).axes
    assert kinetic.get_ylabel() == "energy [kJ]"
    largest = results["energy/kinetic"].max().item() / 1e3
    assert np.max(kinetic.lines[0].get_ydata()) == pytest.approx(largest)
    assert [angle.get_ylabel(), position.get_ylabel()] == ["angle [deg]", "position [m]"]


def test_lines_that_fall_on_each_other_are_both_seen(results_writer):
    time = np.linspace(0.0, 10.0, 101)
    wave = np.sin(time)
    channels = {
        f"joints/{name}/angle": (values, "rad", f"marker A of {name}")
        for name, values in {"a": wave, "b": 1.001 * wave, "c": 1.1 * wave, "d": wave}.items()
    }
    results = Results.read(results_writer(time, channels=channels))
    (axes,) = plot.plot_channels(results, ["joints/*/angle"]).axes
    assert [line.get_linestyle() for line in axes.lines] == ["-", "--", "-", "--"]


def test_overview_shows_powers_with_their_means_tensions_and_spectra(results_writer):
    time = np.linspace(0.0, 600.0, 6001)
    wave = np.sin(2 * np.pi * time / 9.0)
    channels = {
        "sea/elevation": (wave, "m", "world"),
        "joints/hinge/angle": (np.radians(2.0) * wave, "rad", "marker A of hinge"),
        "forces/pto/power_absorbed": (8e4 * wave**2, "W", "-"),
        "forces/bow/tension": (5e5 + 1e5 * wave, "N", "-"),
        "forces/bow/tension_anchor": (4e5 + 1e5 * wave, "N", "-"),
        "forces/bow/tension_ratio": (0.1 + 0 * wave, "-", "-"),
    }
    path = results_writer(time, channels=channels)
    with h5py.File(path, "a") as file:
        file["solver"].attrs["mean_power_absorbed.pto"] = 4e4
        file["solver"].attrs["mean_power_from"] = 60.0
    results = Results.read(path)
    panels = {panel.quantity: panel for panel in overview(results)}
    (power,) = panels["absorbed power"].lines
    assert power.label == "pto, mean 40 kW"
    assert power.level == pytest.approx(40.0)
    assert panels["absorbed power"].note == "level, dashed: mean after 60 s"
    assert [line.label for line in panels["tension"].lines] == ["bow", "bow anchor"]
    assert panels["tension"].unit == "kN"
    figure = plot.plot_overview(results)
    assert [axes.get_ylabel() for axes in figure.axes][-2:] == [
        "elevation\nspectrum [m$^2$ s/rad]",
        "joint angle\nspectrum [deg$^2$ s/rad]",
    ]
    assert figure.axes[-1].get_xlabel() == "angular frequency [rad/s]"
    assert figure.axes[-3].get_xlabel() == "time [s]"
    line = figure.axes[-1].lines[0]
    variance = np.trapezoid(np.asarray(line.get_ydata()), np.asarray(line.get_xdata()))
    assert variance == pytest.approx(2.0, rel=0.02)  # 2 deg amplitude
    assert 2 * np.pi / 9.0 < figure.axes[-1].get_xlim()[1] < 2.0


def test_overview_figure_has_units_on_all_axes(results):
    figure = plot.plot_overview(results)
    assert all("[" in axes.get_ylabel() for axes in figure.axes)
    assert figure.axes[-1].get_xlabel() == "time [s]"
    assert figure.axes[0].get_title(loc="left") == "Flap decay"


def test_partial_run_is_marked_in_the_title(results_writer):
    partial = Results.read(results_writer(np.linspace(0, 30, 301), status="failed"))
    title = plot.plot_overview(partial).axes[0].get_title(loc="left")
    assert title == "Flap decay (failed at t = 30 s)"


def test_run_without_samples_cannot_be_drawn(results_writer):
    with pytest.raises(CaseError, match="nothing to draw"):
        plot.plot_overview(Results.read(results_writer(np.empty(0), status="failed")))


def test_run_that_stopped_at_its_start_is_drawn_without_a_warning(results_writer):
    stopped = Results.read(results_writer(np.zeros(1), status="interrupted"))
    assert "interrupted at t = 0 s" in plot.plot_overview(stopped).axes[0].get_title(loc="left")


def test_channels_of_one_quantity_share_a_panel(results):
    names = ["joints/*/angle", "joints/hinge1/angle_rate", "bodies/flap1/position.z"]
    figure = plot.plot_channels(results, names)
    labels = [axes.get_ylabel() for axes in figure.axes]
    assert labels == ["angle [deg]", "angle rate [deg/s]", "position [m]"]
    assert [len(axes.lines) for axes in figure.axes] == [2, 1, 1]
    drawn = np.asarray(figure.axes[2].lines[0].get_ydata())
    assert np.array_equal(drawn, results["bodies/flap1/position"].sel(component="z"))


def test_components_and_labels(results):
    assert [line.label for line in select(results, "bodies/base/position")] == [
        "base x",
        "base y",
        "base z",
    ]
    (line,) = select(results, "energy/kinetic")
    assert (line.label, line.quantity, line.unit) == ("kinetic", "energy", "J")


def test_crowded_panel_keeps_the_lines_that_move_most():
    spans = [0.0, 5.0, 1.0, 9.0, 0.0, 2.0, 3.0, 4.0, 6.0, 7.0, 8.0]
    lines = [Line(f"line{i}", "q", "m", np.array([0.0, s])) for i, s in enumerate(spans)]
    panel = most_moving(Panel("q", "m", lines))
    assert [line.span for line in panel.lines] == [5.0, 9.0, 2.0, 3.0, 4.0, 6.0, 7.0, 8.0]
    assert panel.note == f"largest {MOST_LINES} of 11"


def test_comparison_draws_ours_in_degrees_over_theirs(results):
    theirs = Curve("theirs", np.array([0.0, 50.0, 400.0]), np.array([1.0, 2.0, 99.0]))
    points = Curve(
        "points", np.array([7.0]), np.array([-9.0]), points=True, spread=np.array([[-9.5], [-8.8]])
    )
    figure = plot.plot_comparison(results, "joints/hinge1/angle", [theirs, points], end_time=60.0)
    (axes,) = figure.axes
    assert axes.get_ylabel() == "hinge1 angle [deg]"
    assert axes.get_xlim() == (0.0, 60.0)
    ours = axes.lines[-1]
    assert ours.get_label() == "hydrodae"
    assert np.asarray(ours.get_ydata())[0] == pytest.approx(10.0)
    # what lies beyond the time axis does not stretch the other one
    assert np.array_equal(axes.lines[0].get_xdata(), [0.0, 50.0])
    assert axes.get_ylim()[1] < 20.0
    legend = axes.get_legend()
    assert legend is not None
    assert {text.get_text() for text in legend.get_texts()} == {"hydrodae", "theirs", "points"}


def test_pictures_leave_no_global_trace(results):
    before = {key: matplotlib.rcParams[key] for key in plot.STYLE}
    plot.plot_overview(results)
    assert {key: matplotlib.rcParams[key] for key in plot.STYLE} == before
    program = (
        "import sys; from hydrodae import Results, plot;"
        "plot.plot_overview(Results.read(sys.argv[1]));"
        "sys.exit('matplotlib.pyplot' in sys.modules)"
    )
    subprocess.run([sys.executable, "-c", program, str(results.path)], check=True)


def test_saved_picture_is_a_png_of_some_size(results, tmp_path):
    path = plot.save(plot.plot_overview(results), tmp_path / "a" / "overview.png")
    data = path.read_bytes()
    assert data.startswith(b"\x89PNG")
    width, height = (int.from_bytes(data[i : i + 4]) for i in (16, 20))
    assert width >= 1000
    assert height >= 1000


def test_curve_of_a_csv_file(tmp_path):
    path = tmp_path / "curve.csv"
    path.write_text("t_s, a_rad ,b_deg\n0,0.1,\n1,0.2,5\n2,,6\n")
    curve = parse_curve(f"{path}:a_rad:code A:57.29577951308232")
    assert curve.label == "code A"
    assert curve.values == pytest.approx(np.degrees([0.1, 0.2]))
    assert read_curve(path, "b_deg").time.tolist() == [1.0, 2.0]
    path.write_text("t_s,a\n0,1\n1,x\n")
    with pytest.raises(CaseError, match=r"curve.csv:3: expected numbers .* got 'x'"):
        read_curve(path, "a")


def test_published_extrema_of_the_f3of_figure_are_those_of_the_codes(f3of_figure, reference):
    file = reference / "f3of" / "dt3_flap1_decay.csv"
    times, angles = [], []
    for column in f3of_figure.CODES:
        if column == f3of_figure.UNCOUPLED:
            continue
        curve = read_curve(file, column).until(60.0)
        t, x = turning_points(curve.time, curve.values)
        times.append(t[: len(f3of_figure.PUBLISHED)])
        angles.append(x[: len(f3of_figure.PUBLISHED)])
    expected = np.stack([np.min(times, 0), np.max(times, 0), np.min(angles, 0), np.max(angles, 0)])
    assert f3of_figure.PUBLISHED == pytest.approx(expected.T, abs=0.0051)


@pytest.mark.parametrize("with_reference", [True, False])
def test_f3of_figure_with_and_without_reference_data(
    f3of_figure, results, tmp_path, monkeypatch, request, with_reference
):
    file = None
    if with_reference:
        file = request.getfixturevalue("reference") / "f3of" / "dt3_flap1_decay.csv"
    monkeypatch.setattr(f3of_figure, "reference_file", lambda: file)
    picture = f3of_figure.draw(results, tmp_path / "figure.png", 100.0)
    assert picture.stat().st_size > 20_000
    rows = f3of_figure.comparison(results).splitlines()
    assert len(rows) == 1 + len(f3of_figure.PUBLISHED)
    assert "minimum         -9.33 deg at  6.95 s" in rows[1]


@pytest.mark.parametrize(
    "sea",
    [
        'type = "jonswap"\nsignificant_height = 2.0\npeak_period = 8.0\ngamma = 2.0',
        'type = "bretschneider"\nsignificant_height = 2.0\npeak_period = 8.0',
        'type = "pierson_moskowitz"\nsignificant_height = 2.0',
        'type = "ochi_hubble"\nsignificant_height = 2.0\npeak_period = 8.0\nshape = 3.0',
        'type = "table"\nfrequency = [0.5, 0.8, 1.6]\ndensity = [0.0, 0.7, 0.1]',
    ],
)
def test_targets_are_the_seas_that_the_kernel_draws(sea):
    """Variance of the components in bands, each component one bin of equal energy."""
    import tomllib

    from hydrodae import _core
    from hydrodae.pictures.target import density

    text = f"""
[environment]
water_density = 1025.0
[[wave]]
name = "sea"
{sea}
components = 4000
frequency_range = [0.4, 2.5]
[[body]]
name = "stone"
mass = 1.0
inertia = [1.0, 1.0, 1.0]
center_of_gravity = [0.0, 0.0, 0.0]
[[morison]]
name = "drag"
body = "stone"
point = [0.0, 0.0, -1.0]
area = 1.0
drag_coefficient = 1.0
[solver]
end_time = 1.0
"""
    wave = tomllib.loads(text)["wave"][0]
    components = _core.wave_components(_core.parse_case(text, ".", {}))
    omega = np.linspace(0.4, 2.5, 20001)
    target = density(wave, omega)
    variance = 0.5 * components[:, 2] ** 2
    whole = float(np.trapezoid(target, omega))
    assert variance.sum() == pytest.approx(whole, rel=1e-3)
    for low, high in ((0.4, 0.7), (0.7, 0.8), (0.8, 1.0), (1.0, 2.5)):
        inside = (omega >= low) & (omega <= high)
        mine = variance[(components[:, 0] >= low) & (components[:, 0] < high)].sum()
        want = np.trapezoid(target[inside], omega[inside])
        assert mine == pytest.approx(want, abs=2e-3 * whole)


def test_pictures_of_waves_have_the_pto_force_and_the_target(tmp_path):
    from hydrodae.starters import create

    case = create("point_absorber", tmp_path / "buoy")
    results = hydrodae.run(case, set={"solver.end_time": 300.0})
    panels = {panel.quantity: panel for panel in [*overview(results), *spectra(results)]}
    force = results["forces/pto/force"].to_numpy()
    (line,) = panels["PTO force"].lines
    assert line.unit == "kN"
    np.testing.assert_allclose(line.values, force / 1e3)
    elevation = panels["elevation\nspectrum"]
    assert elevation.target is not None
    omega, target = elevation.target
    height = 4.0 * np.sqrt(np.trapezoid(target, omega))
    assert f"{height:.3g} m" in elevation.note
    assert panels["joint displacement\nspectrum"].target is None
