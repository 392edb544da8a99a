"""Tables that a source holds beside A, B and F, kept word for word: Kochin functions, drift forces.

They stay in the convention of the source (Capytaine: e^{-iwt}, the source's names, reference points
and frequencies), whatever is moved, renamed or cut in the database.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import h5py
import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.support.arrays import Array, Complex

if TYPE_CHECKING:
    import xarray as xr

#: Attribute of the netCDF file: frequencies [rad/s] that were solved with FinGreen3D.
SHALLOW = "shallow_omega"
KEPT = ("kochin", "drift")
"""Variables of Capytaine whose names hold one of these words are kept."""


@dataclass(frozen=True)
class SourceTable:
    """A table of the source.

    Attributes
    ----------
    values : array
        Real or complex.
    dims : tuple of str
        Name of each dimension, as "omega", "radiating_dof", "wave_direction", "theta".
    axes : dict of arrays
        Values along the dimensions that have some: numbers [rad/s, rad] or labels.
    """

    values: Array | Complex
    dims: tuple[str, ...]
    axes: Mapping[str, Array | tuple[str, ...]]

    def to_xarray(self) -> xr.DataArray:
        """Return the table with its axes."""
        import xarray as xr

        coords = {
            name: list(axis) if isinstance(axis, tuple) else axis
            for name, axis in self.axes.items()
        }
        return xr.DataArray(self.values, dims=self.dims, coords=coords)


def kept_tables(dataset: xr.Dataset) -> dict[str, SourceTable]:
    """Return what a file of Capytaine holds of them, real and imaginary parts joined."""
    found = {}
    for name, variable in dataset.data_vars.items():
        if not any(word in str(name).lower() for word in KEPT):
            continue
        if "complex" in variable.dims:
            values = variable.transpose("complex", ...).values
            parts = [label_text(c) for c in variable["complex"].values]
            both = values[parts.index("re")] + 1j * values[parts.index("im")]
            dims = tuple(str(d) for d in variable.dims if d != "complex")
        else:
            both, dims = variable.values, tuple(str(d) for d in variable.dims)
        if both.dtype.kind not in "fiuc":
            continue
        axes = {d: _axis(variable[d].values) for d in dims if d in variable.coords}
        kind = complex if np.iscomplexobj(both) else float
        found[str(name)] = SourceTable(np.asarray(both, dtype=kind), dims, axes)
    return found


def shallow_findings(data: xr.Dataset) -> list[Finding]:
    """Report the frequencies of a netCDF file that were solved with FinGreen3D."""
    omega = np.atleast_1d(data.attrs.get(SHALLOW, []))
    if not omega.size:
        return []
    text = (
        f"{omega.size} frequencies up to {omega.max():.4g} rad/s have waves too long for "
        f"Capytaine's usual Green function of a finite depth: solved with FinGreen3D, without a "
        f"lid, to some per cent"
    )
    return [Finding("warning", "shallow water", text, omega=float(omega.max()))]


def write_extra(group: h5py.Group, tables: Mapping[str, SourceTable]) -> None:
    """Write each table as a group: values, the names of its dimensions, and their axes."""
    for name, table in tables.items():
        target = group.create_group(name)
        target.attrs["dims"] = ",".join(table.dims)
        target.attrs["convention"] = "as in the source"
        target.create_dataset("values", data=table.values, compression="gzip")
        for dim, axis in table.axes.items():
            data = np.array(axis, dtype="S64") if isinstance(axis, tuple) else axis
            target.create_dataset(f"axis_{dim}", data=data)


def read_extra(group: h5py.Group) -> dict[str, SourceTable]:
    """Read what `write_extra` wrote.

    Raises
    ------
    DatabaseError
        The number of dimensions or the length of an axis does not fit the table.
    """
    found = {}
    for name, node in group.items():
        values, dims = node["values"][()], tuple(str(node.attrs["dims"]).split(","))
        if len(dims) != values.ndim:
            raise DatabaseError(f"{node.name}: {values.ndim} dimensions, named {dims}").about(
                "shape", node.name, file=group.file.filename
            )
        axes = {}
        for dim, length in zip(dims, values.shape, strict=True):
            if f"axis_{dim}" in node:
                axes[dim] = _axis(node[f"axis_{dim}"][()])
                if len(axes[dim]) != length:
                    raise DatabaseError(
                        f"{node.name}: {len(axes[dim])} values of {dim}, expected {length}"
                    ).about("shape", node.name, file=group.file.filename)
        found[name] = SourceTable(values, dims, axes)
    return found


def _axis(values: NDArray[np.generic]) -> Array | tuple[str, ...]:
    if values.dtype.kind in "fiu":
        return np.asarray(values, dtype=float)
    return tuple(label_text(value) for value in values)


def label_text(value: object) -> str:
    """Return a label, which files may hold as bytes."""
    return value.decode() if isinstance(value, bytes) else str(value)
