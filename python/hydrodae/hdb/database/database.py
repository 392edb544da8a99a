"""The hydrodynamic database in memory: its tables, and what can be done with them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import coordinates as co
from hydrodae.hdb.database import files
from hydrodae.hdb.database.convolution import moved_kernel
from hydrodae.hdb.database.radiation_kernel import LIMIT, make_kernel
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.hdb.database.summary import summary
from hydrodae.hdb.database.tables import Body, Tables
from hydrodae.hdb.hull.hydrostatics import Hydrostatics
from hydrodae.hdb.labels import bodies_of, modes_of, read_labels
from hydrodae.support.arrays import Array

if TYPE_CHECKING:
    from hydrodae.hdb.memory import ExponentialMemory


class HydroDatabase(Tables):
    """Frequency-domain hydrodynamics of one or more bodies.

    Its arguments and attributes are those of `hydrodae.hdb.database.tables.Tables`; a method that
    changes something returns a copy.
    """

    def with_kernel(
        self,
        inputs: Sequence[str] | None = None,
        outputs: Sequence[str] | None = None,
        *,
        length: float | None = None,
        band: tuple[float, float] | None = None,
        limit: float = LIMIT,
    ) -> Self:
        """Return a copy that stores K of these inputs (default: all coordinates).

        See `hydrodae.hdb.database.radiation_kernel.make_kernel`.
        """
        labels = self.coordinates if inputs is None else inputs
        made = make_kernel(self, labels, outputs, length=length, band=band, limit=limit)
        return replace(self, kernel=made)

    def select(self, labels: Sequence[str]) -> Self:
        """Return a copy with these coordinates only, in this order: the others are locked.

        Fits keep those of their inputs and outputs that remain; a fit without inputs is dropped.
        """
        i = self.index(labels)
        square = np.ix_(i, i)
        keep = bodies_of(labels)
        return replace(
            self,
            coordinates=tuple(labels),
            added_mass=self.added_mass[:, i][:, :, i],
            radiation_damping=self.radiation_damping[:, i][:, :, i],
            added_mass_inf=self.added_mass_inf[square],
            added_mass_inf_std=self.added_mass_inf_std[square],
            froude_krylov=self.froude_krylov[:, :, i],
            diffraction=self.diffraction[:, :, i],
            bodies={name: _with_selected_modes(self, name, labels) for name in keep},
            kernel=None if self.kernel is None else self.kernel.selected(labels),
            memory=_selected_fits(self.memory, labels),
            second_order={
                kind: kept
                for kind, table in self.second_order.items()
                if (kept := table.selected(labels)) is not None
            },
        )

    def reordered(self, labels: Sequence[str]) -> Self:
        """Return a copy with the coordinates in this order.

        Raises
        ------
        DatabaseError
            `labels` is not a permutation of the coordinates.
        """
        if sorted(labels) != sorted(self.coordinates):
            self.index(labels)
            missing = [c for c in self.coordinates if c not in labels]
            raise DatabaseError(f"not a permutation of the coordinates; missing: {missing}").about(
                "label", "coordinates"
            )
        return self.select(labels)

    def renamed(self, names: Mapping[str, str]) -> Self:
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
            raise DatabaseError(f"two bodies would get the same name: {list(new.values())}").about(
                "label", "names"
            )

        def rename(labels: Sequence[str]) -> tuple[str, ...]:
            return tuple(f"{new[c.body]}.{c.motion}" for c in read_labels(labels))

        return replace(
            self,
            coordinates=rename(self.coordinates),
            bodies={new[k]: replace(b, name=new[k]) for k, b in self.bodies.items()},
            kernel=None
            if self.kernel is None
            else replace(
                self.kernel, inputs=rename(self.kernel.inputs), outputs=rename(self.kernel.outputs)
            ),
            memory={
                key: replace(fit, inputs=rename(fit.inputs), outputs=rename(fit.outputs))
                for key, fit in self.memory.items()
            },
            second_order={
                kind: replace(table, coordinates=rename(table.coordinates))
                for kind, table in self.second_order.items()
            },
        )

    def moved_to(self, points: Mapping[str, ArrayLike]) -> Self:
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
            not in the database (`hydrodae.hdb.database.coordinates.transport`).
        """
        shifts: dict[str, Array] = {}
        bodies = dict(self.bodies)
        for name, value in points.items():
            old, new = self.reference_point(name), np.asarray(value, dtype=float)
            if new.shape != (3,):
                raise DatabaseError(f"reference point of {name!r} must be 3 numbers [m]").about(
                    "point", name
                )
            shifts[name] = old - new
            hs = bodies[name].hydrostatics
            moved = None if hs is None else hs.moved(old, new)
            stiffness = bodies[name].mode_stiffness
            if stiffness is not None:
                turn = np.eye(len(stiffness))
                turn[:3, 3:6] = -co.skew(shifts[name])
                stiffness = turn.T @ stiffness @ turn
            bodies[name] = replace(
                bodies[name], reference_point=new, hydrostatics=moved, mode_stiffness=stiffness
            )
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
            second_order={kind: t.moved(shifts) for kind, t in self.second_order.items()},
        )

    def at_frequencies(self, kept: NDArray[np.bool_]) -> Self:
        """Return a copy with the tables at some of the frequencies, `kept` (nw,)."""
        return replace(
            self,
            omega=self.omega[kept],
            added_mass=self.added_mass[kept],
            radiation_damping=self.radiation_damping[kept],
            froude_krylov=self.froude_krylov[kept],
            diffraction=self.diffraction[kept],
        )

    def without_coupling(self, near: NDArray[np.bool_] | None = None) -> Self:
        """Return a copy whose bodies radiate each for itself: blocks between bodies are zero.

        Fits and a stored kernel, which hold the coupling, are dropped; the excitation keeps the
        waves that the other bodies scatter.

        Parameters
        ----------
        near : (nb, nb) array of bool, optional
            Pairs of `bodies` whose blocks are kept; default: none but each with itself.
        """
        names = list(self.bodies)
        body = [names.index(label.body) for label in self.labels]
        own = (np.eye(len(names), dtype=bool) if near is None else near)[np.ix_(body, body)]
        which = "between bodies" if near is None else "of far bodies"
        return replace(
            self,
            added_mass=self.added_mass * own,
            radiation_damping=self.radiation_damping * own,
            added_mass_inf=self.added_mass_inf * own,
            added_mass_inf_std=self.added_mass_inf_std * own,
            repairs=(*self.repairs, f"coupling: blocks of A and B {which} set to zero"),
            kernel=None,
            memory={},
        )

    def with_hydrostatics(self, values: Mapping[str, Hydrostatics]) -> Self:
        """Return a copy with the given hydrostatics of some bodies (moments about their points)."""
        bodies = dict(self.bodies)
        for name, value in values.items():
            co.check_body(name, bodies)
            bodies[name] = replace(bodies[name], hydrostatics=value)
        return replace(self, bodies=bodies)

    def with_second_order(self, tables: Mapping[str, SecondOrderTable]) -> Self:
        """Return a copy with tables of second order, in place of those of the same kinds."""
        return replace(self, second_order={**self.second_order, **tables})

    def with_meshes(self, panels: Mapping[str, ArrayLike]) -> Self:
        """Return a copy that keeps the wetted surfaces (n, 4, 3) [m] of some bodies.

        Shapes of modes on their former surfaces are left out.
        """
        bodies = dict(self.bodies)
        for name, value in panels.items():
            co.check_body(name, bodies)
            mesh = np.asarray(value, dtype=float)
            bodies[name] = replace(bodies[name], mesh=mesh, mode_shapes=None)
        return replace(self, bodies=bodies)

    def with_mode_shapes(self, shapes: Mapping[str, Mapping[str, ArrayLike]]) -> Self:
        """Return a copy that keeps the shapes of all modes of some bodies, for pictures.

        Parameters
        ----------
        shapes : mapping
            Displacements (n, 4, 3) of the corners of the wetted surface per unit of a mode [-], by
            the name of the body and that of its mode.

        Raises
        ------
        DatabaseError
            No such body, a mode without a shape, or shapes that do not fit the surface.
        """
        bodies = dict(self.bodies)
        for name, given in shapes.items():
            co.check_body(name, bodies)
            modes = modes_of(name, self.coordinates)
            if set(given) != set(modes):
                raise DatabaseError(
                    f"shapes of {', '.join(given)} of {name!r}: expected those of its modes "
                    f"{', '.join(modes)}"
                ).about("label", name)
            found = np.array([given[mode] for mode in modes], dtype=float)
            bodies[name] = replace(bodies[name], mode_shapes=found)
        return replace(self, bodies=bodies)

    def write(self, path: str | Path, *, kernel: bool = True, single: bool = False) -> None:
        """Write `hydro.h5`; see `hydrodae.hdb.database.files.write`."""
        files.write(self, path, kernel=kernel, single=single)

    @classmethod
    def read(cls, path: str | Path) -> Self:
        """Read `hydro.h5`; see `hydrodae.hdb.database.files.read`."""
        return cls(**files.read(path))

    def summary(self) -> str:
        """Return what is in the database, in words for a newcomer."""
        return summary(self)


def _with_selected_modes(database: Tables, name: str, labels: Sequence[str]) -> Body:
    """The body with hydrostatics and shapes of the modes among the labels alone."""
    body, kept = database.bodies[name], modes_of(name, labels)
    if body.mode_stiffness is None or not kept:
        return replace(body, mode_stiffness=None, mode_shapes=None)
    modes = modes_of(name, database.coordinates)
    places = [modes.index(mode) for mode in kept]
    rows = [*range(6), *(6 + place for place in places)]
    shapes = None if body.mode_shapes is None else body.mode_shapes[places]
    stiffness = body.mode_stiffness[np.ix_(rows, rows)]
    return replace(body, mode_stiffness=stiffness, mode_shapes=shapes)


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
