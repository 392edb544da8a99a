"""The memory fit against the tables of its database, at the frequencies of the waves."""

from __future__ import annotations

import dataclasses
import re
from pathlib import Path

import numpy as np
import pytest
from tests.python.small_database import make_database

import hydrodae
from hydrodae import _core
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.memory import ExponentialMemory
from hydrodae.support.arrays import Array, Complex

OMEGA = np.linspace(0.2, 4.0, 39)  #: Of the tables [rad/s].
RHO, GRAVITY, AREA, VOLUME, DAMPING, A_INF, KERNEL = 1000.0, 9.81, 2.0, 1.5, 80.0, 700.0, 400.0
BAND = 2.0  #: The fit is the tables up to here; beyond it they have another added mass [rad/s].

CASE = """
hydro = {{ database = "hydro.h5", radiation = "exponential" }}
wave = [ {{ name = "w", {wave} }} ]
solver = {{ end_time = 0.5 }}
[[body]]
name = "buoy"
hydro = "float"
motion = "heave"
mass = {wet}
center_of_gravity = [0, 0, -1]
[[body]]
name = "ballast"
motion = "heave"
mass = {dry}
center_of_gravity = [0, 0, -3]
[[joint]]
name = "rod"
type = "fixed"
body_a = "buoy"
body_b = "ballast"
point = [0, 0, -2]
[[force]]
name = "pto"
type = "mooring_matrix"
body = "buoy"
stiffness = [0, 0, 0, 0, 0, 0]
damping = [0, 0, {damping}, 0, 0, 0]
"""


def radiation() -> Complex:
    """H(iw) = K / (iw + 1) [N s/m]: one decaying exponential."""
    return np.asarray(KERNEL / (1.0 + 1j * OMEGA))


def impedance(added: Array) -> Complex:
    """Force over heave of buoy and ballast, (nw,) [N/m]."""
    mass, K = RHO * VOLUME + added, RHO * GRAVITY * AREA
    return np.asarray(-(OMEGA**2) * mass + 1j * OMEGA * (radiation().real + DAMPING) + K)


def write(folder: Path, excess: float, wave: str) -> Path:
    """Case and database whose added mass beyond the band is larger by a share of A_inf."""
    H = radiation()
    fitted = A_INF + H.imag / OMEGA
    added = fitted + np.where(OMEGA > BAND, excess * A_INF, 0.0)
    memory = ExponentialMemory(
        "heave",
        ("float.heave",),
        ("float.heave",),
        poles=np.array([-1.0 + 0.0j]),
        input_matrix=np.array([[1.0 + 0.0j]]),
        output_matrix=np.array([[KERNEL + 0.0j]]),
        added_mass_inf=np.array([[A_INF]]),
        report={"n_states": 1, "passive": True},
    )
    statics = Hydrostatics(VOLUME, np.array([0.0, 0.0, -1.0]), AREA, np.zeros(5))
    database = dataclasses.replace(
        make_database(("float.heave",)),
        omega=OMEGA,
        added_mass=added[:, None, None],
        radiation_damping=H.real[:, None, None],
        added_mass_inf=np.array([[A_INF]]),
        froude_krylov=np.full((OMEGA.size, 1, 1), 1e3 + 0.0j),
        diffraction=np.zeros((OMEGA.size, 1, 1), complex),
        bodies={"float": Body("float", np.array([0.0, 0.0, -1.0]), statics)},
        rho=RHO,
        gravity=GRAVITY,
        memory={"heave": memory},
    )
    database.write(folder / "hydro.h5")
    path = folder / "case.toml"
    dry = 0.4 * RHO * VOLUME
    path.write_text(CASE.format(wave=wave, wet=RHO * VOLUME - dry, dry=dry, damping=DAMPING))
    return path


def expected(path: Path, excess: float) -> float:
    """The rms of what the motions by fit and tables differ, over that by the tables, in percent."""
    fitted = A_INF + radiation().imag / OMEGA
    by_fit = 1.0 / impedance(fitted)
    by_table = 1.0 / impedance(fitted + np.where(OMEGA > BAND, excess * A_INF, 0.0))
    waves = _core.wave_components(hydrodae.Case.read(path).scene)
    rows = np.abs(waves[:, :1] - OMEGA).argmin(axis=1)
    power = waves[:, 2] ** 2
    missed = power @ np.abs(by_fit - by_table)[rows] ** 2
    return float(100.0 * np.sqrt(missed / (power @ np.abs(by_table)[rows] ** 2)))


SEA = 'type = "jonswap", seed = 1, frequency_range = [0.3, 3.9], '


def regular(omega: float) -> str:
    return f'type = "regular", height = 0.01, period = {2.0 * np.pi / omega}'


@pytest.mark.parametrize(
    ("excess", "wave", "word"),
    [
        (0.5, regular(1.5), ""),  # within the band
        (0.005, regular(3.5), ""),  # beyond it, and well fitted
        (0.05, regular(3.5), "note"),
        (0.5, regular(3.5), "looks wrong"),
        (1e-4, SEA + "significant_height = 0.01, peak_period = 12.0", ""),
        (0.5, SEA + "significant_height = 0.01, peak_period = 2.5", "looks wrong"),
        (0.002, SEA + "significant_height = 0.01, peak_period = 2.0", "note"),
    ],
)
def test_waves_beyond_the_band_of_the_fit(
    tmp_path: Path, excess: float, wave: str, word: str
) -> None:
    """Closed form of one coordinate, held by a joint, in its own damping."""
    path = write(tmp_path, excess, wave)
    share = expected(path, excess)
    assert word == ("" if share < 1.0 else "note" if share < 10.0 else "looks wrong")
    notes = [n for n in hydrodae.run(path).notes if "misses the tables" in n]
    text = hydrodae.Case.read(path).examine()
    assert len(notes) == text.count("misses the tables") == (1 if word else 0)
    for note in notes:
        found = re.search(r"float.heave' is off by ([\d.e+]+) %", note)
        assert found
        assert float(found[1]) == pytest.approx(share, rel=0.06)  # two digits
        assert note.startswith("looks wrong") == (word == "looks wrong")
