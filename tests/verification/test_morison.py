"""Morison elements and the motion of the water against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.attack.parts import ORIGIN, Table, Vector, body, case
from tests.verification.blocks import case_of, run_tables

from hydrodae.errors import CaseError
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.linear import LinearModel

RHO, GRAVITY = 1000.0, 9.81


#: A wave of 1 m from the west.
WAVE = dict(name="swell", type="regular", height=2.0, period=7.0, heading_deg=0.0)


def point_mass(
    elements: Table,
    end: float,
    *,
    motion: Any = "heave",
    depth: float = 40.0,
    mooring: Table | None = None,
    step: float = 0.1,
    start: Vector = ORIGIN,
    **more: Any,
) -> Table:
    """Return a ball with a Morison element, on a spring if `mooring` has its keys."""
    at = [0.0, 0.0, -depth]
    spring = dict(name="k", type="mooring_matrix", body="ball") | (mooring or {})
    ball = body("ball", motion, 50.0, at, displacement=start)
    tables = case([ball], end, samples=round(end / step), forces=[spring] if mooring else [])
    water = dict(name="water", body="ball", point=at) | elements
    return tables | {"environment": {"water_density": RHO}, "morison": [water]} | more


def test_fall_to_terminal_velocity() -> None:
    """(m + rho V Ca) v' = m g - 1/2 rho Cd A v^2 from rest."""
    diameter = 0.3
    element = dict(diameter=diameter, drag_coefficient=0.9, added_mass_coefficient=0.5)
    results = run_tables(point_mass(element, 4.0), rtol=1e-8)
    drag = 0.5 * RHO * 0.9 * np.pi / 4 * diameter**2
    inertia = 50.0 + 0.5 * RHO * np.pi / 6 * diameter**3
    terminal = np.sqrt(50.0 * GRAVITY / drag)
    exact = terminal * np.tanh(results.time * np.sqrt(50.0 * GRAVITY * drag) / inertia)
    fall = -results["bodies/ball/velocity"].values[:, 2]
    assert fall[-1] == pytest.approx(terminal, rel=1e-3)
    np.testing.assert_allclose(fall, exact, atol=1e-6 * terminal)
    assert results.statistics["relative_balance_error"] < 1e-6


@pytest.mark.parametrize("coefficient", [0.0, 0.5, 1.0])
def test_added_mass_lengthens_the_period(coefficient: float) -> None:
    volume, stiffness = 0.04, 700.0
    spring = {"stiffness": [stiffness, 0, 0, 0, 0, 0]}
    element = dict(volume=volume, added_mass_coefficient=coefficient)
    start = [0.2, 0.0, 0.0]
    tables = point_mass(element, 10.0, motion="surge", mooring=spring, start=start)
    results = run_tables(tables, rtol=1e-8)
    omega = np.sqrt(stiffness / (50.0 + RHO * volume * coefficient))
    x = results["bodies/ball/position"].values[:, 0]
    np.testing.assert_allclose(x, 0.2 * np.cos(omega * results.time), atol=1e-6)


def test_drag_decay_follows_the_energy_balance() -> None:
    """a' = -4/(3 pi) (c/m) w a^2: the work of c |x'| x' over a cycle, 8/3 c w^2 a^3."""
    stiffness, area = 700.0, 0.004
    spring = {"stiffness": [stiffness, 0, 0, 0, 0, 0]}
    element, start = dict(area=area, drag_coefficient=1.0), [1.0, 0.0, 0.0]
    tables = point_mass(element, 60.0, motion="surge", mooring=spring, start=start, step=0.01)
    results = run_tables(tables, rtol=1e-8)
    omega, drag = np.sqrt(stiffness / 50.0), 0.5 * RHO * area
    x = results["bodies/ball/position"].values[:, 0]
    v = results["bodies/ball/velocity"].values[:, 0]
    amplitude = np.sqrt(x**2 + (v / omega) ** 2)
    exact = 1.0 / (1.0 + 4.0 / (3.0 * np.pi) * drag / 50.0 * omega * results.time)
    assert exact[-1] < 0.25
    # The amplitude goes down in steps of half a cycle: compared as means over whole cycles.
    n = round(2 * np.pi / omega / 0.01)
    mean = np.convolve(amplitude / exact, np.ones(n) / n, "valid")
    np.testing.assert_allclose(mean, 1.0, atol=2e-3)
    work = results["energy/work/water"].values
    lost = 0.5 * 50.0 * omega**2 * (amplitude**2 - 1.0)
    np.testing.assert_allclose(work, lost, atol=1e-5 * abs(lost[-1]))


def pile(end: float, step: float, bottom: float = -20.0, **more: Any) -> Table:
    """Return a fixed pile from `bottom` [m] to 4 m above the water, beside a body that moves."""
    bodies = [body("pile", "fixed", 1.0, [3.0, 1.0, -5.0]), body("elsewhere", "surge", 1.0)]
    keys = dict(name="water", body="pile", diameter=0.8, segments=480)
    member = dict(point_a=[3.0, 1.0, bottom], point_b=[3.0, 1.0, 4.0])
    element = {**keys, **member, **more.pop("element")}
    more = {"environment": {"water_density": RHO}, "morison": [element]} | more
    return case(bodies, end, samples=round(end / step), **more)


@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_pile_in_a_regular_wave(depth: float) -> None:
    """Drag and inertia integrated from the bed (or far below the waves) to the mean surface."""
    a, omega = 1.0, 2 * np.pi / 7.0
    k = float(wavenumber(omega, depth, GRAVITY))
    bottom = -20.0 if np.isfinite(depth) else -160.0
    element = dict(drag_coefficient=1.2, added_mass_coefficient=0.9)
    tables = pile(14.0, 0.1, bottom, element=element, wave=[WAVE])
    if np.isfinite(depth):
        tables["environment"]["water_depth"] = depth
    results = run_tables(tables, rtol=1e-8)
    if np.isfinite(depth):
        single = 1 / k
        square = (np.sinh(2 * k * depth) + 2 * k * depth) / (4 * k * np.sinh(k * depth) ** 2)
    else:
        single, square = 1 / k, 1 / (2 * k)
    drag = 0.5 * RHO * 1.2 * 0.8 * (a * omega) ** 2 * square
    inertia = RHO * np.pi / 4 * 0.8**2 * 1.9 * a * omega**2 * single
    angle = omega * results.time - 3.0 * k
    exact = drag * np.cos(angle) * abs(np.cos(angle)) - inertia * np.sin(angle)
    force = results["forces/water/pile/force"].values
    np.testing.assert_allclose(force[:, 0], exact, atol=2e-4 * (drag + inertia))
    np.testing.assert_allclose(force[:, 1:], 0.0, atol=1e-9 * inertia)
    held = results["bodies/pile/support_force"].values
    np.testing.assert_allclose(held[:, 0], -force[:, 0], atol=1e-9 * inertia)
    eta = results["sea/elevation"].values
    np.testing.assert_allclose(eta, a * np.cos(omega * results.time), atol=1e-12)


def test_instantaneous_surface_reaches_the_crest() -> None:
    """Above z = 0 the water moves as at z = 0: the crest adds 1/2 rho Cd D u0^2 eta."""
    forces = {}
    for surface in ("mean", "instantaneous"):
        element = dict(drag_coefficient=1.2, surface=surface)
        results = run_tables(pile(14.0, 0.05, element=element, wave=[WAVE]), rtol=1e-8)
        forces[surface] = results["forces/water/pile/force"].values[:, 0]
    omega = 2 * np.pi / 7.0
    k = omega**2 / GRAVITY
    angle = omega * results.time - 3.0 * k
    eta, u = np.cos(angle), omega * np.cos(angle)
    crest = eta > 0.0
    extra = 0.5 * RHO * 1.2 * 0.8 * u * abs(u) * eta
    more = forces["instantaneous"] - forces["mean"]
    np.testing.assert_allclose(more[crest], extra[crest], atol=3e-3 * extra.max())


def test_current_on_an_inclined_member() -> None:
    """Across the axis 1/2 rho Cd D L |u_n| u_n, along it the skin 1/2 rho Cdt pi D L |u_t| u_t."""
    element = dict(drag_coefficient=1.1, drag_axial=0.02, point_b=[9.0, 1.0, -8.0])
    sea = {"current": [0.6, 0.3, 0.0]}
    results = run_tables(pile(1.0, 0.1, element=element, sea=sea), rtol=1e-8)
    axis = np.array([6.0, 0.0, 12.0])
    length = np.linalg.norm(axis)
    axis /= length
    u = np.array([0.6, 0.3, 0.0])
    along = u @ axis
    across = u - along * axis
    expected = (
        0.5
        * RHO
        * 0.8
        * length
        * (1.1 * np.linalg.norm(across) * across + 0.02 * np.pi * abs(along) * along * axis)
    )
    np.testing.assert_allclose(results["forces/water/pile/force"][-1], expected, rtol=1e-12)
    arm = np.array([6.0, 1.0, -14.0]) - [3.0, 1.0, -5.0]  # of the middle
    np.testing.assert_allclose(
        results["forces/water/pile/moment"][-1], np.cross(arm, expected), rtol=1e-12
    )


def test_linear_model_has_added_mass_and_wave_inertia() -> None:
    """A free ball under deep waves: x = e^{kz} rho V (1 + Ca) / (m + rho V Ca) per metre."""
    element = dict(volume=0.04, added_mass_coefficient=0.7, drag_coefficient=1.0, area=0.1)
    model = LinearModel(case_of(point_mass(element, 1.0, motion="surge", depth=4.0)))
    assert any("quadratic drag" in note and "water" in note for note in model.notes)
    omega = np.array([0.5, 1.0, 2.0])
    heading = 0.4
    response = model.response(omega, heading)
    k = omega**2 / GRAVITY
    exact = np.exp(-4.0 * k) * 40.0 * 1.7 / (50.0 + 28.0)
    # u = a w e^{kz} cos th: the displacement is sin th, that is -i.
    np.testing.assert_allclose(
        response["bodies/ball/surge"], -1j * exact * np.cos(heading), rtol=1e-12
    )


@pytest.mark.parametrize("depth", [9.0, np.inf])
def test_time_domain_agrees_with_the_linear_model(depth: float) -> None:
    """A tethered ball in small waves, inertia only."""
    spring = dict(
        stiffness=[60, 0, 60, 0, 0, 0],
        damping=[40, 0, 40, 0, 0, 0],
        pretension=[0, 0, 490.5, 0, 0, 0],
    )
    element = dict(volume=0.04, added_mass_coefficient=0.7)
    plane = ["surge", "heave"]
    tables = point_mass(element, 250.0, motion=plane, depth=4.0, mooring=spring)
    if np.isfinite(depth):
        tables["environment"]["water_depth"] = depth
    wave = {"wave": [WAVE | {"height": 0.002}], "sea": {"ramp": 50.0}}
    results = run_tables(tables | wave, rtol=1e-8)
    omega = 2 * np.pi / 7.0
    linear = LinearModel(case_of(tables)).response([omega])
    n = 700  # ten periods
    carrier = 2 / n * np.exp(-1j * omega * results.time[-n:])
    for k, name in ((0, "surge"), (2, "heave")):
        x = results["bodies/ball/position"].values[-n:, k]
        found = ((x - x.mean()) * carrier).sum() / 0.001
        assert found == pytest.approx(linear[f"bodies/ball/{name}"][0], rel=2e-3)


INERTIA = dict(volume=0.04, added_mass_coefficient=0.5)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"volume": None}, "a point element with inertia needs 'diameter' or 'volume'"),
        ({"segments": 3}, "a point element has no 'segments'"),
        ({"body": "bal"}, "did you mean 'ball'"),
        ({"water_density": None}, "need the density of the water"),
        ({"added_mass_coefficient": None}, "neither drag nor inertia"),
        ({"surface": "men"}, "did you mean 'mean'"),
    ],
)
def test_mistakes(change: Table, message: str) -> None:
    tables = point_mass(INERTIA, 1.0)
    where = tables["environment"] if "water_density" in change else tables["morison"][0]
    where |= change
    for key in [key for key, value in where.items() if value is None]:
        del where[key]
    with pytest.raises(CaseError, match=r"<case>|\d+:\d+") as error:
        case_of(tables)
    assert message in str(error.value)


def test_check_tells_the_cost() -> None:
    examined = case_of(point_mass(INERTIA, 1.0, wave=[WAVE])).examine()
    assert "1 wave components at 1 points that move" in examined
