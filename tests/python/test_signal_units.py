"""Signals in the unit that a case, or the other program, gives them."""

from __future__ import annotations

import threading
from typing import Any

import numpy as np
import pytest
from tests.errors import wrong
from tests.python.controlled import PLACE, RATE, case
from tests.python.test_tcp import free_port
from tests.scenes import controlled_cart

import hydrodae
from hydrodae import Case, CaseError, SolverError, tcp

PLAIN = case("resistive", "damping = 1.5")
MOTION = ("joints/slide/displacement", "controllers/pi/output")
IN_MM, IN_KN = '"joints/slide/displacement_rate [mm/s]"', "forces/pto/load [kN]"


def in_other_units(type: str, keys: str = "") -> Case:
    text = controlled_cart(type, keys, IN_MM)
    return Case.from_text(text.replace("forces/pto/load", IN_KN))


def assert_same(found: hydrodae.Results) -> None:
    own = hydrodae.run(PLAIN)
    for name in MOTION:
        np.testing.assert_allclose(found[name], own[name], atol=1e-12)
    assert found["controllers/pi/output"].attrs["unit"] == "N"


def law(_time: float, rate: float) -> float:
    """1.5 N s/m as kN per mm/s."""
    return -1.5e-6 * rate


def served(given: Case, port: int, answer: Any, **how: Any) -> hydrodae.Results:
    faults: list[str] = []

    def peer() -> None:
        try:
            with tcp.connect(port=port, timeout=5.0, **how) as run:
                for t, (rate,) in run:
                    run.answer(answer(t, rate))
        except (tcp.TcpError, OSError) as error:
            faults.append(str(error))

    thread = threading.Thread(target=peer)
    thread.start()
    try:
        return hydrodae.run(given)
    finally:
        thread.join(10.0)


def test_a_case_may_give_signals_other_units() -> None:
    table = in_other_units("table", "at = [-1e3, 1e3]\nvalue = [1.5e-3, -1.5e-3]")
    found = hydrodae.run(table)
    assert_same(found)
    notes = [
        "controller 'pi' reads joints/slide/displacement_rate in mm/s: 1 mm/s = 0.001 m/s",
        "controller 'pi' writes forces/pto/load in kN: 1 kN = 1000 N",
    ]
    assert found.notes[-2:] == notes
    assert all(note in found.summary() for note in notes)
    assert all(note in hydrodae.check(table) for note in notes)
    assert_same(hydrodae.run(in_other_units("python"), controllers={"pi": law}))
    for protocol, sizes in (("hydrodae", None), ("hotint", (1, 1))):
        port = free_port()
        given = in_other_units("tcp", f'port = {port}\nprotocol = "{protocol}"')
        assert_same(served(given, port, law, hotint=sizes))


def test_another_program_may_have_its_own_units() -> None:
    port = free_port()
    units = {"input_units": ["km/h"], "output_units": ["mN"]}
    given = case("tcp", f"port = {port}")
    found = served(given, port, lambda t, rate: -1.5e3 * rate / 3.6, **units)
    assert_same(found)
    assert found.notes[-2:] == [
        "controller 'pi': the other program has joints/slide/displacement_rate in km/h: "
        "1 km/h = 0.277777778 m/s",
        "controller 'pi': the other program has forces/pto/load in mN: 1 mN = 0.001 N",
    ]


@pytest.mark.parametrize(
    ("units", "message"),
    [
        ({"input_units": ["N"]}, "has input 1 in 'N', which is no unit of 'joints/slide/disp"),
        ({"output_units": ["furlong"]}, "output 1 in 'furlong', .* 'forces/pto/load', in 'N'"),
        ({"input_units": ["m/s", "m"]}, r"states 2 units of its inputs \('m/s, m'\), expected 1"),
    ],
)
def test_units_of_a_program_that_cannot_be(units: dict[str, Any], message: str) -> None:
    port = free_port()
    with pytest.raises(SolverError, match=message):
        served(case("tcp", f"port = {port}"), port, law, **units)


@pytest.mark.parametrize(
    ("type", "keys", "inputs", "message"),
    [
        ("pid", "", f'"{PLACE[1:-1]} [s]"', r"'s' is a unit of something else \(s\); .* in 'm'"),
        ("pid", "", f'"{PLACE[1:-1]} [furlong]"', "'furlong' is no unit that is known here"),
        ("pid", "", f'"{PLACE[1:-1]} []"', "'' is no unit that is known here"),
        ("pid", "", f"{PLACE}, {RATE}", "in 'm/s', and cannot be the target of .* in 'm'"),
        ("bang_bang", "lower = 0.0\nupper = 1.0", f"{RATE}, {PLACE}", "cannot be the target of"),
        ("reactive", "", f"{RATE}, {PLACE}", "in 'm'; a reactive controller takes a rate there"),
        ("reactive", "", f"{RATE}, {RATE}", "takes the coordinate of the rate .* in 'm'$"),
        ("resistive", "", PLACE, "a resistive controller takes a rate there, in m/s or rad/s"),
        ("resistive", "", IN_MM, r"are in SI units; leave '\[mm/s\]' away"),
    ],
)
def test_units_that_a_case_cannot_give(type: str, keys: str, inputs: str, message: str) -> None:
    given = case(type, keys, inputs)
    line = controlled_cart(type, keys, inputs).splitlines().index(f"inputs = [{inputs}]") + 1
    for act in (hydrodae.check, hydrodae.Simulation):
        with pytest.raises(CaseError, match=message) as caught:
            act(given)
        assert (caught.value.file, caught.value.line) == ("<case>", line)
        assert caught.value.key == "controller.pi.inputs"


def test_a_load_must_be_where_a_damper_answers() -> None:
    text = controlled_cart("resistive")
    with wrong("controller.pi.outputs"):
        hydrodae.check(Case.from_text(text.replace("pto/load", "pto/damping")))


@pytest.mark.parametrize(
    ("unit", "of", "factor"),
    [
        ("deg", "bodies/cart/rotation.y", np.pi / 180.0),
        ("rpm", "bodies/cart/angular_velocity.y", np.pi / 30.0),
        ("deg/min", "bodies/cart/angular_velocity.y", np.pi / 180.0 / 60.0),
        ("kW", "forces/pto/power_absorbed", 1e3),
        ("kJ/h", "forces/pto/power_absorbed", 1e3 / 3600.0),
        ("Wh", "energy/kinetic", 3600.0),
        ("kN.m", "energy/kinetic", 1e3),
        ("cm*s-2", "bodies/cart/acceleration.x", 0.01),
        ("mm/(s ms)", "bodies/cart/acceleration.x", 1.0),
        ("kg m^2/s2", "energy/kinetic", 1.0),
        ("bar cm2", "forces/spring/force", 10.0),
    ],
)
def test_units_that_are_known(unit: str, of: str, factor: float) -> None:
    """The controller gives on what it reads, in the unit of the scene again."""
    text = controlled_cart("python", inputs=f'"{of}", "{of} [{unit}]"')
    seen: list[tuple[float, float]] = []

    def told(_time: float, plain: float, other: float) -> float:
        seen.append((plain, other))
        return 0.0

    text = text.replace("[solver]\n", "[solver]\nend_time = 0.3\n", 1).replace("end_time = 5.0", "")
    found = hydrodae.run(Case.from_text(text), controllers={"pi": told})
    notes = [note for note in found.notes if "reads" in note]
    assert len(notes) == (factor != 1.0)
    np.testing.assert_allclose([b * factor for _, b in seen], [a for a, _ in seen], rtol=1e-14)
