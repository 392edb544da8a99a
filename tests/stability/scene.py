"""What a hard scene is: a case, the truth of its motion, and how large an error may be.

The allowance was fixed before the methods were run. It knows the scene only by the size L of its
motion (m, or the unit of the error), its time scale tau (the reciprocal of its fastest rate that
matters: that moves more than the smallest allowance, 1e-3 L) and its length T:

- a run with error control at relative tolerance r:  L sqrt(r) max(1, T / (10 tau)), that is 1e-3 of
  the size for every ten time scales at the default r = 1e-6, and its square root at looser ones
  (for r < 1e-6 that of 1e-6);
- a run at a fixed step h:  L (T / tau) (h / tau)^2, what a second-order method may lose;
- and never more than L / 10: beyond that it is another motion, whatever the tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.case import Case
from hydrodae.case.callbacks.controllers import Controller
from hydrodae.case.callbacks.drives import Drive
from hydrodae.case.case import to_toml
from hydrodae.results import Results
from hydrodae.support.arrays import Array

#: Smallest allowance, of the size of the motion.
SMALLEST = 1e-3


@dataclass(frozen=True)
class Scene:
    """A scene that is known to be hard, and how a run of it is judged.

    Attributes
    ----------
    name, title : str
        Name on the command line, and what is hard.
    tables : mapping
        The case by table, without what a method sets.
    truth : callable, optional
        The compared quantity over time: (nt,) times [s] to (nt, n) values; computed independently.
    measured : callable, optional
        The same quantity of a run: results to (nt, n) values. With `truth` None it is (nt,) an
        error of its own (energy gained, for instance).
    size : float
        Size of the motion, in the unit of the error.
    time_scale : float
        Reciprocal of its fastest rate that matters [s].
    source : str
        Where the truth comes from.
    unit : str
        Unit of the error.
    lock_time : float, optional
        Time [s] at which the mechanism locks, so that a run must stop there.
    judged_until : float
        The motion is compared until then [s].
    impossible : str
        Why the scene has no sound motion: every run that completes is wrong; else empty.
    told : str
        Pattern of what must be said where the scene contradicts itself: a refusal or a stop whose
        message matches it is right. A run that completes needs a note that matches it, or, where
        there is a truth, the right motion.
    drives : mapping, optional
        Python functions of time by the name of the constraint that they drive.
    controllers : mapping, optional
        Makes a Python controller for each run, by the name of the controller.
    database : callable, optional
        Writes the hydrodynamic database `hydro.h5` at a path.
    """

    name: str
    title: str
    tables: Mapping[str, Any]
    size: float
    time_scale: float
    source: str
    truth: Callable[[Array], Array] | None = None
    measured: Callable[[Results], Array] | None = None
    unit: str = "m"
    lock_time: float | None = None
    judged_until: float = math.inf
    impossible: str = ""
    told: str = ""
    drives: Mapping[str, Drive] | None = field(default=None, repr=False)
    controllers: Mapping[str, Callable[[], Controller]] | None = field(default=None, repr=False)
    database: Callable[[Path], None] | None = field(default=None, repr=False)

    @property
    def end_time(self) -> float:
        """Length of the run, s."""
        return float(self.tables["solver"]["end_time"])

    def case(self, solver: Mapping[str, Any], folder: Path) -> Case:
        """Return the case with the keys of `solver`; `folder` takes the database, if any.

        Raises
        ------
        CaseError
            The method is refused for this scene.
        """
        tables = dict(self.tables)
        tables["solver"] = {**tables["solver"], **solver}
        if self.database is not None:
            path = folder / f"{self.name}.h5"
            if not path.exists():
                self.database(path)
            tables["hydro"] = {"database": path.name, **tables.get("hydro", {})}
        lines = [f"{key} = {to_toml(value, key)}" for key, value in tables.items()]
        return Case.from_text("\n".join([f"title = {to_toml(self.title)}", *lines]), folder)

    def allowance(self, rtol: float | None = None, step: float | None = None) -> float:
        """Return the largest error of a right motion, in `unit`.

        Parameters
        ----------
        rtol : float, optional
            Relative tolerance of a run with error control.
        step : float, optional
            Fixed step [s] of a run without.
        """
        scales = self.end_time / self.time_scale
        if step is not None:
            return self.size * min(0.1, scales * (step / self.time_scale) ** 2)
        loose = max(math.sqrt(rtol or 0.0), SMALLEST)
        return self.size * min(0.1, loose * max(1.0, scales / 10.0))

    def motion(self, results: Results) -> float:
        """Return how far what is measured goes from its start, in `unit`; `size` without a truth.

        What a run's own estimate is relative to. The size by which a run is judged may be smaller,
        as that of the delay that a bump causes on a long way.
        """
        if self.truth is None or len(results.time) == 0:
            return self.size
        exact = self.truth(results.time[results.time <= self.judged_until])
        return float(np.linalg.norm(exact - exact[0], axis=1).max()) or self.size

    def error(self, results: Results) -> float:
        """Return the largest error of a run over its samples, in `unit`; inf if not finite."""
        assert self.measured is not None
        if len(results.time) == 0:
            return 0.0
        judged = results.time <= self.judged_until
        ours = np.asarray(self.measured(results), dtype=float)[judged]
        if not np.all(np.isfinite(ours)):
            return math.inf
        if self.truth is None:
            return float(np.abs(ours).max(initial=0.0))
        exact = self.truth(results.time[judged])
        return float(np.linalg.norm(ours - exact, axis=1).max(initial=0.0))
