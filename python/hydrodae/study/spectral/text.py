"""What `hydrodae.spectral` found, in words and tables."""

from __future__ import annotations

from typing import Any

import numpy as np

from hydrodae.study.rao.text import NOTHING, name_of_power, short_name
from hydrodae.study.slow.text import table as slow_table
from hydrodae.support.units import displayed, power_text


def table(found: Any) -> str:
    """Notes, standard deviations of motions and rates, mean powers, linear equivalents."""
    lines = [f"note: {note}" for note in found.notes]
    kind = "one wave (Lorentz)" if len(found.waves) == 1 else f"{len(found.waves)} waves (Gauss)"
    lines.append(
        f"{kind}, standard deviation of the elevation "
        f"{found.standard_deviation['sea/elevation']:.4g} m; {found.iterations} iterations, "
        f"{1e3 * found.time:.1f} ms"
    )
    lines.append(f"{'standard deviation':40} {'motion':>12} {'rate':>12}")
    units = {n: u.removesuffix("/m") for n, u in zip(found.names, found.units, strict=True)}
    largest: dict[str, float] = {}
    for name in found.rate:
        largest[units[name]] = max(found.standard_deviation[name], largest.get(units[name], 0.0))
    for name, rate in found.rate.items():
        value = found.standard_deviation[name]
        if value <= NOTHING * largest[units[name]]:
            value = rate = 0.0
        factor, unit = displayed(units[name])
        lines.append(
            f"  {short_name(name):38} {factor * value:12.5g} {factor * rate:12.5g}  "
            f"{unit}, {unit}/s"
        )
    lines += _air(found)
    lines += [
        f"mean power of {name_of_power(name):26} {power_text(value, 5)}"
        for name, value in found.power.items()
    ]
    lines += [f"damping of {name}: {_damping(value)}" for name, value in found.damping.items()]
    lines += [f"slope of outlet {name}: {g:.5g} kg/(s Pa)" for name, g in found.outlet.items()]
    if found.slow is not None:
        lines.append(slow_table(found.slow, found.standard_deviation))
    return "\n".join(lines)


def _air(found: Any) -> list[str]:
    """Standard deviations of pressures and mass flows."""
    units = {n: u.removesuffix("/m") for n, u in zip(found.names, found.units, strict=True)}
    return [
        f"  {short_name(name):38} {found.standard_deviation[name]:12.5g} {'':12}  {units[name]}"
        for name in found.names
        if name.startswith(("chambers/", "outlets/"))
    ]


def _damping(value: Any) -> str:
    """One number of a force along a joint; of a matrix the diagonal, of segments their sum."""
    if np.ndim(value) == 0:
        return f"c = {value:.5g} N s/m or N m s/rad"
    if np.ndim(value) == 2:
        return f"diagonal {', '.join(f'{x:.4g}' for x in np.diag(value))} N s/m, N m s/rad"
    x, y, z = np.einsum("nii->i", value)
    return f"{x:.4g}, {y:.4g}, {z:.4g} N s/m along x, y, z"
