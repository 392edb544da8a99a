"""`Hydrostatics[_i].dat` and `KH[_i].dat` of Nemoh (and of programs that imitate them)."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.hull.mesh_statics import mesh_statics
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.hdb.readers.stiffness_file import read_stiffness
from hydrodae.hdb.readers.text import files_named, finite, read_lines
from hydrodae.support.arrays import Array
from hydrodae.support.naming import names_file

_PAIR = re.compile(r"=\s*(\S+)\s*-\s*[XYZ]G\s*=\s*(\S+)")
_VALUE = re.compile(r"^\s*(Displacement|Waterplane area)[^=]*=\s*(\S+)", re.IGNORECASE)
#: Difference of K33 / (rho g) and A_w that quadrature on panels leaves, over A_w.
SAME_AREA = 0.01
#: Densities of several bodies that are one to the digits of the files, over the density.
ONE_DENSITY = 1e-3
#: Densities of water [kg/m3]: boiling fresh water, and the Dead Sea.
WATER = (950.0, 1250.0)


@dataclass(frozen=True)
class FileHydrostatics:
    """Hydrostatics of one body about the centre of gravity that its file states."""

    hydrostatics: Hydrostatics
    center_of_gravity: Array
    files: tuple[Path, Path]


@dataclass(frozen=True)
class _Written:
    """What the two files of one body hold: `area` [m2] is None where `text` does not state it."""

    text: Path
    matrix: Path
    buoyancy: Array
    center_of_gravity: Array
    volume: float
    area: float | None
    stiffness: Array


def find(root: Path, *names: str) -> Path | None:
    """Find a file by name, whatever its case, in a folder or one folder below.

    Raises
    ------
    DatabaseError
        Two different files of that name at the same depth.
    """
    for name in names:
        found = files_named(root, name)
        # mechanics/ repeats what the mesh folder holds
        repeats = [p for p in found if p.parent != root and p.parent.name.lower() == "mechanics"]
        found = [p for p in found if p not in repeats] or found
        if len(found) > 1:
            raise DatabaseError(f"two files could be meant: {found[0]} and {found[1]}").about(
                "ambiguous"
            )
        if found:
            return found[0]
    return None


def read_all(
    root: Path, count: int, rho: float, gravity: float
) -> tuple[list[FileHydrostatics | None], list[Finding]]:
    """Read the hydrostatics of every body of a folder; None where a file is missing.

    Nemoh's mesher writes `KH.dat` with the density of its own input. A stiffness of another density
    is scaled to `rho` [kg/m3], that of the tables, which the findings report.

    Raises
    ------
    DatabaseError
        A file is damaged, or K33 belongs to another waterplane than the text states.
    """
    written = [_read_one(root, i, count) for i in range(count)]
    density = _density([w for w in written if w is not None], rho, gravity)
    found = [None if w is None else _hydrostatics(w, rho, density * gravity) for w in written]
    if density == rho:
        return found, []
    text = (
        f"the stiffness of KH.dat is that of a density of {density:.5g} kg/m3, by K33 and the "
        f"waterplane of Hydrostatics.dat; scaled to {rho:.5g} kg/m3, the density of the tables"
    )
    return found, [Finding("warning", "hydrostatics", text, density)]


def total_of_all_bodies(
    found: list[FileHydrostatics | None], heave_force: Array | None, rho: float, gravity: float
) -> Finding | None:
    """Detect the multi-body files of Nemoh 3 that hold the sum of all bodies in every file.

    Equal displacements are legitimate for equal bodies; then the heave excitation at the lowest
    frequency tends to rho g A_w of the single body.

    `heave_force` is |F_3| of each body at the lowest frequency [N/m], NaN where it has no heave.
    None if the files can be trusted.
    """
    present = [f.hydrostatics for f in found if f is not None]
    if len(present) < 2:
        return None
    volume = np.array([h.displaced_volume for h in present])
    area = np.array([h.waterplane_area for h in present])
    if np.ptp(volume) > 1e-3 * volume.max() or np.ptp(area) > 1e-3 * area.max():
        return None
    text = f"every body has the displacement {volume[0]:.5g} m3 and the waterplane {area[0]:.5g} m2"
    if heave_force is None or not np.all(np.isfinite(heave_force)):
        reason = "which cannot be separated from the sum of all bodies (a defect of Nemoh 3)"
    else:
        ratio = heave_force / (rho * gravity * area[0])
        if np.all(np.abs(ratio - 1.0) < 0.05):
            return None
        shown = ", ".join(f"{r:.2f}" for r in ratio)
        reason = (
            f"but the heave force at low frequency is only {shown} of rho g A_w: these files hold "
            f"the sum of all bodies (a defect of Nemoh 3)"
        )
    return Finding(
        "warning",
        "hydrostatics",
        f"{text}, {reason}; hydrostatics are left out, give those of each body by its "
        f"mesh (--mesh NAME=FILE)",
        value=float(volume[0]),
    )


def from_meshes(
    root: Path, meshes: list[str], total: Hydrostatics, points: list[Array]
) -> list[tuple[Hydrostatics, Path]] | None:
    """Hydrostatics body by body from the meshes of a folder, if their sum is what its files say.

    They are about `points` (3,) [m], each with its mesh file; `meshes` are the names in Nemoh.cal.
    None if a mesh is missing or wrong, or their sum is not the `total` that the files hold.
    """
    result = []
    for name, point in zip(meshes, points, strict=True):
        path = mesh_file(root, name)
        if path is None:
            return None
        try:
            result.append((mesh_statics(read_mesh(path), point), path))
        except DatabaseError:
            return None
    volume = sum(hs.displaced_volume for hs, _ in result)
    area = sum(hs.waterplane_area for hs, _ in result)
    same_volume = abs(volume / total.displaced_volume - 1.0) < 0.02
    same_area = abs(area - total.waterplane_area) < 0.02 * abs(total.waterplane_area) + 1e-6
    return result if same_volume and same_area else None


def mesh_file(root: Path, name: str) -> Path | None:
    """Find the mesh that Nemoh.cal calls `name`, without suffix."""
    return find(root, f"{name}.dat", f"{name}.gdf", f"{name}.stl")


def wetted_meshes(root: Path, meshes: dict[str, str]) -> dict[str, Array]:
    """Panels (n, 4, 3) [m] by body of the mesh files that are there; `meshes` has their names."""
    found = {}
    for body, name in meshes.items():
        path = mesh_file(root, name)
        try:
            if path is not None:
                found[body] = read_mesh(path)
        except DatabaseError:  # a file of that name which is no mesh: nothing is computed from it
            continue
    return found


def _read_one(root: Path, i: int, count: int) -> _Written | None:
    suffixes = ("", "_0") if count == 1 else (f"_{i}",)
    text = find(root, *(f"Hydrostatics{s}.dat" for s in suffixes))
    matrix = find(root, *(f"KH{s}.dat" for s in suffixes))
    if text is None or matrix is None:
        return None
    buoyancy, center, values = _read_text(text)
    volume, area = values["displacement"], values.get("waterplane area")
    return _Written(text, matrix, buoyancy, center, volume, area, read_stiffness(matrix).stiffness)


def _hydrostatics(w: _Written, rho: float, weight: float) -> FileHydrostatics:
    """Hydrostatics of a body whose stiffness was made with the specific `weight` [N/m3]."""
    hs = Hydrostatics.from_stiffness(
        w.stiffness, w.center_of_gravity, w.volume, w.buoyancy, rho, weight / rho
    )
    return FileHydrostatics(hs, w.center_of_gravity, (w.text, w.matrix))


def _density(written: list[_Written], rho: float, gravity: float) -> float:
    """Density [kg/m3] of the stiffnesses: `rho`, or that of K33 = rho' g A_w in all bodies.

    Raises
    ------
    DatabaseError
        K33 and A_w of the bodies have no density of water in common.
    """
    known = [(w, w.stiffness[2, 2] / gravity, w.area) for w in written if w.area is not None]
    # a submerged body has areas of rounding size
    least = [1e-4 * abs(w.volume) ** (2.0 / 3.0) for w, _, _ in known]
    wrong = [
        (w, mass / area if area else np.inf)
        for (w, mass, area), small in zip(known, least, strict=True)
        if abs(mass / rho - area) > SAME_AREA * max(abs(area), small)
    ]
    if not wrong:
        return rho
    floating = [
        mass / area for (_, mass, area), small in zip(known, least, strict=True) if area > small
    ]
    first, density = wrong[0]
    if floating and np.ptp(floating) <= ONE_DENSITY * rho and WATER[0] <= density <= WATER[1]:
        return float(density)
    shown = ", ".join(f"{d:.5g}" for d in floating) or "none"
    raise DatabaseError(
        f"K33 belongs to a waterplane of {first.stiffness[2, 2] / (rho * gravity):.5g} m2, but "
        f"{first.text.name} says {first.area:.5g} m2; no density of water explains both in all "
        f"bodies (rho = {rho:.5g}; K33 and waterplane give {shown} kg/m3). Replace the file that "
        f"is of another hull, or take both away and give the mesh of the wetted hull "
        f"(--mesh NAME=FILE)"
    ).about("conflict", "K33", file=first.matrix)


@names_file
def _read_text(path: Path) -> tuple[Array, Array, dict[str, float]]:
    pairs: list[tuple[float, float]] = []
    values: dict[str, float] = {}
    for i, line in enumerate(read_lines(path), start=1):
        pair, value = _PAIR.search(line), _VALUE.match(line)
        try:
            if pair:
                pairs.append((finite(pair[1]), finite(pair[2])))
            elif value:
                values[value[1].lower()] = finite(value[2])
        except ValueError as error:
            raise DatabaseError(f"{error}").about("format", line=i) from None
    if len(pairs) != 3 or "displacement" not in values:
        raise DatabaseError("expected three lines 'XF = . - XG = .' and a displacement").about(
            "format"
        )
    table = np.array(pairs)
    return table[:, 0], table[:, 1], values
