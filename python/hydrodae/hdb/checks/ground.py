"""Bodies that stand on the ground: they cannot move, and errors of their own motion do not matter.

Between the foot of a hinged flap and the base below it, both meshed, panel methods find what no
water does: forces that are not reciprocal, and damping that feeds energy into the pair. The flap
alone is right, and the base never moves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.tables import Body

#: A hull within this share of the depth from the ground touches it.
TOUCHING = 1e-4
#: A waterplane below this share of V^(2/3) is rounding.
SUBMERGED = 1e-3


def standing(database: HydroDatabase) -> list[str]:
    """Return the bodies whose hull reaches the ground.

    Returns
    -------
    list of str
        By the mesh; without one, bodies without a waterplane whose moments are about a point on
        the ground.
    """
    depth = database.water_depth
    if not np.isfinite(depth):
        return []
    return [name for name, body in database.bodies.items() if _reaches(body, depth)]


def _reaches(body: Body, depth: float) -> bool:
    statics, point = body.hydrostatics, body.reference_point
    if body.mesh is not None:
        lowest = float(body.mesh[:, :, 2].min())
    elif statics is None or point is None:
        return False
    else:
        area = SUBMERGED * abs(statics.displaced_volume) ** (2.0 / 3.0)
        if abs(statics.waterplane_area) > area:
            return False
        lowest = float(point[2])
    return lowest <= -(1.0 - TOUCHING) * depth


def of_what_moves(
    database: HydroDatabase, judge: Callable[[HydroDatabase], list[Finding]]
) -> list[Finding]:
    """Judge a database; errors that only bodies on the ground make are warnings.

    Parameters
    ----------
    database : HydroDatabase
    judge : function
        Returns the findings of a database.

    Returns
    -------
    list of Finding
        Those of the whole, and one that says what was assumed, where that mattered.
    """
    found = judge(database)
    held = standing(database) if any(f.severity == "error" for f in found) else []
    moving = [str(label) for label in database.labels if label.body not in held]
    if not held or not moving:
        return found
    left = {f.check for f in judge(database.select(moving)) if f.severity == "error"}
    if all(f.check in left for f in found if f.severity == "error"):
        return found
    one = len(held) == 1
    text = (
        f"{' and '.join(held)} {'stands' if one else 'stand'} on the ground at "
        f"{-database.water_depth:g} m and cannot move: errors that {'its' if one else 'their'} "
        f"own motion makes are warnings; --keep what moves leaves them out"
    )
    return [
        Finding("warning", "assumption", text),
        *(
            replace(f, severity="warning") if f.severity == "error" and f.check not in left else f
            for f in found
        ),
    ]
