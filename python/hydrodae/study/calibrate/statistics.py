"""What a least-squares fit to correlated samples knows of its parameters.

With J the derivatives of the weighted differences r by the parameters, and S the covariance of r,

    cov = (J^T J)^-1 J^T S J (J^T J)^-1                                          (sandwich)

which is s^2 (J^T J)^-1 where the samples of r are independent. Differences of a model and a tank
are not: their autocorrelation is taken from themselves, by an autoregressive model of each channel
of each record (Burg's method, order by the information criterion of Schwarz). J^T S J is then a sum
over frequencies of its spectral density times |FFT of J|^2.

References
----------
H. White, Econometrica 48 (1980) 817-838 (the sandwich); J. P. Burg, Maximum entropy spectral
analysis, Stanford (1975); G. Schwarz, Annals of Statistics 6 (1978) 461-464.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtrit

from hydrodae.support.arrays import Array

#: Largest order of the autoregressive models.
ORDER = 24
#: Change of the channels over their size for a parameter that counts as without effect.
NO_EFFECT = 1e-6
#: Least singular value of the derivatives, columns of length one, where all are determined.
SINGULAR = 2e-3
#: Part of a parameter in a direction that is not determined.
PART = 0.1


@dataclass(frozen=True)
class Spread:
    """Uncertainty of the parameters of a fit.

    Attributes
    ----------
    covariance : (n, n) array
    correlation : (n, n) array
    half : (n,) array
        Half of the 95 % intervals.
    independent : (n,) array
        For each parameter: as many independent samples would show as much of it.
    """

    covariance: Array
    correlation: Array
    half: Array
    independent: Array


def spread(jacobian: Array, residual: Array, blocks: Sequence[slice]) -> Spread:
    """Uncertainty of parameters from derivatives and differences at the fit.

    Parameters
    ----------
    jacobian : (m, n) array
        Of full rank.
    residual : (m,) array
    blocks : sequence of slices
        Samples of one channel of one record, evenly spaced.

    Returns
    -------
    Spread
        Student's t with the least number of independent samples minus n degrees of freedom.
    """
    m, n = jacobian.shape
    inverse = np.linalg.inv(jacobian.T @ jacobian)
    middle, white = np.zeros((n, n)), np.zeros((n, n))
    for block in blocks:
        part = jacobian[block]
        middle += weighted(part, residual[block])
        white += float(np.mean(residual[block] ** 2)) * part.T @ part
    honest, plain = inverse @ middle @ inverse, inverse @ white @ inverse
    independent = np.minimum(m * np.diag(plain) / np.diag(honest), float(m))
    freedom = max(float(independent.min()) - n, 1.0)
    covariance = honest * (freedom + n) / freedom
    deviation = np.sqrt(np.diag(covariance))
    half = float(stdtrit(freedom, 0.975)) * deviation
    return Spread(covariance, covariance / np.outer(deviation, deviation), half, independent)


def weighted(part: Array, residual: Array) -> Array:
    """J^T S J of one block, (n, n)."""
    size = 1 << int(np.ceil(np.log2(4 * len(residual))))
    density = spectral_density(residual, size)
    transformed = np.fft.fft(part, size, axis=0)
    return np.asarray((transformed.conj().T @ (density[:, None] * transformed)).real / size)


def spectral_density(residual: Array, size: int) -> Array:
    """Density of an autoregressive model at `size` frequencies; its mean is the variance."""
    variance, coefficients = autoregressive(residual)
    denominator = np.fft.fft(np.concatenate([[1.0], coefficients]), size)
    return np.asarray(variance / np.abs(denominator) ** 2)


def autoregressive(values: Array) -> tuple[float, Array]:
    """Variance of the noise and coefficients of x_t + a_1 x_{t-1} + ... = e_t, after Burg.

    Parameters
    ----------
    values : (n,) array
        About their mean zero.

    Returns
    -------
    variance : float
    coefficients : (p,) array
        p <= `ORDER`, with the least n ln(variance) + p ln(n).
    """
    n = len(values)
    forward, backward = values[1:].copy(), values[:-1].copy()
    variance = float(np.mean(values**2))
    a = np.empty(0)
    best = (n * np.log(variance) if variance > 0.0 else -np.inf, variance, a)
    for order in range(1, min(ORDER, n // 5) + 1):
        size = float(forward @ forward + backward @ backward)
        if size <= 0.0 or variance <= 0.0:
            break
        k = -2.0 * float(forward @ backward) / size
        variance *= 1.0 - k * k
        a = np.concatenate([a, [0.0]])
        a = a + k * np.concatenate([a[:-1][::-1], [1.0]])
        forward, backward = (forward + k * backward)[1:], (backward + k * forward)[:-1]
        if variance <= 0.0:
            break
        criterion = n * np.log(variance) + order * np.log(n)
        if criterion < best[0]:
            best = (criterion, variance, a)
    return best[1], best[2]


def undetermined(jacobian: Array, names: Sequence[str]) -> list[str]:
    """Report which parameters, or which of them together, the samples do not determine.

    Parameters
    ----------
    jacobian : (m, n) array
        Of the differences over the size of the channels by the parameters over theirs.
    names : sequence of str

    Returns
    -------
    list of str
        Empty if all are determined.
    """
    sizes = np.linalg.norm(jacobian, axis=0) / np.sqrt(len(jacobian))
    silent = [name for name, size in zip(names, sizes, strict=True) if size < NO_EFFECT]
    told = [f"{name}: has no effect on the channels of the records" for name in silent]
    seen = [k for k, size in enumerate(sizes) if size >= NO_EFFECT]
    if len(seen) > 1:
        lengths = np.linalg.norm(jacobian[:, seen], axis=0)
        columns = jacobian[:, seen] / lengths
        _, values, rows = np.linalg.svd(columns, full_matrices=False)
        for value, row in zip(values, rows, strict=True):
            if value < SINGULAR:
                change = np.abs(row) / lengths  # of the parameters over their sizes
                part = (change > PART * change.max()) & (np.abs(row) > SINGULAR)
                group = [names[seen[k]] for k in np.flatnonzero(part)]
                told.append(
                    f"{', '.join(group)}: only a combination of them is determined: changes of one "
                    "are made up for by the others"
                )
    return told
