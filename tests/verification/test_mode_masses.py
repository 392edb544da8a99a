"""Masses of modes: light modes in the water, and mass that couples modes and rigid motions."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.verification.test_modes import write_wet_beam

import hydrodae


@pytest.mark.parametrize("amplitude", [0.1, 1e-3])
def test_added_mass_is_part_of_the_scale_of_the_energy(tmp_path: Path, amplitude: float) -> None:
    """A mode of 1 mg with an added mass of 40 kg: errors of its energy are those of 40 kg."""
    write_wet_beam(tmp_path / "hydro.h5")
    scene = hydrodae.Scene("a light mode", directory=tmp_path)
    scene.hydro(database="hydro.h5", radiation="none")
    scene.body("beam", hydro="beam", motion="heave", mass=1e3, center_of_gravity=[0.0, 0.0, 0.0])
    start: Any = {"amplitude": amplitude}
    scene.mode("bend", body="beam", mass=1e-6, stiffness=4000.0, initial=start)
    scene.solver(end_time=1.0, method="ida", rtol=1e-3, accuracy="none")
    assert hydrodae.run(scene).status == "completed"
