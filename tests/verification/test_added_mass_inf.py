"""A at infinite frequency: WAMIT, OrcaWave and Capytaine solve for it; the estimate must hold."""

from __future__ import annotations

import numpy as np
import pytest

from hydrodae import hdb, infinity
from hydrodae.hdb.readers.finishing import finish
from hydrodae.hdb.reading import read_source

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


def test_a_smooth_tail_that_begins_early_is_not_trusted():
    """A large cylinder whose B still is at 0.6 of its peak at the end of the table."""
    island = hdb.Cylinder(45.0, 30.0, -20.0)

    def table(last, count):
        water = hdb.Water(np.linspace(0.03, last, count), depth=300.0, rho=1025.0)
        return hdb.cylinders({"island": (0.0, 0.0)}, island, water, orders=2, modes=20)[0]

    short, whole = table(0.9, 35), table(2.5, 90)
    truth = np.diag(whole.added_mass_inf)[:3]
    i = np.arange(3)
    tables = short.added_mass[:, i, i], short.radiation_damping[:, i, i]
    value, doubt = infinity.added_mass_inf(short.omega, *tables)
    assert np.all(np.abs(value - truth) < doubt)
    assert doubt[0] > 0.02 * truth[0]
