"""Every case in another guise moves alike: scaled, turned, mirrored, shifted, carried, reordered.

Laws of nature that no code writes down. Runs are short, and all of one method.
"""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.property import moved_water, moves

import hydrodae
from hydrodae import hdb
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array

ROOT = Path(__file__).resolve().parents[2]

#: End of each run [s].
DRY = {
    "benchmarks/andrews": 0.01,
    "benchmarks/bricard": 0.5,
    "benchmarks/chain_10": 0.3,
    "benchmarks/door": 1.0,
    "benchmarks/fast_rotor": 0.1,
    "benchmarks/flyball_governor": 0.1,
    "benchmarks/heavy_top": 0.2,
    "benchmarks/kinematic_lock": 0.4,
    "benchmarks/light_joint": 1.0,
    "benchmarks/mass_ratio": 2.0,
    "benchmarks/n_four_bar_2": 0.5,
    "benchmarks/pendulum_1000s": 2.0,
    "benchmarks/simple_pendulum": 2.0,
    "benchmarks/slider_crank_equal": 1.0,
    "benchmarks/tumbling_body": 2.0,
    "control/case": 2.0,
}
WET = {
    "f3of/flap_decay": 4.0,
    "f3of/pitch_decay": 4.0,
    "f3of/rao": 4.0,
    "f3of/surge_decay": 4.0,
    "f3of/waves": 4.0,
    "sphere/control": 6.0,
    "sphere/decay": 4.0,
    "sphere/latch": 8.0,
    "sphere/wave": 4.0,
    "tank_section/section": 1.0,
}
LEFT_OUT = {
    "4n3la/irregular": "its database is made in 20 s; tests/verification/test_squid.py mirrors it",
    "4n3la/regular": "as irregular",
    "9n9la/irregular": "its database is made in minutes",
    "9n9la/regular": "as irregular",
    "control/case_tcp": "another program",
    "plugin/case": "laws of a library with numbers of their own",
    "pto/case": "the gains of its controller are numbers of their own",
    "pto/ro": "as case",
    "rm3/decay": "its database is not in the repository",
    "rm3/moored": "as decay",
    "rm3/moored_lines": "as decay",
    "rm3/sea": "as decay",
    "rm3/wave": "as decay",
    "tank_section/fixed": "nothing moves",
    "wecccomp/case": "its database is not in the repository",
    # studies
    "4n3la/take_offs": "no case",
    "pto/powers": "no case",
    "pto/ro_powers": "no case",
    "rm3/power_matrix": "no case",
}
NOT_TURNED = {"tank_section/section": "its database has the coordinates of one plane"}
NOT_SHIFTED = {"f3of/waves": "the phases of an irregular sea are those of its seed"}
NOT_CARRIED = {"benchmarks/mass_ratio": "its spring refers to the world"}
SOLVER = {"method": "radau", "accuracy": "none"}
ANGLE, SCALE, SPEED = 0.7, 25.0, 0.7  # rad, -, m/s


@dataclass(frozen=True)
class Motion:
    """Bodies of a run: times (nt,), and by channel and body (nt, 3) arrays."""

    time: Array
    position: dict[str, Array]
    velocity: dict[str, Array]
    angular_velocity: dict[str, Array]


@cache
def scene(name: str) -> dict[str, Any]:
    """A case, with a short end and few samples."""
    made = tomllib.loads((ROOT / "cases" / f"{name}.toml").read_text())
    end = {**DRY, **WET}[name]
    made["solver"] = {"rtol": 1e-6, **made["solver"], **SOLVER, "end_time": end}
    made["output"] = {"step": end / 20.0}
    if "sea" in made:
        made["sea"]["ramp"] = min(made["sea"]["ramp"], 0.5 * end)
    return made


@cache
def water(name: str) -> hdb.HydroDatabase:
    """Database of a case."""
    return hdb.read(ROOT / "cases" / Path(name).parent / "hydro.h5")


def run(made: dict[str, Any], folder: Path) -> Motion:
    """Motion of a scene whose database stands in a folder."""
    results = hydrodae.run(hydrodae.Case.from_text(moves.text(made), folder))
    names = [b["name"] for b in made["body"] if b["name"] != "carriage"]

    def channel(what: str) -> dict[str, Array]:
        found = {n: f"bodies/{n}/{what}" for n in names if f"bodies/{n}/{what}" in results}
        return {n: np.asarray(results[path].values) for n, path in found.items()}

    return Motion(
        np.asarray(results.time),
        channel("position"),
        channel("velocity"),
        channel("angular_velocity"),
    )


@cache
def known(name: str) -> Motion:
    """Motion of a case as it is."""
    return run(scene(name), ROOT / "cases" / Path(name).parent)


def assert_alike(name: str, seen: Motion, expected: Motion) -> None:
    """Within 100 rtol of the motion: of the largest displacement, velocity, angular velocity."""
    rtol = scene(name)["solver"]["rtol"]
    np.testing.assert_allclose(seen.time, expected.time, rtol=1e-12)
    for what in ("position", "velocity", "angular_velocity"):
        ours, theirs = getattr(seen, what), getattr(expected, what)
        assert set(theirs) <= set(ours)
        start = {n: x[0] if what == "position" else 0.0 for n, x in theirs.items()}
        size = max((np.abs(x - start[n]).max() for n, x in theirs.items()), default=0.0)
        for body, x in theirs.items():
            error = np.abs(ours[body] - x).max()
            assert error <= 100.0 * rtol * size, f"{what} of {body}: {error:.2g} of {size:.2g}"


def put(data: hdb.HydroDatabase | None, folder: Path) -> Path:
    """Write a database where its scene looks for it."""
    if data is not None:
        data.write(folder / "hydro.h5")
    return folder


def wet(name: str) -> hdb.HydroDatabase | None:
    return water(name) if name in WET else None


def test_every_case_is_tried_or_says_why_not() -> None:
    shipped = {
        path.relative_to(ROOT / "cases").with_suffix("").as_posix()
        for path in (ROOT / "cases").glob("*/*.toml")
    }
    assert shipped == {*DRY, *WET, *LEFT_OUT}


@pytest.mark.parametrize("name", [*DRY, *WET])
def test_froude_scaling(name: str, tmp_path: Path) -> None:
    """Lengths by 25, times by 5, masses by 25^3, at the same gravity and density."""
    data = wet(name)
    put(None if data is None else moved_water.scaled(data, SCALE), tmp_path)
    seen, old = run(moves.scaled(scene(name), SCALE), tmp_path), known(name)
    rate = math.sqrt(SCALE)
    expected = Motion(
        old.time * rate,
        {n: x * SCALE for n, x in old.position.items()},
        {n: x * rate for n, x in old.velocity.items()},
        {n: x / rate for n, x in old.angular_velocity.items()},
    )
    assert_alike(name, seen, expected)


@pytest.mark.parametrize("name", [*DRY, *WET])
def test_order_of_bodies_joints_and_forces(name: str, tmp_path: Path) -> None:
    data = wet(name)
    put(None if data is None else moved_water.reordered(data), tmp_path)
    assert_alike(name, run(moves.reordered(scene(name)), tmp_path), known(name))


def compare_moved(name: str, move: moves.Move, tmp_path: Path, *, free: bool = False) -> None:
    """Run a case that is moved as a whole, beside what its motion must be."""
    data = wet(name)
    put(None if data is None else moved_water.moved(data, move), tmp_path)
    made = moves.freed(scene(name)) if free else scene(name)

    def number(omega: float) -> float:
        assert data is not None
        return float(wavenumber(omega, data.water_depth, data.gravity))

    seen, old = run(moves.moved(made, move, number), tmp_path), known(name)
    expected = Motion(
        old.time,
        {n: move.place(x) for n, x in old.position.items()},
        {n: move.arrow(x) for n, x in old.velocity.items()},
        {n: move.turn(x) for n, x in old.angular_velocity.items()},
    )
    assert_alike(name, seen, expected)


@pytest.mark.parametrize("name", [*DRY, *WET])
def test_mirror(name: str, tmp_path: Path) -> None:
    """In a skew vertical plane, or in y = 0 where all moves in that; axes of turning are axial."""
    plain = name in NOT_TURNED
    compare_moved(name, moves.mirrored(0.0 if plain else ANGLE), tmp_path, free=not plain)


@pytest.mark.parametrize("name", [n for n in (*DRY, *WET) if n not in NOT_TURNED])
def test_rotation_about_the_vertical(name: str, tmp_path: Path) -> None:
    """By a skew angle; what moves in a plane is held in it by a joint."""
    compare_moved(name, moves.turned(ANGLE), tmp_path, free=True)


@pytest.mark.parametrize("name", [n for n in (*DRY, *WET) if n not in NOT_SHIFTED])
def test_horizontal_translation(name: str, tmp_path: Path) -> None:
    """The phases of waves are zero at the origin, so the device and its waves move together."""
    compare_moved(name, moves.shifted(37.0, -11.0), tmp_path)


@pytest.mark.parametrize("name", [n for n in DRY if n not in NOT_CARRIED])
def test_galilei(name: str, tmp_path: Path) -> None:
    """On a carriage of constant speed a mechanism moves as on the ground."""
    old = known(name)
    still = np.zeros(3)
    start = {n: (v[0], old.angular_velocity.get(n, [still])[0]) for n, v in old.velocity.items()}
    seen = run(moves.carried(scene(name), SPEED, start), tmp_path)
    way = np.array([SPEED, 0.0, 0.0])
    expected = Motion(
        old.time,
        {n: x + old.time[:, None] * way for n, x in old.position.items()},
        {n: v + way for n, v in old.velocity.items()},
        old.angular_velocity,
    )
    assert_alike(name, seen, expected)
