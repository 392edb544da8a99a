"""Motion in a sea by statistical linearisation: between linear response and time domain."""

from __future__ import annotations

from hydrodae.study.spectral.motion import Spectral, spectral

__all__ = ["Spectral", "spectral"]
