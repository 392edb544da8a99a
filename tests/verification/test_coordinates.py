"""Joint coordinates against the coordinates of all bodies: the same motion, loads and reactions."""

from __future__ import annotations

from pathlib import Path

import h5py
import numpy as np
import pytest
from tests.errors import wrong

import hydrodae

REDUCED = {"solver.coordinates": "reduced"}
SOLVER = """
[solver]
method = "explicit_rk"
end_time = {end}
rtol = 1e-9
[output]
step = 0.05
"""
BODY = """
[[body]]
name = "{name}"
mass = {mass}
center_of_gravity = {at}
inertia = [0.4, 0.9, 0.6]
products_of_inertia = [0.05, -0.03, 0.08]
{more}
"""
JOINT = """
[[joint]]
name = "{name}"
type = "{kind}"
body_a = "{a}"
body_b = "{b}"
point = {point}
{more}
"""
SPRING = """
[[force]]
name = "hold_{name}"
type = "spring_damper"
body_a = "ground"
body_b = "{name}"
point_a = [0.2, 0.4, 1.5]
point_b = [0.4, 0.0, 0.0]
stiffness = 60.0
damping = 2.0
length = 1.0
"""
AXIS = "axis = [0.3, 0.9, 0.2]\naxis_x = [0.9, -0.3, 0.0]\n"
KINDS = {
    "spherical": "",
    "revolute": AXIS,
    "prismatic": AXIS,
    "fixed": "",
    "universal": AXIS,
    "cylindrical": AXIS,
    "planar": AXIS,
    "sliding": AXIS,
    "screw": AXIS + "pitch = 0.7\n",
}


def joint(name: str, kind: str, a: str, b: str, point: object, more: str = "") -> str:
    return JOINT.format(name=name, kind=kind, a=a, b=b, point=point, more=more)


def compare(
    bodies: hydrodae.Results,
    reduced: hydrodae.Results,
    tolerance: float,
    leave: str = "",
    least: float = 1e-3,
) -> None:
    """Every channel but those of the solver, and energies that are nothing but rounding.

    Sizes are those of the largest channel of a kind, `least` at least.
    """
    assert list(bodies) == list(reduced)
    names = [n for n in bodies if not n.startswith(("solver/", "energy/"))]
    with h5py.File(bodies.path) as one, h5py.File(reduced.path) as other:
        values = {name: one[name][:] for name in names}
        others = {name: other[name][:] for name in names}
    sizes: dict[str, float] = {}
    for name in names:
        kind = name.rsplit("/", 1)[-1]
        sizes[kind] = max(sizes.get(kind, least), float(np.abs(values[name]).max()))
    for name in names:
        if leave and leave in name:
            continue
        difference = float(np.abs(values[name] - others[name]).max())
        assert difference <= tolerance * sizes[name.rsplit("/", 1)[-1]], name


def both(
    case: hydrodae.Case, tolerance: float = 1e-6, leave: str = "", least: float = 1e-3
) -> tuple[hydrodae.Results, hydrodae.Results]:
    bodies, reduced = hydrodae.run(case), hydrodae.run(case, set=REDUCED)
    compare(bodies, reduced, tolerance, leave, least)
    return bodies, reduced


def text_case(text: str, end: float) -> hydrodae.Case:
    return hydrodae.Case.from_text(text + SOLVER.format(end=end))


def tell(results: hydrodae.Results) -> str:
    [note] = [note for note in results.notes if note.startswith("reduced coordinates")]
    return note


@pytest.mark.parametrize("kind", KINDS)
def test_joints_carry_bodies_both_ways(kind: str) -> None:
    """From the ground to one body, and on to the body A of a joint whose body B that is."""
    spin = "initial.angular_velocity = [0.4, -0.3, 0.5]" if kind == "spherical" else ""
    text = BODY.format(name="one", mass=2.0, at=[0.3, -0.2, 0.1], more=spin)
    text += BODY.format(name="two", mass=3.0, at=[0.9, 0.1, -0.4], more="")
    text += joint("first", kind, "ground", "one", [0.1, 0.0, 0.2], KINDS[kind])
    text += joint("second", kind, "two", "one", [0.6, 0.2, -0.1], KINDS[kind])
    text += SPRING.format(name="one") + SPRING.format(name="two")
    _, reduced = both(text_case(text, 1.0))
    assert " 0 of " in tell(reduced)


def test_a_tree_floats_freely() -> None:
    """No ground, gravity or spring: momentum is kept; the middle of the chain is the root."""
    text = "[environment]\ngravity = 0.0\n"
    spin = {"one": "initial.angular_velocity = [1.0, 2.0, 0.5]"}
    for k, name in enumerate(("one", "two", "three", "four")):
        text += BODY.format(name=name, mass=k + 1.0, at=[k, 0.0, 0.2 * k], more=spin.get(name, ""))
    text += joint("first", "spherical", "one", "two", [0.5, 0.0, 0.0])
    text += joint("second", "universal", "two", "three", [1.5, 0.0, 0.3], AXIS)
    text += joint("third", "revolute", "three", "four", [2.5, 0.1, 0.4], AXIS)
    _, reduced = both(text_case(text, 1.0))
    assert "12 velocities in place of 24, 0 of 12" in tell(reduced)
    masses = {name: k + 1.0 for k, name in enumerate(("one", "two", "three", "four"))}
    momentum = sum(m * np.asarray(reduced[f"bodies/{n}/velocity"]) for n, m in masses.items())
    assert np.ptp(momentum, axis=0).max() < 1e-8


def test_planar_bodies_turn_over_and_over() -> None:
    """Angles of locked bodies go on over turns: a windmill and a pendulum on its rim."""
    planar = 'motion = "planar"\ninitial.angular_velocity = [0.0, 9.0, 0.0]'
    text = BODY.format(name="mill", mass=5.0, at=[0.1, 0.0, 0.0], more=planar)
    text += BODY.format(name="bob", mass=0.5, at=[1.0, 0.0, -0.5], more='motion = "planar"')
    text += joint("axle", "revolute", "ground", "mill", [0, 0, 0], "axis = [0, 1, 0]")
    text += joint("pin", "spherical", "bob", "mill", [1.0, 0.0, 0.0])
    text = text.replace("products_of_inertia = [0.05, -0.03, 0.08]\n", "")
    text += (
        '[[force]]\nname = "wind_up"\ntype = "pto_linear"\njoint = "axle"\n'
        "damping = 0.01\nstiffness = 0.02\n"
    )
    bodies, reduced = both(text_case(text, 3.0))
    assert abs(bodies["joints/axle/angle"].values[-1]) > 3 * np.pi
    assert "2 velocities in place of 6, 0 of 4" in tell(reduced)


def test_a_joint_that_would_break_locks_stays_as_rows() -> None:
    """A planar body on one that moves in space: it has its own coordinates, and multipliers."""
    text = BODY.format(name="flat", mass=1.0, at=[0.0, 0.0, -1.0], more='motion = "planar"')
    text = text.replace("products_of_inertia = [0.05, -0.03, 0.08]\n", "")
    text += BODY.format(name="free", mass=1.0, at=[1.0, 0.0, -1.0], more="")
    text += joint("ball", "spherical", "free", "flat", [0.5, 0.0, -1.0])
    text += joint("cross", "universal", "ground", "free", [1.0, 0.0, 0.0], AXIS)
    _, reduced = both(text_case(text, 1.0))
    assert "5 velocities in place of 9, 3 of 7 constraint rows left ('ball')" in tell(reduced)


@pytest.mark.parametrize("name", ["n_four_bar_2", "slider_crank_equal", "bricard"])
def test_loops_are_cut_and_closed(name: str, repository: Path) -> None:
    """Rows of the joints that close loops stay, those that follow from others do not."""
    case = hydrodae.Case.read(repository / "cases" / "benchmarks" / f"{name}.toml").with_values(
        {
            "solver.method": "explicit_rk",
            "solver.rtol": 1e-9,
            "solver.end_time": 0.4,
            "output.step": 0.05,
        }
    )
    # How redundant rows share a load inside a step depends on rounding, in any coordinates.
    _, reduced = both(case, leave="reaction" if name == "bricard" else "")
    left = {"n_four_bar_2": "5 velocities in place of 15, 4 of 14", "bricard": "4 of 29"}
    assert left.get(name, "") in tell(reduced)


def test_drives_stops_and_friction_act() -> None:
    """Rows that come and go: a driven crank throws a slide that sticks, slips and strikes."""
    text = BODY.format(name="arm", mass=2.0, at=[0.5, 0.0, 0.0], more="")
    text += BODY.format(name="slide", mass=1.0, at=[0.6, 0.0, 0.0], more="")
    text += joint("axle", "revolute", "ground", "arm", [0, 0, 0], "axis = [0, 1, 0]")
    text += joint("rail", "prismatic", "arm", "slide", [0.6, 0, 0], "axis = [1, 0, 0]")
    text += (
        '[[constraint]]\nname = "motor"\ntype = "coordinate"\njoint = "axle"\n'
        "drive = { amplitude = 0.8, period = 1.0 }\n"
        '[[constraint]]\nname = "end"\ntype = "stop"\njoint = "rail"\n'
        "upper = 0.2\nlower = -0.2\nrestitution = 0.5\n"
        '[[force]]\nname = "rub"\ntype = "dry_friction"\njoint = "rail"\n'
        "static = 4.0\nkinetic = 3.0\n"
    )
    bodies, _ = both(text_case(text, 2.0), tolerance=1e-5)
    assert len(bodies.impacts["end"]["time"]) > 0


def test_a_device_in_waves_with_memory(repository: Path) -> None:
    """F3OF afloat: a free base, two flaps, added mass that joins them, memory and excitation."""
    case = hydrodae.Case.read(repository / "cases" / "f3of" / "rao.toml").with_values(
        {
            "solver.method": "explicit_rk",
            "solver.rtol": 1e-8,
            "solver.end_time": 4.0,
            "sea.ramp": 2.0,
        }
    )
    bodies, reduced = both(case, tolerance=1e-5, least=1e-6)
    assert "5 velocities in place of 9, 0 of 4" in tell(reduced)
    for results in (bodies, reduced):
        assert results.statistics["relative_balance_error"] < 1e-6


def test_a_run_goes_on_from_its_state(repository: Path) -> None:
    """A restored run goes on bit for bit."""
    case = hydrodae.Case.read(repository / "cases" / "f3of" / "flap_decay.toml").with_values(
        {**REDUCED, "solver.method": "explicit_rk", "solver.end_time": 4.0}
    )
    simulation = hydrodae.Simulation(case)
    while simulation.time < 2.0:
        simulation.advance(2.0)
    state = simulation.state()
    ends = []
    for _ in range(2):
        simulation.restore(state)
        while not simulation.finished:
            simulation.advance()
        ends.append(np.array(simulation.read("bodies/flap1/velocity")))
    np.testing.assert_array_equal(ends[0], ends[1])


PENDULUM = BODY.format(name="bob", mass=1.0, at=[0, 0, -1], more='motion = "planar"').replace(
    "products_of_inertia = [0.05, -0.03, 0.08]\n", ""
) + joint("hinge", "revolute", "ground", "bob", [0, 0, 0], "axis = [0, 1, 0]")


def test_what_cannot_be_had_is_refused() -> None:
    """By the key, with what to use instead."""
    case = text_case(PENDULUM, 1.0)
    with wrong("solver.coordinates"):
        case.with_values({**REDUCED, "solver.method": "radau"})
    with wrong("solver.coordinates"):
        case.with_values({"solver.coordinates": "joint"})
    rubbed = text_case(
        PENDULUM + '[[force]]\nname = "rub"\ntype = "dry_friction"\njoint = "hinge"\n'
        "static_coefficient = 0.1\nradius = 0.05\n",
        1.0,
    )
    with wrong("solver.coordinates"):
        hydrodae.run(rubbed, set=REDUCED)


def test_auto_takes_the_method_that_knows_them() -> None:
    results = hydrodae.run(
        text_case(PENDULUM, 1.0).with_values({**REDUCED, "solver.method": "auto"})
    )
    assert results.statistics["method_in_use"] == "explicit_rk"


def test_the_energy_guard_looks_inside_steps(repository: Path) -> None:
    """A step that loses energy ends the run by the guard in both coordinates."""
    case = hydrodae.Case.read(repository / "cases" / "benchmarks" / "bricard.toml").with_values(
        {"solver.method": "explicit_rk", "solver.order": 5, "solver.step": 0.2}
    )
    for values in ({}, REDUCED):
        with pytest.raises(hydrodae.SolverError, match="energy"):
            hydrodae.run(case, set={**values, "solver.energy_guard": 1e-6})
