"""Crests of given height: NewWave, and NewWave in a random sea."""

from __future__ import annotations

import numpy as np
import pytest
from tests.attack.parts import Table
from tests.errors import wrong
from tests.verification.sea_scenes import JONSWAP, elevation, gauge, rate, strut

import hydrodae
from hydrodae.linear.sea import wave_components

CREST: Table = {"height": 5.0, "time": 7.0, "place": [30.0, -12.0]}
NEW: Table = dict(name="design", type="new_wave", peak_period=10.0, heading_deg=25.0, crest=CREST)


@pytest.mark.parametrize(
    "more",
    [
        {},
        {"spectrum": "bretschneider", "components": 37},
        {"spectrum": "ochi_hubble", "shape": 2.5, "frequency_range": [0.4, 1.5]},
        {"gamma": 1.0},
    ],
)
def test_the_crest_is_exact(more: Table) -> None:
    case = strut(NEW | more, gauges=[CREST["place"], [0.0, 0.0]], step=1.0)
    results = hydrodae.run(case)
    assert abs(gauge(results)[7] - 5.0) < 1e-10
    assert abs(gauge(results, 1)[7]) < 4.9
    assert abs(rate(case, 7.0, *CREST["place"])) < 1e-10
    early, late = (elevation(case, 7.0 + t, *CREST["place"]) for t in (-2.3, 2.3))
    assert abs(early - late) < 1e-10


def test_amplitudes_are_the_energies_of_the_spectrum() -> None:
    """A S_n / sum S_n: of a straight line between two points the energies of bins are known."""
    keys: Table = dict(spectrum="table", frequency=[0.5, 1.5], density=[0.0, 2.0], components=10)
    case = strut(_without(NEW, keys))
    w, _, a, _ = wave_components(case).T
    np.testing.assert_allclose(w, 0.55 + 0.1 * np.arange(10), rtol=1e-12)
    np.testing.assert_allclose(a, 5.0 * (2.0 * np.arange(10) + 1.0) / 100.0, rtol=1e-9)


def _without(wave: Table, more: Table) -> Table:
    return {key: value for key, value in wave.items() if key != "peak_period"} | more


@pytest.mark.parametrize("more", [{}, {"spreading": 6.0}, {"spacing": "frequency"}])
def test_a_random_sea_has_the_crest(more: Table) -> None:
    case = strut(JONSWAP | {"crest": CREST} | more)
    x, y = CREST["place"]
    assert abs(elevation(case, 7.0, x, y) - 5.0) < 1e-10
    assert abs(rate(case, 7.0, x, y)) < 1e-10
    free = wave_components(strut(JONSWAP | more))
    kept = wave_components(case)
    np.testing.assert_array_equal(free[:, :2], kept[:, :2])
    assert np.abs(free[:, 2] - kept[:, 2]).max() > 1e-3


def test_the_mean_of_many_is_new_wave() -> None:
    """Mean of 1000 constrained seas: A rho(t), of the mean of their own autocorrelations."""
    t = np.array([-9.0, -4.0, -1.5, 0.0, 2.0, 5.0, 14.0])
    crest = {"height": 4.0, "time": 20.0}
    seas, rhos = [], []
    for seed in range(1000):
        wave = JONSWAP | {"seed": seed, "components": 30}
        seas.append(elevation(strut(wave | {"crest": crest}), 20.0 + t))
        w, _, a, _ = wave_components(strut(wave)).T
        rhos.append(np.cos(np.outer(t, w)) @ a**2 / (a**2).sum())
    rest = np.array(seas) - 4.0 * np.array(rhos)
    error = rest.std(axis=0) / np.sqrt(1000.0)
    assert error[3] < 1e-12
    assert (np.delete(error, 3) > 1e-3).all()
    assert (np.abs(rest.mean(axis=0)) <= 4.0 * error + 1e-10).all()


def test_a_crest_that_breaks_is_noted() -> None:
    steep = hydrodae.run(strut(NEW | {"crest": {"height": 12.0}, "peak_period": 8.0}, end=1.0))
    mild = hydrodae.run(strut(NEW | {"crest": {"height": 2.0}, "peak_period": 8.0}, end=1.0))
    assert any("crest of 12 m has a steepness" in note for note in steep.notes)
    assert not any("steepness" in note for note in mild.notes)


@pytest.mark.parametrize(
    ("wave", "key"),
    [
        (_without(NEW, {}), ""),
        ({k: v for k, v in NEW.items() if k != "crest"}, ""),
        (NEW | {"crest": {"time": 3.0}}, "crest.height"),
        (NEW | {"crest": {"height": -3.0}}, "crest.height"),
        (NEW | {"crest": {"height": 3.0, "place": [1.0]}}, "crest.place"),
        (NEW | {"shape": 2.0}, "shape"),
        (NEW | {"spectrum": "bretschneider", "gamma": 2.0}, "gamma"),
        (NEW | {"frequency": [0.5, 1.0]}, "frequency"),
        (NEW | {"spectrum": "table"}, "peak_period"),
        (JONSWAP | {"crest": {"height": 3.0, "place": [1.0, 2.0, 3.0]}}, "crest.place"),
        (JONSWAP | {"significant_height": 0.0, "crest": {"height": 3.0}}, "crest.height"),
    ],
)
def test_what_cannot_be_is_told(wave: Table, key: str) -> None:
    path = f"wave.{wave['name']}"
    with wrong(f"{path}.{key}" if key else path):
        strut(wave)
