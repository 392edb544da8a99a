"""Controllers against theory: the most power of a PI, and a PI against the exact motion."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from tests.python.test_tcp import free_port

import hydrodae

OMEGA, AMPLITUDE = 1.2, 0.01  # rad/s, m: of cases/sphere/control.toml


def impedance(repository: Path) -> tuple[complex, complex]:
    """Intrinsic impedance [N s/m] and excitation [N/m] of the sphere in heave at OMEGA."""
    from hydrodae import hdb

    database = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    k = int(np.argmin(abs(database.omega - OMEGA)))
    assert database.omega[k] == pytest.approx(OMEGA)
    heave = database.coordinates.index("sphere.heave")
    inertia = 261.8e3 + database.added_mass[k, heave, heave]
    stiffness = database.hydrostatic_stiffness("sphere")[2, 2]
    resistance = database.radiation_damping[k, heave, heave]
    return (
        complex(resistance, OMEGA * inertia - stiffness / OMEGA),
        complex(database.excitation[k, 0, heave]),
    )


def mean_power(results: hydrodae.Results, periods: int = 8) -> float:
    """What the power take-off absorbs over the last periods of the wave, W."""
    span = periods * 2.0 * np.pi / OMEGA
    work, end = results["energy/work/pto"].values, results.time[-1]
    return float(np.interp(end - span, results.time, work) - work[-1]) / span


def test_a_pi_takes_the_most_power_of_its_wave(repository: Path) -> None:
    """|F|^2 / (8 Re Z) with Kp = Re Z, Ki = w Im Z; 4 R Kp / (R + Kp)^2 of it with another Kp."""
    Z, force = impedance(repository)
    most = abs(AMPLITUDE * force) ** 2 / (8.0 * Z.real)
    path = repository / "cases" / "sphere" / "control.toml"
    gains = {"controller.pi.gain_p": Z.real, "controller.pi.gain_i": OMEGA * Z.imag}
    assert mean_power(hydrodae.run(path, set=gains)) == pytest.approx(most, rel=0.01)
    assert mean_power(hydrodae.run(path)) == pytest.approx(most, rel=0.02)  # as the case has it
    more = hydrodae.run(path, set={**gains, "controller.pi.gain_p": 3.0 * Z.real})
    assert mean_power(more) == pytest.approx(0.75 * most, rel=0.02)


def exact_float(end: float) -> np.ndarray:
    """Displacements of cases/control at the sampling instants: x' = A x + b u, u held."""
    mass, stiffness, damping, period = 1000.0, 4000.0, 100.0, 0.05
    augmented = np.zeros((3, 3))
    augmented[:2] = [[0.0, 1.0, 0.0], [-stiffness / mass, -damping / mass, 1.0 / mass]]
    step = expm(period * augmented)
    x, integral, out = np.array([0.5, 0.0]), 0.0, [0.5]
    for _ in range(round(end / period)):
        error = -x[1]
        load = 600.0 * error + integral
        integral += period * 300.0 * error
        x = step[:2, :2] @ x + step[:2, 2] * load
        out.append(x[0])
    return np.array(out)


@pytest.fixture(scope="module")
def built_in(repository: Path) -> hydrodae.Results:
    return hydrodae.run(repository / "cases" / "control" / "case.toml", set={"solver.rtol": 1e-9})


def test_the_float_follows_the_exact_motion(built_in: hydrodae.Results) -> None:
    found = built_in["joints/slide/displacement"].values
    np.testing.assert_allclose(found, exact_float(10.0), atol=1e-7)


def command_of(program: Path, folder: Path) -> list[str]:
    """How a controller of cases/control is started; skips where its language is not."""
    if program.suffix == ".py":
        return [sys.executable, str(program)]
    tool = shutil.which({".c": "cc", ".m": "octave-cli"}[program.suffix])
    if tool is None:
        pytest.skip(f"nothing here runs {program.name}")
    if program.suffix == ".c":
        subprocess.run([tool, "-O2", "-Wall", "-Werror", program, "-o", folder / "c"], check=True)
        return [str(folder / "c")]
    package = [tool, "--eval", "pkg load instrument-control"]
    if subprocess.run(package, capture_output=True, check=False).returncode:
        pytest.skip("Octave has no package instrument-control")
    return [tool, str(program)]


@pytest.mark.parametrize("program", ["client.py", "client.c", "client.m"])
def test_other_programs_give_the_same_motion(
    repository: Path, tmp_path: Path, built_in: hydrodae.Results, program: str
) -> None:
    folder = repository / "cases" / "control"
    command = command_of(folder / program, tmp_path)
    port = free_port()
    values = {
        "solver.rtol": 1e-9,
        "controller.pi.port": port,
        "controller.pi.protocol": "hydrodae" if program == "client.py" else "hotint",
    }
    with subprocess.Popen([*command, str(port)]) as client:
        results = hydrodae.run(folder / "case_tcp.toml", set=values)
        assert client.wait(20) == 0
    for name in ("joints/slide/displacement", "forces/pto/float/force", "energy/work/pto"):
        scale = float(abs(built_in[name]).max())
        np.testing.assert_allclose(results[name], built_in[name], atol=1e-9 * scale)
