"""Loads of pairs of waves in runs, by tables of the database."""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.python.test_hdb_second_order import floating, read
from tests.scenes import toml

import hydrodae
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array, Complex

#: (frequency [rad/s], amplitude [m], phase [rad])
WAVES = [(0.8, 1.0, 0.3), (0.85, 0.8, 1.7), (0.95, 0.6, -2.0), (1.1, 0.5, 0.9)]
OMEGA = np.array([0.6, 0.8, 0.85, 0.95, 1.1, 1.4])
TURN = np.array([[1.0, -1.0], [1.0, 1.0]]) / np.sqrt(2.0)  # by 45 degrees


def made_up() -> SecondOrderTable:
    """Differences of surge, heave and pitch: Hermitian, the drift along the waves."""
    draw = np.random.default_rng(3)
    raw = draw.normal(size=(6, 6, 1, 3)) + 1j * draw.normal(size=(6, 6, 1, 3))
    values: Complex = np.asarray(1e3 * (raw + raw.swapaxes(0, 1).conj()), dtype=complex)
    i = np.arange(6)
    values[i, i] = 1e3 * (2.0 + np.abs(values[i, i].real) / 1e3)
    labels = ("float.surge", "float.heave", "float.pitch")
    zero, all_of = np.zeros(1), np.ones(values.shape, bool)
    return SecondOrderTable(
        "difference", labels, ("pressure",) * 3, OMEGA, zero, zero, values, all_of
    )


def made_sums() -> SecondOrderTable:
    table = made_up()
    values = table.values + table.values.swapaxes(0, 1)
    return replace(table, kind="sum", values=values)


def write(folder: Path, *tables: SecondOrderTable, owner: HydroDatabase | None = None) -> Path:
    database = floating() if owner is None else owner
    database.with_second_order({t.kind: t for t in tables}).write(folder / "hydro.h5")
    return folder


def case(
    folder: Path,
    loads: Sequence[str] = ("difference",),
    *,
    waves: Sequence[tuple[float, float, float]] = WAVES,
    heading: float = 0.0,
    more: str = "",
    body: str = "",
    sea: str = "",
    motion: str = "surge",
    at: Sequence[float] = (0.0, 0.0, 0.0),
    end: float = 100.0,
    step: float = 2.5,
    hydro: str = "",
    hull: str = 'hydro = "float"',
) -> hydrodae.Case:
    w, a, phase = (list(column) for column in zip(*waves, strict=True))
    return hydrodae.Case.from_text(
        f"""
[hydro]
database = "hydro.h5"
radiation = "none"
{hydro}
[second_order]
loads = {toml(list(loads))}
{more}
{sea}
[[body]]
name = "float"
motion = "{motion}"
mass = 1e12
inertia = [1e12, 1e12, 1e12]
center_of_gravity = {toml([float(x) for x in at])}
{hull}
{body}
[[wave]]
name = "pairs"
type = "components"
heading_deg = {heading!r}
omega = {toml(w)}
amplitude = {toml(a)}
phase = {toml(phase)}
[solver]
end_time = {end!r}
[output]
step = {step!r}
""",
        directory=folder,
    )


def load(results: hydrodae.Results, what: str = "force") -> Array:
    return np.asarray(results[f"forces/second_order/float/{what}"].values)


def pairs(t: Array, table: SecondOrderTable, column: int, waves: Any = WAVES) -> Array:
    """Return the sum over all ordered pairs, as the docstring of the tables has it."""
    at = [int(np.abs(table.omega - w).argmin()) for w, _, _ in waves]
    total = np.zeros(len(t))
    sign = -1.0 if table.of.hermitian else 1.0
    for i, (wi, ai, pi) in zip(at, waves, strict=True):
        for j, (wj, aj, pj) in zip(at, waves, strict=True):
            angle = (wi + sign * wj) * t + pi + sign * pj
            total += (ai * aj * table.values[i, j, 0, column] * np.exp(1j * angle)).real
    return total


Pick = Callable[[Array], Array]


@pytest.mark.parametrize(("terms", "allowed"), [("few", 1e-3), ("all", 1e-9)])
@pytest.mark.parametrize(("word", "column"), [("difference", 1), ("newman", 2)])
def test_slow_force_of_four_waves(
    word: str, column: int, terms: str, allowed: float, reference: Path, tmp_path: Path
) -> None:
    """The semisubmersible OC4 by WAMIT's table against a program of its own."""
    folder = reference / "second_order"
    owner = floating()
    tables = read(owner, folder / "qtf_oc4_wamit" / "marin_semi.12d")
    write(tmp_path, *tables.values(), owner=owner)
    with (folder / "own_values" / "slow_force.csv").open() as file:
        own = np.array([[float(x) for x in row] for row in list(csv.reader(file))[1:]])
    made = case(tmp_path, [word], more=f'terms = "{terms}"', end=300.0)
    found = load(hydrodae.run(made))[:, 0]
    np.testing.assert_allclose(found, own[:, column], rtol=0.0, atol=allowed * own[:, column].std())


@pytest.mark.parametrize("both", [False, True])
def test_sums_and_moments(both: bool, tmp_path: Path) -> None:
    """Each load of the case alone and beside another."""
    write(tmp_path, made_up(), made_sums())
    words = ["difference", "sum"] if both else ["sum"]
    results = hydrodae.run(case(tmp_path, words, more='terms = "all"', motion="planar"))
    t = np.asarray(results.time)
    tables = [made_up(), made_sums()] if both else [made_sums()]
    for what, axis, column in (("force", 0, 0), ("force", 2, 1), ("moment", 1, 2)):
        exact = sum(pairs(t, table, column) for table in tables)
        found = load(results, what)[:, axis]
        np.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-9 * np.abs(exact).max())


def test_a_table_of_single_waves(tmp_path: Path) -> None:
    """The mean drift of each wave, and Newman's slow drift by it as by the diagonal of pairs."""
    whole = made_up()
    i = np.arange(OMEGA.size)
    diagonal = replace(whole, kind="mean", values=whole.values[i, i], computed=whole.computed[i, i])
    (tmp_path / "pairs").mkdir()
    write(tmp_path / "pairs", whole)
    write(tmp_path, diagonal)
    mean = load(hydrodae.run(case(tmp_path, ["mean"])))[:, 0]
    at = [int(np.abs(OMEGA - w).argmin()) for w, _, _ in WAVES]
    drift = sum(
        a**2 * diagonal.values[k, 0, 0].real for k, (_, a, _) in zip(at, WAVES, strict=True)
    )
    np.testing.assert_allclose(mean, drift, rtol=1e-9)
    runs = [hydrodae.run(case(f, ["newman"])) for f in (tmp_path, tmp_path / "pairs")]
    np.testing.assert_allclose(load(runs[0]), load(runs[1]), rtol=1e-9, atol=1e-6)


def test_few_products_of_a_sea(tmp_path: Path) -> None:
    """The default stays within 1e-3 of the rms of all terms, from far fewer pairs."""
    write(tmp_path, made_up())
    draw = np.random.default_rng(5)
    waves = [(float(w), 0.2, float(p)) for w, p in draw.uniform([0.6, 0], [1.4, 6.28], (40, 2))]
    runs = {
        terms: load(hydrodae.run(case(tmp_path, waves=waves, more=f'terms = "{terms}"')))[:, 0]
        for terms in ("few", "all")
    }
    rms = runs["all"].std()
    assert 0.0 < np.sqrt(np.mean((runs["few"] - runs["all"]) ** 2)) < 1e-3 * rms


def test_turned_with_the_waves_and_moved(tmp_path: Path) -> None:
    """Waves and device turned by 45 degrees: so is the load. Moved: phases by k x alone."""
    write(tmp_path, made_up())
    straight = load(hydrodae.run(case(tmp_path)))
    turned = case(tmp_path, heading=45.0, body="initial.rotation_deg = [0.0, 0.0, 45.0]")
    np.testing.assert_allclose(
        load(hydrodae.run(turned))[:, :2], straight[:, :2] @ TURN.T, atol=1e-6 * 1e4
    )
    k = [float(wavenumber(w, np.inf, 9.81)) for w, _, _ in WAVES]
    ahead = [(w, a, p + 12.0 * n) for (w, a, p), n in zip(WAVES, k, strict=True)]
    there = "initial.displacement = [12.0, 0.0, 0.0]"
    for sea in ("", '[sea]\nphase = "moving"'):
        moved = load(hydrodae.run(case(tmp_path, waves=ahead, body=there, sea=sea)))
        np.testing.assert_allclose(moved, straight, atol=1e-3 * straight.std())


def test_a_moored_float_is_offset_and_sways(tmp_path: Path) -> None:
    """Offset F a^2 / K of one wave; at the difference of two the closed form."""
    write(tmp_path, made_up())
    k, c, m = 4e3, 2e4, 1e5
    spring = f"""
[[joint]]
name = "rail"
type = "prismatic"
body_a = "ground"
body_b = "float"
point = [0.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
[[force]]
name = "mooring"
type = "pto_linear"
joint = "rail"
stiffness = {k}
damping = {c}
"""
    table, dw, end = made_up(), 0.05, 400.0
    one = case(tmp_path, waves=WAVES[:1], body=spring, end=end).with_values({"body.float.mass": m})
    x = hydrodae.run(one)["bodies/float/position"].values[-1, 0]
    assert x == pytest.approx(table.values[1, 1, 0, 0].real / k, rel=5e-3)
    two = case(tmp_path, waves=WAVES[:2], body=spring, end=end).with_values({"body.float.mass": m})
    results = hydrodae.run(two)
    t, x = np.asarray(results.time), results["bodies/float/position"].values[:, 0]
    late = t > end - 2.0 * np.pi / dw - 1e-9
    (_, a1, p1), (_, a2, p2) = WAVES[:2]
    force = 2.0 * a1 * a2 * table.values[2, 1, 0, 0] * np.exp(1j * (p2 - p1))
    answer = force / (k - dw**2 * (m + 300.0) + 1j * dw * c)
    basis = np.column_stack([np.ones(late.sum()), np.cos(dw * t[late]), -np.sin(dw * t[late])])
    _, real, imaginary = np.linalg.lstsq(basis, x[late], rcond=None)[0]
    found = real + 1j * imaginary
    assert abs(found) == pytest.approx(abs(answer), rel=5e-3)
    assert abs(np.angle(found / answer, deg=True)) < 1.0
    work = results["energy/work/second_order"].values
    assert abs(results["energy/balance_error"].values).max() < 1e-3 * abs(work).max()
