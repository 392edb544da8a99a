"""Mesh files: STL, OBJ, GDF of WAMIT, PNL of HAMS, Nemoh, GMSH (ASCII 2.2 and 4.1).

All are read into panels (n, 4, 3) [m], triangles with their last corner repeated.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from hydrodae.errors import DatabaseError
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file

_TRIANGLE, _QUAD = 2, 3
#: Distance from the origin that no vertex reaches [m]: fifth powers of it are finite numbers.
FARTHEST = 1e60
#: Corners that come first of GMSH's elements of higher order.
_CORNERS = {_TRIANGLE: 3, _QUAD: 4, 9: 3, 10: 4, 16: 4}


@names_file
def read_mesh(path: str | Path) -> Array:
    """Read a mesh file; its content decides the format.

    Returns
    -------
    (n, 4, 3) array
        Symmetric halves that the file leaves out (Nemoh, GDF, PNL) are added.

    Raises
    ------
    DatabaseError
        Missing or wrong; the message names file and line.
    """
    file = Path(path)
    if not file.is_file():
        raise DatabaseError("no such mesh file").about("missing")
    try:
        return _read(file)
    except (ValueError, IndexError, OverflowError, MemoryError) as error:
        if isinstance(error, DatabaseError):
            raise
        raise DatabaseError(f"the mesh is damaged: {error}").about("format") from None


def _read(file: Path) -> Array:
    raw = file.read_bytes()
    if raw[:11] == b"$MeshFormat":
        return _gmsh(raw.decode(errors="replace").splitlines())
    if len(raw) >= 84 and len(raw) == 84 + 50 * int.from_bytes(raw[80:84], "little"):
        return _stl_binary(raw)
    lines = raw.decode(errors="replace").splitlines()
    if raw[:5].lower() == b"solid":
        return _stl_text(lines)
    first = lines[0].split() if lines else []
    if len(first) == 2 and first[0] == "2" and first[1] in ("0", "1"):
        return _nemoh(lines)
    if file.suffix.lower() == ".obj":
        return _obj(lines)
    if file.suffix.lower() == ".gdf":
        return _gdf(lines)
    if file.suffix.lower() == ".pnl":
        return _pnl(lines)
    raise DatabaseError("expected a mesh of STL, OBJ, GDF, PNL, Nemoh or GMSH").about("format")


def triangles_of(panels: ArrayLike) -> Array:
    """Return the triangles (m, 3, 3) of panels (n, 4, 3), those without area left out.

    Further numbers of the corners after x, y, z are carried along.
    """
    p = np.asarray(panels, dtype=float)
    both = np.concatenate([p[:, [0, 1, 2]], p[:, [0, 2, 3]]])
    sides = both[:, 1:, :3] - both[:, :1, :3]
    across = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    return np.asarray(both[across > 1e-12 * across.max(initial=0.0)], dtype=float)


def mirrored(panels: Array, axes: str) -> Array:
    """Add the mirror images of half of a hull (or a quarter).

    Parameters
    ----------
    panels : (n, 4, 3) array
    axes : str
        "y" for the plane y = 0, "x" for x = 0, "xy" for both.

    Returns
    -------
    (m, 4, 3) array

    Raises
    ------
    DatabaseError
        Other axes, or panels on both sides of the plane: then it is no half.
    """
    if axes not in ("x", "y", "xy", "yx"):
        raise DatabaseError(f"mirror={axes}: expected x, y or xy").about("option", "mirror")
    size = float(np.abs(panels).max())
    for axis in (("x", "y").index(letter) for letter in axes):
        along = panels[..., axis]
        if min(-along.min(), along.max()) > 1e-6 * size:
            raise DatabaseError(
                f"mirror={axes}: the panels lie on both sides of {'xy'[axis]} = 0, from "
                f"{along.min():g} to {along.max():g} m: this is no half"
            ).about("mesh", "mirror")
        panels = np.concatenate([panels, _mirror_image(panels, axis)])
    return panels


def _mirror_image(panels: Array, axis: int) -> Array:
    image = panels[:, [1, 0, 3, 2]].copy()
    image[..., axis] *= -1.0
    return _triangles_last(image)


def _stl_binary(raw: bytes) -> Array:
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    triangles = np.frombuffer(raw, record, offset=84)["corners"].astype(float)
    return _quads(triangles)


def _stl_text(lines: list[str]) -> Array:
    corners = []
    for i, line in enumerate(lines, start=1):
        words = line.split()
        if words[:1] == ["vertex"]:
            corners.append(_floats(i, words[1:], 3, "vertex x y z"))
    if not corners or len(corners) % 3:
        raise DatabaseError(f"{len(corners)} corners: expected three a facet").about("shape")
    return _quads(np.array(corners).reshape(-1, 3, 3))


def _obj(lines: list[str]) -> Array:
    """`v x y z`, and faces `f a b c ...` by the number of the vertex, negative: from the last one.

    A corner may be `a/texture/normal`. More than four corners are a fan about the first one.
    """
    points: dict[int, list[float]] = {}
    panels = []
    for i, line in enumerate(lines, start=1):
        words = line.split()
        if words[:1] == ["v"]:
            points[len(points) + 1] = _floats(i, words[1:4], 3, "v x y z")
        elif words[:1] == ["f"]:
            names = [word.partition("/")[0] for word in words[1:]]
            numbers = _floats(i, names, max(len(names), 3), "f and three vertices or more")
            places = [int(n) if n > 0 else len(points) + 1 + int(n) for n in numbers]
            face = [_point(i, points, n) for n in places]
            fan = [[face[0], *face[k : k + 2]] for k in range(1, len(face) - 1)]
            panels += [face] if len(face) == 4 else fan
    return _with_mirrored(panels, [])


def _nemoh(lines: list[str]) -> Array:
    """`2 s`, then `i x y z` up to a line of zeros, then four corners a panel up to zeros."""
    points: dict[int, list[float]] = {}
    panels, in_points = [], True
    for i, line in enumerate(lines[1:], start=2):
        words = line.split()
        if not words:
            continue
        values = _floats(i, words, 4, "4 numbers")
        if in_points:
            if values[0] == 0.0:
                in_points = False
            else:
                points[int(values[0])] = values[1:]
            continue
        if values[0] == 0.0:
            break
        panels.append([_point(i, points, int(v)) for v in values])
    return _with_mirrored(panels, [1] if lines[0].split()[1] == "1" else [])


def _gdf(lines: list[str]) -> Array:
    """Title, `ULEN GRAV`, `ISX ISY`, number of panels, then 12 numbers a panel in any lines."""
    _floats(2, lines[1].split()[:2] if len(lines) > 1 else [], 2, "ULEN GRAV")
    symmetric = _floats(3, lines[2].split()[:2] if len(lines) > 2 else [], 2, "ISX ISY")
    (count,) = _floats(4, lines[3].split()[:1] if len(lines) > 3 else [], 1, "panels")
    numbers: list[float] = []
    for i, line in enumerate(lines[4:], start=5):
        words = line.replace(",", " ").split()
        numbers += _floats(i, words, len(words), "coordinates")
    if len(numbers) < 12 * count:
        raise DatabaseError(
            f"{len(numbers)} coordinates for {count:g} panels: expected 12 a panel"
        ).about("shape")
    found = np.array(numbers[: 12 * int(count)]).reshape(-1, 4, 3).tolist()
    return _with_mirrored(found, [axis for axis in (0, 1) if symmetric[axis] == 1.0])


def _pnl(lines: list[str]) -> Array:
    """Numbers of panels and nodes, ISX ISY, then `i x y z` a node, then `i n corners` a panel."""
    rows = [(i, w) for i, line in enumerate(lines, start=1) if (w := line.split("!")[0].split())]
    rows = [(i, w) for i, w in rows if w[0].lstrip("+-").replace(".", "", 1).isdigit()]
    where = rows[0][0] if rows else 1
    first = _floats(where, rows[0][1] if rows else [], 4, "panels nodes ISX ISY")
    count, nodes = int(first[0]), int(first[1])
    if len(rows) < 1 + nodes + count:
        raise DatabaseError(
            f"{len(rows) - 1} lines for {nodes} nodes and {count} panels: expected one each"
        ).about("shape")
    points = {}
    for i, words in rows[1 : 1 + nodes]:
        values = _floats(i, words, 4, "node x y z")
        points[int(values[0])] = values[1:]
    panels = []
    for i, words in rows[1 + nodes : 1 + nodes + count]:
        corners = int(_floats(i, words[:2], 2, "panel, its number of corners")[1])
        numbers = _floats(i, words[2:], corners, f"{corners} corners")
        panels.append([_point(i, points, int(n)) for n in numbers])
    return _with_mirrored(panels, [axis for axis in (0, 1) if first[2 + axis] == 1.0])


def _gmsh(lines: list[str]) -> Array:
    words = lines[1].split() if len(lines) > 1 else []
    version = words[0] if words else "?"
    if len(words) < 2 or words[1] != "0" or version not in ("2.2", "4.1"):
        raise DatabaseError(f"expected an ASCII file of GMSH 2.2 or 4.1, got {version}").about(
            "format", line=2
        )
    sections = {line.strip(): i for i, line in enumerate(lines) if line.startswith("$")}
    for name in ("$Nodes", "$Elements"):
        if name not in sections:
            raise DatabaseError(f"no section {name}").about("missing", name)
    reader = _gmsh_2 if version == "2.2" else _gmsh_4
    panels = reader(lines, sections["$Nodes"] + 1, sections["$Elements"] + 1)
    return _with_mirrored(panels, [])


def _gmsh_2(lines: list[str], nodes: int, elements: int) -> list[list[list[float]]]:
    points = {}
    for i in range(nodes + 1, nodes + 1 + int(lines[nodes])):
        values = _floats(i + 1, lines[i].split(), 4, "node x y z")
        points[int(values[0])] = values[1:]
    panels = []
    for i in range(elements + 1, elements + 1 + int(lines[elements])):
        words = [int(w) for w in lines[i].split()]
        corners = _CORNERS.get(words[1])
        if corners is not None:
            first = 3 + words[2]
            panels.append([_point(i + 1, points, n) for n in words[first : first + corners]])
    return panels


def _gmsh_4(lines: list[str], nodes: int, elements: int) -> list[list[list[float]]]:
    points = {}
    row = nodes + 1
    for _ in range(int(lines[nodes].split()[0])):
        count = int(lines[row].split()[3])
        for j in range(count):
            i = row + 1 + count + j
            points[int(lines[row + 1 + j])] = _floats(i + 1, lines[i].split()[:3], 3, "x y z")
        row += 1 + 2 * count
    panels = []
    row = elements + 1
    for _ in range(int(lines[elements].split()[0])):
        words = [int(w) for w in lines[row].split()]
        corners = _CORNERS.get(words[2])
        for i in range(row + 1, row + 1 + words[3]):
            if corners is not None:
                tags = [int(w) for w in lines[i].split()][1 : 1 + corners]
                panels.append([_point(i + 1, points, n) for n in tags])
        row += 1 + words[3]
    return panels


def _with_mirrored(panels: list[list[list[float]]], axes: list[int]) -> Array:
    """Panels as one array, and their mirror images across the planes normal to `axes`."""
    if not panels:
        raise DatabaseError("no panels in it").about("mesh", "panels")
    result = np.array([p if len(p) == 4 else [*p, p[-1]] for p in panels], dtype=float)
    result = _triangles_last(_bounded(result))
    for axis in axes:
        result = np.concatenate([result, _mirror_image(result, axis)])
    return result


def _triangles_last(panels: Array) -> Array:
    """Turn triangles, which may repeat any corner, until the pair stands last."""
    same = np.linalg.norm(panels - np.roll(panels, -1, axis=1), axis=2) < 1e-12
    for i in np.flatnonzero(same.any(axis=1)):
        panels[i] = np.roll(panels[i], -(int(same[i].argmax()) + 2), axis=0)
    return panels


def _bounded(panels: Array) -> Array:
    """Return the panels, none of which has a corner at `FARTHEST` or beyond."""
    fine = np.all(np.abs(panels) < FARTHEST, axis=2)
    if not fine.all():
        place = "({:.6g}, {:.6g}, {:.6g})".format(*panels[~fine][0])
        raise DatabaseError(
            f"a vertex at {place} is too far away; give finite numbers in metres"
        ).about("mesh", "places")
    return panels


def _quads(triangles: Array) -> Array:
    triangles = _bounded(triangles)
    return np.concatenate([triangles, triangles[:, 2:]], axis=1)


def _point(line: int, points: dict[int, list[float]], number: int) -> list[float]:
    if number not in points:
        raise DatabaseError(f"no point {number}").about("missing", f"point {number}", line=line)
    return points[number]


def _floats(line: int, words: list[str], count: int, meaning: str) -> list[float]:
    try:
        values = [float(w.upper().replace("D", "E")) for w in words]
    except ValueError:
        values = []
    if len(values) != count or not np.all(np.isfinite(values)):
        raise DatabaseError(f"expected {meaning}, got {' '.join(words)[:60]!r}").about(
            "format", line=line
        )
    return values
