"""Makes the exact motions of the cases in cases/benchmarks, one JSON file each beside this script.

    .venv/bin/python tests/verification/truths/make.py [NAME ...]

Each is solved twice, at two tolerances or by two methods. A file holds how it was solved, how far
both solutions are apart (`agreement`), the names of the columns and a row for each output time.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

FOLDER = Path(__file__).resolve().parent
sys.path.insert(0, str(FOLDER.parents[2]))

from tests.verification.truths import andrews, bricard, planar, spatial  # noqa: E402
from tests.verification.truths.problem import FINE, Problem  # noqa: E402

PROBLEMS: dict[str, Problem] = {
    **planar.PROBLEMS,
    **spatial.PROBLEMS,
    **andrews.PROBLEMS,
    **bricard.PROBLEMS,
}


def read(name: str) -> dict[str, Any]:
    """The document of a problem as it is stored."""
    document: dict[str, Any] = json.loads((FOLDER / f"{name}.json").read_text(encoding="utf-8"))
    return document


def solve(name: str) -> dict[str, Any]:
    """The document of a problem. Both solutions must agree."""
    problem = PROBLEMS[name]
    motion = problem.motion(problem.time, FINE)
    apart = float(np.abs(motion - problem.motion(problem.time, problem.check)).max())
    if not apart < problem.agreement:
        sys.exit(f"{name}: the solutions are {apart:.1e} apart, not within {problem.agreement:.0e}")
    rows = np.column_stack([problem.time, motion])
    return {
        "method": problem.method,
        "agreement": float(f"{apart:.1e}"),
        "columns": ["t", *problem.columns],
        "rows": [[float(f"{value:.13g}") for value in row] for row in rows],
    }


def write(name: str, document: dict[str, Any]) -> None:
    """One line for each row."""
    head = json.dumps({key: value for key, value in document.items() if key != "rows"}, indent=1)
    rows = ",\n".join(json.dumps(row) for row in document["rows"])
    text = f'{head[:-2]},\n "rows": [\n{rows}\n]}}\n'
    (FOLDER / f"{name}.json").write_text(text, encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(PROBLEMS)}")
    names = parser.parse_args().names or list(PROBLEMS)
    if unknown := [name for name in names if name not in PROBLEMS]:
        parser.error(f"no problem {', '.join(unknown)}: {', '.join(PROBLEMS)}")
    for name in names:
        document = solve(name)
        write(name, document)
        print(f"{name:<20} {document['method']}; agree within {document['agreement']:.0e}")


if __name__ == "__main__":
    main()
