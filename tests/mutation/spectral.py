"""Mutants of the linear equivalents in a sea: drag, laws of one rate, their fixed point."""

from __future__ import annotations

from tests.mutation.subject import Mutant, Subject

_ROOM = "python/hydrodae/study/spectral"
_FACTORS, _LAWS, _POINT = (f"{_ROOM}/{name}.py" for name in ("factors", "laws", "fixed_point"))
_LINEARISE = f"{_ROOM}/linearise.py"

SUBJECT = Subject(
    "spectral",
    (
        *("tests/python/test_rate_laws.py", "tests/verification/test_spectral.py"),
        "tests/verification/test_chamber_spectral.py",
    ),
    (
        Mutant(
            _FACTORS, "np.sqrt(8.0 / np.pi * np.maximum", "1.03 * np.sqrt(8.0 / np.pi * np.maximum"
        ),
        Mutant(_FACTORS, "3.0 * np.sqrt(0.5 * np.pi) if", "3.09 * np.sqrt(0.5 * np.pi) if"),
        Mutant(_FACTORS, "else 8.0 * np.sqrt(2.0 / np.pi)", "else 8.24 * np.sqrt(2.0 / np.pi)"),
        Mutant(_FACTORS, "8.0 / (3.0 * np.pi) * np.abs(amplitude)", "0.82 * np.abs(amplitude)"),
        Mutant(_FACTORS, "0.25 * np.pi * (NODES + 1.0)", "0.24 * np.pi * (NODES + 1.0)"),
        Mutant(_FACTORS, "np.sqrt(1.0 - up**2)", "(1.0 - up**2)"),
        Mutant(
            _FACTORS, "2.0 * (speed * np.cos(angle) ** 2)", "2.0 * (speed * np.sin(angle) ** 2)"
        ),
        Mutant(_FACTORS, "return work / sigma, mean", "return work, mean"),
        Mutant(_FACTORS, "return 2.0 * work / amplitude, mean", "return work / amplitude, mean"),
        Mutant(
            _FACTORS, "np.sqrt(2.0 * np.maximum(values, 0.0))", "np.sqrt(np.maximum(values, 0.0))"
        ),
        Mutant(_FACTORS, "np.full(z.shape, 0.5 / np.pi)", "np.full(z.shape, 0.49 / np.pi)"),
        Mutant(_LAWS, "kinetic * np.sign(v)", "0.97 * kinetic * np.sign(v)"),
        Mutant(_LAWS, "slip + (stick - slip) *", "slip + 0.0 *"),
        Mutant(_LAWS, "g * direction + viscous * v", "g * direction"),
        Mutant(_LAWS, "np.abs(v) ** (n - 1.0) * v", "np.abs(v) ** n * v"),
        Mutant(_LAWS, "constant * v / np.hypot(v, reversal)", "constant * np.sign(v)"),
        Mutant(_LAWS, "np.clip(load, -limit, limit)", "load"),
        Mutant(_POINT, "return bool(np.all(near))", "return True"),
        Mutant(_LINEARISE, "np.sum(factor * motion.covariance)", "np.sum(factor) * 1.0"),
        Mutant(_LINEARISE, "load.axes, 1, 2) @ factor @ load.axes", "load.axes, 1, 2) @ load.axes"),
    ),
)
