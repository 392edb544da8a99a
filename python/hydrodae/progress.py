"""Progress of a long run on stderr: a bar in a terminal, else a plain line every few seconds."""

from __future__ import annotations

import sys
from time import monotonic
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

#: Wall time before anything is shown, s.
PATIENCE = 1.0
#: Wall time between two plain lines, s.
INTERVAL = 5.0


class ProgressLine:
    """Callback of a run, and the context in which the bar lives.

    Examples
    --------
    >>> with ProgressLine("case") as progress:
    ...     progress(1.0, 10.0)  # quiet: the run is young
    """

    def __init__(self, title: str, unit: str = "s") -> None:
        self._title, self._unit = title, unit
        self._console = Console(stderr=True)
        self._start = self._last = monotonic()
        self._bar: Progress | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.stop()

    def __call__(self, time: float, end_time: float) -> None:
        """Show that `time` of `end_time` [s] is reached."""
        now = monotonic()
        if now - self._start < PATIENCE:
            return
        if self._console.is_terminal:
            self._update_bar(time, end_time)
        elif now - self._last >= INTERVAL:
            self._last = now
            remaining = (now - self._start) * (end_time - time) / time if time > 0 else float("inf")
            done = f"{time:g} of {end_time:g} {self._unit}"
            print(
                f"{self._title}: {done}, about {remaining:.0f} s to go",
                file=sys.stderr,
                flush=True,
            )

    def _update_bar(self, time: float, end_time: float) -> None:
        if self._bar is None:
            self._bar = Progress(
                TextColumn("{task.description}", markup=False),
                BarColumn(),
                TextColumn("{task.completed:g} of {task.total:g} " + self._unit),
                TimeRemainingColumn(),
                console=self._console,
                transient=True,
            )
            self._task = self._bar.add_task(self._title, total=end_time)
            self._bar.start()
        self._bar.update(self._task, completed=time)
