"""Free bodies and rods of a MoorDyn input file as rigid bodies of a case."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydrodae.mooring.imported import Imported
from hydrodae.mooring.moordyn_chains import Chain
from hydrodae.mooring.moordyn_deck import Body, Deck, Rod, directions
from hydrodae.mooring.moordyn_places import Places
from hydrodae.mooring.moordyn_sections import Row
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class _Part:
    """Mass and volume about one centre, world axes."""

    mass: float  #: [kg]
    volume: float  #: [m3]
    centre: Array  #: [m]
    inertia: Array  #: (3, 3), about the centre [kg m2]


def add_rigid_bodies(deck: Deck, places: Places, out: Imported) -> None:
    """Add the free bodies and rods that lines end at, with the rods and points that they carry.

    Raises
    ------
    CaseError
        One reaches above the water, or has no mass or no moments of inertia.
    """
    for key in sorted(places.made):
        body = deck.bodies.get(key)
        if body is None:
            _add(deck, places, out, key, [deck.rods[key.removeprefix("rod")]])
        else:
            carried = [rod for rod in deck.rods.values() if rod.attachment == f"body{key}"]
            _add(deck, places, out, f"body{key}", carried, body)
    # a rod that is held somewhere needs no load of its own, unless nothing moves it
    held = [rod for rod in deck.rods.values() if not _is_made(rod, places)]
    if held:
        names = ", ".join(f"rod {rod.id}" for rod in held)
        out.note(
            f"{names}: without mass, buoyancy and drag, which are those of what holds it, or of a "
            "body of the case; ends of lines are where it has them",
            held[0].row.number,
        )


def _is_made(rod: Rod, places: Places) -> bool:
    return f"rod{rod.id}" in places.made or rod.attachment.removeprefix("body") in places.made


def _add(
    deck: Deck, places: Places, out: Imported, name: str, rods: list[Rod], body: Body | None = None
) -> None:
    parts: list[_Part] = []
    row = rods[0].row if body is None else body.row
    entry = name if body is None else body.id
    for rod in rods:
        a, b = (_world(places, rod, end) for end in rod.ends)
        if rod.ends[0] != rod.ends[1]:
            if (top := max(a[2], b[2])) > 0.0:
                raise rod.row.fail(
                    f"rod {rod.id} reaches up to z = {top:g} m, above the water: its buoyancy is "
                    "not carried over; take a body of the case that has hydrostatics of its own: "
                    f"--body {entry}=NAME"
                )
            parts.append(_rod_part(rod, a, b))
            out.morison.append(_rod_water(rod, name, a, b))
    if body is not None:
        parts += _body_parts(deck, places, body)
        _check_under_water(body, parts[-1])
    mass = sum(part.mass for part in parts)
    if mass <= 0.0:
        raise row.fail(
            f"{name.rstrip('0123456789')} {entry.removeprefix('rod')} is free and has no mass: "
            f"write one, or take a body of the case: --body {entry}=NAME"
        )
    table, spins = _table(name, parts)
    ends = [end for force in out.forces for end in _ends_at(force, name)]
    if not spins and any(np.abs(end - table["center_of_gravity"]).max() > 1e-9 for end in ends):
        raise row.fail(
            f"body {entry}: lines pull at it beside its centre of gravity, and it has no moments "
            f"of inertia: write I [kg m2], or take a body of the case: --body {entry}=NAME"
        )
    out.bodies.append(table)
    if body is not None and (body.drag_area or body.added_mass * body.volume):
        out.morison.append(_body_water(name, body, parts[-1].centre))
    if body is not None:
        for text in _averaged(name, body):
            out.note(text, row.number)
    if rods and body is None and rods[0].attachment.endswith("pinned"):
        out.joints.append(_pin(places, rods[0], name))
    text = f"{name} is a rigid body with {mass:g} kg, its buoyancy and its drag"
    out.note(text, row.number)


def _check_under_water(body: Body, part: _Part) -> None:
    """Refuse a volume that a sphere cannot hold beneath the surface."""
    radius = (0.75 * part.volume / math.pi) ** (1.0 / 3.0)
    if part.volume > 0.0 and part.centre[2] + radius > 0.0:
        raise body.row.fail(
            f"body {body.id} is at the surface (z = {part.centre[2]:g} m, volume {part.volume:g} "
            "m3), where its buoyancy is not known from the file; take a body of the case that has "
            f"hydrostatics of its own: --body {body.id}=NAME"
        )


def _world(places: Places, rod: Rod, end: tuple[float, float, float]) -> Array:
    """Place of an end of a rod, world axes."""
    owner = rod.attachment.removesuffix("pinned")
    if owner == "coupled":
        return places.pose("").of(end)
    return places.pose(owner.removeprefix("body")).of(end)


def _rod_part(rod: Rod, a: Array, b: Array) -> _Part:
    """A solid cylinder: m d^2/8 about its axis, m (d^2/16 + l^2/12) across."""
    length = float(np.linalg.norm(b - a))
    along = (b - a) / length
    d = rod.type.value("diameter", "the diameter")
    mass = length * rod.type.value("mass", "the mass per length")
    axial, across = mass * d**2 / 8.0, mass * (d**2 / 16.0 + length**2 / 12.0)
    inertia = across * np.eye(3) + (axial - across) * np.outer(along, along)
    return _Part(mass, 0.25 * math.pi * d**2 * length, 0.5 * (a + b), inertia)


def _rod_water(rod: Rod, name: str, a: Array, b: Array) -> dict[str, Any]:
    """Morison's loads; those of both ends, pi d^2/4 and half a sphere each, are along the axis."""
    length = float(np.linalg.norm(b - a))
    d = rod.type.value("diameter", "the diameter")
    return {
        "name": f"rod{rod.id}_water",
        "body": name,
        "point_a": a.tolist(),
        "point_b": b.tolist(),
        "diameter": d,
        "drag_coefficient": rod.type.value("Cd", "the drag across"),
        "drag_axial": rod.type.value("CdEnd", "the drag of an end", 0.0) * d / (2.0 * length),
        "added_mass_coefficient": rod.type.value("Ca", "the added mass across"),
        "added_mass_axial": rod.type.value("CaEnd", "the added mass", 0.0) * 2 * d / (3 * length),
    }


def _body_parts(deck: Deck, places: Places, body: Body) -> list[_Part]:
    """Points that the body carries, and itself as the last one."""
    pose = places.pose(body.id)
    carried = [p for p in deck.points.values() if p.attachment == f"body{body.id}"]
    parts = [
        _Part(p.mass, p.volume, pose.of(p.place), np.zeros((3, 3)))
        for p in carried
        if p.mass or p.volume
    ]
    inertia = pose.rotation @ np.diag(body.inertia) @ pose.rotation.T
    return [*parts, _Part(body.mass, body.volume, pose.of(body.centre), inertia)]


def _body_water(name: str, body: Body, centre: Array) -> dict[str, Any]:
    table: dict[str, Any] = {
        "name": f"{name}_water",
        "body": name,
        "point": centre.tolist(),
        "area": body.drag_area,
        "volume": body.volume,
        "drag_coefficient": 1.0,
    }
    if body.added_mass * body.volume:
        table["added_mass_coefficient"] = body.added_mass
    return table


def _averaged(name: str, body: Body) -> list[str]:
    """Say which loads of water lose their directions."""
    out = []
    drag, added = directions(body.row, "CdA"), directions(body.row, "Ca")
    for column, what, values in (("CdA", "drag area", drag), ("Ca", "added mass", added)):
        if len(values) > 2 and len(set(values[:3])) > 1:
            out.append(f"{name}: {column} is the mean {what} of three directions")
    # one and three numbers are those of rotations too, the second of two is theirs alone
    if any({2: drag[1:], 6: drag[3:]}.get(len(drag), drag)):
        out.append(f"{name}: CdA is without that of rotations")
    return out


def _table(name: str, parts: list[_Part]) -> tuple[dict[str, Any], bool]:
    """Keys of the body, and whether it has moments of inertia."""
    mass = sum(part.mass for part in parts)
    centre = np.sum([part.mass * part.centre for part in parts], axis=0) / mass
    tensor = np.zeros((3, 3))
    for part in parts:
        arm = part.centre - centre
        tensor += part.inertia + part.mass * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    spins = bool(np.linalg.eigvalsh(tensor)[0] > 0.0)
    table: dict[str, Any] = {
        "name": name,
        "motion": "rigid" if spins else "point",
        "mass": mass,
        "center_of_gravity": centre.tolist(),
    }
    if spins:
        table["inertia"] = np.diag(tensor).tolist()
        products = [tensor[0, 1], tensor[1, 2], tensor[2, 0]]
        if np.abs(products).max() > 1e-12 * np.abs(tensor).max():
            table["products_of_inertia"] = [float(product) for product in products]
    volume = sum(part.volume for part in parts)
    if volume > 0.0:
        table["volume"] = volume
        if spins:
            moment = np.sum([part.volume * part.centre for part in parts], axis=0)
            table["center_of_buoyancy"] = (moment / volume).tolist()
    return table, spins


def _ends_at(force: dict[str, Any], name: str) -> list[Array]:
    """Points of a line that belong to a body."""
    return [np.array(force[f"point_{k}"]) for k in "ab" if force.get(f"body_{k}") == name]


def _pin(places: Places, rod: Rod, name: str) -> dict[str, Any]:
    """End A of a pinned rod, on what holds it."""
    owner = rod.attachment.removesuffix("pinned")
    key = owner.removeprefix("body") if owner != "coupled" else ""
    return {
        "name": f"{name}_pin",
        "type": "spherical",
        "body_a": "ground" if owner == "fixed" else places.names[key],
        "body_b": name,
        "point": _world(places, rod, rod.ends[0]).tolist(),
    }


def note_clamps(chain: Chain, deck: Deck) -> list[tuple[str, Row]]:
    """Say with its row where a rod clamps a line that turns freely here.

    Raises
    ------
    CaseError
        Bending holds a large part of the line: the length (EI/w)^(1/3) over which bending bears
        the weight w per length is more than a tenth of it.
    """
    out = []
    for point, line in ((chain.ends[0], chain.lines[0]), (chain.ends[1], chain.lines[-1])):
        stiffness = float(line.type.others.get("EI", "0") or 0)
        if not point.rod or stiffness <= 0.0:
            continue
        area = 0.25 * math.pi * line.type.diameter**2
        weight = abs(line.type.mass - deck.density * area) * deck.gravity
        reach = (stiffness / weight) ** (1.0 / 3.0) if weight else math.inf
        what = f"line {line.id} is clamped by rod {point.rod} in the file, here its end turns"
        if reach > 0.1 * sum(part.length for part in chain.lines):
            raise line.row.fail(
                f"{what}, and it is stiff: bending bears its weight over {reach:.3g} m; end it at "
                "a point in place of the rod if the end may turn, or write EI = 0"
            )
        out.append((f"{what} (bending bears its weight over {reach:.3g} m)", line.row))
    return out
