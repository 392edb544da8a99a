"""Python functions that coordinates follow."""

from __future__ import annotations

import numpy as np
import pytest

import hydrodae

CASE = """
[[body]]
name = "arm"
motion = "planar"
mass = 2.0
center_of_gravity = [0.5, 0.0, 0.0]
inertia = [0.1, 0.1, 0.1]

[[joint]]
name = "hinge"
type = "revolute"
body_a = "ground"
body_b = "arm"
point = [0.0, 0.0, 0.0]
axis = [0.0, 1.0, 0.0]

[[constraint]]
name = "motor"
type = "coordinate"
joint = "hinge"
drive = { python = true }

[solver]
end_time = 3.0
rtol = 1e-8
"""


def angle(t: float) -> float:
    return float(0.3 * np.sin(2.0 * t) + 0.1 * t**2)


def motion(t: float) -> tuple[float, float, float]:
    return angle(t), 0.6 * np.cos(2 * t) + 0.2 * t, -1.2 * np.sin(2 * t) + 0.2


def case() -> hydrodae.Case:
    return hydrodae.Case.from_text(CASE)


@pytest.mark.parametrize("function", [angle, motion])
def test_joint_follows_the_function(function: object) -> None:
    results = hydrodae.run(case(), drives={"motor": function})  # type: ignore[dict-item]
    exact = np.array([motion(t) for t in results.time])
    np.testing.assert_allclose(results["joints/hinge/angle"], exact[:, 0], atol=1e-7)
    np.testing.assert_allclose(results["joints/hinge/angle_rate"], exact[:, 1], atol=1e-6)
    # what turns it: (I + m a^2) s'' - m g a cos(s), the angle about y being positive downwards
    torque = 0.6 * exact[:, 2] - 2.0 * 9.81 * 0.5 * np.cos(exact[:, 0])
    np.testing.assert_allclose(results["constraints/motor/reaction"], torque, atol=1e-3)


def test_a_late_pulse_of_values_is_seen() -> None:
    """253 s of nothing, then a degree and back within 1.4 s: only what is sampled is there."""
    values = {"solver.end_time": 267.36, "output.step": 0.13}

    def pulse(t: float) -> float:
        s = min(max((t - 253.0) / 1.4, 0.0), 1.0)
        return 0.02 * (4.0 * s * (1.0 - s)) ** 6

    results = hydrodae.run(
        hydrodae.Case(text=CASE, values=values), drives={"motor": lambda t: pulse(t)}
    )
    exact = [pulse(t) for t in results.time]
    assert max(exact) > 0.019
    np.testing.assert_allclose(results["joints/hinge/angle"], exact, atol=1e-6)


def test_rate_level_follows_the_function() -> None:
    text = CASE.replace('joint = "hinge"\n', 'joint = "hinge"\nlevel = "velocity"\n')
    results = hydrodae.run(hydrodae.Case.from_text(text), drives={"motor": lambda t: 0.5 * t})
    np.testing.assert_allclose(results["joints/hinge/angle"], 0.25 * results.time**2, atol=1e-6)


def test_exceptions_come_back() -> None:
    class OutOfFuelError(Exception):
        pass

    def failing(t: float) -> tuple[float, float, float]:
        if t > 1.0:
            raise OutOfFuelError(f"at {t}")
        return motion(t)

    with pytest.raises(OutOfFuelError, match="at 1"):
        hydrodae.run(case(), drives={"motor": failing})


def test_values_that_are_no_numbers_are_refused() -> None:
    with pytest.raises(hydrodae.CaseError, match=r"motor.*returned .*nan"):
        hydrodae.run(case(), drives={"motor": lambda t: (0.0, 0.0, np.nan if t > 1 else 0.0)})
    with pytest.raises(hydrodae.CaseError, match="not finite at t = "):
        hydrodae.run(case(), drives={"motor": lambda t: np.nan if t > 1 else 0.0})


@pytest.mark.parametrize(
    ("drives", "message"),
    [
        (None, "drive of constraint 'motor' is a Python function, which nobody gave"),
        ({"moter": motion}, "did you mean 'motor'"),
        ({"motor": 3.0}, "needs a function of time, got 3.0"),
        ({"motor": lambda t: (t, 1.0)}, "it returned 2 numbers"),
        ({"motor": lambda t: float(t > 1.0)}, "not smooth enough"),
    ],
)
def test_wrong_drives_are_refused(drives: dict[str, object] | None, message: str) -> None:
    with pytest.raises(hydrodae.CaseError, match=message):
        hydrodae.run(case(), drives=drives)  # type: ignore[arg-type]


def test_executable_and_check_say_who_must_give_the_function() -> None:
    with pytest.raises(hydrodae.CaseError, match=r"hydrodae\.run"):
        case().examine()
    assert "a Python function" in case().examine({"motor": motion})
