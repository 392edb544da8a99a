"""Runs of one case: in one call, or step by step."""

from hydrodae.simulation.simulate import run
from hydrodae.simulation.stepping import Simulation

__all__ = ["Simulation", "run"]
