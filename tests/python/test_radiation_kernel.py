"""The kernel of the convolution and its added mass, against exact sums of damped cosines."""

from __future__ import annotations

import numpy as np
import pytest
from tests.errors import refused
from tests.python.test_irf import A_INF, ExactKernel

from hydrodae import hdb
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.convolution import taper
from hydrodae.hdb.database.radiation_kernel import make_kernel
from hydrodae.hdb.database.tables import Body

BAND = (0.2, 3.0)


def database(labels=("buoy.surge", "buoy.heave"), coupling=0.0) -> HydroDatabase:
    """Two coordinates with the kernel of B ~ w^-4, the second one twice as large."""
    omega, a, b = ExactKernel(4).tables(10.0, 0.05)
    form = np.array([[1.0, coupling], [coupling, 2.0]])
    n = len(labels)
    return HydroDatabase(
        coordinates=labels,
        omega=omega,
        added_mass=a[:, None, None] * form,
        radiation_damping=b[:, None, None] * form,
        added_mass_inf=form,
        added_mass_inf_std=np.zeros((n, n)),
        heading=np.zeros(1),
        froude_krylov=np.zeros((omega.size, 1, n), dtype=complex),
        diffraction=np.zeros((omega.size, 1, n), dtype=complex),
        bodies={"buoy": Body("buoy", np.zeros(3))},
        rho=1000.0,
        gravity=9.81,
    )


def test_kernel_added_mass_and_report():
    kernel = make_kernel(database(), ["buoy.heave"], band=BAND)
    exact = 2.0 * ExactKernel(4).kernel(kernel.time)
    assert np.abs(kernel.values[:, 0, 0] - exact).max() < 1e-4
    assert kernel.added_mass_inf[0, 0] == pytest.approx(2.0 * A_INF, rel=1e-3)
    assert kernel.report["h_error_band"] < 2e-3
    # the envelope rule: a thousandth of int |K| beyond T
    long = np.arange(0.0, 200.0, 0.01)
    size = np.abs(ExactKernel(4).kernel(long))
    assert size[long > kernel.length].sum() < 1.05e-3 * size.sum()
    assert size[long > 0.9 * kernel.length].sum() > 1e-3 * size.sum()


def test_a_longer_memory_matches_h_better():
    errors = [
        make_kernel(database(), ["buoy.heave"], length=length, band=BAND, limit=1.0).report[
            "h_error_band"
        ]
        for length in (5.0, 10.0, 20.0, 40.0)
    ]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 2e-4


def test_transfer_is_that_of_the_kernel_as_it_is_used():
    kernel = make_kernel(database(), ["buoy.heave"], length=30.0, band=BAND)
    w = np.array([0.0, 0.7, 2.5])
    fine = np.linspace(0.0, kernel.length, 200_001)
    used = 2.0 * ExactKernel(4).kernel(fine) * taper(fine)
    direct = [np.trapezoid(used * np.exp(-1j * x * fine), fine) for x in w]
    np.testing.assert_allclose(kernel.transfer(w)[:, 0, 0], direct, atol=2e-4)


def test_no_coupling_is_stored_as_zero():
    kernel = make_kernel(database(coupling=1e-9), ["buoy.surge", "buoy.heave"], band=BAND)
    assert not kernel.values[:, 0, 1].any()
    assert kernel.values[:, 0, 0].any()
    coupled = make_kernel(database(coupling=0.1), ["buoy.surge", "buoy.heave"], band=BAND)
    assert coupled.values[:, 0, 1].any()


def test_kernel_follows_selection_names_and_reference_points(tmp_path):
    db = database().with_kernel(["buoy.heave"], ["buoy.surge"], band=BAND)
    assert db.kernel is not None
    assert db.kernel.outputs == ("buoy.heave", "buoy.surge")
    only = db.select(["buoy.heave"]).kernel
    assert only is not None
    assert only.outputs == ("buoy.heave",)
    assert db.select(["buoy.surge"]).kernel is None
    renamed = db.renamed({"buoy": "float"}).kernel
    assert renamed is not None
    assert renamed.inputs == ("float.heave",)
    db.write(tmp_path / "hydro.h5")
    back = hdb.read(tmp_path / "hydro.h5").kernel
    assert back is not None
    np.testing.assert_array_equal(back.values, db.kernel.values)
    assert "K(t) to" in db.summary()


def test_moved_kernel_is_that_of_the_moved_tables():
    labels = ("buoy.surge", "buoy.pitch")
    whole = database(labels, coupling=0.3)
    before = whole.with_kernel(labels, length=20.0, band=BAND)
    point = {"buoy": [0.0, 0.0, -2.0]}
    moved = before.moved_to(point).kernel
    made = whole.moved_to(point).with_kernel(labels, length=20.0, band=BAND).kernel
    assert moved is not None
    assert made is not None
    np.testing.assert_allclose(moved.values, made.values, atol=1e-12)
    np.testing.assert_allclose(moved.added_mass_inf, made.added_mass_inf, rtol=1e-9)


def test_bad_requests_are_refused():
    with refused("option", "length"):
        make_kernel(database(), ["buoy.heave"], length=0.1, band=BAND)
    with refused("frequencies", "band"):
        make_kernel(database(), ["buoy.heave"], band=(20.0, 30.0))
    with refused("label", "buoy.haeve"):
        make_kernel(database(), ["buoy.haeve"], band=BAND)
