"""Runs every command of the documentation: python -m tests.commands.

    python -m tests.commands [--limit SECONDS] [--hours] [--list] [PATTERN ...]

Commands are the lines of shell blocks in README.md, docs, cases and tests/README.md, and those in
docstrings of scripts. Each group (a page, or the folder of a case) runs in a clean copy of the
repository. Printed are for each: how it ended, exit code, time, place. It passed, failed, took too
long, lacks something (an extra, reference data, a program, a file of one's own), or is left out,
with the reason. Exit code 1 if one failed or took too long. All take an hour or two.
"""

from __future__ import annotations

import argparse
import fnmatch
import sys
import tempfile
from collections import Counter
from pathlib import Path

from tests.commands.find import all_commands
from tests.commands.run import run_group, to_run

ROOT = Path(__file__).resolve().parents[2]


def main() -> int:
    """Run and report; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.commands", description=(__doc__ or "").partition("\n")[0]
    )
    parser.add_argument("patterns", nargs="*", metavar="PATTERN", help="of places and commands")
    parser.add_argument("--limit", type=float, default=900.0, help="of each command, s (900)")
    parser.add_argument("--hours", action="store_true", help="run those marked with hours too")
    parser.add_argument("--list", action="store_true", help="list the commands, run nothing")
    options = parser.parse_args()
    counts: Counter[str] = Counter()
    for commands in to_run(all_commands(ROOT)).values():
        if options.patterns and not any(
            fnmatch.fnmatch(text, f"*{pattern}*")
            for pattern in options.patterns
            for command in commands
            for text in (command.source, command.plain)
        ):
            continue
        if options.list:
            print(*(f"{c.source}:{c.line}: {c.plain}" for c in commands), sep="\n")
            continue
        with tempfile.TemporaryDirectory(prefix="hydrodae-commands-") as folder:
            for outcome in run_group(commands, ROOT, Path(folder), options.limit, options.hours):
                counts[outcome.status] += 1
                print(outcome, flush=True)
    if not options.list:
        print(", ".join(f"{number} {status}" for status, number in sorted(counts.items())))
    return int(counts["failed"] + counts["too long"] > 0)


if __name__ == "__main__":
    sys.exit(main())
