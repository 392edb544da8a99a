"""Cables of WEC-Sim, and variant subsystems around their controllers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.python.test_wecsim_controls import ACTUATED, WAVES, block, motion, wire
from tests.python.wecsim_files import (
    TWO_BODIES,
    append,
    left_out,
    tables,
    two_bodies,
    write_one_body,
    write_slx,
)

import hydrodae
from hydrodae.errors import CaseError
from hydrodae.wecsim import convert

__all__ = ["two_bodies"]
CABLE = """
constraint(2) = constraintClass('Bottom'); constraint(2).location = [3 0 -12];
constraint(3) = constraintClass('Top'); constraint(3).location = [3 0 -2];
cable(1) = cableClass('Tether', 'constraint(2)', 'constraint(3)');
cable(1).stiffness = 1e5; cable(1).damping = 300;
cable(1).quadDrag.cd = [1 1 1 0 0 0]; cable(1).quadDrag.area = [2 2 2 0 0 0];
"""
BLOCKS = [
    *TWO_BODIES,
    ("Spherical", "Spherical", "constraint(2)"),
    ("Spherical1", "Spherical", "constraint(3)"),
    ("Cable", "Cable", "cable(1)"),
]
#: Spar - joint - node - cable - node - joint - float, beside the take-off.
LINES = ["3r-4l", "4r-2r-5r-6l", "5l-1r-7r", "6r-8l", "7l-8r"]


@pytest.mark.parametrize(
    ("stated", "length"),
    [("", 10.0), ("cable(1).cableLength = 9.5;", 9.5), ("cable(1).preTension = 2e4;", 9.8)],
)
def test_a_cable_is_a_rope_between_two_nodes(
    two_bodies: Path, tmp_path: Path, stated: str, length: float
) -> None:
    """T = k (L - L0) + c L', nodes of 1 kg that neither sink nor rise, as WEC-Sim has them."""
    write_slx(two_bodies / "model.slx", BLOCKS, LINES)
    append(two_bodies, CABLE + stated)
    assert left_out(convert(two_bodies, tmp_path / "case")) == ""
    made = tables(tmp_path / "case")
    (rope,) = (force for force in made["force"] if force["type"] == "rope")
    assert rope["points"] == [[3.0, 0.0, -12.0], [3.0, 0.0, -2.0]]
    assert rope["length"] == pytest.approx(length)
    assert rope["stiffness"] / rope["length"] == pytest.approx(1e5)
    assert rope["damping"] / rope["length"] == pytest.approx(300.0)
    nodes = [body for body in made["body"] if body["name"] in rope["bodies"]]
    assert [node["volume"] for node in nodes] == pytest.approx([1.0 / 1025.0] * 2)
    drag = [f for f in made["force"] if f.get("body") in rope["bodies"]]
    expected = [1025.0] * 3 + [0.0] * 3  # rho cd A / 2 of 2 m2
    assert [f["quadratic"] for f in drag] == [expected, expected]


def test_a_cable_pulls_by_its_stiffness(two_bodies: Path, tmp_path: Path) -> None:
    write_slx(two_bodies / "model.slx", BLOCKS, LINES)
    append(two_bodies, CABLE + "cable(1).preTension = 2e4; simu.endTime = 0.01; simu.dt = 0.01;")
    results = hydrodae.run(convert(two_bodies, tmp_path / "case").case)
    tension = np.asarray(results["forces/tether/tension"]).ravel()
    assert tension[0] == pytest.approx(2e4, rel=1e-6)


def test_a_cable_between_what_is_not_there_is_one_error(two_bodies: Path, tmp_path: Path) -> None:
    write_slx(two_bodies / "model.slx", BLOCKS, LINES)
    append(two_bodies, CABLE.replace("'constraint(3)')", "'constraint(7)')"))
    with pytest.raises(CaseError, match=r"cable\(1\): 'constraint\(7\)' is no constraint or pto"):
        convert(two_bodies, tmp_path / "case")


def variants(active: str) -> str:
    """A variant subsystem 10 with a gain as one choice, and a filter behind a gain as another."""
    text = block(11, "Inport") + block(12, "Outport")
    for sid, label, more in ((50, "gain", ""), (60, "filtered", block(41, "DiscreteTransferFcn"))):
        inside = block(11, "Inport") + block(12, "Outport") + motion("velocity")
        inside += block(31, "Gain", Gain="-k") + more + wire("21#out:1", "31#in:1")
        last = "31" if not more else "41"
        inside += wire(f"{last}#out:1", "12#in:1")
        inside += wire("31#out:1", "41#in:1") if more else ""
        text += block(sid, "SubSystem", f"<System>{inside}</System>", VariantControl=label)
    text = block(
        10,
        "SubSystem",
        f"<System>{text}</System>",
        Variant="on",
        VariantControlMode="label",
        LabelModeActiveChoice=active,
    )
    return text + wire("3#out:1", "10#in:1") + wire("10#out:1", "3#in:1")


@pytest.mark.parametrize(
    ("active", "gain", "damping"),
    [("gain", 2e4, 2e4), ("gain", 0.0, None), ("filtered", 0.0, None), ("filtered", 2e4, "Filter")],
)
def test_the_active_choice_of_a_variant_is_followed(
    tmp_path: Path, active: str, gain: float, damping: float | str | None
) -> None:
    """A filter of a signal that is zero stays zero; of another its controller is to be written."""
    pto = f"k = {gain};"
    write_one_body(tmp_path / "source", WAVES, pto, variants(active), ACTUATED)
    converted = convert(tmp_path / "source", tmp_path / "case", accept=None)
    forces = tables(tmp_path / "case").get("force", [])
    assert [force["damping"] for force in forces] == (
        [damping if active == "gain" else 0.0] if gain else []
    )
    assert ("DiscreteTransferFcn" in left_out(converted)) == (damping == "Filter")
    assert ("is zero with the gains" in str(converted.remarks.of("assumed"))) == (gain == 0.0)
