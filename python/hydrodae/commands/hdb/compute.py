"""The command `hydrodae hdb compute`: from shapes or mesh files to `hydro.h5`, with Capytaine."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from hydrodae.commands.arguments import parse_headings, parse_numbers, parse_point
from hydrodae.commands.hdb.mesh_fit import add_mesh_fit, check_mass, few_enough, masses_of
from hydrodae.commands.hdb.options import BAD_DATA, DONE, add_grid_options, omega_of, refused, write
from hydrodae.commands.hdb.own_coordinates import add_own_coordinates, with_own_coordinates
from hydrodae.commands.options import add_quiet
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem import run as bem
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.bem.cutting import immersed
from hydrodae.hdb.bem.revolution import read_profile, revolution
from hydrodae.hdb.database.coordinates import body_name, check_body
from hydrodae.hdb.hull.meshes import mirrored, read_mesh
from hydrodae.hdb.preparation import computing, pipeline
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array
from hydrodae.support.progress import StageLine


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand compute."""
    compute = actions.add_parser(
        "compute",
        help="compute a database with Capytaine from shapes or mesh files",
        description="Compute a database by the boundary-element method (Capytaine, extra bem) and "
        "write hydro.h5. What is done is kept: an interrupted run goes on where it stopped.",
        epilog="example: hydrodae hdb compute --body buoy=sphere:radius=5 --cog buoy=0,0,-2 "
        "--omega 0.1,4,40 -o hydro.h5",
    )
    compute.add_argument(
        "--body",
        metavar="NAME=WHAT",
        action="append",
        required=True,
        help="sphere:radius=R[:x=..:y=..:z=..], cylinder:radius=R:draft=D[:top=..:x=..:y=..], "
        "box:length=L:width=W:draft=D[..], cone:radius=R:draft=D[:bottom=RADIUS..], "
        "ring:radius=R:inner=R:draft=D[..] in metres. Or revolution:profile=FILE[:x=..:y=..:z=..] "
        "with points r z a line. Or a mesh file (STL, OBJ, GDF, PNL, Nemoh, GMSH). :x=..:y=..:z=.. "
        "moves it, :mirror=y (x, xy) completes a half, :scale=0.001 is for millimetres. May be "
        "repeated",
    )
    compute.add_argument(
        "--cog",
        metavar="NAME=X,Y,Z",
        action="append",
        default=[],
        help="reference point of every body, its centre of gravity at rest [m]",
    )
    add_grid_options(compute)
    compute.add_argument("--depth", metavar="H", type=float, default=np.inf, help="default: inf")
    compute.add_argument(
        "--panel",
        metavar="SIZE",
        type=float,
        help="side of the panels of simple shapes [m]; default: an eighth of the smaller of the "
        "shortest wave and the cube root of the volume",
    )
    compute.add_argument(
        "--no-lid", action="store_true", help="leave irregular frequencies in (faster)"
    )
    add_mesh_fit(compute)
    add_own_coordinates(compute)
    compute.add_argument(
        "--poses",
        metavar="COORDINATE=A,B,...",
        help="several poses of one body, for [[pose_table]] of a case: heave=A,B,... [m], or "
        "roll_deg, pitch_deg, yaw_deg about --cog. Writes FILE with the number of the pose in its "
        "name for each, and prints the table",
    )
    compute.add_argument(
        "--work", metavar="FOLDER", help="where finished frequencies are kept (default: FILE.bem)"
    )
    add_quiet(compute)
    compute.add_argument(
        "--kochin",
        metavar="N",
        type=int,
        default=0,
        help="also keep the Kochin functions at N angles around the circle (twice the time)",
    )
    compute.add_argument(
        "--accept",
        metavar="CHECK",
        action="append",
        default=[],
        help="write the file although this check found an error; may be repeated",
    )


def run(args: argparse.Namespace) -> int:
    """Compute a database.

    Returns
    -------
    int
        0, or 2 if a check found an error and nothing was written.
    """
    settings = bem.Settings(
        omega=omega_of(args),
        heading=parse_headings("--heading-deg", args.heading_deg),
        rho=args.rho,
        gravity=args.gravity,
        water_depth=args.depth,
        lid=not args.no_lid,
        kochin=args.kochin,
        most_panels=args.most_panels,
    )
    points = dict(parse_point("--cog", text) for text in args.cog)
    for text in args.body:
        _name_of(text)
    for name in [*points, *masses_of(args.mass)]:
        check_body(name, [_name_of(text) for text in args.body])
    if args.poses is None:
        still = Pose("heave", 0.0)
        return _compute_one(args, settings, points, still, args.output)
    poses = _poses(args)
    files = [str(_numbered(args.output, k + 1)) for k in range(len(poses))]
    for pose, file in zip(poses, files, strict=True):
        print(f"{pose.coordinate} of {pose.value:g}:")
        code = _compute_one(args, settings, points, pose, file)
        if code != DONE:
            return code
    print(_pose_table(_name_of(args.body[0]), poses, files))
    return DONE


@dataclass(frozen=True)
class Pose:
    """A displacement [m] or rotation [deg] of a body about its reference point."""

    coordinate: str
    value: float

    def moved(self, panels: Array, point: Array) -> Array:
        """Return panels in the pose, turned about the reference point."""
        if self.coordinate == "heave":
            return np.asarray(panels + np.array([0.0, 0.0, self.value]))
        axis = ("roll_deg", "pitch_deg", "yaw_deg").index(self.coordinate)
        turn = Rotation.from_rotvec(np.radians(self.value) * np.eye(3)[axis]).as_matrix()
        return np.asarray((panels - point) @ turn.T + point)

    def of_point(self, point: Array) -> Array:
        """Return the reference point in the pose."""
        rise = self.value if self.coordinate == "heave" else 0.0
        return np.asarray(point + np.array([0.0, 0.0, rise]))

    def of_shape(self, shape: str, words: dict[str, str]) -> dict[str, str]:
        """Return the lengths of a simple shape in the pose; it goes on above the water."""
        if self.coordinate != "heave":
            raise CaseError(f"--poses: a {shape} takes heave only; give a mesh file")
        up, down = ("z", "") if shape == "sphere" else ("top", "draft")
        out = dict(words)
        if shape == "sphere" or float(words.get(up, "0")) < 0.0:
            out[up] = str(float(words.get(up, "0")) + self.value)
        if down in words:
            out[down] = str(float(words[down]) - self.value)
        return out


def _poses(args: argparse.Namespace) -> list[Pose]:
    coordinate, equals, values = args.poses.partition("=")
    if not equals or coordinate not in ("heave", "roll_deg", "pitch_deg", "yaw_deg"):
        raise CaseError(
            f"--poses {args.poses!r}: expected heave=A,B,..., or roll_deg, pitch_deg, yaw_deg"
        )
    numbers = parse_numbers("--poses", values, values.count(",") + 1)
    if len(numbers) < 2 or any(b <= a for a, b in pairwise(numbers)):
        raise CaseError(f"--poses {args.poses!r}: expected two or more ascending numbers")
    if len(args.body) != 1:
        raise CaseError("--poses: a table of poses has one --body")
    if args.piston or args.mode:
        raise CaseError("--poses: a body with --piston or --mode has no table of poses")
    return [Pose(coordinate, number) for number in numbers]


def _numbered(output: str, number: int) -> Path:
    path = Path(output)
    return path.with_name(f"{path.stem}_{number}{path.suffix}")


def _pose_table(body: str, poses: list[Pose], files: list[str]) -> str:
    coordinate = poses[0].coordinate
    key = "values" if coordinate == "heave" else "values_deg"
    names = ", ".join(f'"{Path(file).name}"' for file in files)
    return (
        "fit the memory of each file (hydrodae hdb fit), and put into the case:\n\n"
        f'[[pose_table]]\nname = "{body}"\nbody = "{body}"\n'
        f'coordinate = "{coordinate.removesuffix("_deg")}"\n'
        f"{key} = [{', '.join(f'{pose.value:g}' for pose in poses)}]\n"
        f"databases = [{names}]"
    )


def _compute_one(
    args: argparse.Namespace,
    settings: bem.Settings,
    points: dict[str, list[float]],
    pose: Pose,
    output: str,
) -> int:
    """Compute the database of one pose and write it; the exit code."""
    masses = masses_of(args.mass)
    bodies = [_body(text, points, masses, args.panel, settings, pose) for text in args.body]
    meshed = {_name_of(text) for text in args.body if not _by_formula(text)}
    bodies = few_enough(bodies, meshed, args.most_panels, settings.lid)
    bodies = with_own_coordinates(bodies, pistons=args.piston, formulas=args.mode)
    statics = computing.hydrostatics_of(bodies)
    for body in bodies:
        volume, pool = statics[body.name].displaced_volume, len(body.pool)
        on_pool = f" and {pool} on its pool" if pool else ""
        print(f"{body.name}: {len(body.panels)} panels{on_pool}, displaces {volume:.5g} m3")
    warning = bem.panel_warning(bodies, settings)
    if warning:
        print(f"warning: {warning}")
    work = Path(args.work or f"{args.output}.bem")
    if output != args.output:
        work = work / Path(output).stem
    with StageLine("compute", pipeline.names(pipeline.COMPUTE)) as stage:
        database, report = computing.compute(
            bodies,
            settings,
            work,
            progress=None if args.quiet else _Frequencies(stage),
            stage=None if args.quiet else stage,
        )
    print(database.summary())
    print(report)
    if args.no_lid and report.find("irregular frequencies"):
        print(
            "computed with --no-lid: a lid, the default, removes irregular frequencies (not the "
            "resonance of a moonpool, which asks for finer steps)"
        )
    if refused(report.left(args.accept), output):
        return BAD_DATA
    return write(database, output)


def _name_of(text: str) -> str:
    name, equals, _ = text.partition("=")
    if not equals or body_name(name) != name:
        raise CaseError(f"--body {text!r}: expected NAME=SHAPE:key=value... or NAME=FILE")
    return name


def _body(
    text: str,
    points: dict[str, list[float]],
    masses: dict[str, float],
    size: float | None,
    settings: bem.Settings,
    pose: Pose,
) -> bem.WettedBody:
    name, what = _name_of(text), text.partition("=")[2]
    if name not in points:
        raise CaseError(f"--body {name}: needs --cog {name}=X,Y,Z, its reference point [m]")
    first, words = _words(name, what)
    axes = words.get("mirror", "")
    try:
        point = np.array(points[name], dtype=float)
        if name in masses:
            rest = _panels(name, first, dict(words), size, settings)
            offer = (name, "" if _by_formula(text) else first, words)
            check_mass(rest, masses[name], settings.rho, offer)
        if first in shapes.SHAPES:  # built as far as they are wet
            panels = immersed(_panels(name, first, pose.of_shape(first, words), size, settings))
        else:
            panels = immersed(pose.moved(_panels(name, first, words, size, settings), point))
    except DatabaseError as error:
        hint = ""
        if error.subject == "holes" and Path(first).is_file():
            hint = (
                f" (with its mirror image, mirror={axes}: the half does not end at that plane)"
                if axes
                else " (half of a hull: add :mirror=y, or x, or xy)"
            )
        raise error.within(f"body {name}", hint) from None
    return bem.WettedBody(name, panels, pose.of_point(point))


def _by_formula(text: str) -> bool:
    first, _ = _words(_name_of(text), text.partition("=")[2])
    return first == "revolution" or first in shapes.SHAPES


def _words(name: str, what: str) -> tuple[str, dict[str, str]]:
    """Return the shape or file, and what follows it as key=value."""
    words, found = what.split(":"), dict[str, str]()
    while len(words) > 1 and "=" in words[-1]:
        key, _, value = words.pop().partition("=")
        if key in found:
            raise CaseError(f"--body {name}: {key} is given twice")
        found[key] = value
    return ":".join(words), found


def _lengths(name: str, words: dict[str, str]) -> dict[str, float]:
    found = {}
    for key, value in words.items():
        try:
            found[key] = float(value)
        except ValueError:
            raise CaseError(f"--body {name}: {key}={value!r}: expected a number [m]") from None
    return found


def _panels(
    name: str, first: str, words: dict[str, str], size: float | None, settings: bem.Settings
) -> Array:
    """Panels of a shape by formula, of a profile, or of a mesh file."""
    is_file = Path(first).is_file() or (bool(Path(first).suffix) and first not in shapes.SHAPES)
    if first == "revolution":
        return _turned(name, dict(words), size, settings)
    if first in shapes.SHAPES or not is_file:
        lengths = _lengths(name, words)
        if first not in shapes.SHAPES:
            shapes.build(first, 1.0, lengths)  # says what is missing
        return shapes.build(first, size or _size(first, lengths, settings), lengths)
    axes = words.pop("mirror", "")
    scale = _lengths(name, {"scale": words.pop("scale", "1")})["scale"]
    if not 0.0 < scale < np.inf:
        raise CaseError(f"--body {name}: scale={scale:g}: expected a number > 0 [-]")
    panels = scale * read_mesh(first)
    if axes:
        panels = mirrored(panels, axes)
    return np.asarray(panels + _shift(name, words, "a mesh takes x, y, z, mirror and scale only"))


def _turned(name: str, words: dict[str, str], size: float | None, settings: bem.Settings) -> Array:
    """Surface of revolution of the profile in a file."""
    if "profile" not in words:
        raise CaseError(f"--body {name}: revolution needs profile=FILE, points r z [m] a line")
    profile = read_profile(words.pop("profile"))
    shift = _shift(name, words, "revolution takes profile, x, y and z only")
    if size is None:
        coarse = immersed(revolution(float(np.ptp(profile, axis=0).max()) / 8.0, profile) + shift)
        size = _panel_size(coarse, settings)
    return np.asarray(revolution(size, profile) + shift)


def _shift(name: str, words: dict[str, str], known: str) -> Array:
    lengths = _lengths(name, words)
    shift = [lengths.pop(axis, 0.0) for axis in ("x", "y", "z")]
    if lengths:
        raise CaseError(f"--body {name}: {next(iter(lengths))}: {known}")
    return np.array(shift)


def _size(shape: str, lengths: dict[str, float], settings: bem.Settings) -> float:
    coarse = max([*map(abs, lengths.values()), 1e-3]) / 4.0
    return _panel_size(shapes.build(shape, coarse, lengths), settings)


def _panel_size(coarse: Array, settings: bem.Settings) -> float:
    """An eighth of the shortest wave or of the cube root of the volume, the smaller one [m]."""
    volume = shapes.hydrostatics(coarse, np.zeros(3)).displaced_volume
    k = wavenumber(settings.omega[-1:], settings.water_depth, settings.gravity)[0]
    return min(2.0 * np.pi / float(k), float(np.cbrt(volume))) / 8.0


class _Frequencies:
    """Shows how many frequencies are done, and the time that the others will take."""

    def __init__(self, show: Callable[[str], None]) -> None:
        self._show = show
        self._before: int | None = None

    def __call__(self, done: int, total: int, omega: float, spent: float) -> None:
        if self._before is None:
            self._before = done - 1  # of an earlier run
        left = spent / (done - self._before) * (total - done)
        at = f"{done} of {total} frequencies, w = {omega:.4g} rad/s"
        self._show(f"{at}, about {left:.0f} s to go")
