"""Marker channels against the closed forms of a pendulum and of a turning body."""

from __future__ import annotations

import numpy as np
import pytest
from tests.attack.parts import Table, Y, body, case, joint
from tests.verification.blocks import case_of, run_tables

import hydrodae

GRAVITY = 9.81
ARM = 1.2  # m, the centre of gravity from the hinge
TIP = 2.0  # m, the marker from the hinge


def pendulum(**change: str) -> Table:
    """Return a rod with markers at its tip, the second of them changed."""
    hinge = joint("hinge", "revolute", "ground", "rod", axis=Y, initial={"angle_deg": 70.0})
    tip = dict(body="rod", point=[0.0, 0.3, -TIP])
    markers = [tip | {"name": "tip"}, tip | {"name": "accelerometer", "axes": "body"} | change]
    rod = body("rod", "rigid", 3.0, [0.0, 0.0, -ARM], [0.49, 0.5, 0.02])
    tables = case([rod], 5.0, joints=[hinge], marker=markers)
    del tables["output"]
    return tables


def test_tip_of_a_pendulum() -> None:
    results = run_tables(pendulum(), rtol=1e-9)
    angle = results["joints/hinge/angle"].values
    rate = results["joints/hinge/angle_rate"].values
    acceleration = -3.0 * GRAVITY * ARM * np.sin(angle) / (0.5 + 3.0 * ARM**2)
    # About y the tip hangs along u = (-sin a, 0, -cos a) and moves along w = du/da.
    u = np.column_stack([-np.sin(angle), 0 * angle, -np.cos(angle)])
    w = np.column_stack([-np.cos(angle), 0 * angle, np.sin(angle)])
    tip = {
        kind: results[f"markers/tip/{kind}"] for kind in ("position", "velocity", "acceleration")
    }
    np.testing.assert_allclose(tip["position"], TIP * u + [0, 0.3, 0], atol=1e-7)
    np.testing.assert_allclose(tip["velocity"], TIP * rate[:, None] * w, atol=1e-6)
    expected = TIP * (acceleration[:, None] * w - (rate**2)[:, None] * u)
    np.testing.assert_allclose(tip["acceleration"], expected, atol=1e-5)
    turning = results["bodies/rod/angular_acceleration"].values[:, 1]
    np.testing.assert_allclose(turning, acceleration, atol=1e-5)
    # In body axes: along and across the rod.
    own = results["markers/accelerometer/acceleration"]
    assert own.attrs["frame"] == "body rod"
    np.testing.assert_allclose(own.values[:, 0], -TIP * acceleration, atol=1e-5)
    np.testing.assert_allclose(own.values[:, 2], TIP * rate**2, atol=1e-5)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"body": "rot"}, "did you mean 'rod'"),
        ({"axes": "bodi"}, "did you mean 'body'"),
        ({"name": "tip"}, "two marker entries have the name 'tip'"),
    ],
)
def test_wrong_markers_are_refused(change: Table, message: str) -> None:
    with pytest.raises(hydrodae.CaseError, match=message):
        case_of(pendulum(**change))
