"""What a hydrodynamic database holds: one convention, e^{+iwt}, SI, radians."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import coordinates as co
from hydrodae.hdb.database.convolution import RadiationKernel
from hydrodae.hdb.database.extra import SourceTable
from hydrodae.hdb.database.layout import TABLES
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.labels import DOFS, Label, bodies_of, modes_of, read_labels
from hydrodae.hdb.relations import irf
from hydrodae.support.arrays import Array, Complex

if TYPE_CHECKING:
    from hydrodae.hdb.memory import ExponentialMemory

#: Arrays of numbers by their names: those of the file without its folders.
NUMBERS = {name.rpartition("/")[2]: e for name, e in TABLES.items() if not e.kind.is_text}


@dataclass(frozen=True)
class Body:
    """A body of the database.

    Attributes
    ----------
    name : str
        Without `.` and spaces.
    reference_point : (3,) array or None
        World point about which rotations, moments, A, B and F of this body are [m]; None if the
        source does not say.
    hydrostatics : Hydrostatics or None
        None if unknown.
    mode_stiffness : (6 + m, 6 + m) array or None
        Hydrostatics over surge ... yaw and the m modes of the body [N/m, N, N m], as the source
        has them: not symmetric, and without gravity in the modes. Rows are loads. None without
        modes.
    mesh : (n, 4, 3) array or None
        Panels of the wetted surface [m], world axes, as they were computed; triangles repeat their
        last corner. None if the source does not hold them. Nothing is computed from them.
    mode_shapes : (m, n, 4, 3) array or None
        Displacements of the corners of `mesh` per unit of each mode [-], modes in the order of the
        coordinates. None if they are unknown. Nothing is computed from them.
    column : bool
        It is a water column: a piston of water inside a hull, not a hull itself.
    """

    name: str
    reference_point: Array | None = None
    hydrostatics: Hydrostatics | None = None
    mesh: Array | None = None
    mode_stiffness: Array | None = None
    column: bool = False
    mode_shapes: Array | None = None

    def __post_init__(self) -> None:
        if co.body_name(self.name) != self.name:
            raise DatabaseError(
                f"body name {self.name!r}: use letters, digits, _ and - only"
            ).about("label", self.name)
        if self.reference_point is not None:
            point = np.array(self.reference_point, dtype=float)
            if point.shape != (3,) or not np.all(np.isfinite(point)):
                raise DatabaseError(
                    f"reference point of {self.name!r} must be 3 numbers [m]"
                ).about("point", self.name)
            object.__setattr__(self, "reference_point", point)
        if self.mesh is not None:
            mesh = np.array(self.mesh, dtype=float)
            if mesh.ndim != 3 or mesh.shape[1:] != (4, 3) or not np.all(np.isfinite(mesh)):
                raise DatabaseError(f"mesh of {self.name!r} must be panels (n, 4, 3) [m]").about(
                    "shape", self.name
                )
            if not len(mesh):
                raise DatabaseError(f"mesh of {self.name!r} has no panels").about("mesh", self.name)
            object.__setattr__(self, "mesh", mesh)


@dataclass
class Tables:
    """Frequency-domain hydrodynamics of one or more bodies, as it stands in `hydro.h5`.

    Convention: x(t) = Re(X e^{+iwt}), unit wave elevation cos(wt - k.x) with its phase zero at the
    origin of the world. Rows are forces (influenced), columns are motions (radiating).

    Attributes
    ----------
    coordinates : (n,) tuple of str
        Labels `<body>.<motion>`; any subset of the six motions of each body, in any order, and its
        modes under other names.
    omega : (nw,) array
        Frequencies [rad/s], ascending, finite, > 0.
    added_mass, radiation_damping : (nw, n, n) arrays
        A [kg, kg m, kg m2] and B [N s/m, N s, N m s].
    added_mass_inf, added_mass_inf_std : (n, n) arrays
        A at infinite frequency and its uncertainty, in the units of A.
    heading : (nh,) array
        Directions of travel [rad], 0 = +x.
    froude_krylov, diffraction : (nw, nh, n) complex arrays
        Excitation per metre of wave amplitude [N/m, N m/m].
    bodies : dict of Body
        Every body of `coordinates`, by name.
    rho, gravity, water_depth : float
        [kg/m3], [m/s2], [m] (may be infinite).
    added_mass_inf_origin : str
        "source" or how it was estimated.
    excitation_split : bool
        False if the source gives the total only: then it all stands in `diffraction`.
    source, source_sha256, generator, title : str
        Provenance.
    repairs : tuple of str
        What `hydrodae.hdb.checks.repair` changed, one sentence each.
    kernel : RadiationKernel, optional
        Radiation kernel K(t) for the convolution.
    memory : dict of ExponentialMemory
        Fits of the radiation memory, by name.
    extra : dict of SourceTable
        Kochin functions and drift forces as the source wrote them (`hydrodae.hdb.database.extra`).
    second_order : dict of SecondOrderTable
        Mean drift and quadratic transfer functions, by "mean", "difference" and "sum".
    """

    coordinates: tuple[str, ...]
    omega: Array
    added_mass: Array
    radiation_damping: Array
    added_mass_inf: Array
    added_mass_inf_std: Array
    heading: Array
    froude_krylov: Complex
    diffraction: Complex
    bodies: dict[str, Body]
    rho: float
    gravity: float
    water_depth: float = np.inf
    added_mass_inf_origin: str = "source"
    excitation_split: bool = True
    source: str = ""
    source_sha256: str = ""
    generator: str = ""
    title: str = ""
    repairs: tuple[str, ...] = ()
    kernel: RadiationKernel | None = None
    memory: dict[str, ExponentialMemory] = field(default_factory=dict)
    extra: dict[str, SourceTable] = field(default_factory=dict)
    second_order: dict[str, SecondOrderTable] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self.coordinates = tuple(self.coordinates)
        for name, entry in NUMBERS.items():
            setattr(self, name, np.asarray(getattr(self, name), dtype=entry.kind.number()))
        self._check()

    def _check(self) -> None:
        n, nw = len(self.coordinates), self.omega.size
        lengths = {"n": n, "w": nw, "h": self.heading.size}
        if len(set(self.coordinates)) != n or n == 0:
            raise DatabaseError(f"coordinates must be different labels: {self.coordinates}").about(
                "label", "coordinates"
            )
        names = bodies_of(self.coordinates)
        if set(names) != set(self.bodies):
            raise DatabaseError(
                f"bodies {list(self.bodies)} do not fit the coordinates {names}"
            ).about("label", "bodies")
        for name, body in self.bodies.items():
            modes = modes_of(name, self.coordinates)
            found = 6 if body.mode_stiffness is None else len(body.mode_stiffness)
            if found != 6 + len(modes):
                raise DatabaseError(
                    f"coordinates {', '.join(modes)} of {name!r}: expected a mode_stiffness of "
                    f"6 + {len(modes)} rows, or one of {', '.join(DOFS)}"
                ).about("label", name)
            shapes = None if body.mesh is None else (len(modes), *body.mesh.shape)
            if body.mode_shapes is not None and body.mode_shapes.shape != shapes:
                raise DatabaseError(
                    f"mode_shapes of {name!r} have shape {body.mode_shapes.shape}, expected "
                    f"{shapes or 'none without a mesh'}"
                ).about("shape", name)
        for name, entry in NUMBERS.items():
            value, shape = getattr(self, name), tuple(lengths[str(dim)] for dim in entry.dims)
            if value.shape != shape:
                raise DatabaseError(f"{name} has shape {value.shape}, expected {shape}").about(
                    "shape", name
                )
            if not np.all(np.isfinite(value)):
                raise DatabaseError(f"{name} holds values that are not finite").about(
                    "not_finite", name
                )
        if nw == 0 or self.omega[0] <= 0.0 or not np.all(np.diff(self.omega) > 0.0):
            raise DatabaseError("omega must be ascending and > 0 [rad/s]").about("frequencies")
        for kind, table in self.second_order.items():
            if kind != table.kind or not set(table.coordinates) <= set(self.coordinates):
                raise DatabaseError(
                    f"second order, {kind}: a table of {table.kind} of {table.coordinates} does "
                    f"not fit the coordinates {self.coordinates}"
                ).about("label", kind)
        if not (self.rho > 0.0 and self.gravity > 0.0 and self.water_depth > 0.0):
            raise DatabaseError("rho, gravity and water_depth must be > 0").about("value", "water")

    @property
    def labels(self) -> list[Label]:
        """The coordinates, each as its body and its motion."""
        return read_labels(self.coordinates)

    @property
    def excitation(self) -> Complex:
        """Froude-Krylov plus diffraction, (nw, nh, n) [N/m, N m/m]."""
        return self.froude_krylov + self.diffraction

    def index(self, labels: str | Sequence[str]) -> NDArray[np.intp]:
        """Positions of labels (or of one label) among the coordinates.

        Raises
        ------
        DatabaseError
            Unknown label; the message names the nearest.
        """
        return co.index([labels] if isinstance(labels, str) else labels, self.coordinates)

    def hydrostatic_stiffness(self, body: str) -> Array:
        """Buoyancy stiffness (6, 6) of a body about its reference point [N/m, N, N m].

        Raises
        ------
        DatabaseError
            Unknown body, or its hydrostatics or reference point are unknown.
        """
        point = self.reference_point(body)
        return self.hydrostatics(body).stiffness(point, self.rho, self.gravity)

    def hydrostatics(self, body: str) -> Hydrostatics:
        """Hydrostatics of a body; an error where they are unknown."""
        hs = self.bodies[body].hydrostatics
        if hs is None:
            raise DatabaseError(f"the hydrostatics of body {body!r} are not in the database").about(
                "missing", body
            )
        return hs

    def reference_point(self, body: str) -> Array:
        """Point (3,) about which the moments of a body are, world [m].

        Raises
        ------
        DatabaseError
            Unknown body, or the source does not say.
        """
        co.check_body(body, self.bodies)
        point = self.bodies[body].reference_point
        if point is None:
            raise DatabaseError(
                f"the source does not say about which point the moments of {body!r} are; "
                f"state it (source_points, --origin {body}=x,y,z)"
            ).about("point", body)
        return point

    def phase_point(self, body: str) -> Array:
        """Where the phase of the waves is taken off the forces before interpolation, (3,) [m].

        The centre of buoyancy; the reference point, which may be far from the body, where that is
        not known. Likewise in a run.

        Raises
        ------
        DatabaseError
            Unknown body, or neither is known.
        """
        co.check_body(body, self.bodies)
        hs = self.bodies[body].hydrostatics
        if hs is None or not hs.displaced_volume > 0.0:
            return self.reference_point(body)
        return hs.center_of_buoyancy

    def radiation_kernel(self, time: ArrayLike, *, extrapolate: bool = False) -> Array:
        """K(t), (nt, n, n) [N/m, N, N m]; see `hydrodae.hdb.relations.irf.radiation_kernel`."""
        return irf.radiation_kernel(
            self.omega, self.radiation_damping, time, extrapolate=extrapolate
        )
