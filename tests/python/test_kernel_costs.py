"""What the benchmark of costs is made of: its arrays, its tables, and what it says has changed."""

from __future__ import annotations

from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest
from tests.benchmark import kernel_costs as costs
from tests.benchmark.kernel_scenes import database, write_array

from hydrodae import Case

RECORD: costs.Record = {
    "scenes": {"a": {"instructions": {"march": 1000, "read": 50}, "seconds": {"march": 1.0}}}
}


@pytest.mark.parametrize("limited", [True, False])
def test_arrays_take_energy_and_couple_as_they_say(limited: bool) -> None:
    made = database(4, limited)
    fit = made.memory["made up"]
    damping = fit.transfer(np.linspace(0.0, 5.0, 50))
    lowest = np.linalg.eigvalsh(damping + damping.conj().transpose(0, 2, 1)).min()
    assert lowest > 0.0
    apart = ~np.eye(4, dtype=bool)
    assert np.all((fit.added_mass_inf[apart] == 0.0) == limited)
    assert np.all((damping[:, apart] == 0.0) == limited)


def test_an_array_is_a_case(tmp_path: Path) -> None:
    case = Case.read(write_array(tmp_path, limited=True, count=3).case)
    assert case.body_names == ["b0", "b1", "b2"]


def test_changes_show_counts_that_differ_and_no_noise_of_times() -> None:
    now = deepcopy(RECORD)
    assert costs.changes(RECORD, now) == "nothing has changed"
    now["scenes"]["a"]["instructions"]["march"] = 900
    now["scenes"]["a"]["seconds"]["march"] = 1.2
    now["scenes"]["new"] = now["scenes"]["a"]
    rows = costs.changes(RECORD, now).splitlines()[2:]
    assert rows == ["| a | march, instructions | 1 000 | 900 | 0.90 |"]


def test_tables_stand_between_the_markers_of_a_page(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text(f"before\n{costs.BEGIN}\nold\n{costs.FINISH}\nafter\n")
    costs.put("new", page)
    assert page.read_text() == f"before\n{costs.BEGIN}\n\nnew\n\n{costs.FINISH}\nafter\n"
