"""Links without mass: what they pass on, and what they leave free; test_families has motions."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.attack.light import bob_on_links
from tests.attack.parts import GRAVITY, Table, body, case, joint
from tests.verification.blocks import run_tables

import hydrodae
from hydrodae.errors import CaseError


@pytest.mark.parametrize("method", ["auto", "ida", "radau", "explicit_rk"])
def test_massless_links_pass_on_what_their_platform_needs(method: str, tmp_path: Path) -> None:
    scene = bob_on_links(length=2.0, mass=80.0, light=0.0, angle=0.8, n_links=2)
    results = hydrodae.run(scene.case({"method": method, "rtol": 1e-6}, tmp_path))
    forces = [results[f"joints/top{k}/reaction_force"].values for k in (1, 2)]
    needed = results["bodies/bob/acceleration"].values + np.array([0.0, 0.0, GRAVITY])
    np.testing.assert_allclose(
        np.linalg.norm(forces[0] + forces[1], axis=1),
        80.0 * np.linalg.norm(needed, axis=1),
        atol=1.0,
    )


END = joint("end", "spherical", "bob", "rod", [0.0, 0.0, -1.0])


@pytest.mark.parametrize(
    ("joints", "which"),
    [
        ([joint("top", "spherical", "rod", "ground"), END], r" about its axis \[0, 0, 1\]"),
        ([END], ""),
    ],
)
def test_a_direction_without_inertia_that_nothing_holds_is_named(
    joints: list[Table], which: str
) -> None:
    rod = body("rod", "rigid", 0.0, [0.0, 0.0, -0.5], [0.0] * 3)
    bob = body("bob", "rigid", 3.0, [0.0, 0.0, -1.0], [1.0] * 3)
    words = "'rod' has no moment of inertia, and no constraint holds its rotation" + which
    with pytest.raises(CaseError, match=words) as error:
        run_tables(case([rod, bob], 1.0, joints=joints), rtol=1e-6)
    assert "inertia" in str(error.value)
