"""What a picture shows: lines of results, gathered into panels of one quantity and unit."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import CaseError
from hydrodae.post import displayed

if TYPE_CHECKING:
    from hydrodae.results import Results

#: A panel with more lines than this shows those that move most.
MOST_LINES = 8


@dataclass(frozen=True)
class Line:
    """(n_time,) values in `unit`, as a person reads them (degrees)."""

    label: str
    quantity: str
    unit: str
    values: NDArray[np.float64]

    @property
    def span(self) -> float:
        """Largest minus smallest value."""
        return float(np.ptp(self.values)) if len(self.values) else 0.0


@dataclass
class Panel:
    """Lines that share one set of axes."""

    quantity: str
    unit: str
    lines: list[Line] = field(default_factory=list)
    note: str = ""

    @property
    def label(self) -> str:
        """Label of the value axis, with the unit."""
        return f"{self.quantity} [{self.unit}]"


def select(results: Results, name: str) -> list[Line]:
    """Lines of a channel, of one component of it ("bodies/base/position.z"), or of a pattern.

    Raises
    ------
    ChannelError
        There is no such channel.
    CaseError
        There is no such component, or the pattern matches nothing.
    """
    if any(c in name for c in "*?["):
        matches = results.channels(name)
        if not matches:
            raise CaseError(f"{results.path}: no channel matches {name!r}")
        return [line for match in matches for line in select(results, match)]
    base, _, component = name.rpartition(".")
    if name in results or base not in results:
        base, component = name, ""
    channel = results[base]
    factor, unit = displayed(str(channel.attrs.get("unit", "-")))
    values = factor * channel.to_numpy()
    group, _, last = base.rpartition("/")
    owner = " ".join(group.split("/")[1:])  # "hinge1" of joints/hinge1/angle
    quantity = (last if owner else group or last).replace("_", " ")
    label = owner or last.replace("_", " ")
    components = [str(c) for dim in channel.dims[1:] for c in channel[dim].to_numpy()]
    if component and component not in components:
        raise CaseError(
            f"{base} has no component {component!r}; it has {', '.join(components) or 'none'}"
        )
    if not components:
        return [Line(label, quantity, unit, values)]
    return [
        Line(f"{label} {c}", quantity, unit, values[:, i])
        for i, c in enumerate(components)
        if component in ("", c)
    ]


def gather(lines: Iterable[Line]) -> list[Panel]:
    """One panel for each quantity and unit, in the order of their first line."""
    panels: dict[tuple[str, str], Panel] = {}
    for line in lines:
        key = (line.quantity, line.unit)
        panels.setdefault(key, Panel(*key)).lines.append(line)
    return list(panels.values())


def overview(results: Results) -> list[Panel]:
    """Panels of the standard picture: joint coordinates, motions of the bodies, energies."""
    if not len(results.time):
        return []
    panels = [
        Panel("joint angle", "deg", _all(results, "joints/*/angle")),
        Panel("joint displacement", "m", _all(results, "joints/*/displacement")),
        Panel("body displacement\nfrom the start", "m", _from_start(_moving(results, "position"))),
        Panel("body rotation", "deg", _moving(results, "rotation")),
        _energy(results),
    ]
    return [panel for panel in panels if panel.lines]


def most_moving(panel: Panel) -> Panel:
    """The panel with its `MOST_LINES` lines of largest span, and a note when some are left out."""
    if len(panel.lines) <= MOST_LINES:
        return panel
    spans = np.array([line.span for line in panel.lines])
    kept = np.sort(np.argsort(-spans, kind="stable")[:MOST_LINES])
    note = f"largest {MOST_LINES} of {len(spans)}"
    return Panel(panel.quantity, panel.unit, [panel.lines[i] for i in kept], note)


def _all(results: Results, pattern: str) -> list[Line]:
    return [line for name in results.channels(pattern) for line in select(results, name)]


def _moving(results: Results, quantity: str) -> list[Line]:
    """Components of a vector of all bodies that move: span above 1e-3 of the largest one."""
    lines = _all(results, f"bodies/*/{quantity}")
    least = 1e-3 * max((line.span for line in lines), default=0.0)
    return [line for line in lines if line.span > least]


def _from_start(lines: Iterable[Line]) -> list[Line]:
    return [replace(line, values=line.values - line.values[:1]) for line in lines]


def _energy(results: Results) -> Panel:
    """Energies in J, kJ, MJ or GJ; the potential, and so the total, from its least value."""
    lines = [line for line in _all(results, "energy/*") if not line.label.endswith("error")]
    if not lines:
        return Panel("energy", "J")
    zero = next((line.values.min() for line in lines if line.label == "potential"), 0.0)
    values = [
        line.values - zero if line.label in ("potential", "total") else line.values
        for line in lines
    ]
    largest = max(float(np.abs(v).max()) for v in values)
    prefixes = (("G", 1e9), ("M", 1e6), ("k", 1e3))
    prefix, factor = next(((p, f) for p, f in prefixes if largest >= f), ("", 1.0))
    unit = f"{prefix}J"
    scaled = [
        replace(line, unit=unit, values=v / factor) for line, v in zip(lines, values, strict=True)
    ]
    return Panel("energy", unit, scaled, "potential from its least")
