"""Fits of tables that are wrong above the band: the motion is that of the right tables."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.prepare import goes_on, ways_out

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
    ways = ways_out(dataclasses.replace(right, added_mass=a), BAND)
    assert ways
    for gone, text in ways:
        assert not np.any(gone & (w >= BAND[0]) & (w <= BAND[1])), text
