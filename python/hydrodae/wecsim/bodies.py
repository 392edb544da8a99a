"""Bodies of an input file as tables of a case, with their drag."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from hydrodae.case.bodies import shape_file
from hydrodae.errors import CaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.hull.closed import write_stl
from hydrodae.hdb.hull.meshes import triangles_of
from hydrodae.support.arrays import Array
from hydrodae.wecsim.modes import Modes, add_modes
from hydrodae.wecsim.morison import members
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.surface import read_shape, read_surface
from hydrodae.wecsim.text import CaseText

#: Fields of bodies that are for pictures, or that nothing here depends on.
IDLE = {
    "adjMassFactor": "added mass at infinite frequency stands in the mass matrix here",
    "viz.color": "",
    "viz.opacity": "",
    "paraview": "",
    "bodyparaview": "",
    "name": "",
    "dof": "",
    "flex": "",
    "gbmDOF": "",
}
#: Fields of effects that the kernel has another way, or not at all.
LACKING = {
    "QTFs": "second-order forces (QTF)",
    "largeXYDisplacement.option": 'large displacements: [sea] phase = "moving" is near to it',
    "hydroStiffness": "hydroStiffness of the body; that of the database is used",
}


class Bodies:
    """Numbers of the bodies: what the case says of each.

    Parameters
    ----------
    read : InputFile
    names : dict of str
        By number.
    database : HydroDatabase or None
    rho : float
        Density of the water [kg/m3].
    target : Path
        Folder of the case, for surfaces.
    modes : dict of Modes
        By the name of the body.
    """

    def __init__(
        self,
        read: InputFile,
        names: dict[int, str],
        database: HydroDatabase | None,
        rho: float,
        target: Path,
        modes: Mapping[str, Modes] | None = None,
    ) -> None:
        self.read, self.names, self.database, self.rho = read, names, database, rho
        self.target, self.modes = target, modes or {}

    def item(self, number: int) -> Item:
        """Entries of a body."""
        item = self.read.get("body", number)
        if item is None:
            raise CaseError(f"{self.read.path}: there is no body({number})")
        return item

    def is_wet(self, number: int) -> bool:
        """Whether it has a body in the database."""
        dry = self.item(number).whole("nonHydro")
        return self.database is not None and not dry and self.names[number] in self.database.bodies

    def center_of_gravity(self, number: int) -> Array:
        """World [m]: of the database, or of the input file for bodies without one."""
        item = self.item(number)
        if self.is_wet(number) and self.database is not None:
            point = self.database.bodies[self.names[number]].reference_point
            if point is not None:
                return np.asarray(point)
        point = item.vector("centerGravity", [])
        if point.size != 3:
            place = self.read.place(item.line)
            raise CaseError(
                f"{place}: {item.title} has no centre of gravity that could be read; "
                f"write {item.title}.centerGravity = [x y z]"
            )
        return point

    def volume(self, number: int) -> float:
        """Displaced volume [m3]."""
        item = self.item(number)
        if self.is_wet(number) and self.database is not None:
            statics = self.database.bodies[self.names[number]].hydrostatics
            return 0.0 if statics is None else float(statics.displaced_volume)
        return item.number_of("volume")

    def start(self, number: int) -> tuple[Array, Array]:
        """Displacement of the centre of gravity [m] and rotation vector [rad] at the start."""
        item = self.item(number)
        shift = item.vector("initial.displacement", [0.0, 0.0, 0.0])
        axis = item.vector("initial.axis", [0.0, 1.0, 0.0])
        angle = item.number_of("initial.angle")
        size = float(np.linalg.norm(axis))
        return shift, axis / (size or 1.0) * angle

    def add(self, text: CaseText, number: int, motion: str) -> None:
        """Add [[body]] and its damping."""
        item, name = self.item(number), self.names[number]
        keys: dict[str, Any] = {"name": name}
        if self.is_wet(number):
            keys["hydro"] = name
        keys["motion"] = motion if motion != "rigid" else None
        keys["mass"], comment = self._mass(item, number)
        keys["center_of_gravity"] = self.center_of_gravity(number)
        keys |= self._inertia(item)
        if not self.is_wet(number):
            volume = self.volume(number)
            if volume > 0.0:
                keys["volume"] = volume
                center = item.vector("centerBuoyancy", [])
                keys["center_of_buoyancy"] = center if center.size == 3 else None
            elif "centerBuoyancy" in item.entries:
                item.used.add("centerBuoyancy")
                place = self.read.place(item.line_of("centerBuoyancy"))
                self.read.remarks.not_needed(place, f"{item.title}.centerBuoyancy (no volume)")
        else:
            self._overwritten(item, name)
        keys |= self._surface(item, number, motion)
        shift, rotation = self.start(number)
        if motion != "fixed" and (shift.any() or rotation.any()):
            initial: dict[str, Any] = {}
            if shift.any():
                initial["displacement"] = shift
            if rotation.any():
                initial["rotation_deg"] = np.rad2deg(rotation)
            keys["initial"] = initial
        elif shift.any() or rotation.any():
            self._left_out(item, "initial.displacement", "start of a body that is fixed")
        text.table("[[body]]", keys, f"{item.title}{comment}")
        if "mesh" not in keys:
            self._draw(item, number)
        if name in self.modes:
            add_modes(text, self.read, item, name, self.modes[name])
        elif item.whole("flex"):
            self._left_out(item, "flex", "generalised modes, which the database lacks", "modes")
        self._notes(item)
        if motion != "fixed":
            self._damping(text, item, name)
        self._morison(text, item, number, name)

    def _overwritten(self, item: Item, name: str) -> None:
        """Name what WEC-Sim overwrites with the values of the database, as is done here."""
        for field in ("centerGravity", "centerBuoyancy", "volume"):
            if field in item.entries:
                item.used.add(field)
                self.read.remarks.assumed(
                    self.read.place(item.line_of(field)),
                    f"{item.title}.{field} is that of {name} in the database, as in WEC-Sim",
                )

    def _left_out(self, item: Item, field: str, text: str, part: str = "") -> None:
        item.used.add(field)
        place = self.read.place(item.line_of(field))
        self.read.remarks.left_out(place, f"{item.title}: {text}", part)

    def _surface(self, item: Item, number: int, motion: str) -> dict[str, Any]:
        """Keys for pressure on the mesh at each instant, which nonlinearHydro asks for."""
        option = item.whole("nonlinearHydro")
        if option == 0:
            return {}
        effect = "nonlinear hydrodynamics (pressure on the mesh at each instant)"
        file = self._file(item)
        if motion == "fixed" or not self.is_wet(number) or file is None:
            what = "it does not move" if motion == "fixed" else "no database or geometryFile"
            self._left_out(item, "nonlinearHydro", f"{effect}: {what}")
            return {}
        triangles, fault = read_surface(file, self.center_of_gravity(number))
        if fault:
            self._left_out(item, "nonlinearHydro", f"{effect}: {fault}")
            return {}
        name = f"{self.names[number]}.stl"
        write_stl(triangles, self.target / name)
        if option == 1:
            place = self.read.place(item.line_of("nonlinearHydro"))
            self.read.remarks.assumed(
                place, f"{item.title}.nonlinearHydro = 1 taken as 2: pressure up to the wave"
            )
        return {"mesh": name, "hydrostatics": "mesh", "froude_krylov": "mesh"}

    def _file(self, item: Item) -> Path | None:
        """Geometry file; None if none is stated."""
        stated = item.text("geometryFile")
        item.used.add("geometryFile")
        return self.read.path.parent / stated.replace("\\", "/") if stated else None

    def _draw(self, item: Item, number: int) -> None:
        """Write the geometry file to where pictures look for it, in world axes."""
        file = self._file(item)
        if file is None:
            return
        panels, fault = read_shape(file, self.center_of_gravity(number))
        if fault:
            place = self.read.place(item.line_of("geometryFile"))
            self.read.remarks.not_needed(place, f"{item.title}.geometryFile to draw it ({fault})")
            return
        target = shape_file(self.target, self.names[number])
        target.parent.mkdir(exist_ok=True)
        write_stl(triangles_of(panels), target)

    def _mass(self, item: Item, number: int) -> tuple[float | str, str]:
        value = item.get("mass")
        if isinstance(value, str) and value.lower() == "equilibrium":
            volume = self.volume(number)
            if not volume > 0.0:
                raise CaseError(
                    f"{self.read.place(item.line_of('mass'))}: {item.title}.mass is 'equilibrium', "
                    "but no displaced volume is known"
                )
            return "equilibrium", f": stated volume {volume:.6g} m3"
        if isinstance(value, float | np.ndarray):
            return item.number_of("mass"), ""
        if isinstance(value, str) and value.lower() in ("fixed", "user"):
            return 999.0, ": mass as for a body that does not move"
        raise CaseError(
            f"{self.read.place(item.line_of('mass'))}: {item.title}.mass could not be read; "
            "write a number of kg or 'equilibrium'"
        )

    def _inertia(self, item: Item) -> dict[str, Any]:
        inertia = item.vector("inertia", [])
        if inertia.size != 3:
            if not isinstance(item.get("inertia"), str):
                self._left_out(item, "inertia", "inertia could not be read; 0 is taken")
            return {}
        products = item.vector("inertiaProducts", [0.0, 0.0, 0.0])
        keys: dict[str, Any] = {"inertia": inertia}
        if products.any():  # WEC-Sim: xy, xz, yz
            keys["products_of_inertia"] = products[[0, 2, 1]]
        return keys

    def _notes(self, item: Item) -> None:
        remarks = self.read.remarks
        for field, text in LACKING.items():
            if np.any(item.vector(field, [0.0]) != 0.0):
                self._left_out(item, field, text)
        for field in item.entries:
            if field.startswith("variableHydro."):
                item.used.add(field)
        for field, why in IDLE.items():
            if field in item.entries:
                item.used.add(field)
                place = self.read.place(item.line_of(field))
                remarks.not_needed(place, f"{item.title}.{field}" + (f" ({why})" if why else ""))

    def _damping(self, text: CaseText, item: Item, name: str) -> None:
        if keys := damping_keys(item, self.rho):
            keys = {"type": "viscous_damping", "name": f"{name}_drag", "body": name} | keys
            text.table("[[force]]", keys, f"linearDamping and quadDrag of {item.title}")

    def _morison(self, text: CaseText, item: Item, number: int, name: str) -> None:
        option = item.whole("morisonElement.option")
        fields = ("cd", "ca", "area", "VME", "rgME", "z")
        rows = {f: item.matrix(f"morisonElement.{f}") for f in fields}
        if option == 0:
            return
        center = self.center_of_gravity(number)
        for index in range(max(len(value) for value in rows.values())):
            element = {f: v[min(index, len(v) - 1)].ravel()[:3] for f, v in rows.items()}
            found = members(option, element, center)
            if not found:
                self._left_out(
                    item,
                    "morisonElement.option",
                    f"Morison element {index + 1}: neither a drag area nor a volume of a cylinder",
                )
            for suffix, keys in found.items():
                text.table(
                    "[[morison]]",
                    {"name": f"{name}_morison{index + 1}{suffix}", "body": name} | keys,
                    f"Morison element {index + 1} of {item.title}",
                )


def damping_keys(item: Item, rho: float) -> dict[str, Any]:
    """Keys of `viscous_damping` for linearDamping and quadDrag; empty where there are none."""
    linear = _six(item.get("linearDamping"))
    quadratic = _six(item.get("quadDrag.drag"))
    area = item.vector("quadDrag.area", [])
    factor = item.vector("quadDrag.cd", [])
    if not quadratic.any() and area.size == 6 and factor.size == 6:
        quadratic = np.diag(0.5 * rho * factor * area)
    found = {"linear": linear, "quadratic": quadratic}
    return {key: _short(matrix) for key, matrix in found.items() if matrix.any()}


def _six(value: Any) -> Array:
    """Six numbers or a 6 x 6 matrix as a matrix."""
    if not isinstance(value, float | np.ndarray):
        return np.zeros((6, 6))
    array = np.atleast_2d(np.asarray(value, dtype=float))
    if array.size in (5, 6) and 1 in array.shape:
        array = np.diag(np.pad(array.ravel(), (0, 6 - array.size)))
    made = np.zeros((6, 6))
    rows, columns = min(array.shape[0], 6), min(array.shape[1], 6)
    if array.size > 1:
        made[:rows, :columns] = array[:rows, :columns]
    return made


def _short(matrix: Array) -> Array:
    """A diagonal matrix by its six numbers."""
    diagonal = np.diag(matrix)
    return diagonal if not (matrix - np.diag(diagonal)).any() else matrix
