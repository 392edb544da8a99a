"""The map of methods against hard scenes: which pass, which stop, which are refused.

A run that returns success with a wrong motion is the one outcome that must not happen.
"""

from hydrodae.study.stability.grid import Cell, all_methods, all_scenes, run_cell, stability_map
from hydrodae.study.stability.methods import Method
from hydrodae.study.stability.scene import Scene

__all__ = ["Cell", "Method", "Scene", "all_methods", "all_scenes", "run_cell", "stability_map"]
