"""The command `hydrodae recommend`."""

from __future__ import annotations

import argparse

from hydrodae.commands.chart import add_common, common_options


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    parser.add_argument(
        "--error",
        metavar="E",
        type=float,
        required=True,
        help="largest difference relative to the largest excursion, such as 1e-4",
    )
    add_common(parser)


def run(arguments: argparse.Namespace) -> int:
    """Print the cheapest setting that meets an error, as lines of a case."""
    from hydrodae.commands.arguments import given_case
    from hydrodae.study.chart import Run, recommend
    from hydrodae.support.progress import ProgressLine

    def told(run: Run) -> str:
        return (
            f"{run.method} at {run.knob} {run.setting:g}: error {run.error:.1e}, "
            f"solver time {1e3 * (run.time or 0.0):.1f} ms"
        )

    case = given_case(arguments)
    with ProgressLine(f"runs of {case.title}, simulated") as progress:
        found = recommend(case, arguments.error, progress=progress, **common_options(arguments))
    print(f"# {told(found.run)}\n{found.toml()}")
    print(f"\n# runner-up: {told(found.runner_up) if found.runner_up else 'none'}")
    for name in found.chart.methods():
        runs = [run for run in found.chart.runs if run.method == name]
        if not any(run.measured and (run.error or 0.0) <= arguments.error for run in runs):
            bad = sorted({run.outcome for run in runs} - {"ok"})
            print(f"# {name} does not meet it{': ' + ', '.join(bad) if bad else ''}")
    return 0
