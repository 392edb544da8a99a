"""What a picture shows: lines of results, gathered into panels of one quantity and unit."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.pictures.target import target_of
from hydrodae.results.series import FEWEST, spectral_density
from hydrodae.support.arrays import Array
from hydrodae.support.units import displayed, prefixed

if TYPE_CHECKING:
    from hydrodae.results import Results

#: A panel with more lines than this shows those that move most.
MOST_LINES = 8
#: Units of which k, M or G are drawn.
_PREFIXED = ("N", "N m", "N s", "N m s", "W", "J", "Pa")


@dataclass(frozen=True)
class Line:
    """(n_time,) values in `unit`, as a person reads them (degrees)."""

    label: str
    quantity: str
    unit: str
    values: Array
    level: float | None = None  #: drawn dashed beside the line, such as its mean

    @property
    def span(self) -> float:
        """Largest minus smallest value."""
        known = self.values[np.isfinite(self.values)]
        return float(np.ptp(known)) if len(known) else 0.0


@dataclass
class Panel:
    """Lines that share one set of axes."""

    quantity: str
    unit: str
    lines: list[Line] = field(default_factory=list)
    note: str = ""
    omega: Array | None = None  #: rad/s, of spectra; else the lines are over time
    decades: bool = False  #: whether the values are drawn on a logarithmic axis
    target: tuple[Array, Array] | None = None
    """Frequencies [rad/s] and densities of the sea that the case asks for."""

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


def scaled(panel: Panel) -> Panel:
    """The panel in k, M or G of its unit, by its largest value; angles and lengths as they are."""
    if panel.unit not in _PREFIXED:
        return panel
    largest = max((float(np.abs(line.values).max()) for line in panel.lines), default=0.0)
    factor, unit = prefixed(largest, panel.unit)
    lines = [
        replace(
            line,
            unit=unit,
            values=line.values * factor,
            level=None if line.level is None else line.level * factor,
        )
        for line in panel.lines
    ]
    return Panel(panel.quantity, unit, lines, panel.note)


def overview(results: Results) -> list[Panel]:
    """Panels of the standard picture over time: what of it the file has.

    Elevation, joint coordinates, motions of the bodies, absorbed powers and their means;
    loads of the power take-offs, sizes of the reactions at joints and at bodies that cannot move;
    loads of the constraints, tensions, energies, estimated errors.
    """
    if not len(results.time):
        return []
    panels = [
        Panel("elevation", "m", _all(results, "sea/elevation")),
        Panel("joint angle", "deg", _coordinates(results, "angle")),
        Panel("joint displacement", "m", _coordinates(results, "displacement")),
        Panel("body displacement\nfrom the start", "m", _from_start(_moving(results, "position"))),
        Panel("body rotation", "deg", _moving(results, "rotation")),
        _power(results),
        *_drives(results),
        *(
            scaled(Panel(kind, unit, _sizes(results, names)))
            for kind, unit, names in (
                ("support force", "N", _of_fixed(results, "support_force")),
                ("support moment", "N m", _of_fixed(results, "support_moment")),
                ("reaction force", "N", results.channels("joints/*/reaction_force")),
                ("reaction moment", "N m", results.channels("joints/*/reaction_moment")),
            )
        ),
        *(scaled(panel) for panel in gather(_constraint_loads(results))),
        scaled(Panel("tension", "N", _tensions(results))),
        _energy(results),
        _errors(results),
    ]
    return [panel for panel in panels if panel.lines]


def spectra(results: Results) -> list[Panel]:
    """Panels of spectral densities after the ramp: elevation, with its target, and coordinates.

    None where there are no waves, or too few samples.
    """
    start = results.settled
    kept = results.time >= start
    if "sea/elevation" not in results or np.count_nonzero(kept) < FEWEST:
        return []
    panels = []
    for panel in overview(results):
        if panel.quantity in ("elevation", "joint angle", "joint displacement"):
            found = [spectral_density(results.time[kept], x.values[kept]) for x in panel.lines]
            unit = f"{panel.unit}$^2$ s/rad"
            lines = [
                Line(line.label, panel.quantity, unit, spectrum.density)
                for line, spectrum in zip(panel.lines, found, strict=True)
            ]
            made = Panel(panel.quantity + "\nspectrum", unit, lines, "", found[0].omega)
            panels.append(_beside_target(results, made) if panel.quantity == "elevation" else made)
    return panels


def _beside_target(results: Results, panel: Panel) -> Panel:
    """The spectrum of the elevation with that of the case, and the significant heights of both."""
    assert panel.omega is not None
    omega = np.linspace(0.0, 2.0 * float(panel.omega[-1]), 4001)
    target = target_of(results, omega)
    if target is None:
        return panel
    realised = panel.lines[0]
    told = 4.0 * np.sqrt(np.trapezoid(realised.values, panel.omega))
    asked = 4.0 * np.sqrt(np.trapezoid(target, omega))
    line = replace(realised, label=f"realised, $H_s$ {told:.3g} m")
    near = omega <= panel.omega[-1]
    note = f"target, $H_s$ {asked:.3g} m"
    return replace(panel, lines=[line], note=note, target=(omega[near], target[near]))


def highest_frequency(panels: Iterable[Panel]) -> float:
    """Frequency [rad/s] below which every line of these spectra has 99.5 % of its variance."""
    highest = 0.0
    for panel in panels:
        assert panel.omega is not None
        for line in panel.lines:
            part = np.cumsum(line.values)
            if part[-1] > 0:
                highest = max(highest, float(panel.omega[np.searchsorted(part, 0.995 * part[-1])]))
    return highest


def most_moving(panel: Panel) -> Panel:
    """The panel with its `MOST_LINES` lines of largest span, and a note when some are left out."""
    if len(panel.lines) <= MOST_LINES:
        return panel
    spans = np.array([line.span for line in panel.lines])
    kept = np.sort(np.argsort(-spans, kind="stable")[:MOST_LINES])
    note = f"largest {MOST_LINES} of {len(spans)}"
    note = f"{note}; {panel.note}" if panel.note else note
    return replace(panel, lines=[panel.lines[i] for i in kept], note=note)


def _all(results: Results, pattern: str) -> list[Line]:
    return [line for name in results.channels(pattern) for line in select(results, name)]


def _moving(results: Results, quantity: str) -> list[Line]:
    """Components of a vector of all bodies that move: span above 1e-3 of the largest one."""
    lines = _all(results, f"bodies/*/{quantity}")
    least = 1e-3 * max((line.span for line in lines), default=0.0)
    return [line for line in lines if line.span > least]


def _from_start(lines: Iterable[Line]) -> list[Line]:
    return [replace(line, values=line.values - line.values[:1]) for line in lines]


def _coordinates(results: Results, kind: str) -> list[Line]:
    """All joint coordinates of a kind: angle, angle_2, ... or displacement, displacement_2, ..."""
    found = []
    for name in results.channels(f"joints/*/{kind}*"):
        last = name.rpartition("/")[2]
        number = last.removeprefix(kind).removeprefix("_")
        if number.isdecimal():
            found += [
                replace(line, label=f"{line.label} {number}") for line in select(results, name)
            ]
        elif last == kind:
            found += select(results, name)
    return found


def _of_fixed(results: Results, quantity: str) -> list[str]:
    """Channels of a quantity of the bodies that cannot move."""
    names = results.channels(f"bodies/*/{quantity}")
    return [name for name in names if name.rpartition("/")[0] + "/velocity" not in results]


def _sizes(results: Results, names: Iterable[str]) -> list[Line]:
    """Magnitudes of those of these vectors that are not zero."""
    found = []
    for name in names:
        values = np.linalg.norm(results[name].to_numpy(), axis=1)
        if values.max() > 0.0:
            _, owner, quantity = name.split("/")
            unit = str(results[name].attrs.get("unit", "-"))
            found.append(Line(owner, quantity.replace("_", " "), unit, values))
    return found


def _constraint_loads(results: Results) -> list[Line]:
    """Loads of the constraints that act."""
    lines = (select(results, name)[0] for name in results.channels("constraints/*/reaction"))
    return [replace(line, quantity="constraint load") for line in lines if line.values.any()]


def _power(results: Results) -> Panel:
    """Absorbed power of each take-off, its mean as a level and in its label."""
    lines = []
    for name in results.channels("forces/*/power_absorbed"):
        line = replace(select(results, name)[0], quantity="absorbed power")
        mean = results.statistics.get(f"mean_power_absorbed.{line.label}")
        lines.append(line if mean is None else replace(line, level=float(mean)))
    panel = scaled(Panel("absorbed power", "W", lines))
    start = results.settled
    panel.note = f"level, dashed: mean after {start:g} s" if start else "dashed: mean"
    panel.lines = [
        line
        if line.level is None
        else replace(line, label=f"{line.label}, mean {line.level:.3g} {line.unit}")
        for line in panel.lines
    ]
    return panel


def _drives(results: Results) -> list[Panel]:
    """Loads of the power take-offs along their joints: forces, moments."""
    panels = []
    for kind, unit in (("force", "N"), ("moment", "N m")):
        lines = []
        for name in results.channels("forces/*/power_absorbed"):
            channel = f"{name.rpartition('/')[0]}/{kind}"
            if channel in results and results[channel].ndim == 1:
                lines += select(results, channel)
        panels.append(scaled(Panel(f"PTO {kind}", unit, lines)))
    return panels


def _tensions(results: Results) -> list[Line]:
    """Tensions of ropes and lines at their ends."""
    lines = []
    for name in results.channels("forces/*/tension*"):
        if results[name].ndim == 1 and results[name].attrs.get("unit") == "N":
            end = name.rpartition("/tension")[2].replace("_", " ")
            line = select(results, name)[0]
            lines.append(replace(line, label=line.label + end, quantity="tension"))
    return lines


#: The potential counts from its least value, and with it the total.
_FROM_LEAST = {"potential": "potential from its least", "total": "kinetic and potential"}


def _energy(results: Results) -> Panel:
    """Energies, and the work of each force by its name; the potential from its least value."""
    lines = []
    for name in results.channels("energy/*"):
        kind, _, force = name.removeprefix("energy/").partition("/")
        told = str(results[name].attrs.get("description", ""))
        if name.endswith("error") or told.startswith("Part of"):
            continue
        label = f"work of {force}" if force else kind.replace("_", " ")
        lines.append(replace(select(results, name)[0], label=label, quantity="energy"))
    zero = next((line.values.min() for line in lines if line.label == "potential"), 0.0)
    lines = [
        replace(line, values=line.values - zero, label=_FROM_LEAST[line.label])
        if line.label in _FROM_LEAST
        else line
        for line in lines
    ]
    return scaled(Panel("energy", "J", lines))


def _errors(results: Results) -> Panel:
    """Estimated error of each body and line as a part of its motion, where the run has one."""
    lines = []
    for name, error in results.accuracy().items():
        values = np.full(len(results.time), np.nan)
        known = np.where(error.relative > 0.0, error.relative, np.nan)
        values[: len(known)] = known[: len(values)]
        if np.isfinite(values).any():
            lines.append(Line(name, "estimated error,\npart of the motion", "-", values))
    return Panel("estimated error,\npart of the motion", "-", lines, decades=True)
