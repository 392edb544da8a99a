"""The water of a scene: waves, depth, seabed."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from hydrodae.hdb.database.files import DAMAGED, damaged
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.damaged import reading
from hydrodae.viewer.source import Source
from hydrodae.viewer.stage import Sea

#: Most wave components that are drawn.
MOST = 400


def make_sea(source: Source, tables: Mapping[str, Any]) -> tuple[Sea | None, list[str]]:
    """The sea of a case, and notes of what is left out of it; None for a case without water."""
    environment = tables.get("environment", {})
    path = source.case.scene.database_path
    wet = path or tables.get("wave") or tables.get("morison")
    if not wet and not {"water_density", "water_depth"} & set(environment):
        return None, []
    depth, gravity = environment.get("water_depth", np.inf), environment.get("gravity", 9.81)
    if path:
        depth, gravity = reading(Path(path), damaged, DAMAGED, _water)
    waves, notes = _waves(source, depth, gravity)
    return Sea(waves, float(tables.get("sea", {}).get("ramp", 0.0)), depth), notes


def _water(file: h5py.File) -> tuple[float, float]:
    """Depth [m] and gravity [m/s2] of a database."""
    return float(file.attrs["water_depth"]), float(file.attrs["gravity"])


def _waves(source: Source, depth: float, gravity: float) -> tuple[np.ndarray[Any, Any], list[str]]:
    """Components (n, 5): frequency, wavenumber, heading, amplitude, phase."""
    from hydrodae import _core

    found = np.asarray(_core.wave_components(source.case.scene), dtype=float).reshape(-1, 4)
    notes = []
    if len(found) > MOST:
        energy = found[:, 2] ** 2
        kept = np.sort(np.argsort(energy)[-MOST:])
        part = 100.0 * energy[kept].sum() / energy.sum()
        notes.append(
            f"the sea is drawn with the {MOST} largest of {len(found)} wave components, "
            f"{part:.1f} % of the energy"
        )
        found = found[kept]
    k = wavenumber(found[:, 0], depth, gravity)
    return np.column_stack([found[:, 0], k, found[:, 1:]]), notes


def seabed(sea: Sea | None, tables: Mapping[str, Any]) -> float | None:
    """Height of the seabed [m]: of the water, else of what lies on it; None if unknown."""
    if sea is not None and np.isfinite(sea.depth):
        return -sea.depth
    heights = []
    for force in tables.get("force", []):
        if force["type"] == "catenary" and force.get("seabed", True):
            if force.get("body_a", "ground") == "ground":
                heights.append(float(force["point_a"][2]))
        if force["type"] == "line" and "seabed_depth" in force:
            heights.append(-float(force["seabed_depth"]))
    return min(heights) if heights else None
