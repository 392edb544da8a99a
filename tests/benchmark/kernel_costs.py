"""What hydrodae costs: each part of a step, whole runs, and both beside the floor.

    .venv/bin/python tests/benchmark/kernel_costs.py --output docs/performance.md

Builds kernel_costs.cpp and floor.cpp (release, in build/benchmark) and measures all scenes, or
those of --scenes. Times are the best of several. Instructions are counted where valgrind is
installed. They hardly depend on what else the machine does, times do.

The tables are printed. --output puts them between the two markers of a page. Each run adds a record
to a history of this machine; the last table shows what has changed since the record before.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.benchmark import counting  # noqa: E402
from tests.benchmark.counting import count, run, seconds, sets, wall  # noqa: E402
from tests.benchmark.floor import AGREE, CASE, END, solve, write_numbers  # noqa: E402
from tests.benchmark.kernel_scenes import NAMES, Scene, scene  # noqa: E402

import hydrodae  # noqa: E402

KERNELS = ("residual", "jacobian", "factorise", "solve", "accelerations", "sample")
PHASES = ("read", "start", "march", "output", "estimate", "whole")
ERRORS = (1e-3, 1e-6)  # of the largest angle
STEPS = {"gauss": range(20, 200, 2), "rk": range(50, 400, 5)}
BEGIN, FINISH = "<!-- made by tests/benchmark/kernel_costs.py -->", "<!-- end of what it made -->"
Record = dict[str, Any]


def measure(chosen: Scene, folder: Path) -> Record:
    """Figures of one scene: of one call of each part, and of the phases of a whole run."""
    case, output = str(chosen.case), str(folder / "results.h5")
    keys = sets(chosen.keys)
    whole = [case, "-o", output, "--quiet", *sets(chosen.keys, "--set")]
    alone = [*whole, "--set", 'solver.accuracy="none"']
    kernels = seconds("costs", "kernels", case, *keys)
    phases = seconds("costs", "run", case, *keys, repeats=3)
    found: Record = {
        "end": chosen.end,
        "unknowns": kernels.pop("unknowns"),
        "nonzeros": kernels.pop("nonzeros"),
        "steps": phases.pop("steps"),
        "seconds": kernels | {"march": phases["march"]},
    }
    found["seconds"]["whole"] = wall("solve", *whole)
    if counting.can_count():
        counts = count("costs", "kernels", case, *keys)
        phase = count("costs", "run", case, *keys)
        without, all_of_it = count("solve", *alone)["rest"], count("solve", *whole)["rest"]
        counts |= {name: phase[name] for name in ("read", "start", "march")}
        counts["output"] = without - sum(phase[name] for name in ("read", "start", "march"))
        counts["estimate"], counts["whole"] = all_of_it - without, all_of_it
        counts.pop("rest")
        found["instructions"] = counts
    return found


def angles(rtol: float, folder: Path) -> np.ndarray[Any, Any]:
    """Angles of both hinges at the samples of a run of hydrodae with explicit_rk [rad]."""
    path = folder / "decay.h5"
    run("solve", str(CASE), "-o", str(path), "--quiet", *sets(decay(rtol), "--set"))
    results = hydrodae.Results(path)
    return np.column_stack([np.asarray(results[f"joints/hinge{i}/angle"]) for i in (1, 2)])


def decay(rtol: float) -> Record:
    """The flap decay by explicit_rk, without the estimate of the error."""
    method = {"solver.method": '"explicit_rk"', "solver.accuracy": '"none"'}
    return {"solver.end_time": END, "solver.rtol": f"{rtol:.3g}"} | method


def measure_floor(folder: Path) -> list[Record]:
    """Cheapest runs of hydrodae and of both methods of the floor that meet each error."""
    numbers = folder / "numbers.txt"
    write_numbers(numbers)
    truth = solve(numbers, "gauss", 800)
    largest = float(np.abs(truth).max())

    def error(other: np.ndarray[Any, Any]) -> float:
        return float(np.abs(other - truth).max()) / largest

    apart = error(angles(1e-11, folder))
    if apart > AGREE:
        raise SystemExit(f"hydrodae and the floor differ by {apart:.1e} of the largest angle")
    rtols = 10.0 ** -np.arange(2.0, 9.0, 0.5)
    own = {float(rtol): error(angles(float(rtol), folder)) for rtol in rtols}
    rows = []
    for goal in ERRORS:
        rtol = next(value for value in own if own[value] <= goal)
        keys = sets(decay(rtol))
        timed = seconds("costs", "run", str(CASE), *keys, repeats=10)
        row = {"goal": goal, "method": "explicit_rk", "setting": f"rtol {rtol:.0e}"}
        row |= {"error": own[rtol], "steps": timed["steps"], "seconds": timed["march"]}
        if counting.can_count():
            row["instructions"] = count("costs", "run", str(CASE), *keys)["march"]
        rows.append(row)
        for method, ladder in STEPS.items():
            found = ((n, error(solve(numbers, method, n))) for n in ladder)
            steps, least = next((n, value) for n, value in found if value <= goal)
            given = [str(numbers), method, str(steps)]
            row = {"goal": goal, "method": method, "setting": "floor", "error": least}
            row |= {"steps": steps, "seconds": seconds("floor", *given)["seconds"]}
            if counting.can_count():
                row["instructions"] = count("floor", *given)["floor"]
            rows.append(row)
    return rows


def number(value: float) -> str:
    """Three digits, without powers of ten."""
    return f"{value:.3g}" if value < 100.0 else f"{value:,.0f}".replace(",", " ")


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def tables(record: Record) -> str:
    """The record in Markdown."""
    counted = record["counted"]
    calls, runs = [], []
    for name, found in record["scenes"].items():
        time_of, made = found["seconds"], found.get("instructions", {})
        cells = [name, f"{found['unknowns']:.0f}"]
        for kernel in KERNELS:
            spent = number(1e6 * time_of[kernel])
            cells.append(f"{number(1e-3 * made[kernel])} ({spent})" if counted else spent)
        calls.append(cells)
        steps = [name, f"{found['end']:g}", f"{found['steps']:.0f}"]
        phases = [number(1e-6 * made[phase]) if counted else "-" for phase in PHASES]
        runs.append([*steps, *phases, number(1e3 * time_of["whole"])])
    unit = "Thousands of instructions (in brackets us)" if counted else "Microseconds"
    parts = [
        f"{unit} of one call:\n",
        table(["scene", "unknowns", *KERNELS], calls),
        "\nMillions of instructions of whole runs, and the wall time of `hydrodae-solve`:\n",
        table(["scene", "s", "steps", *PHASES, "wall, ms"], runs),
    ]
    if record["floor"]:
        parts += ["\nThe flap decay beside the floor, 100 s:\n", floor_table(record["floor"])]
    return "\n".join(parts)


def floor_table(found: list[Record]) -> str:
    head = ["error", "method", "setting", "steps", "million instructions", "ms"]
    rows = []
    for row in found:
        own = next(r for r in found if r["goal"] == row["goal"] and r["setting"] != "floor")
        ratios = ["-", "-"]
        if row["setting"] == "floor":
            ratios[1] = number(own["seconds"] / row["seconds"])
            if "instructions" in row:
                ratios[0] = number(own["instructions"] / row["instructions"])
        made = number(1e-6 * row["instructions"]) if "instructions" in row else "-"
        spent = number(1e3 * row["seconds"])
        cells = [f"{row['error']:.1e}", f"`{row['method']}`", row["setting"], f"{row['steps']:.0f}"]
        rows.append([*cells, made, spent, *ratios])
    return table([*head, "hydrodae over it, instructions", "time"], rows)


def changes(before: Record, now: Record) -> str:
    """Figures that both records have, where the three digits of a table differ."""
    rows = []
    for name, found in now["scenes"].items():
        old = before["scenes"].get(name, {})
        for kind in ("instructions", "seconds"):
            for part, value in found.get(kind, {}).items():
                was = old.get(kind, {}).get(part)
                if was and abs(value / was - 1.0) > (0.005 if kind == "instructions" else 0.5):
                    rows.append([name, f"{part}, {kind}", number(was), number(value)])
                    rows[-1].append(f"{value / was:.2f}")
    if not rows:
        return "nothing has changed"
    return table(["scene", "figure", "before", "now", "ratio"], rows)


def processor() -> str:
    """Return the name of the processor (Linux)."""
    path = Path("/proc/cpuinfo")
    lines = path.read_text().splitlines() if path.exists() else []
    names = [line.split(": ", 1)[1] for line in lines if line.startswith("model name")]
    return names[0] if names else platform.processor()


def take(names: list[str]) -> Record:
    """Measure scenes, and the floor."""
    commit = ["git", "-C", str(ROOT), "describe", "--always", "--dirty", "--abbrev=8"]
    made = subprocess.run(commit, capture_output=True, text=True, check=False).stdout.strip()
    record: Record = {
        "date": time.strftime("%Y-%m-%d %H:%M"),
        "commit": made,
        "machine": platform.node(),
        "processor": processor(),
        "compiler": counting.compiler(),
        "load": [os.getloadavg()[0]],
        "counted": counting.can_count(),
        "scenes": {},
    }
    with tempfile.TemporaryDirectory() as place:
        for name in names:
            folder = Path(place) / "".join(c for c in name if c.isalnum())
            folder.mkdir()
            chosen = scene(name, folder)
            if chosen is None:
                print(f"{name}: left out, its database has not been computed", flush=True)
                continue
            record["scenes"][name] = measure(chosen, folder)
            print(f"{name}: measured", flush=True)
        record["floor"] = measure_floor(Path(place))
    record["load"].append(os.getloadavg()[0])
    return record


def put(text: str, page: Path) -> None:
    """Replace what stands between the markers of a page."""
    before, rest = page.read_text().split(BEGIN)
    _, after = rest.split(FINISH)
    page.write_text(f"{before}{BEGIN}\n\n{text}\n\n{FINISH}{after}")


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--scenes", nargs="+", choices=NAMES, default=NAMES, metavar="NAME")
    parser.add_argument("--output", type=Path, help="page whose tables are replaced")
    parser.add_argument("--history", type=Path, help="default: build/benchmark/MACHINE.jsonl")
    given = parser.parse_args()
    counting.build()
    record = take(given.scenes)
    ending = "{date}, commit {commit}, {processor}, {compiler}".format(**record)
    load = " to ".join(f"{value:.1f}" for value in record["load"])
    text = f"{tables(record)}\n\n*{ending}; load of the machine {load} on {os.cpu_count()} cores.*"
    print(text)
    if given.output:
        put(text, given.output)
    history = given.history or ROOT / "build" / "benchmark" / f"{record['machine']}.jsonl"
    lines = history.read_text().splitlines() if history.exists() else []
    if lines:
        last = json.loads(lines[-1])
        print(f"\nSince {last['date']}, commit {last['commit']}:\n\n{changes(last, record)}")
    history.parent.mkdir(parents=True, exist_ok=True)
    with history.open("a") as file:
        file.write(json.dumps(record) + "\n")


if __name__ == "__main__":
    main()
