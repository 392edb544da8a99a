"""Controllers against theory: the most power of a PI, and the same law in other programs."""

from __future__ import annotations

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


@pytest.mark.parametrize("program", ["client.py", "client.c"])
def test_other_programs_give_the_same_motion(
    repository: Path, tmp_path: Path, built_in: hydrodae.Results, program: str
) -> None:
    folder = repository / "cases" / "control"
    command = [sys.executable, str(folder / program)]
    if program == "client.c":
        subprocess.run(["cc", "-O2", str(folder / program), "-o", tmp_path / "client"], check=True)
        command = [str(tmp_path / "client")]
    port = free_port()
    values = {
        "solver.rtol": 1e-9,
        "controller.pi.port": port,
        "controller.pi.protocol": "hydrodae" if program == "client.py" else "hotint",
    }
    with subprocess.Popen([*command, str(port)]) as client:
        results = hydrodae.run(folder / "case_tcp.toml", set=values)
        assert client.wait(10) == 0
    for name in ("joints/slide/displacement", "forces/pto/float/force", "energy/work/pto"):
        scale = float(abs(built_in[name]).max())
        np.testing.assert_allclose(results[name], built_in[name], atol=1e-9 * scale)


@pytest.mark.parametrize("way", ["python", "hydrodae", "hotint"])
def test_the_sphere_under_one_law_in_three_programs(repository: Path, way: str) -> None:
    """Sampled alike, equal within 1e-9: in the kernel, in Python, over both protocols."""
    import threading

    from hydrodae import tcp

    folder = repository / "cases" / "sphere"
    text = (folder / "control.toml").read_text()
    short = {"solver.end_time": 6.0, "sea.ramp": 2.0}
    own = hydrodae.run(hydrodae.Case.from_text(text, folder), set=short)
    kp, ki, period = 9.567e4, -2.096e5, 0.05

    class Pi:
        integral = 0.0

        def __call__(self, _: float, rate: float) -> float:
            load = kp * -rate + self.integral
            self.integral += period * ki * -rate
            return load

    head, tail = text.split("gain_p")[0], "[solver]" + text.split("[solver]")[1]
    if way == "python":
        given = hydrodae.Case.from_text(head.replace('"pid"', '"python"') + tail, folder)
        other = hydrodae.run(given, set=short, controllers={"pi": Pi()})
    else:
        port = free_port()
        keys = f'port = {port}\nprotocol = "{way}"\n'
        given = hydrodae.Case.from_text(head.replace('"pid"', '"tcp"') + keys + tail, folder)

        def peer() -> None:
            law = Pi()
            with tcp.connect(port=port, hotint=(1, 1) if way == "hotint" else None) as run:
                for t, (rate,) in run:
                    run.answer(law(t, rate))

        thread = threading.Thread(target=peer)
        thread.start()
        other = hydrodae.run(given, set=short)
        thread.join(5.0)
    for name in ("joints/guide/displacement", "controllers/pi/output", "energy/work/pto"):
        scale = float(abs(own[name]).max())
        np.testing.assert_allclose(other[name], own[name], atol=1e-9 * scale)


def test_the_sphere_under_one_law_as_an_fmu(repository: Path, tmp_path: Path) -> None:
    """The same law in the importer: motion within 1e-9 of the case with its own controller."""
    pytest.importorskip("fmpy", reason="needs the extra cosim")
    from tests.verification.fmu_device import Device

    from hydrodae.fmu import export

    folder = repository / "cases" / "sphere"
    text = (folder / "control.toml").read_text()
    short = {"solver.end_time": 6.0, "sea.ramp": 2.0}
    own = hydrodae.run(hydrodae.Case.from_text(text, folder), set=short)
    bare = text.split("[[controller]]")[0] + "[solver]" + text.split("[solver]")[1]
    path = export(hydrodae.Case.from_text(bare, folder), tmp_path / "sphere.fmu", set=short)
    kp, ki, period, integral = 9.567e4, -2.096e5, 0.05, 0.0
    slide = "joints/guide/displacement"
    found = [0.0]
    with Device(path, tmp_path / "sphere") as device:
        device.begin()
        for k in range(120):
            (rate,) = device.get(slide + "_rate")
            device.set("forces/pto/load", kp * -rate + integral)
            integral += period * ki * -rate
            device.step(k * period, period)
            found += device.get(slide)
    expected = own[slide].to_numpy()
    np.testing.assert_allclose(found, expected, atol=1e-9 * np.abs(expected).max())
