"""Design values: most likely waves, extremes of runs, return levels of years, contours of seas."""

from __future__ import annotations

from hydrodae.study.extremes.contour import Contour, JointModel, contour
from hydrodae.study.extremes.design import Design, design_value
from hydrodae.study.extremes.likely_wave import LikelyWave, likely_wave
from hydrodae.study.extremes.long_term import LongTerm, linear_long_term, runs_long_term
from hydrodae.study.extremes.writing import write_case, write_components

__all__ = [
    "Contour",
    "Design",
    "JointModel",
    "LikelyWave",
    "LongTerm",
    "contour",
    "design_value",
    "likely_wave",
    "linear_long_term",
    "runs_long_term",
    "write_case",
    "write_components",
]
