r"""Many equal cylinders that scatter and radiate waves into each other.

Kagemoto and Yue (1986, J. Fluid Mech. 166): with A_i the outgoing and D_i the incident coefficients
of body i, T its scattering, X_ij the translation of what j sends out to i, and R what it radiates,

    D_i = D0_i + sum_{j != i} X_ij A_j,   A_j = T D_j + R U_j

exact but for the truncation of orders and modes. T compresses: with T = P Q^H from its singular
values, weighted with what of each mode reaches a neighbour, the unknowns are Q^H D, a few an order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hydrodae.hdb.interaction import radial
from hydrodae.hdb.interaction.cylinder import Cylinder, Response, respond
from hydrodae.hdb.interaction.vertical import Outside
from hydrodae.support.arrays import Array, Complex

#: Motions of the cylinder by order: its rows in (surge, sway, heave, roll, pitch, yaw).
DOFS = 6
#: Modes that fall below this on their way to the nearest neighbour are left out.
FAINT = 1e-7
#: Singular values of the weighted scattering below this share of the largest are left out.
RANK = 1e-8


@dataclass(frozen=True)
class Solution:
    """Loads on an array at one frequency, per unit potential: int phi n dS.

    Attributes
    ----------
    radiation : (6 n, 6 n) complex array
        Per unit velocity; rows are loads.
    undisturbed, scattered : (nh, 6 n) complex arrays
        Of plane waves e^{-ik.x} Z_0(z) alone, and of what the bodies add.
    sent : (6 n + nh, n, 2 orders + 1) complex array
        Coefficients of the progressive waves that leave each body, H_n(k r) / H_n(k a) e^{i n
        theta} Z_0(z) about its axis: per unit velocity, then of the plane waves.
    """

    radiation: Complex
    undisturbed: Complex
    scattered: Complex
    sent: Complex


@dataclass(frozen=True)
class _Order:
    """One order n: scattering T = sent @ heard, and the motions that this order has."""

    sent: Complex  # (M', r)
    heard: Complex  # (r, M')
    radiated: Complex  # (M', 6)
    loads: Complex  # (6, M')
    rank: slice


def solve(
    body: Cylinder, places: Array, modes: Outside, orders: int, headings: Sequence[float]
) -> Solution:
    """Solve an array at one frequency.

    Parameters
    ----------
    body : Cylinder
    places : (n, 2) array
        Axes of the bodies [m], at least a diameter apart.
    modes : Outside
        Eigenfunctions at this frequency.
    orders : int
        Highest order of e^{i n theta}.
    headings : sequence of float
        Directions of travel of the plane waves [rad]; not at infinite frequency.
    """
    near = _nearest(places)
    kept = _audible(modes, body.radius, near)
    found = [respond(body, modes, n, kept) for n in range(orders + 1)]
    weight = np.ones(kept)
    if np.isfinite(near):
        loud = np.exp(-modes.numbers[:kept] * (near - 2.0 * body.radius))
        weight = np.sqrt(np.maximum(loud, FAINT))
    if modes.waves:
        weight[0] = 1.0
    parts = _compress(found, weight, orders)
    matrix, sent, received, direct = _couple(body, places, modes, parts, kept, orders)
    arriving, loads, plain = _plane_waves(body, places, modes, found, parts, headings, orders)
    n = len(places)
    size = parts[-1].rank.stop
    answer = np.linalg.solve(np.eye(n * size) - matrix, np.concatenate([sent, arriving.T], axis=1))
    radiation = direct + received @ answer[:, : n * DOFS]
    own = sum(_embed(r.impedance, n) for n, r in enumerate(found[:2]))
    for i in range(n):
        block = slice(DOFS * i, DOFS * (i + 1))
        radiation[block, block] += own
    total = loads + (received @ answer[:, n * DOFS :]).T
    heard = np.asarray(answer.T.reshape(-1, n, size), dtype=complex)
    return Solution(radiation, plain, total - plain, _sent(parts, heard))


def _sent(parts: list[_Order], heard: Complex) -> Complex:
    """Return coefficients (6 n + nh, n, 2 orders + 1) of the progressive waves of each body.

    `heard` (6 n + nh, n, r): per unit velocity, then of plane waves, these themselves included.
    """
    n = heard.shape[1]
    out = np.empty((len(heard), n, len(parts)), dtype=complex)
    for k, part in enumerate(parts):
        out[:, :, k] = heard[:, :, part.rank] @ part.sent[0]
        for i in range(n):
            out[DOFS * i : DOFS * (i + 1), i, k] += part.radiated[0]
    return out


def _nearest(places: Array) -> float:
    """Smallest distance of two bodies [m]; infinite for one."""
    if len(places) < 2:
        return np.inf
    distance = np.linalg.norm(places[:, None] - places[None, :], axis=2)
    return float(distance[np.triu_indices(len(places), 1)].min())


def _audible(modes: Outside, radius: float, near: float) -> int:
    """Count of modes that reach a neighbour."""
    if not np.isfinite(near):
        return 1
    loud = np.exp(-modes.numbers * (near - 2.0 * radius)) > FAINT
    if modes.waves:
        loud[0] = True
    return max(1, int(np.count_nonzero(loud)))


def _turns(order: int) -> Complex:
    """Parts (6, d) of the motions of |order| in e^{i order theta}: cos and sin by exponentials."""
    parts = np.zeros((DOFS, (1, 2)[abs(order)] if abs(order) < 2 else 0), dtype=complex)
    if order == 0:
        parts[2, 0] = 1.0
    elif abs(order) == 1:
        sine = -0.5j * order
        parts[0, 0], parts[1, 0] = 0.5, sine
        parts[4, 1], parts[3, 1] = 0.5, -sine
    return parts


def _embed(impedance: Complex, order: int) -> Complex:
    """Impedance of one order (d, d) as (6, 6)."""
    result = np.zeros((DOFS, DOFS), dtype=complex)
    for signed in {order, -order}:
        # the load on cos of e^{i theta} is that on cos itself: pi
        parts = _turns(signed)
        result += 2.0 ** min(order, 1) * parts.conj() @ impedance @ parts.T
    return result


def _compress(found: Sequence[Response], weight: Array, orders: int) -> list[_Order]:
    parts = []
    start = 0
    for n in range(-orders, orders + 1):
        one = found[abs(n)]
        scaled = weight[:, None] * one.scattering * weight
        u, s, v = np.linalg.svd(scaled)
        rank = max(1, int(np.count_nonzero(s > RANK * s[0])))
        turns = _turns(n)
        parts.append(
            _Order(
                sent=u[:, :rank] * s[:rank] / weight[:, None],
                heard=np.asarray(v[:rank] / weight, dtype=complex),
                radiated=one.radiated @ turns.T,
                loads=2.0 ** min(abs(n), 1) * turns.conj() @ one.loads,
                rank=slice(start, start + rank),
            )
        )
        start += rank
    return parts


def _couple(
    body: Cylinder, places: Array, modes: Outside, parts: list[_Order], kept: int, orders: int
) -> tuple[Complex, Complex, Complex, Complex]:
    """Matrices from (heard coefficients, velocities) to (heard coefficients, loads)."""
    n, size = len(places), parts[-1].rank.stop
    near = Outside(modes.depth, modes.numbers[:kept], modes.waves, modes.norms[:kept])
    out = np.zeros((size + DOFS, 2 * orders + 1, kept), dtype=complex)
    into = np.zeros((2 * orders + 1, kept, size + DOFS), dtype=complex)
    for k, part in enumerate(parts):
        out[part.rank, k], out[size:, k] = part.heard, part.loads
        into[k, :, part.rank], into[k, :, size:] = part.sent, part.radiated
    blocks: dict[float, Complex] = {}
    whole = np.zeros((n, size + DOFS, n, size + DOFS), dtype=complex)
    order = np.arange(-orders, orders + 1)
    for i in range(n):
        for j in range(n):
            if i == j:
                continue
            dx, dy = places[i] - places[j]
            distance = round(float(np.hypot(dx, dy)), 9)
            if distance not in blocks:
                blocks[distance] = radial.translation(near, body.radius, distance, orders)
            turn = np.exp(1j * np.arctan2(dy, dx) * (order[None, :] - order[:, None]))
            whole[i, :, j] = _between(out, blocks[distance] * turn[:, :, None], into)
    flat = whole.reshape(n * (size + DOFS), n * (size + DOFS))
    heard = (np.arange(n)[:, None] * (size + DOFS) + np.arange(size)).ravel()
    motion = (np.arange(n)[:, None] * (size + DOFS) + size + np.arange(DOFS)).ravel()
    return (
        flat[np.ix_(heard, heard)],
        flat[np.ix_(heard, motion)],
        flat[np.ix_(motion, heard)],
        flat[np.ix_(motion, motion)],
    )


def _between(out: Complex, moved: Complex, into: Complex) -> Complex:
    """Sum over orders and modes: out[a, l, m] moved[l, n, m] into[n, m, b]."""
    result = np.zeros((out.shape[0], into.shape[2]), dtype=complex)
    for to in range(moved.shape[0]):
        rows = np.flatnonzero(np.any(out[:, to] != 0.0, axis=1))
        for frm in range(moved.shape[1]):
            columns = np.flatnonzero(np.any(into[frm] != 0.0, axis=0))
            scaled = out[rows, to] * moved[to, frm]
            result[np.ix_(rows, columns)] += scaled @ into[frm][:, columns]
    return result


def _plane_waves(
    body: Cylinder,
    places: Array,
    modes: Outside,
    found: Sequence[Response],
    parts: list[_Order],
    headings: Sequence[float],
    orders: int,
) -> tuple[Complex, Complex, Complex]:
    """Heard coefficients (nh, n r), loads with what each body scatters itself, and without."""
    n, size = len(places), parts[-1].rank.stop
    arriving = np.zeros((len(headings), n, size), dtype=complex)
    loads = np.zeros((len(headings), n, DOFS), dtype=complex)
    plain = np.zeros((len(headings), n, DOFS), dtype=complex)
    for h, heading in enumerate(headings):
        k = modes.numbers[0]
        phase = np.exp(-1j * k * (places @ np.array([np.cos(heading), np.sin(heading)])))
        waves = radial.plane_wave(modes, body.radius, heading, orders)
        for part, value, order in zip(parts, waves, range(-orders, orders + 1), strict=True):
            arriving[h][:, part.rank] = value * np.outer(phase, part.heard[:, 0])
            both = 2.0 ** min(abs(order), 1) * _turns(order).conj()
            loads[h] += value * np.outer(phase, part.loads[:, 0])
            plain[h] += value * np.outer(phase, both @ found[abs(order)].undisturbed[:, 0])
    shape = (len(headings), n * DOFS)
    return arriving.reshape(len(headings), n * size), loads.reshape(shape), plain.reshape(shape)
