"""The command `hydrodae hdb compare`."""

from __future__ import annotations

import argparse

import numpy as np

from hydrodae.hdb.checks.compare import compare, grid_sensitivity, other_water
from hydrodae.hdb.readers.reading import read


def add_arguments(actions: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Add the subcommand compare."""
    parser = actions.add_parser(
        "compare",
        help="compare two databases, or one with coarser versions of itself",
        description="With two databases: the largest differences of their tables. With one: how "
        "K(t) and the added mass at infinity depend on the frequency step, the highest and "
        "lowest frequency, and the memory.",
    )
    parser.add_argument("database", metavar="A", help="hydro.h5, or any source for import")
    parser.add_argument("other", metavar="B", nargs="?", help="what A is compared with")
    parser.add_argument("--rho", metavar="R", type=float, help="density [kg/m3], if not in A or B")


def run(args: argparse.Namespace) -> int:
    """Print the comparison; returns 0."""
    a = read(args.database, rho=args.rho)
    if args.other is not None:
        b = read(args.other, rho=args.rho)
        print(f"largest differences of {args.database} from {args.other}")
        for text in other_water(a, b):
            print(f"  {text}")
        for difference in compare(a, b):
            print(f"  {difference}")
        return 0
    print(f"{args.database}: what changes when the table is")
    print(f"  {'':26s}{'K(t)':>10s}{'A_inf':>10s}")
    for text, kernel, value in grid_sensitivity(a):
        shown = "".join(f"{'-' if np.isnan(v) else f'{v:.2%}':>10s}" for v in (kernel, value))
        print(f"  {text:26s}{shown}")
    print("K(t): largest change over the peak (shorter memory: share of int |K| dt left out);")
    print("A_inf: largest change by Ogilvie's relation; both of the worst coordinate")
    return 0
