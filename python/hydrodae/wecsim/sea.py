"""Waves and simulation of an input file as tables of a case."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.records import Table, read_components, read_elevation, read_table
from hydrodae.support.arrays import Array
from hydrodae.wecsim.gauges import add_gauges
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.old_names import WAVES
from hydrodae.wecsim.text import CaseText

#: Fields of simu that only steer Simulink, its files and its pictures.
IDLE = (
    "simMechanicsFile mode explorer dt solver cicDt nonlinearDt morisonDt domainSize "
    "paraview.option paraview.dt paraview.path paraview.startTime paraview.endTime saveText "
    "saveStructure saveWorkspace saveMat outputDir rateTransition zeroCross reloadH5Data keepPool "
    "autoRateTranBlk pressureDis pressure cicEndTime stateSpace FIR"
).split()


def radiation_of(read: InputFile) -> tuple[str, float | None, str]:
    """Kind of radiation that a run has in WEC-Sim: kind here, frequency [rad/s], and why."""
    waves = read.of("waves")
    kind = _kind(waves[0]) if waves else "noWaveCIC"
    if kind in ("regular", "noWave"):
        period = waves[0].number_of("period")
        if period > 0.0:
            text = (
                f"{kind}: added mass and damping at the frequency of the wave, as in WEC-Sim. "
                'With radiation = "exponential" and `hydrodae hdb fit` transients are right too.'
            )
            return "constant", 2.0 * math.pi / period, text
    return "exponential", None, f"{kind}: a fitted memory stands for the convolution of WEC-Sim."


def _kind(waves: Item) -> str:
    kind = str(waves.arguments[0]) if waves.arguments else "noWaveCIC"
    return WAVES.get(kind, kind)


def add_waves(text: CaseText, read: InputFile, folder: Path, omega: Array | None) -> None:
    """Add [sea] and every [[wave]].

    Parameters
    ----------
    text : CaseText
    read : InputFile
    folder : Path
        Where data of imported elevations go.
    omega : array or None
        Frequencies of the database [rad/s].
    """
    all_waves = read.of("waves")
    if not all_waves:
        read.remarks.left_out(
            read.path.name, "there is no waves = waveClass(...): still water", "waves"
        )
    simu = read.get("simu")
    ramp = 100.0 if simu is None else simu.number_of("rampTime", 100.0)
    tables: list[tuple[dict[str, Any], str]] = []
    for waves in all_waves:
        tables += _tables(waves, read, folder, omega)
    for keys, _ in tables:
        _allow_loss(keys, omega, read)
    current = _current(all_waves, read)
    if tables or current:
        text.table(
            "[sea]",
            {"ramp": max(ramp, 0.0), "current": current},
            "The ramp of WEC-Sim is half a cosine; here it has three continuous derivatives.",
        )
    for keys, comment in tables:
        text.table("[[wave]]", keys, *([comment] if comment else []))
    add_gauges(text, read, len(tables))


def _tables(
    waves: Item, read: InputFile, folder: Path, omega: Array | None
) -> list[tuple[dict[str, Any], str]]:
    kind = _kind(waves)
    place = read.place(waves.line)
    name = "waves" if waves.number == 1 else f"waves{waves.number}"
    for field in ("marker.location", "marker.size", "marker.style", "marker.graphicColor"):
        waves.used.add(field)
    for field in ("viz.numPointsX", "viz.numPointsY"):
        waves.used.add(field)
    if kind in ("noWave", "noWaveCIC"):
        for field in ("period", "height", "direction", "spectrumType"):
            waves.used.add(field)
        return []
    first = {"name": name}
    if kind in ("regular", "regularCIC"):
        waves.used.add("spread")  # of the energy of a sea
        heading = waves.vector("direction", [0.0])
        _only_one(waves, "direction", heading, read)
        height, period = waves.number_of("height"), waves.number_of("period")
        if not period > 0.0:
            text = "regular waves without a height and a period that is read"
            read.remarks.left_out(place, text, "waves")
            return []
        keys = first | {
            "type": "regular",
            "height": height,
            "period": period,
            "heading_deg": _turned(float(heading[0])),
        }
        _only_one(waves, "height", waves.vector("height", [0.0]), read)
        _only_one(waves, "period", waves.vector("period", [0.0]), read)
        return [(keys, "")]
    if kind == "elevationImport":
        return _elevation(waves, read, folder, first)
    if kind in ("irregular", "spectrumImport"):
        if kind == "irregular":
            spectrum = _formula(waves, read)
        else:
            table = _data(waves, "spectrumFile", read)
            if table is None:
                return []
            if table.values.shape[1] == 3:
                return _with_phases(waves, read, table, first["name"], omega)
            spectrum = _imported(table)
        return [] if spectrum is None else _directions(waves, read, first, spectrum)
    read.remarks.left_out(place, f"waves of type {kind!r}", "waves")
    return []


def _allow_loss(keys: dict[str, Any], omega: Array | None, read: InputFile) -> None:
    """Let a spectrum lose what the frequencies of the database do not hold, as WEC-Sim does."""
    if omega is None or "peak_period" not in keys:
        return
    ends = np.array([omega[0], omega[-1]]) * keys["peak_period"] / (2.0 * math.pi)
    held = np.exp(-1.25 * ends**-4.0)  # of Pierson and Moskowitz
    lost = 1.0 - float(held[1] - held[0])
    if lost > 0.09:
        keys["lost_variance"] = 1.0
        read.remarks.assumed(
            read.path.name,
            f"some {100 * lost:.0f} % of the energy of {keys['name']} is outside the frequencies "
            "of the database and left out, as in WEC-Sim",
        )


def _only_one(item: Item, field: str, values: Array, read: InputFile) -> None:
    if values.size > 1:
        read.remarks.left_out(
            read.place(item.line_of(field)),
            f"{item.title}.{field} has {values.size} values; the first is taken, and "
            "`hydrodae sweep` runs them all",
        )


def _formula(waves: Item, read: InputFile) -> dict[str, Any] | None:
    spectrum = waves.text("spectrumType", "PM")
    height, period = waves.number_of("height"), waves.number_of("period")
    for field in ("height", "period"):
        _only_one(waves, field, waves.vector(field, [0.0]), read)
    keys: dict[str, Any] = {"significant_height": height, "peak_period": period}
    if not (height > 0.0 and period > 0.0):
        waves.used |= {"gamma", "direction", "spread", "phaseSeed", "bem.option", "bem.count"}
        if {"height", "period"} <= set(waves.entries):
            text = f"waves of {height:g} m and {period:g} s: still water"
            read.remarks.assumed(read.place(waves.line), text)
        else:
            text = "waves whose height or period was not read: still water"
            read.remarks.left_out(read.place(waves.line), text, "waves")
        return None
    if spectrum in ("PM", "BS"):
        return {"type": "bretschneider"} | keys
    if spectrum == "JS":
        gamma = waves.number_of("gamma", math.nan)
        if not math.isfinite(gamma):  # IEC TS 62600-2, as WEC-Sim has it
            ratio = period / math.sqrt(height) if height > 0.0 else 5.0
            gamma = min(max(math.exp(5.75 - 1.15 * ratio), 1.0), 5.0)
        return {"type": "jonswap"} | keys | {"gamma": gamma}
    place = read.place(waves.line_of("spectrumType"))
    read.remarks.left_out(place, f"spectrum {spectrum!r}: PM, JS and BS are read", "waves")
    return None


def _with_phases(
    waves: Item, read: InputFile, table: Table, name: str, omega: Array | None
) -> list[tuple[dict[str, Any], str]]:
    """A regular wave for each frequency [Hz] of a spectrum [m2/Hz] with phases [rad].

    Of sqrt(2 S dw) cos(w t + phase), between the frequencies of the database; in each direction
    sqrt(share) of it.
    """
    for field in ("phaseSeed", "bem.option", "bem.count"):
        waves.used.add(field)
    place = read.place(waves.line_of("spectrumFile"))
    rate = 2.0 * math.pi * table.values[:, 0]
    ends = waves.vector("bem.range", [] if omega is None else [omega[0], omega[-1]])
    held = rate > 0.0
    if ends.size == 2:
        held &= (rate >= ends[0]) & (rate <= ends[1])
    units = ("frequency [Hz]", "density [m2/Hz]", "phase [rad]")
    try:
        found = read_components(Table(table.path, units, table.values[held]))
    except CaseError as error:
        read.remarks.left_out(place, str(error), "waves")
        return []
    lost = int(np.sum(~held & (rate > 0.0) & (table.values[:, 1] > 0.0)))
    if lost:
        text = f"{lost} frequencies are outside {ends[0]:.4g} to {ends[1]:.4g} rad/s, as in WEC-Sim"
        read.remarks.assumed(place, text)
    headings = waves.vector("direction", [0.0])
    shares = waves.vector("spread", [1.0])
    if shares.size != headings.size:
        shares = np.full(headings.size, 1.0 / headings.size)
        read.remarks.assumed(place, "as many spreads as directions: equal shares")
    tables: list[tuple[dict[str, Any], str]] = []
    for heading, share in zip(headings, shares, strict=True):
        for wave in found:
            keys = wave.wave(f"{name}_{len(tables) + 1}")
            keys |= {"height": keys["height"] * math.sqrt(share), "heading_deg": _turned(heading)}
            tables.append((keys, ""))
    return tables


def _imported(table: Table) -> dict[str, Any]:
    rows = table.values
    kept = (rows[:, 0] > 0.0) & np.isfinite(rows[:, 1])
    return {
        "type": "table",
        "frequency": rows[kept, 0] * 2.0 * math.pi,
        "density": np.maximum(rows[kept, 1], 0.0) / (2.0 * math.pi),
    }


def _directions(
    waves: Item, read: InputFile, first: dict[str, Any], spectrum: dict[str, Any]
) -> list[tuple[dict[str, Any], str]]:
    """One wave system for each direction, with its share of the energy."""
    headings = waves.vector("direction", [0.0])
    shares = waves.vector("spread", [1.0])
    if shares.size != headings.size:
        shares = np.full(headings.size, 1.0 / headings.size)
        read.remarks.assumed(
            read.place(waves.line_of("direction")), "as many spreads as directions: equal shares"
        )
    stated = waves.number_of("phaseSeed")
    seed = round(stated) or 1
    if not stated.is_integer():
        place = read.place(waves.line_of("phaseSeed"))
        read.remarks.assumed(
            place, f"{waves.title}.phaseSeed = {stated:g}: {seed}, as seeds are whole"
        )
    option = waves.text("bem.option", "EqualEnergy")
    extra: dict[str, Any] = {"seed": seed}
    count = waves.whole("bem.count")
    if count > 1:
        extra["components"] = count
    elif option != "EqualEnergy":
        extra["components"] = 1000
    if option != "EqualEnergy":
        extra["spacing"] = "frequency"
    limits = waves.vector("bem.range", [])
    if limits.size == 2:
        extra["frequency_range"] = limits
    read.remarks.assumed(
        read.place(waves.line), f"random phases by seed {seed} of hydrodae, not those of MATLAB"
    )
    tables = []
    for index, (heading, share) in enumerate(zip(headings, shares, strict=True)):
        keys = first | spectrum | {"heading_deg": _turned(heading)} | extra
        if headings.size > 1:
            keys["name"] = f"{first['name']}_{index + 1}"
            keys["seed"] = seed + index
            if "density" in keys:
                keys["density"] = keys["density"] * share
            else:
                keys["significant_height"] = keys["significant_height"] * math.sqrt(share)
        note = "" if headings.size == 1 else f"{100 * share:g} % of the energy."
        if spectrum["type"] == "bretschneider":
            note = f"{note} PM of WEC-Sim has a peak period of its own: JONSWAP with gamma 1."
        tables.append((keys, note.strip()))
    return tables


def _turned(heading: float) -> float:
    return float((heading + 180.0) % 360.0 - 180.0)


def _elevation(
    waves: Item, read: InputFile, folder: Path, first: dict[str, Any]
) -> list[tuple[dict[str, Any], str]]:
    table = _data(waves, "elevationFile", read)
    if table is None:
        return []
    place = read.place(waves.line_of("elevationFile"))
    try:
        record = read_elevation(table, time=table.names[0], column=table.names[1])
    except CaseError as error:
        read.remarks.left_out(place, str(error), "waves")
        return []
    for note in record.notes:
        read.remarks.assumed(place, note)
    file = f"{first['name']}.csv"
    record.write(folder / file)
    keys = first | {
        "type": "measured",
        "file": file,
        "heading_deg": _turned(float(waves.vector("direction", [0.0])[0])),
        "taper": min(30.0, 0.1 * record.length),
        "lost_variance": 0.5,
    }
    note = "The record fades at both ends over `taper`: give a longer record, or a shorter run."
    return [(keys, note)]


def _data(waves: Item, field: str, read: InputFile) -> Table | None:
    """Columns of a file of numbers: MATLAB's .mat, or text."""
    name = waves.text(field)
    place = read.place(waves.line_of(field))
    path = read.path.parent / name.replace("\\", "/")
    try:
        table = read_table(path)
        if len(table.names) < 2 or len(table.values) < 4:
            raise CaseError("expected two columns and four rows, or more")
    except (OSError, CaseError) as error:
        text = f"{waves.title}.{field}: {name!r} cannot be read ({error})"
        read.remarks.left_out(place, text, "waves")
        return None
    return table


def _current(all_waves: list[Item], read: InputFile) -> Array | None:
    for waves in all_waves:
        option = waves.whole("current.option", 3)
        speed = waves.number_of("current.speed")
        heading = math.radians(waves.number_of("current.direction"))
        if option == 0 and speed:
            return np.array([speed * math.cos(heading), speed * math.sin(heading), 0.0])
        waves.used.add("current.depth")
        if option in (1, 2) and speed:
            place = read.place(waves.line_of("current.option"))
            read.remarks.left_out(place, "current that varies with the depth", "current")
    return None


def add_solver(text: CaseText, read: InputFile) -> None:
    """Add [solver] and [output]."""
    simu = read.get("simu") or Item("simu", 1)
    end = simu.number_of("endTime", 400.0)
    start = simu.number_of("startTime", 0.0)
    if start:
        read.remarks.assumed(read.place(simu.line_of("startTime")), f"starts at 0, not {start:g} s")
    method = simu.text("solver", "ode4")
    step = simu.number_of("dt", 0.1)
    text.table(
        "[solver]",
        {"end_time": end},
        f"{method} with dt = {step:g} s in WEC-Sim; here the steps are chosen by their error.",
    )
    text.table("[output]", {"step": simu.number_of("dtOut", step)})
    for field in IDLE:
        if field in simu.entries:
            simu.used.add(field)
            read.remarks.not_needed(read.place(simu.line_of(field)), f"simu.{field}")
