"""Bodies: their motion, and the surface that stands for each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hydrodae.case.bodies import bodies_and_attachments, shape_file
from hydrodae.hdb.database.coordinates import check_body
from hydrodae.hdb.database.files import read as read_database
from hydrodae.hdb.database.tables import Body as HydroBody
from hydrodae.hdb.hull.freeboard import freeboard
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.hull.meshes import read_mesh, triangles_of
from hydrodae.hdb.labels import modes_of
from hydrodae.support.arrays import Array
from hydrodae.viewer import shapes
from hydrodae.viewer.bending import bend
from hydrodae.viewer.source import Source
from hydrodae.viewer.stage import Body

NOTHING: Array = np.empty((0, 3, 3))
#: Diameter of drawn rods over the length of the longest one.
SLENDER = 0.04
#: Surfaces that cut meshes, in words.
CUTS = {"waves": "the waves as they come", "still": "z = 0"}


def make_bodies(
    source: Source,
    tables: Mapping[str, Any],
    wanted: Mapping[str, str],
    height: float | None = None,
) -> list[Body]:
    """Bodies of a case with their motion.

    Parameters
    ----------
    source : Source
    tables : mapping
        The case file.
    wanted : mapping
        Shapes that the user asks for, by body; see `hydrodae.viewer.shapes.shape_of`.
    height : float, optional
        Of what is drawn above a wetted surface [m].

    Raises
    ------
    HydrodaeError
        A shape that is asked for is wrong, or the database cannot be read.
    """
    entries = bodies_and_attachments(tables)
    for name in wanted:
        check_body(name, [entry["name"] for entry in entries])
    path = source.case.scene.database_path
    database = read_database(path) if path else {"bodies": {}, "coordinates": ()}
    wet = database["bodies"]
    ends = attachments(tables)
    size = _extent([*(e for at in ends.values() for e in at), *map(_center, entries)])
    made = []
    for entry in entries:
        name, center = entry["name"], _center(entry)
        cut, drawn = "", shape_file(source.case.directory, name)
        hydro = None  # body of the database whose surface is drawn
        if "mesh" in entry and name not in wanted:
            place = np.asarray(entry.get("mesh_origin", np.zeros(3)), dtype=float)
            hull = triangles_of(read_mesh(source.case.directory / entry["mesh"]) + place)
            above, cut = NOTHING, _cut(entry, tables)
            origin = f"its mesh, {len(hull)} triangles; dark: beneath {CUTS[cut]}"
        elif drawn.is_file() and name not in wanted:
            hull, above = triangles_of(read_mesh(drawn)), NOTHING
            origin = f"shapes/{drawn.name} beside the case, {len(hull)} triangles"
        else:
            hydro = None if name in wanted else wet.get(entry.get("hydro", ""))
            hull, above, origin = _surface(entry, wanted.get(name), hydro, ends[name], tables, size)
        if height is not None and len(above):
            above = freeboard(wet[entry["hydro"]].mesh, height) + _shift(entry, wet)
        position = source.values(f"bodies/{name}/position")
        orientation = source.values(f"bodies/{name}/orientation")
        moves = entry.get("motion") != "fixed"
        body = Body(name, center, position, orientation, hull, above, origin, moves, cut)
        known = modes_of(entry.get("hydro", ""), database["coordinates"])
        modes = [mode for mode in tables.get("mode", []) if mode["body"] == name]
        made.append(bend(body, hydro, known, modes, source))
    return made


def attachments(tables: Mapping[str, Any]) -> dict[str, list[Array]]:
    """Points of each body, in the reference pose, at which something is attached to it."""
    found: dict[str, list[Array]] = {entry["name"]: [] for entry in bodies_and_attachments(tables)}

    def add(body: Any, point: Any) -> None:
        if body in found and point is not None:
            at = np.asarray(point, dtype=float)
            if not any(np.allclose(at, known) for known in found[body]):
                found[body].append(at)

    for joint in tables.get("joint", []):
        add(joint["body_a"], joint.get("point"))
        add(joint["body_b"], joint.get("point_b", joint.get("point")))
    for force in tables.get("force", []):
        add(force.get("body_a"), force.get("point_a"))
        add(force.get("body_b"), force.get("point_b"))
        if force["type"] == "rope":
            for body, point in zip(bodies_of_rope(force), force["points"], strict=True):
                add(body, point)
    for marker in tables.get("marker", []):
        add(marker["body"], marker["point"])
    return found


def bodies_of_rope(force: Mapping[str, Any]) -> list[str]:
    """Return the body of each point of a rope."""
    bodies = force["bodies"]
    return [bodies] * len(force["points"]) if isinstance(bodies, str) else list(bodies)


def _cut(entry: Mapping[str, Any], tables: Mapping[str, Any]) -> str:
    """Surface at which the kernel cuts the mesh of a body."""
    waves = entry.get("froude_krylov") == "mesh" and tables.get("wave")
    return "waves" if waves and tables.get("sea", {}).get("stretching") != "none" else "still"


def _surface(
    entry: Mapping[str, Any],
    wanted: str | None,
    wet: HydroBody | None,
    ends: Sequence[Array],
    tables: Mapping[str, Any],
    size: float,
) -> tuple[Array, Array, str]:
    """Surface, what is drawn above water, and where both are from."""
    center = _center(entry)
    if wanted is not None:
        hull = shapes.shape_of(entry["name"], wanted, center, ends)
        return hull, NOTHING, f"drawn as asked: {wanted}"
    if wet is not None and wet.mesh is not None:
        shift = _shift(entry, {wet.name: wet})
        hull, above = triangles_of(wet.mesh) + shift, freeboard(wet.mesh) + shift
        text = f"wetted surface of the database, {len(wet.mesh)} panels"
        return hull, above, text + (", extended above the water" if len(above) else "")
    if wet is not None and wet.hydrostatics is not None:
        hull = _from_hydrostatics(wet.hydrostatics) + _shift(entry, {wet.name: wet})
        return hull, NOTHING, "a cylinder of its displaced volume and waterplane: no mesh is known"
    members = _members(entry["name"], tables)
    if members:
        return np.concatenate(members), NOTHING, "its Morison members"
    sides = _box_of_inertia(entry)
    if len(ends) > 1 and not (sides is not None and _inside(ends, center, sides, entry)):
        longest = max(float(np.linalg.norm(a - b)) for a in ends for b in ends)
        return shapes.rods(center, ends, SLENDER * longest), NOTHING, "rods to what it holds"
    if sides is not None:
        hull = shapes.box(length=sides[0], width=sides[1], height=sides[2]) @ _axes(entry).T
        return hull + center, NOTHING, "the solid box that has its inertia"
    if ends and np.linalg.norm(ends[0] - center) > 1e-9 * size:
        length = float(np.linalg.norm(ends[0] - center))
        return shapes.rods(center, [ends[0]], SLENDER * length * 2.0), NOTHING, "a rod and a ball"
    return shapes.sphere(radius=0.03 * size) + center, NOTHING, "a ball at its centre of gravity"


def _from_hydrostatics(hs: Hydrostatics) -> Array:
    """Upright cylinder of this waterplane and volume; submerged: a sphere about the buoyancy."""
    volume, area = hs.displaced_volume, hs.waterplane_area
    middle = np.asarray(hs.center_of_buoyancy, dtype=float)
    if area < 1e-3 * volume ** (2.0 / 3.0):
        return np.asarray(shapes.sphere(radius=(0.75 * volume / np.pi) ** (1.0 / 3.0)) + middle)
    radius, draught = float(np.sqrt(area / np.pi)), volume / area
    length = draught * 1.15  # with a freeboard
    hull = shapes.cylinder(radius=radius, length=length)
    return np.asarray(hull + np.array([middle[0], middle[1], 0.5 * length - draught]))


def _members(body: str, tables: Mapping[str, Any]) -> list[Array]:
    """Rods and balls of the Morison elements of a body."""
    found = []
    for element in tables.get("morison", []):
        if element["body"] != body or "diameter" not in element:
            continue
        diameter = float(element["diameter"])
        if "point_a" in element:
            found.append(shapes.rod(element["point_a"], element["point_b"], diameter))
        else:
            found.append(shapes.sphere(radius=0.5 * diameter) + np.asarray(element["point"]))
    return found


def _box_of_inertia(entry: Mapping[str, Any]) -> Array | None:
    """Sides of the solid box of this mass and principal inertia; None if no box has them.

    I_x = m (b^2 + c^2) / 12, so a^2 = 6 (I_y + I_z - I_x) / m, and so on.
    """
    given, mass = entry.get("inertia", np.zeros(3)), entry["mass"]
    if "products_of_inertia" in entry:
        return None
    if "radii_of_gyration" in entry:
        gyration = np.square(np.asarray(entry["radii_of_gyration"], dtype=float))
    elif isinstance(given, str) or isinstance(mass, str) or mass <= 0.0:
        return None
    else:
        gyration = np.asarray(given, dtype=float) / mass
    squares = 6.0 * (gyration.sum() - 2.0 * gyration)
    if squares.min() < -1e-6 * squares.max() or squares.max() <= 0.0:
        return None
    longest = float(np.sqrt(squares.max()))
    return np.asarray(np.maximum(np.sqrt(np.maximum(squares, 0.0)), 0.02 * longest))


def _inside(ends: Sequence[Array], center: Array, sides: Array, entry: Mapping[str, Any]) -> bool:
    """Whether a box about the centre of gravity reaches all ends: then it says more than rods."""
    if entry.get("motion", "rigid") != "rigid":
        return False  # moments of inertia across the plane may be dummies
    arms = (np.array(ends) - center) @ _axes(entry)
    return bool(np.all(np.abs(arms) <= 0.55 * sides + 1e-9 * sides.max()))


def _axes(entry: Mapping[str, Any]) -> Array:
    """Rotation (3, 3) to the principal axes of inertia (Rodrigues)."""
    turn = np.radians(np.asarray(entry.get("principal_axes_deg", np.zeros(3)), dtype=float))
    angle = float(np.linalg.norm(turn))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = turn / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * cross @ cross)


def _shift(entry: Mapping[str, Any], wet: Mapping[str, HydroBody]) -> Array:
    """From the place of a body in the database to that of the scene."""
    body = wet[next(iter(wet))] if len(wet) == 1 else wet[entry["hydro"]]
    if body.reference_point is None:
        return np.zeros(3)
    return np.asarray(_center(entry) - body.reference_point, dtype=float)


def _center(entry: Mapping[str, Any]) -> Array:
    return np.asarray(entry["center_of_gravity"], dtype=float)


def _extent(points: Sequence[Array]) -> float:
    spread = float(np.linalg.norm(np.ptp(np.array(points), axis=0))) if len(points) else 0.0
    return spread if spread > 0.0 else 1.0
