"""Spectra and components in files: units, directions, phases."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.python.record_files import OMEGA, PEAK, bretschneider, table, written

from hydrodae.errors import CaseError
from hydrodae.records import read_components, read_spectrum


@pytest.mark.parametrize(
    ("names", "abscissa", "factor"),
    [
        ("omega,S", OMEGA, 1.0),
        ("f [Hz],S [m^2/Hz]", OMEGA / 2 / np.pi, 2 * np.pi),
        ("f [Hz],S [m2 s/rad]", OMEGA / 2 / np.pi, 1.0),
        ("frequency (rad/s),density [cm2 s]", OMEGA, 2e4 * np.pi),
        ("period,density", 2 * np.pi / OMEGA, OMEGA**2 / 2 / np.pi),
    ],
)
def test_spectra_in_every_unit(tmp_path, names, abscissa, factor):
    text = table(names, abscissa, factor * bretschneider(OMEGA))
    found = read_spectrum(written(tmp_path, text))
    np.testing.assert_allclose(found.omega, OMEGA, rtol=1e-9)
    np.testing.assert_allclose(found.density[0], bretschneider(OMEGA), rtol=1e-9, atol=1e-15)
    held = math.exp(-1.25 * (PEAK / 3.0) ** 4)  # the part below the last frequency
    assert found.significant_height == pytest.approx(2.0 * math.sqrt(held), rel=1e-3)
    assert found.peak_period == pytest.approx(2 * np.pi / PEAK, rel=0.02)


ANGLES = np.arange(-90.0, 91.0, 15.0)


def spread(degrees):
    """2/pi cos^2, in 1/rad."""
    return 2.0 / np.pi * np.cos(np.radians(degrees)) ** 2


@pytest.mark.parametrize("form", ["matrix", "pairs"])
def test_spectra_over_directions(tmp_path, form):
    grid = 2 * np.pi * bretschneider(OMEGA)[:, None] * spread(ANGLES) * np.pi / 180.0
    hertz = OMEGA / 2 / np.pi
    if form == "matrix":
        text = table("f [Hz]," + ",".join(f"{a:g}" for a in ANGLES), hertz, *grid.T)
    else:
        pairs = np.repeat(ANGLES, len(hertz)), np.tile(hertz, len(ANGLES))
        text = table("dir [deg],f [Hz],S [m2/Hz/deg]", *pairs, grid.T.ravel())
    found = read_spectrum(written(tmp_path, text))
    assert found.heading is not None
    np.testing.assert_allclose(np.degrees(found.heading), ANGLES)
    np.testing.assert_allclose(found.density.sum(axis=0), bretschneider(OMEGA), rtol=1e-6)
    waves = found.waves()
    assert len(waves) == 11  # not +-90 deg, where nothing travels
    assert waves[0]["heading_deg"] == pytest.approx(-75.0)


def test_a_mean_direction_of_each_frequency_keeps_the_energy(tmp_path):
    headings = np.where(OMEGA < 0.9, 20.0, -170.0)
    text = table("omega,S,direction", OMEGA, bretschneider(OMEGA), headings)
    found = read_spectrum(written(tmp_path, text))
    assert [w["heading_deg"] for w in found.waves()] == pytest.approx([-170.0, 20.0])
    np.testing.assert_allclose(found.density.sum(axis=0), bretschneider(OMEGA), rtol=1e-7)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("f,S\n0.1,1\n0.2,2\n", r"states no unit.*--columns \"f \[Hz\], S\""),
        ("0.1,1\n0.2,2\n", "which column is the frequency"),
        ("f [Hz],S [kg]\n0.1,1\n0.2,2\n", "unknown unit; known are m2/Hz"),
        ("f [s],S\n0.1,1\n0.2,2\n", r"expected a unit of rad/s"),
        ("omega,S\n0.1,1\n0.2,-2\n", "missing or negative"),
        ("omega,S\n0.1,1\n0.1,2\n", "each once"),
        ("omega,S,direction\n0.1,1,0\n0.1,2,10\n0.2,1,0\n", "one row for each pair"),
    ],
)
def test_what_is_no_spectrum(tmp_path, text, message):
    with pytest.raises(CaseError, match=message):
        read_spectrum(written(tmp_path, text))


def test_components_with_phases(tmp_path):
    text = "amplitude [cm];frequency [Hz];direction;phase [deg]\n50;0,1;30;-90\n0;0,2;0;0\n"
    (one,) = read_components(written(tmp_path, text))
    assert one.amplitude == pytest.approx(0.5)
    assert one.omega == pytest.approx(0.2 * np.pi)
    assert one.heading == pytest.approx(np.pi / 6)
    assert one.phase == pytest.approx(-np.pi / 2)
    assert one.wave("a")["height"] == 1.0
    bare = written(tmp_path, "height,T,phase\n1,10,0.5\n")
    with pytest.raises(CaseError, match=r"'phase' states no unit.*phase \[deg\]"):
        read_components(bare)
    (one,) = read_components(bare, ["height", "T", "phase [rad]"])
    assert (one.amplitude, one.phase) == (0.5, 0.5)
    with pytest.raises(CaseError, match="which column is the amplitude"):
        read_components(written(tmp_path, "T,phase [rad]\n1,10\n"))


def test_components_of_a_density_with_phases_have_its_variance(tmp_path):
    text = table("omega,S,phase [rad]", OMEGA, bretschneider(OMEGA), np.sin(OMEGA))
    found = read_components(written(tmp_path, text))
    variance = 0.5 * sum(one.amplitude**2 for one in found)
    assert 4.0 * math.sqrt(variance) == pytest.approx(1.9899, abs=1e-3)
