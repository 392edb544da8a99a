"""Mutation check: wrong lines that the tests have to see.

    python -m tests.mutation                 # all subjects in Python
    python -m tests.mutation sweep spectral  # these
    python -m tests.mutation kernel          # builds the kernel for each mutant: hours

Each mutant replaces one text of a source in a copy of the package, and the tests of its subject run
on the copy. Prints those that survive; exit code 1 if more than a tenth of a subject does.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from tests.mutation import kernel, memory, spectral, sweep
from tests.mutation.subject import Subject, copy_package, passes, survives

SUBJECTS = {s.name: s for s in (sweep.SUBJECT, spectral.SUBJECT, memory.SUBJECT, kernel.SUBJECT)}
#: Part of the mutants of a subject that may survive.
ALLOWED = 0.1


def check(subject: Subject, folder: Path) -> bool:
    """Try all mutants of a subject; prints one line for each; returns whether enough are killed."""
    site = copy_package(folder)
    if not passes(subject.tests, site):
        print(f"{subject.name}: its tests fail on the sources as they are")
        return False
    alive = 0
    for mutant in subject.mutants:
        lives = survives(subject, mutant, folder, site)
        alive += lives
        print(f"{'SURVIVES' if lives else 'killed  '}  {mutant.name}", flush=True)
    count = len(subject.mutants)
    print(f"{subject.name}: {count - alive} of {count} killed")
    return alive <= ALLOWED * count


def main(arguments: Sequence[str]) -> int:
    """Check the subjects that are named; returns the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("subjects", nargs="*", metavar="SUBJECT", help=f"of {', '.join(SUBJECTS)}")
    named = parser.parse_args(arguments).subjects
    if wrong := [name for name in named if name not in SUBJECTS]:
        parser.error(f"no subject {wrong[0]!r}; there are {', '.join(SUBJECTS)}")
    chosen = [SUBJECTS[name] for name in named] or [
        subject for subject in SUBJECTS.values() if not subject.compiled
    ]
    good = True
    for subject in chosen:
        with tempfile.TemporaryDirectory() as folder:
            good = check(subject, Path(folder)) and good
    return int(not good)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
