"""Springs and end stops against closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.attack.parts import Table, body, case, driven, spring
from tests.errors import wrong
from tests.verification.blocks import METHODS, block, run_tables

from hydrodae.errors import CaseError, SolverError


def _spring(name: str, **law: Any) -> Table:
    """Return a spring of 1 m between the ground and the block."""
    return dict(type="spring_damper", name=name, body_a="ground", body_b="block") | dict(
        point_a=[-1.0, 0.0, 0.0], point_b=[0.0, 0.0, 0.0], **law
    )


def test_hardening_spring_keeps_its_energy() -> None:
    """m v^2 / 2 + k d^2 / 2 + k2 d^3 / 3 + k3 d^4 / 4 is constant."""
    law = _spring("spring", stiffness=20.0, hardening=[5.0, 40.0])
    run = block(law, 5.0, start=0.6)
    d = run["joints/slide/displacement"].values
    v = run["joints/slide/displacement_rate"].values
    potential = 10.0 * d**2 + 5.0 / 3.0 * d**3 + 10.0 * d**4
    energy = v**2 + potential
    assert np.ptp(energy) < 1e-6 * energy[0]
    assert run["energy/potential"].values == pytest.approx(potential, abs=1e-6)


def test_a_spring_that_pushes_away_has_two_places_of_rest() -> None:
    """f = k d - k3 d^3 with k = 8, k3 = 200: rest at d = 0.2; small swings of 2 k / m."""
    law = _spring("snap", stiffness=-8.0, hardening=[0.0, 200.0])
    omega = math.sqrt(16.0 / 2.0)
    run = block(law, 2.0 * math.pi / omega, start=0.2001, step=2.0 * math.pi / omega / 64)
    d = run["joints/slide/displacement"].values
    assert d[32] == pytest.approx(0.1999, abs=2e-7)
    assert d[-1] == pytest.approx(0.2001, abs=2e-7)


def test_a_curve_goes_through_its_points() -> None:
    """Driven along it, the load at each point is that of the table, and beyond it straight on."""
    points, loads = [-0.2, 0.0, 0.1, 0.3], [-30.0, 0.0, 5.0, 35.0]
    law = _spring("spring", curve_at=points, curve_force=loads)
    moves = [driven("drive", {"constant": -0.4, "rate": 0.1}, joint="slide")]
    run = block(law, 8.0, start=-0.4, speed=0.1, step=1.0, constraint=moves)
    force = run["forces/spring/force"].values
    at = run["joints/slide/displacement"].values
    expected = {-0.4: 60.0, -0.3: 45.0, -0.2: 30.0, 0.0: 0.0, 0.1: -5.0, 0.3: -35.0, 0.4: -50.0}
    for place, load in expected.items():
        k = int(np.argmin(abs(at - place)))
        assert force[k] == pytest.approx(load, abs=1e-6), place
    slope = np.diff(-force) / np.diff(at)
    assert (slope > 0.0).all()  # monotone between them


def stop(**law: float) -> Table:
    return dict(type="end_stop", name="stop", joint="slide", upper=0.0) | law


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("zeta", [0.05, 0.2, 0.5])
def test_linear_stop_gives_back_what_the_closed_form_says(method: str, zeta: float) -> None:
    """m u'' + c u' + k u = 0 until the load is zero (no pull); k = 1e6, m = 100, v = 1 m/s."""
    m, k, v0 = 100.0, 1e6, 1.0
    omega = math.sqrt(k / m)
    damped = omega * math.sqrt(1.0 - zeta**2)
    t = math.atan2(2.0 * zeta * math.sqrt(1.0 - zeta**2), 2.0 * zeta**2 - 1.0) / damped
    u = v0 / damped * math.exp(-zeta * omega * t) * math.sin(damped * t)
    u_dot = -k * u / (2.0 * zeta * omega * m)  # where k u + c u' = 0
    force = stop(stiffness=k, exponent=1.0, viscous=2.0 * zeta * omega * m)
    run = block(force, 0.1, mass=m, start=-0.01, speed=v0, method=method, step=1e-4)
    assert run["joints/slide/displacement_rate"].values[-1] == pytest.approx(u_dot, abs=1e-5)
    most = v0 / omega * math.exp(-zeta / math.sqrt(1.0 - zeta**2) * math.acos(zeta))
    assert run["forces/stop/penetration"].values.max() == pytest.approx(most, rel=1e-4)
    assert run["forces/stop/force"].values.max() <= 0.0  # never pulls


@pytest.mark.parametrize("exponent", [1.0, 1.5, 3.0])
def test_hunt_crossley_gives_back_what_the_closed_form_says(exponent: float) -> None:
    """d v - ln(1 + d v) is the same before and after, whatever k and n are."""
    d, v = 0.4, 1.5

    def side(rate: float) -> float:
        return d * rate - math.log(1.0 + d * rate)

    low, high = 0.0, v
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if side(-middle) < side(v) else (low, middle)
    force = stop(stiffness=1e5, exponent=exponent, damping=d)
    run = block(force, 0.5, mass=10.0, start=-0.05, speed=v)
    assert run["joints/slide/displacement_rate"].values[-1] == pytest.approx(-low, rel=1e-6)


def test_a_stop_with_a_width_stores_what_it_gives_back() -> None:
    force = stop(stiffness=2e4, exponent=1.0, width=0.02)
    run = block(force, 0.4, mass=10.0, start=-0.05, speed=1.0, step=0.001)
    total = run["energy/total"].values
    assert np.ptp(total) < 1e-6 * total[0]
    assert run["joints/slide/displacement_rate"].values[-1] == pytest.approx(-1.0, rel=1e-7)
    with wrong("force.stop.upper"):
        block(dict(type="end_stop", name="stop", joint="slide", stiffness=1.0), 1.0)


PLACE = [1.0, 2.0, 3.0]


def at_one_place(speed: list[float], end: float, **keys: Any) -> Table:
    """Return a bob on a spring that holds it where it is."""
    law = spring("spring", "ground", "bob", PLACE, keys.pop("point_b", PLACE), 8.0, **keys)
    bob = body("bob", "point", 2.0, PLACE, velocity=speed)
    return case([bob], end, forces=[law], gravity=0.0, output={"step": 0.01})


def test_a_spring_without_length_rests_where_its_points_coincide() -> None:
    """How it leaves the place and comes back is in test_families."""
    run = run_tables(at_one_place([0.0, 0.0, 0.0], 1.0), method="radau", rtol=1e-9)
    assert np.ptp(run["bodies/bob/position"].values, axis=0).max() == 0.0
    one, same = (
        run_tables(at_one_place([1.0, -2.0, 0.5], 1.0, **k)) for k in ({}, {"length": 0.0})
    )
    np.testing.assert_array_equal(one["bodies/bob/position"], same["bodies/bob/position"])


@pytest.mark.parametrize("keys", [{"length": 0.1}, {"force": 1.0}])
def test_a_spring_that_pushes_where_its_points_coincide_is_refused(keys: Table) -> None:
    with wrong("force.spring.point_b"):
        run_tables(at_one_place([1.0, 0.0, 0.0], 1.0, **keys))


def test_a_spring_that_starts_at_one_place_only_is_refused_by_name() -> None:
    """The reference pose has a direction, the start has none."""
    tables = at_one_place([0.0, 0.0, 0.0], 1.0, length=0.1, point_b=[2.0, 2.0, 3.0])
    tables["body"][0]["initial"]["displacement"] = [-1.0, 0.0, 0.0]
    with pytest.raises((CaseError, SolverError), match="'spring': its points are at one place"):
        run_tables(tables)
