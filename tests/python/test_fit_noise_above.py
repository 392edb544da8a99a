"""Fits of tables with noise, coarse panels above the band, or single wrong frequencies."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.hdb.checks.smooth import lone_findings
from hydrodae.hdb.memory.data import least_damping, with_zero
from hydrodae.hdb.memory.fit import _near as as_near
from hydrodae.hdb.memory.goal import Goal, Quality
from hydrodae.hdb.memory.goal import noise as noise_of
from hydrodae.hdb.memory.modes import Problem
from hydrodae.hdb.memory.vector_fitting import Limits
from hydrodae.hdb.preparation.fit_stages import goes_on
from hydrodae.hdb.preparation.left_out import cure, ways_out

BAND = (0.2, 1.0)


@pytest.fixture(scope="module")
def right() -> hdb.HydroDatabase:
    """A cylinder of 5 m radius and 12 m draught, whose heave hardly radiates above 2 rad/s."""
    water = hdb.Water(np.linspace(0.06, 3.0, 50), depth=60.0)
    cylinder = hdb.Cylinder(5.0, 12.0, -6.0)
    return hdb.cylinders({"buoy": (0.0, 0.0)}, cylinder, water, orders=2, modes=40)[0]


def test_what_is_wrong_above_the_band_is_left_out_and_told(right):
    w, i = right.omega, right.index("buoy.heave")[0]
    a, b = right.added_mass.copy(), right.radiation_damping.copy()
    noise = np.random.default_rng(3).standard_normal((2, w.size)) * (w > 1.5)
    a[:, i, i] *= 1.0 + 0.1 * noise[0]
    b[:, i, i] += 0.1 * b[:, i, i].max() * noise[1]
    noisy = dataclasses.replace(right, added_mass=a, radiation_damping=b)
    fit = hdb.fit(noisy, "buoy.heave", band=BAND).memory["default"]
    assert fit.report["passive"]
    assert "left out" in fit.report["left_out"]

    # heave per newton of a mass that floats, by the fit and by the right tables
    stiffness = right.hydrostatic_stiffness("buoy")[2, 2]
    mass = stiffness / 9.81 * 12.0
    inside = (w >= BAND[0]) & (w <= BAND[1])
    w = w[inside]
    made = 1j * w * fit.added_mass_inf[0, 0] + fit.transfer(w)[:, 0, 0]
    known = right.radiation_damping[inside, i, i] + 1j * w * right.added_mass[inside, i, i]
    responses = [1.0 / (stiffness - w**2 * mass + 1j * w * z) for z in (made, known)]
    error = np.abs(responses[0] - responses[1]).max()
    assert error < 5e-3 * np.abs(responses[1]).max()

    # a fit of another inertia, or that rings beyond the tables, is no way out
    assert goes_on(fit, right)
    heavier = dataclasses.replace(fit, added_mass_inf=1.1 * fit.added_mass_inf)
    assert not goes_on(heavier, right)
    beside = np.array([[1.0 + 0.0j]])
    ringing = dataclasses.replace(
        fit,
        poles=np.append(fit.poles, -1e-3 + 3.5j),
        input_matrix=np.concatenate([fit.input_matrix, beside]),
        output_matrix=np.concatenate([fit.output_matrix, 1e3 * beside], axis=1),
    )
    assert not goes_on(ringing, right)


def test_nothing_in_the_band_is_left_out(right):
    w, i = right.omega, right.index("buoy.heave")[0]
    x = (w - 0.7) / 0.06
    a = right.added_mass.copy()
    a[:, i, i] *= 1.0 - 0.3 * x / (1.0 + x**2) ** 2
    wrong = dataclasses.replace(right, added_mass=a)
    ways = ways_out(wrong, BAND)
    assert ways
    # what is in the band has a repair, or none if most of it is wrong
    assert "or energy: interpolate them (hdb doctor --repair irregular), or" in cure(
        wrong, ["buoy.heave"], BAND
    )
    assert cure(right, ["buoy.heave"], BAND) == ""
    b = right.radiation_damping.copy()
    b[4:17, i, i] *= -1.0
    many = dataclasses.replace(right, radiation_damping=b)
    assert "causality or energy: compute again with a lid" in cure(many, ["buoy.heave"], BAND)
    for gone, text in ways:
        assert not np.any(gone & (w >= BAND[0]) & (w <= BAND[1])), text


def test_noise_in_the_band_widens_the_target_and_is_told(right):
    i = right.index("buoy.heave")[0]
    a = right.added_mass.copy()
    noise = np.random.default_rng(5).standard_normal(right.omega.size)
    a[:, i, i] *= 1.0 + 3e-4 * noise
    noisy = dataclasses.replace(right, added_mass=a)
    report = hdb.fit(noisy, "buoy.heave", band=BAND).memory["default"].report
    assert report["passive"]
    assert "noise" in report["noisy"]
    assert report["weighted_error_band"] < 3.0 * report["noise"] < 0.01
    # a target that is asked for is held
    with refused("target"):
        hdb.fit(noisy, "buoy.heave", band=BAND, target=4.5e-4)


def test_one_wrong_frequency_is_told_and_left_out(right):
    i, w = right.index("buoy.heave")[0], right.omega
    assert lone_findings(right, BAND) == []
    for table, factor in (("radiation_damping", 2.0), ("added_mass", 1.1)):
        wrong = getattr(right, table).copy()
        wrong[12, i, i] *= factor
        garbled = dataclasses.replace(right, **{table: wrong})
        (finding,) = lone_findings(garbled, BAND)
        assert finding.severity == "warning"
        assert finding.omega == pytest.approx(w[12])

    fit = hdb.fit(garbled, "buoy.heave", band=BAND).memory["default"]
    assert f"{w[12]:.4g} rad/s" in fit.report["left_out"]
    a_inf = fit.added_mass_inf[0, 0]
    known = right.radiation_damping[:, i, i] + 1j * w * (right.added_mass[:, i, i] - a_inf)
    off = np.abs(fit.transfer(w)[:, 0, 0] - known)
    assert off[12] < 0.01 * np.abs(known[12])


def test_many_wrong_frequencies_are_refused(right):
    i = right.index("buoy.heave")[0]
    a = right.added_mass.copy()
    a[[4, 11], i, i] *= 1.2
    with refused("frequencies", "lone"):
        hdb.fit(dataclasses.replace(right, added_mass=a), "buoy.heave", band=BAND)


def test_a_narrow_resonance_is_no_wrong_frequency(right):
    # a causal mode narrower than the step, whose A goes with its B
    i, w = right.index("buoy.heave")[0], right.omega
    a, b = right.added_mass.copy(), right.radiation_damping.copy()
    p = complex(-0.02, w[20])
    h = 0.02 * b[:, i, i].max() * (1.0 / (1j * w - p) + 1.0 / (1j * w - p.conjugate()))
    b[:, i, i] += h.real
    a[:, i, i] += h.imag / w
    assert lone_findings(dataclasses.replace(right, added_mass=a, radiation_damping=b), BAND) == []


def test_noise_of_a_table_is_what_was_added():
    omega = np.linspace(0.1, 3.0, 60)
    smooth = 1.0 / (1j * omega + 0.5) + 2j * omega
    rows = np.zeros(1, dtype=int)

    def problem(value):
        samples = with_zero(omega, value[:, None], np.ones((omega.size, 1)))
        return Problem(samples, rows, rows, 1, Limits(omega, least_damping(omega)))

    mass = np.array([2.0])
    assert noise_of(problem(smooth), mass, (0.3, 2.0)) < 1e-5
    rng = np.random.default_rng(2)
    white = 1e-3 * (rng.standard_normal(60) + 1j * rng.standard_normal(60))
    inside = (omega >= 0.3) & (omega <= 2.0)
    size = np.linalg.norm((smooth - 2j * omega)[inside])
    expected = np.sqrt(2.0 * inside.sum()) * 1e-3 / size
    found = noise_of(problem(smooth + white), mass, (0.3, 2.0))
    assert found == pytest.approx(expected, rel=0.3)


def test_equal_devices_far_apart_are_fitted_once(right):
    one = right.select(["buoy.heave"])
    double = np.eye(2)

    def pair(table):
        return table * double if table.ndim == 3 else table * double[0]

    b = one.bodies["buoy"]
    two = dataclasses.replace(
        one,
        coordinates=("u1.heave", "u2.heave"),
        bodies={name: dataclasses.replace(b, name=name) for name in ("u1", "u2")},
        added_mass=pair(one.added_mass),
        radiation_damping=pair(one.radiation_damping),
        added_mass_inf=one.added_mass_inf * double,
        added_mass_inf_std=one.added_mass_inf_std * double,
        froude_krylov=np.repeat(one.froude_krylov, 2, axis=2),
        diffraction=np.repeat(one.diffraction, 2, axis=2),
    )
    told: list[str] = []
    fit = hdb.fit(two, "all", band=BAND, progress=told.append).memory["default"]
    assert sum("its fit" in text for text in told) == 1
    assert fit.report["passive"]
    h = fit.transfer(right.omega)
    assert np.allclose(h[:, 0, 0], h[:, 1, 1])
    assert np.abs(h[:, 0, 1]).max() == 0.0
    # one that is larger by 1 % is fitted by itself
    larger = np.diag([1.0, 1.01])
    other = dataclasses.replace(
        two,
        added_mass=two.added_mass * larger,
        radiation_damping=two.radiation_damping * larger,
        added_mass_inf=two.added_mass_inf * larger,
    )
    told.clear()
    hdb.fit(other, "all", band=BAND, progress=told.append)
    assert not any("its fit" in text for text in told)


def test_a_misfit_that_neighbours_share_is_no_noise():
    goal = Goal(BAND, 500.0, 4.5e-4, 0.15, None)
    near = Quality(5e-3, 5e-3, 5e-3, 0.1, 5e-3, 2e-3)
    assert as_near(near, 2e-3, goal)
    assert not as_near(dataclasses.replace(near, steady=4.9e-3), 2e-3, goal)
    assert not as_near(near, 1e-3, goal)  # five times the noise
    assert not as_near(dataclasses.replace(near, weighted_band=0.02), 1e-2, goal)
    # no panels are surer of H than that
    assert as_near(dataclasses.replace(near, weighted_band=1.9e-3), 0.0, goal)
    assert not as_near(dataclasses.replace(near, weighted_band=2.1e-3), 0.0, goal)
    assert not as_near(
        dataclasses.replace(near, weighted_band=1e-3, weighted_outside=0.2), 0.0, goal
    )


def test_a_hopeless_table_is_not_fitted_before_the_part_that_can_be_met(right, monkeypatch):
    from hydrodae.hdb import memory

    i = right.index("buoy.heave")[0]
    b = right.radiation_damping.copy()
    high = right.omega > 1.5
    b[high, i, i] += b[:, i, i].max() * np.random.default_rng(3).standard_normal(high.sum())
    tried = []
    whole = memory.fit_memory

    def counted(tables, *args, **options):
        tried.append(tables.omega.size)
        return whole(tables, *args, **options)

    monkeypatch.setattr(memory, "fit_memory", counted)
    noisy = dataclasses.replace(right, radiation_damping=b)
    fit = hdb.fit(noisy, "buoy.heave", band=BAND).memory["default"]
    assert fit.report["target_met"]
    assert len(tried) == 1
    assert tried[0] < right.omega.size


def test_lateral_motions_of_a_body_of_revolution_take_the_planar_fit(right):
    told: list[str] = []
    labels = [f"buoy.{dof}" for dof in ("surge", "sway", "roll", "pitch")]
    fit = hdb.fit(right, labels, band=BAND, progress=told.append).memory["default"]
    assert sum("tables of a group before" in text for text in told) == 1
    assert fit.report["passive"]
    assert fit.report["h_error_band"] < 2e-3
