"""Loads of second order: what a run refuses, and what it or `hydrodae check` warns of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.python.test_hdb_second_order import floating
from tests.verification.test_second_order_loads import (
    OMEGA,
    WAVES,
    case,
    load,
    made_up,
    pairs,
    write,
)  # fmt: skip

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.study.check import check

Change = Callable[[SecondOrderTable], SecondOrderTable]
MODE = '[[mode]]\nname = "bend"\nbody = "float"\nmass = 1.0\nstiffness = 1.0'
POSES = """[[pose_table]]
name = "poses"
body = "float"
coordinate = "heave"
values = [-1.0, 1.0]
databases = ["down.h5", "up.h5"]"""


def unchanged(table: SecondOrderTable) -> SecondOrderTable:
    return table


def incomplete(table: SecondOrderTable) -> SecondOrderTable:
    computed = table.computed.copy()
    computed[1, 2] = computed[2, 1] = False
    return replace(table, computed=computed)


def turned(i: int, j: int) -> Change:
    """The load of the pair (i, j) turned by 0.01 rad; that of (j, i), if another one, as it is."""

    def change(table: SecondOrderTable) -> SecondOrderTable:
        values = table.values.copy()
        values[i, j] *= np.exp(0.01j)
        return replace(table, values=values)

    return change


def wide() -> HydroDatabase:
    """The made-up body in waves from two headings; the tables of second order have one."""
    owner = floating()
    force = np.zeros((owner.omega.size, 2, 6), complex)
    heading = np.array([0.0, 0.5])
    found: HydroDatabase = replace(owner, heading=heading, froude_krylov=force, diffraction=force)
    return found


def with_a_mode() -> HydroDatabase:
    owner = floating()
    square, force = np.eye(7), np.zeros((owner.omega.size, 1, 7), complex)
    body = replace(owner.bodies["float"], mode_stiffness=square)
    found: HydroDatabase = replace(
        owner,
        coordinates=(*owner.coordinates, "float.bend"),
        added_mass=np.tile(square, (owner.omega.size, 1, 1)),
        radiation_damping=np.tile(square, (owner.omega.size, 1, 1)),
        added_mass_inf=square,
        added_mass_inf_std=0.0 * square,
        froude_krylov=force,
        diffraction=force,
        bodies={"float": body},
    )
    return found


def diagonal(factor: float) -> Change:
    def change(table: SecondOrderTable) -> SecondOrderTable:
        values = table.values.copy()
        values[2, 2] *= factor
        return replace(table, values=values)

    return change


@pytest.mark.parametrize(
    ("change", "keys", "key", "words"),
    [
        (unchanged, {"heading": 20.0}, "second_order.loads", "outside the headings of the table"),
        (unchanged, {"waves": [*WAVES, (2.0, 0.5, 0.0)]}, "second_order.lost_variance",
         "10 % of the variance of the waves lies outside the frequencies"),
        (turned(2, 2), {}, "second_order.loads", "of two equal waves of .* a mean is real"),
        (turned(1, 2), {}, "second_order.loads", "from the same waves in the other order"),
        (incomplete, {}, "second_order.loads", "not computed for float.surge at 0.85 and 0.8"),
        (unchanged, {"loads": ["sum"]}, "second_order.loads", "needs a table of sums"),
        (unchanged, {"loads": ["mean", "newman"]}, "second_order.loads", "expected one of"),
        (unchanged, {"hull": ""}, "hydro", r"no \[\[body\]\] has the key 'hydro'"),
        (unchanged, {"body": MODE}, "second_order.loads", "body 'float' has modes"),
        (unchanged, {"body": POSES}, "second_order.loads", r"has a \[\[pose_table\]\]"),
    ],
)  # fmt: skip
def test_refused(
    change: Change, keys: dict[str, Any], key: str, words: str, tmp_path: Path
) -> None:
    write(tmp_path, change(made_up()), owner=with_a_mode() if "mode" in str(keys) else wide())
    for name, z in (("down.h5", -1.0), ("up.h5", 1.0)):
        floating(point=(0.0, 0.0, z)).write(tmp_path / name)
    with pytest.raises(CaseError, match=words) as error:
        hydrodae.run(case(tmp_path, end=1.0, **keys))
    assert error.value.key == key


@pytest.mark.parametrize(
    ("word", "change", "waves", "told"),
    [
        ("difference", unchanged, WAVES, ""),
        ("difference", diagonal(-1.0), WAVES, "against 25 % of the waves, at worst -"),
        ("newman", unchanged, WAVES[:2], ""),
        ("newman", unchanged, WAVES, "lies above 0.2 rad/s"),
    ],
)  # fmt: skip
def test_warned_of(word: str, change: Change, waves: Any, told: str, tmp_path: Path) -> None:
    write(tmp_path, change(made_up()))
    notes = hydrodae.run(case(tmp_path, [word], waves=waves, end=1.0)).notes
    said = [note for note in notes if note.startswith("second order")]
    assert len(said) == bool(told)
    assert told in "".join(said)


def test_newman_has_no_root_of_mixed_signs(tmp_path: Path) -> None:
    """The load of two waves is (T_ii + T_jj) / 2 for any signs."""
    table = diagonal(-1.0)(made_up())
    write(tmp_path, table)
    results = hydrodae.run(case(tmp_path, ["newman"], more='terms = "all"'))
    i = np.arange(OMEGA.size)
    own = table.values[i, i]
    exact = pairs(np.asarray(results.time), replace(table, values=0.5 * (own[:, None] + own)), 0)
    np.testing.assert_allclose(load(results)[:, 0], exact, atol=1e-8 * np.abs(exact).max())


@pytest.mark.parametrize("end", [40.0, 60.0])
def test_slow_motion_needs_five_cycles(end: float, tmp_path: Path) -> None:
    """(M + A) x'' + K x: a period of 10 s with A = 400 kg below the table."""
    write(tmp_path, made_up())
    stiffness = (2.0 * np.pi / 10.0) ** 2 * (1e12 + 400.0)
    spring = '[[force]]\nname = "line"\ntype = "mooring_matrix"\nbody = "float"\nstiffness = ['
    spring += f"{stiffness!r}, 0.0, 0.0, 0.0, 0.0, 0.0]"
    said = check(case(tmp_path, ["newman"], body=spring, end=end))
    told = "swings with 10 s, and the run of 40 s has 4 cycles; set end_time = 50 or more"
    assert (told in said) == (end < 50.0)
