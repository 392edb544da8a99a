"""Properties of mooring lines by their diameter, for early design.

The coefficients are the defaults of MoorPy (M. Hall and others, MoorPy, NREL, 2021,
doi:10.11578/dc.20210726.1), which fit catalogues of makers: chain of grade R4 with the stiffness
of DNV-OS-E301 and the breaking load of DNV-OS-E302; six-strand wire rope; polyester and nylon with
a stiffness in proportion to the breaking load. A line that is bought has a data sheet: use that.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from typing import NamedTuple

from hydrodae.errors import CaseError

_LARGEST = 1.0  #: [m]; a diameter above it was given in millimetres


@dataclass(frozen=True)
class LineType:
    """What a metre of line is.

    Attributes
    ----------
    name : str
        "studless chain 0.1 m", for people.
    diameter : float
        Nominal diameter: of the bar of a chain, over all of a rope [m].
    volume_diameter : float
        Diameter of a cylinder of the same volume [m]: the one for drag and added mass, and the
        `Diam` of MoorDyn.
    mass : float
        Dry, per unstretched length [kg/m].
    stiffness : float
        Axial stiffness EA [N]; of polyester and nylon the quasi-static one.
    breaking_load : float
        Minimum breaking load [N].
    stiffness_at_sea : tuple of float or None
        Of polyester and nylon: EA at wave frequency is the first [N] plus the second [-] times the
        mean tension.
    drag, drag_axial, added_mass, added_mass_axial : float
        Coefficients of Morison's equation over `volume_diameter`, as a force of type `line` takes
        them: drag of DNV-OS-E301, added mass of Bureau Veritas NR 493 (2021).
    """

    name: str
    diameter: float
    volume_diameter: float
    mass: float
    stiffness: float
    breaking_load: float
    stiffness_at_sea: tuple[float, float] | None = None
    drag: float = 0.0
    drag_axial: float = 0.0
    added_mass: float = 0.0
    added_mass_axial: float = 0.0
    contact_diameter: float | None = None

    def keys(self) -> dict[str, float]:
        """Keys of a force of type `line`."""
        contact = self.contact_diameter
        return {
            "mass": self.mass,
            "diameter": self.volume_diameter,
            "stiffness": self.stiffness,
            "breaking_load": self.breaking_load,
            "drag": self.drag,
            "drag_axial": self.drag_axial,
            "added_mass": self.added_mass,
            "added_mass_axial": self.added_mass_axial,
        } | ({} if contact is None else {"contact_diameter": contact})

    def weight(self, density: float = 1025.0, gravity: float = 9.81) -> float:
        """Weight in water per unstretched length [N/m], as forces of type `catenary` take it.

        Parameters
        ----------
        density : float
            Of the water [kg/m3].
        gravity : float
            [m/s2]
        """
        return (self.mass - density * 0.25 * pi * self.volume_diameter**2) * gravity


class _Water(NamedTuple):
    drag: float
    drag_axial: float
    added_mass: float
    added_mass_axial: float


def chain(diameter: float, *, studs: bool = False) -> LineType:
    """Chain of grade R4, by the diameter of its bar [m].

    Raises
    ------
    CaseError
        The diameter is none, or beyond 0.3 m, where the formula of the breaking load ends.
    """
    d = _checked(diameter, 0.3)
    breaking = (-2.19e9 * d + 1.21e9) * d**2 + 9.11e2 * d
    if studs:
        mass, stiffness = 21.9e3 * d**2, 88.0e9 * d**2
        name, volume, water = f"studlink chain {d:g} m", 1.89 * d, _Water(1.376, 0.741 / pi, 1, 0.5)
        width = 3.6 * d  # of a link, ISO 1704
    else:
        mass, stiffness = 20.0e3 * d**2, (-3.93e7 * d + 85.6e9) * d**2
        name, volume, water = f"studless chain {d:g} m", 1.8 * d, _Water(1.333, 0.639 / pi, 1, 0.5)
        width = 3.35 * d
    return LineType(
        name, d, volume, mass, stiffness, breaking, contact_diameter=width, **water._asdict()
    )


def studless_chain(diameter: float) -> LineType:
    """Chain without studs: see `chain`."""
    return chain(diameter)


def studlink_chain(diameter: float) -> LineType:
    """Chain with studs: see `chain`."""
    return chain(diameter, studs=True)


def wire(diameter: float) -> LineType:
    """Six-strand wire rope, by its diameter [m]. Raises CaseError as `chain` does."""
    d = _checked(diameter)
    water = _Water(1.021, 0.0, 1.0, 0.0)
    mass, stiffness, breaking = 5293.0 * d**2, 97.1e9 * d**2, 1022e6 * d**2
    return LineType(f"wire rope {d:g} m", d, 1.18 * d, mass, stiffness, breaking, **water._asdict())


def polyester(diameter: float) -> LineType:
    """Polyester rope, by its diameter [m]. Raises CaseError as `chain` does."""
    d = _checked(diameter)
    breaking = 308e6 * d**2
    return _fibre("polyester", d, 679.0, 1380.0, breaking, (14.0, 11.6, 40.0), 2.021)


def nylon(diameter: float) -> LineType:
    """Nylon rope, by its diameter [m]. Raises CaseError as `chain` does."""
    d = _checked(diameter)
    breaking = (230e6 * d + 207e6) * d**2
    return _fibre("nylon", d, 585.0, 1140.0, breaking, (5.0, 2.08, 39.0), 1.979)


def _fibre(
    name: str,
    d: float,
    mass_per_square: float,
    density: float,
    breaking: float,
    stiffness: tuple[float, float, float],
    drag: float,
) -> LineType:
    """A rope of a material with this density [kg/m3]; stiffnesses over the breaking load."""
    mass = mass_per_square * d**2
    static, at_rest, by_tension = stiffness
    return LineType(
        f"{name} rope {d:g} m",
        d,
        sqrt(4.0 * mass / (pi * density)),
        mass,
        static * breaking,
        breaking,
        (at_rest * breaking, by_tension),
        **_Water(drag, 0.0, 1.1, 0.15)._asdict(),
    )


def _checked(diameter: float, largest: float = _LARGEST) -> float:
    if not 0.0 < diameter <= largest:
        raise CaseError(
            f"a line of diameter {diameter:g} m: expected more than 0 and at most {largest:g} m"
        )
    return float(diameter)
