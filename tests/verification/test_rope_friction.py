"""Ropes that rub on sheaves and points (capstan friction) against closed forms."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tests.verification.blocks import METHODS, G, heaving, height_of, run_text
from tests.verification.drums import BOB, DOWN, RADIUS, two_masses

import hydrodae
from hydrodae.errors import CaseError

OVER = (
    f"points = [[{-RADIUS}, 0.0, {DOWN}], [0.0, 0.0, 0.0], [{RADIUS}, 0.0, {DOWN}]]\n"
    f"radii = [0.0, {RADIUS}, 0.0]\naxes = [[0, 0, 0], [0, 1, 0], [0, 0, 0]]\n"
)
M_1, M_2 = 10.0, 12.0  # of the Atwood machine
STIFF = "stiffness = 1e9\ndamping = 4e6\n"


def rope(bodies: str, keys: str, over: str = OVER, name: str = "rope") -> str:
    return f'[[force]]\ntype = "rope"\nname = "{name}"\nbodies = {bodies}\n{over}{keys}\n'


def atwood(mu: float, keys: str, light: float = M_1, heavy: float = M_2) -> str:
    return two_masses(light, heavy) + rope(
        '["light", "ground", "heavy"]', f"friction = [{mu}]\n{keys}"
    )


def tensions(run: hydrodae.Results) -> np.ndarray:
    return np.asarray(run["forces/rope/tensions"].values)


def slip(run: hydrodae.Results) -> np.ndarray:
    return np.asarray(run["forces/rope/slip"].values)


def velocity(run: hydrodae.Results, body: str) -> np.ndarray:
    return np.asarray(run[f"bodies/{body}/velocity"].values[:, 2])


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("masses", [(M_1, M_2), (M_2, M_1)])
def test_an_elastic_rope_sticks_and_slips_at_the_ratio_of_the_capstan(
    masses: tuple[float, float], method: str
) -> None:
    """It slips at T2 / T1 = exp(mu phi) and at no other ratio, whatever swings meanwhile. While it
    slips m2 (v2' + g) = E m1 (v1' + g)."""
    text = atwood(0.05, "stiffness = 5e4\npretension = 90.0", *masses)
    run = run_text(text, 1.0, method=method, rtol=1e-8, step=0.002)
    before, after = tensions(run).T
    v, grip = slip(run).ravel(), math.exp(0.05 * math.pi)
    low, high = np.minimum(before, after), np.maximum(before, after)
    slips = v != 0.0
    assert 20 < slips.sum() < len(v) - 20
    assert low.min() > 1.0
    assert high[slips] == pytest.approx(grip * low[slips], rel=1e-12)
    assert (high[~slips] < grip * low[~slips] * (1.0 + 1e-8)).all()
    assert (np.sign(v[slips]) == np.sign(after - before)[slips]).all()
    assert (run["forces/rope/friction_power"].values <= 0.0).all()
    same = slips[1:] & slips[:-1] & (v[1:] * v[:-1] > 0.0)  # no event between
    to_heavy = np.where(v > 0.0, grip, 1.0 / grip)[1:]
    gained = masses[1] * (np.diff(velocity(run, "heavy")) + G * np.diff(run.time))
    given = to_heavy * masses[0] * (np.diff(velocity(run, "light")) + G * np.diff(run.time))
    assert gained[same] == pytest.approx(given[same], rel=1e-6)


@pytest.mark.parametrize("masses", [(M_1, M_2), (M_2, M_1)])
@pytest.mark.parametrize("mu", [0.03, 0.055, 0.06, 0.1])
def test_masses_over_a_fixed_bar(mu: float, masses: tuple[float, float]) -> None:
    """The rope is held where m2 / m1 < exp(mu pi) = E, and else slides at
    a = (m2 - E m1) g / (m2 + E m1), in both directions."""
    run = run_text(atwood(mu, f"{STIFF}pretension = 98.1", *masses), 0.4)
    late = run.time > 0.2
    m_1, m_2 = sorted(masses)
    grip = math.exp(mu * math.pi)
    holds = m_2 / m_1 < grip
    a = 0.0 if holds else (m_2 - grip * m_1) * G / (m_2 + grip * m_1)
    wanted = {m_1: m_1 * (G + a), m_2: m_2 * (G - a)}
    for side in (0, 1):
        assert tensions(run)[late, side] == pytest.approx(wanted[masses[side]], rel=1e-6)
    v = velocity(run, "light" if masses[0] == m_1 else "heavy")[late]
    if holds:
        assert (slip(run)[late] == 0.0).all()
        assert np.abs(v).max() < 1e-8
    else:
        assert np.polyfit(run.time[late], v, 1)[0] == pytest.approx(a, rel=1e-6)
        assert np.abs(slip(run)[late]) == pytest.approx(v, rel=1e-6)


def test_masses_over_a_fixed_bar_as_in_the_reference(reference: Path) -> None:
    path = reference / "rope" / "capstan.json"
    for wanted in json.loads(path.read_text())["atwood_fixed_drum_half_wrap"]["cases"]:
        text = atwood(wanted["mu"], f"{STIFF}pretension = 98.1", wanted["m1"], wanted["m2"])
        run = run_text(text, 0.4, step=0.1)
        assert tensions(run)[-1] == pytest.approx([wanted["T1"], wanted["T2"]], rel=1e-6)
        assert (slip(run)[-1] == 0.0) == wanted["sticks"]


@pytest.mark.parametrize("damping", [0.0, 200.0])
def test_what_friction_takes_is_what_is_lost(damping: float) -> None:
    text = atwood(0.05, f"stiffness = 5e4\ndamping = {damping}\npretension = 60.0")
    run = run_text(text, 1.0, step=0.0005)
    energy = run["energy/total"].values
    power = run["forces/rope/friction_power"].values
    taken = np.concatenate([[0.0], np.cumsum(0.5 * (power[1:] + power[:-1]) * np.diff(run.time))])
    left = energy - energy[0] - taken
    assert (power <= 0.0).all()
    assert taken[-1] < -0.5
    assert np.abs(run["energy/balance_error"].values).max() < 1e-6
    if damping == 0.0:
        assert np.abs(left).max() < 2e-4 * -taken[-1]
    else:
        assert np.diff(left).max() < 1e-5


def test_a_rope_turns_the_wheel_that_it_sticks_to() -> None:
    """Over a wheel on a hinge: a = (m2 - m1) g / (m1 + m2 + I / R^2), some turns long."""
    inertia = 3.0
    text = (
        two_masses(M_1, M_2)
        + f"""
[[body]]
name = "wheel"
motion = ["pitch"]
mass = 5.0
inertia = [{inertia}, {inertia}, {inertia}]
center_of_gravity = [0.0, 0.0, 0.0]
"""
    )
    keys = "stiffness = 1e8\ndamping = 4e5\npretension = 98.1\nfriction = [0.3]"
    over = OVER.replace(str(DOWN), "-40.0")
    text = text.replace(str(DOWN), "-40.0") + rope('["light", "wheel", "heavy"]', keys, over)
    run = run_text(text, 5.0)
    assert (slip(run) == 0.0).all()
    a = (M_2 - M_1) * G / (M_1 + M_2 + inertia / RADIUS**2)
    speed = velocity(run, "light")
    assert speed[-1] == pytest.approx(a * 5.0, rel=1e-4)
    turned = run["bodies/wheel/angular_velocity"].values[:, 1]
    assert turned[-1] * RADIUS == pytest.approx(speed[-1], rel=1e-5)
    assert tensions(run)[-1] == pytest.approx([M_1 * (G + a), M_2 * (G - a)], rel=1e-4)
    assert a * 5.0**2 / 2.0 > 2.0 * math.pi * RADIUS


def test_a_pendulum_on_a_drum_that_it_sticks_to_keeps_its_energy() -> None:
    """The rope is laid on the drum and comes off without slip: the energy is kept."""
    keys = f"stiffness = 1e5\npretension = {2.0 * G}\nfriction = [3.0]"
    text = BOB + rope('["ground", "ground", "bob"]', keys)
    run = run_text(text, 3.0)
    height = run["bodies/bob/position"].values[:, 2]
    energy = run["energy/total"].values
    assert np.ptp(run["forces/rope/wrap"].values) > 0.4
    assert (slip(run) == 0.0).all()
    assert np.ptp(energy) < 1e-5 * np.ptp(2.0 * G * height)


@pytest.mark.parametrize("damping", [0.0, 2e4])
def test_friction_of_many_places_multiplies(damping: float) -> None:
    """Hauled in by a winch over a sheave, a free sheave and a point: T = m g exp(sum mu phi)."""
    mass, mu = 10.0, 0.2
    text = heaving({"load": (mass, (-RADIUS, 0.0, DOWN))}) + rope(
        '["load", "ground", "ground", "ground", "ground"]',
        f"stiffness = 1e6\ndamping = {damping}\nfriction = [0, {mu}, 0, {mu}, 0]\n"
        "winch_time = [0.0, 0.5]\nwinch_length = [16.0695, 15.9695]",
        f"points = [[{-RADIUS}, 0, {DOWN}], [0, 0, 0], [4, 0, 0], [4.5, 0, -3], [8, 0, -3]]\n"
        f"radii = [0, {RADIUS}, {RADIUS}, 0, 0]\n"
        "axes = [[0, 0, 0], [0, 1, 0], [0, 1, 0], [0, 0, 0], [0, 0, 0]]\n",
    )
    run = run_text(text, 0.5, rtol=1e-8, step=0.001)
    wrap, T = run["forces/rope/wrap"].values, tensions(run)
    both = (slip(run) > 0.0).all(axis=1)
    assert both.sum() > 50
    wanted = np.exp(mu * wrap[both][:, [0, 2]])
    assert T[both, 1:] == pytest.approx(wanted * T[both, :-1], rel=1e-9)
    assert wrap[0] == pytest.approx([math.pi / 2, math.pi / 2, math.pi / 2], abs=1e-9)
    assert (run["forces/rope/friction_power"].values <= 0.0).all()


def test_a_rope_over_a_sheave_that_it_leaves_has_one_tension() -> None:
    """Its end goes up until the rope is straight, and down again."""
    text = heaving({"end": (10.0, (3.0, 0.0, -1.0))})
    text += (
        '[[constraint]]\nname = "moves"\ntype = "coordinate"\nbody = "end"\ncoordinate = "heave"\n'
        "drive = { amplitude = 2.0, period = 4.0 }\n"
    )
    text += rope(
        '["ground", "ground", "end"]',
        "stiffness = 1e6\nlength = 6.0\nfriction = [0.4]",
        "points = [[-3.0, 0.0, 0.5], [0.0, 0.0, 0.0], [3.0, 0.0, -1.0]]\n"
        f"radii = [0.0, {RADIUS}, 0.0]\naxes = [[0, 0, 0], [0, 1, 0], [0, 0, 0]]\n",
    )
    run = run_text(text, 4.0, rtol=1e-8)
    off = run["forces/rope/wrap"].values.ravel() == 0.0
    assert 20 < off.sum() < len(off) - 20
    before, after = tensions(run)[off].T
    assert after == pytest.approx(before, rel=1e-12)
    assert (tensions(run)[~off, 0] != tensions(run)[~off, 1]).sum() > 20


BESIDE = """
[[body]]
name = "buoy"
motion = "heave"
mass = 400.0
center_of_gravity = [20.0, 0.0, 0.0]
[[force]]
type = "spring_damper"
name = "spring"
body_a = "ground"
body_b = "buoy"
point_a = [20.0, 0.0, -3.0]
point_b = [20.0, 0.0, 0.0]
stiffness = 4000.0
damping = 50.0
"""
DRIVEN = f"""
[[body]]
name = "float"
motion = "heave"
mass = 30.0
center_of_gravity = [{-RADIUS}, 0.0, {DOWN}]
[[constraint]]
name = "wave"
type = "coordinate"
body = "float"
coordinate = "heave"
drive = {{ amplitude = 0.3, period = 2.0 }}
"""


@pytest.mark.parametrize("method", ["radau", "ida"])
def test_a_load_hauled_over_a_bar_in_the_steady_state(method: str) -> None:
    """One side is driven up and down, another body swings beside it: up the load comes with
    T2 = E T1, down it sinks with T1 = E T2, and the rope sticks at the turns."""
    text = heaving({"load": (40.0, (RADIUS, 0.0, DOWN))}) + DRIVEN + BESIDE
    text += rope(
        '["float", "ground", "load"]',
        "stiffness = 2e5\ndamping = 2e3\npretension = 392.4\nfriction = [0.08]",
    )
    run = run_text(text, 6.0, method=method, rtol=1e-7)
    one, two = tensions(run).T
    v, grip = slip(run).ravel(), math.exp(0.08 * math.pi)
    for way, hauled, loose in ((1.0, two, one), (-1.0, one, two)):
        slips = np.sign(v) == way
        assert slips.sum() > 100
        assert hauled[slips] == pytest.approx(grip * loose[slips], rel=1e-9)
    assert (v == 0.0).sum() > 20
    power = run["forces/rope/friction_power"].values
    assert (power <= 0.0).all()
    assert power.sum() * 0.01 < -10.0
    assert np.abs(run["energy/balance_error"].values).max() < 1e-3


def test_radau_ida_and_explicit_rk_agree() -> None:
    text = atwood(0.05, "stiffness = 5e4\ndamping = 500.0\npretension = 90.0")
    runs = [run_text(text, 1.0, method=method, rtol=1e-9) for method in METHODS]
    for run in runs[1:]:
        for body in ("light", "heavy"):
            assert height_of(run, body) == pytest.approx(height_of(runs[0], body), abs=1e-7)
        assert tensions(run) == pytest.approx(tensions(runs[0]), abs=1e-3)


def test_a_run_goes_on_from_a_state_as_if_it_had_not_stopped() -> None:
    text = atwood(0.1, "stiffness = 5e4\npretension = 60.0")
    text += "[solver]\nend_time = 1.0\n[output]\nstep = 0.1\n"
    one, two = (hydrodae.Simulation(hydrodae.Case.from_text(text)) for _ in range(2))
    while one.time < 0.7:
        one.advance(0.7)
    two.restore(one.state())
    for run in (one, two):
        while not run.finished:
            run.advance()
    assert two.read("bodies/light/position.z") == one.read("bodies/light/position.z")
    assert two.read("forces/rope/friction_power") == one.read("forces/rope/friction_power")


@pytest.mark.parametrize("keys", ["friction = [0.0]", "friction = [0.0, 0.0, 0.0]"])
def test_a_rope_without_friction_is_as_before(keys: str) -> None:
    plain = rope('["light", "ground", "heavy"]', "stiffness = 5e4")
    runs = [run_text(two_masses(M_1, M_2) + plain + more, 0.2) for more in ("", keys + "\n")]
    for name in ("forces/rope/tension", "bodies/light/position"):
        assert (runs[0][name].values == runs[1][name].values).all()
    assert runs[0].statistics["unknowns"] == runs[1].statistics["unknowns"]
    assert "forces/rope/slip" not in runs[0]


def test_at_rest_it_has_run_to_one_tension() -> None:
    """The equilibrium is that without friction, from where the run does not move."""
    text = heaving({"load": (M_1, (RADIUS, 0.0, DOWN))})
    text += rope('["ground", "ground", "load"]', "stiffness = 5e4\nfriction = [0.3]")
    text += '[solver]\nend_time = 0.5\nstart = "equilibrium"\n[output]\nstep = 0.01\n'
    run = hydrodae.run(hydrodae.Case.from_text(text))
    assert tensions(run) == pytest.approx(M_1 * G, rel=1e-6)
    assert (slip(run) == 0.0).all()
    stretch = M_1 * G / 5e4 * (-2.0 * DOWN + math.pi * RADIUS)
    height = run["bodies/load/position"].values[:, 2] - DOWN
    assert height == pytest.approx(-stretch, rel=1e-6)
    assert "friction of ropes ('rope') is left out of the equilibrium" in run.summary()
    E = math.exp(0.3 * math.pi)
    assert run["forces/rope/grip"].values == pytest.approx(E, rel=1e-6)
    rest = hydrodae.equilibrium(hydrodae.Case.from_text(text))
    assert rest.bands["rope"] == pytest.approx((M_1 * G / E, M_1 * G * E), rel=1e-6)
    assert f"friction holds {M_1 * G / E:.1f} to {M_1 * G * E:.1f} N at one end" in str(rest)


def test_a_stop_struck_turns_the_slip_round() -> None:
    """The heavier mass falls on a stop and rebounds while the rope slips over the bar; work in =
    gain + what friction and impacts take, and friction never gives."""
    text = heaving({"light": (10.0, (-RADIUS, 0.0, DOWN))})
    text += f"""
[[body]]
name = "heavy"
mass = 25.0
inertia = [1.0, 1.0, 1.0]
center_of_gravity = [{RADIUS}, 0.0, {DOWN}]
[[joint]]
name = "rail"
type = "prismatic"
body_a = "ground"
body_b = "heavy"
point = [{RADIUS}, 0.0, {DOWN}]
axis = [0.0, 0.0, 1.0]
[[constraint]]
name = "floor"
type = "stop"
joint = "rail"
lower = -0.3
restitution = 0.5
"""
    keys = "stiffness = 1e5\ndamping = 1e3\npretension = 98.1\nfriction = [0.2]"
    text += rope('["light", "ground", "heavy"]', keys)
    runs = [run_text(text, 1.2, method=method, rtol=1e-6) for method in ("radau", "explicit_rk")]
    for run in runs:
        assert run["forces/rope/friction_power"].values.max() <= 0.0
        assert slip(run).min() < -0.1 < 0.5 < slip(run).max()
        assert float(run.statistics["relative_balance_error"]) < 1e-5
    places = [run["bodies/light/position"].values[:, 2] for run in runs]
    assert places[0] == pytest.approx(places[1], abs=1e-4)


def test_a_rope_that_rubs_parts_at_its_larger_tension() -> None:
    load = 1.1 * M_2 * G
    text = atwood(0.1, f"stiffness = 5e4\nbreaking_load = {load}\nbreaks = true\npretension = 60.0")
    run = run_text(text, 1.0)
    at = run["forces/rope/parted_at"].values[-1]
    assert 0.0 < at < 1.0
    assert run["forces/rope/tension"].values.max() <= load
    assert (tensions(run)[run.time > at] == 0.0).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ("friction = [0.1, 0.2]", "one entry for each of the points"),
        ("friction = [0.1, 0.2, 0.0]", "the ends of a rope are held"),
        ("friction = [-0.1]", "friction"),
        ("friction = [20.0]", "5 at most"),
    ],
)
def test_bad_friction_is_refused(change: str, message: str) -> None:
    text = two_masses(M_1, M_2) + rope('["light", "ground", "heavy"]', f"stiffness = 1e4\n{change}")
    with pytest.raises(CaseError, match=message):
        run_text(text, 0.1)


@pytest.mark.parametrize("aside", [0.0, 1e-3])
@pytest.mark.parametrize("masses", [(12.0, 10.0), (10.0, 12.0)])
def test_a_rope_turned_back_by_180_degrees_keeps_its_friction(
    masses: tuple[float, float], aside: float
) -> None:
    """Both parts hang side by side: phi = pi, and e^(0.2 pi) = 1.87 holds 1.2; at half the friction
    it slides at a = (m2 - E m1) g / (m2 + E m1)."""
    points = [[0.0, 0.0, 4.0], [0.0, 0.0, 10.0], [aside, 0.0, 3.97]]
    text = f"[environment]\ngravity = {G}\n"
    for name, mass, place in zip("ab", masses, [points[0], points[2]], strict=True):
        text += f'[[body]]\nname = "{name}"\nmotion = "point"\nmass = {mass}\n'
        text += f"center_of_gravity = {place}\n"
    keys = "stiffness = 4e4\nlength = 12.0\ndamping = 4e3\nfriction = [0, {}, 0]"
    over = f"points = {points}\n"
    held = run_text(text + rope('["a", "ground", "b"]', keys.format(0.2), over), 2.0)
    assert held["forces/rope/wrap"].values.ravel() == pytest.approx(math.pi, abs=1e-3)
    grip = np.asarray(held["forces/rope/grip"].values).ravel()
    assert grip == pytest.approx(math.exp(0.2 * math.pi), rel=1e-3)
    assert np.abs(height_of(held, "a") + height_of(held, "b")).max() < 0.05
    assert np.abs(slip(held)[held.time > 1.0]).max() == 0.0
    light, heavy = min(masses), max(masses)
    E = math.exp(0.02 * math.pi)
    loose = run_text(text + rope('["a", "ground", "b"]', keys.format(0.02), over), 0.8)
    late = (loose.time > 0.4) & (loose.time < 0.7)
    v = np.abs(velocity(loose, "a"))
    fall = np.polyfit(loose.time[late], v[late], 1)[0]
    assert fall == pytest.approx(G * (heavy - E * light) / (heavy + E * light), rel=0.02)
