"""Mutated inputs for the readers, the checks and the solver.

    bash tests/fuzz/run.sh [--seconds 600] [--seed 1] [--inputs 10000]

Input k of a seed is always the same: a case (alone or with a command line), a case with a mutated
database or mesh, a results file, a database of another program (tables.py), a folder of WEC-Sim
(wecsim.py), or a study, a journal of a sweep, a record or a checkpoint (files.py). C++ reads,
checks and runs cases under sanitizers (worker.cpp), Python reads files (reader.py). A fault is what
ends a process, takes longer than a limit, or ends with a code other than 0, 2, 3 and 4; it is kept
in build/fuzz with the words that repeat it.

HDF5 1.10 itself reads and writes beyond its memory on some damaged files. Databases have a process
each, so that what they spoil is not found later elsewhere, and what ends inside the library is
counted by itself ("HDF5").
"""

from __future__ import annotations

import argparse
import os
import queue
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from random import Random

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from tests.fuzz import cases, files, hdf5, meshes, tables, values, wecsim  # noqa: E402

DOCUMENTED = (0, 2, 3, 4)
PATIENCE = 900.0  # s of wall time; workers count processor time themselves
SANITIZERS = {
    "ASAN_OPTIONS": "abort_on_error=0:handle_abort=1:detect_stack_use_after_return=1:"
    "max_allocation_size_mb=2000:hard_rss_limit_mb=4000",
    "UBSAN_OPTIONS": "print_stacktrace=1",
    "LSAN_OPTIONS": f"print_suppressions=0:suppressions={ROOT / 'tests/fuzz/leaks.txt'}",
}


class Worker:
    """A process that answers one line for each request."""

    def __init__(self, command: list[str], log: Path) -> None:
        """Nothing runs before the first request."""
        self.command, self.log = command, log
        self.process: subprocess.Popen[bytes] | None = None

    def ask(self, request: str) -> tuple[int | None, str]:
        """Return code and message, without a code where the process ended or hangs."""
        if self.process is None:
            with self.log.open("w") as log:
                self.process = subprocess.Popen(
                    self.command,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=log,
                    env={**os.environ, **SANITIZERS},
                )
        process = self.process
        assert process.stdin is not None
        assert process.stdout is not None
        timer = threading.Timer(PATIENCE, process.kill)
        timer.start()
        try:
            process.stdin.write(f"{request}\n".encode())
            process.stdin.flush()
            answer = process.stdout.readline()  # bytes: a carriage return ends no line
        except BrokenPipeError:
            answer = b""
        finally:
            timer.cancel()
        code, _, message = answer.decode(errors="replace").partition(" ")
        if answer and code.isdecimal():
            return int(code), message.strip()
        if answer:  # what follows may be the answer to this request or to the next
            process.kill()
        ended = process.wait()
        self.process = None
        if answer:
            return None, f"no answer: {code[:100]} {message[:200].strip()}"
        return None, f"ended with {ended}: {reason(self.log)}"

    def close(self) -> str:
        """End the process; what it says of leaked memory, if anything."""
        if self.process is None:
            return ""
        process, self.process = self.process, None
        assert process.stdin is not None
        process.stdin.close()
        return reason(self.log) if process.wait(PATIENCE) else ""

    def in_library(self) -> bool:
        """Did it end inside HDF5? The first frame that tells is none of the sanitizer or of libc.

        Of Python it is the line of h5py that called.
        """
        if not self.log.exists():
            return False
        lines = self.log.read_text(errors="replace").splitlines()
        others = ("libsanitizer", "libasan", "sysdeps", "libc.so")
        frames = (line for line in lines if " #" in line and not any(o in line for o in others))
        python = (line for line in lines if line.startswith('  File "'))
        return "libhdf5" in next(frames, "") or "/h5py/" in next(python, "")


def reason(log: Path) -> str:
    """Of a process that ended: what the sanitizer or the run-time library says."""
    lines = log.read_text(errors="replace").splitlines()
    marks = ("ERROR:", "runtime error:", "Assertion", "hang", "terminate called", "what():")
    found = [line for line in lines if any(mark in line for mark in marks)]
    return (found or lines[-1:] or ["no words"])[0][:300]


@dataclass
class Fuzz:
    """What both threads share."""

    corpus: cases.Corpus
    results: list[Path]
    sources: list[Path]
    program: str
    seed: int
    until: float
    inputs: int
    base: Path
    folder: Path
    kinds: tuple[str, ...]
    places: dict[str, Path]
    answers: Counter[str] = field(default_factory=Counter)
    faults: list[str] = field(default_factory=list)
    lock: threading.Lock = field(default_factory=threading.Lock)
    numbers: queue.SimpleQueue[int] = field(default_factory=queue.SimpleQueue)

    def work(self, thread: int) -> None:
        """Take inputs until there are no more, or no time."""
        place = self.base / f"work{thread}"
        logs = [self.base / f"{name}{thread}.log" for name in ("worker", "reader")]
        worker = Worker([self.program], logs[0])
        reading = [sys.executable, "-X", "faulthandler", str(ROOT / "tests/fuzz/reader.py")]
        reader = Worker(reading, logs[1])
        while time.monotonic() < self.until:
            try:
                number = self.numbers.get_nowait()
            except queue.Empty:
                break
            shutil.rmtree(place, ignore_errors=True)
            place.mkdir()
            for kind, by, request in self.make(number, place):
                process = worker if by == "worker" else reader
                alone = kind == "database" and by == "worker"
                if alone and (words := process.close()):
                    self.note(number, "before", "", "", None, words, place, logs)
                code, message = process.ask(request)
                if alone and (words := process.close()):
                    code, message = None, words
                inside = code is None and (alone or by == "reader") and process.in_library()
                self.note(number, kind, by, request, code, message, place, logs, inside)
        for process in (worker, reader):
            if words := process.close():
                self.note(-1, "end", "", "", None, words, place, logs)

    def make(self, number: int, place: Path) -> list[tuple[str, str, str]]:
        """Write input `number`; return requests as kind, who, words."""
        random = Random(f"{self.seed}:{number}")
        kind = random.choice(self.kinds)
        if kind == "results":
            path = place / "results.h5"
            shutil.copy(random.choice(self.results), path)
            hdf5.mutate(path, random)
            return [(kind, "reader", f"results {path}")]
        if kind in files.KINDS:
            path = files.mutated(kind, self.places, place, random)
            return [(kind, "reader", f"{kind} {path}")]
        if kind == "tables":
            return [(kind, "reader", f"tables {tables.mutated(self.sources, place, random)}")]
        if kind == "wecsim":
            wecsim.write(place, random)
            return [(kind, "reader", f"wecsim {place}")]
        if kind == "mesh":
            text, path = meshes.mutated(place, random)
            requests = [(kind, "reader", f"mesh {path}")]
        elif kind == "database":
            wet = [c for c in self.corpus.cases if "hydro" in c]
            case = dict(random.choice(wet))
            source = Path(case["hydro"]["database"])
            if source.stat().st_size > 200_000 and random.random() < 0.8:
                case = dict(wet[0])  # a large one takes long
                source = Path(case["hydro"]["database"])
            shutil.copy(source, place / "hydro.h5")
            hdf5.mutate(place / "hydro.h5", random)
            how = random.choice(("exponential", "exponential", "none", "constant", "convolution"))
            case["hydro"] = {**case["hydro"], "database": "hydro.h5", "radiation": how}
            case["solver"] = {**case["solver"], "end_time": 2.0}
            text = values.case_text(case)
            requests = [(kind, "reader", f"database {place / 'hydro.h5'}")]
        else:
            text, requests = cases.mutated(self.corpus, random), []
            if kind == "command" and random.random() < 0.7:
                text = values.case_text(random.choice(self.corpus.cases))
        (place / "case.toml").write_bytes(text.encode("utf-8", "replace"))
        if kind == "command":
            words = cases.words(text, self.corpus, random)
            (place / "words").write_bytes(
                b"".join(w.encode("utf-8", "replace") + b"\0" for w in words)
            )
        tasks = random.choice(("r", "r", "er", "lr", "w"))
        return [*requests, (kind, "worker", f"{tasks} {place}")]

    def note(
        self,
        number: int,
        kind: str,
        by: str,
        request: str,
        code: int | None,
        message: str,
        place: Path,
        logs: list[Path],
        in_library: bool = False,
    ) -> None:
        """Count an answer; keep a fault."""
        fine = code in DOCUMENTED and message
        with self.lock:
            if in_library:
                self.answers[f"{kind}, {by}: HDF5"] += 1
                return
            self.answers[f"{kind}, {by}: {code if fine else 'FAULT'}"] += 1
            if fine:
                return
            kept = self.folder / "faults" / f"{self.seed}_{number}_{by}"
            shutil.rmtree(kept, ignore_errors=True)
            shutil.copytree(place, kept)
            for log in logs:
                if log.exists():
                    shutil.copy(log, kept)
            command = self.program if by == "worker" else f"{sys.executable} tests/fuzz/reader.py"
            again = f"{command} {request.replace(str(place), str(kept))}"
            self.faults.append(f"input {number} ({kind}): code {code}, {message}\n    {again}")
            print(self.faults[-1], flush=True)


def make_results(folder: Path) -> list[Path]:
    """Results files to start from: of a mechanism, and of a body in water."""
    import hydrodae

    paths = []
    for case in ("benchmarks/door", "sphere/decay"):
        path = folder / f"{Path(case).stem}.h5"
        length = {"solver.end_time": 1.0, "output.step": 0.05}
        hydrodae.run(ROOT / "cases" / f"{case}.toml", output=path, set=length)
        paths.append(path)
    return paths


def main() -> int:
    """Return 0 where there is no fault."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seconds", type=float, default=600.0, help="time limit")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--inputs", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0, help="number of the first input")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--program", default=str(ROOT / "build/tests/tests/fuzz/hydrodae-fuzz"))
    parser.add_argument(
        "--kinds",
        default="case,case,command,database,mesh,results,tables,wecsim," + ",".join(files.KINDS),
    )
    options = parser.parse_args()
    folder = ROOT / "build" / "fuzz"
    (folder / "faults").mkdir(parents=True, exist_ok=True)
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="hydrodae-fuzz-") as place:
        base = Path(place)
        fuzz = Fuzz(
            cases.collect(base),
            make_results(base),
            tables.collect(base),
            options.program,
            options.seed,
            start + options.seconds,
            options.inputs,
            base,
            folder,
            tuple(options.kinds.split(",")),
            files.prepare(base),
        )
        for number in range(options.first, options.first + options.inputs):
            fuzz.numbers.put(number)
        threads = [threading.Thread(target=fuzz.work, args=(k,)) for k in range(options.jobs)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    for what, count in sorted(fuzz.answers.items()):
        print(f"{count:7} {what}")
    done = options.inputs - fuzz.numbers.qsize()
    spent = time.monotonic() - start
    print(f"{done} inputs of seed {options.seed} in {spent:.0f} s: {len(fuzz.faults)} faults")
    return 1 if fuzz.faults else 0


if __name__ == "__main__":
    sys.exit(main())
