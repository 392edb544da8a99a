"""Progress of long work on stderr: a bar in a terminal, else a plain line every few seconds."""

from __future__ import annotations

import sys
from time import monotonic
from types import TracebackType
from typing import Self

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn
from rich.status import Status

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


class StageLine:
    """Callback of work in stages of unknown number: its last line of text, and the time.

    Examples
    --------
    >>> with StageLine("fit") as progress:
    ...     progress("12 states")  # quiet: the work is young
    """

    def __init__(self, title: str) -> None:
        self._title = title
        self._console = Console(stderr=True)
        self._start = self._last = monotonic()
        self._status: Status | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._status is not None:
            self._status.stop()

    def __call__(self, text: str) -> None:
        """Show the stage."""
        now = monotonic()
        if now - self._start < PATIENCE:
            return
        line = f"{self._title}, {now - self._start:.0f} s: {text}"
        if self._console.is_terminal:
            if self._status is None:
                self._status = Status("", console=self._console)
                self._status.start()
            self._status.update(escape(line))
        elif now - self._last >= INTERVAL:
            self._last = now
            print(line, file=sys.stderr, flush=True)
