"""The band that a device feels, and what is judged in it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.checks.band import LONGEST, felt_band
from hydrodae.hdb.checks.ground import standing
from hydrodae.hdb.checks.longwave import long_wave_findings


def test_waves_much_shorter_than_the_body_are_not_felt(sphere):
    low, high = felt_band(sphere)
    assert low == pytest.approx(LONGEST)
    # at the natural frequency of heave it moves most; waves of half its diameter are not felt
    resonance = 2.0 * np.pi / 4.36
    assert 1.3 * resonance < high < np.sqrt(2.0 * np.pi / 5.0 * sphere.gravity)


def test_the_band_follows_the_size(sphere):
    # lengths over 16, at the same gravity: frequencies times 4
    small = replace(
        sphere,
        omega=4.0 * sphere.omega,
        added_mass=sphere.added_mass / 16.0**3,
        added_mass_inf=sphere.added_mass_inf / 16.0**3,
        radiation_damping=sphere.radiation_damping * 4.0 / 16.0**3,
        froude_krylov=sphere.froude_krylov / 16.0**2,
        diffraction=sphere.diffraction / 16.0**2,
        bodies={"sphere": replace(sphere.bodies["sphere"], hydrostatics=None)},
    ).select(["sphere.surge", "sphere.heave"])
    big = replace(
        sphere, bodies={"sphere": replace(sphere.bodies["sphere"], hydrostatics=None)}
    ).select(["sphere.surge", "sphere.heave"])
    assert felt_band(small)[1] == pytest.approx(4.0 * felt_band(big)[1], rel=1e-9)


def test_negative_damping_counts_in_the_band_only(sphere):
    high = felt_band(sphere)[1]
    for where, severity in ((0.5 * high, "error"), (1.5 * high, "info")):
        b = sphere.radiation_damping.copy()
        heave = sphere.index("sphere.heave")[0]
        b[np.abs(sphere.omega - where).argmin(), heave, heave] = -b[:, heave, heave].max()
        report = hdb.check(replace(sphere, radiation_damping=b))
        assert report.find("B positive semidefinite")[0].severity == severity
        whole = hdb.check(replace(sphere, radiation_damping=b), band=(0.02, 8.4))
        assert whole.find("B positive semidefinite")[0].severity == "error"


def test_a_deep_body_in_shallow_water_is_no_contradiction(reference):
    # a spar of 30 m in 49.5 m: the plate at its foot feels a fraction of the acceleration
    database = hdb.read(reference / "hdb" / "rm3_aqwa")
    found = {f.check: f for f in long_wave_findings(database)}
    assert found["heave force against stiffness"].severity == "info"


def test_phases_are_those_of_where_the_water_pushes(reference):
    # OrcaWave's reference point is 26 m from the body: k x' is 0.02 at the lowest frequency
    database = hdb.read(reference / "hdb" / "multibody_orcawave")
    (phase,) = [f for f in long_wave_findings(database) if f.check == "phase convention"]
    assert phase.value < 2e-3


def test_errors_of_a_body_on_the_ground_alone_are_warnings(reference):
    # the base of the flap stands on the ground; heave of both, as if sealed, is not reciprocal
    whole = hdb.read(reference / "hdb" / "oswec_wamit", rho=1000.0)
    report = hdb.check(whole)
    assert report.ok
    assert "base stands on the ground at -10.9 m" in report.find("assumption")[0].message
    assert report.find("B positive semidefinite")[0].value < -0.5
    lifted = replace(whole, water_depth=12.0)
    assert standing(whole) == ["base"]
    assert standing(lifted) == []
    assert hdb.check(lifted).find("B positive semidefinite")[0].severity == "error"
    b = whole.radiation_damping.copy()
    heave = whole.index("flap.heave")[0]
    b[10:20, heave, heave] *= -2.0
    report = hdb.check(replace(whole, radiation_damping=b))
    assert report.find("B positive semidefinite")[0].severity == "error"
