"""Hexagonal arrays in an irregular sea: time and memory of a run against the number of units.

    .venv/bin/python tests/benchmark/hexagonal_arrays.py -o docs/arrays.png

Units are buoys (the nodes of 4N3LA) 3 m apart, each with a mooring and a take-off to the seabed,
free, or joined: each to its nearest neighbour further inwards, by an arm of 4N3LA. The radiation
couples all bodies, or only those of a unit (`hydrodae.arrays.limit`). A and F are those of the
interaction theory. The memory is made up: a bank of resonators with the damping of the tables at a
few frequencies, one for each of its eigenvectors that counts: passive whatever the tables are, with
as many states as a fit would have (24 for one buoy), and nothing to search for.

Each run has a process of its own. Times are those of the processor; slopes are those of the least
squares in logarithms over the number of bodies. Some minutes, most of them for the tables of 19.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure

import hydrodae
from hydrodae import arrays, hdb
from hydrodae.hdb.memory import ExponentialMemory
from hydrodae.pictures.plot import save
from hydrodae.support.arrays import Array

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "cases" / "4n3la"))

import parts  # noqa: E402

UNITS = (1, 3, 7, 19)
SPACING = 3.0  # m
WATER = hdb.Water(np.linspace(0.3, 7.2, 24), 6.0)
BANK = np.array([1.2, 2.0, 2.8, 3.6, 4.8, 6.3])  # rad/s, of the resonators
KEPT = 0.02  # least eigenvalue of a resonator's damping beside the largest of all
MOORING, TAKE_OFF = 200.0, 150.0  # N/m, N s/m
WAYS = {
    "free, full": (False, False),
    "joined, full": (True, False),
    "free, limited": (False, True),
    "joined, limited": (True, True),
}


def water(count: int) -> hdb.HydroDatabase:
    """Tables of the buoys of an array, without memory."""
    places = arrays.places_of({"buoy": (0.0, 0.0)}, arrays.hexagonal(count, SPACING))
    node = hdb.Cylinder(parts.RADIUS, parts.DRAFT, -parts.NODE_DEPTH)
    return hdb.cylinders(places, node, WATER, orders=2, modes=60)[0]


def with_bank(
    database: hdb.HydroDatabase, groups: list[list[str]], bank: Array = BANK
) -> hdb.HydroDatabase:
    """Give each group of coordinates a memory of resonators, H = sum G (s + d)/((s + d)^2 + w^2).

    G = 2 d B(w) is positive semidefinite, hence Re H(i w) too; d is half the distance of the w.
    """
    label = database.coordinates
    scale = np.sqrt(np.einsum("wii->wi", database.radiation_damping).max(axis=0))
    poles, rows = [], []
    for group in groups:
        at = np.array([i for i in database.index(group) if scale[i] > 1e-9 * scale.max()])
        for w, d in zip(bank, 0.5 * np.gradient(bank), strict=True):
            nearest = int(np.abs(database.omega - w).argmin())
            damping = database.radiation_damping[nearest][np.ix_(at, at)]
            values, vectors = np.linalg.eigh(damping / np.outer(scale[at], scale[at]))
            for value, vector in zip(values, vectors.T, strict=True):
                if value > KEPT:
                    row = np.zeros(len(label), dtype=complex)
                    row[at] = np.sqrt(2.0 * d * value) * vector * scale[at]
                    poles.append(complex(-d, w))
                    rows.append(row)
    inlet = np.array(rows)
    outlet = np.asarray(2.0 * inlet.T, dtype=complex)
    memory = ExponentialMemory(
        "bank", label, label, np.array(poles), inlet, outlet, database.added_mass_inf
    )
    lowest = memory.passivity(float(bank[-1]), 500)
    report = {"n_states": memory.n_states, "passive": lowest.relative > -1e-9}
    return replace(database, memory={"bank": replace(memory, report=report)})


def groups_of(database: hdb.HydroDatabase, limited: bool) -> list[list[str]]:
    """Coordinates that radiate into each other: all, or those of each body."""
    if not limited:
        return [list(database.coordinates)]
    return [
        [label for label in database.coordinates if label.rpartition(".")[0] == body]
        for body in database.bodies
    ]


def buoy(directory: Path) -> hydrodae.Scene:
    """One unit, in the sea of 4N3LA."""
    scene = hydrodae.Scene("buoy", directory=directory)
    scene.hydro(database="hydro.h5")
    parts.add_nodes(scene, parts.Layout("buoy", {"buoy": (0.0, 0.0)}, {}, ()))
    hold = [MOORING, MOORING, 0.0, 0.0, 0.0, 0.1 * MOORING]
    damp = [0.2 * value for value in hold]
    scene.force.mooring_matrix("mooring", body="buoy", stiffness=hold, damping=damp)
    scene.force.spring_damper(
        "pto",
        body_a="ground",
        body_b="buoy",
        point_a=[0.0, 0.0, -WATER.depth],
        point_b=[0.0, 0.0, -parts.DRAFT],
        damping=TAKE_OFF,
    )
    return parts.irregular(scene)


def joints(units: dict[str, tuple[float, float]]) -> dict[str, tuple[str, str]]:
    """Arms from each unit to its nearest one further inwards: a tree."""
    found: dict[str, tuple[str, str]] = {}
    names = list(units)
    for i, name in enumerate(names[1:], start=1):
        far = {other: math.dist(units[other], units[name]) for other in names[:i]}
        found[f"arm{i}"] = (f"{min(far, key=lambda other: far[other])}_buoy", f"{name}_buoy")
    return found


def array(count: int, joined: bool, directory: Path) -> hydrodae.Scene:
    """Scene of an array, whose database is hydro.h5 in the directory."""
    units = arrays.hexagonal(count, SPACING)
    scene = arrays.place(buoy(directory), units, directory)
    if joined:
        places = arrays.places_of({"buoy": (0.0, 0.0)}, units)
        layout = parts.Layout(scene.title, places, joints(units), ())
        parts.add_arms(scene, layout, parts.STIFFNESS, parts.DAMPING)
    return scene


def write(
    tables: hdb.HydroDatabase, count: int, joined: bool, limited: bool, directory: Path
) -> tuple[int, int]:
    """Write the case of an array and its database; return the numbers of bodies and states."""
    if limited:
        tables = arrays.limit(tables, units=arrays.hexagonal(count, SPACING)).database
    made = with_bank(tables, groups_of(tables, limited))
    made.write(directory / "hydro.h5")
    scene = array(count, joined, directory)
    (directory / "case.toml").write_text(scene.to_toml())
    return scene.to_toml().count("[[body]]"), made.memory["bank"].n_states


def resident(key: str) -> float:
    """Memory of this process [MiB]: VmRSS now, VmHWM at most (Linux)."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(key):
            return float(line.split()[1]) / 1024.0
    return float("nan")


def measure(scene: Path, end: float, repeats: int) -> dict[str, Any]:
    """One run and its cost, in this process."""
    case = hydrodae.Case.read(scene).with_values({"solver.end_time": end})
    with tempfile.TemporaryDirectory() as folder:
        short = case.with_values({"hydro.radiation": "none", "solver.end_time": 0.01})
        hydrodae.run(short, Path(folder) / "short.h5")  # loads the libraries
        before, starts, times = resident("VmHWM"), [], []
        for _ in range(repeats):
            began = time.process_time()
            hydrodae.Simulation(case)
            starts.append(time.process_time() - began)
            began = time.process_time()
            results = hydrodae.run(case, Path(folder) / "results.h5")
            times.append(time.process_time() - began)
        found = results.statistics
    return {
        "start": min(starts),
        "time": (min(times) - min(starts)) / end,
        "memory": resident("VmHWM"),
        "added": resident("VmHWM") - before,
        "unknowns": int(found["unknowns"]),
        "method": str(found["method_in_use"]),
        "calls": int(found["residual_calls"]),
        "error": float(found["estimated_error"]),
    }


def slope(found: list[dict[str, Any]], key: str, least: int = 1) -> float:
    """Slope in logarithms over the number of bodies, from `least` bodies on."""
    kept = [(row["bodies"], row[key]) for row in found if row["bodies"] >= least]
    if len(kept) < 2:
        return float("nan")
    return float(np.polyfit(np.log([n for n, _ in kept]), np.log([v for _, v in kept]), 1)[0])


def draw(rows: dict[str, list[dict[str, Any]]], path: Path) -> None:
    """Time and memory over the number of bodies."""
    figure = Figure(figsize=(9.0, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    marks = ("o-", "s-", "o--", "s--")
    for (way, found), mark in zip(rows.items(), marks, strict=False):
        bodies = [row["bodies"] for row in found]
        left.loglog(bodies, [1e3 * row["time"] for row in found], mark, label=way)
        right.semilogx(bodies, [row["memory"] for row in found], mark, label=way)
    left.set(xlabel="bodies", ylabel="time per simulated second [ms]")
    right.set(xlabel="bodies", ylabel="most memory of the process [MiB]", ylim=(0.0, None))
    for axis in (left, right):
        ticks = sorted({row["bodies"] for found in rows.values() for row in found})
        axis.set_xticks(ticks, [str(n) for n in ticks])
        axis.minorticks_off()
        axis.grid(alpha=0.3)
    left.legend()
    path.parent.mkdir(parents=True, exist_ok=True)
    save(figure, path)


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--units", type=int, nargs="+", default=UNITS)
    parser.add_argument("--end", type=float, default=60.0, help="of each run, s")
    parser.add_argument("--repeats", type=int, default=2, help="the least time is taken")
    parser.add_argument("--one", type=Path, help=argparse.SUPPRESS)  # a case, for a process
    parser.add_argument("-o", "--output", type=Path, default=Path("build/arrays.png"))
    given = parser.parse_args()
    if given.one:
        print(json.dumps(measure(given.one, given.end, given.repeats)))
        return
    print(f"load of the machine (1 min): {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
    print(
        "| array | units | bodies | states | unknowns | method | start, ms | ms a simulated s |"
        " times real time | memory, MiB | estimated error |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    rows: dict[str, list[dict[str, Any]]] = {way: [] for way in WAYS}
    with tempfile.TemporaryDirectory() as folder:
        for count in sorted(given.units):
            tables = water(count)
            for way, (joined, limited) in WAYS.items():
                place = Path(folder) / way.replace(", ", "_") / str(count)
                place.mkdir(parents=True)
                bodies, states = write(tables, count, joined, limited, place)
                command = [sys.executable, __file__, "--one", str(place / "case.toml")]
                options = ["--end", f"{given.end}", "--repeats", f"{given.repeats}"]
                done = subprocess.run(
                    [*command, *options], check=True, capture_output=True, text=True
                )
                row = json.loads(done.stdout) | {"bodies": bodies}
                rows[way].append(row)
                print(
                    f"| {way} | {count} | {bodies} | {states} | {row['unknowns']}"
                    f" | `{row['method']}` | {1e3 * row['start']:.0f} | {1e3 * row['time']:.2f}"
                    f" | {1.0 / row['time']:.0f} | {row['memory']:.0f} | {row['error']:.0e} |",
                    flush=True,
                )
        for way, found in rows.items():
            print(
                f"{way}: slope of the time {slope(found, 'time'):.2f}, from 3 bodies on "
                f"{slope(found, 'time', 3):.2f}; of the memory {slope(found, 'memory'):.2f}"
            )
    draw(rows, given.output)
    print(f"load of the machine (1 min): {os.getloadavg()[0]:.1f}; picture: {given.output}")


if __name__ == "__main__":
    main()
