"""Fixed points x = g(x) of several arrays, by the mixing of Anderson (J. ACM 12 (1965) 547)."""

from __future__ import annotations

import numpy as np

from hydrodae.support.arrays import Array

#: Former iterates that are mixed.
DEPTH = 3
#: Share of the way to g(x) that a step goes.
SHARE = 0.5


class Mixing:
    """Next iterates from x and g(x); all entries are weighted by the largest of their array.

    A step that would turn the sign of a diagonal, of which damping has none, is replaced by the
    mean of x and g(x): the fixed point where g falls as 1/x, as next to a resonance.
    """

    def __init__(self) -> None:
        self._x: list[Array] = []
        self._rest: list[Array] = []

    def step(self, old: list[Array], new: list[Array]) -> list[Array]:
        """Return the next x from x = `old` and g(x) = `new`."""
        scale = np.concatenate([np.full(g.size, max(np.abs(g).max(), 1e-300)) for g in new])
        x = np.concatenate([a.ravel() for a in old]) / scale
        rest = np.concatenate([g.ravel() for g in new]) / scale - x
        self._x = [*self._x, x * scale][-DEPTH - 1 :]
        self._rest = [*self._rest, rest * scale][-DEPTH - 1 :]
        plain = x + SHARE * rest
        if len(self._x) == 1:
            return _split((x + rest) * scale, new)  # nothing is known yet: from zero to g(0)
        dx = np.diff(self._x, axis=0) / scale
        df = np.diff(self._rest, axis=0) / scale
        weights = np.linalg.lstsq(df.T, rest, rcond=1e-10)[0]
        mixed = plain - weights @ (dx + SHARE * df)
        out = _split(mixed * scale, new)
        if all(_same_sign(a, g) for a, g in zip(out, new, strict=True)):
            return out
        self._x, self._rest = self._x[-1:], self._rest[-1:]
        return _split(plain * scale, new)


def _split(values: Array, like: list[Array]) -> list[Array]:
    ends = np.cumsum([a.size for a in like])[:-1]
    return [part.reshape(a.shape) for part, a in zip(np.split(values, ends), like, strict=True)]


def _same_sign(mixed: Array, found: Array) -> bool:
    """Return whether the diagonals are alike in sign and no more than tenfold apart."""
    a = np.einsum("nii->ni", mixed)
    b = np.einsum("nii->ni", found)
    near = (a * b >= 0.0) & (np.abs(a) >= 0.1 * np.abs(b)) & (np.abs(a) <= 10.0 * np.abs(b))
    return bool(np.all(near))
