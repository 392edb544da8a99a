"""RM3 against WEC-Sim: decay of the float, regular wave with and without coupling of the bodies."""

from __future__ import annotations

import contextlib
import io
import warnings
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.hdb.memory import MemoryFitWarning
from hydrodae.linear import LinearModel
from hydrodae.study.sensitivity import sensitivity

FLOAT, SLIDE = "bodies/float/heave", "joints/slide/displacement"


def case(folder: Path, name: str, database: str, motion: str = "heave") -> hydrodae.Case:
    values = {f"body.{body}.motion": motion for body in ("float", "spar")}
    return hydrodae.Case(path=folder / name, values={**values, "hydro.database": database})


def decay_model(database: Path, motion: str = "heave") -> LinearModel:
    """Linear model of the decay; the fit need not cover the motion."""
    values = {f"body.{body}.motion": motion for body in ("float", "spar")}
    return LinearModel(
        hydrodae.Case(
            path=database.parent / "decay.toml",
            values={**values, "hydro.database": database.name, "hydro.radiation": "none"},
        )
    )


def run_with_note(arguments: list[str]) -> None:
    """A command that fits; the tables are noisy, so that it prints how far the fit is off."""
    printed = io.StringIO()
    with contextlib.redirect_stderr(printed), warnings.catch_warnings():
        warnings.simplefilter("always", MemoryFitWarning)
        assert main(arguments) == 0
    assert "hydrodae: note: memory fit" in printed.getvalue()


def prepare(reference: Path, output: Path, *options: str) -> None:
    """The command of cases/rm3/README.md, in heave alone."""
    source = str(reference / "hdb" / "rm3_wamit")
    arguments = ["--rho", "1000", "--keep", "float.heave,spar.heave", "--states", "16"]
    fit = ["--fit", "heave=float.heave,spar.heave", "--band", "0.1,1.6"]
    run_with_note(["hdb", "import", source, "-o", str(output), *arguments, *fit, *options])


def prepare_planar(reference: Path, output: Path) -> None:
    """The commands of cases/rm3/README.md as they stand: six coordinates, at most 40 states."""
    source, planar = str(reference / "hdb" / "rm3_wamit"), "float.planar,spar.planar"
    command = ["hdb", "import", source, "-o", str(output), "--rho", "1000", "--keep", planar]
    assert main(command) == 0
    fit = ["hdb", "fit", str(output), f"planar={planar}", "--states", "40", "--band", "0.1,1.6"]
    run_with_note(fit)


def decay_errors(folder: Path, database: str, reference: Path, motion: str) -> tuple[float, float]:
    """Rms differences of float and spar from WEC-Sim over 100 s [m]."""
    table = np.genfromtxt(reference / "rm3" / "wecsim_decay.csv", delimiter=",", names=True)
    early = table["t_s"] <= 99.96
    results = hydrodae.run(case(folder, "decay.toml", database, motion))
    errors = []
    for body in ("float", "spar"):
        z = results[f"bodies/{body}/position"].values[:, 2]
        ours = np.interp(table["t_s"][early], results.time, z)
        errors.append(float(np.sqrt(np.mean((ours - table[f"{body}_z_m"][early]) ** 2))))
    return errors[0], errors[1]


def relative_amplitude(folder: Path, database: str, motion: str) -> float:
    """Of the slide over the last five periods [m]."""
    results = hydrodae.run(case(folder, "wave.toml", database, motion))
    last = results.time >= results.time[-1] - 40.0 + 1e-6
    carrier = np.exp(-2j * np.pi * results.time[last] / 8.0)
    slide = results[SLIDE].values[last]
    return float(abs(2.0 * np.mean((slide - slide.mean()) * carrier)))


def test_decay_against_wecsim(rm3: Path, reference: Path) -> None:
    on_float, on_spar = decay_errors(rm3, "heave.h5", reference, "heave")
    assert on_float <= 5e-4
    assert on_spar <= 3e-4


def test_regular_wave_with_coupled_bodies(rm3: Path) -> None:
    assert relative_amplitude(rm3, "heave.h5", "heave") == pytest.approx(0.879, rel=0.01)


def test_dropping_the_coupling_lowers_the_motion(rm3: Path) -> None:
    """Frequency domain: 0.879 m with the blocks between the bodies, 0.867 without them."""
    rows = sensitivity(case(rm3, "wave.toml", "heave.h5"), "rao", periods=[8.0], channels=[SLIDE])
    found = {row.variant: 1.25 * row.value for row in rows}
    assert found["base: tables as stored"] == pytest.approx(0.879, rel=0.01)
    assert found["no coupling of bodies"] == pytest.approx(0.860, rel=0.015)
    assert found["no coupling of bodies"] == pytest.approx(0.867, rel=0.002)
    power = {
        row.variant: row.value for row in sensitivity(case(rm3, "wave.toml", "heave.h5"), "power")
    }
    speed = 2 * np.pi / 8.0 * found["base: tables as stored"]
    assert power["base: tables as stored"] == pytest.approx(0.5 * 1.2e6 * speed**2, rel=1e-6)


@pytest.mark.long
def test_regular_wave_without_coupling(reference: Path, rm3: Path) -> None:
    prepare(reference, rm3 / "alone.h5", "--no-coupling")
    assert relative_amplitude(rm3, "alone.h5", "heave") == pytest.approx(0.860, rel=0.015)


@pytest.mark.long
def test_in_the_plane(reference: Path, rm3_planar: Path) -> None:
    """The cases of cases/rm3 as they stand."""
    on_float, on_spar = decay_errors(rm3_planar, "hydro.h5", reference, "planar")
    assert on_float <= 5e-4
    assert on_spar <= 3e-4
    assert relative_amplitude(rm3_planar, "hydro.h5", "planar") == pytest.approx(0.879, rel=0.01)


@pytest.mark.long
def test_moored_in_an_irregular_sea(rm3_planar: Path) -> None:
    """cases/rm3/moored.toml: the statics from the spar's water plane, and a run about them."""
    moored = hydrodae.Case(path=rm3_planar / "moored.toml")
    rest = hydrodae.equilibrium(moored)
    pull = -rest.stiffness.load_of("spar")[2]
    area = np.pi / 4.0 * 6.0**2  # of the spar, 6 m thick [m2]
    assert rest.offsets["spar"][2] == pytest.approx(-pull / (1000.0 * 9.81 * area), rel=0.02)
    tensions = [rest.tensions[f"forces/{name}/tension"] for name in ("bow", "port", "starboard")]
    assert tensions == pytest.approx([162.1e3] * 3, rel=1e-3)
    surge = [mode.period for mode in rest.modes if abs(mode.shape["bodies/spar/surge"]) > 0.9]
    assert max(surge) == pytest.approx(67.5, rel=0.05)
    run = hydrodae.run(moored)
    late = run.time >= 100.0
    place = run["bodies/spar/position"].values[late]
    assert np.mean(place, axis=0) == pytest.approx([0.0, 0.0, -21.63], abs=0.05)
    for name, static in zip(("bow", "port", "starboard"), tensions, strict=True):
        tension = run[f"forces/{name}/tension"].values[late]
        assert np.mean(tension) == pytest.approx(static, rel=5e-3)
        assert 0.9 * static < tension.min() < tension.max() < 1.1 * static


@pytest.mark.long
def test_dynamic_lines_in_an_irregular_sea(rm3_planar: Path) -> None:
    """cases/rm3/moored_lines.toml: at rest as catenaries; tolerances hold what they say."""
    case = hydrodae.Case(path=rm3_planar / "moored_lines.toml")
    rest = hydrodae.equilibrium(case)
    names = ("bow", "port", "starboard")
    tensions = [rest.tensions[f"forces/{name}/tension"] for name in names]
    assert tensions == pytest.approx([162.1e3] * 3, rel=5e-3)
    channels = [f"forces/{name}/tension" for name in names] + [SLIDE]
    assert "rtol = 1e-4" in case.text
    found, exact = (
        hydrodae.run(hydrodae.Case(path=case.path, values=values))
        for values in ({}, {"solver.rtol": 1e-6})
    )
    for channel in channels:
        true = exact[channel].values
        assert np.std(true[1000:]) > (1e3 if "tension" in channel else 0.1)
        difference = found[channel].values - true
        assert np.sqrt(np.mean(difference**2)) < 3e-4 * np.std(true[1000:])
    assert np.mean(exact[channels[0]].values[1000:]) == pytest.approx(tensions[0], rel=5e-3)
