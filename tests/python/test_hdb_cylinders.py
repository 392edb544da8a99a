"""Arrays of cylinders by interaction theory: closed forms, energy, a boundary-element run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy import special
from tests.errors import refused

from hydrodae import hdb
from hydrodae.commands.cli import main
from hydrodae.hdb.interaction.array import solve
from hydrodae.hdb.interaction.radial import translation
from hydrodae.hdb.interaction.vertical import outside
from hydrodae.hdb.relations.dispersion import wavenumber

RHO, GRAVITY = 1025.0, 9.81
MORE = np.array([0.0, 0.1, 0.2, 0.3])  # rad/s, beside the frequency that is looked at
NODE = hdb.Cylinder(radius=0.3, draft=0.6, point=-0.3)
FOUR = {"S3": (0.0, 0.0), "C1": (0.7, -1.21), "S1": (0.0, -2.42), "S2": (2.1, -1.21)}


@pytest.mark.parametrize("omega", [1.0, 9.0, np.inf])
def test_eigenfunctions_are_orthogonal(omega: float) -> None:
    modes = outside(omega, 5.0, GRAVITY, 8)
    x, w = np.polynomial.legendre.leggauss(80)
    values = np.array([modes.at(2.5 * (s + 1.0)) for s in x])
    assert np.einsum("s,si,sj->ij", 0.5 * w, values, values) == pytest.approx(np.eye(8), abs=1e-12)


@pytest.mark.parametrize("mode", [0, 3])
def test_outgoing_wave_is_incident_wave_elsewhere(mode: int) -> None:
    """Graf's addition theorem, summed at a point beside the other body."""
    a, orders, order = 0.3, 14, 2
    modes = outside(4.0, 5.0, GRAVITY, 5)
    from_, to = np.array([0.0, 0.0]), np.array([1.1, -0.7])
    point = to + np.array([0.2, 0.1])
    dx, dy = to - from_
    r, angle = np.hypot(*point), np.arctan2(point[1], point[0])
    k = modes.numbers[mode]
    radial = special.hankel2 if mode == 0 else special.kv
    sent = radial(order, k * r) / radial(order, k * a) * np.exp(1j * order * angle)
    table = translation(modes, a, float(np.hypot(dx, dy)), orders)[:, orders + order, mode]
    n = np.arange(-orders, orders + 1)
    r, angle = np.hypot(0.2, 0.1), np.arctan2(0.1, 0.2)
    if mode == 0:
        there = special.jv(abs(n), k * r) * abs(special.hankel2(abs(n), k * a))
    else:
        there = special.iv(abs(n), k * r) / special.iv(abs(n), k * a)
    turn = np.exp(1j * (order - n) * np.arctan2(dy, dx) + 1j * n * angle)
    assert (table * turn * there).sum() == pytest.approx(sent, rel=1e-7)


@pytest.mark.parametrize("omega", [2.0, 5.0])
def test_nearly_bottom_mounted_cylinder_is_that_of_maccamy_and_fuchs(omega: float) -> None:
    a, h = 0.5, 2.0
    k = float(wavenumber(omega, h, GRAVITY))
    exact = 4.0 * RHO * GRAVITY * np.tanh(k * h) / (k**2 * abs(special.h1vp(1, k * a)))
    body = hdb.Cylinder(a, 1.995, -1.0)
    database, _ = hdb.cylinders({"a": (0, 0)}, body, hdb.Water(omega + MORE, h), modes=100)
    assert abs(database.excitation[0, 0, 0]) == pytest.approx(exact, rel=5e-3)


def test_damping_of_an_array_is_the_energy_of_its_waves() -> None:
    """B_ij = k / (8 pi rho g c_g) int F_i F_j* dbeta, which joins radiation with diffraction."""
    omega, h, count = 3.6, 3.0, 48
    beta = 2.0 * np.pi * np.arange(count) / count
    places = {"a": (0.0, 0.0), "b": (0.9, 0.3), "c": (-0.2, 1.0)}
    database, _ = hdb.cylinders(
        places, NODE, hdb.Water(omega + MORE, h, beta, RHO, GRAVITY), modes=60, orders=6
    )
    k = float(wavenumber(omega, h, GRAVITY))
    group = 0.5 * omega / k * (1.0 + 2.0 * k * h / np.sinh(2.0 * k * h))
    assert database.heading.size == count + 1  # the first again closes the circle
    force = database.excitation[0, :count]
    energy = k / (8.0 * np.pi * RHO * GRAVITY * group) * 2.0 * np.pi / count
    damping = energy * np.einsum("hi,hj->ij", force, force.conj())
    scale = np.sqrt(np.diag(database.radiation_damping[0]))
    scale[5::6] = 1.0
    error = (damping - database.radiation_damping[0]) / np.outer(scale, scale)
    assert np.abs(error).max() < 1e-6


def test_one_body_is_alone_and_far_bodies_are_too() -> None:
    water = hdb.Water(3.0 + MORE, 3.0)
    one, _ = hdb.cylinders({"a": (0, 0)}, NODE, water, modes=60)
    two, _ = hdb.cylinders({"a": (0, 0), "b": (0, 4000.0)}, NODE, water, modes=60)
    assert two.added_mass[0, :6, :6] == pytest.approx(one.added_mass[0], rel=1e-3, abs=1e-3)


#: Entries of A and B at 3 rad/s by Capytaine 3 in deep water, those of panels of 0.05 and 0.08 m
#: extrapolated to no size: bodies and motions, A, B.
BEM = [
    (("S3.surge", "S3.surge"), 153.0323, 36.0122),
    (("S3.heave", "S3.heave"), 51.8819, 26.5765),
    (("S3.roll", "S3.roll"), 2.4751, 0.0993),
    (("S3.surge", "C1.surge"), 3.8192, 24.8054),
    (("S3.surge", "C1.sway"), 13.0741, 8.2989),
    (("S3.heave", "C1.heave"), -1.5294, 18.5815),
    (("S3.heave", "S2.sway"), 0.0305, -11.9877),
]


@pytest.mark.parametrize(("entry", "mass", "damping"), BEM)
def test_four_nodes_against_a_boundary_element_run(
    four: hdb.HydroDatabase, entry: tuple[str, str], mass: float, damping: float
) -> None:
    i, j = four.index(entry)
    size = np.sqrt(four.added_mass[0, i, i] * four.added_mass[0, j, j])
    assert four.added_mass[0, i, j] == pytest.approx(mass, abs=0.01 * size)
    size = np.sqrt(four.radiation_damping[0, i, i] * four.radiation_damping[0, j, j])
    assert four.radiation_damping[0, i, j] == pytest.approx(damping, abs=0.01 * size)


@pytest.fixture(scope="module")
def four() -> hdb.HydroDatabase:
    """Four nodes in deep water."""
    return hdb.cylinders(FOUR, NODE, hdb.Water(3.0 + MORE, 10.0), modes=300)[0]


def test_report_states_the_truncation() -> None:
    water = hdb.Water(3.0 + MORE, 3.0)
    coarse, report = hdb.cylinders(FOUR, NODE, water, modes=40, orders=3)
    found = next(f for f in report if f.check == "truncation")
    finer, _ = hdb.cylinders(FOUR, NODE, water, modes=240, orders=4)
    scale = np.sqrt(np.diag(finer.added_mass[2]))
    scale[5::6] = np.inf
    error = np.abs(coarse.added_mass[2] - finer.added_mass[2]) / np.outer(scale, scale)
    assert 0.3 * error.max() < found.value < 3.0 * error.max()


def test_turned_array_has_turned_loads() -> None:
    """The layout in other axes: no direction is special."""
    turn = np.radians(33.0)
    c, s = np.cos(turn), np.sin(turn)
    turned = {name: (c * x - s * y, s * x + c * y) for name, (x, y) in FOUR.items()}
    water = hdb.Water(3.0 + MORE, 3.0, np.array([0.4]))
    other = hdb.Water(3.0 + MORE, 3.0, np.array([0.4 + turn]))
    here, _ = hdb.cylinders(FOUR, NODE, water, modes=40)
    there, _ = hdb.cylinders(turned, NODE, other, modes=40)
    axes = np.kron(np.eye(8), np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]))
    assert axes @ there.added_mass[0] @ axes.T == pytest.approx(here.added_mass[0], abs=1e-9)
    assert axes @ there.excitation[0, 0] == pytest.approx(here.excitation[0, 0], abs=1e-7)


@pytest.mark.parametrize(
    ("places", "body", "depth", "reason", "subject"),
    [
        ({"a": (0, 0), "b": (0.5, 0)}, NODE, 3.0, "geometry", "b"),
        ({"a": (0, 0)}, NODE, np.inf, "value", "depth"),
        ({"a": (0, 0)}, NODE, 0.5, "geometry", "cylinder"),
        ({}, NODE, 3.0, "option", "places"),
        ({"a": (0, 0, 0)}, NODE, 3.0, "shape", "a"),
    ],
)
def test_impossible_arrays_are_refused(
    places: dict[str, tuple[float, ...]],
    body: hdb.Cylinder,
    depth: float,
    reason: str,
    subject: str,
) -> None:
    with refused(reason, subject):
        hdb.cylinders(places, body, hdb.Water(3.0 + MORE, depth))


def test_command_writes_a_database(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "hydro.h5"
    words = "hdb array --radius 0.3 --draft 0.6 --depth 3 --modes 40 --omega 1,6,6".split()
    places = ["--at", "a=0,0", "--at", "b=1.4,0"]
    assert main([*words, *places, "-o", str(file)]) == 0
    assert "truncation" in capsys.readouterr().out
    database = hdb.HydroDatabase.read(file)
    assert list(database.bodies) == ["a", "b"]
    assert database.reference_point("b") == pytest.approx([1.4, 0.0, -0.3])
    assert database.omega.size == 6
    assert main([*words, "--at", "a=0", "-o", str(file)]) == 2
    assert "expected 2 numbers" in capsys.readouterr().err


def test_frequency_of_infinity_has_no_waves() -> None:
    found = solve(NODE, np.zeros((1, 2)), outside(np.inf, 3.0, GRAVITY, 60), 1, [])
    high = solve(NODE, np.zeros((1, 2)), outside(60.0, 3.0, GRAVITY, 60), 1, [])
    assert found.radiation.imag == pytest.approx(0.0, abs=1e-12)
    assert high.radiation[2, 2].real == pytest.approx(found.radiation[2, 2].real, rel=5e-3)
