"""What the benchmark of costs is made of: its arrays, its tables, and what it says has changed."""

from __future__ import annotations

from copy import deepcopy
from pathlib import Path

import numpy as np
import pytest
from tests.benchmark import kernel_costs as costs
from tests.benchmark.array_scenes import SPACING, Layout, database, write_array

from hydrodae import Case

RECORD: costs.Record = {
    "scenes": {"a": {"instructions": {"march": 1000, "read": 50}, "seconds": {"march": 1.0}}}
}


@pytest.mark.parametrize("rigid", [True, False])
@pytest.mark.parametrize("neighbours", [True, False])
def test_arrays_take_energy_and_couple_as_they_say(neighbours: bool, rigid: bool) -> None:
    layout = Layout(19, neighbours, rigid)
    fit = database(layout).memory["made up"]
    damping = fit.transfer(np.linspace(0.0, 5.0, 50))
    lowest = np.linalg.eigvalsh(damping + damping.conj().transpose(0, 2, 1)).min()
    assert lowest > -1e-9 * np.abs(damping).max()
    assert np.linalg.eigvalsh(fit.added_mass_inf).min() > 0.0
    at = np.repeat(layout.places(), len(layout.dofs), axis=0)
    far = np.linalg.norm(at[:, None] - at, axis=2) / SPACING
    reach = 2.0 if neighbours else 4.0  # neighbours are coupled through a third body as well
    assert np.array_equal(np.abs(damping).max(axis=0) > 0.0, far < reach + 1e-9)


def test_an_array_is_a_case(tmp_path: Path) -> None:
    case = Case.read(write_array(tmp_path, Layout(3, neighbours=True, rigid=True)))
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
