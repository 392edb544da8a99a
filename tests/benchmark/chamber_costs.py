"""What a chamber of air costs: processor time of runs, against a linear take-off in its place.

    .venv/bin/python tests/benchmark/chamber_costs.py

The starter `owc` in its sea, without the second run that estimates the error. The damper takes
what the Wells turbine takes at small pressures without the spring of the air. Times are the least
of some runs. Aims: 1.15 with the Wells turbine, 1.5 with an orifice that is laminar up
to 1 Pa.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import tomllib
from pathlib import Path
from typing import Any

import hydrodae
from hydrodae.case.case import to_toml
from hydrodae.commands.cli import guarded
from hydrodae.starters import create

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.benchmark.ratios import print_ratios  # noqa: E402

DENSITY = 1.225
AIMS = {"wells": 1.15, "orifice": 1.5}


def cases(folder: Path, end: float) -> dict[str, hydrodae.Case]:
    """The column with a damper on its mode, below a Wells turbine, and below an orifice."""
    path = create("owc", folder / "owc")
    tables: dict[str, Any] = tomllib.loads(path.read_text())
    tables["solver"] |= {"end_time": end, "accuracy": "none", "energy_guard": 0.0}
    tables["output"] = {"step": 0.5}
    (turbine,), (piston,) = tables["outlet"], tables["piston"]
    flow = turbine["flow_slope"] * turbine["diameter"] / turbine["speed"]  # kg/(s Pa)
    made = {}
    for name in ("damper", "wells", "orifice"):
        other = {
            key: [dict(t) for t in v] if isinstance(v, list) else v for key, v in tables.items()
        }
        if name == "damper":
            for key in ("chamber", "piston", "outlet"):
                del other[key]
            other["mode"][0]["damping"] = piston["area"] ** 2 * DENSITY / flow
        elif name == "orifice":
            hole = {"coefficient": 0.62, "area": 0.3, "laminar_pressure": 1.0}
            other["outlet"] = [{"name": "hole", "type": "orifice", "chamber": "air", **hole}]
        made[name] = hydrodae.Case(written(other), directory=path.parent)
    return made


def written(tables: dict[str, Any]) -> str:
    """Text of a case file."""
    lines = []
    for key, value in tables.items():
        if isinstance(value, str):
            lines.append(f"{key} = {to_toml(value, key)}")
        for table in value if isinstance(value, list) else [value]:
            if isinstance(table, dict):
                lines.append(f"[[{key}]]" if isinstance(value, list) else f"[{key}]")
                lines += [f"{name} = {to_toml(v, name)}" for name, v in table.items()]
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--end", type=float, default=1800.0, help="of the runs, s")
    parser.add_argument("--repeats", type=int, default=5)
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        print_ratios(cases(folder, given.end), folder / "results.h5", given.repeats, AIMS)


if __name__ == "__main__":
    sys.exit(guarded(main))
