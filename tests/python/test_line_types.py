"""Line types by diameter."""

from __future__ import annotations

import math

import pytest

import hydrodae
from hydrodae.errors import CaseError


def test_line_types() -> None:
    """Against makers' and OrcaFlex's formulas for chain, and the chain of MoorDyn's tests."""
    chain = hydrodae.mooring.studless_chain(0.14)
    assert chain.mass == pytest.approx(390.0, rel=0.01)
    assert chain.volume_diameter == pytest.approx(0.252)
    assert chain.stiffness == pytest.approx(1.674e9, rel=0.01)
    # DNV-OS-E302, grade R4: 0.0274 d^2 (44 - 0.08 d) kN, d in mm.
    d = 140.0
    assert chain.breaking_load == pytest.approx(27.4 * d**2 * (44.0 - 0.08 * d), rel=0.02)
    assert chain.weight() == pytest.approx((chain.mass - 1025.0 * math.pi / 4 * 0.252**2) * 9.81)
    studs = hydrodae.mooring.studlink_chain(0.1)
    assert studs.stiffness == pytest.approx(1.01e11 * 0.1**2, rel=0.15)
    assert hydrodae.mooring.wire(0.08).mass == pytest.approx(33.9, rel=0.01)
    rope = hydrodae.mooring.polyester(0.2)
    assert 0.0 < rope.weight() < rope.mass * 9.81 * 0.3
    assert rope.stiffness / rope.breaking_load == pytest.approx(14.0)
    nylon = hydrodae.mooring.nylon(0.2)
    assert nylon.stiffness < 0.5 * rope.stiffness
    with pytest.raises(CaseError, match=r"at most 0\.3 m"):
        hydrodae.mooring.chain(120.0)
