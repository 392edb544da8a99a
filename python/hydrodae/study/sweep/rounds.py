"""Seeds that are added to the sea states of a study until an interval is met."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from hydrodae import _core
from hydrodae.study.sweep.batches import Batch, batches_of
from hydrodae.study.sweep.journal import Row
from hydrodae.study.sweep.plan import Study, point_key
from hydrodae.study.sweep.points import Point


class Rounds(Iterator[Batch]):
    """Batches of a study with an interval: those of a sea state until its interval is met.

    An iterator that has ended for now has more batches when rows have come. Which runs are made
    depends on the rows of the sea state alone.

    Parameters
    ----------
    plan : Study
    rows : mapping from str
        Finished runs by the keys of their points, which grows.
    """

    def __init__(self, plan: Study, rows: Mapping[str, Row]) -> None:
        self._plan, self._rows = plan, rows
        self._cells: dict[str, list[Point]] = {}
        seed = plan.over[0]
        for point in plan.points:
            cell = point_key({k: v for k, v in point.items() if k != seed})
            self._cells.setdefault(cell, []).append(point)
        self._asked = dict.fromkeys(self._cells, 0)
        self._ready: list[Batch] = []

    def __next__(self) -> Batch:
        if not self._ready:
            for cell in list(self._cells):
                self._extend(cell)
        if not self._ready:
            raise StopIteration
        return self._ready.pop(0)

    def _extend(self, cell: str) -> None:
        """Ask for the next rounds of a sea state whose runs have all come."""
        points, wanted = self._cells[cell], self._plan.repetitions
        while True:
            asked = self._asked[cell]
            rows = [self._rows.get(point_key(point)) for point in points[:asked]]
            if any(row is None for row in rows):
                return
            found = wanted.estimate(rows)
            if (asked and found.half <= wanted.interval * abs(found.mean)) or asked >= len(points):
                del self._cells[cell]
                return
            self._asked[cell] = min(len(points), asked + (_core.lanes if asked else wanted.first))
            new = points[asked : self._asked[cell]]
            left = {point_key(point) for point in new} - set(self._rows)
            self._ready += batches_of(self._plan, new, left)
            if left:
                return
