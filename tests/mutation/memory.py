"""Mutants of the memory fit: partial fractions, passivity, transfer and kernel of a fit."""

from __future__ import annotations

from tests.mutation.subject import Mutant, Subject

_ROOM = "python/hydrodae/hdb/memory"
_PASSIVITY, _MODEL, _VERDICT, _DATA = (
    f"{_ROOM}/{name}.py" for name in ("passivity", "model", "verdict", "data")
)
_FRACTIONS, _FITTING = (f"{_ROOM}/{name}.py" for name in ("partial_fractions", "vector_fitting"))

SUBJECT = Subject(
    "memory",
    (
        *("tests/python/test_memory.py", "tests/python/test_partial_fractions.py"),
        *("tests/python/test_memory_methods.py", "tests/python/test_pole_searches.py"),
    ),
    (
        Mutant(_PASSIVITY, "ACCEPTED = -5e-5", "ACCEPTED = -5e-4"),
        Mutant(_PASSIVITY, "found.lowest >= ACCEPTED", "found.lowest > -1.0"),
        Mutant(
            _PASSIVITY, "0.5 * (first - second), matrices[:, 1, 0])", "0.5 * (first - second), 0.0)"
        ),
        Mutant(_PASSIVITY, "inner_values.min(initial=values[:, 0].min())", "values[:, 0].min()"),
        Mutant(_VERDICT, "PASSIVE_LIMIT = -1e-4", "PASSIVE_LIMIT = -1e-3"),
        Mutant(_VERDICT, 'if not report.get("target_met", True):', "if False:"),
        Mutant(
            _MODEL,
            "np.exp(np.outer(np.asarray(time, dtype=float), self.poles))",
            "np.exp(1.03 * np.outer(np.asarray(time, dtype=float), self.poles))",
        ),
        Mutant(
            _MODEL,
            "0.5 / (s - self.poles), 0.5 / (s - self.poles.conj())",
            "0.5 / (s - self.poles), 0.5 / (s - self.poles)",
        ),
        Mutant(_MODEL, "left.conj(), right.conj()", "left, right"),
        Mutant(_MODEL, "np.any(self.poles.real >= 0.0)", "False"),
        Mutant(_MODEL, "for _ in range(2):", "for _ in range(0):"),
        Mutant(
            _MODEL,
            "2 * self.poles.size - np.count_nonzero",
            "2 * self.poles.size + 0 * np.count_nonzero",
        ),
        Mutant(_FRACTIONS, "inverse, -2.0 * poles.imag", "inverse, 2.0 * poles.imag"),
        Mutant(_FRACTIONS, "a * (a * a + b * b + square)", "a * (a * a + b * b - square)"),
        Mutant(_FRACTIONS, "-2.0 * b * real / size", "-1.94 * b * real / size"),
        Mutant(_FITTING, "1j * (direct[:, pair] - other)", "1j * (direct[:, pair] + other)"),
        Mutant(_FITTING, "1j * coefficients[at + 1]", "-1j * coefficients[at + 1]"),
        Mutant(_FITTING, "(count - real) // 2", "(count - real)"),
        Mutant(_DATA, "NOISE = 1e-8", "NOISE = 1e-3"),
        Mutant(_DATA, "ZERO_WEIGHT = 3.0", "ZERO_WEIGHT = 0.0"),
    ),
)
