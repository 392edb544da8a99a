"""Static equilibrium of moored scenes against catenary equations solved with scipy."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq, root
from tests.attack.parts import Table, body, case, spring
from tests.verification.blocks import case_of

import hydrodae
from hydrodae.linear import LinearModel
from hydrodae.mooring.stiffness import mooring_stiffness
from hydrodae.support.arrays import Array

LENGTH, WEIGHT, EA = 400.0, 1200.0, 5e7
G = 9.80665


def reach(
    pull: float, lift: float, length: float = LENGTH, w: float = WEIGHT
) -> tuple[float, float]:
    """Where the upper end of a line on the seabed is by its forces (Jonkman 2007, B-1 to B-3)."""
    hung = min(lift / w, length)
    foot = lift - w * hung  # vertical force at its lower end
    x = pull / w * (math.asinh(lift / pull) - math.asinh(foot / pull)) + pull * hung / EA
    z = (math.hypot(pull, lift) - math.hypot(pull, foot)) / w
    z += (lift * hung - 0.5 * w * hung**2) / EA
    lying = length - hung
    return x + lying * (1.0 + pull / EA), z


def force_on_fairlead(d: Array, length: float = LENGTH, w: float = WEIGHT) -> Array:
    """Force of such a line on its upper end, d away from its anchor; slack lines hang."""
    x, z = math.hypot(d[0], d[1]), d[2]
    strain = (math.sqrt(1.0 + 2.0 * w * z / EA) - 1.0) / w * EA  # of a hanging length, w l = V
    if x <= length - strain:
        hung = EA / w * (math.sqrt(1.0 + 2.0 * w * z / EA) - 1.0)
        return np.array([0.0, 0.0, -w * hung])

    def lift_at(pull: float) -> float:
        return float(
            brentq(lambda v: reach(pull, v, length, w)[1] - z, 1e-9, 1e9, xtol=1e-9, rtol=1e-14)
        )

    pull = brentq(lambda h: reach(h, lift_at(h), length, w)[0] - x, 1e-6, 1e8, rtol=1e-14)
    return np.array([-pull * d[0] / x, -pull * d[1] / x, -lift_at(pull)])


def line(name: str, anchor: Array, fairlead: Array, length: float = LENGTH) -> Table:
    keys = dict(type="catenary", name=name, body_b="buoy", length=[length])
    ends: Table = dict(point_a=anchor.tolist(), point_b=fairlead.tolist())
    return {**keys, **ends, "weight": [WEIGHT], "stiffness": [EA]}


def scene(
    load: Array, lines: list[Table], *, motion: str = "point", stiff: float = 5e5
) -> hydrodae.Case:
    """A buoy at the origin that floats with a stiffness, its weight borne, under a load."""
    lift = (load + np.array([0.0, 0.0, 2e5 * 9.81])).tolist()
    current = dict(type="constant_load", name="current", body="buoy", force=lift)
    diagonal = [0.0, 0.0, stiff, 5e7, 5e7, 0.0]
    water: Table = dict(type="mooring_matrix", name="water", body="buoy", stiffness=diagonal)
    buoy = body("buoy", motion, 2e5, inertia=[1e7] * 3)
    return case_of(case([buoy], 1.0, forces=[current, water, *lines]))


@pytest.mark.parametrize("load", [1e4, 1e5, 4e5, 2e6])
@pytest.mark.parametrize("start", [300.0, 385.0, 397.0])
def test_single_point_mooring(load: float, start: float) -> None:
    """H is the load, whatever the start: slack at 300 m, taut at 397 m from the anchor."""
    anchor = np.array([-start, 0.0, -50.0])
    lines = [line("bow", anchor, np.zeros(3))]
    found = hydrodae.equilibrium(scene(np.array([load, 0.0, 0.0]), lines))

    def off(heave: float) -> float:  # the line pulls the buoy down until the water bears it
        lift = -5e5 * heave
        return reach(load, lift)[1] - (50.0 + heave)

    heave = brentq(off, -40.0, -1e-6, xtol=1e-14, rtol=1e-14)
    x, _ = reach(load, -5e5 * heave)
    assert found.offsets["buoy"] == pytest.approx([x - start, 0.0, heave], abs=1e-6)
    tension = math.hypot(load, 5e5 * heave)
    assert found.tensions["forces/bow/tension"] == pytest.approx(tension, rel=1e-8)
    assert f"tension {tension:.1f} N" in str(found)


def spread(radius: float = 385.0, fairlead: float = 5.0) -> list[tuple[Array, Array]]:
    out = []
    for k in range(3):
        way = np.array([math.cos(2 * math.pi * k / 3), math.sin(2 * math.pi * k / 3), 0.0])
        out.append(((radius + fairlead) * way - [0, 0, 52], fairlead * way - [0, 0, 2]))
    return out


def load_of_spread(at: Array) -> Array:
    """Force and moment of the three lines on a body that is displaced and turned by a vector."""
    angle = float(np.linalg.norm(at[3:]))
    axis = at[3:] / angle if angle else np.zeros(3)
    total = np.zeros(6)
    for anchor, fairlead in spread():
        arm = (  # Rodrigues
            fairlead * math.cos(angle)
            + np.cross(axis, fairlead) * math.sin(angle)
            + axis * (axis @ fairlead) * (1.0 - math.cos(angle))
        )
        force = force_on_fairlead(at[:3] + arm - anchor)
        total += np.concatenate([force, np.cross(arm, force)])
    return total


def test_spread_mooring() -> None:
    """Symmetric; load and stiffness of the independent equations, by differences."""
    lines = [line(f"line{k}", *ends) for k, ends in enumerate(spread())]
    moored = scene(np.zeros(3), lines, motion="rigid")
    found = hydrodae.equilibrium(moored)
    tensions = [found.tensions[f"forces/line{k}/tension"] for k in range(3)]
    assert tensions == pytest.approx([tensions[0]] * 3, rel=1e-9)
    own = [hold for hold in found.moorings if hold.name != "water"]
    model = LinearModel(moored)
    stiffness = mooring_stiffness(model, own).of("buoy")
    at = np.concatenate([found.offsets["buoy"], found.rotations["buoy"]])
    assert mooring_stiffness(model, own).load_of("buoy") == pytest.approx(
        load_of_spread(at), abs=1e-3
    )
    steps = 1e-3 * np.eye(6)
    by_differences = -np.array(
        [(load_of_spread(at + h) - load_of_spread(at - h)) / 2e-3 for h in steps]
    ).T
    size = np.sqrt(np.outer(np.diag(by_differences), np.diag(by_differences)))
    assert np.max(np.abs(stiffness - by_differences) / size) < 1e-5
    assert stiffness[0, 0] == pytest.approx(stiffness[1, 1], rel=1e-9)
    periods = [mode.period for mode in found.modes]
    assert max(periods) == pytest.approx(2 * math.pi * math.sqrt(2e5 / stiffness[0, 0]), rel=0.02)


@pytest.mark.parametrize("seed", range(24))
def test_random_scenes(seed: int) -> None:
    """A buoy on two to five lines under a load, from a start that is no equilibrium at all."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 6))
    angles = 2 * math.pi * (np.arange(count) + rng.uniform(-0.2, 0.2, count)) / count
    radius, lengths = rng.uniform(300.0, 395.0, count), rng.uniform(380.0, 420.0, count)
    anchors = np.stack([radius * np.cos(angles), radius * np.sin(angles), np.full(count, -50.0)], 1)
    load = np.append(rng.normal(size=2), 0.0) * 10.0 ** rng.uniform(4.0, 6.0)
    lines = [line(f"line{k}", anchors[k], np.zeros(3), float(lengths[k])) for k in range(count)]
    found = hydrodae.equilibrium(scene(load, lines)).offsets["buoy"]

    def forces(at: Array) -> Array:
        total = load - [0.0, 0.0, 5e5 * at[2]]
        for k in range(count):
            total = total + force_on_fairlead(at - anchors[k], float(lengths[k]))
        return np.asarray(total / 1e5)

    assert np.max(np.abs(forces(found))) < 1e-6
    other = root(forces, found + rng.normal(size=3) * [0.5, 0.5, 0.05], tol=1e-12)
    if other.success:
        assert found == pytest.approx(other.x, abs=1e-4)


def test_ropes_from_slack_to_taut() -> None:
    """Nothing holds the start: the equilibrium is 12 m away, where two slack ropes come taut."""
    current = dict(type="constant_load", name="current", body="buoy", force=[2e3, 0.0, 0.0])
    rope: Table = dict(type="rope", bodies=["ground", "buoy"], stiffness=1e7, length=33.0)
    ropes = [
        {**rope, "name": f"rope{side}", "points": [[-20.0, side, 0.0], [0.0] * 3]}
        for side in (-8, 8)
    ]
    buoy = body("buoy", ["surge", "sway"], 1e4)
    found = hydrodae.equilibrium(case_of(case([buoy], 1.0, forces=[current, *ropes])))

    def off(x: float) -> float:
        length = math.hypot(x, 8.0)
        return 2.0 * 1e7 * (length - 33.0) / 33.0 * x / length - 2e3

    x = brentq(off, 30.0, 40.0, xtol=1e-13) - 20.0
    assert found.offsets["buoy"] == pytest.approx([x, 0.0, 0.0], abs=1e-7)
    assert set(found.tensions) >= {"forces/rope8/tension", "forces/rope-8/tension"}


def test_no_equilibrium_is_one_clear_message() -> None:
    """Heavier than its buoyancy, it goes down to the seabed, of which the line knows nothing."""
    anchor = np.array([-385.0, 0.0, -50.0])
    sinking = scene(np.array([0.0, 0.0, -1e6]), [line("bow", anchor, np.zeros(3))], stiff=0.0)
    message = r"no static equilibrium near the start: catenary 'bow': end B is .* m below the"
    with pytest.raises(hydrodae.CaseError, match=message):
        hydrodae.equilibrium(sinking)


@pytest.mark.parametrize(("x", "z"), [(200.0, 60.0), (255.0, 30.0), (264.0, 60.0), (270.0, 60.0)])
def test_a_line_with_a_float_sags_on_both_sides(x: float, z: float) -> None:
    """Its lower part lies on the bed, its upper part hangs between float and fairlead."""
    lengths, float_up = (240.0, 40.0), 164366.55
    line = hydrodae.catenary(x, z, lengths, (WEIGHT, WEIGHT), (EA, EA), loads=[-float_up], n=281)

    def off(v: Array) -> list[float]:
        pull, lift = v[0] * 1e5, v[1] * 1e5
        foot = lift - WEIGHT * lengths[1]
        across = pull / WEIGHT * (math.asinh(lift / pull) - math.asinh(foot / pull))
        across += pull * lengths[1] / EA
        up = (math.hypot(pull, lift) - math.hypot(pull, foot)) / WEIGHT
        up += 0.5 * (lift + foot) * lengths[1] / EA
        below = reach(pull, foot + float_up, lengths[0])
        return [below[0] + across - x, below[1] + up - z]

    found = root(off, [line.horizontal / 1e5 * 1.01, line.vertical / 1e5 + 0.01], tol=1e-13)
    assert found.success
    assert [line.horizontal, line.vertical] == pytest.approx(found.x * 1e5, rel=1e-8)
    if line.vertical < WEIGHT * lengths[1]:
        assert line.z[241:].min() < line.z[240]  # below the float
    assert line.x[-1] == pytest.approx(x, abs=1e-8)
    assert line.z[-1] == pytest.approx(z, abs=1e-8)


def test_a_part_that_sags_to_the_bed_is_no_line() -> None:
    with pytest.raises(hydrodae.CaseError, match="down on the seabed"):
        hydrodae.catenary(60.0, 5.0, (40.0, 60.0), (WEIGHT,) * 2, (EA,) * 2, loads=[-6e4])


def hanging(stiffness: float) -> hydrodae.Case:
    """A load on a rope between soft springs, in a wind."""
    at = [3.0, 5.0, -10.0]
    springs = [0.5, 0.5, 0.5, 0.0, 0.0, 0.0]
    ends: Table = dict(bodies=["ground", "load"], points=[[3.0, 5.0, -5.0], at])
    forces = [
        dict(type="mooring_matrix", name="soft", body="load", stiffness=springs),
        dict(type="constant_load", name="wind", body="load", force=[0.0, 0.3, 0.0]),
        dict(type="rope", name="rope", length=4.9, stiffness=stiffness, **ends),
    ]
    return case_of(case([body("load", "point", 1.0, at)], 1.0, forces=forces))


def test_soft_springs_hold_beside_a_rope_that_hardly_gives() -> None:
    """Pivots below 1e-12 of the largest were those of directions that nothing holds."""
    pose = hydrodae.equilibrium(hanging(2e13))
    aside, below = pose.offsets["load"][1:]
    assert math.hypot(aside, 5.0 - below) == pytest.approx(4.9, abs=1e-6)
    assert aside == pytest.approx(0.3 / (G / 4.9 + 0.5), rel=0.02)


def test_a_rope_whose_rounding_is_a_load_is_told() -> None:
    with pytest.raises(hydrodae.CaseError, match=r"heave of body 'load' .* rounding in the last"):
        hydrodae.equilibrium(hanging(5e17))


def test_buoyancy_of_a_volume_is_no_mooring() -> None:
    buoy = body("buoy", "heave", 1000.0, [0.0, 0.0, -5.0]) | {"volume": 1.5}
    ends = [0.0, 0.0, -20.0], [0.0, 0.0, -6.0]
    tether = spring("tether", "ground", "buoy", *ends, 1e5, length=13.9)
    water: Table = {"environment": {"water_density": 1000.0}}
    found = hydrodae.equilibrium(case_of(case([buoy], 1.0, forces=[tether], **water)))
    assert [hold.name for hold in found.moorings] == ["tether"]
