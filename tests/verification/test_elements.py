"""Forces with states, forces between bodies, and forces of one's own, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from tests.attack.parts import Table, body, case, driven
from tests.verification.blocks import METHODS, block, block_case, case_of, run_tables

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel

LUGRE = dict(
    type="friction_lugre",
    name="rail",
    joint="slide",
    static=12.0,
    kinetic=8.0,
    stribeck_rate=0.01,
    bristle_stiffness=1e5,
    bristle_damping=632.4555320336759,
    viscous=3.0,
)
OWN = dict(type="python_load", name="own", joint="slide")


def crank(**drive: float) -> list[Table]:
    return [driven("crank", drive, joint="slide")]


def integral(values: np.ndarray, time: np.ndarray) -> float:
    return float(np.trapezoid(values, time))


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("polytropic", [1.0, 1.4])
def test_hydraulic_power_is_what_the_motor_takes_and_the_gas_stores(
    method: str, polytropic: float
) -> None:
    """A driven piston: absorbed = motor + stored, where the gas stores int p dV."""
    machine: Table = dict(type="pto_hydraulic", name="pto", joint="slide", valve_rate=0.02)
    machine |= dict(area=1e-3, motor_conductance=1e-10, polytropic=polytropic)
    machine |= dict(pressure_high=2e6, pressure_low=5e5, volume_high=1e-3, volume_low=2e-3)
    moves = crank(amplitude=0.3, period=2.0)
    speed = 0.3 * np.pi  # of the drive at t = 0
    results = block(machine, 6.0, method=method, step=0.001, speed=speed, constraint=moves)
    pto = {
        name: results[f"forces/pto/{name}"].values
        for name in ("force", "power_absorbed", "pressure_high", "pressure_low", "motor_power")
    }
    time = results["forces/pto/force"].time.values
    high, low = pto["pressure_high"], pto["pressure_low"]
    stored = 0.0
    for p, p0, v0 in ((high, 2e6, 1e-3), (low, 5e5, 2e-3)):
        volume = v0 * (p0 / p) ** (1.0 / polytropic)
        stored -= integral(p, volume)  # the gas pushes back as it expands
    absorbed, motor = integral(pto["power_absorbed"], time), integral(pto["motor_power"], time)
    assert motor > 0.3 * absorbed
    assert absorbed == pytest.approx(motor + stored, rel=2e-5)
    # The fluid goes from one accumulator to the other.
    gas = sum(
        v0 * (p0 / p) ** (1.0 / polytropic) for p, p0, v0 in ((high, 2e6, 1e-3), (low, 5e5, 2e-3))
    )
    assert np.ptp(gas) < 1e-7 * 3e-3
    rate = results["joints/slide/displacement_rate"].values
    assert pto["force"] == pytest.approx(-1e-3 * (high - low) * np.tanh(rate / 0.02), abs=1e-6)
    assert results["forces/pto/pressure_high"].attrs["unit"] == "Pa"


@pytest.mark.parametrize("method", METHODS)
def test_bristles_slide_by_the_stribeck_curve(method: str) -> None:
    """At a steady rate the load is g(v) + sigma_2 v."""
    for rate in (0.003, 0.02, 0.2):
        moves = crank(rate=rate)
        run = block(LUGRE, 1.0, method=method, rtol=1e-6, step=0.1, speed=rate, constraint=moves)
        force = run["forces/rail/force"].values
        curve = 8.0 + 4.0 * np.exp(-((rate / 0.01) ** 2)) + 3.0 * rate
        assert force[-1] == pytest.approx(-curve, rel=1e-5)


@pytest.mark.parametrize("method", METHODS)
def test_bristles_stick_below_the_static_load(method: str) -> None:
    """Pushed by 6 N the bristles bend by F / sigma_0 and hold; by 14 N the block slips."""
    push = dict(type="constant_load", name="push", body="block", force=[6.0, 0.0, 0.0])
    results = block([LUGRE, push], 5.0, method=method, rtol=1e-6)
    place = results["joints/slide/displacement"].values
    assert results["forces/rail/deflection"].values[-1] == pytest.approx(6.0 / 1e5, rel=1e-4)
    assert place[-1] < 2.0 * 6.0 / 1e5  # it crept while it came to rest
    assert abs(place[-1] - place[-300]) < 1e-7
    push["force"] = [14.0, 0.0, 0.0]
    slipped = block([LUGRE, push], 5.0, method=method, rtol=1e-6)
    rate = slipped["joints/slide/displacement_rate"].values[-1]
    assert rate == pytest.approx(2.0 * (1.0 - np.exp(-7.5)), rel=2e-3)  # 2 v' = 14 - 8 - 3 v


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_bushing_swings_at_its_own_frequencies(method: str, axis: int) -> None:
    """sqrt(k / m) along each axis, sqrt(k / I) about it; large turns about a principal axis too."""
    shift, turn = np.zeros(3), np.zeros(3)
    shift[axis], turn[axis] = 0.1, 60.0
    ends = dict(body_a="ground", body_b="engine", point=[0.0, 0.0, 0.0])
    springs = [900.0, 1600.0, 2500.0, 4.0, 9.0, 16.0]
    hold = dict(stiffness=springs, pretension=[0.0, 0.0, 39.24, 0.0, 0.0, 0.0])
    engine = body("engine", "rigid", 4.0, inertia=[0.4, 0.5, 0.6], displacement=shift)
    engine["initial"]["rotation_deg"] = turn.tolist()
    mount = dict(type="bushing", name="mount", **ends, **hold)
    tables = case([engine], 3.0, forces=[mount], gravity=9.81, samples=300)
    results = run_tables(tables, method=method, rtol=1e-7)
    time = results["forces/mount/displacement"].time.values
    k, k_turn = [900.0, 1600.0, 2500.0][axis], [4.0, 9.0, 16.0][axis]
    inertia = [0.4, 0.5, 0.6][axis]
    place = results["forces/mount/displacement"].values[:, axis]
    angle = results["forces/mount/rotation"].values[:, axis]
    assert place == pytest.approx(0.1 * np.cos(np.sqrt(k / 4.0) * time), abs=2e-5)
    assert angle == pytest.approx(
        np.radians(60.0) * np.cos(np.sqrt(k_turn / inertia) * time), abs=2e-5
    )
    moment = results["forces/mount/moment"].values[:, axis]
    assert moment == pytest.approx(-k_turn * angle, abs=1e-8)


def test_a_bushing_between_bodies_keeps_momentum() -> None:
    """Two free bodies, off-centre, twisted: linear and angular momentum stay zero."""
    tilted = dict(displacement=[0.05, -0.1, 0.02], rotation_deg=[20.0, -35.0, 50.0])
    law = dict(
        stiffness=[90.0, 160.0, 250.0, 4.0, 9.0, 16.0], damping=[1.0, 1.0, 1.0, 0.1, 0.1, 0.1]
    )
    ends = dict(body_a="a", body_b="b", point=[0.6, 0.1, 0.0], axis=[1.0, 0.0, 0.0])
    bodies = [
        body("a", "rigid", 3.0, inertia=[0.2, 0.3, 0.4]),
        body("b", "rigid", 1.0, [1.0, 0.3, -0.2], [0.1, 0.2, 0.15], **tilted),
    ]
    coupling = dict(type="bushing", name="coupling", **ends, **law)
    tables = case(bodies, 5.0, forces=[coupling], gravity=0.0, samples=100)
    results = run_tables(tables, method="radau", rtol=1e-8)
    linear, angular = np.zeros(3), np.zeros(3)
    for name, mass in (("a", 3.0), ("b", 1.0)):
        linear = linear + mass * results[f"bodies/{name}/velocity"].values
    assert np.abs(linear).max() < 1e-8
    for name, mass, inertia in (("a", 3.0, [0.2, 0.3, 0.4]), ("b", 1.0, [0.1, 0.2, 0.15])):
        w, x, y, z = results[f"bodies/{name}/orientation"].values.T
        R = np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        ).transpose(2, 0, 1)
        omega = results[f"bodies/{name}/angular_velocity"].values
        spin = np.einsum("tij,j,tkj,tk->ti", R, inertia, R, omega)
        place, speed = (results[f"bodies/{name}/{q}"].values for q in ("position", "velocity"))
        angular = angular + spin + mass * np.cross(place, speed)
    assert np.abs(angular).max() < 1e-7


@pytest.mark.parametrize("method", METHODS)
def test_a_python_law_is_the_same_as_a_built_in_one(method: str) -> None:
    linear = dict(type="pto_linear", name="own", joint="slide", stiffness=50.0, damping=1.5)
    built_in = block(linear, 3.0, start=0.2, method=method)["joints/slide/displacement"].values
    law = lambda _t, s, rate: -50.0 * s - 1.5 * rate  # noqa: E731
    own = block(OWN, 3.0, start=0.2, method=method, given={"own": law})
    assert own["joints/slide/displacement"].values == pytest.approx(built_in, abs=1e-8)
    assert own["forces/own/force"].values[0] == pytest.approx(-10.0)


def test_a_python_wrench_acts_on_a_body() -> None:
    """A conical pendulum of sorts: F = -k r + c z x v keeps the plane turning."""
    bead = body("bead", "point", 1.0, displacement=[0.1, 0.0, 0.0])
    wrench = dict(type="python_wrench", name="field", body="bead")
    tables = case([bead], 4.0, forces=[wrench], gravity=0.0, samples=40)

    def field(_time: float, xi: np.ndarray, twist: np.ndarray) -> np.ndarray:
        force = -9.0 * xi[:3] + 0.8 * np.cross([0.0, 0.0, 1.0], twist[:3])
        return np.concatenate([force, np.zeros(3)])

    results = hydrodae.run(case_of(tables, rtol=1e-9), forces={"field": field})
    time = results["bodies/bead/position"].time.values
    # x + i y = sum of two rotations: s^2 - 0.8 i s + 9 = 0
    roots = np.roots([1.0, -0.8j, 9.0])
    parts = np.linalg.solve(np.array([np.ones(2), roots]), np.array([0.1, 0.0]))
    exact = sum(c * np.exp(s * time) for c, s in zip(parts, roots, strict=True))
    place = results["bodies/bead/position"].values
    assert place[:, 0] + 1j * place[:, 1] == pytest.approx(exact, abs=1e-6)


def test_what_a_python_law_does_wrong_comes_back() -> None:
    case = block_case(OWN, 1.0, start=0.2)

    def breaks(time: float, _s: float, _rate: float) -> float:
        if time > 0.3:
            raise RuntimeError("valve stuck")
        return 0.0

    with pytest.raises(RuntimeError, match="valve stuck"):
        hydrodae.run(case, forces={"own": breaks})
    with pytest.raises(CaseError, match="must return one number"):
        hydrodae.run(case, forces={"own": lambda _t, _s, _rate: [1.0, 2.0]})
    with pytest.raises(CaseError, match="returned nan at t = "):
        hydrodae.run(case, forces={"own": lambda _t, _s, _rate: float("nan")})
    with pytest.raises(CaseError, match="which nobody gave"):
        hydrodae.run(case)
    with pytest.raises(CaseError, match="did you mean 'own'"):
        hydrodae.run(case, forces={"owm": breaks})


def test_states_stand_in_check_and_in_the_linear_model() -> None:
    """`check` counts them; at rest bristles are springs: sqrt(sigma_0 / m)."""
    case = block_case(LUGRE, 1.0)
    text = hydrodae.check(case)
    assert "+ 1 states" in text
    assert "force rail" in text
    model = LinearModel(case)
    assert any("'rail'" in note and "it sticks there" in note for note in model.notes)
    stiff = -(100.0**2) * 2.0 + 1e5 + 1j * 100.0 * (2.0 * np.sqrt(1e5) + 3.0)
    assert model.dynamic_stiffness(100.0)[0, 0] == pytest.approx(stiff, rel=1e-9)
