"""Booleans, integers, enumerations and strings of FMUs, as controllers and of cases."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests import scenes
from tests.verification.fmu_of_c import PLATFORMS, compiled

import hydrodae
from hydrodae import Case, CaseError, SolverError
from hydrodae.fmu import export

#: name, causality, type of FMI 2 and of FMI 3
VARIABLES = {
    1: ("rate", "input", "Real", "Float64"),
    2: ("gear", "input", "Integer", "Int32"),
    3: ("on", "input", "Boolean", "Boolean"),
    4: ("mode", "parameter", "Enumeration", "Enumeration"),
    5: ("invert", "parameter", "Boolean", "Boolean"),
    6: ("least", "parameter", "Integer", "Int8"),
    7: ("label", "parameter", "String", "String"),
    8: ("brake", "output", "Boolean", "Boolean"),
    9: ("steps", "output", "Integer", "UInt16"),
    10: ("length", "output", "Integer", "Int64"),
    11: ("phase", "output", "Enumeration", "Enumeration"),
    12: ("half", "output", "Real", "Float32"),
}
KINDS = """
[[force]]
type = "dry_friction"
name = "latch"
joint = "slide"
static = 1.0
kinetic = 0.0
[[force]]
type = "constant_load"
name = "told"
body = "cart"
[[controller]]
name = "switch"
type = "bang_bang"
inputs = ["joints/slide/displacement"]
outputs = ["forces/told/force.y"]
lower = 0.0
upper = 1.0
period = 0.1
[[controller]]
name = "kinds"
inputs = [
    "joints/slide/displacement_rate", "forces/told/cart/force.y", "forces/told/cart/force.y",
]
outputs = [
    "forces/latch/static", "forces/pto/neutral", "forces/pto/load", "forces/pto/stiffness",
    "forces/told/force.z",
]
period = 0.1
TYPE
"""
FMU = """type = "fmu"
file = "kinds.fmu"
fmu_inputs = ["rate", "gear", "on"]
fmu_outputs = ["brake", "steps", "length", "phase", "half"]
fmu_factors = [50.0, 0.001, 0.1, 4.0, 1.0]
parameters = ["mode", "invert", "least"]
parameter_values = [2, 1, -3]
text_parameters = ["label"]
text_values = ["four"]"""


def kinds(folder: Path, fmi: int, keys: str = FMU, *, runs: bool = True) -> Case:
    lines = []
    for reference, (name, causality, *types) in VARIABLES.items():
        fixed = 'variability="fixed"' if causality == "parameter" else ""
        head = f'name="{name}" valueReference="{reference}" causality="{causality}" {fixed}'
        lines.append(
            f"<ScalarVariable {head}><{types[0]}/></ScalarVariable>"
            if fmi == 2
            else f"<{types[1]} {head}/>"
        )
    xml = (
        f'<fmiModelDescription fmiVersion="{fmi}.0" modelName="kinds" '
        f'{"guid" if fmi == 2 else "instantiationToken"}="kinds">'
        f'<CoSimulation modelIdentifier="kinds"/><ModelVariables>{"".join(lines)}</ModelVariables>'
        f"</fmiModelDescription>"
    )
    with zipfile.ZipFile(folder / "kinds.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", xml)
        binary = compiled("kinds", fmi) if runs else b""
        archive.writestr(f"binaries/{PLATFORMS[fmi]}/kinds.so", binary)
    text = scenes.cart("stiffness = 8.0", more=KINDS.replace("TYPE", keys))
    (folder / "case.toml").write_text(text)
    return Case.read(folder / "case.toml")


@pytest.mark.parametrize("fmi", [2, 3])
def test_variables_of_all_kinds_are_signals(fmi: int, tmp_path: Path) -> None:
    """Against a Python function of the same meaning, a latch under a boolean included."""
    calls = 0

    def law(t: float, rate: float, gear: float, on: float) -> tuple[float, ...]:
        nonlocal calls
        calls += 1
        brake = on == 1.0 and rate > 0.0
        return 50.0 * brake, 0.001 * (calls - 1), 0.4 * gear, 8.0, float(np.float32(0.5 * rate))

    found = hydrodae.run(kinds(tmp_path, fmi))
    own = hydrodae.run(kinds(tmp_path, fmi, 'type = "python"'), controllers={"kinds": law})
    half = "controllers/kinds/output_5"
    # numbers of 32 bits are what FMI 3 has there, FMI 2 lacks them
    tolerance = 1e-6 if fmi == 2 else 1e-12
    for name in ("joints/slide/displacement", "controllers/kinds/output_1", half):
        np.testing.assert_allclose(found[name], own[name], rtol=tolerance, atol=tolerance)
    assert set(np.unique(found["controllers/kinds/output_1"][1:])) == {0.0, 50.0}
    assert float(abs(found["controllers/kinds/output_3"]).max()) == 0.4


@pytest.mark.parametrize("fmi", [2, 3])
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[2, 1, -3]", "[2, 0.5, -3]", "'invert' of the FMU is given 0.5, expected a boolean: 0"),
        ("[2, 1, -3]", "[2.5, 1, -3]", "'mode' of the FMU is given 2.5, expected an integer from"),
        ("[2, 1, -3]", "[2, 1, -3e9]", "'least' of the FMU is given -3e.09, expected an integer"),
        ('["label"]', '["mode"]', "'mode' of the FMU is of type Enumeration, expected one string"),
        ('"invert"', '"label"', "'label' of the FMU is of type String, expected one number, bool"),
        ('["four"]', "[]", "'text_values' must have as many as 'text_parameters': 1, it has 0"),
        ("[50.0, 0.001, 0.1, 4.0, 1.0]", "[50.0]", "'fmu_factors' must have as many as 'outputs'"),
    ],
)
def test_values_that_a_kind_cannot_have(
    fmi: int, old: str, new: str, message: str, tmp_path: Path
) -> None:
    with pytest.raises(CaseError, match=message):
        hydrodae.check(kinds(tmp_path, fmi, FMU.replace(old, new), runs=False))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('["rate", "gear"', '["half", "gear"', "'half' of the FMU is of causality 'output'"),
        ('"rate", "gear", "on"', '"gear", "rate", "on"', "'gear' .* given 0.3, .*integer from -2"),
        ("[2, 1, -3]", "[9, 1, -3]", "'length' of the FMU is 1.15.*too large an integer"),
    ],
)
def test_values_that_a_run_cannot_pass_on(old: str, new: str, message: str, tmp_path: Path) -> None:
    case = kinds(tmp_path, 3, FMU.replace(old, new))
    with pytest.raises((CaseError, SolverError), match=message):
        hydrodae.run(case.with_values({"body.cart.initial.velocity": [0.3, 0.0, 0.0]}))


X = "joints/slide/displacement"
PARAMETERS = ["solver.order", "solver.branch_guard", "solver.method", "force.pto.stiffness"]
GIVEN = (8, False, "explicit_rk", 9.0)


def exported(folder: Path, fmi: int) -> Path:
    solver = 'order = 5\nbranch_guard = true\nmethod = "radau"\nend_time = 2.0'
    case = Case.from_text(scenes.cart("stiffness = 8", solver=solver))
    return export(case, folder / "cart.fmu", fmi=fmi, inputs=[], outputs=[X], parameters=PARAMETERS)


@pytest.mark.parametrize("fmi", [2, 3])
def test_parameters_of_a_case_have_their_types(fmi: int, tmp_path: Path) -> None:
    pytest.importorskip("fmpy", reason="needs the extra cosim")
    from tests.verification.fmu_device import problems, simulate

    path = exported(tmp_path, fmi)
    assert problems(path) == []
    given: dict[str, Any] = dict(zip(PARAMETERS, GIVEN, strict=True))
    found = simulate(path, stop_time=2.0, output_interval=0.5, output=[X], start_values=given)
    with zipfile.ZipFile(path) as archive:
        case = Case.from_text(archive.read("resources/case.toml").decode()).with_values(given)
    run, expected = hydrodae.Simulation(case), []
    for t in found["time"]:
        while run.time < t:
            run.advance(float(t))
        expected.append(run.read(X))
    assert list(found[X]) == expected


@pytest.mark.parametrize("fmi", [2, 3])
def test_parameters_of_all_types_are_part_of_states(fmi: int, tmp_path: Path) -> None:
    pytest.importorskip("fmpy", reason="needs the extra cosim")
    from tests.verification.fmu_device import Device

    path = exported(tmp_path, fmi)
    with Device(path, tmp_path / "a") as one, Device(path, tmp_path / "b") as other:
        references = [one.references[name] for name in PARAMETERS]
        integer = "Integer" if fmi == 2 else "Int32"
        for kind, k in ((integer, 0), ("Boolean", 1), ("String", 2)):
            getattr(one.fmu, f"set{kind}")([references[k]], [GIVEN[k]])
        one.begin()
        one.step(0.0, 0.7)
        other.load(one.save())
        for kind, k in ((integer, 0), ("Boolean", 1), ("String", 2)):
            (told,) = getattr(other.fmu, f"get{kind}")([references[k]])
            assert (told.decode() if isinstance(told, bytes) else told) == GIVEN[k]
        for device in (one, other):
            device.step(0.7, 0.7)
        assert one.get(X) == other.get(X)
        with pytest.raises(Exception, match="failed with status"):  # asked for as another type
            getattr(other.fmu, f"get{integer}")([references[2]])


def test_what_is_no_parameter_of_an_fmu(tmp_path: Path) -> None:
    for key in ("force.pto.joint", "body.cart.initial.displacement", "force.pto.type", "title"):
        with pytest.raises(CaseError, match=f"{key}: a parameter must be a number"):
            export(
                Case.from_text(scenes.cart("stiffness = 8")), tmp_path / "x.fmu", parameters=[key]
            )
    with pytest.raises(CaseError, match=r"solver\.rtol: a parameter that is given twice"):
        export(
            Case.from_text(scenes.cart("stiffness = 8")),
            tmp_path / "x.fmu",
            parameters=["solver.rtol", "solver.rtol"],
        )
