"""Power take-offs of PTO-Sim: what the import makes of them, and their powers."""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest
from tests.python.test_wecsim_controls import GAINS, PI, WAVES, block, wire
from tests.python.wecsim_files import LIBRARIES, left_out, tables, write_one_body, write_slx

import hydrodae
from hydrodae.results import Results
from hydrodae.study.sweep.measures import make_measure, measure
from hydrodae.wecsim import convert

sys.path.append(str(Path(__file__).parents[2] / "cases" / "wecsim"))
import ptosim  # type: ignore[import-not-found]  # the equations of PTO-Sim, without the kernel

ACTUATED = "Translational PTO Actuation Force"
TURNED = "Rotational PTO Actuation Torque"
LINEAR = """
ptoSim(1) = ptoSimClass('ddLinearGen');
ptoSim(1).directLinearGenerator.Rs = 4; ptoSim(1).directLinearGenerator.Bfric = -2e3;
ptoSim(1).directLinearGenerator.tau_p = 0.1; ptoSim(1).directLinearGenerator.lambda_fd = 40;
ptoSim(1).directLinearGenerator.Ls = 1.2; ptoSim(1).directLinearGenerator.theta_d_0 = 0;
ptoSim(1).directLinearGenerator.lambda_sq_0 = 0; ptoSim(1).directLinearGenerator.lambda_sd_0 = 40;
ptoSim(1).directLinearGenerator.Rload = -46;
"""
DIRECT = """
ptoSim(1) = ptoSimClass('simpleDDPTO');
ptoSim(1).simpleDirectDrivePTO.torqueConstant = 7; ptoSim(1).simpleDirectDrivePTO.gearRatio = 50;
ptoSim(1).simpleDirectDrivePTO.drivetrainInertia = 20;
ptoSim(1).simpleDirectDrivePTO.drivetrainFriction = 3;
ptoSim(1).simpleDirectDrivePTO.windingResistance = 0.05;
ptoSim(1).simpleDirectDrivePTO.windingInductance = 0.01;
"""
HYDRAULIC = """
ptoSim(1) = ptoSimClass('hydraulicCyl'); ptoSim(1).hydPistonCompressible.xi_piston = 8;
ptoSim(1).hydPistonCompressible.Ap_A = 0.0378; ptoSim(1).hydPistonCompressible.Ap_B = 0.0378;
ptoSim(1).hydPistonCompressible.bulkModulus = 1.86e9;
ptoSim(1).hydPistonCompressible.pistonStroke = 20;
ptoSim(1).hydPistonCompressible.pAi = 8e6; ptoSim(1).hydPistonCompressible.pBi = 8e6;
ptoSim(2) = ptoSimClass('rectCheckValve'); ptoSim(2).rectifyingCheckValve.Cd = 0.61;
ptoSim(2).rectifyingCheckValve.Amax = 0.002; ptoSim(2).rectifyingCheckValve.Amin = 1e-8;
ptoSim(2).rectifyingCheckValve.pMax = 1.5e6; ptoSim(2).rectifyingCheckValve.pMin = 0;
ptoSim(2).rectifyingCheckValve.rho = 850; ptoSim(2).rectifyingCheckValve.k1 = 200;
ptoSim(2).rectifyingCheckValve.k2 = 8.137375e-6;
ptoSim(3) = ptoSimClass('hydraulicAcc'); ptoSim(3).gasHydAccumulator.vI0 = 2;
ptoSim(3).gasHydAccumulator.pIprecharge = 1e7;
ptoSim(4) = ptoSimClass('hydraulicAcc'); ptoSim(4).gasHydAccumulator.vI0 = 3;
ptoSim(4).gasHydAccumulator.pIprecharge = 6e6;
ptoSim(5) = ptoSimClass('hydraulicMotor'); ptoSim(5).hydraulicMotor.effModel = 2;
ptoSim(5).hydraulicMotor.displacement = 240;
ptoSim(5).hydraulicMotor.effTableShaftSpeed = [0 2500];
ptoSim(5).hydraulicMotor.effTableDeltaP = [0 2e7];
ptoSim(5).hydraulicMotor.effTableVolEff = ones(2,2)*0.9;
ptoSim(5).hydraulicMotor.effTableMechEff = ones(2,2)*0.85;
ptoSim(6) = ptoSimClass('electricGen'); ptoSim(6).electricGeneratorEC.Ra = 1;
ptoSim(6).electricGeneratorEC.La = 0.1; ptoSim(6).electricGeneratorEC.Ke = 2.0;
ptoSim(6).electricGeneratorEC.Jem = 2; ptoSim(6).electricGeneratorEC.bShaft = 0.1;
"""


def part(number: int, kind: str, item: int) -> str:
    """XML of a block of the library of PTO-Sim."""
    return (
        f'<Block BlockType="Reference" Name="{kind}" SID="{number}">'
        f'<P Name="SourceBlock">WECSim_Lib_PTOSim/Group/{kind}</P>'
        f'<InstanceData><P Name="ptoSim">ptoSim({item})</P></InstanceData></Block>'
    )


def circuit(speed: bool = True) -> str:
    """Cylinder 40, rectifier 41, accumulators 42 and 43, motor 44, generator 45, controller 46."""
    text = part(40, "Compressible Fluid Piston", 1) + part(41, "Rectifying Check Valve", 2)
    text += part(42, "Gas-Charged Hydraulic Accumulator", 3)
    text += part(43, "Gas-Charged Hydraulic Accumulator", 4) + part(44, "Hydraulic Motor", 5)
    text += part(45, "Electric Generator Equivalent Circuit", 6)
    text += block(47, "Constant", Value="rpm") + block(48, "Sum", Inputs="+-")
    text += (
        '<Block BlockType="Reference" Name="pid" SID="46"><P Name="SourceBlock">pid_lib/PID '
        'Controller</P><InstanceData><P Name="P">0.001</P><P Name="I">0.001</P>'
        '<P Name="D">0</P></InstanceData></Block>'
    )
    wires = ["40#out:2-41#in:1", "40#out:3-41#in:2", "41#out:1-40#in:1", "41#out:2-40#in:2"]
    wires += ["42#out:1-41#in:3", "43#out:1-41#in:4", "41#out:3-42#in:1", "41#out:4-43#in:1"]
    wires += ["42#out:1-44#in:2", "45#out:1-44#in:3", "44#out:1-45#in:1", "44#out:2-42#in:2"]
    wires += ["47#out:1-48#in:1", "45#out:1-48#in:2", "48#out:1-46#in:1"]
    wires += ["46#out:1-45#in:2"] if speed else []
    return text + "".join(wire(*w.split("-")) for w in wires)


def powers(case: Path, results: Results) -> dict[str, float]:
    """Results of the study powers.toml."""
    file = case.with_name("powers.toml")
    given = tomllib.loads(file.read_text(encoding="utf-8"))["result"]
    made = tuple(make_measure(file, name, table) for name, table in given.items())
    return {name: value for name, (value, _) in measure(results, made).items()}


def test_a_linear_generator_has_the_powers_of_its_fluxes(tmp_path: Path) -> None:
    signals = part(40, "Direct Drive Linear Generator", 1)
    signals += wire("3#out:1", "40#in:1") + wire("40#out:1", "3#in:1")
    write_one_body(tmp_path / "w", WAVES, LINEAR, signals, ACTUATED)
    converted = convert(tmp_path / "w", tmp_path / "c")
    assert left_out(converted) == ""
    results = hydrodae.run(converted.case)
    ours = powers(converted.case, results)
    chain = ptosim.chain_of(tmp_path / "w")
    exact = ptosim.linear_generator(chain, results, "pto1")
    for stage, value in exact.items():
        assert ours[f"power_{stage}"] == pytest.approx(value, rel=3e-3)
    assert ours["efficiency"] == pytest.approx(exact["electric"] / exact["absorbed"], rel=3e-3)
    assert ours["power_electric"] == pytest.approx(0.92 * ours["power_shaft"], rel=1e-9)
    rate = np.abs(results["joints/pto1/displacement_rate"]).max()
    assert rate * np.pi / 0.1 * 1.2 / 50 > 0.05  # the fluxes turn far enough to matter


def test_a_direct_drive_has_the_powers_of_linear_theory(tmp_path: Path) -> None:
    pi = PI.replace('"12#in:1"', '"40#in:1"') + part(40, "Simple Direct Drive PTO", 1)
    pi = pi.replace("11#out:1", "3#out:1").replace("12#in:1", "40#in:1")
    signals = pi + wire("21#out:1", "40#in:2") + wire("40#out:1", "3#in:1")
    pto = DIRECT + GAINS.format(ki="-1e5").replace("pto(1).damping = 1e4; ", "")
    database = write_one_body(tmp_path / "w", WAVES, pto, signals, ACTUATED)
    converted = convert(tmp_path / "w", tmp_path / "c")
    assert left_out(converted) == ""
    case = tables(tmp_path / "c")
    machine = next(f for f in case["force"] if f["type"] == "pto_lagged")
    assert machine["damping"] == pytest.approx(2e5 / 50**2)
    assert machine["stiffness"] == pytest.approx(-1e5 / 50**2)
    results = hydrodae.run(converted.case, set={"solver.end_time": 200.4})
    ours = powers(converted.case, results)
    omega, statics = 2.0 * np.pi / 6.0, database.bodies["buoy"].hydrostatics
    assert statics is not None

    def at(table: np.ndarray) -> complex:
        return complex(np.interp(omega, database.omega, table))

    i = database.coordinates.index("buoy.heave")
    added, damping = at(database.added_mass[:, i, i]), at(database.radiation_damping[:, i, i])
    spring = database.rho * database.gravity * statics.waterplane_area
    mass = database.rho * statics.displaced_volume
    rest = 1j * omega * (mass + added) + damping + spring / (1j * omega)
    force = 0.5 * at(database.excitation[:, 0, i])
    chain = ptosim.chain_of(tmp_path / "w")
    exact = ptosim.direct_drive(chain, omega, rest, force)
    assert exact["electric"] < 0.95 * exact["shaft"] < 0.95 * exact["absorbed"]
    for stage, value in exact.items():
        assert ours[f"power_{stage}"] == pytest.approx(value, rel=1e-2)


def test_a_hydraulic_chain_has_the_powers_of_the_equations_of_ptosim(tmp_path: Path) -> None:
    signals = circuit() + wire("3#out:1", "40#in:3") + wire("40#out:1", "3#in:1")
    waves = "waves = waveClass('regular'); waves.height = 3; waves.period = 6;"
    write_one_body(tmp_path / "w", waves, "rpm = 1500;" + HYDRAULIC, signals, ACTUATED)
    converted = convert(tmp_path / "w", tmp_path / "c")
    assert left_out(converted) == ""
    results = hydrodae.run(converted.case)
    ours = powers(converted.case, results)
    exact = ptosim.hydraulic(ptosim.chain_of(tmp_path / "w"), results, "pto1")
    assert exact["absorbed"] > 2e4
    for stage in ("absorbed", "hydraulic", "shaft", "electric"):
        assert ours[f"power_{stage}"] == pytest.approx(exact[stage], rel=2e-2)
    share = ours["power_electric"] / ours["power_absorbed"]
    assert ours["efficiency"] == pytest.approx(share, rel=1e-9)


@pytest.mark.parametrize(
    ("kind", "fields"),
    [
        ("linCrank", "crank = 3; ptoSim(7).linearCrank.offset = 1.3; {0}.rodLength = 5"),
        ("adjustableRod", "crank = 3; ptoSim(7).adjustableRod.offset = 1.3; {0}.rodInit = 5"),
    ],
)
def test_a_crank_moves_the_piston(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str, fields: str
) -> None:
    monkeypatch.setitem(LIBRARIES, TURNED, f"WECSim_Lib_PTOs/{TURNED}")
    name = "linearCrank" if kind == "linCrank" else kind
    item = f"ptoSim(7) = ptoSimClass('{kind}'); ptoSim(7).{name}.{fields};"
    pto = "rpm = 1500;" + HYDRAULIC + item.format(f"ptoSim(7).{name}")
    title = "Rotary to Linear " + ("Crank" if kind == "linCrank" else "Adjustable Rod")
    signals = circuit() + part(49, title, 7)
    signals += "".join(
        wire(*w.split("-"))
        for w in ("3#out:1-49#in:1", "49#out:1-40#in:3", "40#out:1-49#in:2", "49#out:2-3#in:1")
    )
    source = tmp_path / "w"
    write_one_body(source, "waves = waveClass('noWave'); waves.period = 6;", pto, signals, ACTUATED)
    blocks = [("Buoy", "Rigid Body", "body(1)"), ("World", "Global Reference Frame", "simu")]
    blocks.append(("PTO", TURNED, "pto(1)"))
    write_slx(source / "one.slx", blocks, ["2r-3l", "3r-1r"], signals)
    text = (source / "wecSimInputFile.m").read_text()
    text = text.replace("pto(1).location = [0 0 0]", "pto(1).location = [0 0 -8]")
    text = text.replace("endTime = 200", "endTime = 5").replace("rampTime = 60", "rampTime = 1")
    text = text.replace("hydroData\\device.h5'", "dry'") + "body(1).nonHydro = 1;"
    text = text.replace("'equilibrium'", "2e5") + "body(1).volume = 100;"
    text += "body(1).centerGravity = [0.5 0 -4]; body(1).centerBuoyancy = [0 0 -4];"
    (source / "wecSimInputFile.m").write_text(text)
    converted = convert(source, tmp_path / "c")
    assert left_out(converted) == ""
    results = hydrodae.run(converted.case)
    found = sum(np.asarray(results[f"joints/pto1_{p}/displacement"]) for p in ("fluid", "oil"))
    exact = ptosim.stroke(ptosim.chain_of(source), results, "pto1")
    assert np.max(np.abs(exact)) > 0.1
    np.testing.assert_allclose(found, exact, atol=1e-8)


def test_what_is_missing_or_not_known_is_left_out(tmp_path: Path) -> None:
    signals = circuit() + wire("3#out:1", "40#in:3") + wire("40#out:1", "3#in:1")
    pto = "rpm = 1500;" + HYDRAULIC.replace("ptoSim(2).rectifyingCheckValve.rho = 850;", "")
    write_one_body(tmp_path / "w", WAVES, pto, signals, ACTUATED)
    converted = convert(tmp_path / "w", tmp_path / "c", accept=["pto"])
    assert "ptoSim(2).rectifyingCheckValve.rho is not one number" in left_out(converted)
    assert not tables(tmp_path / "c").get("force")
    assert not (tmp_path / "c" / "powers.toml").exists()


def test_a_motor_without_a_set_speed_takes_no_flow(tmp_path: Path) -> None:
    signals = circuit(speed=False) + wire("3#out:1", "40#in:3") + wire("40#out:1", "3#in:1")
    write_one_body(tmp_path / "w", WAVES, "rpm = 1500;" + HYDRAULIC, signals, ACTUATED)
    converted = convert(tmp_path / "w", tmp_path / "c", accept=["pto"])
    assert "ptoSim(5): no generator whose controller has a constant set speed" in left_out(
        converted
    )
    force = next(f for f in tables(tmp_path / "c")["force"] if f["type"] == "pto_hydraulic")
    assert force["motor_conductance"] == 0.0
