"""Exponential radiation memory: fits of the stored impedance, their passivity, storage."""

from __future__ import annotations

from hydrodae.memory.fit import MemoryFitWarning, fit_memory
from hydrodae.memory.model import ExponentialMemory
from hydrodae.memory.passivity import Passivity

__all__ = ["ExponentialMemory", "MemoryFitWarning", "Passivity", "fit_memory"]
