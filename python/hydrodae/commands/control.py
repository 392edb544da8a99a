"""The command `hydrodae control`."""

from __future__ import annotations

import argparse

from hydrodae.commands.options import add_case


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of the command."""
    tasks = parser.add_subparsers(metavar="TASK", required=True)
    design = tasks.add_parser(
        "design",
        help="gains of a PI controller by impedance matching",
        description="Match a PI controller of the rate of a joint to the impedance of the device. "
        "It takes most power at one period. The impedance comes from the frequency tables.",
        epilog="example: hydrodae control design case.toml --joint slide --period 8",
    )
    add_case(design, library=False)
    design.add_argument("--joint", metavar="NAME", required=True, help="along which it acts")
    design.add_argument(
        "--period",
        metavar="SECONDS",
        type=float,
        help="of the wave to match (default: the energy period of the sea of the case)",
    )
    design.add_argument(
        "--keep",
        metavar="NAME",
        action="append",
        default=[],
        help="a take-off that stays beside the controller; without it all take-offs along joints "
        "are left out; may be repeated",
    )
    design.set_defaults(library=[])


def run(arguments: argparse.Namespace) -> int:
    """Print impedance, gains and powers; returns 0."""
    from math import pi

    from hydrodae.commands.arguments import given_case
    from hydrodae.control import Plant, match

    plant = Plant(given_case(arguments), arguments.joint)
    found = match(plant, arguments.period, keep=arguments.keep)
    turns = plant.turns
    resistance, stiffness = ("N m s/rad", "N m/rad") if turns else ("N s/m", "N/m")
    print(f"joint {arguments.joint} at {found.omega:.5g} rad/s ({2 * pi / found.omega:.4g} s)")
    print(f"  impedance    {found.impedance:.5g} {resistance}, of the device without its take-offs")
    for title, names in (("left out", found.left_out), ("counted", found.counted)):
        kinds = ", ".join(f"{name} ({plant.loads[name]})" for name in names)
        print(f"  {title:<12s} {kinds or 'no force of the case'}")
    if found.left_out:
        print(
            "  the controller replaces what is left out: set its damping and stiffness to zero, "
            "or keep it by --keep NAME"
        )
    if found.excitation == found.excitation:
        print(f"  excitation   {found.excitation:.5g} {'N m/m' if turns else 'N/m'}")
        print(f"  most power   {found.power:.5g} W per m2 of amplitude, |F|^2 / (8 Re Z)")
        print(
            f"  by damper    {found.resistive_power:.5g} W/m2 at {found.resistive:.5g} {resistance}"
        )
    print(f"  gain_p = {found.gain_p:.6g}  # {resistance}")
    print(f"  gain_i = {found.gain_i:.6g}  # {stiffness}")
    return 0
