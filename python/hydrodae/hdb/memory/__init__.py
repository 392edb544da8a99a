"""Exponential radiation memory: fits of the stored impedance, their passivity, storage."""

from __future__ import annotations

from hydrodae.hdb.memory.fit import MemoryFitWarning, fit_memory
from hydrodae.hdb.memory.model import ExponentialMemory
from hydrodae.hdb.memory.passivity import Passivity

__all__ = ["ExponentialMemory", "MemoryFitWarning", "Passivity", "fit_memory"]
