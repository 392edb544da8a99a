"""Mass, stiffness, strength and hydrodynamic coefficients of mooring lines by their diameter."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hydrodae.errors import CaseError

# Coefficients over the nominal diameter d, as in MoorPy (NREL, MoorProps_default.yaml): mass and
# stiffness of chains after DNV-OS-E301; drag after DNV-OS-E301, turned to the diameter of the same
# volume, along the line over d (a force of type `line` takes it over pi d); added mass after Bureau
# Veritas NR 493 (2021). Of fibre ropes the stiffness is a multiple
# of the breaking load.
#                    mass/d2  D/d   EA/d2   Cd     Cdt    Ca   Cat
_CHAINS = {
    "chain": (20.0e3, 1.80, 85.6e9, 1.333, 0.639, 1.0, 0.5),
    "chain_studlink": (21.9e3, 1.89, 88.0e9, 1.376, 0.741, 1.0, 0.5),
}
_WIRE = (5293.0, 1.18, 97.1e9, 1022e6, 1.021)
#           mass/d2  density  MBL/d2  MBL/d3  EA/MBL  Cd
_ROPES = {
    "polyester": (679.0, 1380.0, 308e6, 0.0, 14.0, 2.021),
    "nylon": (585.0, 1140.0, 207e6, 230e6, 5.0, 1.979),
}
# Breaking load c d^2 (44 - 80 d) [N], d in m: DNV-OS-E302.
_GRADES = {"R3": 22.3e6, "R3S": 24.9e6, "R4": 27.4e6, "R4S": 30.4e6, "R5": 32.0e6}


@dataclass(frozen=True)
class LineType:
    """What a mooring line is made of.

    Attributes
    ----------
    mass : float
        Dry mass per unstretched length [kg/m].
    diameter : float
        Of the cylinder with the same volume [m].
    stiffness : float
        Axial stiffness EA [N].
    breaking_load : float
        Minimum breaking load [N].
    drag, drag_axial, added_mass, added_mass_axial : float
        Coefficients of a force of type `line`, over `diameter`.
    """

    mass: float
    diameter: float
    stiffness: float
    breaking_load: float
    drag: float
    drag_axial: float
    added_mass: float
    added_mass_axial: float

    def weight(self, density: float = 1025.0, gravity: float = 9.81) -> float:
        """Weight in water per unstretched length [N/m], for a force of type `catenary`."""
        return (self.mass - density * 0.25 * math.pi * self.diameter**2) * gravity

    def keys(self) -> dict[str, float]:
        """Keys of a force of type `line`."""
        return {
            "mass": self.mass,
            "diameter": self.diameter,
            "stiffness": self.stiffness,
            "breaking_load": self.breaking_load,
            "drag": self.drag,
            "drag_axial": self.drag_axial,
            "added_mass": self.added_mass,
            "added_mass_axial": self.added_mass_axial,
        }


def line_type(material: str, diameter: float, *, grade: str = "R4") -> LineType:
    """Typical properties of a mooring line, for first designs.

    Parameters
    ----------
    material : {"chain", "chain_studlink", "wire", "polyester", "nylon"}
        A chain without studs or with studs, a wire rope, or a fibre rope.
    diameter : float
        Nominal diameter: of the bar of a chain, of a rope [m].
    grade : {"R3", "R3S", "R4", "R4S", "R5"}
        Steel of a chain.

    Raises
    ------
    CaseError
        If there is no such material or grade, or the diameter is not above 0.

    Notes
    -----
    Coefficients of MoorPy (NREL), which takes them from DNV-OS-E301 and Bureau Veritas NR 493;
    breaking loads of chains after DNV-OS-E302. Fibre ropes: the quasi-static stiffness.
    """
    d = diameter
    if not d > 0.0:
        raise CaseError(f"line_type: 'diameter' must be above 0, not {d}")
    if material in _CHAINS:
        if grade not in _GRADES:
            raise CaseError(f"line_type: no grade {grade!r}; there are: {', '.join(_GRADES)}")
        m, volume, ea, cd, cdt, ca, cat = _CHAINS[material]
        strength = _GRADES[grade] * d**2 * (44.0 - 80.0 * d)
        along = cdt / math.pi
        return LineType(m * d**2, volume * d, ea * d**2, strength, cd, along, ca, cat)
    if material == "wire":
        m, volume, ea, mbl, cd = _WIRE
        return LineType(m * d**2, volume * d, ea * d**2, mbl * d**2, cd, 0.0, 1.0, 0.0)
    if material in _ROPES:
        m, density, mbl2, mbl3, ratio, cd = _ROPES[material]
        strength = mbl2 * d**2 + mbl3 * d**3
        volume = math.sqrt(4.0 * m / (math.pi * density))
        return LineType(m * d**2, volume * d, ratio * strength, strength, cd, 0.0, 1.1, 0.15)
    known = ", ".join([*_CHAINS, "wire", *_ROPES])
    raise CaseError(f"line_type: no material {material!r}; there are: {known}")
