"""Time that a fit may take."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import numpy as np

TIME_LIMIT = 300.0
"""Seconds that a fit takes at most where no limit is given."""
SEARCH = 0.6
"""Share of the time for the search without constraints; the rest is left to make it passive."""


@dataclass(frozen=True)
class Clock:
    """Seconds from `start` (of `time.monotonic`) that a part of a fit may take."""

    seconds: float = np.inf
    start: float = field(default_factory=time.monotonic)

    def over(self, share: float = 1.0) -> bool:
        """Return whether this share of the time has passed."""
        return time.monotonic() - self.start >= share * self.seconds

    def part(self, share: float) -> Clock:
        """Return a clock, from now, for a share of what is left."""
        now = time.monotonic()
        return Clock(max(0.0, share * (self.start + self.seconds - now)), now)
