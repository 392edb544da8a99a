"""The exact motions in tests/verification/truths are what their scripts make."""

from __future__ import annotations

import numpy as np
import pytest
from tests.verification.truths import make as truths

LONG = ("andrews", "bricard", "light_joint", "pendulum_1000s", "tumbling_body")


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=pytest.mark.slow if n in LONG else ()) for n in truths.PROBLEMS]
)
def test_a_stored_motion_is_what_its_script_makes(name: str) -> None:
    stored, made = truths.read(name), truths.solve(name)
    assert stored["columns"] == made["columns"]
    assert np.shape(stored["rows"]) == np.shape(made["rows"])
    apart = np.abs(np.array(stored["rows"]) - np.array(made["rows"])).max()
    assert apart <= truths.PROBLEMS[name].agreement


def test_every_file_has_a_script_and_is_small() -> None:
    files = sorted(truths.FOLDER.glob("*.json"))
    assert {file.stem for file in files} == set(truths.PROBLEMS)
    assert all(file.stat().st_size < 100 * 1024 for file in files)


def test_andrews_ends_where_the_handbook_has_it() -> None:
    """Crank angle at 0.03 s: E. Hairer, G. Wanner, Solving Ordinary Differential Equations II."""
    rows = np.array(truths.read("andrews")["rows"])
    beta = rows[np.isclose(rows[:, 0], 0.03), 3]
    assert beta == pytest.approx([15.81077119629904], abs=2e-8)


def test_solutions_that_do_not_agree_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    from dataclasses import replace

    strict = replace(truths.PROBLEMS["door"], agreement=1e-30)
    monkeypatch.setitem(truths.PROBLEMS, "door", strict)
    with pytest.raises(SystemExit, match=r"door: the solutions are .* apart"):
        truths.solve("door")
