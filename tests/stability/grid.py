"""Run methods on scenes and judge every run: pass, stopped, refused or wrong."""

from __future__ import annotations

import math
import re
import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from tests.stability import mechanics, past, switching, water
from tests.stability.methods import METHODS, Method
from tests.stability.scene import Scene

from hydrodae.case import Case
from hydrodae.errors import CaseError, HydrodaeError, RunInterrupted, SolverError
from hydrodae.results import Results
from hydrodae.simulation import run

PASS, STOPPED, REFUSED, WRONG = "pass", "stopped", "refused", "wrong"

#: A run that must stop at a lock may notice it this much late [s].
LOCK_MARGIN = 0.01


@dataclass(frozen=True)
class Cell:
    """One method on one scene.

    Attributes
    ----------
    scene, method : str
        Names.
    outcome : str
        "pass", "stopped", "refused" or "wrong".
    reason : str
        Why it is not a plain pass.
    error, allowance : float or None
        Largest error over the run, or over the part before it stopped, and the largest one of a
        right motion, in the unit of the scene.
    time_s : float
        CPU time [s].
    reached_s : float
        Simulated time [s].
    balance : float or None
        Largest error of the energy balance over the largest energy exchanged.
    size : float or None
        How far the motion goes from its start, in the unit of the scene.
    estimate : float or None
        The run's own estimate of its error, relative to the size of its motion.
    """

    scene: str
    method: str
    outcome: str
    reason: str = ""
    error: float | None = None
    time_s: float = 0.0
    allowance: float | None = None
    reached_s: float = 0.0
    balance: float | None = None
    size: float | None = None
    estimate: float | None = None

    def record(self) -> dict[str, Any]:
        """Return the cell for JSON; an error that is not finite becomes None."""
        values = asdict(self)
        for key in ("error", "allowance", "balance", "estimate"):
            if values[key] is not None and not math.isfinite(values[key]):
                values[key] = None
        return values


def all_scenes() -> dict[str, Scene]:
    """Return the scenes of the map by name."""
    every = (*mechanics.scenes(), *switching.scenes(), *past.scenes(), *water.scenes())
    return {scene.name: scene for scene in every}


def all_methods() -> dict[str, Method]:
    """Return the methods of the map by name."""
    return {method.name: method for method in METHODS}


def stability_map(
    scenes: Iterable[Scene] | None = None,
    methods: Iterable[Method] | None = None,
    *,
    time_limit: float = 5.0,
    report: Callable[[Cell], None] | None = None,
) -> list[Cell]:
    """Run every method on every scene.

    Parameters
    ----------
    scenes, methods : iterable, optional
        Rows and columns; by default all.
    time_limit : float
        CPU time [s] after which a run counts as stopped.
    report : callable, optional
        Called with each cell when it is known.

    Returns
    -------
    list of Cell
    """
    columns = list(all_methods().values() if methods is None else methods)
    cells = []
    with tempfile.TemporaryDirectory(prefix="hydrodae-stability-") as folder:
        for scene in all_scenes().values() if scenes is None else scenes:
            for method in columns:
                cells.append(run_cell(scene, method, Path(folder), time_limit))
                if report is not None:
                    report(cells[-1])
    return cells


def run_cell(scene: Scene, method: Method, folder: Path, time_limit: float) -> Cell:
    """Run one method on one scene and judge the motion.

    Parameters
    ----------
    scene : Scene
        Row.
    method : Method
        Column.
    folder : path
        Takes the scene's hydrodynamic database.
    time_limit : float
        CPU time [s].
    """
    started = time.process_time()
    results: Results | None
    complaint = ""
    try:
        results = _run(scene, scene.case(method.keys(scene), folder), time_limit)
    except CaseError as error:
        return _told(scene, method, REFUSED, error)
    except RunInterrupted as error:
        results, complaint = error.results, "time limit"
    except SolverError as error:
        results, complaint = error.results, _first_line(error)
        if scene.told or results is None or len(results.time) == 0:  # did not even start
            return _told(scene, method, STOPPED, error)
    except HydrodaeError as error:
        return _told(scene, method, STOPPED, error)
    assert results is not None
    spent = time.process_time() - started
    outcome, reason, off = _judge(scene, method, results, complaint)
    balance, estimate = (
        results.statistics.get(name) for name in ("relative_balance_error", "estimated_error")
    )
    return Cell(
        scene.name, method.name, outcome, reason, off, spent, method.allowance(scene),
        results.end_time, None if balance is None else float(balance), scene.motion(results),
        None if estimate is None else float(estimate),
    )  # fmt: skip


def _run(scene: Scene, case: Case, time_limit: float) -> Results:
    """Run the case; CPU time, since on a busy machine wall time says little about the method."""
    deadline = time.process_time() + time_limit
    return run(
        case,
        progress=lambda _time, _end: time.process_time() < deadline,
        drives=scene.drives,
        controllers={name: make() for name, make in (scene.controllers or {}).items()} or None,
    )


def _told(scene: Scene, method: Method, outcome: str, error: Exception) -> Cell:
    """Cell of a run without a motion to judge: right if the scene asks for just that message."""
    line = _first_line(error)
    if scene.told and re.search(scene.told, str(error)):
        return Cell(scene.name, method.name, PASS, f"{outcome}: {line}")
    return Cell(scene.name, method.name, outcome, line)


def _judge(
    scene: Scene, method: Method, results: Results, complaint: str
) -> tuple[str, str, float | None]:
    """Outcome, reason and error of a run that left results; `complaint` if it did not complete."""
    if complaint and scene.lock_time is None:
        return STOPPED, complaint, scene.error(results)
    if scene.impossible:
        return WRONG, f"completes although {scene.impossible}", None
    if scene.told and scene.truth is None:
        notes = [note for note in results.notes if re.search(scene.told, note)]
        if notes:
            return PASS, notes[0], None
        return WRONG, "completes, and does not report what it changed", None
    off, allowed = scene.error(results), method.allowance(scene)
    if scene.lock_time is not None:
        late = results.end_time - scene.lock_time
        sample = results.time[1] if len(results.time) > 1 else 0.0
        if late > LOCK_MARGIN + sample:
            return WRONG, f"passes the lock by {late:.3g} s", late
        if complaint == "time limit" or late < -LOCK_MARGIN:
            return STOPPED, complaint, off
        if off > allowed:
            return WRONG, f"off by {off:.2g} {scene.unit} before the lock", off
        return PASS, f"stops at the lock: {complaint}", off
    if off > allowed:
        parted = min((e.runs_part_at for e in results.accuracy().values()), default=math.inf)
        if math.isfinite(parted):  # the output states it
            return PASS, f"off by {off:.2g} {scene.unit}; two runs part at {parted:.3g} s", off
        return WRONG, f"off by {off:.2g} {scene.unit}, more than {allowed:.2g}", off
    return PASS, "", off


def _first_line(error: Exception) -> str:
    line = next(iter(str(error).splitlines()), "")
    return re.sub(r"^<?string>?:\s*", "", line)
