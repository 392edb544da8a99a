"""Response amplitude operators: the frequency domain, and regular-wave runs beside it."""

from __future__ import annotations

from hydrodae.study.rao.regular_waves import Harmonic
from hydrodae.study.rao.responses import Rao, rao

__all__ = ["Harmonic", "Rao", "rao"]
