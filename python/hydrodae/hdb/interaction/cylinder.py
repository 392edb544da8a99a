r"""One floating vertical cylinder: how it scatters and radiates, and what loads it.

Eigenfunction matching on r = a after Garrett (1971, J. Fluid Mech. 46) and Yeung (1981, Appl. Ocean
Res. 3). Per order n, with R_s, R_i the radial functions of outgoing and incident waves,

    r > a:  phi = sum_m (A_m R_s,m + D_m R_i,m) Z_m
    r < a:  phi = phi_p + sum_q C_q V_q(r) P_q,   V_q = I_n(q pi r/b) / I_n(q pi a/b), V_0 = (r/a)^n

phi is continuous over the gap b below the cylinder, and its radial derivative over the whole depth,
where it is that of the hull above the gap. phi_p meets the motion of the bottom.
Potentials are per unit velocity; the load per unit potential is i w rho int phi n dS, n out of the
body.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import special

from hydrodae.hdb.interaction.radial import incident, outgoing_slope
from hydrodae.hdb.interaction.vertical import Outside
from hydrodae.support.arrays import Array, Complex

#: Eigenfunctions below the body for every one outside, times depth over gap.
INNER_SHARE = 1.0


@dataclass(frozen=True)
class Cylinder:
    """A truncated vertical cylinder that floats upright.

    Attributes
    ----------
    radius, draft : float
        [m].
    point : float
        Height z of the reference point on its axis [m].
    """

    radius: float
    draft: float
    point: float


@dataclass(frozen=True)
class Response:
    """What a cylinder does to waves of one order |n| at one frequency, of the M' modes kept.

    Attributes
    ----------
    scattering : (M', M') complex array
        Outgoing coefficients from incident ones.
    radiated : (M', d) complex array
        Outgoing coefficients per unit velocity [m].
    loads : (d, M') complex array
        int phi n dS of incident waves and what they scatter [m2, m3].
    undisturbed : (d, M') complex array
        The same of the incident waves alone.
    impedance : (d, d) complex array
        int phi n dS per unit velocity [m3 .. m5].

    The d motions are heave for n = 0, surge and pitch for n = 1, none above. Those of n = 1 are the
    parts of e^{i theta}: surge moves as cos(theta).
    """

    scattering: Complex
    radiated: Complex
    loads: Complex
    undisturbed: Complex
    impedance: Complex


def respond(body: Cylinder, modes: Outside, order: int, kept: int) -> Response:
    """Solve the isolated cylinder for one order n >= 0; incident are the first `kept` modes."""
    a, h = body.radius, modes.depth
    gap = h - body.draft
    count = max(4, int(np.ceil(INNER_SHARE * modes.numbers.size * gap / h)))
    overlap = modes.overlap(gap, count)
    inner = _inner_slope(a, gap, order, count)
    edge, slope = incident(modes, a, order)
    flow = (gap / h) * overlap.T @ (inner[:, None] * overlap)
    matrix = np.diag(outgoing_slope(modes, a, order)) - flow
    push, value, radial = _motions(body, modes, order, overlap)
    # h R' Z_m of the outside = b V' (C of the inside) + the hull's own
    driven = (push + gap * overlap.T @ (radial - inner[:, None] * value)) / h
    known = (flow * edge - np.diag(slope))[:, :kept]
    found = np.asarray(np.linalg.solve(matrix, np.concatenate([known, driven], axis=1)), complex)
    scattering, radiated = found[:, :kept], found[:, kept:]
    side, bottom = _weights(body, modes, order, count)
    outer = np.diag(edge)[:, :kept] + scattering
    return Response(
        scattering=scattering[:kept],
        radiated=radiated[:kept],
        loads=side @ outer + bottom @ (overlap @ outer),
        undisturbed=_undisturbed(body, modes, order, side, edge)[:, :kept],
        impedance=side @ radiated
        + bottom @ (overlap @ radiated - value)
        + _particular_loads(body, gap, order),
    )


def _inner_slope(a: float, gap: float, order: int, count: int) -> Array:
    """V_q'(a), (count,) [1/m]."""
    x = np.pi * np.arange(1, count) / gap
    ratio = 0.5 * (special.ive(order - 1, x * a) + special.ive(order + 1, x * a))
    return np.concatenate([[order / a], x * ratio / special.ive(order, x * a)])


def _motions(
    body: Cylinder, modes: Outside, order: int, overlap: Array
) -> tuple[Array, Array, Array]:
    """Flow through the hull in Z_m (M, d), and phi_p and its slope at r = a in P_q (count, d).

    Heave: phi_p = (s^2 - r^2/2) / (2 b). Pitch: phi_p = -(s^2 r - r^3/4) / (2 b), as the bottom
    goes down by x per radian.
    """
    a, h = body.radius, modes.depth
    gap = h - body.draft
    square, one = _square(gap, overlap.shape[0]), np.eye(overlap.shape[0])[0]
    if order == 0:
        value = (square - 0.5 * a**2 * one) / (2.0 * gap)
        return np.zeros((modes.numbers.size, 1)), value[:, None], -0.5 * a / gap * one[:, None]
    if order == 1:
        surge = modes.integral(gap, h)
        pitch = modes.moment(gap, h) - (h + body.point) * surge
        value = -(square * a - 0.25 * a**3 * one) / (2.0 * gap)
        radial = -(square - 0.75 * a**2 * one) / (2.0 * gap)
        none = np.zeros_like(value)
        return (
            np.column_stack([surge, pitch]),
            np.column_stack([none, value]),
            np.column_stack([none, radial]),
        )
    nothing = np.zeros((overlap.shape[0], 0))
    return np.zeros((modes.numbers.size, 0)), nothing, nothing


def _square(gap: float, count: int) -> Array:
    """(1/b) int_0^b s^2 P_q ds, (count,) [m2]."""
    q = np.arange(1, count)
    others = 2.0 * np.sqrt(2.0) * gap**2 * (-1.0) ** q / (np.pi * q) ** 2
    return np.concatenate([[gap**2 / 3.0], others])


def _weights(body: Cylinder, modes: Outside, order: int, count: int) -> tuple[Array, Array]:
    """Return int phi n dS of Z_m on the side (d, M), and of V_q P_q on the bottom (d, count)."""
    a, h = body.radius, modes.depth
    gap = h - body.draft
    x = np.pi * np.arange(1, count) / gap
    sign = np.sqrt(2.0) * (-1.0) ** np.arange(1, count)
    if order == 0:
        ratio = special.ive(1, x * a) / (x * special.ive(0, x * a))
        heave = -2.0 * np.pi * a * np.r_[0.5 * a, sign * ratio]
        return np.zeros((1, modes.numbers.size)), heave[None, :]
    if order == 1:
        surge = modes.integral(gap, h)
        pitch = modes.moment(gap, h) - (h + body.point) * surge
        ratio = special.ive(2, x * a) / (x * special.ive(1, x * a))
        below = np.pi * a**2 * np.r_[0.25 * a, sign * ratio]
        return np.pi * a * np.stack([surge, pitch]), np.stack([np.zeros(count), below])
    return np.zeros((0, modes.numbers.size)), np.zeros((0, count))


def _particular_loads(body: Cylinder, gap: float, order: int) -> Array:
    """Return int phi_p n dS over the bottom, (d, d)."""
    a = body.radius
    if order == 0:
        integral = gap**2 * a**2 / 2.0 - a**4 / 8.0
        return np.array([[-2.0 * np.pi * integral / (2.0 * gap)]])
    if order == 1:
        integral = gap**2 * a**4 / 4.0 - a**6 / 24.0
        return np.array([[0.0, 0.0], [0.0, -np.pi * integral / (2.0 * gap)]])
    return np.zeros((0, 0))


def _undisturbed(body: Cylinder, modes: Outside, order: int, side: Array, edge: Complex) -> Complex:
    """Return int phi n dS of the propagating incident wave alone, zero for others, (d, M)."""
    result = np.zeros((side.shape[0], modes.numbers.size), dtype=complex)
    if not modes.waves or order > 1:
        return result
    a, k = body.radius, modes.numbers[0]
    size = abs(special.hankel2(order, k * a)) * modes.at(modes.depth - body.draft)[0]
    result[:, 0] = side[:, 0] * edge[0]
    if order == 0:
        result[0, 0] -= 2.0 * np.pi * a * special.jv(1, k * a) / k * size
    else:
        result[1, 0] += np.pi * a**2 * special.jv(2, k * a) / k * size
    return result
