"""The radiation kernel K(t) as the convolution uses it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import coordinates as co
from hydrodae.support.arrays import Array, Complex


@dataclass(frozen=True)
class RadiationKernel:
    """K(t) of loads on `outputs` from velocities of `inputs`.

    Attributes
    ----------
    time : (nt,) array
        Uniform from 0 to T [s].
    values : (nt, n_out, n_in) array
        K, not tapered [N/m, N, N m]; zero where there is no coupling.
    inputs, outputs : tuple of str
        Labels "<body>.<dof>"; outputs contain the inputs.
    added_mass_inf : (n_out, n_in) array
        [kg, kg m, kg m2].
    report : dict
        How it was made, and its error of H; see `hydrodae.hdb.database.radiation_kernel`.
    """

    time: Array
    values: Array
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    added_mass_inf: Array
    report: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        nt, n_out, n_in = self.time.size, len(self.outputs), len(self.inputs)
        shapes = (self.values.shape, self.added_mass_inf.shape)
        if shapes != ((nt, n_out, n_in), (n_out, n_in)):
            raise DatabaseError(
                f"radiation kernel: shapes {shapes} do not fit {nt} times, {n_out} outputs, "
                f"{n_in} inputs"
            ).about("shape", "radiation_kernel")
        if missing := [label for label in self.inputs if label not in self.outputs]:
            raise DatabaseError(
                f"radiation kernel: inputs {missing} are not among the outputs"
            ).about("label", "radiation_kernel")

    @property
    def length(self) -> float:
        """T [s]."""
        return float(self.time[-1])

    def tapered(self) -> Array:
        """K as the convolution uses it, (nt, n_out, n_in)."""
        return self.values * taper(self.time)[:, None, None]

    def transfer(self, omega: Array) -> Complex:
        """H(iw) = int_0^T K e^{-iwt} dt of the kernel as it is used, (nw, n_out, n_in)."""
        return transform(self.time, self.tapered(), np.asarray(omega, dtype=float))

    def selected(self, labels: Sequence[str]) -> RadiationKernel | None:
        """Return the part of these coordinates, None if none of them moves."""
        columns = [i for i, label in enumerate(self.inputs) if label in labels]
        rows = [i for i, label in enumerate(self.outputs) if label in labels]
        if not columns:
            return None
        return RadiationKernel(
            self.time,
            self.values[:, rows][:, :, columns],
            tuple(self.inputs[i] for i in columns),
            tuple(self.outputs[i] for i in rows),
            self.added_mass_inf[np.ix_(rows, columns)],
            self.report,
        )


def taper(time: Array) -> Array:
    """Return the squared cosine that lets K down to zero over the last tenth, (nt,)."""
    late = np.clip((time / time[-1] - 0.9) / 0.1, 0.0, 1.0)
    return np.asarray(np.cos(0.5 * np.pi * late) ** 2)


def moved_kernel(kernel: RadiationKernel, shifts: Mapping[str, Array]) -> RadiationKernel:
    """Transport to new reference points: U_old = X U_new, F_new = Y^T F_old."""
    x = co.transport(kernel.inputs, shifts, "the inputs of the radiation kernel")
    y = co.transport(kernel.outputs, shifts, "the outputs of the radiation kernel")
    return RadiationKernel(
        kernel.time,
        y.T @ kernel.values @ x,
        kernel.inputs,
        kernel.outputs,
        y.T @ kernel.added_mass_inf @ x,
        kernel.report,
    )


def transform(time: Array, values: Array, omega: Array) -> Complex:
    """Return int values e^{-iwt} dt by the trapezoid on a spline four times as fine.

    The times of the fine grid are t = t_a + t_b: sums over the t_b of each t_a come first, then one
    over the t_a, so that few exponentials are needed.
    """
    fine = np.linspace(0.0, time[-1], 4 * (time.size - 1) + 1)
    out = np.zeros((omega.size, *values.shape[1:]), dtype=complex)
    flat = values.reshape(time.size, -1)
    coupled = np.flatnonzero(np.any(flat != 0.0, axis=0))
    width = int(np.ceil(np.sqrt(fine.size)))
    rows = -(-fine.size // width)
    table = np.zeros((rows * width, coupled.size))
    table[: fine.size] = CubicSpline(time, flat[:, coupled])(fine) * fine[1]
    table[[0, fine.size - 1]] *= 0.5
    table = table.reshape(rows, width, -1).transpose(1, 0, 2).reshape(width, -1)
    inner, outer = fine[:width], fine[1] * width * np.arange(rows)
    result = np.empty((omega.size, coupled.size), dtype=complex)
    for part in np.array_split(np.arange(omega.size), omega.size * table.shape[1] // 1_000_000 + 1):
        w = omega[part, None]
        first = np.exp(-1j * w * inner)
        sums = (first.real @ table + 1j * (first.imag @ table)).reshape(part.size, rows, -1)
        result[part] = np.einsum("wa,wam->wm", np.exp(-1j * w * outer), sums)
    out.reshape(omega.size, -1)[:, coupled] = result
    return out
