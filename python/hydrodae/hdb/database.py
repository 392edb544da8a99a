"""The hydrodynamic database in memory: one convention, e^{+iwt}, SI, radians."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae import irf
from hydrodae.errors import DatabaseError
from hydrodae.hdb import coordinates as co
from hydrodae.hdb.hydrostatics import Hydrostatics
from hydrodae.hdb.radiation_kernel import RadiationKernel, make_kernel, moved_kernel

if TYPE_CHECKING:
    from hydrodae.memory import ExponentialMemory

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]


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
    """

    name: str
    reference_point: Array | None = None
    hydrostatics: Hydrostatics | None = None

    def __post_init__(self) -> None:
        if co.body_name(self.name) != self.name:
            raise DatabaseError(f"body name {self.name!r}: use letters, digits, _ and - only")
        if self.reference_point is not None:
            point = np.array(self.reference_point, dtype=float)
            if point.shape != (3,) or not np.all(np.isfinite(point)):
                raise DatabaseError(f"reference point of {self.name!r} must be 3 numbers [m]")
            object.__setattr__(self, "reference_point", point)


@dataclass
class HydroDatabase:
    """Frequency-domain hydrodynamics of one or more bodies.

    Convention: x(t) = Re(X e^{+iwt}), unit wave elevation cos(wt - k.x) with its phase zero at the
    origin of the world. Rows are forces (influenced), columns are motions (radiating).

    Attributes
    ----------
    coordinates : (n,) tuple of str
        Labels `<body>.<dof>`; any subset of the six of each body, in any order.
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
        What `hydrodae.hdb.repair` changed, one sentence each.
    kernel : RadiationKernel, optional
        Radiation kernel K(t) for the convolution.
    memory : dict of ExponentialMemory
        Fits of the radiation memory, by name.
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

    def __post_init__(self) -> None:
        self.coordinates = tuple(self.coordinates)
        for name in ("omega", "added_mass", "radiation_damping", "added_mass_inf",
                     "added_mass_inf_std", "heading"):  # fmt: skip
            setattr(self, name, np.asarray(getattr(self, name), dtype=float))
        for name in ("froude_krylov", "diffraction"):
            setattr(self, name, np.asarray(getattr(self, name), dtype=complex))
        self._check()

    def _check(self) -> None:
        n, nw, nh = len(self.coordinates), self.omega.size, self.heading.size
        if len(set(self.coordinates)) != n or n == 0:
            raise DatabaseError(f"coordinates must be different labels: {self.coordinates}")
        names = co.bodies_of(self.coordinates)
        if set(names) != set(self.bodies):
            raise DatabaseError(f"bodies {list(self.bodies)} do not fit the coordinates {names}")
        shapes = {
            "omega": (nw,),
            "added_mass": (nw, n, n),
            "radiation_damping": (nw, n, n),
            "added_mass_inf": (n, n),
            "added_mass_inf_std": (n, n),
            "heading": (nh,),
            "froude_krylov": (nw, nh, n),
            "diffraction": (nw, nh, n),
        }
        for name, shape in shapes.items():
            value = getattr(self, name)
            if value.shape != shape:
                raise DatabaseError(f"{name} has shape {value.shape}, expected {shape}")
            if not np.all(np.isfinite(value)):
                raise DatabaseError(f"{name} holds values that are not finite")
        if nw == 0 or self.omega[0] <= 0.0 or not np.all(np.diff(self.omega) > 0.0):
            raise DatabaseError("omega must be ascending and > 0 [rad/s]")
        if not (self.rho > 0.0 and self.gravity > 0.0 and self.water_depth > 0.0):
            raise DatabaseError("rho, gravity and water_depth must be > 0")

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
        point, hs = self.reference_point(body), self.bodies[body].hydrostatics
        if hs is None:
            raise DatabaseError(f"the hydrostatics of body {body!r} are not in the database")
        return hs.stiffness(point, self.rho, self.gravity)

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
            )
        return point

    def radiation_kernel(self, time: ArrayLike, *, extrapolate: bool = False) -> Array:
        """K(t), (nt, n, n) [N/m, N, N m]; see `hydrodae.irf.radiation_kernel`."""
        return irf.radiation_kernel(
            self.omega, self.radiation_damping, time, extrapolate=extrapolate
        )

    def with_kernel(
        self,
        inputs: Sequence[str] | None = None,
        outputs: Sequence[str] | None = None,
        *,
        length: float | None = None,
        band: tuple[float, float] | None = None,
    ) -> HydroDatabase:
        """Return a copy that stores K of these inputs (default: all coordinates).

        See `hydrodae.hdb.radiation_kernel.make_kernel`.
        """
        labels = self.coordinates if inputs is None else inputs
        return replace(self, kernel=make_kernel(self, labels, outputs, length=length, band=band))

    def select(self, labels: Sequence[str]) -> HydroDatabase:
        """Return a copy with these coordinates only, in this order: the others are locked.

        Fits keep those of their inputs and outputs that remain; a fit without inputs is dropped.
        """
        i = self.index(labels)
        square = np.ix_(i, i)
        keep = co.bodies_of(labels)
        return replace(
            self,
            coordinates=tuple(labels),
            added_mass=self.added_mass[:, i][:, :, i],
            radiation_damping=self.radiation_damping[:, i][:, :, i],
            added_mass_inf=self.added_mass_inf[square],
            added_mass_inf_std=self.added_mass_inf_std[square],
            froude_krylov=self.froude_krylov[:, :, i],
            diffraction=self.diffraction[:, :, i],
            bodies={name: self.bodies[name] for name in keep},
            kernel=None if self.kernel is None else self.kernel.selected(labels),
            memory=_selected_fits(self.memory, labels),
        )

    def reordered(self, labels: Sequence[str]) -> HydroDatabase:
        """Return a copy with the coordinates in this order.

        Raises
        ------
        DatabaseError
            `labels` is not a permutation of the coordinates.
        """
        if sorted(labels) != sorted(self.coordinates):
            self.index(labels)
            missing = [c for c in self.coordinates if c not in labels]
            raise DatabaseError(f"not a permutation of the coordinates; missing: {missing}")
        return self.select(labels)

    def renamed(self, names: Mapping[str, str]) -> HydroDatabase:
        """Return a copy with bodies renamed, `names` = {old: new}.

        Raises
        ------
        DatabaseError
            An old name is unknown, or two bodies would get one name.
        """
        for old in names:
            co.check_body(old, self.bodies)
        new = {name: names.get(name, name) for name in self.bodies}
        if len(set(new.values())) != len(new):
            raise DatabaseError(f"two bodies would get the same name: {list(new.values())}")

        def rename(labels: Sequence[str]) -> tuple[str, ...]:
            return tuple(f"{new[c.rpartition('.')[0]]}.{c.rpartition('.')[2]}" for c in labels)

        return replace(
            self,
            coordinates=rename(self.coordinates),
            bodies={new[k]: replace(b, name=new[k]) for k, b in self.bodies.items()},
            kernel=None
            if self.kernel is None
            else replace(
                self.kernel,
                inputs=rename(self.kernel.inputs),
                outputs=rename(self.kernel.outputs),
            ),
            memory={
                key: replace(fit, inputs=rename(fit.inputs), outputs=rename(fit.outputs))
                for key, fit in self.memory.items()
            },
        )

    def moved_to(self, points: Mapping[str, ArrayLike]) -> HydroDatabase:
        """Return a copy about other reference points: X^T A X, X^T B X, X^T F.

        Waves keep their phase zero at the origin of the world: only moments change.

        Parameters
        ----------
        points : dict of (3,) arrays
            New reference point of each body to move, world [m].

        Raises
        ------
        DatabaseError
            Unknown body, unknown old reference point, or a coordinate that the move couples in is
            not in the database (`hydrodae.hdb.coordinates.transport`).
        """
        shifts: dict[str, Array] = {}
        bodies = dict(self.bodies)
        for name, value in points.items():
            old, new = self.reference_point(name), np.asarray(value, dtype=float)
            if new.shape != (3,):
                raise DatabaseError(f"reference point of {name!r} must be 3 numbers [m]")
            shifts[name] = old - new
            hs = bodies[name].hydrostatics
            moved = None if hs is None else hs.moved(old, new)
            bodies[name] = Body(name, new, moved)
        x = co.transport(self.coordinates, shifts)
        return replace(
            self,
            added_mass=x.T @ self.added_mass @ x,
            radiation_damping=x.T @ self.radiation_damping @ x,
            added_mass_inf=x.T @ self.added_mass_inf @ x,
            added_mass_inf_std=np.abs(x).T @ self.added_mass_inf_std @ np.abs(x),
            froude_krylov=self.froude_krylov @ x,
            diffraction=self.diffraction @ x,
            bodies=bodies,
            kernel=None if self.kernel is None else moved_kernel(self.kernel, shifts),
            memory={key: _moved_fit(key, fit, shifts) for key, fit in self.memory.items()},
        )

    def without_coupling(self) -> HydroDatabase:
        """Return a copy whose bodies radiate each for itself: blocks between bodies are zero.

        Fits and a stored kernel, which hold the coupling, are dropped; the excitation keeps the
        waves that the other bodies scatter.
        """
        body = np.array([label.rpartition(".")[0] for label in self.coordinates])
        own = body[:, None] == body
        return replace(
            self,
            added_mass=self.added_mass * own,
            radiation_damping=self.radiation_damping * own,
            added_mass_inf=self.added_mass_inf * own,
            added_mass_inf_std=self.added_mass_inf_std * own,
            repairs=(*self.repairs, "coupling: blocks of A and B between bodies set to zero"),
            kernel=None,
            memory={},
        )

    def with_hydrostatics(self, values: Mapping[str, Hydrostatics]) -> HydroDatabase:
        """Return a copy with the given hydrostatics of some bodies (moments about their points)."""
        bodies = dict(self.bodies)
        for name, value in values.items():
            co.check_body(name, bodies)
            bodies[name] = replace(bodies[name], hydrostatics=value)
        return replace(self, bodies=bodies)

    def write(self, path: str | Path, *, kernel: bool = True, single: bool = False) -> None:
        """Write `hydro.h5`; see `hydrodae.hdb.files.write`."""
        from hydrodae.hdb import files

        files.write(self, path, kernel=kernel, single=single)

    @classmethod
    def read(cls, path: str | Path) -> HydroDatabase:
        """Read `hydro.h5`; see `hydrodae.hdb.files.read`."""
        from hydrodae.hdb import files

        return files.read(path)

    def summary(self) -> str:
        """Return what is in the database, in words for a newcomer."""
        from hydrodae.hdb.summary import summary

        return summary(self)


def _selected_fits(
    fits: Mapping[str, ExponentialMemory], labels: Sequence[str]
) -> dict[str, ExponentialMemory]:
    kept = {}
    for key, fit in fits.items():
        columns = [i for i, label in enumerate(fit.inputs) if label in labels]
        rows = [i for i, label in enumerate(fit.outputs) if label in labels]
        if columns:
            kept[key] = replace(
                fit,
                inputs=tuple(fit.inputs[i] for i in columns),
                outputs=tuple(fit.outputs[i] for i in rows),
                input_matrix=fit.input_matrix[:, columns],
                output_matrix=fit.output_matrix[rows],
                added_mass_inf=fit.added_mass_inf[np.ix_(rows, columns)],
            )
    return kept


def _moved_fit(name: str, fit: ExponentialMemory, shifts: Mapping[str, Array]) -> ExponentialMemory:
    """Transport a fit: U_old = X U_new at its inputs, F_new = Y^T F_old at its outputs."""
    x = co.transport(fit.inputs, shifts, f"the inputs of fit {name!r}")
    y = co.transport(fit.outputs, shifts, f"the outputs of fit {name!r}")
    return replace(
        fit,
        input_matrix=fit.input_matrix @ x,
        output_matrix=y.T @ fit.output_matrix,
        added_mass_inf=y.T @ fit.added_mass_inf @ x,
    )
