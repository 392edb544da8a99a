"""Examples of every command, at the end of its --help."""

from __future__ import annotations

import argparse

EXAMPLES = {
    "new": ("hydrodae new", "hydrodae new flap my_flap"),
    "run": (
        "hydrodae run case.toml",
        "hydrodae run case.toml --set wave.sea.significant_height=3 -o storm.h5",
        "hydrodae run case.toml --checkpoint 60",
    ),
    "check": ("hydrodae check case.toml", "hydrodae check case.toml --json"),
    "equilibrium": ("hydrodae equilibrium case.toml --set body.float.mass=8e5",),
    "rao": (
        "hydrodae rao case.toml --periods 6,8,10 --picture rao.pdf",
        "hydrodae rao case.toml -o rao.nc",
    ),
    "drift": (
        "hydrodae drift case.toml -o with_drift.h5",
        "hydrodae drift case.toml --pairs --offset -o drift.csv",
    ),
    "spectral": ("hydrodae spectral case.toml",),
    "ladder": ("hydrodae ladder case.toml",),
    "sweep": (
        "hydrodae sweep power_matrix.toml",
        "hydrodae sweep power_matrix.toml --jobs 4 -o power.nc",
        "hydrodae sweep best_damper.toml --optimise",
    ),
    "extremes": (
        "hydrodae extremes wave case.toml bodies/float/heave --hours 3 -o wave.csv",
        "hydrodae extremes fit storm_*.h5 --channel forces/bow/tension --distribution gpd",
        "hydrodae extremes years case.toml --channel bodies/float/heave --scatter scatter.csv",
        "hydrodae extremes contour scatter.csv --years 1,50 -o contours.csv",
    ),
    "calibrate": (
        "hydrodae calibrate case.toml --record decay.csv --parameter force.brake.damping=0,1e4 "
        "--channel joints/slide/displacement=heave:mm",
        "hydrodae calibrate case.toml --tests tests.toml --picture fit.png --write fitted.toml",
    ),
    "record": (
        "hydrodae record probe.mat -o probe.csv",
        "hydrodae record gauge.txt --columns 'time [s],eta [mm]' -o gauge.csv --heading 30",
        "hydrodae record spectrum.csv",
    ),
    "mooring": ("hydrodae mooring linearise case.toml", "hydrodae mooring import lines.dat"),
    "control": ("hydrodae control design case.toml --joint slide --period 8",),
    "fmu": ("hydrodae fmu case.toml -o device.fmu --inputs 'forces/pto/*'",),
    "view": (
        "hydrodae view case.h5",
        "hydrodae view case.h5 --picture case.png --time 40 --camera side",
    ),
    "plot": (
        "hydrodae plot case.h5",
        "hydrodae plot case.h5 'joints/*/angle' bodies/float/position.z -o motion.pdf",
        "hydrodae plot case.h5 --list",
    ),
    "report": ("hydrodae report case.h5", "hydrodae report power_matrix.nc -o power.html"),
    "chart": ("hydrodae chart case.toml --set solver.end_time=100",),
    "recommend": ("hydrodae recommend case.toml --error 1e-3",),
    "hdb": (
        "hydrodae hdb import results_folder -o hydro.h5",
        "hydrodae hdb fit hydro.h5 heave=float.heave --case case.toml",
        "hydrodae hdb doctor hydro.h5",
        "hydrodae hdb compute --body buoy=sphere:radius=5 --cog buoy=0,0,-2 --omega 0.1,4,40",
    ),
    "keys": ("hydrodae keys", "hydrodae keys force pto_linear"),
    "schema": ("hydrodae schema",),
    "completion": ("hydrodae completion bash",),
    "version": ("hydrodae version",),
}

_HEAD = "examples:"


class Formatter(argparse.HelpFormatter):
    """Wraps text, but for lists of examples."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        if text.startswith(_HEAD):
            return "".join(f"{indent}{line}\n" for line in text.splitlines())
        return super()._fill_text(text, width, indent)


def add_examples(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add to every command its examples."""
    for name, parser in commands.choices.items():
        if name in EXAMPLES:
            parser.formatter_class = Formatter
            parser.epilog = "\n  ".join((_HEAD, *EXAMPLES[name]))
