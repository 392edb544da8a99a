"""A stage as files for ParaView: VTKHDF, polygons and lines over time.

The connections between points are stored once, the points for every sample (VTKHDF 2, PolyData).
ParaView 5.12 and later read it, as does VTK's vtkHDFReader.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path

import h5py
import numpy as np
from numpy.typing import NDArray

from hydrodae.support.arrays import Array
from hydrodae.support.outputs import claim_folder
from hydrodae.viewer.framing import Frame
from hydrodae.viewer.stage import Sea, Stage

Index = NDArray[np.int64]
#: Kinds of cells of PolyData, in the order of the format.
KINDS = ("Vertices", "Lines", "Polygons", "Strips")
#: Points along each side of the sea.
POINTS = 101


def write_paraview(stage: Stage, frame: Frame, folder: Path) -> list[Path]:
    """Write ``bodies.vtkhdf``, ``lines.vtkhdf`` and ``sea.vtkhdf``, each if there is something.

    Parameters
    ----------
    stage : Stage
    frame : Frame
        How far the sea reaches.
    folder : Path
        Made if it is not there.

    Returns
    -------
    list of Path
        What was written; `README.txt` lists the numbers of the bodies and lines.
    """
    claim_folder(folder)
    written = []
    if any(len(body.surface) for body in stage.bodies):
        written.append(_bodies(stage, folder / "bodies.vtkhdf"))
    if stage.lines:
        written.append(_lines(stage, folder / "lines.vtkhdf"))
    if stage.sea is not None:
        written.append(_sea(stage.sea, stage.time, frame, folder / "sea.vtkhdf"))
    return [*written, _readme(stage, folder / "README.txt")]


def _bodies(stage: Stage, path: Path) -> Path:
    """Triangles; the cell data `body` is the number of the body.

    The point data `above_water` [m] is the height over the surface that cuts a mesh: the wetted
    part of which the load is taken is where it is below zero. NaN for all other bodies.
    """
    parts = [np.concatenate([body.surface, body.above]) for body in stage.bodies]
    count = sum(map(len, parts))
    cells = np.arange(3 * count).reshape(count, 3)
    numbers = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    places = [body.bent().astype(np.float32) for body in stage.bodies]
    points = (np.concatenate([p[i] for p in places]) for i in range(len(stage.time)))
    heights = None
    if stage.sea is not None and any(body.cut for body in stage.bodies):
        heights = {"above_water": _heights(stage, stage.sea, parts)}
    return write(path, stage.time, points, "Polygons", list(cells), {"body": numbers}, heights)


def _heights(stage: Stage, sea: Sea, parts: list[Array]) -> Array:
    """Heights (n, k) of the corners of all bodies above the surfaces that cut them."""
    found = []
    for body, part in zip(stage.bodies, parts, strict=True):
        heights = np.full((len(stage.time), 3 * len(part)), np.nan)
        if body.cut:
            corners, index = np.unique(part.reshape(-1, 3), axis=0, return_inverse=True)
            for i, places in enumerate(body.places(corners)):
                heights[i] = sea.above(body.cut, float(stage.time[i]), places)[index.ravel()]
        found.append(heights)
    return np.concatenate(found, axis=1)


def _lines(stage: Stage, path: Path) -> Path:
    """One polyline a line; the point data `load` [N] is that of the piece that ends there."""
    cells, first = [], 0
    for line in stage.lines:
        cells.append(np.arange(first, first + line.points.shape[1]))
        first += line.points.shape[1]
    points = (np.concatenate([x.points[i] for x in stage.lines]) for i in range(len(stage.time)))
    loads = np.full((len(stage.time), first), np.nan)
    for line, at in zip(stage.lines, cells, strict=True):
        if line.load is not None:
            pieces = np.broadcast_to(line.load, (len(stage.time), len(at) - 1))
            loads[:, at] = np.concatenate([pieces[:, :1], pieces], axis=1)
    numbers = np.arange(len(cells))
    return write(path, stage.time, points, "Lines", cells, {"line": numbers}, {"load": loads})


def _sea(sea: Sea, time: Array, frame: Frame, path: Path) -> Path:
    """The free surface as squares, with the point data `elevation` [m]."""
    side = np.linspace(-frame.water, frame.water, POINTS)
    x, y = np.meshgrid(frame.center[0] + side, frame.center[1] + side)
    number = np.arange(POINTS**2).reshape(POINTS, POINTS)
    corners = [number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]]
    cells = list(np.stack(corners, axis=-1).reshape(-1, 4))
    heights = sea.elevations(time, x, y)
    points = (np.column_stack([x.ravel(), y.ravel(), z]) for z in heights)
    return write(path, time, points, "Polygons", cells, {}, {"elevation": heights})


def write(
    path: Path,
    time: Array,
    points: Iterator[Array],
    kind: str,
    cells: list[Index],
    cell_data: Mapping[str, Index],
    point_data: Mapping[str, Array] | None = None,
) -> Path:
    """Write one file of PolyData over time.

    Parameters
    ----------
    path : Path
    time : (n,) array
        Samples [s].
    points : iterator of (k, 3) arrays
        Places at each sample [m].
    kind : str
        Of the cells: "Lines" or "Polygons".
    cells : list of int arrays
        Points of each cell.
    cell_data : mapping of (cells,) int arrays
        Constant over time.
    point_data : mapping of (n, k) arrays
        Over time.
    """
    steps = len(time)
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([2, 0], dtype=np.int64)
        root.attrs.create("Type", b"PolyData", dtype=h5py.string_dtype("ascii", 8))
        for name in KINDS:
            _cells(root.create_group(name), cells if name == kind else [])
        count = _points(root, points)
        root["NumberOfPoints"] = np.array([count], dtype=np.int64)
        group = root.create_group("Steps")
        group.attrs["NSteps"] = steps
        group["Values"] = np.asarray(time, dtype=float)
        none = np.zeros(steps, dtype=np.int64)
        group["PartOffsets"] = none
        group["NumberOfParts"] = none + 1
        group["PointOffsets"] = count * np.arange(steps)
        for name in ("CellOffsets", "ConnectivityIdOffsets"):
            group[name] = np.zeros((steps, len(KINDS)), dtype=np.int64)
        for name, numbers in cell_data.items():
            root[f"CellData/{name}"] = numbers
            group[f"CellDataOffsets/{name}"] = none
        for name, values in (point_data or {}).items():
            data = np.asarray(values, dtype=np.float32).ravel()
            root.create_dataset(f"PointData/{name}", data=data, compression="gzip")
            group[f"PointDataOffsets/{name}"] = count * np.arange(steps)
    return path


def _cells(group: h5py.Group, cells: list[Index]) -> None:
    connectivity = np.concatenate(cells) if cells else np.empty(0, dtype=np.int64)
    group["NumberOfConnectivityIds"] = np.array([len(connectivity)], dtype=np.int64)
    group["NumberOfCells"] = np.array([len(cells)], dtype=np.int64)
    group["Connectivity"] = connectivity.astype(np.int64)
    group["Offsets"] = np.cumsum([0, *map(len, cells)]).astype(np.int64)


def _points(root: h5py.Group, points: Iterator[Array]) -> int:
    """Store the points of all samples one after the other; returns how many a sample has."""
    first = next(points)
    count = len(first)
    stored = root.create_dataset(
        "Points",
        data=first.astype(np.float32),
        maxshape=(None, 3),
        chunks=(max(count, 1), 3),
        compression="gzip",
        shuffle=True,
    )
    for places in points:
        stored.resize(len(stored) + count, axis=0)
        stored[-count:] = places
    return count


def _readme(stage: Stage, path: Path) -> Path:
    rows = [
        f"{stage.title} ({stage.state})",
        "",
        "Open the .vtkhdf files in ParaView 5.12 or later.",
    ]
    rows += ["", "bodies.vtkhdf, cell data 'body':"]
    rows += [f"  {i:3} {body.name}: {body.origin}" for i, body in enumerate(stage.bodies)]
    if any(body.cut for body in stage.bodies):
        rows += [
            "bodies.vtkhdf, point data 'above_water' [m]: height over the surface at a mesh.",
            "  The wetted part is below 0 (Clip), the water line at 0 (Contour).",
        ]
    if stage.lines:
        rows += ["", "lines.vtkhdf, cell data 'line', point data 'load' [N]:"]
        rows += [f"  {i:3} {line.name} ({line.kind})" for i, line in enumerate(stage.lines)]
    if stage.sea is not None:
        rows += ["", "sea.vtkhdf, point data 'elevation' [m]: the waves as they come"]
    rows += ["", *stage.notes]
    path.write_text("\n".join(rows).rstrip() + "\n", encoding="utf-8")
    return path
