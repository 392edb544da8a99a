"""The commands `hydrodae extremes ...`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from hydrodae.commands.machine import plain, print_json
from hydrodae.commands.options import add_case, add_json, add_quiet
from hydrodae.errors import CaseError
from hydrodae.support import outputs

if TYPE_CHECKING:
    from hydrodae.study.extremes.scatter import ScatterTable

Told = tuple[object, dict[str, Any], list[str], list[list[float]]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the commands below `hydrodae extremes`."""
    commands = parser.add_subparsers(metavar="COMMAND", required=True)
    _add_wave(commands)
    _add_fit(commands)
    _add_years(commands)
    _add_contour(commands)


def _add_wave(commands: Any) -> None:
    wave = commands.add_parser(
        "wave",
        help="the most likely wave for a response of the linear model",
        description="The wave in which a channel of the linear model is most likely to have its "
        "extreme, in the sea of the case.",
    )
    add_case(wave, "case file (TOML) with irregular waves")
    wave.add_argument(
        "channel",
        metavar="CHANNEL",
        help="of the linear model, such as bodies/float/heave or forces/pto/force",
    )
    level = wave.add_mutually_exclusive_group()
    level.add_argument(
        "--response", metavar="X", type=float, help="level about rest, in the unit of the channel"
    )
    level.add_argument(
        "--hours", metavar="H", type=float, default=3.0, help="its largest of so many hours (3)"
    )
    _add_exceedance(wave)
    wave.add_argument("--least", action="store_true", help="the least in place of the largest")
    wave.add_argument(
        "--time", metavar="S", type=float, help="of the peak (default: halfway from the ramp on)"
    )
    wave.add_argument("--components", metavar="N", type=int, default=500, help="of each wave (500)")
    wave.add_argument("-o", "--output", metavar="FILE", help="components of the wave (.csv)")
    wave.add_argument(
        "--case", metavar="FILE", dest="copy", help="copy of the case in this wave; needs -o"
    )
    add_json(wave)
    wave.set_defaults(work=_wave)


def _add_fit(commands: Any) -> None:
    fit = commands.add_parser(
        "fit",
        help="level of some hours from runs in one sea state",
        description="Fit a distribution of extremes to maxima of runs. Print levels with 95 % "
        "intervals (profile likelihood).",
    )
    fit.add_argument(
        "files", metavar="FILE", nargs="+", help="results of runs, or the table of a sweep (.nc)"
    )
    fit.add_argument(
        "--channel", metavar="NAME", required=True, help="channel, or result of the sweep"
    )
    fit.add_argument(
        "--distribution",
        choices=("gev", "gumbel", "gpd"),
        default="gev",
        help="of block maxima: gev (default), gumbel; of peaks over a threshold: gpd",
    )
    fit.add_argument("--block", metavar="S", type=float, help="duration (default: 30 blocks)")
    fit.add_argument(
        "--threshold", metavar="X", type=float, help="default: a tenth of the crests exceed it"
    )
    fit.add_argument(
        "--from", metavar="S", dest="start", type=float, help="first sample (end of the ramp)"
    )
    fit.add_argument("--hours", metavar="H1,H2,...", default="3", help="durations (default 3)")
    _add_exceedance(fit)
    fit.add_argument("--least", action="store_true", help="least values in place of the largest")
    _add_output(fit)
    fit.set_defaults(work=_fit)


def _add_years(commands: Any) -> None:
    years = commands.add_parser(
        "years",
        help="return levels of years over all sea states of a scatter table",
        description="Return levels over the sea states of a scatter table: of the linear model of "
        "a case, or of the runs of a sweep (.nc).",
    )
    add_case(years, "case file (TOML), or the table of a sweep (.nc)")
    years.add_argument(
        "--channel", metavar="NAME", required=True, help="channel, or result of the sweep"
    )
    years.add_argument(
        "--scatter", metavar="FILE", required=True, help="CSV: height, period, hours (a year)"
    )
    years.add_argument("--years", metavar="N1,N2,...", default="1,10,50", help="return periods")
    years.add_argument("--wave", metavar="NAME", help="wave of the case that the table is of")
    _add_output(years)
    years.set_defaults(work=_years)


def _add_contour(commands: Any) -> None:
    contour = commands.add_parser(
        "contour",
        help="sea states of a return period, from a scatter table or a joint model",
        description="Environmental contour of height and peak period (IFORM): Weibull height, "
        "lognormal period.",
    )
    source = contour.add_mutually_exclusive_group(required=True)
    source.add_argument(
        "scatter", metavar="SCATTER", nargs="?", help="CSV: height, period, hours (a year)"
    )
    source.add_argument(
        "--model",
        metavar="A,B,C,A1,A2,A3,B1,B2,B3",
        help="joint model of DNV-RP-C205 in place of a table; --model=... if it begins with -",
    )
    contour.add_argument("--years", metavar="N1,N2,...", default="50", help="return periods (50)")
    contour.add_argument(
        "--hours", metavar="H", type=float, default=3.0, help="of one sea state (3)"
    )
    contour.add_argument("--points", metavar="N", type=int, default=36, help="on each (36)")
    _add_output(contour)
    contour.set_defaults(work=_contour)


def _add_exceedance(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--exceedance",
        metavar="P",
        type=float,
        help="probability that the largest exceeds the level (default 0.632: the most probable)",
    )


def _add_output(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("-o", "--output", metavar="FILE", help="table: .csv, or .json")
    add_json(parser)
    add_quiet(parser)


def run(arguments: argparse.Namespace) -> int:
    """Print what one of the commands finds, and write it.

    Raises
    ------
    CaseError
        As the functions of `hydrodae.extremes`.
    """
    if arguments.output is not None:
        _claim(arguments)
    found, content, head, rows = arguments.work(arguments)
    if arguments.json:
        print_json(content)
    else:
        print(found)
    if arguments.output is not None and head:
        _write(Path(arguments.output), content, head, rows)
    if not arguments.json:
        for name in ("output", "copy"):
            if getattr(arguments, name, None):
                print(f"written: {getattr(arguments, name)}")
    return 0


def _claim(arguments: argparse.Namespace) -> None:
    """Refuse a file that cannot be written before anything is computed."""
    kinds = {".csv": outputs.CSV, ".json": outputs.JSON}
    if hasattr(arguments, "copy"):
        kinds.pop(".json")
    path = Path(arguments.output)
    if path.suffix.lower() not in kinds:
        raise CaseError(
            f"{path}: the ending says the kind of file, {', '.join(kinds)}, not {path.suffix!r}"
        )
    outputs.claim(path, kinds[path.suffix.lower()])


def _write(path: Path, content: dict[str, Any], head: list[str], rows: list[list[float]]) -> None:
    import csv
    import json

    with outputs.whole(path) as beside, beside.open("w", newline="") as file:
        if path.suffix.lower() == ".json":
            json.dump(plain(content), file, indent=1, allow_nan=False)
            return
        table = csv.writer(file)
        table.writerow(head)
        table.writerows([[f"{x:.9g}" for x in row] for row in rows])


def _wave(arguments: argparse.Namespace) -> Told:
    from hydrodae.commands.arguments import given_case
    from hydrodae.study.extremes import likely_wave, write_case, write_components

    if arguments.copy and not arguments.output:
        raise CaseError("--case needs -o FILE.csv, which the copy names")
    case = given_case(arguments)
    found = likely_wave(
        case,
        arguments.channel,
        response=arguments.response,
        hours=arguments.hours,
        exceedance=arguments.exceedance,
        least=arguments.least,
        time=arguments.time,
        components=arguments.components,
    )
    if arguments.output:
        write_components(arguments.output, found)
    if arguments.copy:
        write_case(case, arguments.output, arguments.copy)
    names = (
        "channel",
        "unit",
        "level",
        "at_rest",
        "time",
        "hours",
        "exceedance",
        "crest",
        "trough",
    )
    content = {name: getattr(found, name) for name in (*names, "notes")} | {
        "standard_deviation": found.narrow.deviation,
        "mean_period": found.narrow.period,
    }
    return found, content, [], []


def _fit(arguments: argparse.Namespace) -> Told:
    from hydrodae.commands.arguments import parse_positive
    from hydrodae.study.extremes import design_value
    from hydrodae.support.progress import ProgressLine

    with ProgressLine("extremes", "files") as progress:
        found = design_value(
            arguments.files,
            arguments.channel,
            distribution=arguments.distribution,
            block=arguments.block,
            threshold=arguments.threshold,
            hours=parse_positive("--hours", arguments.hours),
            exceedance=arguments.exceedance,
            least=arguments.least,
            start=arguments.start,
            progress=None if arguments.quiet else progress,
        )
    rows = [[h, x.value, x.low, x.high] for h, x in zip(found.hours, found.levels, strict=True)]
    fit = found.fit
    content = {
        "channel": found.channel,
        "unit": found.unit,
        "distribution": fit.family.name,
        "location": -fit.loc if found.least else fit.loc,
        "scale": fit.scale,
        "shape": fit.shape,
        "threshold": found.clusters and (-1.0 if found.least else 1.0) * found.clusters.threshold,
        "extremal_index": found.clusters and found.clusters.extremal_index,
        "maxima": -fit.maxima if found.least else fit.maxima,
        "span": fit.span,
        "quantiles": dict(zip(("correlation", "difference"), fit.qq(), strict=True)),
        "exceedance": found.exceedance,
        "levels": [dict(zip(("hours", "level", "low", "high"), row, strict=True)) for row in rows],
        "notes": found.notes,
    }
    unit = found.unit
    head = ["duration [h]", f"level [{unit}]", f"low [{unit}]", f"high [{unit}]"]
    return found, content, head, rows


def _years(arguments: argparse.Namespace) -> Told:
    from hydrodae.commands.arguments import given_case, parse_positive
    from hydrodae.study.extremes import linear_long_term, runs_long_term
    from hydrodae.study.extremes.samples import SWEEP
    from hydrodae.support.progress import ProgressLine

    years = parse_positive("--years", arguments.years)
    of_runs = arguments.case.lower().endswith(SWEEP)
    if of_runs and (arguments.set or arguments.wave or arguments.library):
        raise CaseError("--set, --library and --wave belong to a case, not to the table of a sweep")
    with ProgressLine("extremes", "copies" if of_runs else "periods") as line:
        progress = None if arguments.quiet else line
        table = _scatter(arguments.scatter)
        if of_runs:
            found = runs_long_term(
                arguments.case, arguments.channel, table, years=years, progress=progress
            )
        else:
            found = linear_long_term(
                given_case(arguments),
                arguments.channel,
                table,
                years=years,
                wave=arguments.wave,
                progress=progress,
            )
    parts = (found.levels, *found.intervals.T, *found.ranges.T)
    rows = [list(map(float, row)) for row in zip(found.years, *parts, strict=True)]
    names = ["level", "low", "high", "largest_low", "largest_high"]
    content = {
        "channel": found.channel,
        "unit": found.unit,
        "source": found.source,
        "levels": [dict(zip(("years", *names), row, strict=True)) for row in rows],
        "states": found.states,
        "hours": found.hours,
    }
    head = ["years", *(f"{name} [{found.unit}]" for name in names)]
    return found, content, head, rows


def _scatter(path: str) -> ScatterTable:
    from hydrodae.study.extremes.scatter import read_scatter

    return read_scatter(path)


def _contour(arguments: argparse.Namespace) -> Told:
    from hydrodae.commands.arguments import parse_numbers, parse_positive
    from hydrodae.study.extremes import JointModel, contour

    source = (
        JointModel(*parse_numbers("--model", arguments.model, 9))
        if arguments.model
        else _scatter(arguments.scatter)
    )
    found = contour(
        source,
        years=parse_positive("--years", arguments.years),
        hours=arguments.hours,
        points=arguments.points,
    )
    rows = [
        [float(n), float(h), float(t)]
        for n, heights, periods in zip(found.years, found.heights, found.periods, strict=True)
        for h, t in zip(heights, periods, strict=True)
    ]
    content = {
        "model": vars(found.model),
        "hours": found.hours,
        "contours": [
            {"years": n, "height": heights, "period": periods}
            for n, heights, periods in zip(found.years, found.heights, found.periods, strict=True)
        ],
        "notes": found.notes,
    }
    return found, content, ["years", "height [m]", "period [s]"], rows
