"""Samples, scaling and weights of a memory fit: the stored points of a hydrodynamic database."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from hydrodae.errors import DatabaseError
from hydrodae.hdb.labels import read_labels
from hydrodae.hdb.memory.modes import Problem, Searches
from hydrodae.hdb.memory.vector_fitting import (
    Array,
    ComplexArray,
    Limits,
    Samples,
    relocate,
    solve_residues,
    starting_poles,
)

NOISE = 1e-8
"""A coordinate whose largest damping is below this share of the largest of its kind is left out."""
WEIGHT_FLOOR = 1e-2
"""|H| is taken as at least this share of its largest value in the weights."""
ENTRY_FLOOR = 1e-3
"""|H| is taken as at least this share of the largest entry (entries that symmetry makes zero)."""
UNIFORM_FLOOR = 0.12
"""Share of a uniform goal by which damping is kept from zero: it costs less to be passive then."""
ZERO_WEIGHT = 3.0
"""Weight of the row H(0) = 0 relative to the largest other weight of the entry."""


class RadiationData(Protocol):
    """What a fit reads of a hydrodynamic database (SI, rad/s)."""

    @property
    def coordinates(self) -> Sequence[str]:
        """Return the labels of the coordinates."""

    @property
    def omega(self) -> Any:
        """Return (nw,) frequencies."""

    @property
    def added_mass(self) -> Any:
        """Return (nw, n, n)."""

    @property
    def radiation_damping(self) -> Any:
        """Return (nw, n, n)."""


@dataclass(frozen=True)
class ImpedanceData:
    """Z = B + i omega A of the loads on `outputs` from the motion of `inputs`, SI.

    Attributes
    ----------
    omega
        (nw,) rad/s, positive and finite.
    square
        (nw, n_in, n_in), symmetrised, with B turned into the nearest one that takes energy.
    stored
        (nw, n_in, n_in), symmetrised, as it stands in the tables.
    rectangular
        (nw, n_extra, n_in): outputs that are no inputs.
    scale
        (n_in,) root of the largest damping of each input; 1 for those left out.
    active
        (n_in,) False for inputs without radiation damping (noise).
    extra
        Labels of the outputs that are no inputs.
    searches
        Of poles, made so far.
    """

    omega: Array
    square: ComplexArray
    stored: ComplexArray
    rectangular: ComplexArray
    scale: Array
    active: npt.NDArray[np.bool_]
    extra: tuple[str, ...]
    searches: Searches = field(default_factory=dict)


def gather(
    database: RadiationData, inputs: Sequence[str], outputs: Sequence[str], floor: float = 0.0
) -> ImpedanceData:
    """Read and check what a fit needs.

    Eigenvalues of B below `floor` times the largest are raised to that in `square`.

    Raises
    ------
    DatabaseError
        If a label is unknown or repeated, if data are not finite or if no input radiates.
    """
    labels = [str(label) for label in database.coordinates]
    for name, wanted in (("inputs", inputs), ("outputs", outputs)):
        if unknown := [label for label in wanted if label not in labels]:
            raise DatabaseError(
                f"memory fit: {name} {unknown} are not in the database (it has {', '.join(labels)})"
            ).about("label", unknown[0])
        if len(set(wanted)) != len(wanted) or not wanted:
            raise DatabaseError(
                f"memory fit: {name} must be given once each, got {list(wanted)}"
            ).about("option", name)
    if missing := [label for label in inputs if label not in outputs]:
        raise DatabaseError(f"memory fit: inputs {missing} must be among the outputs").about(
            "label", missing[0]
        )
    extra = tuple(label for label in outputs if label not in inputs)
    columns = [labels.index(label) for label in inputs]
    rows = columns + [labels.index(label) for label in extra]
    omega = np.asarray(database.omega, dtype=float)
    keep = np.isfinite(omega) & (omega > 0.0)
    omega = omega[keep]
    pick = np.ix_(np.nonzero(keep)[0], np.array(rows), np.array(columns))
    damping = np.asarray(database.radiation_damping, dtype=float)
    impedance = (
        damping[pick]
        + 1j * omega[:, None, None] * np.asarray(database.added_mass, dtype=float)[pick]
    )
    if not np.all(np.isfinite(impedance)):
        raise DatabaseError(
            "memory fit: added mass or radiation damping is not finite at some frequency"
        ).about("not_finite")
    if omega.size < 8 or np.any(np.diff(omega) <= 0.0):
        raise DatabaseError("memory fit: at least 8 ascending frequencies are needed").about(
            "frequencies"
        )
    n = len(columns)
    square = 0.5 * (impedance[:, :n] + impedance[:, :n].transpose(0, 2, 1))
    peaks = np.einsum("wii->wi", damping[keep]).max(axis=0)
    rotation = np.array([label.is_rotation for label in read_labels(labels)])
    largest = np.array([peaks[rotation == kind].max(initial=0.0) for kind in rotation])[columns]
    own = peaks[columns]
    active = (own > NOISE * largest) & (own > 0.0)
    if not np.any(active):
        raise DatabaseError(
            f"memory fit: none of {list(inputs)} has positive radiation damping"
        ).about("missing", "radiation_damping")
    scale = np.where(active, np.sqrt(np.maximum(own, 1e-300)), 1.0)
    return ImpedanceData(
        omega,
        _passive(square, scale, active, floor),
        square,
        impedance[:, n:],
        scale,
        active,
        extra,
    )


def _passive(
    square: ComplexArray, scale: Array, active: npt.NDArray[np.bool_], floor: float
) -> ComplexArray:
    """Raise the eigenvalues of the scaled B to 0 or to `floor` of the largest; A stays."""
    i = np.nonzero(active)[0]
    result = square.copy()
    at = np.ix_(np.arange(len(square)), i, i)
    result[at] = raised(scaled(square, scale, i), floor) * (scale[i] * scale[i][:, None])
    return result


def raised(matrices: ComplexArray, floor: float, largest: float = 0.0) -> ComplexArray:
    """Raise the eigenvalues of Re Z (nw, n, n) to 0 or to `floor` of the largest; Im Z stays.

    `largest` is the largest eigenvalue where it is not one of these matrices; else 0.
    """
    values, vectors = np.linalg.eigh(matrices.real)
    least = floor * (largest or values.max())
    damping = (vectors * np.maximum(values, least)[:, None]) @ vectors.transpose(0, 2, 1)
    return np.asarray(damping + 1j * matrices.imag)


def uncoupled_groups(
    data: ImpedanceData, tolerance: float
) -> tuple[list[npt.NDArray[np.int64]], float]:
    """Split the active inputs into groups (planar, lateral) whose coupling is below `tolerance`.

    Returns
    -------
    groups, neglected
        Indices of each group; the largest coupling left out: rms over omega of B_ij relative to the
        root of the product of the diagonal ones. (Of A only its change with frequency would count,
        which drowns in the noise of A where the waves are short.)
    """
    index = np.nonzero(data.active)[0]
    size = np.sqrt(np.mean(data.stored.real**2, axis=0))
    root = np.sqrt(np.diag(size))
    coupling = size / np.where(root > 0.0, root, 1.0) / np.where(root > 0.0, root, 1.0)[:, None]
    groups: list[set[int]] = []
    for i in index:
        linked = [group for group in groups if any(coupling[i, j] > tolerance for j in group)]
        groups = [group for group in groups if group not in linked] + [{int(i)}.union(*linked)]
    ordered = [np.array(sorted(group)) for group in sorted(groups, key=min)]
    apart = np.zeros_like(coupling, dtype=bool)
    for group in ordered:
        rest = np.setdiff1d(index, group)
        apart[np.ix_(group, rest)] = True
    return ordered, float(coupling[apart].max(initial=0.0))


def in_band(omega: Array, band: tuple[float, float]) -> npt.NDArray[np.bool_]:
    """Return which frequencies lie in the band."""
    return (omega >= band[0] - 1e-9) & (omega <= band[1] + 1e-9)


def weigh(
    value: ComplexArray, omega: Array, added_mass: Array, band: tuple[float, float], factor: float
) -> Array:
    """Return the weights |H|^(-1/2), times `factor` in the band, of Z (nw, ne) with A_inf (ne,)."""
    size = np.abs(value - 1j * omega[:, None] * added_mass)
    least = np.maximum(WEIGHT_FLOOR * size.max(axis=0), ENTRY_FLOOR * size.max())
    size = np.maximum(size, least)
    return np.asarray(size**-0.5 * np.where(in_band(omega, band), factor, 1.0)[:, None])


def with_zero(omega: Array, value: ComplexArray, weight: Array) -> Samples:
    """Append the row H(0) = 0."""
    return Samples(
        np.append(omega, 0.0),
        np.concatenate([value, np.zeros_like(value[:1])]),
        np.concatenate([weight, ZERO_WEIGHT * weight.max(axis=0, keepdims=True)]),
    )


def scaled(matrices: ComplexArray, scale: Array, pick: npt.NDArray[np.int64]) -> ComplexArray:
    """Return the rows and columns `pick` of (nw, n, n) over the scales of both."""
    return np.asarray(matrices[:, pick][:, :, pick] / scale[pick] / scale[pick][:, None])


def make_problem(
    omega: Array,
    matrices: ComplexArray,
    band: tuple[float, float],
    factor: float,
    added_mass: Array | None = None,
) -> Problem:
    """Weigh the scaled Z (nw, n, n), with A_inf given or from a first fit of moderate weights.

    Parameters
    ----------
    omega
        (nw,) rad/s.
    matrices
        (nw, n, n) scaled, symmetric.
    band, factor
        Where the weights are `factor` times larger, rad/s.
    added_mass
        (n, n) A_inf for the weights; None to estimate it.
    """
    n = matrices.shape[1]
    rows, columns = np.triu_indices(n)
    value = matrices[:, rows, columns]
    double = np.where(rows == columns, 1.0, np.sqrt(2.0))
    mass = (first_added_mass(omega, matrices, band) if added_mass is None else added_mass)[
        rows, columns
    ]
    samples = with_zero(omega, value, double * weigh(value, omega, mass, band, factor))
    return Problem(samples, rows, columns, n, Limits(omega, least_damping(omega)))


def least_damping(omega: Array) -> Array:
    """Return the least -Re p [1/s] of poles at the frequencies of the table, (nw,)."""
    return np.asarray(np.maximum(0.2 * np.gradient(omega), 1e-3 * omega[-1]))


def first_added_mass(omega: Array, matrices: ComplexArray, band: tuple[float, float]) -> Array:
    """Estimate A_inf (n, n) of the scaled Z (nw, n, n) by a vector fit with twelve poles."""
    n, limits = matrices.shape[1], Limits(omega, least_damping(omega))
    rows, columns = np.triu_indices(n)
    value = matrices[:, rows, columns]
    double = np.where(rows == columns, 1.0, np.sqrt(2.0))
    added_mass = value[-1].imag / omega[-1]
    poles = starting_poles(
        min(12, omega.size // 3 * 2), 2, max(omega[0], 0.02 * omega[-1]), omega[-1], 0.1, True
    )
    for _ in range(8):
        samples = with_zero(omega, value, double * weigh(value, omega, added_mass, band, 10.0))
        poles, _ = relocate(poles, samples, limits)
        added_mass = solve_residues(poles, samples)[-1]
    full = np.zeros((n, n))
    full[rows, columns] = full[columns, rows] = added_mass
    return full
