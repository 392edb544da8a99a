"""Fatigue loads of a series: cycles by rainflow counting, and the load that does the same harm."""

from __future__ import annotations

from hydrodae.errors import CaseError
from hydrodae.support.arrays import Array
from hydrodae.support.extras import install_command


def require_rainflow() -> None:
    """Raise CaseError if the library that counts cycles is missing."""
    try:
        import rainflow  # noqa: F401
    except ImportError:
        raise CaseError(
            f"fatigue loads need the package rainflow: {install_command('fatigue')}"
        ) from None


def damage_equivalent_load(
    values: Array, duration: float, exponent: float, frequency: float
) -> float:
    """Range of the load that harms as much as a series, at a fixed frequency.

        DEL = (sum n_i S_i^m / (f T))^(1/m)

    n_i cycles of range S_i by rainflow counting (ASTM E1049-85).

    Parameters
    ----------
    values : (n,) array
        Any unit; that of the result.
    duration : float
        T [s].
    exponent : float
        Slope m of the Woehler line [-]: about 3 for welds, 5 for chains, 10 for composites.
    frequency : float
        f [Hz].
    """
    import rainflow

    harm = sum(count * size**exponent for size, count in rainflow.count_cycles(values))
    return float((harm / (frequency * duration)) ** (1.0 / exponent))
