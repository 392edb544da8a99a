"""The common way from what a reader hands over to a `HydroDatabase`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.labels import bodies_of
from hydrodae.hdb.readers.source import TABLES, SourceData, sha256
from hydrodae.hdb.relations import infinity
from hydrodae.hdb.relations.entries import asymmetry, entry_scale, worst
from hydrodae.support.arrays import Array, Complex
from hydrodae.support.version import version

#: Halves of A or B further apart, over the diagonal, are no noise: a number is garbled.
GARBLED = 10.0
#: No water couples two motions by so many times what their own added masses allow.
EXCHANGED = 2.0
#: Median of surge, sway and heave, over the largest A, by which A_inf of a file may miss that of
#: its A and B; and where B still has half its peak at the last frequency, as of a table that ends
#: there: 0.37 of four frequencies.
FOREIGN, ENDS_EARLY = 0.3, 0.5
#: Couplings below this share of the largest added mass are noise.
LEAST_COUPLING = 0.02
#: Fewest frequencies with which A(0) and A(inf) can be compared.
LEAST_ROWS = 8


def finish(data: SourceData) -> HydroDatabase:
    """Symmetrise, split the excitation, estimate added_mass_inf; findings go to `data.findings`."""
    _drop_rows_with_nan(data)
    if data.omega.size < 4:
        raise DatabaseError(
            f"{data.omega.size} frequencies > 0; 4 are needed at least: "
            f"compute more where they come from"
        ).about("frequencies", file=data.name)
    asymmetry_finding(data)
    exchange_finding(data)
    uncoupled_finding(data)
    a = 0.5 * (data.added_mass + data.added_mass.transpose(0, 2, 1))
    b = 0.5 * (data.radiation_damping + data.radiation_damping.transpose(0, 2, 1))
    fk, diffraction, split = _split_excitation(data)
    a_inf, std, origin = _added_mass_inf(data, a, b)
    return HydroDatabase(
        coordinates=data.coordinates,
        omega=data.omega,
        added_mass=a,
        radiation_damping=b,
        added_mass_inf=a_inf,
        added_mass_inf_std=std,
        added_mass_inf_origin=origin,
        heading=data.heading,
        froude_krylov=fk,
        diffraction=diffraction,
        excitation_split=split,
        bodies={name: _body(data, name) for name in bodies_of(data.coordinates)},
        rho=data.rho,
        gravity=data.gravity,
        water_depth=data.water_depth,
        source=data.name,
        source_sha256=sha256(data.files),
        generator=f"hydrodae {version()}",
        title=data.title,
        extra=data.extra,
        second_order=data.second_order,
    )


def _body(data: SourceData, name: str) -> Body:
    point, found = data.reference_points.get(name), data.hydrostatics.get(name)
    if point is None:
        text = (
            f"{name}: the source does not say about which point its moments are; state it "
            f"(source_points, --origin {name}=x,y,z)"
        )
        data.findings.append(Finding("warning", "reference point", text))
    statics = None if found is None or point is None else found[0].moved(found[1], point)
    return Body(name, point, statics, data.meshes.get(name), data.mode_stiffness.get(name))


def _drop_rows_with_nan(data: SourceData) -> None:
    bad = np.zeros(data.omega.size, dtype=bool)
    for name in TABLES:
        value = getattr(data, name)
        if value is not None:
            bad |= ~np.isfinite(value).reshape(data.omega.size, -1).all(axis=1)
    if not bad.any():
        return
    where = ", ".join(f"{w:.4g}" for w in data.omega[bad][:6]) + (" ..." if bad.sum() > 6 else "")
    share = bad.mean()
    if share > 0.2 or (~bad).sum() < 4:
        raise DatabaseError(
            f"{bad.sum()} of {bad.size} frequencies hold NaN (w = {where} rad/s): the "
            f"computation behind it failed; repeat it"
        ).about("not_finite", file=data.name)
    text = f"{bad.sum()} of {bad.size} frequencies hold NaN and were dropped (w = {where} rad/s)"
    first = float(data.omega[bad][0])
    data.findings.append(Finding("warning", "NaN", text, float(share), first))
    data.keep_frequencies(~bad)


def asymmetry_finding(data: SourceData) -> None:
    """Report max |A - A^T| and |B - B^T| over the largest entry, with lengths scaled out."""
    for name in ("added_mass", "radiation_damping"):
        value, (w, i, j) = worst(asymmetry(getattr(data, name)))
        level = "error" if value > GARBLED else "warning" if value > 0.02 else "info"
        text = f"largest asymmetry {value:.2g} of the diagonal"
        if value > 0.02:
            text += f", between {data.coordinates[i]} and {data.coordinates[j]}"
        text += "; the mean of both halves is used"
        omega = float(data.omega[w])
        data.findings.append(Finding(level, f"symmetry of {name}", text, value, omega))


def exchange_finding(data: SourceData) -> None:
    """Report an added mass that couples two motions more than each has of its own.

    A_inf is positive definite, |A_ij|^2 <= A_ii A_jj; medians over the frequencies keep about to
    it, unless the rows or columns of two motions are exchanged.
    """
    size = np.median(np.abs(data.added_mass), axis=0)
    turning = np.array([c.endswith(("roll", "pitch", "yaw")) for c in data.coordinates])
    kinds = [turning == kind for kind in (False, True)]
    largest = [float(size[np.ix_(k, k)].max(initial=0.0)) for k in kinds]
    unit = np.sqrt(np.where(turning, largest[1], largest[0]))
    unit[unit <= 0.0] = np.inf
    scaled = size / np.outer(unit, unit)
    own = np.sqrt(np.diag(scaled))
    ratio = scaled / np.maximum(np.outer(own, own), 1e-12)
    np.fill_diagonal(ratio, 0.0)
    ratio[scaled < LEAST_COUPLING] = 0.0
    i, j = np.unravel_index(ratio.argmax(), ratio.shape)
    if ratio[i, j] > EXCHANGED:
        text = (
            f"that of {data.coordinates[i]} by {data.coordinates[j]} is {ratio[i, j]:.2g} times "
            f"what their own added masses allow: are rows or columns exchanged?"
        )
        data.findings.append(Finding("error", "coupling of added_mass", text, float(ratio[i, j])))


def uncoupled_finding(data: SourceData) -> None:
    """Report bodies that no entry of A and B couples: blocks left out, not zero by symmetry."""
    bodies = bodies_of(data.coordinates)
    body = np.array([bodies.index(label.body) for label in data.labels])
    filled = np.any(data.added_mass != 0.0, axis=0) | np.any(data.radiation_damping != 0.0, axis=0)
    radiates = [bool(filled[np.ix_(body == i, body == i)].any()) for i in range(len(bodies))]
    alone = [
        f"{bodies[i]} and {bodies[j]}"
        for i in range(len(bodies))
        for j in range(i)
        if radiates[i] and radiates[j]
        if not filled[np.ix_(body == i, body == j)].any()
    ]
    if alone:
        text = f"A and B hold nothing that couples {'; '.join(alone[:4])}: taken as zero"
        data.findings.append(Finding("warning", "coupling of bodies", text))


def _split_excitation(data: SourceData) -> tuple[Complex, Complex, bool]:
    fk, d, total = data.froude_krylov, data.diffraction, data.excitation

    def say(text: str, severity: str = "info") -> None:
        data.findings.append(Finding(severity, "excitation", text))

    if fk is not None and d is not None:
        if total is not None:
            data.findings.append(_sum_finding(data, fk, d, total))
        return fk, d, True
    if total is not None and d is not None:
        say("Froude-Krylov taken as excitation - diffraction")
        return total - d, d, True
    if total is not None and fk is not None:
        say("diffraction taken as excitation - Froude-Krylov")
        return fk, total - fk, True
    if total is not None:
        say("the source holds the total only; Froude-Krylov and diffraction are not separated")
        return np.zeros_like(total), total, False
    if d is not None or fk is not None:
        half = "diffraction" if d is not None else "Froude-Krylov"
        raise DatabaseError(
            f"only the {half} force is there; the excitation needs the other half too"
        ).about("missing", "excitation", file=data.name)
    say("the source holds no excitation: no waves can be used", "warning")
    data.heading = np.zeros(0)
    empty = np.zeros((data.omega.size, 0, len(data.coordinates)), dtype=complex)
    return empty, empty.copy(), True


def _sum_finding(data: SourceData, fk: Complex, d: Complex, total: Complex) -> Finding:
    scale = np.abs(total).max(axis=(0, 1))
    scale[scale <= 1e-6 * scale.max()] = np.inf
    value, (w, _, i) = worst(np.abs(fk + d - total) / scale)
    level = "error" if value > 0.01 else "info"
    text = f"largest difference {value:.2g} of the largest force, at {data.coordinates[i]}"
    return Finding(level, "excitation = FK + diffraction", text, value, float(data.omega[w]))


def _coupling_doubt(value: Array, std: Array) -> Array:
    """Uncertainty (n, n) whose couplings share the doubt of their diagonals.

    What is wrong with the motion of one coordinate is wrong with its coupling too:
    u_ij >= |r_ij| sqrt(u_ii u_jj) with the correlation r_ij = A_ij / sqrt(A_ii A_jj), at most 1.
    """
    correlation = np.minimum(np.abs(value) / entry_scale(value, 0.0), 1.0)
    own = np.sqrt(np.diag(std))
    return np.asarray(np.maximum(std, correlation * np.outer(own, own)))


def _mesh_doubt(a: Array) -> Array:
    """Uncertainty (n, n) of A that its asymmetry shows: half of it, at all frequencies alike.

    A coordinate is as uncertain as its worst coupling, scaled by the roots of the diagonals:
    errors of a mesh too coarse for a gap or a plate do not break Ogilvie's relation.
    """
    size = np.sqrt(np.abs(np.einsum("wii->wi", a)).max(axis=0))
    half = 0.5 * np.median(np.abs(a - a.transpose(0, 2, 1)), axis=0) / entry_scale(a)
    own = np.sqrt(half.max(axis=1)) * size
    return np.asarray(np.outer(own, own))


def _added_mass_inf(data: SourceData, a: Array, b: Array) -> tuple[Array, Array, str]:
    value, std = infinity.added_mass_inf(data.omega, a, b)
    value, std = 0.5 * (value + value.T), 0.5 * (std + std.T)
    _settle_limits(data, a, value, std)
    std = _coupling_doubt(value, std) + _mesh_doubt(data.added_mass)
    if data.added_mass_inf is None:
        return value, std, "Ogilvie's relation at low frequencies"
    given = 0.5 * (data.added_mass_inf + data.added_mass_inf.T)
    error, (i, j) = worst(np.abs(given - value) / entry_scale(given))
    level = "warning" if error > 0.05 else "info"
    text = (
        f"differs from Ogilvie's relation by up to {error:.2g} "
        f"({data.coordinates[i]}, {data.coordinates[j]}); the source's value is used"
    )
    going = [k for k, c in enumerate(data.coordinates) if c.endswith(("surge", "sway", "heave"))]
    own = np.abs(np.diag(given - value)) / np.maximum(np.abs(a).max(axis=0).diagonal(), 1e-300)
    damping = np.abs(b).diagonal(axis1=1, axis2=2)[:, going]
    rest = np.median(damping[-1] / np.maximum(damping.max(axis=0), 1e-300)) if going else 0.0
    if going and float(np.median(own[going])) > (ENDS_EARLY if rest > 0.5 else FOREIGN):
        level = "error"
        text += "; so far off are A and B of different columns, units or runs"
    data.findings.append(Finding(level, "added_mass_inf of the source", text, error))
    return given, np.abs(given - value), "source"


def _settle_limits(data: SourceData, a: Array, estimate: Array, doubt: Array) -> None:
    """Put A(0) and A(inf) of the source right where they were exchanged.

    Capytaine before 3.0 wrote these rows of `.1` the other way round. A (nw, n, n) at the lowest
    frequency is close to A(0), and Ogilvie's relation gives the estimate of A(inf), both (n, n).
    """
    zero, high = data.added_mass_zero, data.added_mass_inf
    if data.omega.size < LEAST_ROWS or (zero is None and high is None):
        return
    first, limit, room = np.diag(a[0]), np.diag(estimate), 3.0 * np.diag(doubt)
    # only coordinates whose two limits are apart can decide
    apart = np.abs(first - limit) > room + 0.1 * np.abs(first)

    def near(table: Array | None) -> NDArray[np.bool_]:
        """Report which diagonal entries are those of w = inf; none of a table that is not there."""
        off = np.inf if table is None else np.abs(np.diag(table) - limit)
        return np.asarray(off < room + 0.05 * np.abs(limit))[apart]

    exchanged = bool(apart.any()) and not near(high).any()
    if zero is not None:
        exchanged &= bool(near(zero).all())
    elif high is not None:
        exchanged &= np.allclose(np.diag(high)[apart], first[apart], rtol=0.02)
    if not exchanged:
        return
    data.added_mass_inf = zero
    text = "the rows of w = 0 and w = inf are exchanged (Capytaine before 3.0 wrote them so)"
    data.findings.append(Finding("warning", "added_mass_inf of the source", f"{text}; put right"))
