"""Scenes with much drag: RM3 with plates in the water, and a spar of Morison elements alone."""

from __future__ import annotations

from pathlib import Path

import hydrodae


def sea(height: float, period: float) -> dict[str, object]:
    """A JONSWAP sea."""
    return {"name": "sea", "type": "jonswap", "significant_height": height, "peak_period": period}


def rm3_with_drag(folder: Path, height: float, period: float = 8.0) -> hydrodae.Case:
    """RM3 in heave with the drag of the float's and the spar's plates, C_d of flat discs.

    `folder` has wave.toml and heave.h5 of the fixture `rm3`.
    """
    plates = [
        {"name": "disc", "body": "float", "point": [0.0, 0.0, -3.0], "area": 286.0},
        {"name": "plate", "body": "spar", "point": [0.0, 0.0, -30.0], "area": 707.0},
    ]
    values = {f"body.{body}.motion": "heave" for body in ("float", "spar")}
    more = {
        "hydro.database": "heave.h5",
        "wave": [sea(height, period)],
        "morison": [{**plate, "drag_coefficient": 2.0} for plate in plates],
        "sea.ramp": 50.0,
    }
    return hydrodae.Case(path=folder / "wave.toml", values={**values, **more})


SPAR = """
title = "Spar of Morison elements"
[environment]
water_density = 1025.0
[sea]
ramp = 50.0
[[wave]]
name = "sea"
type = "jonswap"
significant_height = {height}
peak_period = {period}
[[body]]
name = "spar"
motion = ["heave", "pitch"]
mass = 1.449e5
center_of_gravity = [0.0, 0.0, -13.0]
inertia = [5.2e6, 5.2e6, 1.6e5]
[[force]]
type = "constant_load"
name = "buoyancy"
body = "spar"
force = [0.0, 0.0, 1421469.0]
[[force]]
type = "mooring_matrix"
name = "restoring"
body = "spar"
stiffness = [0.0, 0.0, 7.1e4, 0.0, 4.3e6, 0.0]
[[morison]]
name = "hull"
body = "spar"
point_a = [0.0, 0.0, -20.0]
point_b = [0.0, 0.0, 2.0]
diameter = 3.0
drag_coefficient = 1.0
drag_axial = 0.02
added_mass_coefficient = 1.0
segments = 11
[[morison]]
name = "plate"
body = "spar"
point = [0.0, 0.0, -20.0]
area = 28.0
volume = 72.0
drag_coefficient = 4.0
added_mass_coefficient = 1.0
[solver]
end_time = 1100.0
rtol = 1e-5
[output]
step = 0.2
"""


def spar(height: float, period: float = 8.0) -> hydrodae.Case:
    """Heave and pitch, natural periods 11 and 11.7 s; held in surge."""
    return hydrodae.Case.from_text(SPAR.format(height=height, period=period))
