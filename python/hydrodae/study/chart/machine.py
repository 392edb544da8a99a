"""The machine that a time was measured on."""

from __future__ import annotations

import os
import platform
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from hydrodae.support.version import version


def machine() -> dict[str, Any]:
    """Processor, number of cores, versions and date: what a time depends on."""
    from hydrodae import _core

    model = platform.processor() or platform.machine()
    try:
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                model = line.partition(":")[2].strip()
                break
    except OSError:
        pass
    return {
        "processor": model,
        "cores": os.cpu_count(),
        "system": platform.system(),
        "python": platform.python_version(),
        "hydrodae": version(),
        "kernel": _core.version,
        "date": datetime.now(UTC).isoformat(timespec="seconds"),
    }
