"""F3OF decay tests against linear theory without memory cut, reduced coordinates, other codes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.verification import cummins, reduced_flaps

import hydrodae
from hydrodae.hdb import HydroDatabase, read
from hydrodae.results.post import turning_points


@pytest.fixture(scope="module")
def case(repository: Path) -> Path:
    return repository / "cases" / "f3of" / "flap_decay.toml"


@pytest.fixture(scope="module")
def database(case: Path) -> Path:
    return case.parent / "hydro.h5"


def angles(results: hydrodae.Results) -> np.ndarray:
    """(nt, 2) [rad]."""
    return np.column_stack([results[f"joints/hinge{k}/angle"].values for k in (1, 2)])


def mean_period(time: np.ndarray, x: np.ndarray, cycles: int = 5) -> float:
    """Mean time between falls through zero."""
    k = np.flatnonzero((x[:-1] > 0) & (x[1:] <= 0))
    falls = time[k] + x[k] / (x[k] - x[k + 1]) * (time[k + 1] - time[k])
    return float(np.diff(falls[: cycles + 1]).mean())


def bodies_of(db: HydroDatabase) -> dict[str, cummins.Body]:
    bodies = {}
    for name in ("base", "flap1", "flap2"):
        hydrostatics = db.bodies[name].hydrostatics
        assert hydrostatics is not None
        bodies[name] = cummins.Body(
            cummins.MASS[name],
            cummins.PITCH_INERTIA[name],
            np.asarray(db.bodies[name].reference_point),
            hydrostatics.displaced_volume,
            db.hydrostatic_stiffness(name),
        )
    return bodies


def linear_model(path: Path) -> cummins.CumminsModel:
    """Linear Cummins model of tests/verification/cummins.py on the case's own database."""
    db = read(path)
    return cummins.f3of_dt3(db, bodies_of(db))


@pytest.fixture(scope="module")
def small_release(case: Path) -> hydrodae.Results:
    return hydrodae.run(
        case,
        set={"joint.hinge1.initial.angle_deg": 0.5, "solver.rtol": 1e-7, "solver.end_time": 1000.0},
    )


def test_small_release_matches_linear_theory_without_memory_cut(
    small_release: hydrodae.Results, database: Path
) -> None:
    time = small_release.time
    exact = linear_model(database).free_decay([np.radians(0.5), 0.0], time[time <= 100.0])
    ours = angles(small_release)
    for end in (50.0, 100.0):
        n = int(np.count_nonzero(time <= end + 1e-9))
        assert cummins.nrms(ours[:n, 0], exact[:n, 0]) <= 0.002
        assert cummins.nrms(ours[:n, 1], exact[:n, 1]) <= 0.006


def test_small_release_stays_bounded_and_keeps_its_late_amplitude(
    small_release: hydrodae.Results, database: Path
) -> None:
    time, ours = small_release.time, angles(small_release)
    late = time >= 900.0
    exact = linear_model(database).free_decay([np.radians(0.5), 0.0], time[late])
    amplitude, expected = np.abs(ours[late, 0]).max(), np.abs(exact[:, 0]).max()
    assert amplitude == pytest.approx(expected, rel=0.10)
    assert np.abs(ours).max() <= np.radians(0.5) * (1.0 + 1e-9)


def test_memory_of_the_flaps_is_small_passive_and_decaying(
    small_release: hydrodae.Results, database: Path
) -> None:
    fit = read(database).memory["flaps_planar"]
    assert fit.n_states <= 130
    assert fit.passivity().relative >= -1e-4
    model = reduced_flaps.read(str(database), "flaps_planar")
    stiffness = np.diag([-(model.moment(k, 1e-6) - model.moment(k, -1e-6)) / 2e-6 for k in (0, 1)])
    inverse, m = np.linalg.inv(model.inertia), len(model.state_matrix)
    coupled = np.block(
        [
            [np.zeros((2, 2)), np.eye(2), np.zeros((2, m))],
            [-inverse @ stiffness, np.zeros((2, 2)), -inverse @ model.output_matrix],
            [np.zeros((m, 2)), model.input_matrix, model.state_matrix],
        ]
    )
    assert np.linalg.eigvals(coupled).real.max() < 0.0


def test_redundant_and_reduced_coordinates_agree(case: Path, database: Path) -> None:
    results = hydrodae.run(case, set={"solver.rtol": 1e-9, "solver.end_time": 100.0})
    reduced = reduced_flaps.read(str(database), "flaps_planar")
    exact = reduced.decay((np.radians(10.0), 0.0), results.time)
    assert np.abs(angles(results) - exact).max() <= 1e-7


@pytest.fixture(scope="module")
def flap_decay(case: Path) -> hydrodae.Results:
    return hydrodae.run(case, set={"solver.end_time": 100.0})


def test_flap_period_and_extrema_at_ten_degrees(flap_decay: hydrodae.Results) -> None:
    time, flap1 = flap_decay.time, np.degrees(angles(flap_decay)[:, 0])
    assert 14.0 <= mean_period(time, flap1) <= 14.2
    _, extrema = turning_points(time, flap1)
    np.testing.assert_allclose(extrema[:3], [-9.12, 9.02, -8.91], atol=0.25)


@pytest.mark.parametrize("code", ["PDS", "WDN"])
def test_flap_decay_against_other_codes(
    flap_decay: hydrodae.Results, reference: Path, code: str
) -> None:
    table = np.genfromtxt(reference / "f3of" / "dt3_flap1_decay.csv", delimiter=",", names=True)
    early = table["t_s"] <= 50.0 + 1e-9
    theirs = table[f"{code}_flap1_deg"][early]
    ours = np.interp(table["t_s"][early], flap_decay.time, np.degrees(angles(flap_decay)[:, 0]))
    assert cummins.nrms(ours, theirs) <= 0.10


def test_mean_axes_shorten_the_period(case: Path, flap_decay: hydrodae.Results) -> None:
    """At 10 degrees against the linear period: mean axes -0.4 %, body axes -0.1 %.

    The heave of the centre of gravity on its arc (5 cm) works against the waterplane stiffness;
    alone it shortens the period by 0.2 % in either axes; the sine in the net lift lengthens it.
    """
    small = hydrodae.run(
        case, set={"joint.hinge1.initial.angle_deg": 0.5, "solver.end_time": 100.0}
    )
    mean = hydrodae.run(case, set={"hydro.axes": "mean", "solver.end_time": 100.0})
    linear, body, earth = (
        mean_period(run.time, angles(run)[:, 0]) for run in (small, flap_decay, mean)
    )
    assert 14.0 <= earth <= body <= 14.2  # what the codes span
    assert 0.004 <= 1.0 - earth / linear <= 0.006
    assert 0.0025 <= 1.0 - earth / body <= 0.004
    # How it is counted changes it by as much as the axes do: 14.046 s between falls through zero,
    # 14.015 s from the release over the first three peaks.
    assert earth == pytest.approx(14.046, abs=0.005)
    peaks, _ = turning_points(mean.time, angles(mean)[:, 0])
    assert peaks[5] / 3.0 == pytest.approx(14.015, abs=0.005)


def test_load_on_the_fixed_base_balances_the_hinges(flap_decay: hydrodae.Results) -> None:
    """The base stands still: what holds it, the hinges and the loads on it add up to nothing."""
    total = flap_decay["bodies/base/support_force"].values.copy()
    for component in ("weight", "hydrostatic", "radiation", "added_mass_inf"):
        total += flap_decay[f"forces/{component}/base/force"].values
    for joint in ("hinge1", "hinge2"):  # marker axes: x = world x, y = -world z, z = world y
        x, y, _ = flap_decay[f"joints/{joint}/reaction_force"].values.T
        total -= np.stack([x, np.zeros_like(x), -y], axis=1)
    weight = 1_089_825.0 * 9.81
    assert np.abs(total).max() <= 1e-8 * weight
    assert np.ptp(flap_decay["forces/radiation/base/force"].values[:, 0]) > 0.0


@pytest.fixture(scope="module")
def surge_decay(repository: Path) -> hydrodae.Results:
    return hydrodae.run(
        repository / "cases" / "f3of" / "surge_decay.toml", set={"solver.end_time": 300.0}
    )


def test_surge_decay_period_and_extrema(surge_decay: hydrodae.Results) -> None:
    surge = surge_decay["bodies/base/position"].values[:, 0]
    assert mean_period(surge_decay.time, surge) == pytest.approx(47.92, rel=0.012)
    _, extrema = turning_points(surge_decay.time, surge)
    np.testing.assert_allclose(extrema[:3], [-4.98, 4.97, -4.96], atol=0.02)


def test_locked_flaps_follow_the_base(surge_decay: hydrodae.Results) -> None:
    pitch = surge_decay["bodies/base/rotation"].values[:, 1]
    for flap in ("flap1", "flap2"):
        np.testing.assert_allclose(
            surge_decay[f"bodies/{flap}/rotation"].values[:, 1], pitch, atol=1e-6
        )


@pytest.mark.parametrize(
    ("name", "release"),
    [("surge_decay", [0.05, 0.0, 0.0]), ("pitch_decay", [0.0, 0.0, np.radians(0.1)])],
)
def test_small_releases_of_the_locked_device_match_linear_theory(
    repository: Path, database: Path, name: str, release: list[float]
) -> None:
    """DT1 and DT2, a hundredth of their releases: surge, heave and pitch over 50 s."""
    db = read(database)
    model = cummins.f3of_dt1(db, bodies_of(db))
    surge, _, pitch = release
    values: dict[str, Any] = {"solver.end_time": 50.0, "solver.rtol": 1e-7, "output.step": 0.5}
    for body, x in (("base", None), ("flap1", -12.5), ("flap2", 12.5)):
        arm = np.zeros(2) if x is None else np.array([x, 3.5])  # from the base's centre
        turned = np.array([[np.cos(pitch), np.sin(pitch)], [-np.sin(pitch), np.cos(pitch)]]) @ arm
        dx, dz = turned - arm
        values[f"body.{body}.initial.displacement"] = [surge + dx, 0.0, dz]
        values[f"body.{body}.initial.rotation_deg"] = [0.0, np.degrees(pitch), 0.0]
    results = hydrodae.run(repository / "cases" / "f3of" / f"{name}.toml", set=values)
    lift = sum(
        (cummins.RHO * body.displaced_volume - body.mass) * cummins.GRAVITY
        for body in bodies_of(db).values()
    )
    rest = np.linalg.solve(model.stiffness, [0.0, lift, 0.0])
    exact = model.free_decay(np.array(release) - rest, results.time) + rest
    position = results["bodies/base/position"].values
    seen = (position[:, 0], position[:, 2] + 9.0, results["bodies/base/rotation"].values[:, 1])
    for ours, theirs in zip(seen, exact.T, strict=True):
        assert cummins.nrms(ours, theirs) <= 0.01


@pytest.mark.parametrize(("rtol", "drift"), [(1e-8, 2e-4), (1e-10, 1e-6)])
def test_energy_of_an_undamped_flap(case: Path, rtol: float, drift: float) -> None:
    """Without memory nothing takes energy: it drifts over 1000 s by what the tolerance allows."""
    results = hydrodae.run(
        case, set={"hydro.radiation": "none", "solver.rtol": rtol, "solver.end_time": 1000.0}
    )
    total = results["energy/total"].values
    # Energy of the swing: above the potential at rest (angle 0, which is the reference pose).
    assert np.abs(total - total[0]).max() <= drift * abs(total[0])
    kinetic = results["energy/kinetic"].values + results["energy/kinetic_added_mass"].values
    assert kinetic.max() == pytest.approx(abs(total[0]), rel=0.01)
