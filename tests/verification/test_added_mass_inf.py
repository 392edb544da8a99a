"""A at infinite frequency: WAMIT, OrcaWave and Capytaine solve for it; the estimate must hold."""

from __future__ import annotations

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.readers.finishing import finish
from hydrodae.hdb.readers.reading import read_source
from hydrodae.hdb.relations import infinity

KNOWN = (
    "sphere_wamit",
    "rm3_wamit",
    "oswec_wamit",
    "cubes_wamit",
    "cylinder_wamit_out",
    "multibody_orcawave",
    "cylinder_hams",
    "cylinder_aqwa",
    "rm3_aqwa",
    "own/sphere.nc",
    "own/4n3la.nc",
)


def estimated(folder):
    """The truth of a source, and the database without it."""
    data = read_source(folder)
    assert data.added_mass_inf is not None
    truth = 0.5 * (data.added_mass_inf + data.added_mass_inf.T)
    data.added_mass_inf = None
    return truth, finish(data)


@pytest.mark.parametrize("name", KNOWN)
def test_the_truth_is_inside_the_stated_uncertainty(reference, name):
    truth, database = estimated(reference / "hdb" / name)
    error = np.abs(database.added_mass_inf - truth)
    # what vanishes by symmetry, and yaw of bodies of revolution, is noise of the mesh
    size = np.sqrt(np.abs(np.diag(truth)))
    scale = np.outer(size, size)
    turning = np.array([c.endswith(("roll", "pitch", "yaw")) for c in database.coordinates])
    least = [1e-4 * np.diag(truth)[turning == kind].max() for kind in turning]
    used = np.diag(truth) > least
    outside = (error > database.added_mass_inf_std) & (error > 1e-3 * scale)
    outside &= np.outer(used, used)
    if name == "rm3_aqwa":  # a resonance of the gap between two frequencies: 1.7 times A itself
        outside &= np.eye(len(truth), dtype=bool)
    assert not outside.any(), np.argwhere(outside)


def test_the_median_error_of_wamit_is_below_half_a_per_cent(reference):
    errors = []
    for name in KNOWN[:5]:
        truth, database = estimated(reference / "hdb" / name)
        diagonal = np.diag(truth)
        used = diagonal > 1e-5 * diagonal.max()
        errors += list(np.abs(np.diag(database.added_mass_inf) / diagonal - 1.0)[used])
    assert len(errors) > 40
    assert np.median(errors) < 0.002


@pytest.mark.parametrize("name", ["oswec_nemoh_v2.3", "oswec_nemoh_v3.0.2"])
def test_panels_that_fail_at_high_frequencies_do_not_spoil_it(reference, name):
    # the twin of WAMIT has an infinite frequency; panels of Nemoh's fail between 3 and 5 rad/s
    twin = hdb.read(reference / "hdb" / "oswec_wamit", rho=1000.0)
    database = hdb.read(reference / "hdb" / name)
    database = database.moved_to({body: twin.reference_point(body) for body in twin.bodies})
    for label in ("flap.pitch", "base.surge", "flap.surge"):
        i, j = database.index(label)[0], twin.index(label)[0]
        truth = twin.added_mass_inf[j, j]
        error = abs(database.added_mass_inf[i, i] - truth)
        assert error < 0.06 * truth, label
        assert error < database.added_mass_inf_std[i, i], label


@pytest.mark.parametrize("last", [2.0, 3.0, 4.0, 6.0, 9.0])
def test_a_smooth_tail_is_trusted_as_far_as_it_is_right(last):
    """One mode, H = s/((s - p)(s - p*)): its tail is smooth, and no power law before it is over."""
    omega, pole = np.linspace(0.03, last, 60), -1.0 + 0.6j
    s = 1j * omega
    h = s / ((s - pole) * (s - np.conj(pole)))
    value, doubt = infinity.added_mass_inf(omega, 1.0 + h.imag / omega, h.real)
    assert abs(value - 1.0) < doubt
    assert doubt < 0.04
