"""Progress of long work on stderr: a bar in a terminal, else a plain line every few seconds."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from functools import cached_property
from time import monotonic
from typing import TYPE_CHECKING, Self

if TYPE_CHECKING:  # rich takes longer to load than short work takes
    from rich.console import Console
    from rich.progress import Progress
    from rich.status import Status

#: Wall time before anything is shown, s.
PATIENCE = 1.0
#: Wall time between two plain lines, s.
INTERVAL = 5.0


class _Line:
    """What both kinds share: patience, a live display in a terminal, plain lines elsewhere."""

    def __init__(self, title: str) -> None:
        self._title = title
        self._start = self._last = self._now = monotonic()
        self._live: Progress | Status | None = None

    @cached_property
    def _console(self) -> Console:
        from rich.console import Console

        return Console(stderr=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._live is not None:
            self._live.stop()

    def _look(self) -> float:
        """Return the wall time since the start, s."""
        self._now = monotonic()
        return self._now - self._start

    def _print_seldom(self, line: str) -> None:
        if self._now - self._last >= INTERVAL:
            self._last = self._now
            print(line, file=sys.stderr, flush=True)


class ProgressLine(_Line):
    """Callback of a run, and the context in which the bar lives.

    Examples
    --------
    >>> with ProgressLine("case") as progress:
    ...     progress(1.0, 10.0)  # quiet: the run is young
    """

    def __init__(self, title: str, unit: str = "s") -> None:
        super().__init__(title)
        self._unit = unit

    def __call__(self, time: float, end_time: float) -> None:
        """Show that `time` of `end_time` [s] is reached."""
        spent = self._look()
        if spent < PATIENCE:
            return
        if self._console.is_terminal:
            self._update_bar(time, end_time)
            return
        remaining = spent * (end_time - time) / time if time > 0 else float("inf")
        done = f"{time:g} of {end_time:g} {self._unit}"
        self._print_seldom(f"{self._title}: {done}, about {remaining:.0f} s to go")

    def _update_bar(self, time: float, end_time: float) -> None:
        from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

        if not isinstance(self._live, Progress):
            self._live = Progress(
                TextColumn("{task.description}", markup=False),
                BarColumn(),
                TextColumn("{task.completed:g} of {task.total:g} " + self._unit),
                TimeRemainingColumn(),
                console=self._console,
                transient=True,
            )
            self._task = self._live.add_task(self._title, total=end_time)
            self._live.start()
        self._live.update(self._task, completed=time)


class StageLine(_Line):
    """Callback of work in stages: a line as each begins, then its last line of text, and the time.

    Parameters
    ----------
    title : str
        Of the work.
    stages : iterable of str
        Names of the stages; any other text is shown now and then.

    Examples
    --------
    >>> with StageLine("fit", ["look", "search"]) as progress:
    ...     progress("12 states")  # quiet: the work is young
    """

    def __init__(self, title: str, stages: Iterable[str] = ()) -> None:
        super().__init__(title)
        self._stages = frozenset(stages)

    def __call__(self, text: str) -> None:
        """Show that a stage begins, or how far it is."""
        spent = self._look()
        line = f"{self._title}, {spent:.0f} s: {text}"
        if text in self._stages:
            self._last = self._now
            self._console.print(line, markup=False, highlight=False, soft_wrap=True)
            return
        if spent < PATIENCE:
            return
        if not self._console.is_terminal:
            self._print_seldom(line)
            return
        from rich.markup import escape
        from rich.status import Status

        if not isinstance(self._live, Status):
            self._live = Status("", console=self._console)
            self._live.start()
        self._live.update(escape(line))
