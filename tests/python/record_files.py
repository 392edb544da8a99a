"""Files of records: a cosine, a spectrum in closed form."""

from __future__ import annotations

from pathlib import Path

import numpy as np

TIME = np.asarray(np.arange(200) * 0.1, dtype=np.float64)
ETA = np.asarray(np.cos(1.3 * TIME), dtype=np.float64)


def written(folder: Path, text: str, encoding: str = "utf-8") -> Path:
    path = folder / "record.txt"
    path.write_text(text, encoding=encoding)
    return path


def table(header: str, *columns) -> str:
    """Return columns between commas, below a header."""
    rows = [",".join(f"{x:.12g}" for x in row) for row in zip(*columns, strict=True)]
    return "\n".join([header, *rows, ""])


OMEGA = np.linspace(0.2, 3.0, 141)
PEAK = 0.9


def bretschneider(omega):
    """Of 2 m, in m2 s/rad."""
    return 5.0 / 16.0 * 2.0**2 * PEAK**4 / omega**5 * np.exp(-1.25 * (PEAK / omega) ** 4)
