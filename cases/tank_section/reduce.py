"""What the other scripts need of the measured series: measured.csv, wave_1031_1.csv, ...

    python cases/tank_section/reduce.py REFERENCE/tank_section

The incident amplitude of a test is that of the wave alone, of the same period and code of height:
mean of the probes at 5.5 and 8.5 m (the model is at 7 m) and of the repetitions.
"""

from __future__ import annotations

import argparse
import csv
import sys
from pathlib import Path

import numpy as np

from hydrodae.commands.cli import guarded

FOLDER = Path(__file__).parent
SOURCE = """# From github.com/KRSundsdal1/2D-ship-cross-section-in-regular-waves, commit 2465cee,
# CC0 1.0: K. R. Sundsdal, M. Greco, F.-C. Hanssen, C. Lugni (2025), Ocean Engineering; NTNU flume.
"""
#: Tests of the wave alone whose records are kept.
RECORDS = ("1031_1", "1061_1", "1101_1")
HEAD = ("test", "period", "incident", "window", "cycles", "along", "up", "moment")
#: Columns of forces [N, N m] and of motions [m, rad].
COLUMNS = {2: ("Fy", "Fz", "Mx"), 3: ("Sway", "Heave", "Roll")}

Row = dict[str, str]


def harmonics(folder: Path, kind: int) -> list[Row]:
    """Rows of harmonics_NPPH.csv."""
    with (folder / f"harmonics_{kind}PPH.csv").open() as file:
        return list(csv.DictReader(file))


def incident(waves: list[Row], test: Row) -> float:
    """Amplitude of the undisturbed wave at the model [m]."""
    same = [w for w in waves if all(w[k] == test[k] for k in ("period_index", "height_code"))]
    return float(np.mean([float(w[name]) for w in same for name in ("WP_4_amp", "WP_6_amp")]))


def write_measured(folder: Path) -> None:
    """All tests of the fixed and of the free section, one a line."""
    waves = harmonics(folder, 1)
    with (FOLDER / "measured.csv").open("w", newline="") as file:
        file.write(SOURCE)
        rows = csv.writer(file)
        rows.writerow(HEAD)
        for kind, names in COLUMNS.items():
            for test in harmonics(folder, kind):
                values = [float(test[f"{name}_amp"]) for name in names]
                if min(values) < 1e-9:
                    continue  # the camera lost the model
                window = float(test["win_start"]) - float(test["wm_start"])
                numbers = [float(test["T"]), incident(waves, test), window, int(test["cycles"])]
                rows.writerow([test["test"], *(f"{x:.5g}" for x in [*numbers, *values])])


def write_record(folder: Path, wave: str) -> None:
    """Elevation at 5.5 m from the start of the wavemaker, ten samples a second."""
    start = next(float(r["wm_start"]) for r in harmonics(folder, 1) if r["test"] == wave)
    series = np.genfromtxt(folder / f"series_{wave}.csv", delimiter=",", names=True)
    time = np.arange(0.0, series["Time_s"][-1] - start, 0.1)
    eta = np.interp(time + start, series["Time_s"], series["WP_4_m"])
    with (FOLDER / f"wave_{wave}.csv").open("w") as file:
        file.write("time,elevation\n")
        file.writelines(f"{t:.1f},{x:.5f}\n" for t, x in zip(time, eta, strict=True))


def main() -> None:
    """Write the files beside this one."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("reference", type=Path, help="folder of the reference data")
    folder = parser.parse_args().reference
    write_measured(folder)
    for wave in RECORDS:
        write_record(folder, wave)


if __name__ == "__main__":
    sys.exit(guarded(main))
