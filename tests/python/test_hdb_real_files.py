"""Real files of four codes: phase, symmetry, frequencies, depth and volumes as they stand there."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from hydrodae import hdb
from hydrodae.hdb.readers.reading import read_source

# folder: frequencies, depth [m], asymmetry of A over its largest entry, surge phase near 0.5 rad/s
# in x(t) = Re(X e^{+iwt}) (Nemoh's files hold the negative), displaced volumes [m3] or None
FILES: dict[str, tuple[int, float, float, float, list[float | None]]] = {
    "sphere_nemoh_v2.3": (420, 50.0, 2e-6, 1.569, [261.3639]),
    "sphere_nemoh_v3.0.2": (420, 50.0, 4e-6, 1.569, [261.3639]),
    "sphere_wamit": (420, 50.0, 7e-6, 1.569, [261.364]),
    "rm3_nemoh_v2.3": (260, np.inf, 0.455, 1.564, [725.8328, 886.6924]),
    # both hydrostatics files hold the sum of the two bodies: refused
    "rm3_nemoh_v3.0.2": (260, np.inf, 0.797, 1.564, [None, None]),
    "rm3_wamit": (260, np.inf, 0.0208, 1.564, [725.833, 886.687]),
    "cylinder_nemoh_v3.0.2": (525, 3.0, 0.0072, 1.571, [0.24176]),
    "oc3hywind_nemoh_v3.0.2": (128, np.inf, 1.2e-5, 1.533, [32081.97]),
    "volturnus_nemoh": (50, 200.0, 8.6e-5, 1.411, [20075.01]),
    "iea_sphere_bemio_h5/iea_sphere.h5": (240, 200.0, 3.3e-5, 1.571, [261.724]),
}


@pytest.mark.parametrize("name", FILES)
def test_what_stands_in_the_file(reference, name):
    count, depth, asymmetry, phase, volumes = FILES[name]
    options: dict[str, Any] = {"rho": 1000.0} if name.endswith("wamit") else {}
    source = read_source(reference / "hdb" / name, **options)
    a = np.asarray(source.added_mass)
    found = np.abs(a - a.transpose(0, 2, 1)).max() / np.abs(a).max()
    assert found == pytest.approx(asymmetry, rel=0.3)
    db = hdb.read(reference / "hdb" / name, **options)
    assert np.array_equal(db.added_mass, db.added_mass.transpose(0, 2, 1))
    assert db.omega.size == count
    assert db.water_depth == depth
    at = int(np.abs(db.omega - 0.5).argmin())
    surge = db.index([label for label in db.coordinates if label.endswith(".surge")])
    np.testing.assert_allclose(np.angle(db.excitation[at, 0, surge]), phase, atol=2e-3)
    hydrostatics = [body.hydrostatics for body in db.bodies.values()]
    for ours, volume in zip(hydrostatics, volumes, strict=True):
        if volume is None:
            assert ours is None
        else:
            assert ours is not None
            assert ours.displaced_volume == pytest.approx(volume, rel=1e-4)
