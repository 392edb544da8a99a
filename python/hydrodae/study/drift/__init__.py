"""Mean drift of a device as it moves, from its far field."""

from __future__ import annotations

from hydrodae.study.drift.far_field import Drift, drift
from hydrodae.study.drift.offset import Offset, mean_offset

__all__ = ["Drift", "Offset", "drift", "mean_offset"]
