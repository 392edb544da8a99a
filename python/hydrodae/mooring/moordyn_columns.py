"""Columns of the tables of MoorDyn's input files: their names in versions 1 and 2, and units.

Sources: moordyn.readthedocs.io, "Input Files"; input files of MoorDyn, MoorPy, RAFT and WEC-Sim.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Column:
    """A column: its name here, what it holds, its spellings, and whether a table needs it."""

    key: str
    what: str
    names: tuple[str, ...]
    needed: bool = True
    unit: str = "-"


def _optional(key: str, what: str, *names: str, unit: str = "-") -> Column:
    return Column(key, what, names, False, unit)


def _needed(key: str, what: str, *names: str, unit: str = "-") -> Column:
    return Column(key, what, names, True, unit)


_PLACE = tuple(_needed(axis, "a coordinate", axis.upper(), unit="m") for axis in "xyz")
_FORCE = tuple(_optional(f"f{axis}", "a force", f"F{axis.upper()}", unit="N") for axis in "xyz")

COLUMNS: dict[str, tuple[Column, ...]] = {
    "types": (
        _needed("name", "the name", "TypeName", "LineType", "Name", "Type"),
        _needed("diameter", "the diameter", "Diam", "Diameter", "D", unit="m"),
        _needed("mass", "the mass per length", "Mass/m", "MassDen", "MassDenInAir", "Mass/length",
                unit="kg/m"),
        _needed("EA", "the stiffness EA", "EA", unit="N"),
        _needed("BA", "the internal damping", "BA/-zeta", "BA", "BA/zeta", "-zeta", "CIntDamp",
                "cInt"),
        _optional("EI", "the bending stiffness", "EI"),
        _needed("Cd", "the drag across", "Cd", "Cdn"),
        _needed("Ca", "the added mass across", "Ca", "Can"),
        _needed("CdAx", "the drag along", "CdAx", "Cdt"),
        _needed("CaAx", "the added mass along", "CaAx", "Cat"),
        _optional("Cl", "the lift coefficient", "Cl"),
        _optional("dF", "the range of lock-in", "dF"),
        _optional("cF", "the centre of lock-in", "cF"),
    ),
    "points": (
        _needed("id", "the number of the point", "ID", "Node", "Point", "Connection"),
        _needed("attachment", "the attachment", "Attachment", "Type"),
        *_PLACE,
        _needed("mass", "the mass", "Mass", "M", unit="kg"),
        _needed("volume", "the volume", "Volume", "V", "Vol", unit="m^3"),
        *_FORCE,
        _needed("CdA", "the drag area", "CdA", unit="m^2"),
        _needed("Ca", "the added mass coefficient", "Ca"),
    ),
    "lines": (
        _needed("id", "the number of the line", "ID", "Line"),
        _needed("type", "the type of the line", "LineType", "Type", "TypeName"),
        _needed("a", "end A", "AttachA", "NodeA", "AttachAnch", "NodeAnch", "EndA",
                "Anchor"),
        _needed("b", "end B", "AttachB", "NodeB", "AttachFair", "NodeFair", "EndB",
                "Fairlead"),
        _needed("length", "the unstretched length", "UnstrLen", "UnstrLength", "Length", unit="m"),
        _needed("segments", "the number of segments", "NumSegs", "NumSeg", "Segments"),
        _optional("outputs", "outputs", "LineOutputs", "Outputs", "Flags/Outputs", "Flags", "Outs"),
    ),
    "bodies": (
        _needed("id", "the number of the body", "ID", "Body", "BodyID"),
        _needed("attachment", "the attachment", "Attachment", "Type"),
        *(_needed(axis, "a coordinate", f"{axis.upper()}0", axis.upper(), unit="m")
          for axis in "xyz"),
        *(_needed(f"r{axis}", "an angle", *names, unit="deg") for axis, names in (
            ("x", ("r0", "roll", "rx")), ("y", ("p0", "pitch", "ry")), ("z", ("y0", "yaw", "rz")))),
        _optional("mass", "the mass", "Mass", "M"),
        _optional("CG", "the centre of gravity", "CG"),
        _optional("I", "the moments of inertia", "I"),
        _optional("volume", "the volume", "Volume", "V", "Vol"),
        _optional("CdA", "the drag area", "CdA"),
        _optional("Ca", "the added mass coefficient", "Ca"),
    ),
    "rod types": (
        _needed("name", "the name", "TypeName", "RodType", "Name", "Type"),
        _needed("diameter", "the diameter", "Diam", "Diameter", "D", unit="m"),
        _needed("mass", "the mass per length", "Mass/m", "MassDen", "MassDenInAir", "Mass/length",
                unit="kg/m"),
        _needed("Cd", "the drag across", "Cd", "Cdn"),
        _needed("Ca", "the added mass across", "Ca", "Can"),
        _optional("CdEnd", "the drag of an end", "CdEnd"),
        _optional("CaEnd", "the added mass of an end", "CaEnd"),
    ),
    "rods": (
        _needed("id", "the number of the rod", "ID", "Rod", "RodID"),
        _needed("type", "the type of the rod", "RodType", "Type", "TypeName"),
        _needed("attachment", "the attachment", "Attachment", "Attach"),
        *(_needed(axis + end, "a coordinate", axis.upper() + end, unit="m")
          for end in "ab" for axis in "xyz"),
        _needed("segments", "the number of segments", "NumSegs", "NumSeg", "Segments"),
        _optional("outputs", "outputs", "RodOutputs", "Outputs", "Flags", "Outs"),
    ),
}  # fmt: skip
#: As MoorDyn 2 takes the columns of line types, by their places.
TYPES_BY_PLACE = ("name", "diameter", "mass", "EA", "BA", "EI", "Cd", "Ca", "CdAx", "CaAx")
LINES_BY_PLACE = ("id", "type", "a", "b", "length", "segments")

#: SI units, and others that their numbers may come in.
_OTHERS = {
    "m": ("mm", "cm", "km", "ft", "in"),
    "kg/m": ("t/m", "g/m", "kg/km", "lb/ft", "te/m"),
    "N": ("kn", "mn", "lbf", "te", "tf"),
    "kg": ("t", "te", "g", "lb"),
    "m^3": ("l", "cm^3", "ft^3"),
    "m^2": ("cm^2", "mm^2", "ft^2"),
    "deg": ("rad",),
}

#: Options of all versions, in lower case; others are unknown.
OPTIONS = frozenset(
    "bathymetry bathymetryfile cb cbot cdscaleic cfl currents cv depth disableoutput "
    "disableouttime dt dtic dtm dtout dtwave echo fileic fricdamp frictioncoefficient g "
    "gendynamicic gravity icdfac icdt icfile icgendynamic icthresh ictmax inertialf "
    "inertialf_rampt kb kbot mc mu_ka mu_kt outswitch rho rhow seafloorfile statdynfricscale "
    "threshic tmaxic tscheme unifycurrentgrid waterdepth waterkin wavekin writelog writeunits "
    "wtrdens wtrdepth wtrdnsty wtrdpth".split()
)


def required(table: str) -> list[Column]:
    """Columns that a table must have."""
    return [column for column in COLUMNS[table] if column.needed]


def find_column(table: str, word: str, taken: list[str]) -> Column | None:
    """Return the column that a word of a header names, one that is not taken if there is one.

    In bodies both Y0, a coordinate, and y0, the yaw, may be written y0: the coordinate is first.
    """
    plain = word.rstrip("*").lower()
    found = [c for c in COLUMNS[table] if plain in [name.lower() for name in c.names]]
    free = [column for column in found if column.key not in taken]
    return next(iter(free + found), None)


def other_unit(table: str, key: str, unit: str) -> str:
    """Return the SI unit of a column if its header has another one; else nothing."""
    si = next(column.unit for column in COLUMNS[table] if column.key == key)
    plain = unit.strip("()[]").lower().replace("²", "^2").replace("³", "^3")
    return si if plain in _OTHERS.get(si, ()) else ""
