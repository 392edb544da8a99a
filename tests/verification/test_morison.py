"""Morison elements and the motion of the water against closed forms."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.linear import LinearModel

RHO, GRAVITY = 1000.0, 9.81


def point_mass(elements: str, more: str = "", motion: str = "heave", start: str = "") -> str:
    return f"""
[environment]
water_density = {RHO}

[[body]]
name = "ball"
motion = "{motion}"
mass = 50.0
center_of_gravity = [0.0, 0.0, -40.0]
{start}

[[morison]]
name = "water"
body = "ball"
point = [0.0, 0.0, -40.0]
{elements}

{more}
"""


def mooring(*lines: str) -> str:
    head = ("[[force]]", 'name = "k"', 'type = "mooring_matrix"', 'body = "ball"')
    return "\n".join((*head, *lines, ""))


def solver(end: float, step: float = 0.1) -> str:
    return f"[solver]\nend_time = {end}\nrtol = 1e-8\n[output]\nstep = {step}\n"


def run(text: str) -> hydrodae.Results:
    return hydrodae.run(hydrodae.Case.from_text(text))


def test_fall_to_terminal_velocity() -> None:
    """(m + rho V Ca) v' = m g - 1/2 rho Cd A v^2 from rest."""
    diameter = 0.3
    results = run(
        point_mass(
            f"diameter = {diameter}\ndrag_coefficient = 0.9\nadded_mass_coefficient = 0.5",
            solver(4.0),
        )
    )
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
    spring = mooring(f"stiffness = [{stiffness}, 0, 0, 0, 0, 0]")
    results = run(
        point_mass(
            f"volume = {volume}\nadded_mass_coefficient = {coefficient}",
            spring + solver(10.0),
            "surge",
            "initial.displacement = [0.2, 0.0, 0.0]",
        )
    )
    omega = np.sqrt(stiffness / (50.0 + RHO * volume * coefficient))
    x = results["bodies/ball/position"].values[:, 0]
    np.testing.assert_allclose(x, 0.2 * np.cos(omega * results.time), atol=1e-6)


def test_drag_decay_follows_the_energy_balance() -> None:
    """a' = -4/(3 pi) (c/m) w a^2: the work of c |x'| x' over a cycle, 8/3 c w^2 a^3."""
    stiffness, area = 700.0, 0.004
    spring = mooring(f"stiffness = [{stiffness}, 0, 0, 0, 0, 0]")
    results = run(
        point_mass(
            f"area = {area}\ndrag_coefficient = 1.0",
            spring + solver(60.0, 0.01),
            "surge",
            "initial.displacement = [1.0, 0.0, 0.0]",
        )
    )
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


PILE = """
[environment]
water_density = 1000.0
{depth}

[sea]
{sea}

{wave}

[[body]]
name = "pile"
motion = "fixed"
mass = 1.0
center_of_gravity = [3.0, 1.0, -5.0]

[[body]]
name = "elsewhere"
motion = "surge"
mass = 1.0
center_of_gravity = [0.0, 0.0, 0.0]

[[morison]]
name = "water"
body = "pile"
point_a = [3.0, 1.0, {bottom}]
point_b = [3.0, 1.0, 4.0]
diameter = 0.8
segments = 480
surface = "{surface}"
{elements}
"""
WAVE = """
[[wave]]
name = "swell"
type = "regular"
height = 2.0
period = 7.0
heading_deg = 0.0
"""


@pytest.mark.parametrize("depth", [20.0, np.inf])
def test_pile_in_a_regular_wave(depth: float) -> None:
    """Drag and inertia integrated from the bed (or far below the waves) to the mean surface."""
    a, omega = 1.0, 2 * np.pi / 7.0
    k = float(wavenumber(omega, depth, GRAVITY))
    bottom = -20.0 if np.isfinite(depth) else -160.0
    text = PILE.format(
        depth=f"water_depth = {depth}" if np.isfinite(depth) else "",
        sea="",
        wave=WAVE,
        bottom=bottom,
        surface="mean",
        elements="drag_coefficient = 1.2\nadded_mass_coefficient = 0.9",
    )
    results = run(text + solver(14.0))
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
        text = PILE.format(
            depth="",
            sea="",
            wave=WAVE,
            bottom=-20.0,
            surface=surface,
            elements="drag_coefficient = 1.2",
        )
        results = run(text + solver(14.0, 0.05))
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
    text = PILE.format(
        depth="",
        sea="current = [0.6, 0.3, 0.0]",
        wave="",
        bottom=-20.0,
        surface="mean",
        elements="drag_coefficient = 1.1\ndrag_axial = 0.02",
    ).replace("point_b = [3.0, 1.0, 4.0]", "point_b = [9.0, 1.0, -8.0]")
    results = run(text + solver(1.0))
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
    text = point_mass(
        "volume = 0.04\nadded_mass_coefficient = 0.7\ndrag_coefficient = 1.0\narea = 0.1",
        solver(1.0),
        "surge",
    ).replace("-40.0", "-4.0")
    model = LinearModel(hydrodae.Case.from_text(text))
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
    spring = mooring(
        "stiffness = [60, 0, 60, 0, 0, 0]",
        "damping = [40, 0, 40, 0, 0, 0]",
        "pretension = [0, 0, 490.5, 0, 0, 0]",
    )
    text = point_mass(
        "volume = 0.04\nadded_mass_coefficient = 0.7", spring + solver(250.0), "planar"
    ).replace("-40.0", "-4.0")
    text = text.replace('motion = "planar"', 'motion = ["surge", "heave"]')
    if np.isfinite(depth):
        text = text.replace("[environment]", f"[environment]\nwater_depth = {depth}")
    wave = WAVE.replace("height = 2.0", "height = 0.002")
    results = run(text + wave + "[sea]\nramp = 50.0\n")
    omega = 2 * np.pi / 7.0
    linear = LinearModel(hydrodae.Case.from_text(text)).response([omega])
    n = 700  # ten periods
    carrier = 2 / n * np.exp(-1j * omega * results.time[-n:])
    for k, name in ((0, "surge"), (2, "heave")):
        x = results["bodies/ball/position"].values[-n:, k]
        found = ((x - x.mean()) * carrier).sum() / 0.001
        assert found == pytest.approx(linear[f"bodies/ball/{name}"][0], rel=2e-3)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("volume = 0.04", "", "a point element with inertia needs 'diameter' or 'volume'"),
        ("volume = 0.04", "volume = 0.04\nsegments = 3", "a point element has no 'segments'"),
        ('body = "ball"', 'body = "bal"', "did you mean 'ball'"),
        ("water_density = 1000.0", "", "need the density of the water"),
        ("added_mass_coefficient = 0.5", "", "neither drag nor inertia"),
        ("volume = 0.04", "volume = 0.04\nsurface = 'men'", "did you mean 'mean'"),
    ],
)
def test_mistakes(old: str, new: str, message: str) -> None:
    text = point_mass("volume = 0.04\nadded_mass_coefficient = 0.5", solver(1.0))
    assert text.count(old) == 1
    with pytest.raises(CaseError, match=r"<case>|\d+:\d+") as error:
        hydrodae.Case.from_text(text.replace(old, new))
    assert message in str(error.value)


def test_check_tells_the_cost(tmp_path: Path) -> None:
    text = point_mass("volume = 0.04\nadded_mass_coefficient = 0.5", WAVE + solver(1.0))
    assert "1 wave components at 1 points that move" in hydrodae.Case.from_text(text).examine()
