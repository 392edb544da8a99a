"""The map of methods against hard scenes: which pass, which stop, which are refused.

A run that returns success with a wrong motion is the one outcome that must not happen.
"""

from tests.stability.grid import Cell, all_methods, all_scenes, run_cell, stability_map
from tests.stability.methods import Method
from tests.stability.scene import Scene

__all__ = ["Cell", "Method", "Scene", "all_methods", "all_scenes", "run_cell", "stability_map"]
