"""Runs of one's own with Capytaine against tables of WAMIT and Aquaplus; see bem_codes.py."""

from __future__ import annotations

import pytest
from tests.benchmark import bem_codes

pytest.importorskip("capytaine", reason="needs the extra bem")


@pytest.mark.long
def test_a_cylinder_is_that_of_wamit(reference, tmp_path):
    found = bem_codes.cylinder(tmp_path, 5)
    assert max(found.values()) < 0.01, found


@pytest.mark.long
def test_forces_on_two_boxes_at_45_degrees_are_those_of_aquaplus(tmp_path):
    assert bem_codes.boxes(tmp_path)["F"] < 0.03
