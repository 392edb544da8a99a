"""Slow motion of a linearised case by the loads of pairs of its waves."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from hydrodae.linear import LinearModel
from hydrodae.linear.response import moves, unit_of
from hydrodae.study.slow.loads import SlowLoads, word_of
from hydrodae.support.arrays import Array, Complex

#: Frequencies of the response, equal steps, and about each natural frequency on both sides: the
#: nearest is 1e-4 of it away, which resolves damping ratios of 1e-3.
STEPS, ABOUT = 400, np.geomspace(1e-4, 1.0, 60)
#: Least stiffness against the largest of its unit, below which nothing holds a motion.
HELD = 1e-9
#: Frequency of what states and delays of forces hold at rest [rad/s].
STILL = 1e-6
#: Pairs of more components are too many: as in runs.
MOST = 3000


@dataclass(frozen=True)
class SlowMotion:
    """Loads of pairs of waves at differences of frequencies, and the motion by them.

    Attributes
    ----------
    word : str
        Of the case: "mean", "newman" or "difference".
    labels : tuple of str
        n hydrodynamic coordinates that move, `<body>.<motion>` of the database.
    mean : (n,) array
        Mean loads [N, N m], in the axes of the tables (turned by the mean yaw of each body).
    omega : (w,) array
        Differences of frequencies [rad/s]; empty where the sea is no continuous one.
    spectrum : (w, n) array
        One-sided spectra of the loads [N2 s, N2 m2 s].
    load_deviation : (n,) array
        Standard deviation of the loads about their mean [N, N m].
    offset : dict
        Mean offset of each coordinate of bodies and joints by its channel [m, rad]; empty where
        nothing holds the device against the mean loads.
    standard_deviation : dict
        Of the slow motion about it [m, rad]; empty without it.
    notes : list of str
        What is left out.
    """

    word: str
    labels: tuple[str, ...]
    mean: Array
    omega: Array
    spectrum: Array
    load_deviation: Array
    offset: dict[str, float] = field(default_factory=dict)
    standard_deviation: dict[str, float] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def slow_motion(model: LinearModel, damping: Array | None = None) -> SlowMotion | None:
    """Return slow loads and motion of a linearised case in its sea.

    None without such loads, or where they load no coordinate that moves.

    Parameters
    ----------
    model : LinearModel
    damping : (n_u, n_u) array, optional
        Damping beside that of the model.

    Raises
    ------
    CaseError
        The tables do not cover the waves of the case.
    """
    word = word_of(model)
    if not word:
        return None
    loads = SlowLoads(model, word)
    if not loads.parts:
        return None
    mean = loads.mean()
    notes = [loads.sea.lost_text] if loads.sea.lost > 0.0 else []
    omega, spectrum = np.zeros(0), np.zeros((0, mean.size, mean.size), dtype=complex)
    if loads.sea.width > 0.0 and word != "mean":
        omega, spectrum = loads.spectrum()
    diagonal = np.einsum("wii->wi", spectrum).real
    deviation = np.sqrt(np.trapezoid(diagonal, omega, axis=0))
    offset = _offset(model, mean)
    motion: dict[str, float] = {}
    if not offset:
        notes.append("nothing holds the device against its mean drift: it has no mean offset")
    elif word == "mean":
        motion = dict.fromkeys(offset, 0.0)
    elif loads.sea.width > 0.0:
        w, response = _response(model, damping, float(omega[-1]))
        motion = _in_continuous_sea(w, response, omega, spectrum, offset)
    elif loads.sea.omega.size > MOST:
        notes.append(f"pairs of {loads.sea.omega.size} waves are too many for the slow motion")
    else:
        motion, deviation = _by_components(model, damping, loads, offset)
    return SlowMotion(
        word, model.hydro_labels, mean, omega, diagonal, deviation, offset, motion, notes
    )


def _names(model: LinearModel) -> tuple[list[str], Array]:
    """Return channels that are coordinates, and their map (n, n_u) from the motion."""
    channels = model.channels
    mine = [k for k, name in enumerate(channels.names) if moves(name)]
    return [channels.names[k] for k in mine], channels.by_xi[mine]


def _offset(model: LinearModel, mean: Array) -> dict[str, float]:
    """Return the mean offset of each coordinate; empty if a load meets no stiffness."""
    free, force = model.free, model.hydro_map.T @ mean
    stiffness = free.T @ (model.stiffness + model.late(np.array([STILL]))[0].real) @ free
    size = np.sqrt(np.abs(np.diag(free.T @ model.mass @ free)) + 1e-300)
    u, values, v = np.linalg.svd(stiffness / np.outer(size, size))
    held = values > HELD * values.max(initial=0.0)
    load = u.T @ (force / size)
    if np.abs(load[~held]).max(initial=0.0) > HELD * np.abs(load).max(initial=0.0):
        return {}
    xi = free @ ((v[held].T @ (load[held] / values[held])) / size)
    names, by_xi = _names(model)
    return dict(zip(names, map(float, by_xi @ xi), strict=True))


def _response(model: LinearModel, damping: Array | None, highest: float) -> tuple[Array, Complex]:
    """Return frequencies (w,) up to the highest, and coordinates by loads there (w, n, m)."""
    w = np.linspace(0.0, highest, STEPS)
    for mode in model.modes():
        own = 2.0 * np.pi / mode.period
        w = np.union1d(w, own * np.concatenate([1.0 - ABOUT, 1.0 + ABOUT]))
    w = w[(w > 0.0) & (w <= highest)]
    return w, _at(model, damping, w)


def _at(model: LinearModel, damping: Array | None, w: Array) -> Complex:
    free = model.free
    more = 0.0 if damping is None else free.T @ damping @ free
    z = np.array([model.dynamic_stiffness(complex(x)) + 1j * x * more for x in w])
    by_xi = _names(model)[1] @ free
    return np.asarray(
        by_xi
        @ np.linalg.solve(
            z,
            np.broadcast_to(model.hydro_map.T.astype(complex), (w.size, *model.hydro_map.T.shape)),
        )
    )


def _in_continuous_sea(
    w: Array, response: Complex, omega: Array, spectrum: Complex, offset: dict[str, float]
) -> dict[str, float]:
    """Return standard deviations: roots of int G S conj G^T dW."""
    at = np.clip(np.searchsorted(omega, w, side="right") - 1, 0, omega.size - 2)
    upper = ((w - omega[at]) / (omega[at + 1] - omega[at]))[:, None, None]
    between = (1.0 - upper) * spectrum[at] + upper * spectrum[at + 1]
    density = np.einsum("wni,wij,wnj->wn", response, between, response.conj(), optimize=True).real
    variance = np.trapezoid(density, w, axis=0) + w[0] * density[0]
    return dict(zip(offset, map(float, np.sqrt(np.maximum(variance, 0.0))), strict=True))


def _by_components(
    model: LinearModel, damping: Array | None, loads: SlowLoads, offset: dict[str, float]
) -> tuple[dict[str, float], Array]:
    """Return standard deviations of motion and loads: each pair is a line of the spectrum."""
    sea, count = loads.sea, loads.sea.omega.size
    highest = float(np.ptp(sea.omega))
    if highest == 0.0:
        return dict.fromkeys(offset, 0.0), np.zeros(len(model.hydro_labels))
    w, response = _response(model, damping, highest)
    variance, square = np.zeros(len(offset)), np.zeros(len(model.hydro_labels))
    few = count * (count - 1) // 2 <= w.size
    for i in range(count):
        j = np.flatnonzero(sea.omega < sea.omega[i])
        if j.size == 0:
            continue
        apart = sea.omega[i] - sea.omega[j]
        values = loads.pairs(np.full(j.size, i, dtype=np.intp), j)
        weight = 8.0 * sea.energy[i] * sea.energy[j]
        square += weight @ np.abs(values) ** 2
        near = _at(model, damping, apart) if few else _between(w, response, apart)
        variance += weight @ np.abs(np.einsum("pnm,pm->pn", near, values)) ** 2
    motion = dict(zip(offset, map(float, np.sqrt(variance)), strict=True))
    return motion, np.sqrt(square)


def _between(w: Array, response: Complex, at: Array) -> Complex:
    """Return the response (p, n, m) at frequencies between those that are known."""
    k = np.clip(np.searchsorted(w, at) - 1, 0, w.size - 2)
    upper = np.clip((at - w[k]) / (w[k + 1] - w[k]), 0.0, 1.0)[:, None, None]
    return np.asarray((1.0 - upper) * response[k] + upper * response[k + 1])


def units(names: tuple[str, ...]) -> list[str]:
    """Return the unit of each channel of a motion."""
    return [unit_of(name).removesuffix("/m") for name in names]
