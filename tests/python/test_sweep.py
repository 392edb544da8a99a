"""Sweeps: points, measures, failures, and what a kill leaves."""

from __future__ import annotations

import json
import multiprocessing
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray
from scipy.stats import t as student
from tests.errors import wrong
from tests.scenes import cart

import hydrodae
from hydrodae.starters import create
from hydrodae.study.sweep import text
from hydrodae.study.sweep.batches import run_case
from hydrodae.study.sweep.fatigue import damage_equivalent_load
from hydrodae.study.sweep.measures import Measure
from hydrodae.study.sweep.plan import read_study
from hydrodae.support.units import prefixed

CASE = cart(
    "damping = 1.0",
    title="Mass on a spring with a take-off",
    body="float",
    motion="heave",
    initial={"velocity": [0.0, 0.0, 1.0]},
    joint="guide",
    solver="end_time = 8.0",
    step=0.02,
)
SPEED = "body.float.initial.velocity"
RESULT = '[result.x]\nchannel = "joints/guide/displacement"\n'


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "case.toml").write_text(CASE)
    return tmp_path


def write_study(folder: Path, text: str) -> Path:
    path = folder / "study.toml"
    path.write_text('case = "case.toml"\n' + text)
    return path


def test_grid_has_its_keys_as_dimensions(folder: Path) -> None:
    """A damper stops the mass: v = v0 exp(-c t / m), way v0 m / c, power m v0^2 / 2 (1 - ...)."""
    study = write_study(
        folder,
        '[grid]\n"force.pto.damping" = { from = 1.0, to = 2.0, count = 3 }\n'
        '"body.float.mass" = [2.0, 4.0]\n'
        '[result.way]\nchannel = "joints/guide/displacement"\nstatistic = "last"\n',
    )
    found = hydrodae.sweep(study, folder / "study.nc", jobs=2)
    assert dict(found.sizes) == {"damping": 3, "mass": 2}
    assert (found["status"] == "completed").all()
    c, m = found["damping"], found["mass"]
    left = np.exp(-c * 8.0 / m)
    np.testing.assert_allclose(found["way"], (m / c * (1.0 - left)).T, rtol=1e-5)
    power = 0.5 * m * (1.0 - left**2) / 8.0  # (mass, damping)
    np.testing.assert_allclose(found["mean_power_absorbed"], power.T, rtol=1e-5)
    assert found["way"].attrs["units"] == "m"
    xarray.testing.assert_identical(found.load(), xarray.load_dataset(folder / "study.nc"))


def test_one_row_a_point_is_printed(folder: Path) -> None:
    """Power c v0^2 / 2 over a long run: the energy of the mass, 0.5 J each kilogram, in 8 s."""
    study = write_study(
        folder, '[list]\n"force.pto.damping" = [2e3, 4e3]\n"body.float.mass" = [32e3, 64e3]\n'
    )
    lines = text(hydrodae.sweep(study, folder / "study.nc", jobs=1)).splitlines()
    start = lines.index("mean absorbed power, kW:")
    assert [line.split() for line in lines[start + 1 : start + 4]] == [
        ["damping", "mass", "[kg]", "mean", "power"],
        ["2000", "32000", "1.264"],
        ["4000", "64000", "2.528"],
    ]


def test_results_of_each_point_are_printed(folder: Path) -> None:
    """The rate of the guide at the start is 1 m/s; power or not, a row has the results."""
    study = write_study(
        folder,
        '[grid]\n"force.pto.damping" = [2e3, 4e3]\n'
        '[result.fastest]\nchannel = "joints/guide/displacement_rate"\nstatistic = "max"\n',
    )
    results = hydrodae.sweep(study, folder / "study.nc", jobs=1)
    power = ["0.125", "0.125"]  # 1 J in 8 s
    fastest = [f"{float(x):.6g}" for x in results["fastest"]]
    lines = [line.split() for line in text(results).splitlines()]
    assert lines[-3][1:4] == ["mean", "power", "fastest"]
    assert [line[1:] for line in lines[-2:]] == [
        [p, f] for p, f in zip(power, fastest, strict=True)
    ]
    alone = text(results.drop_vars("mean_power_absorbed")).splitlines()
    assert [line.split()[1] for line in alone[-2:]] == fastest


def test_points_of_all_kinds(folder: Path) -> None:
    (folder / "points.csv").write_text("body.float.mass, solver.end_time\n2.0, 1.0\n3.0, 2.0\n")
    study = read_study(
        write_study(
            folder,
            '[list]\n"force.pto.damping" = [1.0, 2.0]\n"force.pto.stiffness" = [3.0, 4.0]\n'
            "[latin_hypercube]\nsamples = 5\n"
            '[latin_hypercube.range]\n"solver.rtol" = [1e-6, 1e-5]\n'
            '[table]\nfile = "points.csv"\n',
        )
    )
    assert len(study.points) == 2 * 5 * 2
    assert not study.dimensions
    pairs = {(p["force.pto.damping"], p["force.pto.stiffness"]) for p in study.points}
    assert pairs == {(1.0, 3.0), (2.0, 4.0)}
    parts = sorted((p - 1e-6) // 1.8e-6 for p in {p["solver.rtol"] for p in study.points})
    assert parts == [0, 1, 2, 3, 4]  # one in each fifth of the range
    assert {p["body.float.mass"] for p in study.points} == {2.0, 3.0}


def test_failed_runs_are_rows_with_their_reason(folder: Path) -> None:
    study = write_study(folder, '[grid]\n"body.float.mass" = [2.0, -1.0]\n')
    found = hydrodae.sweep(study, folder / "study.nc", jobs=1)
    assert list(found["status"].values) == ["completed", "refused"]
    assert "mass" in str(found["reason"].values[1])
    assert np.isnan(found["mean_power_absorbed"].values[1])


def test_means_over_repetitions_and_annual_energy(folder: Path) -> None:
    (folder / "scatter.csv").write_text("height,period,hours\n1.0,2.0,10\n2.0,2.0,30\n")
    study = write_study(
        folder,
        'over = ["solver.end_time"]\n'
        '[grid]\n"force.pto.damping" = [1.0, 2.0]\n"body.float.mass" = [2.0]\n'
        '"solver.end_time" = [4.0, 6.0, 8.0]\n'
        '[scatter]\nfile = "scatter.csv"\nheight = "force.pto.damping"\n'
        'period = "body.float.mass"\n',
    )
    found = hydrodae.sweep(study, folder / "study.nc", jobs=2)
    each = found["mean_power_absorbed"].values[:, 0, :]
    np.testing.assert_allclose(found["mean_power_absorbed_mean"].values[:, 0], each.mean(axis=1))
    half = student.ppf(0.975, 2) * each.std(axis=1, ddof=1) / np.sqrt(3.0)
    np.testing.assert_allclose(found["mean_power_absorbed_interval"].values[:, 0], half)
    joules = 3600.0 * (10.0 * each[0].mean() + 30.0 * each[1].mean())
    assert float(found["annual_energy"]) == pytest.approx(joules)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "nothing varies"),
        ("[gird]\n", "did you mean 'grid'"),
        ('[grid]\n"body.float.mas" = [1.0]\n', r"toml: body\.float\.mas: .*mass"),
        ("[grid]\na = [1, 2.0, 1.0]\n", "'a': 1.0 stands there twice"),
        (f"[grid]\na = {{ from = 1, to = {10**400}, count = 2 }}\n", "numbers 'from' and 'to'"),
        ("[list]\na = [1]\nb = [1, 2]\n", "all need as many"),
        ("[grid]\na = [1]\n[list]\na = [1]\n", "two tables"),
        ('[grid]\na = [1]\n[result.x]\nchannel = "c"\nstatistic = "men"\n', "did you mean 'mean'"),
        (
            '[grid]\n"body.float.mass" = [1.0]\n[result.x]\nchannel = "joints/guide/angle"\n',
            "displ",
        ),
        ("[grid]\na = { from = 1, to = 2, count = 1000000000 }\n", "whole 'count' from 1"),
        ('[grid]\na = { from = "1", to = 2, count = 2 }\n', "numbers 'from' and 'to'"),
        ("[grid]\na = { from = 1, to = 2, count = 2.5 }\n", "whole 'count' from 1"),
        (
            "".join(["[grid]\n", *(f"{k} = {{from=1, to=2, count=2000}}\n" for k in "ab")]),
            "4000000 points",
        ),
        ("[grid]\na = [2020-01-01]\n", "date"),
        ("[latin_hypercube]\nsamples = true\n", "whole number"),
        ("[latin_hypercube]\nsamples = 2\nseed = -1\nrange = {a = [1, 2]}\n", "'seed'"),
        ("[latin_hypercube]\nsamples = 2\nrange = {a = [2, 1]}\n", "least, most"),
        ("[latin_hypercube]\nsamples = 2\nrange = {a = [1]}\n", "least, most"),
        ('[table]\nfile = "twice.csv"\n', "column 'a' stands there twice"),
        ('over = [["a"]]\n[grid]\na = [1]\n', "keys of the study"),
        ('[grid]\na = [1]\n[result.status]\nchannel = "c"\n', "take another name"),
        ('[grid]\na = [1]\n[result.a]\nchannel = "c"\n', "another column 'a'"),
        ('[grid]\na = [1]\n[result."x/y"]\nchannel = "c"\n', "letters"),
        ("[grid]\na = [1]\n[result.x]\nchannel = 3\n", "expected a text"),
        ('[grid]\na = [1]\n[result.x]\nchannel = "c"\nfrom = "x"\n', "time in s"),
        ('[grid]\na = [1]\n[result.x]\nchannel = "c"\nterms = []\n', "or with 'terms'"),
        ("[grid]\na = [1]\n[result.x]\nterms = [{ factor = 1 }]\n", "expected a list such as"),
        ('[grid]\na = [1]\n[result.x]\nchannel = "c"\nunit = "W"\n', "belongs to 'terms'"),
        (
            '[grid]\na = [1]\n[result.x]\nterms = [{ channel = "c", factor = "1" }]\n',
            "factor \\(a number\\)",
        ),
        ('[grid]\na = [1]\n[result.x]\nterms = [{ channel = "c", power = 0 }]\n', "power >= 1"),
        (
            '[grid]\n"body.float.mass" = [1.0]\n' + RESULT + 'over = "y"\n',
            "'y' is no result; known: .*mean_power_absorbed",
        ),
        (
            '[grid]\n"body.float.mass" = [1.0]\n[result.x]\n'
            'channel = "bodies/float/position"\ncomponent = "q"\n',
            "components x, y, z; got 'q'",
        ),
        (
            '[grid]\nh = [1.0]\nt = [5.0]\n[scatter]\nfile = "seas.csv"\n'
            'height = "h"\nperiod = "t"\n',
            "lacks: 9 m, 5 s",
        ),
        (
            '[grid]\nh = [9.0]\nt = [5.0]\nx = [1.0]\n[scatter]\nfile = "seas.csv"\n'
            'height = "h"\nperiod = "t"\n',
            "needs a .grid. of height and period",
        ),
        (
            '[grid]\nh = [9.0]\nt = [5.0]\n[scatter]\nfile = "negative.csv"\n'
            'height = "h"\nperiod = "t"\n',
            "negative or not finite",
        ),
    ],
)
def test_wrong_studies_are_refused(folder: Path, text: str, told: str) -> None:
    (folder / "twice.csv").write_text("a,a\n1,2\n")
    (folder / "seas.csv").write_text("height,period,hours\n9.0,5.0,10\n")
    (folder / "negative.csv").write_text("height,period,hours\n9.0,5.0,-10\n")
    with pytest.raises(hydrodae.CaseError, match=told):
        hydrodae.sweep(write_study(folder, text), folder / "study.nc", jobs=1)


def test_what_is_no_study_is_told_as_what_it_is(folder: Path) -> None:
    with pytest.raises(hydrodae.CaseError, match=r'is a case; a study names one, case = "case'):
        hydrodae.sweep(folder / "case.toml", folder / "x.nc")
    with pytest.raises(hydrodae.CaseError, match="is a folder"):
        hydrodae.sweep(folder, folder / "x.nc")
    (folder / "figure.toml").write_bytes(b"\x89PNG\r\n\x1a\n")
    with pytest.raises(hydrodae.CaseError, match="is a picture; a study is a TOML file"):
        hydrodae.sweep(folder / "figure.toml", folder / "x.nc")
    study = write_study(folder, '[grid]\n"force.pto.damping" = [1]\n')
    study.write_bytes(b"\xef\xbb\xbf" + study.read_bytes())  # the mark of the byte order is no key
    with pytest.raises(hydrodae.CaseError, match=r"expected a name that ends in \.nc"):
        hydrodae.sweep(study, folder / "x.csv")


def test_no_job_at_a_time_is_refused(folder: Path) -> None:
    study = write_study(folder, '[grid]\n"body.float.mass" = [2.0]\n')
    for jobs in (0, -3):
        with wrong("jobs"):
            hydrodae.sweep(study, folder / "study.nc", jobs=jobs)


def test_a_record_of_something_else_is_kept(folder: Path) -> None:
    study = write_study(folder, '[grid]\n"body.float.mass" = [2.0]\n')
    hydrodae.sweep(study, folder / "study.nc", jobs=1)
    with pytest.raises(hydrodae.CaseError, match="another case than this study's"):
        hydrodae.sweep(study, folder / "study.nc", set={"solver.end_time": 2.0}, jobs=1)
    (folder / "notes.runs.jsonl").write_text("my notes")
    with pytest.raises(hydrodae.CaseError, match="no record of a sweep"):
        hydrodae.sweep(study, folder / "notes.nc", jobs=1)
    assert (folder / "notes.runs.jsonl").read_text() == "my notes"


def test_a_killed_worker_is_one_message(folder: Path) -> None:
    """As the kernel of the system kills what takes too much memory."""
    many = list(range(1, 61))  # more than one march, and those in line behind it
    study = write_study(folder, f'[grid]\n"force.pto.damping" = {many}\n')

    def kill(done: float, _total: float) -> None:
        for child in multiprocessing.active_children():
            child.kill()

    with pytest.raises(hydrodae.SolverError, match="call the sweep again to go on"):
        hydrodae.sweep(study, folder / "study.nc", jobs=1, progress=kill)
    kept = (folder / "study.runs.jsonl").read_text().count("completed")
    assert 1 <= kept < len(many)


def test_workers_do_not_run_the_script_again(tmp_path: Path) -> None:
    """Without ``if __name__ == "__main__":`` each would begin processes of its own."""
    script = tmp_path / "script.py"
    script.write_text(
        "from hydrodae.support.processes import context\n"
        "print('script', flush=True)\n"
        "worker = context(anew=True).Process(target=print, args=('worker',))\n"
        "worker.start()\nworker.join()\nprint(worker.exitcode)\n"
    )
    found = subprocess.run([sys.executable, str(script)], capture_output=True, text=True)
    assert (found.stdout.split(), found.stderr) == (["script", "worker", "0"], "")


def test_killed_sweep_goes_on_and_runs_nothing_twice(folder: Path) -> None:
    study = write_study(folder, '[grid]\n"force.pto.damping" = { from = 1, to = 2, count = 12 }\n')
    whole = hydrodae.sweep(study, folder / "whole.nc", jobs=1)
    record = folder / "killed.runs.jsonl"
    command = [sys.executable, "-m", "hydrodae", "sweep", str(study), "--jobs", "1"]
    process = subprocess.Popen([*command, "-o", str(folder / "killed.nc")])
    deadline = time.monotonic() + 60.0
    while time.monotonic() < deadline:
        if record.exists() and record.read_bytes().count(b"\n") > 3:
            break
        time.sleep(0.005)
    process.send_signal(signal.SIGKILL)
    process.wait()
    kept = record.read_bytes().count(b"\n")
    with record.open("ab") as file:
        file.write(b'{"key": "cut o')
    again = hydrodae.sweep(study, folder / "killed.nc", jobs=1)
    xarray.testing.assert_identical(again.load(), whole.load())
    keys = [json.loads(line).get("key") for line in record.read_text().splitlines()]
    assert len(keys) == len(set(keys)) == 13
    assert kept >= 4


@pytest.mark.slow
def test_ten_kills_at_random_moments_change_nothing(folder: Path) -> None:
    study = write_study(folder, '[grid]\n"force.pto.damping" = { from = 1, to = 2, count = 60 }\n')
    whole = hydrodae.sweep(study, folder / "whole.nc", jobs=1)
    record = folder / "killed.runs.jsonl"
    command = [sys.executable, "-m", "hydrodae", "sweep", str(study), "--jobs", "2", "-q"]
    draw = np.random.default_rng(1)
    for kill in range(10):
        before = record.read_bytes().count(b"\n") if record.exists() else 0
        process = subprocess.Popen([*command, "-o", str(folder / "killed.nc")])
        while process.poll() is None:  # after some rows, and some time more
            rows = record.read_bytes().count(b"\n") if record.exists() else 0
            if rows > before + kill % 4:
                time.sleep(float(draw.uniform(0.0, 0.05)))
                break
            time.sleep(0.002)
        process.kill()
        process.wait()
    again = hydrodae.sweep(study, folder / "killed.nc", jobs=2)
    xarray.testing.assert_identical(again.load(), whole.load())
    keys = [json.loads(line).get("key") for line in record.read_text().splitlines()]
    assert len(keys) == len(set(keys)) == 61


def test_what_no_linear_rung_knows_is_refused(repository: Path) -> None:
    """It was a column that is not there."""
    case = hydrodae.Case.read(repository / "cases" / "sphere" / "wave.toml")
    for channel, statistic in (("bodies/spher/heave", "std"), ("bodies/sphere/heave", "max")):
        wanted = Measure("way", channel, statistic, None, 0.0)
        with pytest.raises(hydrodae.CaseError, match=r"\[result\.way\]: no rung of the study"):
            run_case(case, (wanted,), ("frequency",), {})


def test_rungs_of_one_study_stand_side_by_side(tmp_path: Path) -> None:
    """A heaving buoy without drag: linear response, spectral and time domain agree."""
    case = create("point_absorber", tmp_path / "buoy")
    study = case.parent / "rungs.toml"
    study.write_text(
        'case = "case.toml"\nrungs = ["time", "frequency", "spectral"]\n'
        'over = ["wave.sea.seed"]\n'
        '[grid]\n"wave.sea.significant_height" = [1.0]\n"wave.sea.peak_period" = [6.0, 8.0]\n'
        '"wave.sea.seed" = [1, 2]\n'
        '[result.heave]\nchannel = "bodies/buoy/position"\ncomponent = "z"\nstatistic = "std"\n'
        "from = 30.0\n"
        '[scatter]\nfile = "scatter.csv"\nheight = "wave.sea.significant_height"\n'
        'period = "wave.sea.peak_period"\n'
    )
    (case.parent / "scatter.csv").write_text("height,period,hours\n1.0,6.0,1000\n1.0,8.0,500\n")
    found = hydrodae.sweep(study, case.parent / "rungs.nc", set={"solver.end_time": 400.0}, jobs=1)
    assert list(found["rung"].values) == ["frequency", "spectral", "time"]
    assert (found["status"] == "completed").all()
    power = found["mean_power_absorbed_mean"].isel(significant_height=0)
    for name in ("heave", "mean_power_absorbed"):
        linear, spectral, time = (found[name].sel(rung=r) for r in found["rung"].values)
        np.testing.assert_allclose(spectral, linear, rtol=1e-4)
        np.testing.assert_allclose(time, linear, rtol=0.35)  # 400 s of a random sea
        assert found[name].attrs["units"] == ("m" if name == "heave" else "W")
    joules = 3600.0 * (1000.0 * power.isel(peak_period=0) + 500.0 * power.isel(peak_period=1))
    np.testing.assert_allclose(found["annual_energy"], joules)
    assert (found["wall_time"] > 0.0).all()
    assert "annual energy, spectral" in text(found)
    half = found["mean_power_absorbed_interval"] / found["mean_power_absorbed_mean"]
    widest = 100.0 * float(half.sel(rung="time").max())
    unit = prefixed(float(power.sel(rung="time").max()), "W")[1]
    assert f"time, {unit} (95 % interval at most {widest:.0f} % to each side; " in text(found)


def test_capture_width_is_power_over_the_flux_of_the_waves(tmp_path: Path) -> None:
    """A regular wave in deep water carries rho g^2 a^2 T / (8 pi) along each metre [W/m]."""
    case = create("point_absorber", tmp_path / "buoy")
    wave = [{"name": "sea", "type": "regular", "period": 6.0, "height": 1.0}]
    study = case.parent / "width.toml"
    study.write_text('case = "case.toml"\nrungs = ["frequency"]\n[grid]\n"solver.rtol" = [1e-6]\n')
    found = hydrodae.sweep(study, case.parent / "width.nc", set={"wave": wave}, jobs=1)
    flux = 1025.0 * 9.81**2 * 0.25 * 6.0 / (8.0 * np.pi)
    power = found["mean_power_absorbed"]
    np.testing.assert_allclose(found["capture_width"], power / flux, rtol=1e-6)
    k = (2.0 * np.pi / 6.0) ** 2 / 9.81
    assert 0.0 < float(found["capture_width"][0, 0]) < 1.0 / k  # of a heaving body of revolution


def test_damage_equivalent_load_of_equal_cycles() -> None:
    """N cycles of range S: S (N / (f T))^(1/m), whatever the samples between."""
    pytest.importorskip("rainflow")
    time = np.linspace(0.0, 100.0, 10_001)
    values = 3.0 + 2.0 * np.sin(2.0 * np.pi * 0.25 * time)  # 25 cycles of range 4
    found = damage_equivalent_load(values, 100.0, 3.0, 1.0)
    assert found == pytest.approx(4.0 * (25.0 / 100.0) ** (1.0 / 3.0), rel=0.01)
    assert damage_equivalent_load(values, 100.0, 3.0, 0.25) == pytest.approx(4.0, rel=0.01)


def test_fatigue_of_a_study_with_its_interval(folder: Path) -> None:
    pytest.importorskip("rainflow")
    study = write_study(
        folder,
        'over = ["body.float.mass"]\n[grid]\n"body.float.mass" = [2.0, 3.0, 4.0]\n'
        '[result.fatigue]\nchannel = "joints/guide/displacement_rate"\n'
        'statistic = "damage_equivalent_load"\nexponent = 4\n',
    )
    found = hydrodae.sweep(study, folder / "study.nc", jobs=1)
    assert found["fatigue"].attrs["units"] == "m/s"
    assert float(found["fatigue_mean"]) == pytest.approx(float(found["fatigue"].mean()))
    assert float(found["fatigue_interval"]) > 0.0


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('rungs = ["tyme"]\n', "expected a list of frequency, spectral, time"),
        (RESULT + 'statistic = "damage_equivalent_load"\n', "needs 'exponent'"),
        (RESULT + "exponent = 3\n", "belongs to statistic"),
        (RESULT + 'statistic = "damage_equivalent_load"\nexponent = 0\n', "number > 0"),
    ],
)
def test_wrong_rungs_and_fatigue_are_refused(folder: Path, text: str, told: str) -> None:
    grid = '[grid]\n"body.float.mass" = [2.0]\n'
    lines = text + grid if text.startswith("rungs") else grid + text
    with pytest.raises(hydrodae.CaseError, match=told):
        hydrodae.sweep(write_study(folder, lines), folder / "study.nc", jobs=1)
