"""Gumbel distributions of many samples at once, by the largest likelihood."""

from __future__ import annotations

import numpy as np

from hydrodae.support.arrays import Array

#: Newton's steps in ln scale; the error falls from about 0.5 by squares, so 8 reach rounding.
STEPS = 12


def fit_gumbel(x: Array) -> tuple[Array, Array]:
    """Location and scale of samples along the last axis.

        scale = mean(x) - sum(x e^(-x/scale)) / sum(e^(-x/scale)),
        loc = -scale ln mean(e^(-x/scale))

    Parameters
    ----------
    x : (..., n) array

    Returns
    -------
    loc, scale : (...) arrays
        Unit of `x`.
    """
    center = x.mean(axis=-1, keepdims=True)
    size = x.std(axis=-1, keepdims=True)
    z = (x - center) / np.where(size > 0.0, size, 1.0)
    scale = np.full(z.shape[:-1], np.sqrt(6.0) / np.pi)
    for _ in range(STEPS):
        weight = np.exp(-z / scale[..., None])
        total = weight.sum(axis=-1)
        first = (weight * z).sum(axis=-1) / total
        second = (weight * z**2).sum(axis=-1) / total
        # f = scale + first, f' = 1 + (second - first^2) / scale^2, both positive slopes
        step = (scale + first) / (1.0 + (second - first**2) / scale**2)
        scale = np.clip(scale - step, 0.2 * scale, 5.0 * scale)
    loc = -scale * np.log(np.exp(-z / scale[..., None]).mean(axis=-1))
    return center[..., 0] + size[..., 0] * loc, size[..., 0] * scale


def random_gumbel(generator: np.random.Generator, shape: tuple[int, ...]) -> Array:
    """Samples of the standard distribution, loc 0 and scale 1."""
    return np.asarray(-np.log(-np.log(generator.random(shape))))
