"""Exchanges a second between a run and a controller over TCP/IP on this machine.

    python tests/benchmark/tcp_exchanges.py [EXCHANGES]

The time of an exchange is what the run waits for an answer: two frames, two ways through the
kernel of the operating system, and the controller; the least mean of twenty runs, as other work on
the machine only adds to it. Its share is that of the wall time of the run, which makes a step of
one body from one exchange to the next. Controllers: hydrodae.tcp in another process, both
protocols, and the C program of cases/control where there is a compiler.
"""

from __future__ import annotations

import argparse
import os
import shutil
import socket
import subprocess
import sys
import tempfile
from pathlib import Path

import hydrodae
from hydrodae.commands.cli import guarded

RUNS = 20
ROOT = Path(__file__).resolve().parents[2]
CLIENT = """
import sys
from hydrodae import tcp
bare = (1, 1) if sys.argv[2] == "hotint" else None
with tcp.connect(port=int(sys.argv[1]), hotint=bare) as run:
    answer = run.answer
    for _, (rate,) in run:
        answer(-600.0 * rate)
"""


def free_port() -> int:
    """Return a port that nobody has."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        return int(server.getsockname()[1])


def measure(command: list[str], protocol: str, exchanges: int) -> tuple[float, float]:
    """Return the mean wall time of an exchange [s], and the share of exchanges in the run."""
    port = free_port()
    values = {
        "controller.pi.port": port,
        "controller.pi.protocol": protocol,
        "controller.pi.period": 1e-3,
        "solver.end_time": 1e-3 * exchanges,
        "output.step": 1.0,
    }
    words = [str(port) if word == "PORT" else word for word in command]
    with subprocess.Popen(words) as client:
        results = hydrodae.run(ROOT / "cases" / "control" / "case_tcp.toml", set=values)
        client.wait(10)
    told = results.statistics
    mean = float(told["controller_mean_time.pi"])
    return mean, mean * float(told["controller_calls.pi"]) / float(told["wall_time"])


def main() -> int:
    """Measure and print a line for each controller."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("exchanges", nargs="?", type=int, default=1000, help="of each run (1000)")
    exchanges = parser.parse_args().exchanges
    python = [sys.executable, "-c", CLIENT, "PORT"]
    runs = [
        ("Python", "hydrodae", [*python, "hydrodae"]),
        ("Python", "hotint", [*python, "hotint"]),
    ]
    with tempfile.TemporaryDirectory() as folder:
        if compiler := shutil.which("cc"):
            program = os.path.join(folder, "client")
            source = ROOT / "cases" / "control" / "client.c"
            subprocess.run([compiler, "-O2", str(source), "-o", program], check=True)
            runs.append(("C", "hotint", [program, "PORT"]))
        for name, protocol, command in runs:
            time, share = min(measure(command, protocol, exchanges) for _ in range(RUNS))
            rate = f"{1e6 * time:6.1f} us  {1 / time:8,.0f} exchanges/s"
            print(f"{name:7} {protocol:9} {rate}, {100 * share:.0f} % of the run", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(guarded(main))
