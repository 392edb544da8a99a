"""The scenes of `kernel_costs.py`: cases of the repository, and arrays with a made-up database."""

from __future__ import annotations

import runpy
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tests.benchmark.array_scenes import Layout, write_array

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "cases"
STARTERS = ROOT / "python" / "hydrodae" / "starters"


@dataclass(frozen=True)
class Scene:
    """A case, and how much of it is run."""

    case: Path
    end: float  # s
    values: dict[str, Any] = field(default_factory=dict)

    @property
    def keys(self) -> dict[str, Any]:
        """Values that replace those of the case."""
        return {"solver.end_time": self.end} | self.values


def windows(count: int) -> Path:
    """Write the case of a chain of four-bar windows, and return its path."""
    path = ROOT / "build" / f"n_four_bar_{count}.toml"
    path.parent.mkdir(exist_ok=True)
    four_bar = runpy.run_path(str(CASES / "benchmarks" / "four_bar.py"))["four_bar"]
    path.write_text(four_bar(count), encoding="utf-8")
    return path


FIXED = {
    "F3OF, flap decay": Scene(CASES / "f3of" / "flap_decay.toml", 100.0),
    "F3OF, irregular sea": Scene(CASES / "f3of" / "waves.toml", 100.0),
    "sphere, regular wave": Scene(CASES / "sphere" / "wave.toml", 60.0),
    "4N3LA, irregular sea": Scene(CASES / "4n3la" / "irregular.toml", 10.0),
    "9N9LA, irregular sea": Scene(CASES / "9n9la" / "irregular.toml", 5.0),
    "attenuator, irregular sea": Scene(STARTERS / "attenuator" / "case.toml", 30.0),
    "two bodies on catenaries": Scene(STARTERS / "moored" / "case.toml", 30.0),
    "40 four-bar windows": Scene(windows(40), 1.0),
    "chain of 10": Scene(CASES / "benchmarks" / "chain_10.toml", 1.5),
}
ARRAYS = {
    "81 in heave, neighbours": Layout(81, neighbours=True),
    "81 in heave, full": Layout(81, neighbours=False),
}
NAMES = (*FIXED, *ARRAYS)


def scene(name: str, folder: Path) -> Scene | None:
    """Return the scene of a name; None where its database has not been computed."""
    if name in ARRAYS:
        return Scene(write_array(folder, ARRAYS[name]), 5.0)
    found = FIXED[name]
    text = found.case.read_text()
    return found if "[hydro]" not in text or (found.case.parent / "hydro.h5").exists() else None
