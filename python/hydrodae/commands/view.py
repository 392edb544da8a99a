"""The command `hydrodae view`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from hydrodae.errors import CaseError


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command to its parser."""
    parser.add_argument("results", metavar="RESULTS", help="results file, or a case file (.toml)")
    out = parser.add_argument_group("what to write (default: the page, RESULTS.html)")
    out.add_argument("-o", "--output", metavar="FILE.html", help="the page")
    out.add_argument("--picture", metavar="FILE", help="a still picture: png or jpg")
    out.add_argument("--video", metavar="FILE", help="a video: mp4, webm or gif")
    out.add_argument("--paraview", metavar="FOLDER", help="files for ParaView 5.12 or later")
    what = parser.add_argument_group("what to show")
    what.add_argument("--case", metavar="CASE", help="case of the results, if it was moved")
    what.add_argument("--from", dest="first", metavar="T", type=float, help="first sample [s]")
    what.add_argument("--to", dest="last", metavar="T", type=float, help="last sample [s]")
    what.add_argument("--step", metavar="DT", type=float, help="least time between samples [s]")
    what.add_argument(
        "--shape",
        metavar="BODY=WHAT",
        action="append",
        default=[],
        help="cylinder:radius=R:length=L, sphere:radius=R, box:length=L:width=W:height=H, each "
        "may be followed by :x=..:y=..:z=.. from the centre of gravity. Also rods:diameter=D to "
        "the attached joints, or a mesh file (STL, OBJ, GDF, PNL, Nemoh, GMSH). May be repeated",
    )
    what.add_argument(
        "--freeboard",
        metavar="H",
        type=float,
        help="height above water up to which wetted surfaces are drawn [m] (default: 0.15 of the "
        "draught)",
    )
    what.add_argument(
        "--channel",
        metavar="PATTERN",
        action="append",
        default=[],
        help="more channels to be shown as curves, such as 'forces/*/flap1/moment'",
    )
    how = parser.add_argument_group("how to show it")
    how.add_argument(
        "--camera",
        metavar="VIEW",
        default="oblique",
        help="oblique (default), side, front, top, all (with lines that reach far), or "
        "AZIMUTH,ELEVATION[,ZOOM] in degrees",
    )
    how.add_argument(
        "--time", metavar="T", type=float, help="time of the picture, at which the page opens [s]"
    )
    how.add_argument("--size", metavar="WxH", default="1280x720", help="pixels (1280x720)")
    how.add_argument("--rate", metavar="N", type=float, default=25.0, help="frames a second (25)")
    how.add_argument(
        "--speed",
        metavar="S",
        type=float,
        default=1.0,
        help="of the video: simulated time over real",
    )


def run(arguments: argparse.Namespace) -> int:
    """Write page, picture, video and files for ParaView; returns 0."""
    from hydrodae.viewer import view

    size = _size(arguments.size)
    seen = view(
        arguments.results,
        case=arguments.case,
        first=-float("inf") if arguments.first is None else arguments.first,
        last=float("inf") if arguments.last is None else arguments.last,
        step=arguments.step,
        shapes=dict(map(_shape, arguments.shape)),
        freeboard=arguments.freeboard,
        channels=arguments.channel,
        camera=arguments.camera,
    )
    for note in seen.stage.notes:
        print(f"note: {note}", file=sys.stderr)
    written: list[Path] = []
    paged = arguments.output or not (arguments.picture or arguments.video or arguments.paraview)
    if arguments.time is not None and not (paged or arguments.picture):
        raise CaseError("--time: is for a page or a picture; give --from and --to for the others")
    if paged:
        page = arguments.output or Path(arguments.results).with_suffix(".html")
        written.append(seen.write(page, time=arguments.time))
    if arguments.picture:
        written.append(seen.picture(arguments.picture, time=arguments.time, size=size))
    if arguments.video:
        progress = _progress if sys.stderr.isatty() else None
        written.append(
            seen.video(
                arguments.video,
                size=size,
                rate=arguments.rate,
                speed=arguments.speed,
                progress=progress,
            )
        )
    if arguments.paraview:
        written += seen.paraview(arguments.paraview)
    for path in written:
        print(path)
    return 0


def _shape(text: str) -> tuple[str, str]:
    name, equals, what = text.partition("=")
    if not equals or not what:
        raise CaseError(f"--shape {text!r}: expected BODY=SHAPE:key=value... or BODY=FILE")
    return name, what


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit()) or min(int(width), int(height)) < 64:
        raise CaseError(
            f"--size {text!r}: expected WIDTHxHEIGHT of at least 64 pixels, as 1280x720"
        )
    return int(width), int(height)


def _progress(done: int, total: int) -> None:
    end = "\n" if done == total else ""
    print(f"\rframe {done} of {total}", end=end, file=sys.stderr, flush=True)
