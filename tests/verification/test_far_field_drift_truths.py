"""Far-field drift against closed forms, WAMIT and own values of a hemisphere."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.scenes import table

import hydrodae
from hydrodae import hdb
from hydrodae.case import Case
from hydrodae.hdb.bem import run as bem
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.database.kochin import diffraction_of
from hydrodae.hdb.interaction.cylinder import Cylinder
from hydrodae.hdb.preparation import computing
from hydrodae.hdb.preparation.cylinder_array import Water, cylinders
from hydrodae.hdb.relations.dispersion import frequency
from hydrodae.hdb.relations.far_field import horizontal_drift

#: Drift on a fixed cylinder in deep water over rho g A^2 a, by k a (Havelock, Proc. R. Soc. A 175
#: (1940) 409), as the README of the reference data has it; 2/3 for short waves.
HAVELOCK = {
    0.1: 0.00307, 0.2: 0.02393, 0.3: 0.07673, 0.4: 0.16678, 0.5: 0.28599, 0.6: 0.41393,
    0.8: 0.60765, 1.0: 0.66493, 1.5: 0.60041, 2.0: 0.62717, 3.0: 0.63292, 5.0: 0.64376,
    10.0: 0.65508,
}  # fmt: skip


def test_cylinder_to_the_bed() -> None:
    """MacCamy and Fuchs: at finite depth the factor is 1 + 2kh / sinh 2kh.

    The gap below is a thousandth of the depth.
    """
    depth, k = 10.0, np.array(list(HAVELOCK))
    water = Water(frequency(k, depth, 9.81), depth)
    body = Cylinder(1.0, 0.999 * depth, -0.5)
    data, _ = cylinders({"pile": (0.0, 0.0)}, body, water, orders=14, modes=60, kochin=64)
    _, kochin = diffraction_of(data)
    drift = horizontal_drift(kochin, data.heading, data.omega, data.rho, data.gravity, depth)
    found = drift[:, 0, 0] / (
        data.rho * data.gravity * (1.0 + 2 * k * depth / np.sinh(2 * k * depth))
    )
    assert found == pytest.approx(np.array(list(HAVELOCK.values())), rel=5e-3)


@pytest.fixture(scope="module")
def hemisphere(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the database of a hemisphere of 1 m in deep water, by Capytaine."""
    pytest.importorskip("capytaine")
    folder = tmp_path_factory.mktemp("hemisphere")
    omega = np.sqrt(9.80665 * np.array(KR))
    settings = bem.Settings(omega, rho=1000.0, gravity=9.80665, kochin=36)
    body = bem.WettedBody("ball", shapes.sphere(0.1, radius=1.0), np.zeros(3))
    data, _ = computing.compute([body], settings, folder / "work")
    data.write(folder / "hydro.h5")
    return folder


#: Where the own values are.
KR = (0.5, 0.948, 1.285, 1.672, 2.11)


def ball(folder: Path, damping: float) -> Case:
    """A hemisphere that surges and heaves, with a damper on its heave to the ground."""
    statics = hdb.HydroDatabase.read(folder / "hydro.h5").bodies["ball"].hydrostatics
    assert statics is not None
    mass = 1000.0 * statics.displaced_volume
    body = table(
        "body", name="ball", hydro="ball", mass=float(mass), inertia=[100.0] * 3,
        center_of_gravity=[0.0, 0.0, 0.0], motion=["surge", "heave"],
    )  # fmt: skip
    damper = table(
        "force", name="damper", type="viscous_damping", body="ball",
        linear=[0.0, 0.0, damping, 0.0, 0.0, 0.0],
    )  # fmt: skip
    head = '[hydro]\ndatabase = "hydro.h5"\nradiation = "none"\n'
    return Case.from_text(
        head + body + damper + "[solver]\nend_time = 1.0\n[output]\nstep = 0.1\n", folder
    )


def own_values(reference: Path, damping: float) -> np.ndarray:
    rows = np.genfromtxt(
        reference / "second_order" / "own_values" / "hemisphere.csv", delimiter=",", names=True
    )
    return np.asarray(rows[rows["damper_Ns_m"] == damping])


#: Panels of 0.10 m are 2.2 % below the own value, of 0.12 m 2.1 %; the reason is not known.
SHORT_WAVE = pytest.mark.xfail(reason="kR 2.11: 0.638, own value 0.652, its other form 0.646")


@pytest.mark.slow
@pytest.mark.parametrize("place", [0, 1, 2, 3, pytest.param(4, marks=SHORT_WAVE)])
def test_damped_hemisphere(hemisphere: Path, reference: Path, place: int) -> None:
    """By energy, as with 1536 panels: 2 %; the damper takes nearly all of the drift of long waves.

    The own values are by two forms, which differ by up to 1.7 %.
    """
    expected = own_values(reference, 1500.0)[place]
    found = hydrodae.drift(ball(hemisphere, 1500.0), omega=[np.sqrt(9.80665 * expected["kR"])])
    unit = 1000.0 * 9.80665
    assert found.by_power[0, 0] / unit == pytest.approx(expected["by_power_1500"], rel=0.02)


@pytest.mark.slow
def test_free_hemisphere_of_wamit(hemisphere: Path, reference: Path) -> None:
    """Control surface of WAMIT, off the resonance of heave (kR .948): 3 %."""
    run = hdb.import_database(reference / "second_order" / "wecsim_mean_drift_sphere")[0]
    mean = run.second_order["mean"]
    k = np.array(KR[2:])
    found = hydrodae.drift(ball(hemisphere, 0.0), omega=np.sqrt(9.80665 * k))
    surge = mean.values[:, 0, mean.coordinates.index("sphere.surge")].real / (run.rho * run.gravity)
    known = np.interp(k, mean.omega**2 / run.gravity, surge)
    assert found.load[:, 0, 0].real / (1000.0 * 9.80665) == pytest.approx(known, rel=0.03)
    assert np.all(found.by_power > 0.0)
