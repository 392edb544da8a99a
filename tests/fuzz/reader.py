"""Reads HDF5 files as a user of the Python package does, and tells how each ended.

A request is a line "<task> <path>" on standard input, or two words of the command line; tasks are
`results` and `database`. The answer is a line "<code> <message>": 0 read, 2 an error that the
package raises on purpose, 1 any other exception.
"""

from __future__ import annotations

import resource
import signal
import sys
import traceback
import warnings
from pathlib import Path

import hydrodae
from hydrodae import hdb

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


def answer_to(task: str, path: Path) -> str:
    """One line."""
    signal.setitimer(signal.ITIMER_PROF, HANG)
    try:
        {"results": read_results, "database": read_database}[task](path)
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
    for line in requests:
        task, _, path = line.rstrip("\n").partition(" ")
        print(answer_to(task, Path(path)).replace("\n", " "), flush=True)


if __name__ == "__main__":
    main()
