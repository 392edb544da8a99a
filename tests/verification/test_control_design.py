"""`hydrodae control design` against the impedance of the device without its power take-off.

One body in heave, from the tables themselves: Z = B + i (w (m + A) - C / w).
"""

from __future__ import annotations

import tomllib
from pathlib import Path

import h5py
import numpy as np
import pytest
from tests.attack.parts import Table, body, joint
from tests.verification.blocks import case_of

import hydrodae
from hydrodae.commands.cli import main
from hydrodae.control import Plant, match
from hydrodae.errors import CaseError

MASS = 261.8e3  # kg, of cases/sphere
PTO = dict(name="pto", type="pto_general", joint="guide")
LINEAR = dict(name="pto", type="pto_linear", joint="guide", damping=2.32e5, stiffness=4.0e4)
TAKE_OFFS: dict[str, list[Table]] = {
    "none of its own": [PTO],
    "linear": [LINEAR],
    "late": [LINEAR | {"delay": 0.1}],
    "with a lag": [LINEAR | {"type": "pto_lagged", "lag": 0.2, "load_limit": 1.0e6}],
    "two of them": [PTO, dict(name="brake", type="pto_linear", joint="guide", damping=1.0e5)],
}


def own_impedance(repository: Path, omega: float) -> complex:
    """By formula, from the entries of the table at one of its frequencies."""
    with h5py.File(repository / "cases" / "sphere" / "hydro.h5") as f:
        labels = [label.decode() for label in f["coordinates"]]
        i, w = labels.index("sphere.heave"), int(np.abs(f["omega"][:] - omega).argmin())
        assert f["omega"][w] == pytest.approx(omega, rel=1e-9)
        a, b = f["added_mass"][w, i, i], f["radiation_damping"][w, i, i]
        c = f["bodies/sphere/hydrostatic_stiffness"][2, 2]
    return complex(b + 1j * (omega * (MASS + a) - c / omega))


def case_with(repository: Path, forces: list[Table], **more: list[Table]) -> hydrodae.Case:
    """Return the controlled sphere without its controller, with these forces and entries more."""
    folder = repository / "cases" / "sphere"
    tables = tomllib.loads((folder / "control.toml").read_text())
    assert tables["force"] == [PTO]
    del tables["controller"]
    tables |= {key: [*tables.get(key, []), *entries] for key, entries in more.items()}
    return case_of(tables | {"force": forces}, folder)


@pytest.mark.parametrize("kind", TAKE_OFFS)
def test_the_take_off_is_no_part_of_the_device(repository: Path, kind: str) -> None:
    omega = 1.2
    found = match(Plant(case_with(repository, TAKE_OFFS[kind]), "guide"), 2.0 * np.pi / omega)
    z = own_impedance(repository, omega)
    # the hull floats 1 mm off the pose of the table, which the stiffness feels
    assert abs(found.impedance - z) < 1e-4 * abs(z)
    assert found.gain_p == pytest.approx(z.real, rel=1e-4)
    assert found.gain_i == pytest.approx(omega * z.imag, rel=1e-4)
    assert found.left_out == (("pto", "brake") if kind == "two of them" else ("pto",))
    assert found.counted == ()


def test_other_loads_count_and_are_listed(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Friction along the joint belongs to the device."""
    seal = dict(name="seal", type="friction_stribeck", joint="guide", static=1.0e-3)
    seal |= dict(kinetic=1.0e-3, creep_rate=0.1, stribeck_rate=1.0, viscous=2.0e4)
    case = case_with(repository, [LINEAR, seal])
    found = match(Plant(case, "guide"), 2.0 * np.pi / 1.2)
    assert found.impedance.real == pytest.approx(
        own_impedance(repository, 1.2).real + 2e4, rel=1e-4
    )
    assert (found.left_out, found.counted) == (("pto",), ("seal",))
    path = repository / "cases" / "sphere" / "control.toml"
    assert main(["control", "design", str(path), "--joint", "guide"]) == 0
    told = capsys.readouterr().out
    assert "left out     pto (pto_general)" in told


def test_a_take_off_behind_a_gear_is_no_part_of_the_device(repository: Path) -> None:
    """Its inertia is; `keep` counts its friction: 100^2 times 2 kg m2 and 1.5 N m s."""
    omega = 1.2
    shaft = body("shaft", "rigid", 0.0, inertia=[2.0] * 3)
    bearing = joint("shaft", "revolute", "ground", "shaft", axis=[1.0, 0.0, 0.0])
    gear = dict(name="gear", type="coupler", joint="guide", joint_b="shaft", ratio=100.0)
    generator = dict(name="generator", type="pto_lagged", joint="shaft", damping=38.0)
    generator |= dict(stiffness=-15.0, lag=0.01, load_limit=1.0e5)
    rubs = dict(name="gear_friction", type="pto_linear", joint="shaft", damping=1.5)
    more = dict(body=[shaft], joint=[bearing], constraint=[gear])
    case = case_with(repository, [PTO, generator, rubs], **more)
    z = own_impedance(repository, omega) + 1j * omega * 2e4
    found = match(Plant(case, "guide"), 2.0 * np.pi / omega)
    assert abs(found.impedance - z) < 1e-4 * abs(z)
    assert found.left_out == ("pto", "generator", "gear_friction")
    kept = match(Plant(case, "guide"), 2.0 * np.pi / omega, keep=["gear_friction"])
    assert kept.impedance == pytest.approx(found.impedance + 1.5e4, rel=1e-6)
    assert kept.counted == ("gear_friction",)
    with pytest.raises(CaseError, match=r"keep 'gear': no take-off .* pto, generator, gear_fr"):
        match(Plant(case, "guide"), 2.0 * np.pi / omega, keep=["gear"])


def test_the_command_prints_what_it_leaves_out_and_counts(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = repository / "cases" / "sphere" / "control.toml"
    command = ["control", "design", str(path), "--joint", "guide", "--keep"]
    assert main([*command, "pto"]) == 0
    told = capsys.readouterr().out
    assert "left out     no force of the case\n  counted      pto (pto_general)" in told


def test_the_model_of_a_plant_keeps_its_take_off(repository: Path) -> None:
    """Predictive control acts beside the take-off of the case, whose load counts there."""
    plant = Plant(case_with(repository, TAKE_OFFS["linear"]), "guide")
    whole, bare = (p.impedance(1.2)[0] for p in (plant, plant.without(["pto"])))
    assert whole - bare == pytest.approx(2.32e5 + 4.0e4 / 1.2j, rel=1e-9)
