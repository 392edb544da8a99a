"""Bound waves of second order at gauges and on slender members."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table
from tests.errors import wrong
from tests.verification.sea_scenes import JONSWAP, gauge, strut

import hydrodae

SECOND: Table = {"order": 2}


def regular(name: str, w: float, heading: float = 0.0, a: float = 1.0) -> Table:
    keys = dict(name=name, type="regular", height=2.0 * a, period=2.0 * math.pi / w)
    return keys | dict(heading_deg=heading)


def rows(reference: Path) -> list[dict[str, float]]:
    with (reference / "second_order" / "own_values" / "waves.csv").open() as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]


def second(runs: dict[int, hydrodae.Results]) -> np.ndarray:
    return np.asarray(gauge(runs[2]) - gauge(runs[1]))


def both_orders(*waves: Table, **keys: Any) -> dict[int, hydrodae.Results]:
    return {
        1: hydrodae.run(strut(*waves, **keys)),
        2: hydrodae.run(strut(*waves, sea=SECOND, **keys)),
    }


def test_two_waves_at_all_depths_and_headings(reference: Path) -> None:
    """Sum and difference amplitudes of 1 m waves, what each makes alone taken off."""
    for row in rows(reference):
        depth = None if math.isinf(row["depth_m"]) else row["depth_m"]
        w1, w2 = row["w1"], row["w2"]
        a = regular("a", w1, row["heading1_deg"])
        b = regular("b", w2, row["heading2_deg"])
        keys: Table = dict(depth=depth, end=20.0, step=1.0)
        pair = second(both_orders(a, b, **keys))
        alone = second(both_orders(a, **keys)) + second(both_orders(b, **keys))
        t = np.arange(21.0)
        exact = row["sum_m"] * np.cos((w1 + w2) * t)
        exact += row["difference_m"] * np.cos((w1 - w2) * t)
        np.testing.assert_allclose(pair - alone, exact, rtol=0.0, atol=1e-9, err_msg=str(row))


def test_a_regular_wave_is_that_of_stokes() -> None:
    w, a, depth = 0.9, 0.8, 15.0
    k = w**2 / 9.81
    for _ in range(300):
        k = w**2 / (9.81 * math.tanh(k * depth))
    found = second(both_orders(regular("a", w, a=a), depth=depth))
    c = 1.0 / math.tanh(k * depth)
    harmonic = 0.25 * k * a**2 * c * (3.0 * c**2 - 1.0)
    exact = harmonic * np.cos(2.0 * w * np.arange(len(found)) * 0.25)
    exact -= 0.5 * k * a**2 / math.sinh(2.0 * k * depth)
    np.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-10)


def test_only_the_difference_moves_deep_water() -> None:
    """phi2 = w1 a1 a2 sin(th1 - th2) e^{|k1 - k2| z} (Longuet-Higgins 1962), no sum."""
    w1, w2, a1, a2, z = 1.0, 0.8, 0.7, 0.9, -5.0
    inertia = dict(drag_coefficient=0.0, added_mass_coefficient=1.0)
    runs = both_orders(regular("a", w1, a=a1), regular("b", w2, a=a2), strut=inertia)
    t = runs[1].time
    found = [runs[k]["forces/strut/post/force"].to_numpy()[:, 0] for k in (1, 2)]
    weight = 2.0 * 1025.0 * 0.25 * math.pi * 0.1**2 * 2.0
    W, K = w1 - w2, (w1**2 - w2**2) / 9.81
    exact = weight * W * K * w1 * a1 * a2 * math.exp(K * z) * np.sin(W * t)
    assert np.abs(exact).max() > 1e-4 * np.abs(found[0]).max()
    np.testing.assert_allclose(found[1] - found[0], exact, atol=1e-9 * np.abs(exact).max() + 1e-9)


def test_the_limit_cuts_and_both_are_printed() -> None:
    runs = both_orders(JONSWAP | {"components": 40})
    low = hydrodae.run(strut(JONSWAP, sea=SECOND | {"second_order_limit": 0.3}))
    assert any("0 of 60 components, up to 0.3 rad/s" in note for note in low.notes)
    default = math.sqrt(2.0 * 9.81 / 3.0)
    assert any(f"up to {default:.4g} rad/s" in note for note in runs[2].notes)
    np.testing.assert_array_equal(gauge(low), gauge(hydrodae.run(strut(JONSWAP))))


def test_fewer_terms_move_slender_members_but_gauges_have_all() -> None:
    few = hydrodae.run(strut(JONSWAP, sea=SECOND | {"second_order_terms": 30}))
    many = hydrodae.run(strut(JONSWAP, sea=SECOND | {"second_order_terms": 100000}))
    np.testing.assert_array_equal(gauge(few), gauge(many))
    assert any("the 30 largest of" in note for note in few.notes)
    assert any("100 % of the rms of their elevation" in note for note in many.notes)
    # near the surface all terms are the elevation that gauges have
    np.testing.assert_allclose(many["sea/elevation"], gauge(many), atol=1e-9)


def test_crests_grow_and_troughs_flatten() -> None:
    runs = both_orders(JONSWAP, end=400.0, step=0.5)
    first, whole = gauge(runs[1]), gauge(runs[2])

    def skewness(x: np.ndarray) -> float:
        return float(((x - x.mean()) ** 3).mean() / x.std() ** 3)

    assert skewness(whole) - skewness(first) > 0.05


@pytest.mark.parametrize(
    ("sea", "waves", "key"),
    [
        ({"order": 3}, [JONSWAP], "sea.order"),
        ({"order": 2}, [], "sea.order"),
        ({"second_order_limit": 1.0}, [JONSWAP], "sea.second_order_limit"),
        ({"second_order_terms": 10}, [JONSWAP], "sea.second_order_terms"),
        ({"order": 2}, [JONSWAP | {"components": 5000}], "sea.order"),
    ],
)
def test_what_cannot_be_is_told(sea: Table, waves: list[Table], key: str) -> None:
    with wrong(key):
        hydrodae.run(strut(*waves, sea=sea, end=1.0))
