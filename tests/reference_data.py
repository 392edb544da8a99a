"""Where the reference data is: $HYDRODAE_REFERENCE, or shared/reference beside the repository."""

from __future__ import annotations

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def folder() -> Path:
    """Folder of the reference data, there or not."""
    named = os.environ.get("HYDRODAE_REFERENCE")
    return Path(named) if named else ROOT.parent / "shared" / "reference"


def required(*names: str) -> Path:
    """Path of a file or folder of the reference data; ends with exit code 2 where there is none."""
    path = folder().joinpath(*names)
    if not path.exists():
        print(f"no reference data in {path}: set HYDRODAE_REFERENCE to its folder", file=sys.stderr)
        raise SystemExit(2)
    return path
