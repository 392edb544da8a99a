"""From a folder of WEC-Sim to a folder of hydrodae."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.case.case import Case
from hydrodae.errors import CaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.preparation.mirroring import mirrored
from hydrodae.wecsim.actuators import Actuators, parts_of
from hydrodae.wecsim.air import add_orifice, atmosphere, has_orifice
from hydrodae.wecsim.bodies import Bodies
from hydrodae.wecsim.cables import add_cable, node_keys
from hydrodae.wecsim.conditions import STUDY, find_conditions, write_study
from hydrodae.wecsim.drift import add_drift
from hydrodae.wecsim.functions import FUNCTIONS, FunctionFile
from hydrodae.wecsim.hydro import find_source, read_database, with_radiation
from hydrodae.wecsim.links import Links
from hydrodae.wecsim.m_file import read_input
from hydrodae.wecsim.mdl import read_mdl
from hydrodae.wecsim.modes import Modes, read_modes
from hydrodae.wecsim.moorings import add_mooring
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.remarks import Remarks
from hydrodae.wecsim.sea import add_solver, add_waves, radiation_of
from hydrodae.wecsim.sea_states import POWER_MATRIX, write_power_matrix
from hydrodae.wecsim.slx import Model, read_slx
from hydrodae.wecsim.stages import POWERS
from hydrodae.wecsim.text import CaseText
from hydrodae.wecsim.topology import Topology, find_topology

INPUT = "wecSimInputFile.m"
#: Readers of models by the ending of their files.
MODELS = {".slx": read_slx, ".mdl": read_mdl}
#: Coordinates of the database that move with each motion of a body.
_KEEP = {"rigid": "all", "planar": "planar", "heave": "heave", "yaw": "yaw"}
#: What these become by hand.
_OTHERS = {"wind": "wind", "windTurbine": "a wind turbine"}
#: Parts of a device by the object that states their fields; see `Remark`.
_PARTS = {"waves": "waves", "pto": "pto", "constraint": "joint", "mooring": "mooring"}
#: Fields of these without which they are what they are, but for chance and pictures.
_CHANCE = ("phaseSeed", "bem.", "marker.", "viz.")


@dataclass
class Converted:
    """What was written.

    Attributes
    ----------
    case : Path
        The case file.
    remarks : Remarks
        What it does not hold, and what was assumed.
    functions : Path, optional
        Laws of the case in Python, which its run needs: `hydrodae run --functions`.
    """

    case: Path
    remarks: Remarks
    functions: Path | None = None


def convert(
    source: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    accept: Sequence[str] | None = (),
    define: Mapping[str, str] | None = None,
) -> Converted:
    """Write a case for a run of WEC-Sim: case.toml, hydro.h5 and what they need.

    Parameters
    ----------
    source : path
        The folder with `wecSimInputFile.m` and its Simulink model, or the input file.
    folder : path
        A new or empty folder.
    accept : sequence of str
        Parts of the device that the case may lack, as `hydrodae.wecsim.remarks.Remark` names them;
        None for whatever is missing.
    define : mapping from str, optional
        Expressions of MATLAB for variables that a script of the user sets before WEC-Sim reads the
        input file, by their names.

    Raises
    ------
    CaseError
        A file is missing or cannot be understood, the folder is not empty, or the case would lack
        a part of the device that `accept` does not name.
    DatabaseError
        The database cannot be read.
    """
    target = Path(folder)
    if target.exists() and (not target.is_dir() or any(target.iterdir())):
        raise CaseError(f"{target}: is there already; name a new or empty folder")
    read = read_input(_input_file(Path(source)), define)
    file = _model_file(read)
    model = MODELS.get(file.suffix.lower(), read_slx)(file)
    topology = find_topology(model, read)
    conditions = find_conditions(read)
    database, radiation, why, modes = _database(read, topology)
    made = not target.exists()
    target.mkdir(parents=True, exist_ok=True)
    try:
        text, functions = _write(read, model, topology, database, radiation, why, modes, target)
        if conditions is not None:

            def again(other: InputFile) -> CaseText:
                frequency = radiation_of(other)[1]
                keys = dict(radiation)
                if frequency is not None and "frequency" in keys:
                    keys["frequency"] = frequency
                found = find_topology(model, other)
                _keep_to_yaw(other, found, database)
                text, laws = _write(other, model, found, database, keys, why, modes, target)
                if str(laws) != str(functions):
                    raise CaseError(f"the laws of {FUNCTIONS} differ between them")
                return text

            write_study(conditions, read, str(text), again, target)
        else:
            write_power_matrix(str(text), target, FUNCTIONS if functions.laws else "")
        _unused(read)
        if functions.laws and (target / STUDY).is_file():
            remark = f"{STUDY}: the laws are in {FUNCTIONS}; sweep it with --functions {FUNCTIONS}"
            read.remarks.assumed(read.path.name, remark)
        if accept is not None:
            read.remarks.check(accept)
        text.head("missing", [str(remark) for remark in read.remarks.of("left out")])
        if database is not None:
            database.write(target / "hydro.h5")
        functions.write(target)
        case = target / "case.toml"
        case.write_text(str(text), encoding="utf-8")
        _check(case, read)
        return Converted(case, read.remarks, target / FUNCTIONS if functions.laws else None)
    except BaseException:
        for file in [
            *target.glob("*.stl"),
            *target.glob("shapes/*.stl"),
            *target.glob("*.csv"),
            target / "case.toml",
            target / "hydro.h5",
            target / FUNCTIONS,
            target / STUDY,
            target / POWERS,
            target / POWER_MATRIX,
        ]:
            file.unlink(missing_ok=True)
        for folder in (target / "shapes", target) if made else (target / "shapes",):
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()
        raise


def _check(case: Path, read: InputFile) -> None:
    try:
        Case.read(case)
    except CaseError as error:
        raise CaseError(f"{read.path}: its values make a case that is refused: {error}") from None


def _input_file(source: Path) -> Path:
    if source.is_dir():
        found = source / INPUT
        if not found.is_file():
            raise CaseError(f"{source}: there is no {INPUT} in this folder")
        return found
    if not source.is_file():
        raise CaseError(f"{source}: there is no such file or folder")
    return source


def _model_file(read: InputFile) -> Path:
    folder = read.path.parent
    simu = read.get("simu")
    stated = "" if simu is None else simu.text("simMechanicsFile")
    if stated.strip(".") not in ("", "slx", "*.slx"):
        path = folder / stated.replace("\\", "/")
        named = [path] if path.suffix else [path.with_suffix(ending) for ending in MODELS]
        return next((file for file in named if file.is_file()), named[0])
    found = [file for ending in MODELS for file in sorted(folder.glob(f"*{ending}"))]
    if len(found) != 1:
        names = ", ".join(path.name for path in found) or "none"
        raise CaseError(
            f"{read.path}: simu.simMechanicsFile is not set; .slx and .mdl beside it: {names}"
        )
    read.remarks.assumed(read.path.name, f"model {found[0].name}, the only one beside it")
    return found[0]


def _database(
    read: InputFile, topology: Topology
) -> tuple[HydroDatabase | None, dict[str, float | str], str, dict[str, Modes]]:
    """The database with the radiation of the case, the keys of [hydro] and modes by body."""
    wet: dict[int, str] = {}
    sources: dict[str, list[int]] = {}
    for number, name in sorted(topology.names.items()):
        item = read.get("body", number)
        stated = item.arguments[0] if item is not None and item.arguments else ""
        if item is None or item.whole("nonHydro") or not stated:
            continue
        if isinstance(stated, list):
            stated = _initial(item, stated, read)
        wet[number] = name
        sources.setdefault(str(stated), []).append(number)
    simu = read.get("simu")
    if not wet:
        if simu is not None:
            simu.used.add("b2b")  # of radiation
        return None, {}, "", {}
    if len(sources) > 1:
        raise CaseError(
            f"{read.path}: the bodies are in {len(sources)} databases ({', '.join(sources)}); "
            "a case has one, with all bodies: compute them together"
        )
    rho = 1000.0 if simu is None else simu.number_of("rho", 1000.0)
    gravity = 9.81 if simu is None else simu.number_of("gravity", 9.81)
    source = find_source(next(iter(sources)), read)
    database = read_database(source, wet, rho, gravity, read)
    modes = read_modes(source, database)
    if len(wet) > 1 and (simu is None or not simu.number_of("b2b")):
        database = database.without_coupling()
        read.remarks.assumed(
            read.path.name, "simu.b2b is 0: the bodies do not radiate into each other, as there"
        )
    _keep_to_yaw(read, topology, database)
    kind, frequency, why = radiation_of(read)
    moving = [
        f"{wet[number]}.{_KEEP[group.motion]}"
        for group in topology.groups.values()
        for number in group.bodies
        if number in wet and group.motion != "fixed"
    ]
    moving += [f"{body}.{mode}" for body, found in modes.items() for mode in found.names]
    turning = [b for b in read.of("body") if b.number_of("yaw.option")]
    if turning:
        database, mirrors = mirrored(database)
        for finding in mirrors:
            read.remarks.assumed("headings", finding.message)
    database, found = with_radiation(database, moving, kind, read)
    if found != kind:
        kind, why = found, f"{why.partition(':')[0]}: {found}, since no fit was good enough."
    keys: dict[str, float | str] = {"database": "hydro.h5"}
    for body in read.of("body"):
        body.used |= {"yaw.option", "yaw.threshold"}
    if turning:
        keys["axes"] = "yaw"
    keys["radiation"] = kind
    if frequency is not None and kind == "constant":
        keys["frequency"] = frequency
    return database, keys, why, modes


def _initial(item: Item, files: list[Any], read: InputFile) -> Any:
    """Database of a body with several that it starts with, as its variableHydro states it."""
    field = "variableHydro.hydroForceIndexInitial"
    index, place = item.whole(field, 1), read.place(item.line)
    if not 1 <= index <= len(files):
        raise CaseError(
            f"{read.path.name}:{item.line_of(field)}: {item.title}.{field} is {index}, but the "
            f"body has {len(files)} databases"
        )
    if item.whole("variableHydro.option") and len(files) > 1:
        remark = f"{item.title}: variable hydrodynamics; {files[index - 1]}, with which it starts, "
        remark += "is taken. A signal of Simulink chooses between the files in the run; where that "
        remark += "follows a pose, [[pose_table]] blends them (docs/cases.md)"
        read.remarks.left_out(place, remark)
    elif len(files) > 1:
        text = f"{item.title}: variableHydro.option is 0: {files[index - 1]} alone is taken, as "
        read.remarks.assumed(place, text + "in WEC-Sim")
    return files[index - 1]


def _write(
    read: InputFile,
    model: Model,
    topology: Topology,
    database: HydroDatabase | None,
    hydro: dict[str, float | str],
    why: str,
    modes: dict[str, Modes],
    target: Path,
) -> tuple[CaseText, FunctionFile]:
    simu = read.get("simu")
    rho = 1000.0 if simu is None else simu.number_of("rho", 1000.0)
    gravity = 9.81 if simu is None else simu.number_of("gravity", 9.81)
    if database is not None:
        rho, gravity = database.rho, database.gravity
    text = CaseText()
    text.comment(f"From {read.path.name} and {model.path.name} of WEC-Sim.")
    text.value("title", f"{model.path.stem}, from WEC-Sim")
    text.table(
        "[environment]",
        {
            "gravity": gravity,
            "water_density": None if database is not None else rho,
            "water_depth": _water_depth(read, database),
            **atmosphere(model, read),
        },
    )
    if database is not None:
        text.table("[hydro]", hydro, why)
    add_waves(text, read, target, None if database is None else database.omega)
    if database is not None:
        add_drift(text, read, database)
    bodies = Bodies(read, topology.names, database, rho, target, modes)
    carriers = _carriers(text, topology, bodies)
    bodies_by_block = parts_of(topology.names, topology.blocks)
    actuators = Actuators(read, model.path.name, bodies_by_block)
    links = Links(read, topology, bodies, carriers, actuators)
    for link in topology.links:
        links.add(text, link, model.place(link.block))
    actuators.prepare(text)
    for cable in topology.cables:
        add_cable(text, cable, topology, carriers, read)
    if links.stages is not None:
        simu = read.get("simu")
        links.stages.write(target, 100.0 if simu is None else simu.number_of("endTime", 100.0))
    for block, number in topology.flexible:
        if topology.names[number] not in modes:
            lacking = "generalised body modes, which the database lacks; the body is taken as rigid"
            read.remarks.left_out(model.place(block), lacking, "modes")
    if database is not None and has_orifice(model):
        for number, name in topology.names.items():
            if name in modes:
                add_orifice(text, read, bodies.item(number), modes[name], database, name)
    for block, group in topology.moorings:
        held = topology.groups[group].bodies
        add_mooring(text, block, model.place(block), held[0] if held else None, bodies, read)
    add_solver(text, read)
    return text, actuators.file


def _keep_to_yaw(read: InputFile, topology: Topology, database: HydroDatabase | None) -> None:
    """Let groups only yaw that turn about a vertical axis through all their centres of gravity.

    The axis is fixed. The fit of the radiation memory then needs one coordinate in place of six. A
    body with an initial displacement stays free, because a body that only yaws cannot have one.
    """
    bodies = Bodies(read, topology.names, database, 0.0, read.path.parent)
    for link in topology.links:
        if link.kind != "Rotational" or abs(link.axis("y")[2]) < 1.0 - 1e-9:
            continue
        point = link.item.vector("location", [0.0, 0.0, 0.0])
        ends = topology.groups[link.base], topology.groups[link.follower]
        for near, far in (ends, ends[::-1]):
            if (
                (near.motion, far.motion) == ("fixed", "rigid")
                and far.bodies
                and not any(bodies.start(number)[0].any() for number in far.bodies)
                and all(
                    np.hypot(*(bodies.center_of_gravity(number) - point)[:2]) < 1e-9
                    for number in far.bodies
                )
            ):
                far.motion = "yaw"


def _water_depth(read: InputFile, database: HydroDatabase | None) -> float | None:
    """Depth [m] that the input file states; None where a database has its own."""
    depth = None
    for waves in read.of("waves"):
        waves.used.add("waterDepth")
        if "waterDepth" not in waves.entries:
            continue
        stated = waves.number_of("waterDepth", math.inf)
        if database is None:
            depth = stated if math.isfinite(stated) else None
        else:
            place = read.place(waves.line_of("waterDepth"))
            text = f"{waves.title}.waterDepth (the database is for {database.water_depth:g} m)"
            read.remarks.not_needed(place, text)
    return depth


def _carriers(text: CaseText, topology: Topology, bodies: Bodies) -> dict[int, str]:
    """Write all bodies and the welds between them; returns the body that stands for each group."""
    carriers: dict[int, str] = {}
    for count, (key, group) in enumerate(topology.groups.items(), 1):
        for number in group.bodies:
            bodies.add(text, number, group.motion)
        if group.is_ground:
            carriers[key] = "ground"
        elif group.bodies:
            carriers[key] = topology.names[group.bodies[0]]
        else:
            node = node_keys(key, topology, bodies.read, bodies.rho)
            carriers[key] = f"node{count}" if node else f"frame{count}"
            frame = {"name": carriers[key], "mass": 0.0, "center_of_gravity": [0.0, 0.0, 0.0]}
            what = "The node of a cable." if node else "A frame between two joints, without mass."
            text.table("[[body]]", frame | node, what)
        for number in group.bodies[1:]:
            if group.motion != "fixed":
                name = topology.names[number]
                keys: dict[str, Any] = {
                    "name": f"weld_{name}",
                    "type": "fixed",
                    "body_a": carriers[key],
                }
                keys |= {"body_b": name, "point": bodies.center_of_gravity(number)}
                text.table("[[joint]]", keys)
    return carriers


def _unused(read: InputFile) -> None:
    """Note every entry that nothing asked for, and objects without a block."""
    for item in read.items.values():
        if item.kind in _OTHERS:
            text = f"{item.title}: {_OTHERS[item.kind]}"
            part = item.kind.removesuffix("Turbine")
            read.remarks.left_out(read.place(item.line), text, part)
            continue
        if item.kind in ("body", "constraint", "pto", "cable") and "" not in item.used:
            text = f"{item.title} has no block in the Simulink model"
            part = "cable" if item.kind == "cable" else ""
            read.remarks.left_out(read.place(item.line), text, part)
            continue
        if item.kind == "ptoSim" and "" not in item.used:
            read.remarks.left_out(
                read.place(item.line), f"{item.title}: PTO-Sim, drives no take-off of the model"
            )
            continue
        for field, entry in item.entries.items():
            if field not in item.used:
                read.remarks.left_out(read.place(entry.line), f"{item.title}.{field}")
        for field, remark in item.unread.items():
            needed = field in item.used - set(item.entries) and not field.startswith(_CHANCE)
            if needed and not remark.part:
                remark.part = _PARTS.get(item.kind, "")
