"""What a reader hands over."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae.hdb.database.extra import SourceTable
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.labels import Label, read_labels
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.relations.dispersion import phase_at
from hydrodae.support.arrays import Array, Complex

#: What a source holds of each frequency.
TABLES = ("added_mass", "radiation_damping", "froude_krylov", "diffraction", "excitation")
#: What no coefficient in SI units reaches; larger ones stand for overflows.
LARGEST = 1e30
#: Taken where no file gives them: sea water, and the mean over the globe.
SEA_WATER, USUAL_GRAVITY = 1025.0, 9.81


@dataclass(frozen=True)
class Water:
    """What the user states of the water, where a source leaves it out.

    Attributes
    ----------
    density, depth, gravity : float or None
        [kg/m3], [m] (may be infinite), [m/s2].
    """

    density: float | None = None
    depth: float | None = None
    gravity: float | None = None


@dataclass
class SourceData:
    """Tables as a reader understood them: project convention, but neither complete nor symmetric.

    Attributes
    ----------
    coordinates, omega, added_mass, radiation_damping, heading
        As in `HydroDatabase`; omega ascending.
    froude_krylov, diffraction, excitation : (nw, nh, n) complex arrays or None
        What the source holds of the three.
    reference_points : dict
        Point of each body [m], or None.
    hydrostatics : dict
        By body, each with the point [m] that its waterplane moments refer to; bodies without are
        absent.
    added_mass_inf, added_mass_zero : (n, n) array or None
        Those of w = inf and w = 0, given by the source itself.
    files : list of Path
        What was read; hashed for `source_sha256`.
    findings : list of Finding
        What the reader noticed.
    assumed_points : dict of Finding
        By body whose reference point the source does not state; the user may state another. The
        finding reports what is assumed.
    meshes : dict
        Panels (n, 4, 3) of the wetted surface of bodies [m], where the source holds them.
    extra : dict of SourceTable
        Kochin functions and drift forces.
    mode_stiffness : dict
        Hydrostatics of bodies with modes (6 + m, 6 + m) [N/m, N, N m]; see `Body`.
    statics_about : dict of functions
        By body, hydrostatics that the source holds about its point [m], which it does not state;
        text where they are not complete.
    setting : Setting
        How the source writes tables of second order; its water and points are left out.
    second_order : dict of SecondOrderTable
        As in `HydroDatabase`.
    """

    coordinates: tuple[str, ...]
    omega: Array
    added_mass: Array
    radiation_damping: Array
    heading: Array
    rho: float
    gravity: float
    water_depth: float
    name: str
    title: str
    froude_krylov: Complex | None = None
    diffraction: Complex | None = None
    excitation: Complex | None = None
    reference_points: dict[str, Array | None] = field(default_factory=dict)
    hydrostatics: dict[str, tuple[Hydrostatics, Array]] = field(default_factory=dict)
    added_mass_inf: Array | None = None
    added_mass_zero: Array | None = None
    files: list[Path] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)
    assumed_points: dict[str, Finding] = field(default_factory=dict)
    meshes: dict[str, Array] = field(default_factory=dict)
    extra: dict[str, SourceTable] = field(default_factory=dict)
    mode_stiffness: dict[str, Array] = field(default_factory=dict)
    statics_about: dict[str, Callable[[Array], Hydrostatics | str]] = field(default_factory=dict)
    setting: Setting = field(default_factory=Setting)
    second_order: dict[str, SecondOrderTable] = field(default_factory=dict)

    @property
    def labels(self) -> list[Label]:
        """The coordinates, each as its body and its motion."""
        return read_labels(self.coordinates)

    def keep_frequencies(self, kept: NDArray[np.bool_]) -> None:
        """Leave out the frequencies (nw,) that are not kept, in all tables."""
        self.omega = self.omega[kept]
        for name in TABLES:
            value = getattr(self, name)
            if value is not None:
                setattr(self, name, value[kept])

    def to_origin(self, places: Mapping[str, ArrayLike]) -> None:
        """Move the phase zero of the wave, at a place of each body [m], to the origin of the world.

        Forces F with the phase zero at x_0 become F e^{-i k x_0'}, x_0' along the wave.
        """
        body = [label.body for label in self.labels]
        for name in TABLES[2:]:
            force = getattr(self, name)
            if force is None:
                continue
            turned = force.copy()
            for owner, place in places.items():
                of_body = [i for i, of in enumerate(body) if of == owner]
                phase = phase_at(
                    place, self.omega[:, None], self.heading, self.water_depth, self.gravity
                )
                turned[:, :, of_body] *= np.exp(-1j * phase)[:, :, None]
            setattr(self, name, turned)

    def add_statics(
        self, body: str, stiffness: Array, point: Array, volume: float, buoyancy: Array
    ) -> None:
        """Take the waterplane of a buoyancy stiffness (6, 6) [N/m, N, N m] about a point [m]."""
        statics = Hydrostatics.from_stiffness(
            stiffness, point, volume, buoyancy, self.rho, self.gravity
        )
        self.hydrostatics[body] = (statics, point)

    def assume_point(self, body: str, point: Array, why: Finding) -> None:
        """Take a reference point that the source does not state."""
        self.reference_points[body] = point
        self.assumed_points[body] = why
        self.findings.append(why)

    def state_point(self, body: str, point: Array) -> None:
        """Take the reference point that the user states, in place of an assumed one.

        Hydrostatics that waited for it follow.
        """
        if body in self.statics_about:
            found = self.statics_about[body](point)
            if isinstance(found, Hydrostatics):
                self.hydrostatics[body] = (found, point)
            else:
                self.findings.append(without_hydrostatics(f"{body}: no {found}", [body]))
        self.reference_points[body] = point
        why = self.assumed_points.get(body)
        self.findings = [finding for finding in self.findings if finding is not why]


def without_hydrostatics(text: str, names: Iterable[str]) -> Finding:
    """Report bodies without hydrostatics, and what would give them."""
    options = " ".join(f"--mesh {name}=FILE" for name in names)
    return Finding(
        "warning",
        "hydrostatics",
        f"{text}; bodies that move need them: {options} takes those of the mesh of the wetted "
        "hull, --stiffness and --volume a 6 x 6 matrix",
    )


def sha256(files: Iterable[Path]) -> str:
    """Hash of one file's bytes, or of the names and hashes of several in alphabetical order."""
    paths = sorted(files, key=lambda p: p.name.lower())
    digests = [hashlib.sha256(p.read_bytes()).hexdigest() for p in paths]
    if len(digests) == 1:
        return digests[0]
    lines = "".join(f"{d}  {p.name.lower()}\n" for d, p in zip(digests, paths, strict=True))
    return hashlib.sha256(lines.encode()).hexdigest()
