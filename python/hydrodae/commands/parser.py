"""The commands of `hydrodae`: what each is for; its arguments are in the module of its name."""

from __future__ import annotations

import argparse
from importlib import import_module

from hydrodae.commands.examples import add_examples

#: In place of a command: all arguments of all commands.
ALL = "*"

#: What each command is for, in a line and in full, in the order of --help.
COMMANDS = {
    "new": (
        "write a commented case that runs at once, or one from a run of WEC-Sim",
        "Write a folder with a commented case file, its hydrodynamic database, the commands that "
        "made it, and a study of its power. Without KIND, list the kinds. With --from wecsim PATH, "
        "convert a run of WEC-Sim and print what the case does not hold.",
    ),
    "run": ("simulate a case file", "Simulate a case."),
    "check": (
        "read a case, close its joints and show what it costs",
        "Print the scene as a tree, its unknowns, multipliers and mobility, redundant constraint "
        "rows, and how far the bodies were moved to close the joints.",
    ),
    "equilibrium": (
        "find the static pose of a case in still water",
        "Solve for the static pose of the whole constrained scene in still water. Print the "
        "offsets of the bodies, the reactions of the joints, and the loads on coordinates that "
        "bodies do not have. For moored scenes print tensions, stiffness of the moorings and "
        "natural periods.",
    ),
    "rao": (
        "response to waves in the frequency domain",
        "Natural modes and response amplitude operators of a case, linearised about its static "
        "equilibrium, from the frequency tables of its database. With --time-domain, also run "
        "regular waves and compare.",
    ),
    "drift": (
        "mean drift of a device as it moves, by the momentum of its far field",
        "Mean drift in surge, sway and yaw of all bodies together, from the Kochin functions of "
        "the database and the motions of the linearised case. Print the error of the drift and "
        "the least drift that the power taken asks for. With --offset, also find the mean offset "
        "in the waves of the case. With -o, write a copy of the database with the table.",
    ),
    "spectral": (
        "motion in the sea of a case, with drag and friction linearised in it",
        "Standard deviations, mean powers and equivalent damping of a case in its sea. The model "
        "is linear: drag, friction and nonlinear power take-offs become the nearest linear loads "
        "for the motion that follows. With --seeds, also run the case and compare.",
    ),
    "ladder": (
        "what each model of radiation costs on a case, and what it gets wrong",
        "Run a case with radiation none, constant, exponential and convolution. Print memory, "
        "solver time, error of the kernel, and error of the motion against the next higher model.",
    ),
    "sweep": (
        "run a case with many values of its keys, on all cores: power matrix, annual energy",
        "Run every point of a study. Finished runs are kept at once: an interrupted or killed "
        "sweep continues where it stopped. A run that fails is a row with its reason.",
    ),
    "extremes": (
        "design values: most likely waves, maxima of runs, return levels of years, contours",
        None,
    ),
    "calibrate": (
        "fit parameters of a case to what was measured in a tank",
        "Fit numbers of a case to measured channels of one or several tests, by least squares. The "
        "intervals allow for correlated differences. Parameters that the records do not determine "
        "are refused by name.",
    ),
    "mooring": ("mooring matrices from lines, and MoorDyn's input files", None),
    "record": (
        "waves of a case from a measured elevation, a spectrum, or components with phases",
        "Read a file of MATLAB (.mat), CSV or text, and print the [[wave]] tables of a case. An "
        "elevation is written with equal steps of time to the file of -o, which the table names. "
        "What was done to the record is printed as comments.",
    ),
    "control": ("design a controller for a case", None),
    "fmu": (
        "write a case as a component for other programs (FMI co-simulation)",
        "Write a case as an FMU for co-simulation: an archive with the kernel, the case and its "
        "database. Inputs hold from one communication point to the next.",
    ),
    "plot": (
        "draw results",
        "Draw results: joint coordinates, bodies and energy, or the named channels.",
    ),
    "view": (
        "see results in three dimensions: a page, a picture, a video, files for ParaView",
        "Write one HTML file that shows bodies, joints, lines and the sea of a run in three "
        "dimensions. It needs neither network nor server. Options write a picture, a video or "
        "files for ParaView. A case file is shown at its start, without a run.",
    ),
    "report": (
        "write a run, a sweep or an optimisation as one HTML page",
        "Write one HTML page that needs no other file. Of a run it has scene, models used, notes, "
        "checks, figures, statistics, versions and hashes. Of a sweep it has matrices and "
        "failures, of an optimisation the best values and the search.",
    ),
    "chart": (
        "chart speed against accuracy of all methods on a case",
        "Run a case by every method over a ladder of tolerances or steps; print a table, write "
        "PREFIX.png and PREFIX.json.",
    ),
    "recommend": (
        "find the cheapest method and tolerance that meet an error",
        "Run a case by four methods at four tolerances or steps. Print the cheapest setting whose "
        "error is at most E, as lines to paste into the case.",
    ),
    "hdb": ("prepare and look at hydrodynamic databases", None),
    "keys": (
        "the keys of a case file: unit, default, range, meaning",
        "List the tables of a case file, or the keys of one table or of one type of entry, such as "
        "'hydrodae keys force pto_linear'.",
    ),
    "schema": (
        "print the JSON schema of case files, for editors",
        "Print the JSON schema of case files. Editors that know it complete keys and mark wrong "
        "ones. Write it to a file and name the file in the first line of a case: "
        "'#:schema ./case.schema.json'.",
    ),
    "completion": (
        "print what completes commands and options in a shell",
        "Print a script for a shell, which then completes commands and options. For bash, in "
        '~/.bashrc: eval "$(hydrodae completion bash)".',
    ),
    "version": ("print the versions", None),
}


def parser_of(command: str) -> argparse.ArgumentParser:
    """Return the parser of a command line that begins with this command.

    The arguments of other commands are left out: their modules take long to load.

    Parameters
    ----------
    command : str
        The first argument; `ALL` for a parser with the arguments of all commands.
    """
    parser = argparse.ArgumentParser(
        prog="hydrodae",
        description="Simulate wave energy converters with awkward mechanisms.",
        epilog="Exit codes: 0 done, 2 bad case or argument, 3 solver failure, 4 interrupted "
        "(Ctrl-C, SIGTERM), 5 not reproducible, or without an estimate (run --strict).",
    )
    parser.add_argument(
        "--version", action=_PrintVersion, nargs=0, help="print the versions and exit"
    )
    # with its name, argparse formats no usage to find it, which loads shutil, bz2 and lzma
    commands = parser.add_subparsers(metavar="COMMAND", required=True, prog="hydrodae")
    for name in [command] if command in COMMANDS else COMMANDS:
        purpose, description = COMMANDS[name]
        own = commands.add_parser(name, help=purpose, description=description)
        if command in (name, ALL):
            module = import_module(f"hydrodae.commands.{name}")
            own.set_defaults(call=module.run)
            module.add_arguments(own)
    add_examples(commands)
    return parser


class _PrintVersion(argparse.Action):
    """`--version`: the kernel is loaded only if somebody asks."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object, **__: object) -> None:
        from hydrodae.commands.version import versions

        print(versions())
        parser.exit()
