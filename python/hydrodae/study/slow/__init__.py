"""Slow drift in the frequency domain: loads of pairs of waves, and the moored motion by them."""

from __future__ import annotations

from hydrodae.study.slow.motion import SlowMotion, slow_motion

__all__ = ["SlowMotion", "slow_motion"]
