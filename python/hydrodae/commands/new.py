"""The command `hydrodae new`."""

from __future__ import annotations

import argparse
import shlex
from pathlib import Path
from typing import TYPE_CHECKING

from hydrodae.errors import CaseError

if TYPE_CHECKING:
    from hydrodae.wecsim import Converted

PROGRAMS = ("wecsim",)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument(
        "kind", metavar="KIND", nargs="?", help="such as point_absorber or flap; none with --from"
    )
    parser.add_argument(
        "folder", metavar="FOLDER", nargs="?", help="a new or empty folder (default: KIND)"
    )
    parser.add_argument(
        "--from",
        dest="origin",
        metavar=("PROGRAM", "PATH"),
        nargs=2,
        help="wecsim and the folder with wecSimInputFile.m and its Simulink model",
    )
    parser.add_argument(
        "--accept",
        metavar="PART",
        action="append",
        default=[],
        help="with --from: write the case although it lacks this part of the device, such as "
        "waves, pto, joint, mooring or cable. May be repeated",
    )
    parser.add_argument(
        "--define",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="with --from: a variable that a script sets before the input file runs. May be "
        "repeated",
    )


def run(arguments: argparse.Namespace) -> int:
    """Write a starter, or what a run of WEC-Sim is here, or list the kinds; returns 0."""
    if arguments.origin is not None:
        return _convert(arguments)
    if arguments.accept or arguments.define:
        raise CaseError(f"--{'accept' if arguments.accept else 'define'} is for --from")
    from hydrodae.starters import KINDS, create

    if arguments.kind is None:
        for kind, meaning in KINDS.items():
            print(f"{kind:16}{meaning}")
        return 0
    _tell(create(arguments.kind, arguments.folder))
    return 0


def _tell(case: Path, functions: Path | None = None) -> None:
    print(f"written: {case.parent}")
    for file in sorted(case.parent.iterdir()):
        print(f"  {file.name}")
    results = case.with_suffix(".h5")
    more = f" --functions {shlex.quote(str(functions))}" if functions else ""
    print(f"next: hydrodae run {shlex.quote(str(case))}{more}")
    print(f"      hydrodae plot {shlex.quote(str(results))}")


def _convert(arguments: argparse.Namespace) -> int:
    program, path = arguments.origin
    if program not in PROGRAMS:
        raise CaseError(f"--from {program}: expected one of {', '.join(PROGRAMS)}")
    if arguments.kind is None or arguments.folder is not None:
        raise CaseError(f"hydrodae new FOLDER --from {program} {path}: one folder is needed")
    from hydrodae.wecsim import convert

    define = {}
    for text in arguments.define:
        name, equals, define[name] = text.partition("=")
        if not equals or not name.isidentifier():
            raise CaseError(f"--define {text}: expected NAME=VALUE, such as --define option=1")
    converted = convert(path, arguments.kind, accept=arguments.accept, define=define)
    _print_remarks(converted)
    _tell(converted.case, converted.functions)
    return 0


def _print_remarks(converted: Converted) -> None:
    remarks = converted.remarks
    for kind, header in (("left out", "not in the case"), ("assumed", "assumed")):
        found = remarks.of(kind)
        print(f"{header}: {len(found) or 'nothing'}")
        for remark in found:
            print(f"  {remark}")
    idle = remarks.of("not needed")
    if idle:
        print(f"not needed: {len(idle)}")
        for place in dict.fromkeys(remark.place.rpartition(":")[0] for remark in idle):
            here = [r for r in idle if r.place.rpartition(":")[0] == place]
            told = (f"{r.text} ({r.place.rpartition(':')[2]})" for r in here)
            print(f"  {place}, by line: {', '.join(told)}")
