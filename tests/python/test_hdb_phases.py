"""Phases of excitation forces.

Amplitudes cannot show a forgotten conjugation; phases can.
"""

from __future__ import annotations

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.relations.dispersion import wavenumber


@pytest.mark.parametrize("name", ["results.nc", "."])
def test_the_body_behind_feels_the_wave_later(reference, name):
    db = hdb.read(reference / "hdb" / "twospheres_capytaine_legacy" / name)
    first, second = db.bodies
    heave = db.index([f"{first}.heave", f"{second}.heave"])
    k = wavenumber(db.omega[:3], db.water_depth, db.gravity)
    # second sphere at y = 10 m; elevation cos(wt - k y) for heading 90 deg: it lags by 10 k
    along = db.excitation[:3, 1][:, heave]
    lag = np.angle(along[:, 1] / along[:, 0])
    np.testing.assert_allclose(lag, -10.0 * k, rtol=0.06)
    across = db.excitation[:3, 0][:, heave]
    np.testing.assert_allclose(np.angle(across[:, 1] / across[:, 0]), 0.0, atol=1e-3)


def test_phases_of_the_bodies_follow_their_places(device_tables):
    db = device_tables
    k = wavenumber(db.omega[5], db.water_depth, db.gravity)
    for h, beta in enumerate(db.heading):
        direction = np.array([np.cos(beta), np.sin(beta), 0.0])
        for body in db.bodies:
            force = db.froude_krylov[5, h, db.index(f"{body}.heave")[0]]
            expected = -k * db.reference_point(body) @ direction
            assert np.angle(force * np.exp(-1j * expected)) == pytest.approx(0.0, abs=0.02)


def assert_long_wave_phases(db):
    f = db.excitation[0, 0]
    assert np.angle(f[0]) == pytest.approx(np.pi / 2, abs=0.01)
    assert np.angle(f[2]) == pytest.approx(0.0, abs=0.01)
    assert abs(f[2]) == pytest.approx(db.hydrostatic_stiffness("sphere")[2, 2], rel=5e-3)


def test_surge_leads_and_heave_follows_the_elevation_in_long_waves(sphere_tables):
    assert_long_wave_phases(sphere_tables)


@pytest.mark.parametrize("name", ["sphere_nemoh_v2.3", "sphere_nemoh_v3.0.2"])
def test_phases_of_nemoh_in_long_waves(reference, name):
    assert_long_wave_phases(hdb.read(reference / "hdb" / name))
