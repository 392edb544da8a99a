"""The command `hydrodae chart`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from hydrodae.commands.options import add_case
from hydrodae.errors import CaseError

DONE = 0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    add_common(parser)
    parser.add_argument(
        "--steps",
        metavar="A,B,...",
        help="steps [s] of the fixed-step methods (default: from the mean step of ida)",
    )
    parser.add_argument(
        "-o", "--output", metavar="PREFIX", help="default: the case's name with _chart, here"
    )


def run(arguments: argparse.Namespace) -> int:
    """Make a chart, print its table, write picture and JSON."""
    from rich.console import Console

    from hydrodae.commands.arguments import given_case
    from hydrodae.pictures.plot import save
    from hydrodae.study.chart import chart, output
    from hydrodae.support.progress import ProgressLine

    case = given_case(arguments)
    prefix = Path(arguments.output or Path(arguments.case).stem + "_chart")
    options = common_options(arguments)
    if arguments.steps:
        options["steps"] = _numbers(arguments.steps, "--steps")
    with ProgressLine(f"chart of {case.title}, simulated") as progress:
        made = chart(case, progress=progress, **options)
    console = Console(highlight=False, soft_wrap=True)
    console.width = max(console.width, 100)  # no outcome broken over two lines
    console.print(output.heading(made), markup=False)
    console.print()
    console.print(output.table(made))
    console.print(output.footing(made), markup=False)
    picture = save(output.draw(made), prefix.with_name(prefix.name + ".png"))
    values = output.write_json(made, prefix.with_name(prefix.name + ".json"))
    console.print(f"picture in {picture}, values in {values}", markup=False)
    return DONE


def add_common(parser: argparse.ArgumentParser) -> None:
    """Add what the command `recommend` has as well."""
    add_case(parser)
    parser.add_argument(
        "--methods", metavar="A,B,...", help="names, or name:order such as radau:13"
    )
    parser.add_argument(
        "--tolerances", metavar="A,B,...", help="rtol of auto, ida, radau, explicit_rk"
    )
    parser.add_argument(
        "--channels",
        metavar="A,B,...",
        help="channels or patterns, CHANNEL=COLUMN to name a column of the reference file "
        "(default: joint coordinates, else the bodies' positions)",
    )
    parser.add_argument(
        "--reference",
        metavar="FILE|METHOD",
        help="results file, .csv or .json table; or a method (default: radau at rtol 1e-12)",
    )
    parser.add_argument("--repeat", metavar="N", type=int, help="time is the best of N runs")
    parser.add_argument(
        "--time-limit", metavar="S", type=float, help="longest wall time of a run [s] (60)"
    )


def common_options(arguments: argparse.Namespace) -> dict[str, Any]:
    """The arguments that were given, as those of `hydrodae.chart`."""
    options: dict[str, Any] = {
        "reference": arguments.reference,
        "repeat": arguments.repeat,
        "time_limit": arguments.time_limit,
        "methods": arguments.methods and _words(arguments.methods),
        "channels": arguments.channels and _words(arguments.channels),
    }
    if arguments.tolerances:
        options["tolerances"] = _numbers(arguments.tolerances, "--tolerances")
    return {key: value for key, value in options.items() if value is not None}


def _words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]


def _numbers(text: str, option: str) -> list[float]:
    try:
        return [float(word) for word in _words(text)]
    except ValueError as problem:
        raise CaseError(f"{option} {text}: {problem}") from None
