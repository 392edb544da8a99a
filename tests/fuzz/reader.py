"""Reads files as a user of the Python package does, and prints how each ended.

A request is a line "<task> <path>" on standard input, or two words of the command line; for tasks
see `TASKS`. The answer is a line "<code> <message>" on what was standard output: 0 read, 2 an error
that the package raises on purpose, 1 any other exception. What else is written there, by the
package or by a library, goes to standard error.
"""

from __future__ import annotations

import contextlib
import io
import os
import resource
import signal
import sys
import traceback
import warnings
from pathlib import Path

import hydrodae
from hydrodae import hdb, wecsim
from hydrodae.hdb.hull.closed import closed_surface
from hydrodae.hdb.hull.meshes import read_mesh

HANG = 30  # s of processor time, after which the signal ends the process
MEMORY = 4 << 30  # bytes of address space


def read_results(path: Path) -> None:
    """Everything that is in the file."""
    results = hydrodae.Results.read(path)
    repr(results)
    results.summary()
    for name in results.channels():
        try:
            results[name].values.sum()
        except hydrodae.HydrodaeError:  # one channel may be broken, the others are not
            continue
    if len(results):
        results.to_dataset(results.channels()[0])
    str(results.statistics) + str(results.header) + results.message + "".join(results.notes)


def read_database(path: Path) -> None:
    """A database, its summary and its checks."""
    database = hdb.read(path)
    database.summary()
    str(hdb.check(database))


def read_study_file(path: Path) -> None:
    """A study and its points, or an optimisation."""
    from hydrodae.study.sweep import plan, problem

    try:
        study = plan.read_study(path)
    except hydrodae.HydrodaeError:
        problem.read_problem(path)
    else:
        study.identity(hydrodae.Case(path=study.case))


def read_journal(path: Path) -> None:
    """The table of a sweep whose journal has all rows."""
    from hydrodae.study.sweep import journal, plan, table, text

    study = plan.read_study(path.with_name("study.toml"))
    with journal.Journal(path, study.identity(hydrodae.Case(path=study.case))) as found:
        if {plan.point_key(point) for point in study.points} <= set(found.rows):
            text(table.dataset(study, found.rows, {}))


def read_record(path: Path) -> None:
    """A record by the command, and by a case that names it."""
    from hydrodae.commands import cli

    output = path.with_name("made.csv")
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        for kind in ([], ["--kind", "elevation"], ["--kind", "spectrum"]):
            writes = [] if "spectrum" in kind else ["-o", str(output)]
            cli.main(["record", str(path), *kind, *writes])
    wave = f'[[wave]]\nname = "sea"\ntype = "measured"\nfile = "{path.name}"\n'
    hydrodae.Case.from_text(path.with_name("case.toml").read_text() + wave, path.parent)


def read_components(path: Path) -> None:
    """A case that names a file of wave components."""
    wave = f'[[wave]]\nname = "sea"\ntype = "components"\nfile = "{path.name}"\n'
    hydrodae.Case.from_text(path.with_name("case.toml").read_text() + wave, path.parent)


def read_checkpoint(path: Path) -> None:
    """A run that goes on from it."""
    output = path.with_name("zz.h5")
    hydrodae.run(path.with_name("case.toml"), output, resume=True).summary()


def read_tables(path: Path) -> None:
    """A database of another program: import, summary and report."""
    database, report = hdb.import_database(path)
    database.summary()
    str(report)


def read_wecsim(path: Path) -> None:
    """A folder of WEC-Sim as a case."""
    wecsim.convert(path, path / "case")


def read_hull(path: Path) -> None:
    """A mesh, as it is and extended above the water."""
    panels = read_mesh(path)
    for freeboard in (None, 1.0):
        closed_surface(panels, freeboard)


TASKS = {
    "results": read_results,
    "database": read_database,
    "study": read_study_file,
    "journal": read_journal,
    "record": read_record,
    "components": read_components,
    "checkpoint": read_checkpoint,
    "tables": read_tables,
    "wecsim": read_wecsim,
    "mesh": read_hull,
}


def answer_to(task: str, path: Path) -> str:
    """One line."""
    signal.setitimer(signal.ITIMER_PROF, HANG)
    try:
        TASKS[task](path)
    except hydrodae.HydrodaeError as error:
        return f"2 {error}"
    except Exception:  # what the package did not mean to raise
        traceback.print_exc()
        return f"1 {traceback.format_exc().strip().splitlines()[-1]}"
    return "0 read"


def main() -> None:
    """Answer requests until there are none."""
    warnings.simplefilter("ignore")  # of numbers that are not finite
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    requests = [" ".join(sys.argv[1:])] if len(sys.argv) > 1 else sys.stdin
    with os.fdopen(os.dup(1), "w", encoding="utf-8", errors="backslashreplace") as answers:
        os.dup2(2, 1)
        for line in requests:
            task, _, path = line.rstrip("\n").partition(" ")
            text = " ".join(answer_to(task, Path(path)).splitlines())
            print(text, file=answers, flush=True)


if __name__ == "__main__":
    main()
