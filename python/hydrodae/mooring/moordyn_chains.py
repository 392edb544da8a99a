"""Lines of a MoorDyn input file that lie in series."""

from __future__ import annotations

from dataclasses import dataclass

from hydrodae.mooring.moordyn_deck import Deck, Line, Point


@dataclass(frozen=True)
class Chain:
    """Lines in series, from end A, the anchor if there is one, to end B.

    Attributes
    ----------
    ends : tuple of Point
        A and B.
    lines : tuple of Line
        From A to B.
    between : tuple of Point
        Free points between the lines, one less than these.
    hangs : bool
        Whether end B is free, with nothing there.
    """

    ends: tuple[Point, Point]
    lines: tuple[Line, ...]
    between: tuple[Point, ...]
    hangs: bool = False


def find_chains(deck: Deck) -> tuple[list[Chain], list[Point]]:
    """Put the lines of a deck in series.

    Returns
    -------
    chains : list of Chain
        All lines, each in one.
    junctions : list of Point
        Free points that end chains: where one line ends or more than two meet, or that are pushed
        sideways.

    Raises
    ------
    CaseError
        A line ends at something else than a point, or lines make a ring of free points.
    """
    at: dict[str, list[Line]] = {id: [] for id in deck.points}
    for line in deck.lines:
        for end in line.ends:
            if end not in at:
                raise line.row.fail(
                    f"line {line.id} ends at {end!r}, which is no point or rod of the file; points "
                    "are written 4, P4 or Point4, ends of rods R1A and R1B"
                )
            at[end].append(line)
    inner = {
        id
        for id, point in deck.points.items()
        if point.attachment == "free" and len(at[id]) == 2 and not any(point.force[:2])
    }
    chains: list[Chain] = []
    used: set[str] = set()
    for id in deck.points:
        if id in inner:
            continue
        for line in at[id]:
            if line.id not in used:
                chains.append(_follow(deck, at, inner, id, line))
                used.update(part.id for part in chains[-1].lines)
    left = [line for line in deck.lines if line.id not in used]
    if left:
        raise left[0].row.fail(f"line {left[0].id} is in a ring of lines that nothing holds")
    junctions = [
        point
        for id, point in deck.points.items()
        if point.attachment == "free" and id not in inner and at[id]
    ]
    return chains, junctions


def _follow(
    deck: Deck, at: dict[str, list[Line]], inner: set[str], start: str, line: Line
) -> Chain:
    """The chain that begins at a point with a line."""
    lines, between, end = [line], [], _other(line, start)
    while end in inner:
        between.append(deck.points[end])
        first, second = at[end]
        lines.append(second if first is lines[-1] else first)
        end = _other(lines[-1], end)
    a, b = deck.points[start], deck.points[end]
    bare = [point.is_bare and len(at[point.id]) == 1 for point in (a, b)]
    hangs = bare[0] != bare[1]
    if bare[0] if hangs else _rank(b) < _rank(a):
        return Chain((b, a), tuple(reversed(lines)), tuple(reversed(between)), hangs)
    return Chain((a, b), tuple(lines), tuple(between), hangs)


def _rank(point: Point) -> tuple[bool, float]:
    """End A is the fixed one, or else the lower one."""
    return point.attachment != "fixed", point.place[2]


def _other(line: Line, end: str) -> str:
    a, b = line.ends
    return b if a == end else a
