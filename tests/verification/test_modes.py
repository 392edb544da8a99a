"""Bodies that deform: closed forms, a hinge in two forms, and a flexible barge of WAMIT."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hydrodae
from hydrodae.hdb.labels import DOFS
from hydrodae.linear import LinearModel

TIGHT: dict[str, Any] = {"rtol": 1e-9, "accuracy": "none"}


def beam(**body: Any) -> hydrodae.Scene:
    """Return a body of 1000 kg with one mode of 100 kg and 4000 N/m, shape 2 at x = 3 m."""
    scene = hydrodae.Scene("beam")
    scene.environment(gravity=0.0)
    scene.body("beam", mass=1000.0, center_of_gravity=[0.0, 0.0, 0.0], **body)
    scene.mode("bend", body="beam", mass=100.0, stiffness=4000.0, initial={"amplitude": 0.1})
    shape: dict[str, Any] = {"displacement": [[0.0, 0.0, 2.0]], "rotation": [[0.0, -1.0, 0.0]]}
    scene.attachment("tip", body="beam", point=[3.0, 0.0, 0.0], **shape)
    return scene


def test_dry_mode_oscillates_by_itself() -> None:
    scene = beam(motion="fixed")
    scene.solver(end_time=5.0, **TIGHT)
    run = hydrodae.run(scene)
    expected = 0.1 * np.cos(np.sqrt(40.0) * run.time)
    np.testing.assert_allclose(run["modes/beam.bend/amplitude"], expected, atol=1e-8)
    np.testing.assert_allclose(run["bodies/tip/position"][:, 2], 2.0 * expected, atol=1e-7)


@pytest.mark.parametrize("method", ["explicit_rk", "radau", "ida"])
def test_load_on_an_attachment(method: Any) -> None:
    """A point of 25 kg on a shape of 2 adds 100 kg to the modal mass."""
    scene = beam(motion="fixed")
    point = [3.0, 0.0, 0.0]
    start: Any = {"displacement": [0.0, 0.0, 0.2]}
    scene.body("load", motion="point", mass=25.0, center_of_gravity=point, initial=start)
    scene.joint.spherical("clamp", body_a="tip", body_b="load", point=point)
    scene.solver(end_time=5.0, method=method, **TIGHT)
    run = hydrodae.run(scene)
    expected = 0.1 * np.cos(np.sqrt(20.0) * run.time)
    np.testing.assert_allclose(run["modes/beam.bend/amplitude"], expected, atol=1e-6)


def test_large_motion_keeps_energy_and_momentum() -> None:
    """A free body that turns, with a pendulum on its deformed end."""
    scene = beam(inertia=[50.0, 2000.0, 2000.0], initial={"angular_velocity": [0.3, 0.2, 0.5]})
    scene.body("bob", mass=50.0, inertia=[1.0, 1.0, 1.0], center_of_gravity=[3.0, 0.0, -1.0])
    point = [3.0, 0.0, 0.0]
    scene.joint.revolute("pin", body_a="tip", body_b="bob", point=point, axis=[0, 1, 0])
    scene.solver(end_time=10.0, **TIGHT)
    run = hydrodae.run(scene)
    total = run["energy/total"].values
    assert np.ptp(total) < 1e-6 * abs(total[0])
    momentum = (
        1000.0 * run["bodies/beam/velocity"].values + 50.0 * run["bodies/bob/velocity"].values
    )
    assert np.ptp(momentum, axis=0).max() < 1e-6 * np.abs(momentum).max()
    assert np.abs(run["bodies/beam/rotation"].values).max() > 2.0


def test_hinge_as_mode_and_as_joint() -> None:
    """Two uniform halves on a hinge with a spring, and one body with the shape of the hinge.

    Half: 500 kg, 4 m long. Shape: ends up by 1, hinge down by 1, so that momentum and its moment
    vanish: z = |x| / 2 - 1, modal mass int z^2 dm = 1000 / 3 kg; the hinge opens by 1 rad/m.
    """
    stiffness, length = 2000.0, 4.0
    inertia = 500.0 * length**2 / 12.0
    one = hydrodae.Scene("mode")
    one.environment(gravity=0.0)
    own = [10.0, 1000.0 * 64.0 / 12.0, 1000.0 * 64.0 / 12.0]
    one.body("barge", mass=1000.0, inertia=own, center_of_gravity=[0.0, 0.0, 0.0])
    start: Any = {"amplitude": 0.001}
    one.mode("hinge", body="barge", mass=1000.0 / 3.0, stiffness=stiffness, initial=start)
    one.solver(end_time=5.0, **TIGHT)
    two = hydrodae.Scene("joint")
    two.environment(gravity=0.0)
    for name, x, turn in (("fore", 2.0, -1.0), ("aft", -2.0, 1.0)):
        degrees = float(np.degrees(0.0005 * turn))
        two.body(
            name,
            motion="planar",
            mass=500.0,
            inertia=[inertia] * 3,
            center_of_gravity=[x, 0.0, 0.0],
            initial={"rotation_deg": [0.0, degrees, 0.0]},
        )
    pin: dict[str, Any] = {
        "body_a": "aft",
        "body_b": "fore",
        "point": [0.0, 0.0, 0.0],
        "axis": [0, 1, 0],
    }
    two.joint.revolute("hinge", **pin)
    two.force.pto_linear("spring", joint="hinge", damping=0.0, stiffness=stiffness)
    two.solver(end_time=5.0, **TIGHT)
    mode, joint = hydrodae.run(one), hydrodae.run(two)
    angle = joint["joints/hinge/angle"]
    np.testing.assert_allclose(mode["modes/barge.hinge/amplitude"], -angle, atol=2e-6)


def test_count_of_vectors_is_checked() -> None:
    scene = hydrodae.Scene("beam")
    scene.body("beam", mass=1.0, center_of_gravity=[0.0, 0.0, 0.0], motion="fixed")
    scene.mode("bend", body="beam", mass=1.0)
    scene.attachment("tip", body="beam", point=[0, 0, 0], displacement=[[0, 0, 1], [0, 0, 2]])
    scene.solver(end_time=1.0)
    with pytest.raises(hydrodae.CaseError) as caught:
        hydrodae.run(scene)
    assert caught.value.key == "attachment.tip.displacement"


MODES = tuple(f"mode{k}" for k in range(7, 11))
MASSES = (1.079216e6, 1.209976e6, 2.391821e6, 1.830601e6)  # kg, barge.frc
STIFFNESSES = (6.077064e6, 4.382532e7, 2.741026e8, 4.664370e8)  # N/m
#: Amplitudes per metre in barge.4, by period: heave, modes 7 and 8.
BARGE = {
    6.0: (0.4083, 0.1234, 0.0248),
    7.95: (0.2658, 0.1874, 0.0139),
    10.05: (0.6753, 0.1275, 0.0064),
    12.0: (0.8348, 0.0755, 0.0142),
    15.0: (0.9301, 0.0349, 0.0186),
}


def flexible_barge(source: Path, folder: Path, **hydro: Any) -> hydrodae.Scene:
    """Return the barge of WEC-Sim's example of generalised modes."""
    database, _ = hydrodae.hdb.import_database(source)
    database.write(folder / "hydro.h5")
    scene = hydrodae.Scene("barge", directory=folder)
    scene.hydro(database="hydro.h5", **hydro)
    inertia = [6.666667e7, 2.166667e9, 2.166667e9]
    scene.body(
        "barge", hydro="barge", motion="planar", mass=4e6, inertia=inertia,
        center_of_gravity=[0.0, 0.0, 0.0],
    )  # fmt: skip
    for name, mass, stiffness in zip(MODES, MASSES, STIFFNESSES, strict=True):
        scene.mode(name, body="barge", mass=mass, stiffness=stiffness)
    scene.solver(end_time=200.0, rtol=1e-6, accuracy="none")
    return scene


def test_flexible_barge_of_wamit(reference: Path, tmp_path: Path) -> None:
    """Amplitudes per metre of wave are those that WAMIT prints, within its digits and 1e-3."""
    source = reference / "modes" / "gbm_barge" / "barge.1"
    model = LinearModel(flexible_barge(source, tmp_path, radiation="none"))
    omega = 2.0 * np.pi / np.array(list(BARGE))
    found = model.response(omega)
    columns = ("bodies/barge/heave", "modes/barge.mode7/amplitude", "modes/barge.mode8/amplitude")
    for k, expected in enumerate(BARGE.values()):
        row = [abs(found[c][k]) for c in columns]
        np.testing.assert_allclose(row, expected, rtol=1e-3, atol=6e-5)


def test_flexible_barge_in_time(reference: Path, tmp_path: Path) -> None:
    """The same by a run in waves of 1 cm, with A and B of their period, within 1 % and 1 deg."""
    source = reference / "modes" / "gbm_barge" / "barge.1"
    period = 7.95
    frequency = 2.0 * np.pi / period
    scene = flexible_barge(source, tmp_path, radiation="constant", frequency=frequency)
    scene.wave.regular("head", height=0.02, period=period)
    scene.sea(ramp=50.0)
    run = hydrodae.run(scene)
    late = run.time > 200.0 - 5.0 * period
    angle = frequency * run.time[late]
    columns = np.column_stack([np.cos(angle), -np.sin(angle), np.ones_like(angle)])
    channel = run["modes/barge.mode7/amplitude"][late]
    real, imaginary, _ = np.linalg.lstsq(columns, channel, rcond=None)[0]
    assert np.hypot(real, imaginary) / 0.01 == pytest.approx(0.1874, rel=0.01)
    assert np.degrees(np.arctan2(imaginary, real)) % 360.0 == pytest.approx(181.5, abs=1.0)


def write_wet_beam(path: Path) -> None:
    """Write a database of one body with a mode: constant A, no B, a force on all coordinates."""
    labels = tuple(f"beam.{dof}" for dof in (*DOFS, "bend"))
    added = np.diag([50.0, 50.0, 100.0, 1e3, 1e3, 1e3, 40.0])
    added[2, 6] = added[6, 2] = 20.0
    omega = np.linspace(0.5, 8.0, 16)
    stiffness = np.zeros((7, 7))
    stiffness[6, 6], stiffness[2, 6], stiffness[6, 2] = 900.0, 150.0, 250.0
    force = np.array([30.0, 0.0, 500.0, 0.0, 100.0, 0.0, 200.0 + 50.0j])
    loads = np.stack([force, force * [0, 1, 1, 1, 1, 1, 0.5]])  # headings 0 and 90 degrees
    every = np.broadcast_to(loads, (omega.size, 2, 7)).copy()
    statics = hydrodae.hdb.Hydrostatics(1.0, np.zeros(3), 0.2, np.zeros(5))
    body = hydrodae.hdb.Body("beam", np.zeros(3), statics, mode_stiffness=stiffness)
    hydrodae.hdb.HydroDatabase(
        labels,
        omega,
        np.broadcast_to(added, (omega.size, 7, 7)).copy(),
        np.zeros((omega.size, 7, 7)),
        added,
        np.zeros((7, 7)),
        np.radians([0.0, 90.0]),
        np.zeros_like(every),
        every,
        {"beam": body},
        1000.0,
        10.0,
        excitation_split=False,
    ).write(path)


def wet_beam(folder: Path, turned: float = 0.0) -> hydrodae.Scene:
    """Return that body in heave with its mode, in a wave along its own axis."""
    write_wet_beam(folder / "hydro.h5")
    scene = hydrodae.Scene("wet beam", directory=folder)
    scene.hydro(database="hydro.h5", radiation="none")
    start: Any = {"rotation_deg": [0.0, 0.0, turned]}
    centre = [0.0, 0.0, 0.0]
    scene.body(
        "beam", hydro="beam", motion="heave", mass=1000.0, center_of_gravity=centre, initial=start
    )
    scene.mode("bend", body="beam", mass=60.0, stiffness=4000.0, initial={"amplitude": 0.01})
    return scene


def test_wet_mode_is_that_of_two_equations(tmp_path: Path) -> None:
    """Heave and mode: M x'' + K x = 0 with coupled added mass and an unsymmetric stiffness."""
    scene = wet_beam(tmp_path)
    scene.solver(end_time=5.0, **TIGHT)
    run = hydrodae.run(scene)
    mass = np.array([[1100.0, 20.0], [20.0, 100.0]])
    stiffness = np.array([[2000.0, 150.0], [250.0, 4900.0]])  # rho g 0.2 m2; k + 900
    values, shapes = np.linalg.eig(np.linalg.solve(mass, stiffness))
    parts = np.linalg.solve(shapes, [0.0, 0.01])
    exact = (shapes * parts) @ np.cos(np.sqrt(values)[:, None] * run.time)
    np.testing.assert_allclose(run["bodies/beam/position"][:, 2], exact[0], atol=1e-8)
    np.testing.assert_allclose(run["modes/beam.bend/amplitude"], exact[1], atol=1e-8)


def test_waves_meet_a_turned_body_by_their_relative_heading(tmp_path: Path) -> None:
    """Body and wave turned by a right angle: the same motion; the wave alone: another one."""
    amplitudes = []
    for turned, heading in ((0.0, 0.0), (90.0, 90.0), (0.0, 90.0)):
        scene = wet_beam(tmp_path, turned)
        scene.wave.regular("sea", height=0.02, period=3.0, heading_deg=heading)
        scene.solver(end_time=10.0, **TIGHT)
        amplitudes.append(hydrodae.run(scene)["modes/beam.bend/amplitude"].values)
    np.testing.assert_allclose(amplitudes[1], amplitudes[0], atol=1e-10)
    assert np.abs(amplitudes[2] - amplitudes[0]).max() > 1e-4


def test_unknown_mode_is_refused_by_name(tmp_path: Path) -> None:
    scene = wet_beam(tmp_path)
    scene.mode("bent", body="beam", mass=60.0)
    scene.solver(end_time=1.0)
    with pytest.raises(hydrodae.CaseError) as caught:
        hydrodae.run(scene)
    assert caught.value.key == "mode.bent.name"
    assert "did you mean 'bend'" in str(caught.value)


def planar_beam() -> hydrodae.Scene:
    """Return a planar beam with a bob on its deformed end."""
    scene = beam(motion="planar", inertia=[50.0, 2000.0, 2000.0])
    point = [3.0, 0.0, 0.0]
    start: Any = {"displacement": [0.0, 0.0, 0.2]}
    scene.body("bob", motion="point", mass=50.0, center_of_gravity=point, initial=start)
    scene.joint.spherical("pin", body_a="tip", body_b="bob", point=point)
    scene.solver(end_time=2.0, **TIGHT)
    return scene


def test_attachment_on_a_planar_body_is_planar() -> None:
    """Three conditions hold it; with the two of the joint in the plane there are five, and sway."""
    text = str(hydrodae.check(planar_beam()))
    assert "left by 6 constraint rows" in text
    assert "redundant" not in text
    assert "body 'tip'" not in text  # no advice on what is not in the case


def test_attachments_are_drawn_where_they_are(tmp_path: Path) -> None:
    run = hydrodae.run(planar_beam(), output=tmp_path / "beam.h5")
    tip = next(body for body in hydrodae.view(run).stage.bodies if body.name == "tip")
    np.testing.assert_allclose(tip.position[-1], run["bodies/tip/position"].values[-1])


def test_a_mode_is_no_body_for_joints() -> None:
    scene = beam(motion="fixed")
    scene.body("bob", motion="point", mass=1.0, center_of_gravity=[0.0, 0.0, 0.0])
    scene.joint.spherical("pin", body_a="beam.bend", body_b="bob", point=[0.0, 0.0, 0.0])
    scene.solver(end_time=1.0)
    with pytest.raises(hydrodae.CaseError) as caught:
        hydrodae.run(scene)
    assert caught.value.key == "joint.pin.body_a"


LENGTH, LINE_MASS, BENDING = 4.0, 25.0, 2e5  # m, kg/m, N m2
#: Of the static shape (x^4 - 4 L x^3 + 6 L^2 x^2) / (3 L^4) of a cantilever: integrals of it and of
#: its square over the mass, and of E I times its squared curvature.
SHARE, SHAPE_MASS = 0.4 * LINE_MASS * LENGTH, 104.0 / 405.0 * LINE_MASS * LENGTH
SHAPE_STIFFNESS = 3.2 * BENDING / LENGTH**3


def cantilever(
    participation: list[float] | None, gravity: float = 9.81, **body: Any
) -> hydrodae.Scene:
    """Return a beam along x with the static shape of a cantilever as its mode."""
    scene = hydrodae.Scene("cantilever")
    scene.environment(gravity=gravity)
    scene.body("beam", mass=LINE_MASS * LENGTH, center_of_gravity=[2.0, 0.0, 0.0], **body)
    more: dict[str, Any] = {} if participation is None else {"participation": participation}
    scene.mode("bend", body="beam", mass=SHAPE_MASS, stiffness=SHAPE_STIFFNESS, **more)
    return scene


@pytest.mark.parametrize("turn", [0.0, 60.0, 180.0])
def test_weight_bends_a_cantilever(turn: float) -> None:
    """The tip sags by q L^4 / (8 E I), cos(turn) of it where the wall is turned about the beam."""
    scene = cantilever([0.0, 0.0, SHARE], motion="fixed", initial={"rotation_deg": [turn, 0, 0]})
    scene.attachment("tip", body="beam", point=[LENGTH, 0, 0], displacement=[[0.0, 0.0, 1.0]])
    scene.solver(start="equilibrium", end_time=0.5, **TIGHT)
    run = hydrodae.run(scene)
    sag = -LINE_MASS * 9.81 * LENGTH**4 / (8.0 * BENDING) * np.cos(np.radians(turn))
    np.testing.assert_allclose(run["modes/beam.bend/amplitude"], sag, rtol=1e-9, atol=1e-9)
    place = run["bodies/tip/position"].values[0] - [LENGTH, 0.0, 0.0]
    axis = [0.0, -np.sin(np.radians(turn)), np.cos(np.radians(turn))]
    np.testing.assert_allclose(place, sag * np.array(axis), atol=1e-9)
    assert not any("does not load" in note for note in run.notes)


@pytest.mark.parametrize(
    ("participation", "motion", "noted"),
    [(None, "fixed", True), ([0.0, 0.0, 0.0], "fixed", False), (None, "rigid", False)],
)
def test_weight_that_does_not_load_a_mode_is_noted(
    participation: list[float] | None, motion: Any, noted: bool
) -> None:
    """Of normal modes of a free body it is right that it does not."""
    scene = cantilever(participation, motion=motion, inertia=[1.0, 50.0, 50.0])
    scene.solver(end_time=0.1, **TIGHT)
    run = hydrodae.run(scene)
    assert any("does not load its mode 'bend'" in note for note in run.notes) == noted


def test_a_free_body_has_no_participation() -> None:
    scene = cantilever([0.0, 0.0, SHARE], inertia=[1.0, 50.0, 50.0])
    scene.solver(end_time=1.0)
    with pytest.raises(hydrodae.CaseError) as caught:
        hydrodae.run(scene)
    assert caught.value.key == "mode.bend.participation"


@pytest.mark.parametrize("method", ["auto", "radau", "ida"])
def test_weight_on_modes_has_a_potential(method: Any) -> None:
    """A beam that swings about a ball joint and bends: the energy stays, by an exact Jacobian."""
    scene = cantilever([3.0, 2.0, SHARE], inertia=[120.0, 500.0, 400.0])
    scene.joint.spherical("ball", body_a="ground", body_b="beam", point=[0.0, 0.0, 0.0])
    scene.solver(end_time=5.0, method=method, **TIGHT)
    run = hydrodae.run(scene)
    total = run["energy/total"].values
    assert np.ptp(run["modes/beam.bend/amplitude"].values) > 0.01
    assert np.ptp(run["bodies/beam/rotation"].values[:, 1]) > 1.0
    assert np.ptp(total) < 3e-6 * np.ptp(run["energy/kinetic"].values)


@pytest.mark.parametrize(("rate", "noted"), [(0.09, False), (0.11, True)])
def test_centrifugal_loads_are_noted(rate: float, noted: bool) -> None:
    """They soften a mode by m w^2: 1 % at a tenth of its own frequency."""
    spin = [0.0, 0.0, rate * float(np.sqrt(SHAPE_STIFFNESS / SHAPE_MASS))]
    start: Any = {"angular_velocity": spin}
    scene = cantilever(None, gravity=0.0, inertia=[50.0, 50.0, 50.0], initial=start)
    scene.solver(end_time=0.1, **TIGHT)
    run = hydrodae.run(scene)
    assert any("centrifugal" in note for note in run.notes) == noted
