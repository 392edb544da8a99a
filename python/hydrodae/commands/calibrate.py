"""The command `hydrodae calibrate`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from hydrodae.commands.arguments import given_case, parse_numbers
from hydrodae.commands.machine import of_calibration, print_json
from hydrodae.commands.options import add_case, add_json, add_quiet
from hydrodae.errors import CaseError
from hydrodae.pictures.plot import save
from hydrodae.study.calibrate import Free, Record, calibrate, read_record, read_tests
from hydrodae.study.calibrate.parameters import read_free
from hydrodae.support.progress import StageLine


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `hydrodae calibrate`."""
    add_case(parser)
    parser.add_argument(
        "--record",
        metavar="FILE",
        action="append",
        default=[],
        help="measured channels: .mat, CSV, text or results; several share parameters",
    )
    parser.add_argument(
        "--channel",
        metavar="CHANNEL=COLUMN[:UNIT]",
        action="append",
        default=[],
        help="channel of the results and its column in the records",
    )
    parser.add_argument(
        "--parameter",
        metavar="KEY[=LOW,HIGH]",
        action="append",
        default=[],
        help="number of the case that is fitted, and its bounds",
    )
    parser.add_argument(
        "--tests", metavar="FILE", help="records and parameters in TOML: docs/calibrate.md"
    )
    parser.add_argument(
        "--time", metavar="COLUMN[:UNIT]", default="", help="column of time (default: the first)"
    )
    parser.add_argument(
        "--offset",
        metavar="S[,LOW,HIGH]",
        default="0",
        help="time of the case minus time of the record; with bounds it is fitted",
    )
    parser.add_argument(
        "--from",
        dest="start",
        metavar="S",
        type=float,
        help="first time of the records that counts",
    )
    parser.add_argument(
        "--to", dest="end", metavar="S", type=float, help="last time of the records that counts"
    )
    parser.add_argument(
        "--level", action="store_true", help="the zero of the gauges is not known: fit it"
    )
    parser.add_argument(
        "--decay",
        metavar="CHANNEL",
        action="append",
        default=[],
        help="the records are decays: start from periods and decrements of successive peaks",
    )
    parser.add_argument(
        "--most", metavar="N", type=int, default=50, help="evaluations (default 50)"
    )
    parser.add_argument(
        "--write", metavar="FILE", help="a copy of the case with the fitted values, beside the case"
    )
    parser.add_argument("--picture", metavar="FILE", help="measured, before and after (.png, ...)")
    add_json(parser)
    add_quiet(parser)


def run(arguments: argparse.Namespace) -> int:
    """Fit, print the report, and write what is asked for."""
    case = given_case(arguments)
    records, free = _asked(arguments)
    for record in records:
        for note in record.notes:
            print(f"note: record {record.name}: {note}", file=sys.stderr)
    with StageLine(Path(arguments.case).name) as progress:
        found = calibrate(
            case,
            records,
            free,
            decay=arguments.decay,
            most=arguments.most,
            progress=None if arguments.quiet else lambda runs: progress(f"{runs} runs"),
        )
    written = [f"picture: {save(found.draw(), arguments.picture)}"] if arguments.picture else []
    if arguments.write:
        written.append(f"written: {found.write(arguments.write)}")
    if arguments.json:
        print_json(of_calibration(found))
        return 0
    print(found)
    for line in written:
        print(line)
    return 0


def _asked(arguments: argparse.Namespace) -> tuple[list[Record], list[Free | str]]:
    """Records and parameters, those of the file of tests before those of the arguments."""
    records: list[Record] = []
    free: list[Free | str] = []
    if arguments.tests:
        more, parameters = read_tests(arguments.tests)
        records += more
        free += parameters
    options = _options(arguments)
    channels = dict(_channel(text) for text in arguments.channel)
    if arguments.record and not channels:
        raise CaseError("--record needs --channel CHANNEL=COLUMN, the column of each channel")
    if not arguments.record and (options or channels):
        raise CaseError("--channel, --time, --offset, --from, --to, --level need --record")
    records += [read_record(file, channels, **options) for file in arguments.record]
    if not records:
        raise CaseError("nothing to fit to: give --record FILE or --tests FILE")
    return records, free + [read_free(text) for text in arguments.parameter]


def _options(arguments: argparse.Namespace) -> dict[str, Any]:
    options: dict[str, Any] = {}
    for name in ("start", "end"):
        if getattr(arguments, name) is not None:
            options[name] = getattr(arguments, name)
    if arguments.time:
        options["time"] = arguments.time
    if arguments.level:
        options["level"] = True
    if arguments.offset != "0":
        count = 3 if "," in arguments.offset else 1
        numbers = parse_numbers("--offset", arguments.offset, count)
        options["offset"] = numbers[0]
        if count == 3:
            options["offset_bounds"] = (numbers[1], numbers[2])
    return options


def _channel(text: str) -> tuple[str, str]:
    channel, equals, column = (part.strip() for part in text.partition("="))
    if not channel or not equals or not column:
        raise CaseError(f"--channel {text}: expected CHANNEL=COLUMN or CHANNEL=COLUMN:UNIT")
    return channel, column
