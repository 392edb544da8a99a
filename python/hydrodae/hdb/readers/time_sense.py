r"""Files of one format by programs with other signs, recognised by physics.

In x(t) = Re(X e^{+iwt}) a body that is small against the waves feels, about its own place,

    F_1 = + i |F_1| sign(cos beta),   F_3 = K_33 - w^2 (rho V + A_33) + i w B_33,

so that conjugate phases (the other time convention) turn the signs of both F_1 and Im F_3;
headings from where the waves come turn that of F_1 only. Files hold forces of both conventions,
too: then excitation = Froude-Krylov + diffraction after some of them are conjugated. Normals out of
the water instead of out of the body turn the Froude-Krylov force alone: F_1 -> - F_1, F_3 -> - F_3.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import bodies_of
from hydrodae.hdb.readers.source import SourceData
from hydrodae.hdb.relations.dispersion import phase_at
from hydrodae.hdb.relations.noise import scatter
from hydrodae.support.arrays import Complex

#: So many of the lowest frequencies are looked at.
LONGEST = 10
#: Force over its noise from which its phase says anything.
CLEAR = 5.0


#: Error of excitation = Froude-Krylov + diffraction, of the largest force, that is print accuracy,
#: and one that is not.
ADDS_UP, MISSES = 1e-3, 1e-2
#: The three forces by their words in `--time-convention`.
PARTS = {"excitation": "excitation", "froude-krylov": "froude_krylov", "diffraction": "diffraction"}
#: What may be said of them.
FORMAT, OTHER = "format", "other"


def correct_time_sense(data: SourceData, stated: str | None = None) -> None:
    """Conjugate the forces that are of the other convention than the format has, and report it.

    Parameters
    ----------
    data : SourceData
        Changed in place: forces, findings.
    stated : str, optional
        What the user says: "format", "other", or the same of each force, as in
        "froude-krylov=other,diffraction=other". Else physics decides, if it can: all bodies must
        agree.

    Raises
    ------
    DatabaseError
        Other words, or a force that the source has not.
    """
    if stated is not None:
        for name, word in _statement(data, stated).items():
            if word == OTHER:
                _conjugate(data, [name])
        return
    if not data.heading.size or _correct_froude_krylov(data):
        return
    odd = _of_another_sense(data)
    if odd is not None:
        _settle_odd(data, odd)
        return
    force = data.excitation if data.excitation is not None else data.diffraction
    if force is None:
        return
    bodies = bodies_of(data.coordinates)
    horizontal = [s for body in bodies if (s := _horizontal(data, force, body)) is not None]
    # waves that other bodies scatter hide it
    alone = bodies if len(bodies) == 1 else ()
    vertical = [s for body in alone if (s := _vertical(data, force, body)) is not None]
    if not horizontal or not vertical or max(horizontal) > -0.5 or max(vertical) > -0.5:
        return
    _conjugate(data, list(PARTS.values()))
    text = (
        "surge and heave lag where they must lead: the phases are of the other time "
        "convention than the format has, and are taken so (--time-convention other)"
    )
    data.findings.append(Finding("warning", "time convention", text))


def _statement(data: SourceData, stated: str) -> Mapping[str, str]:
    """What the user says of each force of the source, by its name there."""
    there = [word for word, name in PARTS.items() if getattr(data, name) is not None]
    if stated in (FORMAT, OTHER):
        return {PARTS[word]: stated for word in there}
    found = {}
    for item in stated.split(","):
        word, equals, value = item.strip().partition("=")
        if not equals or word not in PARTS or value not in (FORMAT, OTHER):
            raise DatabaseError(
                f"time convention {item.strip()!r}: expected format or other, for all forces or as "
                f"in froude-krylov=other,diffraction=other"
            ).about("option", "time_convention")
        if word not in there:
            raise DatabaseError(
                f"time convention of {word}: the source holds {', '.join(there) or 'no forces'}"
            ).about("missing", word)
        found[PARTS[word]] = value
    return found


def _conjugate(data: SourceData, names: list[str]) -> None:
    for name in names:
        value = getattr(data, name)
        if value is not None:
            setattr(data, name, np.conj(value))


def _of_another_sense(data: SourceData) -> list[str] | None:
    """Forces whose sense is not that of the excitation: conjugated, the three add up."""
    total, fk, scattered = data.excitation, data.froude_krylov, data.diffraction
    if total is None or fk is None or scattered is None:
        return None
    scale = np.nanmax(np.abs(total), axis=(0, 1), initial=0.0)
    scale[scale <= 1e-6 * scale.max(initial=0.0)] = np.inf

    def missed(turned: tuple[bool, ...]) -> float:
        one, other = (np.conj(f) if t else f for f, t in zip((fk, scattered), turned, strict=True))
        return float(np.nanmax(np.abs(one + other - total) / scale, initial=0.0))

    if missed((False, False)) < MISSES:
        return None
    right = [t for t in product((False, True), repeat=2) if missed(t) < ADDS_UP]
    if len(right) != 1:
        return None
    names = ("froude_krylov", "diffraction")
    return [name for name, turned in zip(names, right[0], strict=True) if turned]


def _settle_odd(data: SourceData, odd: list[str]) -> None:
    """Bring the three forces to one sense: that in which the total pushes before the crest.

    Headings from where the waves come would turn all three alike: here the surge force decides.
    """
    total = data.excitation
    assert total is not None  # `_of_another_sense`
    bodies = bodies_of(data.coordinates)
    sine = [s for body in bodies if (s := _horizontal(data, total, body)) is not None]
    if not sine or min(np.abs(sine)) < 0.5 or min(sine) < 0.0 < max(sine):
        return
    turned = odd if sine[0] > 0.0 else [name for name in PARTS.values() if name not in odd]
    _conjugate(data, turned)
    words = [word for word, name in PARTS.items() if name in turned]
    text = (
        f"{' and '.join(words)}: of the other time convention than the rest of the file (the sum "
        f"and the surge force show it), and taken so "
        f"(--time-convention {','.join(f'{w}=other' for w in words)})"
    )
    data.findings.append(Finding("warning", "time convention", text))


def _correct_froude_krylov(data: SourceData) -> bool:
    """Turn the sign of the Froude-Krylov force that excitation and diffraction imply, if wrong.

    SeaFEM writes no Froude-Krylov file, and its excitation is diffraction minus Froude-Krylov.
    """
    total, scattered = data.excitation, data.diffraction
    if data.froude_krylov is not None or total is None or scattered is None:
        return False
    force = total - scattered
    bodies = bodies_of(data.coordinates)
    sine = [s for body in bodies if (s := _horizontal(data, force, body)) is not None]
    heave = [
        float(np.real(_local(data, force, body, 0)[0, data.coordinates.index(f"{body}.heave")]))
        for body in bodies
        if f"{body}.heave" in data.coordinates
    ]
    if not sine or not heave or max(sine) > -0.9 or max(heave) >= 0.0:
        return False
    data.froude_krylov = -force
    data.excitation = None
    text = (
        "the Froude-Krylov force that excitation minus diffraction gives pulls where it must push "
        "(as SeaFEM writes it): its sign is turned"
    )
    data.findings.append(Finding("warning", "time convention", text))
    return True


def _local(data: SourceData, force: Complex, body: str, heading: int) -> Complex:
    """Force of one heading with the phase zero at the body, (nw, n)."""
    point = data.reference_points.get(body)
    if point is None:
        return force[:, heading]
    beta = data.heading[heading]
    phase = phase_at(point, data.omega, beta, data.water_depth, data.gravity)
    return np.asarray(force[:, heading] * np.exp(1j * phase)[:, None])


def _horizontal(data: SourceData, force: Complex, body: str) -> float | None:
    """Sine of the phase of surge (or sway) in the longest wave: +1 expected."""
    along = np.maximum(np.abs(np.cos(data.heading)), np.abs(np.sin(data.heading)))
    h = int(along.argmax())
    cosine, sine = np.cos(data.heading[h]), np.sin(data.heading[h])
    dof, factor = ("surge", cosine) if abs(cosine) > 0.5 else ("sway", sine)
    label = f"{body}.{dof}"
    if label not in data.coordinates:
        return None
    values = _local(data, force, body, h)[:, data.coordinates.index(label)]
    known = np.isfinite(values) & (values != 0.0)
    omega, values = data.omega[known], values[known]
    clear = np.flatnonzero(np.abs(values[:LONGEST]) > CLEAR * scatter(omega, values))
    if not clear.size:
        return None
    return float(np.sin(np.angle(values[clear[0]] * np.sign(factor))))


def _vertical(data: SourceData, force: Complex, body: str) -> float | None:
    """Sign of Im F3 / (w B33) of one body in the longest waves; None where its size is not 1."""
    label = f"{body}.heave"
    if label not in data.coordinates:
        return None
    i = data.coordinates.index(label)
    value = _local(data, force, body, 0)[:LONGEST, i].imag
    waves = (data.omega * data.radiation_damping[:, i, i])[:LONGEST]
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = value / waves
    known = np.isfinite(force[:, 0, i])
    noise = float(scatter(data.omega[known], force[known, 0, i]))
    ratio = ratio[np.isfinite(ratio) & (np.abs(value) > CLEAR * noise)]
    if ratio.size == 0 or np.abs(np.abs(ratio) - 1.0).min() > 0.2:
        return None
    return float(np.sign(ratio[np.abs(np.abs(ratio) - 1.0).argmin()]))
