"""Axes that follow the yaw: waves act with the force of their heading relative to the body."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import hydrodae
from hydrodae import _core, hdb
from hydrodae.errors import CaseError, SolverError
from hydrodae.linear import LinearModel
from hydrodae.support.arrays import Complex

G = 9.81
POINT = np.array([3.0, 1.0, -1.0])  # the centre of gravity
BUOYANCY = np.array([3.6, 1.3, -1.2])  # where the phase of the waves is taken off
MASS, INERTIA = 1000.0, 900.0
ADDED, DAMPING = np.diag([300.0, 300.0, 100.0]), np.diag([60.0, 60.0, 40.0])
STIFFNESS = np.array([600.0, 600.0, 400.0])
OMEGA = np.array([0.5, 1.0, 1.25, 1.6])
#: Amplitude [m], frequency [rad/s], heading and phase [deg]
WAVES = [(0.8, 1.0, 10.0, 30.0), (0.5, 1.25, -35.0, 100.0), (0.4, 1.6, 60.0, -80.0)]


def smooth(omega: float, heading: NDArray[np.float64]) -> Complex:
    """Surge, sway and yaw without the phase, (nh, 3): four harmonics."""
    b = np.asarray(heading)
    by_frequency = np.array([1.0 + 0.3j * omega, 0.8 + 0.2j, 0.5 - 0.4j * omega])
    return np.asarray(
        np.stack(
            [
                400.0 * (np.cos(b) + 0.3 * np.cos(3 * b) + 0.1),
                500.0 * (np.sin(b) + 0.2 * np.sin(2 * b)),
                600.0 * (np.sin(2 * b) + 0.2 * np.cos(b) + 0.1 * np.sin(4 * b)),
            ],
            axis=-1,
        )
        * by_frequency
    )


def write_database(path: Path, degrees: NDArray[Any]) -> None:
    heading, n = np.radians(degrees), OMEGA.size
    ahead = np.stack([np.cos(heading), np.sin(heading)])
    force = np.array(
        [smooth(w, heading) * np.exp(-1j * w**2 / G * BUOYANCY[:2] @ ahead)[:, None] for w in OMEGA]
    )
    hdb.HydroDatabase(
        coordinates=("float.surge", "float.sway", "float.yaw"),
        omega=OMEGA,
        added_mass=np.tile(ADDED, (n, 1, 1)),
        radiation_damping=np.tile(DAMPING, (n, 1, 1)),
        added_mass_inf=ADDED,
        added_mass_inf_std=np.zeros((3, 3)),
        heading=heading,
        froude_krylov=(0.4 * force).astype(complex),
        diffraction=(0.6 * force).astype(complex),
        bodies={
            "float": hdb.Body("float", POINT, hdb.Hydrostatics(1.0, BUOYANCY, 2.0, np.zeros(5)))
        },
        rho=1000.0,
        gravity=G,
    ).write(path)


CASE = """
hydro = { database = "hydro.h5", axes = "yaw", radiation = "constant", frequency = 1.0 }
solver = { end_time = 40.0, rtol = 1e-9 }
output = { step = 0.25 }
[[body]]
name = "float"
hydro = "float"
motion = ["surge", "sway", "yaw"]
mass = 1000.0
center_of_gravity = [3.0, 1.0, -1.0]
inertia = [900.0, 900.0, 900.0]
initial = { rotation_deg = [0, 0, 25] }
"""
for number, (a, w, b, p) in enumerate(WAVES):
    CASE += f"""
[[wave]]
name = "w{number}"
type = "regular"
height = {2 * a}
period = {2 * np.pi / w!r}
heading_deg = {b}
phase_deg = {p}
"""

MOORING = """
[[force]]
name = "mooring"
type = "mooring_matrix"
body = "float"
stiffness = [600.0, 600.0, 0.0, 0.0, 0.0, 400.0]
"""


def truth(
    time: NDArray[np.float64], moves: bool, table: Callable[[float, float], Complex]
) -> NDArray[np.float64]:
    """Displacement and yaw (n, 3), integrated from the equations of motion."""
    inertia = np.array([MASS, MASS, INERTIA]) + np.diag(ADDED)
    arm = (BUOYANCY - POINT)[:2]

    def rates(t: float, y: NDArray[np.float64]) -> NDArray[np.float64]:
        load, psi = np.zeros(3), y[2]
        place = POINT[:2] + (y[:2] if moves else 0.0)
        for a, w, degrees, phase in WAVES:
            k, b = w**2 / G, np.radians(degrees)
            relative = b - psi
            angle = w * t + np.radians(phase)
            angle -= k * place @ [np.cos(b), np.sin(b)]
            angle -= k * arm @ [np.cos(relative), np.sin(relative)]
            load += a * (table(w, relative) * np.exp(1j * angle)).real
        c, s = np.cos(psi), np.sin(psi)
        turned = np.array([c * load[0] - s * load[1], s * load[0] + c * load[1], load[2]])
        force = turned - STIFFNESS * y[:3] - np.diag(DAMPING) * y[3:]
        return np.concatenate([y[3:], force / inertia])

    start = np.array([0.0, 0.0, np.radians(25.0), 0.0, 0.0, 0.0])
    found = solve_ivp(rates, (0, time[-1]), start, "DOP853", time, rtol=1e-11, atol=1e-11)
    return np.asarray(found.y[:3].T)


def motion(results: hydrodae.Results) -> NDArray[np.float64]:
    place = results["bodies/float/position"].values[:, :2] - POINT[:2]
    return np.asarray(np.c_[place, results["bodies/float/rotation"].values[:, 2]])


@pytest.mark.parametrize("phase", ["fixed", "moving"])
@pytest.mark.parametrize("degrees", [np.arange(0, 361, 30), np.arange(-140, 201, 20)])
def test_turning_float_against_its_equations(
    tmp_path: Path, phase: str, degrees: NDArray[np.float64]
) -> None:
    """Three waves from three sides on a float that is 25 to 60 degrees off; circle and fan."""
    write_database(tmp_path / "hydro.h5", degrees)
    (tmp_path / "case.toml").write_text(CASE + MOORING)
    results = hydrodae.run(tmp_path / "case.toml", set={"sea.phase": phase})
    headings = _core.Headings(np.radians(degrees.astype(float)))

    def table(w: float, relative: float) -> Complex:
        if degrees[-1] - degrees[0] == 360:
            return smooth(w, np.array(relative))
        covered = headings.covered(relative)
        assert covered is not None
        return np.asarray(headings.weights(covered) @ smooth(w, np.radians(degrees)))

    expected = truth(results.time, phase == "moving", table)
    assert np.ptp(expected[:, 2]) > 0.5
    # Loads below 1e-6 of the largest are left out; polynomials over the yaw smooth the knots.
    atol = 2e-5 if degrees[-1] - degrees[0] == 360 else 1e-4
    np.testing.assert_allclose(motion(results), expected, atol=atol)
    total = results["forces/excitation/float/force"].values
    part = results["forces/froude_krylov/float/force"].values
    np.testing.assert_allclose(part, 0.4 * total, atol=1e-6 * abs(total).max())


def test_leaving_the_headings_stops_the_run(tmp_path: Path) -> None:
    write_database(tmp_path / "hydro.h5", np.arange(-80, 81, 20))
    (tmp_path / "case.toml").write_text(CASE)
    with pytest.raises(
        SolverError, match=r'"?float.? has turned to a yaw of .*cover -20 to 45 deg'
    ):
        hydrodae.run(tmp_path / "case.toml")
    case = hydrodae.Case.read(tmp_path / "case.toml")  # a march of several stops as well
    for answer in _core.simulate_together([case.scene, case.scene]):
        assert "has turned to a yaw of" in str(answer)


def test_turning_device_and_waves_turns_the_result(tmp_path: Path) -> None:
    """About the origin, in waves whose phase moves with the body: no axis of the world counts."""
    write_database(tmp_path / "hydro.h5", np.arange(0, 361, 30))
    (tmp_path / "case.toml").write_text(CASE)
    runs = []
    for degrees in (0.0, 130.0):
        angle = np.radians(degrees)
        turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
        values: dict[str, Any] = {
            "sea.phase": "moving",
            "body.float.initial.rotation_deg": [0.0, 0.0, 25.0 + degrees],
            "body.float.initial.displacement": [*(turn @ POINT[:2] - POINT[:2]), 0.0],
        }
        for number, (_, _, heading, _) in enumerate(WAVES):
            values[f"wave.w{number}.heading_deg"] = heading + degrees
        results = hydrodae.run(tmp_path / "case.toml", set=values)
        runs.append(results["bodies/float/position"].values[:, :2] @ turn)
    np.testing.assert_allclose(runs[1], runs[0], atol=1e-6)


@pytest.mark.parametrize("headings", [[0.0], np.arange(0.0, 361.0, 60.0)])
def test_body_of_revolution_feels_the_same_turned_or_not(
    tmp_path: Path, headings: list[float]
) -> None:
    """A cylinder whose only heading is 0, and one with all: the waves do not see its yaw."""
    water = hdb.Water(np.linspace(1.0, 3.0, 9), depth=4.0, heading=np.radians(headings))
    buoy = hdb.Cylinder(0.4, 0.5, -0.3)
    hdb.cylinders({"float": (0.0, 0.0)}, buoy, water, orders=2, modes=8)[0].write(
        tmp_path / "hydro.h5"
    )
    (tmp_path / "case.toml").write_text(
        """
        hydro = { database = "hydro.h5", axes = "yaw", radiation = "none" }
        solver = { end_time = 6.0, rtol = 1e-9 }
        wave = [{ name = "w", type = "regular", height = 0.1, period = 3.0, heading_deg = 20.0 }]
        [[body]]
        name = "float"
        hydro = "float"
        motion = ["surge", "sway", "yaw"]
        mass = 500.0
        inertia = [40.0, 40.0, 40.0]
        center_of_gravity = [0.0, 0.0, -0.3]
        """
    )
    runs = [
        hydrodae.run(
            tmp_path / "case.toml",
            set={
                "body.float.initial.rotation_deg": [0.0, 0.0, yaw],
                "body.float.initial.angular_velocity": [0.0, 0.0, rate],
            },
        )
        for yaw, rate in [(0.0, 0.0), (90.0, 0.0), (-130.0, 0.7)]
    ]
    force = runs[0]["forces/excitation/float/force"].values
    assert abs(force[:, 1]).max() == pytest.approx(
        np.tan(np.radians(20.0)) * abs(force[:, 0]).max(), rel=1e-4
    )
    for other in runs[1:]:
        turned = other["forces/excitation/float/force"].values
        np.testing.assert_allclose(turned, force, atol=1e-5 * abs(force).max())


def test_frequency_domain_at_a_mean_yaw_is_that_of_the_turned_heading(tmp_path: Path) -> None:
    """Held by a soft spring, turned by 25 degrees by a moment: waves come from 25 degrees less."""
    write_database(tmp_path / "hydro.h5", np.arange(0, 361, 30))
    (tmp_path / "case.toml").write_text(CASE)
    twist = {"type": "constant_load", "name": "twist", "body": "float"}
    mooring = {
        "type": "mooring_matrix",
        "name": "mooring",
        "body": "float",
        "stiffness": [600.0, 600.0, 0.0, 0.0, 0.0, 400.0],
    }
    found = []
    for degrees in (0.0, 25.0):
        load = {**twist, "moment": [0.0, 0.0, 400.0 * np.radians(degrees)]}
        values = {
            "force": [mooring, load],
            "solver.start": "equilibrium",
            "body.float.initial.rotation_deg": [0.0, 0.0, 0.0],
        }
        case = hydrodae.Case.read(tmp_path / "case.toml").with_values(values)
        response = LinearModel(case).response(OMEGA, np.radians(40.0 + degrees))
        lag = (
            OMEGA**2
            / G
            * (POINT[0] * np.cos(response.heading) + POINT[1] * np.sin(response.heading))
        )
        phasors = [
            response[f"bodies/float/{dof}"] * np.exp(1j * lag) for dof in ("surge", "sway", "yaw")
        ]
        angle = np.radians(degrees)
        c, s = np.cos(angle), np.sin(angle)
        found.append(
            np.array([c * phasors[0] + s * phasors[1], c * phasors[1] - s * phasors[0], phasors[2]])
        )
    assert abs(found[0][2]).min() > 1e-3
    np.testing.assert_allclose(found[1], found[0], rtol=1e-6, atol=1e-9)


WEATHERVANING = {50: 0.68, 100: 14.59, 150: 7.58, 200: 8.96, 400: 11.05, 600: 9.95}  # [deg]


def mean_yaws(results: hydrodae.Results) -> dict[int, float]:
    """Means over the two periods of 8 s before each time [deg]."""
    time = results.time
    yaw = np.degrees(results["bodies/flap/rotation"].values[:, 2])
    return {
        t: float(yaw[(time > t - 16.0 + 1e-6) & (time <= t + 1e-6)].mean()) for t in WEATHERVANING
    }


def test_oswec_weathervanes(reference: Path, tmp_path: Path) -> None:
    """A flap free in yaw, H 2.5 m, T 8 s, from 10 degrees; its headings are 0 to 90 degrees.

    Own scipy integration with the moment F(heading - yaw); WEC-Sim differs from it by 0.4 degrees.
    Its waves grow over 100 s by a cosine, so the sea is a record of them.
    """
    folder = reference / "variable" / "passive_yaw"
    time = np.arange(-60.0, 700.0, 0.25)
    growth = 0.5 * (1.0 - np.cos(np.pi * np.clip(time / 100.0, 0.0, 1.0)))
    rows = np.c_[time - time[0], 1.25 * growth * np.cos(np.pi / 4.0 * time)]
    np.savetxt(tmp_path / "sea.csv", rows, delimiter=",", header="time,elevation", comments="")
    record = {"name": "w", "type": "measured", "file": str(tmp_path / "sea.csv"), "start": 60.0}
    values = {"wave": [{**record, "heading_deg": 10.0}], "sea.ramp": 0.0}
    means = mean_yaws(hydrodae.run(folder / "yaw.toml", set=values))
    assert means == pytest.approx(WEATHERVANING, abs=0.3)
    late = {t: mean for t, mean in WEATHERVANING.items() if t > 100}  # the ramp has another shape
    own = mean_yaws(hydrodae.run(folder / "yaw.toml"))
    assert {t: own[t] for t in late} == pytest.approx(late, abs=0.3)


#: Of a box barge about its centre of gravity: heave, roll, pitch [N/m, N m]; what moves with them.
BARGE_STIFFNESS = np.array([215.8e3, 132.7e3, 1239e3])
BARGE_ADDED = np.diag([5e3, 8e3, 2e4, 19e3, 1e5, 6e4])
ROLL_PERIOD = 3.433  # s


def slopes(omega: float, relative: Any) -> Complex:
    """Loads of long waves of height one: stiffness times height and slope, (nh, 6)."""
    b, k = np.asarray(relative), omega**2 / G
    out = np.zeros((*b.shape, 6), dtype=complex)
    tilts = [np.ones_like(b), -1j * k * np.sin(b), 1j * k * np.cos(b)]
    out[..., 2:5] = np.stack(tilts, axis=-1) * BARGE_STIFFNESS
    return out


def barge(folder: Path, **start: Any) -> hydrodae.Scene:
    """Return a free box barge that radiates nothing; long waves lift and tilt it."""
    area, roll, pitch = BARGE_STIFFNESS / (1000.0 * G)
    statics = hdb.Hydrostatics(13.2, np.zeros(3), area, np.array([0.0, 0.0, pitch, roll, 0.0]))
    heading = np.radians(np.arange(0.0, 361.0, 30.0))
    force = np.array([slopes(omega, heading) for omega in OMEGA])
    n = (OMEGA.size, 1, 1)
    hdb.HydroDatabase(
        coordinates=tuple(f"barge.{dof}" for dof in hdb.labels.DOFS),
        omega=OMEGA,
        added_mass=np.tile(BARGE_ADDED, n),
        radiation_damping=np.tile(np.zeros((6, 6)), n),
        added_mass_inf=BARGE_ADDED,
        added_mass_inf_std=np.zeros((6, 6)),
        heading=heading,
        froude_krylov=force,
        diffraction=np.zeros_like(force),
        bodies={"barge": hdb.Body("barge", np.zeros(3), statics)},
        rho=1000.0,
        gravity=G,
    ).write(folder / "hydro.h5")
    initial: Any = start
    scene = hydrodae.Scene("barge", directory=folder)
    scene.hydro(database="hydro.h5", axes="yaw", radiation="none")
    inertia = [float(BARGE_STIFFNESS[1] * (ROLL_PERIOD / (2 * np.pi)) ** 2 - 19e3), 1e5, 1.2e5]
    scene.body(
        "barge", hydro="barge", mass=13.2e3, inertia=inertia, center_of_gravity=[0.0, 0.0, 0.0],
        initial=initial,
    )  # fmt: skip
    return scene


def tilt(results: hydrodae.Results) -> NDArray[np.float64]:
    """Return how far the vertical leans to starboard and aft, seen from the barge, (n, 2) [-]."""
    turns = Rotation.from_rotvec(results["bodies/barge/rotation"].values)
    return np.asarray(turns.inv().apply([0.0, 0.0, 1.0])[:, [1, 0]])


@pytest.mark.parametrize("heading", [0.0, 65.0, -120.0])
def test_a_turning_barge_rolls_with_its_own_period(tmp_path: Path, heading: float) -> None:
    """It turns by 0.25 deg/s, over 30 degrees; then its roll is that of every heading.

    The turn itself lets pitch shake each cycle a little: 20 of them count.
    """
    ahead = 0.01 * np.exp(1j * np.radians(heading))
    start: Any = {
        "rotation_deg": [0.0, 0.0, heading],
        "angular_velocity": [float(ahead.real), float(ahead.imag), float(np.radians(0.25))],
    }
    scene = barge(tmp_path, **start)
    scene.output(step=0.02)
    scene.solver(end_time=180.0, rtol=1e-9, accuracy="none")
    results = hydrodae.run(scene)
    roll, pitch = tilt(results).T
    yaw = np.unwrap(results["bodies/barge/rotation"].values[:, 2])
    assert yaw[-1] - yaw[0] == pytest.approx(np.radians(45.0), abs=0.01)
    rises = np.flatnonzero((roll[:-1] < 0.0) & (roll[1:] >= 0.0))
    at = results.time[rises] - 0.02 * roll[rises] / (roll[rises + 1] - roll[rises])
    assert (at[-1] - at[-21]) / 20.0 == pytest.approx(ROLL_PERIOD, rel=1e-3)
    assert np.abs(roll).max() == pytest.approx(0.01 * ROLL_PERIOD / (2.0 * np.pi), rel=0.01)
    assert np.abs(pitch).max() < 5e-4


@pytest.mark.parametrize("heading", [0.0, 25.0, -120.0])
def test_a_barge_rolls_and_pitches_in_a_small_wave_as_linear_theory_says(
    tmp_path: Path, heading: float
) -> None:
    """Wave of 1 cm: (I + A) tilt'' + K tilt = a Re(F e^(i w t)), at rest at t = 0, by itself."""
    amplitude, omega = 0.01, 1.25
    scene = barge(tmp_path, rotation_deg=[0.0, 0.0, heading])
    scene.wave.regular("w", height=2.0 * amplitude, period=2.0 * np.pi / omega)
    scene.output(step=0.1)
    scene.solver(end_time=60.0, rtol=1e-9, accuracy="none")
    results = hydrodae.run(scene)
    roll, pitch = tilt(results).T * np.array([[1.0], [-1.0]])
    load = amplitude * slopes(omega, np.radians(-heading))[3:5]
    t = results.time
    for found, f, stiffness, w0 in (
        (roll, load[0], BARGE_STIFFNESS[1], 2.0 * np.pi / ROLL_PERIOD),
        (pitch, load[1], BARGE_STIFFNESS[2], np.sqrt(BARGE_STIFFNESS[2] / 2e5)),
    ):
        steady = f / stiffness / (1.0 - (omega / w0) ** 2)  # then free motion from rest
        free = steady.real * np.cos(w0 * t) - steady.imag * omega / w0 * np.sin(w0 * t)
        expected = (steady * np.exp(1j * omega * t)).real - free
        np.testing.assert_allclose(found, expected, atol=1e-5)


@pytest.mark.parametrize("method", ["auto", "radau", "ida"])
def test_a_tumbling_barge_keeps_its_energy(tmp_path: Path, method: Any) -> None:
    """Heave, roll and pitch by 30 degrees while it turns round twice: still water takes nothing."""
    start: Any = {
        "displacement": [0.0, 0.0, 0.3],
        "rotation_deg": [25.0, 10.0, 40.0],
        "angular_velocity": [0.5, -0.3, 0.6],
    }
    scene = barge(tmp_path, **start)
    scene.solver(end_time=20.0, rtol=1e-10, method=method, accuracy="none")
    results = hydrodae.run(scene)
    total, kinetic = results["energy/total"].values, results["energy/kinetic"].values
    assert np.abs(tilt(results)).max(axis=0).min() > 0.2
    assert np.ptp(total) < (1e-5 if method == "ida" else 1e-7) * np.ptp(kinetic)


def test_a_stiffness_that_no_still_water_has_is_refused(tmp_path: Path) -> None:
    scene = barge(tmp_path)
    scene.solver(end_time=1.0)
    with h5py.File(tmp_path / "hydro.h5", "r+") as file:
        file["bodies/barge/hydrostatic_stiffness"][0, 0] = 1e4
    with pytest.raises(CaseError, match="row surge, column surge") as caught:
        hydrodae.run(scene)
    assert caught.value.key == "body.barge.hydro"
