"""Far-field drift of scenes of exact cylinders: energy, Maruo's law, and invariances."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.scenes import table
from tests.verification.cylinder_scenes import (
    COG,
    OMEGA,
    Places,
    database,
    float_of,
    guide,
    mooring,
    written,
)  # fmt: skip

import hydrodae
from hydrodae.case import Case
from hydrodae.study.drift import Drift
from hydrodae.study.drift.scene import turned

FREE = ["surge", "sway", "heave", "roll", "pitch", "yaw"]
#: Two bodies that no plane of symmetry holds in waves along x.
PAIR = {"fore": (-1.6, 0.3), "aft": (1.4, -0.5)}
HEADINGS = (0.0, 0.6)


def hinged(folder: Path, places=None, headings=HEADINGS, damping=4000.0, turn=0.0) -> Case:
    """Two free cylinders with a hinge and a damper in it, moored by springs at the first."""
    places = PAIR if places is None else places
    middle = np.mean([places[name] for name in places], axis=0)
    hinge = table(
        "joint", name="hinge", type="revolute", body_a="fore", body_b="aft",
        point=[*map(float, middle), COG], axis=[-np.sin(turn), float(np.cos(turn)), 0.0],
    )  # fmt: skip
    pto = table("force", name="pto", type="pto_linear", joint="hinge", damping=damping)
    bodies = [float_of(name, place, FREE) for name, place in places.items()]
    return written(folder, database(places, headings), *bodies, hinge, pto, mooring("fore", 3000.0))


def power_form(found: Drift) -> np.ndarray:
    """Drift along the waves by the power of the take-offs alone, and what is scattered."""
    taken = sum(found.by_force.values())
    return taken / found.speed[:, None] + (found.by_power - found.least)


def test_one_cylinder_with_a_damper(tmp_path: Path) -> None:
    """F = P k/w + scattering, P that of the damper; most of the drift is its doing."""
    place = (0.7, -0.4)
    case = written(
        tmp_path,
        database({"buoy": place}, HEADINGS),
        float_of("buoy", place, ["heave"]),
        guide("buoy", place, 3000.0),
    )
    found = hydrodae.drift(case, omega=OMEGA)
    assert found.along == pytest.approx(power_form(found), rel=1e-6)
    assert found.power == pytest.approx(found.by_force["pto_buoy"], rel=1e-6)
    assert np.all(found.along > found.least)
    free = hydrodae.drift(case, omega=OMEGA, set={"force.pto_buoy.damping": 0.0})
    assert found.along[0, 0] > 50.0 * free.along[0, 0] > 0.0
    sway = np.tan(found.heading) * found.load[:, :2, 0].real
    assert found.load[:, :2, 1].real == pytest.approx(sway, rel=1e-6, abs=1e-6)
    # an upright cylinder that heaves has no moment about its axis
    assert np.abs(found.load[..., 2]).max() < 1e-6 * found.along.max()


def test_two_hinged_cylinders(tmp_path: Path) -> None:
    found = hydrodae.drift(hinged(tmp_path), omega=OMEGA, pairs=True)
    assert found.along == pytest.approx(power_form(found), rel=1e-6, abs=1e-6 * found.along.max())
    assert np.all(found.by_force["pto"] > 0.0)
    assert found.error < 1e-6
    one, other = (found.load[:, found.pairs.tolist().index(pair)] for pair in ([0, 1], [1, 0]))
    assert one == pytest.approx(other.conj(), abs=1e-9 * found.along.max())


def test_without_power_the_drift_is_what_is_scattered(tmp_path: Path) -> None:
    found = hydrodae.drift(hinged(tmp_path, damping=0.0))
    assert np.abs(found.power).max() < 1e-6 * np.abs(found.by_power * found.speed[:, None]).max()
    assert np.all(found.by_power > 0.0)
    assert found.along.min() > -1e-3 * found.along.max()  # between the frequencies: splines
    assert found.margin > -1e-3


def test_turned_and_mirrored(tmp_path: Path) -> None:
    """Device and waves together: turned by 50 degrees, and mirrored about y = 0."""
    first = hydrodae.drift(hinged(tmp_path), omega=OMEGA)
    angle = np.radians(50.0)
    turn = turned(angle)[:2, :2]
    places: Places = {name: turn @ place for name, place in PAIR.items()}
    folder = tmp_path / "turned"
    folder.mkdir()
    headings = [h + angle for h in HEADINGS]
    other = hydrodae.drift(hinged(folder, places, headings, turn=angle), omega=OMEGA)
    size = first.along.max()
    assert other.load[..., :2] == pytest.approx(first.load[..., :2] @ turn.T, abs=1e-7 * size)
    assert other.load[..., 2] == pytest.approx(first.load[..., 2], abs=1e-6 * size)
    places = {name: (x, -y) for name, (x, y) in PAIR.items()}
    folder = tmp_path / "mirrored"
    folder.mkdir()
    mirrored = hydrodae.drift(hinged(folder, places, (-0.6, 0.0)), omega=OMEGA)
    assert mirrored.load[:, ::-1] == pytest.approx(
        first.load * np.array([1.0, -1.0, -1.0]), abs=1e-6 * size
    )


def test_of_another_size(tmp_path: Path) -> None:
    """Froude: forces over rho g L, at frequencies over the root of L."""
    place = (0.0, 0.0)
    loads = []
    for scale in (1.0, 9.0):
        case = written(
            tmp_path,
            database({"buoy": place}, scale=scale),
            float_of("buoy", place, ["heave"], scale),
            guide("buoy", place, 3000.0, scale),
            file=f"hydro{scale:g}.h5",
        )
        found = hydrodae.drift(case, omega=OMEGA / np.sqrt(scale))
        loads.append(found.load[:, 0, 0] / scale)
    assert loads[0] == pytest.approx(loads[1], rel=1e-6)


def test_at_another_place(tmp_path: Path) -> None:
    """A scene whose equilibrium is aside is one whose database is of that place."""
    aside = np.array([0.9, -0.5])
    load = table("force", name="wind", type="constant_load", body="buoy",
                 force=[*(3000.0 * aside).tolist(), 0.0])  # fmt: skip
    case = written(
        tmp_path,
        database({"buoy": (0.0, 0.0)}, HEADINGS),
        float_of("buoy", (0.0, 0.0), FREE),
        mooring("buoy", 3000.0),
        load,
    )
    there = written(
        tmp_path,
        database({"buoy": aside}, HEADINGS),
        float_of("buoy", aside, FREE),
        mooring("buoy", 3000.0),
        file="there.h5",
    )
    found, expected = (hydrodae.drift(each, omega=OMEGA, pairs=True) for each in (case, there))
    assert found.error < 1e-6
    size = expected.along.max()
    assert found.carrier.place[:2] == pytest.approx(aside, abs=1e-9)
    assert found.load == pytest.approx(expected.load, abs=2e-6 * size)


def test_moment_of_two_bodies_far_apart(tmp_path: Path) -> None:
    """About a fixed body the moment is that of the drift of the damped one, 16 radii aside.

    They hide little from each other: what one scatters has fallen by sqrt(radius / distance), a
    quarter, and its phase at the other changes from frequency to frequency.
    """
    places = {"fixed": (0.0, -8.0), "buoy": (0.0, 8.0)}
    buoy = float_of("buoy", places["buoy"], ["heave"]), guide("buoy", places["buoy"], 3000.0)
    fixed = float_of("fixed", places["fixed"], "fixed")
    found = hydrodae.drift(written(tmp_path, database(places), fixed, *buoy), omega=OMEGA)
    assert found.carrier.body == "fixed"
    alone = database({"buoy": places["buoy"]})
    case = written(tmp_path, alone, *buoy, file="alone.h5")
    one = hydrodae.drift(case, omega=OMEGA)
    ratio = found.load[:, 0, 2].real / (-16.0 * one.along[:, 0])
    assert ratio == pytest.approx(np.ones(OMEGA.size), abs=0.25)
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.05)
