"""Convert and run the examples of WEC-Sim.

    python cases/wecsim/compare.py WEC-Sim WEC-Sim_Applications
    HYDRODAE_WECSIM=clones python cases/wecsim/compare.py --survey

The clones are WEC-Sim/WEC-Sim and WEC-Sim/WEC-Sim_Applications. `examples.json` lists the folders
and the figure of each. The table is Markdown. `--survey` takes every input file below the folders,
or below the one that HYDRODAE_WECSIM names, and says which convert whole; see `survey.py`.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
import time
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import figures  # type: ignore[import-not-found] # stands beside this file
import survey  # type: ignore[import-not-found] # stands beside this file

import hydrodae
from hydrodae.case.callbacks.files import read_functions
from hydrodae.errors import HydrodaeError
from hydrodae.wecsim import convert

EXAMPLES = Path(__file__).with_name("examples.json")
HEADER = (
    "| folder | runs | figure | hydrodae | reference | difference | convert, s | run, s |\n"
    "|---|---|---|---|---|---|---|---|"
)


@dataclass
class Row:
    """One example.

    Attributes
    ----------
    folder : str
        Its folder in the clone.
    runs : str
        "yes", "part: what the case lacks" or "no: why".
    figure : figures.Figure, optional
        What is compared; missing where the example does not run or has no figure.
    note : str
        Why the figure is missing.
    converting, running : float, optional
        Wall time in s.
    """

    folder: str
    runs: str
    figure: figures.Figure | None = None
    note: str = ""
    converting: float | None = None
    running: float | None = None

    def __str__(self) -> str:
        cells = [self.folder, self.runs]
        cells += [self.note, "", "", ""] if self.figure is None else self.figure.cells()
        cells += ["" if t is None else f"{t:.1f}" for t in (self.converting, self.running)]
        return "| " + " | ".join(cell.replace("|", "/") for cell in cells) + " |"


def row_of(example: dict[str, Any], clones: list[Path], work: Path) -> Row:
    """Convert and run one example.

    Parameters
    ----------
    example : dict
        Entry of `examples.json`.
    clones : list of Path
        Where to look for its folder.
    work : Path
        Folder for the case.
    """
    folder = example["folder"]
    found = [clone / folder for clone in clones if (clone / folder).exists()]
    if not found:
        return Row(folder, "no: not in these clones")
    row = Row(folder, "yes")
    begin = time.perf_counter()
    try:
        converted = convert(found[0], work, accept=None, define=example.get("define"))
        row.converting = time.perf_counter() - begin
        begin = time.perf_counter()
        functions = read_functions(converted.functions) if converted.functions else {}
        results = hydrodae.run(converted.case, set=example.get("set"), **functions)
        row.running = time.perf_counter() - begin
        if results.status != "completed":
            return Row(folder, f"no: {results.status}", None, "", row.converting, row.running)
        lacks = [r.text for r in converted.remarks.of("left out")]
        harmless = example.get("harmless", [])
        lacks = [text for text in lacks if not any(word in text for word in harmless)]
        if lacks:
            more = f" and {len(lacks) - 1} more" if len(lacks) > 1 else ""
            row.runs = f"part: without {_short(lacks[0], 60)}{more}"
        row.figure = figures.make(example, results, converted.case, found[0])
    except figures.NoFigure as why:
        row.note = str(why)
    except HydrodaeError as error:
        row.runs = f"no: {_short(str(error).replace(str(found[0]), folder), 110)}"
    return row


def _short(text: str, length: int) -> str:
    text = " ".join(text.split())
    return text if len(text) <= length else text[: length - 3].rstrip() + "..."


def read_examples(path: Path) -> list[dict[str, Any]]:
    """The list of a JSON file."""
    return list(json.loads(path.read_text(encoding="utf-8")))


def _compared(given: argparse.Namespace, parser: argparse.ArgumentParser) -> str:
    rows: list[Row] = []
    for example in read_examples(given.examples):
        if given.only not in example["folder"]:
            continue
        with tempfile.TemporaryDirectory() as name, warnings.catch_warnings():
            warnings.simplefilter("ignore")
            rows.append(row_of(example, given.clones, Path(name) / "case"))
        print(rows[-1], file=sys.stderr, flush=True)
    if not rows:
        parser.error(f"--only {given.only}: no folder of {given.examples} contains it")
    kinds = [row.runs.partition(":")[0] for row in rows]
    count = ", ".join(f"{kind} {kinds.count(kind)}" for kind in ("yes", "part", "no"))
    return "\n".join([HEADER, *map(str, rows), "", f"Of {len(rows)}: {count}."])


def main(arguments: list[str]) -> int:
    """Write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("clones", nargs="*", type=Path, metavar="CLONE")
    parser.add_argument("--survey", action="store_true", help="all input files below the clones")
    parser.add_argument("--seconds", type=float, metavar="T", help="--survey: run at most this [s]")
    parser.add_argument("--examples", type=Path, default=EXAMPLES, help="other list of examples")
    parser.add_argument("--only", default="", metavar="TEXT", help="folders that contain this")
    parser.add_argument("--output", type=Path, metavar="FILE", help="write the table here")
    given = parser.parse_args(arguments)
    if not given.clones and survey.VARIABLE in os.environ:
        given.clones = [Path(os.environ[survey.VARIABLE])]
    if not given.clones:
        parser.error(f"name a CLONE, or set {survey.VARIABLE} to a folder that holds the clones")
    if given.seconds is not None and not (given.survey and given.seconds > 0.0):
        parser.error("--seconds: goes with --survey, above zero")
    for clone in given.clones:
        if not clone.is_dir():
            parser.error(f"{clone}: there is no such folder")
    table = survey.table(given) if given.survey else _compared(given, parser)
    if given.output is None:
        print(table)
    else:
        given.output.write_text(table + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
