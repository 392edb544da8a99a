"""Springs, power take-offs, end stops, friction and ropes against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.frequency import LinearModel

METHODS = ["ida", "radau", "explicit_rk"]
G = 9.81

BLOCK = """
[environment]
gravity = 0.0
[[body]]
name = "block"
motion = "surge"
mass = MASS
center_of_gravity = [0.0, 0.0, 0.0]
initial = { displacement = [START, 0.0, 0.0], velocity = [SPEED, 0.0, 0.0] }
[[joint]]
name = "slide"
type = "prismatic"
body_a = "ground"
body_b = "block"
point = [0.0, 0.0, 0.0]
axis = [1.0, 0.0, 0.0]
"""


def block(
    forces: str,
    end: float,
    *,
    mass: float = 2.0,
    start: float = 0.0,
    speed: float = 0.0,
    method: str = "radau",
    rtol: float = 1e-8,
    step: float = 0.01,
    extra: str = "",
) -> hydrodae.Results:
    """Run a block on a slide under these forces."""
    text = (
        BLOCK.replace("MASS", str(mass)).replace("START", str(start)).replace("SPEED", str(speed))
    )
    text += forces + f'[solver]\nend_time = {end}\nmethod = "{method}"\nrtol = {rtol}\n{extra}\n'
    return hydrodae.run(hydrodae.Case.from_text(text + f"[output]\nstep = {step}\n"))


def heaving(masses: dict[str, tuple[float, tuple[float, float, float]]]) -> str:
    """Point masses that can only heave."""
    out = f"[environment]\ngravity = {G}\n"
    for name, (mass, place) in masses.items():
        out += f'[[body]]\nname = "{name}"\nmotion = "heave"\nmass = {mass}\n'
        out += f"center_of_gravity = {list(place)}\n"
    return out


def run_text(
    text: str, end: float, *, method: str = "radau", rtol: float = 1e-9, step: float = 0.01
) -> hydrodae.Results:
    """Run a case of this text."""
    text += (
        f'[solver]\nend_time = {end}\nmethod = "{method}"\nrtol = {rtol}\n[output]\nstep = {step}\n'
    )
    return hydrodae.run(hydrodae.Case.from_text(text))


def height_of(run: hydrodae.Results, body: str) -> np.ndarray:
    """How far a body has risen."""
    z = np.asarray(run[f"bodies/{body}/position"].values[:, 2], dtype=float)
    return z - float(z[0])


# Springs


def test_hardening_spring_keeps_its_energy() -> None:
    """m v^2 / 2 + k d^2 / 2 + k2 d^3 / 3 + k3 d^4 / 4 is constant."""
    spring = """
[[force]]
type = "spring_damper"
name = "spring"
body_a = "ground"
body_b = "block"
point_a = [-1.0, 0.0, 0.0]
point_b = [0.0, 0.0, 0.0]
stiffness = 20.0
hardening = [5.0, 40.0]
"""
    run = block(spring, 5.0, start=0.6)
    d = run["joints/slide/displacement"].values
    v = run["joints/slide/displacement_rate"].values
    potential = 10.0 * d**2 + 5.0 / 3.0 * d**3 + 10.0 * d**4
    energy = v**2 + potential
    assert np.ptp(energy) < 1e-6 * energy[0]
    assert run["energy/potential"].values == pytest.approx(potential, abs=1e-6)


def test_a_spring_that_pushes_away_has_two_places_of_rest() -> None:
    """f = k d - k3 d^3 with k = 8, k3 = 200: rest at d = 0.2; small swings of 2 k / m."""
    spring = """
[[force]]
type = "spring_damper"
name = "snap"
body_a = "ground"
body_b = "block"
point_a = [-1.0, 0.0, 0.0]
point_b = [0.0, 0.0, 0.0]
stiffness = -8.0
hardening = [0.0, 200.0]
"""
    omega = math.sqrt(16.0 / 2.0)
    run = block(spring, 2.0 * math.pi / omega, start=0.2001, step=2.0 * math.pi / omega / 64)
    d = run["joints/slide/displacement"].values
    assert d[32] == pytest.approx(0.1999, abs=2e-7)
    assert d[-1] == pytest.approx(0.2001, abs=2e-7)


def test_a_curve_goes_through_its_points() -> None:
    """Driven along it, the load at each point is that of the table, and beyond it straight on."""
    spring = """
[[force]]
type = "spring_damper"
name = "spring"
body_a = "ground"
body_b = "block"
point_a = [-1.0, 0.0, 0.0]
point_b = [0.0, 0.0, 0.0]
curve_at = [-0.2, 0.0, 0.1, 0.3]
curve_force = [-30.0, 0.0, 5.0, 35.0]
[[constraint]]
name = "drive"
type = "coordinate"
joint = "slide"
drive = { constant = -0.4, rate = 0.1 }
"""
    run = block(spring, 8.0, start=-0.4, speed=0.1, step=1.0)
    force = run["forces/spring/force"].values
    at = run["joints/slide/displacement"].values
    expected = {-0.4: 60.0, -0.3: 45.0, -0.2: 30.0, 0.0: 0.0, 0.1: -5.0, 0.3: -35.0, 0.4: -50.0}
    for place, load in expected.items():
        k = int(np.argmin(abs(at - place)))
        assert force[k] == pytest.approx(load, abs=1e-6), place
    slope = np.diff(-force) / np.diff(at)
    assert (slope > 0.0).all()  # monotone between them


# Power take-offs

GENERAL = """
[[force]]
type = "pto_general"
name = "pto"
joint = "slide"
damping = 300.0
exponent = 2.0
constant = 20.0
reversal_rate = 1e-3
stiffness = 50.0
load_limit = 150.0
power_limit = 80.0
efficiency = 0.8
motor_efficiency = 0.9
[[constraint]]
name = "drive"
type = "coordinate"
joint = "slide"
drive = { amplitude = 0.5, period = 4.0 }
"""


@pytest.mark.parametrize("method", METHODS)
def test_power_take_off_within_its_limits(method: str) -> None:
    run = block(GENERAL, 8.0, method=method, speed=0.5 * math.pi / 2.0, rtol=1e-6)
    s = run["joints/slide/displacement"].values
    v = run["joints/slide/displacement_rate"].values
    raw = -50.0 * s - 300.0 * abs(v) * v - 20.0 * v / np.sqrt(v**2 + 1e-6)
    limit = np.minimum(150.0, 80.0 / np.maximum(abs(v), 1e-9))
    force = run["forces/pto/force"].values
    assert force == pytest.approx(np.clip(raw, -limit, limit), abs=1e-6)
    power = run["forces/pto/power_absorbed"].values
    assert power == pytest.approx(-force * v, abs=1e-6)
    assert power.max() == pytest.approx(80.0, rel=1e-6)
    assert power.min() < -0.1  # the spring gives some back
    electric = run["forces/pto/electric_power"].values
    assert electric == pytest.approx(np.where(power > 0, 0.8 * power, power / 0.9), abs=1e-6)


def test_rotary_power_take_off_damps_each_axis() -> None:
    """Slow spins of a ball with I = 2 in dampers c: w = w0 exp(-c t / I), each by itself."""
    text = """
[environment]
gravity = 0.0
[[body]]
name = "ball"
mass = 1.0
inertia = [2.0, 2.0, 2.0]
center_of_gravity = [0.0, 0.0, 0.0]
initial = { angular_velocity = [0.0, 0.3, 0.0] }
[[joint]]
name = "ball"
type = "spherical"
body_a = "ground"
body_b = "ball"
point = [0.0, 0.0, 0.0]
[[force]]
type = "pto_rotary"
name = "pto"
body_a = "ground"
body_b = "ball"
damping = [0.5, 1.0, 0.0]
"""
    run = run_text(text, 4.0)
    w = run["bodies/ball/angular_velocity"].values[:, 1]
    assert w == pytest.approx(0.3 * np.exp(-run.time / 2.0), abs=1e-8)
    power = run["forces/pto/power_absorbed"].values
    assert power == pytest.approx(1.0 * w**2, abs=1e-9)
    assert "power_absorbed" in str(run.summary()) or run.statistics is not None


def test_a_force_acts_on_the_coordinate_that_it_names() -> None:
    text = """
[environment]
gravity = 0.0
[[body]]
name = "nut"
mass = 2.0
inertia = [2.0, 2.0, 3.0]
center_of_gravity = [0.0, 0.0, 0.0]
initial = { velocity = [0.0, 0.0, 1.0], angular_velocity = [0.0, 0.0, 1.0] }
[[joint]]
name = "rod"
type = "cylindrical"
body_a = "ground"
body_b = "nut"
point = [0.0, 0.0, 0.0]
axis = [0.0, 0.0, 1.0]
[[force]]
type = "pto_linear"
name = "brake"
joint = "rod"
COORDINATE
damping = 3.0
"""
    run = run_text(text.replace("COORDINATE", 'coordinate = "angle"'), 2.0)
    assert run["joints/rod/displacement_rate"].values[-1] == pytest.approx(1.0, abs=1e-8)
    assert run["joints/rod/angle_rate"].values[-1] == pytest.approx(math.exp(-2.0), abs=1e-7)
    assert run["forces/brake/torque"].attrs["unit"] == "N m"
    with pytest.raises(CaseError, match="more than one coordinate"):
        run_text(text.replace("COORDINATE", ""), 1.0)
    with pytest.raises(CaseError, match="angle"):
        run_text(text.replace("COORDINATE", 'coordinate = "angel"'), 1.0)


def test_a_power_take_off_along_a_distance() -> None:
    """Between a ball joint and the ground a telescope turns and gets longer: c s' along it."""
    text = """
[environment]
gravity = 0.0
[[body]]
name = "mass"
motion = ["surge", "sway", "heave"]
mass = 2.0
center_of_gravity = [3.0, 0.0, 4.0]
initial = { velocity = [1.0, 2.0, 0.5] }
[[joint]]
name = "ram"
type = "telescope"
body_a = "ground"
body_b = "mass"
point = [0.0, 0.0, 0.0]
point_b = [3.0, 0.0, 4.0]
[[force]]
type = "pto_linear"
name = "pto"
joint = "ram"
damping = 4.0
stiffness = 3.0
neutral = 5.0
"""
    run = run_text(text, 5.0)
    place, velocity = run["bodies/mass/position"].values, run["bodies/mass/velocity"].values
    distance = np.linalg.norm(place, axis=1)
    rate = np.sum(place * velocity, axis=1) / distance
    assert run["joints/ram/displacement"].values == pytest.approx(distance, abs=1e-9)
    force = run["forces/pto/force"].values
    assert force == pytest.approx(-3.0 * (distance - 5.0) - 4.0 * rate, abs=1e-6)
    assert run["forces/pto/power_absorbed"].values == pytest.approx(-force * rate, abs=1e-6)
    momentum = 2.0 * np.cross(place, velocity)
    assert np.ptp(momentum, axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=1e-7)


# End stops

STOP = """
[[force]]
type = "end_stop"
name = "stop"
joint = "slide"
upper = 0.0
"""


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
    force = f"{STOP}stiffness = {k}\nexponent = 1.0\nviscous = {2.0 * zeta * omega * m}\n"
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
    force = f"{STOP}stiffness = 1e5\nexponent = {exponent}\ndamping = {d}\n"
    run = block(force, 0.5, mass=10.0, start=-0.05, speed=v)
    assert run["joints/slide/displacement_rate"].values[-1] == pytest.approx(-low, rel=1e-6)


def test_a_stop_with_a_width_stores_what_it_gives_back() -> None:
    force = f"{STOP}stiffness = 2e4\nexponent = 1.0\nwidth = 0.02\n"
    run = block(force, 0.4, mass=10.0, start=-0.05, speed=1.0, step=0.001)
    total = run["energy/total"].values
    assert np.ptp(total) < 1e-6 * total[0]
    assert run["joints/slide/displacement_rate"].values[-1] == pytest.approx(-1.0, rel=1e-7)
    with pytest.raises(CaseError, match="needs 'lower' or 'upper'"):
        block(STOP.replace("upper = 0.0", "stiffness = 1.0"), 1.0)


# Friction


@pytest.mark.parametrize("method", METHODS)
def test_smooth_friction_slides_by_its_curve_and_creeps(method: str) -> None:
    rail = """
[[force]]
type = "friction_stribeck"
name = "rail"
joint = "slide"
static = 12.0
kinetic = 8.0
stribeck_rate = 0.05
creep_rate = 1e-4
viscous = 3.0
"""
    for rate in (0.01, 0.1):
        drive = '[[constraint]]\nname = "drive"\ntype = "coordinate"\njoint = "slide"\n'
        run = block(rail + drive + f"drive = {{ rate = {rate} }}\n", 1.0, speed=rate, method=method)
        curve = (8.0 + 4.0 * math.exp(-((rate / 0.05) ** 2))) * rate / math.hypot(rate, 1e-4)
        assert run["forces/rail/force"].values[-1] == pytest.approx(-curve - 3.0 * rate, rel=1e-6)
    push = '[[force]]\ntype = "constant_load"\nname = "push"\nbody = "block"\nforce = [6.0, 0, 0]\n'
    run = block(rail + push, 5.0, method=method, rtol=1e-6)
    creep = run["joints/slide/displacement_rate"].values[-1]
    assert creep == pytest.approx(1e-4 * 0.5 / math.sqrt(0.75), rel=1e-2)


# Ropes


@pytest.mark.parametrize("method", METHODS)
def test_elastic_atwood_machine(method: str) -> None:
    """T = T0 (1 - cos W t), W^2 = k (1 / m1 + 1 / m2), from rest and unstretched."""
    text = (
        heaving({"light": (10.0, (0.0, 0.0, -3.0)), "heavy": (15.0, (0.0, 0.0, -3.0))})
        + """
[[force]]
type = "rope"
name = "rope"
bodies = ["light", "ground", "heavy"]
points = [[0.0, 0.0, -3.0], [0.0, 0.0, 0.0], [0.0, 0.0, -3.0]]
stiffness = 50000.0
"""
    )
    run = run_text(text, 1.0, method=method)
    t = run.time
    k = 50000.0 / 6.0
    omega = math.sqrt(k * (1.0 / 10.0 + 1.0 / 15.0))
    mean = 2.0 * 10.0 * 15.0 / 25.0 * G
    tension = mean * (1.0 - np.cos(omega * t))
    assert run["forces/rope/tension"].values == pytest.approx(tension, abs=1e-4 * mean)
    a = 5.0 / 25.0 * G
    fall = 0.5 * a * t**2 + mean / (15.0 * omega**2) * (1.0 - np.cos(omega * t))
    assert -height_of(run, "heavy") == pytest.approx(fall, abs=1e-6)


def test_tackle_of_two_to_one() -> None:
    """Over a loose pulley both parts pull: B falls with a = g (mB - 2 mA) / (mB + 4 mA)."""
    text = (
        heaving({"A": (10.0, (0.0, 0.0, -5.0)), "B": (30.0, (0.0, 0.0, -2.0))})
        + """
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "B", "ground", "A"]
points = [[0.0, 0.0, 0.0], [0.0, 0.0, -2.0], [0.0, 0.0, 0.0], [0.0, 0.0, -5.0]]
stiffness = 1e7
damping = 2e4
"""
    )
    run = run_text(text, 1.0)
    a = G * (30.0 - 20.0) / (30.0 + 40.0)
    assert -height_of(run, "B")[-1] == pytest.approx(0.5 * a, rel=1e-3)
    assert height_of(run, "A")[-1] == pytest.approx(a, rel=1e-3)
    assert run["forces/rope/tension"].values[-1] == pytest.approx(10.0 * (G + 2.0 * a), rel=1e-3)


@pytest.mark.parametrize(
    ("stiffness", "depth", "in_plane", "across", "vertical"),
    [
        (2000.0, 2.8128403162881224, 1.5219956549417675, 1.8675058228462948, 4.345488622293993),
        (10000.0, 2.3638000092302365, 1.55519924524773, 2.0371787562093453, 8.912748790677249),
    ],
)
def test_ring_on_a_rope(
    stiffness: float, depth: float, in_plane: float, across: float, vertical: float
) -> None:
    """A ring that slides on a rope between two points: statics and the three frequencies."""
    text = f"""
[environment]
gravity = {G}
[[body]]
name = "ring"
motion = ["surge", "sway", "heave"]
mass = 50.0
center_of_gravity = [0.0, 0.0, -2.5]
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "ring", "ground"]
points = [[-2.0, 0.0, 0.0], [0.0, 0.0, -2.5], [2.0, 0.0, 0.0]]
stiffness = {stiffness}
length = 6.0
[solver]
end_time = 1.0
"""
    case = hydrodae.Case.from_text(text)
    found = sorted(2.0 * math.pi / mode.period for mode in LinearModel(case).modes())
    assert found == pytest.approx(sorted([in_plane, across, vertical]), rel=1e-6)
    rest = hydrodae.equilibrium(case)
    assert rest.offsets["ring"][2] == pytest.approx(2.5 - depth, abs=1e-8)


def test_winch_gives_the_energy_that_is_there_in_the_end() -> None:
    text = (
        heaving({"load": (20.0, (0.0, 0.0, -10.0))})
        + """
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "load"]
points = [[0.0, 0.0, 0.0], [0.0, 0.0, -10.0]]
stiffness = 1e5
damping = 500.0
winch_time = [0.0, 40.0, 42.0, 44.0, 100.0]
winch_length = [9.98038, 9.98038, 8.5, 7.0, 7.0]
"""
    )
    run = run_text(text, 60.0, step=0.005)
    rise = height_of(run, "load")
    assert abs(rise[run.time < 39.0]).max() < 1e-3  # nothing moves before
    assert rise[-1] == pytest.approx(9.98038 - 7.0, abs=0.01)
    winch = np.trapezoid(run["forces/rope/winch_power"].values, run.time)
    tension = run["forces/rope/tension"].values
    length = run["forces/rope/length"].values
    speed = run["bodies/load/velocity"].values[:, 2]
    # The rope's own share: what it stores and what its damping takes.
    stored = 0.5 * tension**2 / 1e5 * 7.0
    given = 20.0 * G * rise[-1] + 10.0 * speed[-1] ** 2 + stored[-1] - stored[0]
    assert winch == pytest.approx(given, rel=5e-3)
    assert length[0] == pytest.approx(10.0, abs=1e-9)


def test_a_rope_does_not_push() -> None:
    """A mass thrown up on a slack rope flies freely until the rope is taut."""
    text = heaving({"load": (2.0, (0.0, 0.0, -1.0))}).replace(
        "mass = 2.0", "mass = 2.0\ninitial = { velocity = [0.0, 0.0, 3.0] }"
    )
    text += """
[[force]]
type = "rope"
name = "rope"
bodies = ["ground", "load"]
points = [[0.0, 0.0, 2.0], [0.0, 0.0, -1.0]]
stiffness = 1e4
length = 3.2
"""
    run = run_text(text, 0.5)
    rise = height_of(run, "load")
    assert rise == pytest.approx(3.0 * run.time - 0.5 * G * run.time**2, abs=1e-9)
    assert run["forces/rope/tension"].values.max() == 0.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ('bodies = ["ground", "lode"]', "load"),
        ('bodies = ["ground"]', "as many names in 'bodies'"),
        ('bodies = ["ground", "ground"]', "acts on the ground only"),
    ],
)
def test_bad_ropes_are_refused(change: str, message: str) -> None:
    text = (
        heaving({"load": (2.0, (0.0, 0.0, -1.0))})
        + f"""
[[force]]
type = "rope"
name = "rope"
{change}
points = [[0.0, 0.0, 2.0], [0.0, 0.0, -1.0]]
stiffness = 1e4
"""
    )
    with pytest.raises(CaseError, match=message):
        run_text(text, 0.5)


# Loads that follow the time by themselves


@pytest.mark.parametrize("method", METHODS)
def test_a_late_pulse_of_a_python_load_is_not_stepped_over(method: str) -> None:
    """After 80 s of rest a pulse of 0.2 s gives the block its momentum."""
    load = '[[force]]\ntype = "python_load"\nname = "kick"\njoint = "slide"\n'
    text = BLOCK.replace("MASS", "2.0").replace("START", "0.0").replace("SPEED", "0.0") + load
    text += f'[solver]\nend_time = 100.0\nmethod = "{method}"\n[output]\nstep = 0.1\n'

    def pulse(t: float, s: float, rate: float) -> float:
        return 10.0 * math.exp(-(((t - 80.0) / 0.2) ** 2))

    run = hydrodae.run(hydrodae.Case.from_text(text), forces={"kick": pulse})
    impulse = 10.0 * 0.2 * math.sqrt(math.pi)
    rate = run["joints/slide/displacement_rate"].values
    assert rate[-1] == pytest.approx(impulse / 2.0, rel=1e-4)
    assert abs(rate[: int(78.0 / 0.1)]).max() < 1e-9


def test_a_body_may_not_have_the_name_of_a_channel() -> None:
    """`check` refuses it as `run` does, since forces/kick/force is taken."""
    text = BLOCK.replace("MASS", "2.0").replace("START", "0.0").replace("SPEED", "0.0")
    text = text.replace('"block"', '"force"')
    text += '[[force]]\ntype = "pto_linear"\nname = "pto"\njoint = "slide"\ndamping = 1.0\n'
    case = hydrodae.Case.from_text(text + "[solver]\nend_time = 1.0\n")
    for look in (hydrodae.run, hydrodae.check):
        with pytest.raises(CaseError, match="name of a channel"):
            look(case)
