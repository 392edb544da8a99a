"""Truths of the attack scenes: closed forms, and tight integration in minimal coordinates.

Nothing here shares a line with the solver. A truth is a function of the (nt,) ascending sample
times [s] that returns (nt, n) values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydrodae.support.arrays import Array

Truth = Callable[[Array], Array]
Rates = Callable[[float, Array], Any]

#: Relative tolerance of the integrated truths.
TIGHT = 1e-12


def remembered(truth: Truth) -> Truth:
    """Return a truth that computes each set of sample times once."""
    known: dict[bytes, Array] = {}

    def looked_up(time: Array) -> Array:
        key = np.asarray(time, dtype=float).tobytes()
        if key not in known:
            known[key] = np.asarray(truth(np.asarray(time, dtype=float)))
        return known[key]

    return looked_up


@dataclass(frozen=True)
class Guard:
    """What ends a mode of motion.

    Attributes
    ----------
    value : callable
        Function of time and state that passes zero there.
    rising : bool
        Whether it passes upwards.
    jump : callable
        Time and state at that moment to the next mode and its state.
    """

    value: Callable[[float, Array], float]
    rising: bool
    jump: Callable[[float, Array], tuple[str, Array]]


def hybrid(
    mode: str,
    start: Sequence[float] | NDArray[Any],
    flows: Mapping[str, Rates],
    guards: Mapping[str, Sequence[Guard]],
    place: Callable[[Array, Array, str], Sequence[Array]],
    *,
    breaks: Sequence[float] | NDArray[Any] = (),
    longest: float | Callable[[str, Array], float] = np.inf,
    scale: Any = 1.0,
    method: str = "DOP853",
    rtol: float = TIGHT,
) -> Truth:
    """Return the truth of a motion in pieces.

    Parameters
    ----------
    mode, start
        Mode and state at t = 0.
    flows
        Rates of the state in each mode.
    guards
        What ends each mode.
    place
        Times (nt,), states (n, nt) and mode to the compared quantities, each (nt,).
    breaks
        Times [s] at which the rates are not smooth, so that the integration starts anew there.
    longest
        Longest step [s], or a function of mode and state at the start of a piece that gives it:
        shorter than the time between two zeros of a guard.
    scale
        Size of each state, to which the absolute tolerance refers.
    method, rtol
        Of `scipy.integrate.solve_ivp`.
    """
    from scipy.integrate import solve_ivp

    atol = 0.1 * rtol * np.asarray(scale, dtype=float)

    def event(guard: Guard) -> Callable[[float, Array], float]:
        def value(t: float, y: Array) -> float:
            return float(guard.value(t, y))

        value.terminal, value.direction = True, 1.0 if guard.rising else -1.0  # type: ignore[attr-defined]
        return value

    def truth(time: Array) -> Array:
        now, state, current = 0.0, np.array(start, dtype=float), mode
        end = float(time[-1]) if len(time) else 0.0
        ends = [b for b in sorted(breaks) if 0.0 < b < end] + [end]
        rows: list[Array] = []
        done = 0
        while done < len(time) and ends:
            stop = ends[0]
            if stop <= now:
                ends.pop(0)
                if ends:
                    continue
            watched = guards.get(current, ())
            wanted = time[done:][time[done:] <= stop]
            if stop > now:
                solved = solve_ivp(
                    flows[current],
                    (now, stop),
                    state,
                    method,
                    t_eval=None,
                    dense_output=True,
                    rtol=max(rtol, 2.3e-14),
                    atol=atol,
                    max_step=longest(current, state) if callable(longest) else longest,
                    events=[event(g) for g in watched] or None,
                )
                assert solved.success, solved.message
                reached = float(solved.t[-1])
                here = wanted[wanted <= reached]
                values = (
                    np.where(here[None, :] <= now, state[:, None], solved.sol(here))
                    if len(here)
                    else np.empty((len(state), 0))
                )
                state, struck = solved.y[:, -1].copy(), solved.status == 1
            else:
                reached, here, struck = now, wanted, False
                values = np.repeat(state[:, None], len(here), axis=1)
            if len(here):
                rows.append(np.column_stack(place(here, values, current)))
                done += len(here)
            now = reached
            if struck:
                hits = [k for k, t in enumerate(solved.t_events) if len(t)]
                current, state = watched[hits[0]].jump(now, state)
        return np.concatenate(rows)

    return remembered(truth)


def integrated(
    rates: Rates,
    start: Sequence[float] | NDArray[Any],
    place: Callable[[Array, Array], Sequence[Array]],
    **how: Any,
) -> Truth:
    """Return the truth of a smooth motion: `hybrid` with one mode."""
    return hybrid("", start, {"": rates}, {}, lambda t, y, _mode: place(t, y), **how)


def oscillation(rate: float, damping: float, x: float, v: float) -> Callable[[Array], Array]:
    """x(t) of x'' + 2 damping rate x' + rate^2 x = 0 from x, v (damping below 1)."""
    decay = damping * rate
    swing = rate * np.sqrt(1.0 - damping**2)
    return lambda t: np.asarray(
        np.exp(-decay * t) * (x * np.cos(swing * t) + (v + decay * x) / swing * np.sin(swing * t))
    )


def column(function: Callable[[Array], Array]) -> Truth:
    """Return a truth of one quantity."""
    return lambda time: np.asarray(function(np.asarray(time)))[:, None]


def walls(
    wall: Callable[[float], tuple[float, float, float]],
    lower: float,
    upper: float,
    restitution: float,
    start: tuple[float, float],
    gravity: float,
    finest: float,
    speed: float,
) -> Truth:
    """Return the truth of a free point between two walls that move as `wall`: closed flights.

    Parameters
    ----------
    wall
        Time [s] to value, rate and rate of the rate of both walls.
    lower, upper
        Their places relative to that.
    restitution
        Relative rate after an impact over that before.
    start
        Place and rate at t = 0.
    gravity
        Acceleration towards smaller places.
    finest
        Time in which the wall hardly turns [s].
    speed
        Size of the rates; a rebound of 1e-9 of it stays at the wall.
    """
    from scipy.optimize import brentq

    def flights(end: float) -> list[tuple[float, float, float, int]]:
        """Start, place, rate, and the wall at which it rests (-1, 1) or 0."""
        now, (place, rate), pieces = 0.0, start, []
        rest = 0
        while now < end:
            pieces.append((now, place, rate, rest))
            if rest:
                at = upper if rest > 0 else lower

                def held(t: float, side: int = rest) -> float:  # positive: pushed against it
                    return side * (-gravity - wall(t)[2])

                later = now + finest
                while held(later) > 0.0 and later < end:
                    later += finest
                if later >= end:
                    break
                now = (
                    later
                    if held(later - finest) <= 0.0
                    else brentq(held, later - finest, later, xtol=1e-14)
                )
                place, rate, rest = wall(now)[0] + at, wall(now)[1], 0
                continue

            def gaps(t: float, z: float = place, v: float = rate, t0: float = now) -> Any:
                r = z + v * (t - t0) - 0.5 * gravity * (t - t0) ** 2 - wall(t)[0]
                return r - lower, upper - r

            relative = abs(rate - wall(now)[1])
            pull = abs(gravity + wall(now)[2]) or 1e-300
            leaves = relative < 1e-9 * speed  # with the wall's own rate, or nearly so
            step = finest if leaves else min(finest, relative / pull / 20.0)
            before, later = now, now + step
            if leaves and now > 0.0 and min(gaps(later)) <= 0.0:
                rest = 1 if np.argmin(gaps(later)) else -1
                continue
            while min(gaps(later)) > 0.0 and later < end:
                step = min(finest, 1.1 * step)
                before, later = later, later + step
            if min(gaps(later)) > 0.0:
                break
            side = int(np.argmin(gaps(later)))
            if gaps(before)[side] <= 0.0:
                hit = later
            else:
                hit = brentq(lambda t, k=side, g=gaps: g(t)[k], before, later, xtol=1e-15)
            speed_in = rate - gravity * (hit - now) - wall(hit)[1]
            now, away = hit, -restitution * speed_in
            place = wall(hit)[0] + (upper if side else lower)
            rate = wall(hit)[1] + away
            pushed = (1 if side else -1) * (-gravity - wall(hit)[2]) > 0.0
            if abs(away) < 1e-9 * speed and pushed:
                rest = 1 if side else -1
        return pieces

    def truth(time: Array) -> Array:
        out = np.empty((len(time), 1))
        for t0, place, rate, rest in flights(float(time[-1])):
            now = time >= t0
            s = time[now] - t0
            if rest:
                out[now, 0] = [wall(t)[0] + (upper if rest > 0 else lower) for t in time[now]]
            else:
                out[now, 0] = place + rate * s - 0.5 * gravity * s**2
        return out

    return remembered(truth)
