"""Which input files of WEC-Sim become whole cases, by folder.

A folder is whole where the conversion leaves nothing out and the case runs to its end. It is at
the first try where `hydrodae new --from wecsim` needs neither `--accept` nor `--define`. What to
define is in `examples.json`. The second table counts what is missing by its kind: the remark
without its place, names and numbers.
"""

from __future__ import annotations

import argparse
import json
import re
import sys
import tempfile
import warnings
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import hydrodae
from hydrodae.case.callbacks.files import read_functions
from hydrodae.errors import CaseError, HydrodaeError
from hydrodae.wecsim import convert
from hydrodae.wecsim.case import INPUT

#: Environment variable that names a folder with clones.
VARIABLE = "HYDRODAE_WECSIM"
_LONGEST = 160


@dataclass
class Row:
    """One input file.

    Attributes
    ----------
    folder : str
        Where it is, from the folder of the clones on.
    missing : list of str
        Remarks on what the case lacks.
    stop : str
        Why there is no case, or why its run stops; empty where it runs to its end.
    first : bool
        Whether the conversion needs neither `--accept` nor `--define`, and the case runs.
    """

    folder: str
    missing: list[str] = field(default_factory=list)
    stop: str = ""
    first: bool = False

    @property
    def whole(self) -> bool:
        """Whether nothing is missing and the case runs."""
        return not (self.missing or self.stop)

    def __str__(self) -> str:
        stops = [f"stops: {self.stop}"] if self.stop else []
        text = "; ".join(_short(text) for text in stops + self.missing).replace("|", "/")
        cells = [self.folder, _word(self.whole), _word(self.first), text]
        return "| " + " | ".join(cells) + " |"


def _word(value: bool) -> str:
    return "yes" if value else "no"


def _short(text: str) -> str:
    text = " ".join(text.split())
    return text if len(text) <= _LONGEST else text[: _LONGEST - 3].rstrip() + "..."


def row_of(
    folder: Path, name: str, work: Path, seconds: float | None, define: Mapping[str, str]
) -> Row:
    """Convert and run one folder.

    Parameters
    ----------
    folder : Path
    name : str
        What the table calls it.
    work : Path
        New folder for the case.
    seconds : float, optional
        Longest time to run [s]; by default the end time of the input file.
    define : mapping from str
        Variables that a script beside the input file sets before it.
    """
    row = Row(name)
    try:
        converted = convert(folder, work, accept=None, define=define)
        row.missing = [str(remark) for remark in converted.remarks.of("left out")]
        end = hydrodae.Case.read(converted.case).end_time
        shorter = {} if seconds is None else {"solver.end_time": min(end, seconds)}
        functions = read_functions(converted.functions) if converted.functions else {}
        status = hydrodae.run(converted.case, set=shorter, **functions).status
        row.stop = "" if status == "completed" else status
        converted.remarks.check(())
        row.first = not row.stop and not define
    except CaseError as error:
        row.stop = row.stop or ("" if row.missing and "--accept" in str(error) else str(error))
    except HydrodaeError as error:
        row.stop = str(error)
    row.stop = row.stop.replace(f"{folder}/", "")
    return row


def kind_of(missing: str) -> str:
    """A remark without its place, numbers and names."""
    text = missing.partition(": ")[2] or missing
    text = re.sub(r"'[^']*'", "'...'", re.sub(r"\(\d+\)|\b\d[\d.]*(e[-+]?\d+)?\b", "#", text))
    return _short(text)


def table(given: argparse.Namespace) -> str:
    """Markdown of all folders, and of the kinds of what is missing."""
    rows: list[Row] = []
    examples = json.loads(given.examples.read_text(encoding="utf-8"))
    define = {f"/{e['folder']}": e["define"] for e in examples if "define" in e}
    for clone in given.clones:
        for file in sorted(clone.rglob(INPUT)):
            name = file.parent.relative_to(clone).as_posix()
            if given.only not in name:
                continue
            stated = [d for end, d in define.items() if file.parent.as_posix().endswith(end)]
            defined: dict[str, str] = stated[0] if stated else {}
            with tempfile.TemporaryDirectory() as work, warnings.catch_warnings():
                warnings.simplefilter("ignore")
                rows.append(row_of(file.parent, name, Path(work) / "case", given.seconds, defined))
            print(rows[-1], file=sys.stderr, flush=True)
    faults = [row.missing + [row.stop] * bool(row.stop) for row in rows]
    kinds = Counter(kind for texts in faults for kind in {kind_of(text) for text in texts})
    whole, runs = sum(row.whole for row in rows), sum(not row.stop for row in rows)
    lines = ["| folder | whole | first try | missing |", "|---|---|---|---|", *map(str, rows), ""]
    lines += [f"Of {len(rows)}: {runs} run, {whole} whole, {sum(r.first for r in rows)} first try."]
    lines += ["", "| folders | missing |", "|---|---|"]
    lines += [f"| {count} | {kind.replace('|', '/')} |" for kind, count in kinds.most_common()]
    return "\n".join(lines)
