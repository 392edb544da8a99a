"""What `hydrodae.rao` found, in words and tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from hydrodae.linear import Mode, Response
from hydrodae.study.rao.regular_waves import Harmonic
from hydrodae.support.arrays import Array
from hydrodae.support.units import displayed, power_text

#: A coordinate that moves less than this share of the largest of its unit is not listed.
NOTHING = 1e-9


def short_name(name: str) -> str:
    """Return the name of a response as a person reads it: `body.coordinate`.

    Examples
    --------
    >>> short_name("bodies/flap1/pitch"), short_name("joints/hinge1/angle")
    ('flap1.pitch', 'hinge1.angle')
    """
    return ".".join(name.split("/")[1:])


def name_of_power(name: str) -> str:
    """Return the name of a power as a person reads it.

    Examples
    --------
    >>> name_of_power("pto"), name_of_power("outlets/turbine/power_shaft")
    ('pto', 'outlet turbine, shaft')
    """
    if not name.startswith("outlets/"):
        return name
    _, outlet, kind = name.split("/")
    return f"outlet {outlet}{kind.removeprefix('power').replace('_', ', ')}"


def coordinates(response: Response) -> list[str]:
    """Names of the responses of bodies, joints and air, without the reactions."""
    return [name for name in response.names if "/reaction_" not in name]


def peak(response: Response, values: Array) -> tuple[float, float]:
    """Largest value and its period [s], by the parabola through the three highest points.

    At an end of the frequencies the value there.
    """
    k = int(np.argmax(values))
    w = response.omega
    if not 0 < k < len(w) - 1:
        return float(values[k]), float(2 * np.pi / w[k])
    size = w[k + 1] - w[k - 1]
    a, b, c = np.polyfit((w[k - 1 : k + 2] - w[k]) / size, values[k - 1 : k + 2], 2)
    shift = 0.0 if a == 0.0 else -b / (2 * a)
    return float(c + b * shift + a * shift**2), float(2 * np.pi / (w[k] + shift * size))


def mode_lines(modes: Iterable[Mode]) -> list[str]:
    """One line a natural mode: period, damping ratio, and what moves most in it."""
    lines = []
    for mode in modes:
        main = [f"{short_name(n)} {v:+.2f}" for n, v in mode.shape.items() if abs(v) >= 0.1]
        mark = " (outside the table: extrapolated)" if mode.extrapolated else ""
        lines.append(
            f"mode {mode.period:8.3f} s{mark}, damping ratio {mode.damping_ratio:.4f}: "
            f"{', '.join(main)}"
        )
    return lines


def opening(notes: Iterable[str], modes: Iterable[Mode]) -> str:
    """Notes of the linear model and its natural modes, one line each."""
    return "\n".join([*(f"note: {note}" for note in notes), *mode_lines(modes)])


def table(response: Response, chosen: Response) -> str:
    """Amplitudes per metre of wave amplitude: peak, its period, values at chosen periods.

    Parameters
    ----------
    response : Response
        On a fine grid: where the peaks are looked for.
    chosen : Response
        At the periods to show.
    """
    order = np.argsort(-chosen.omega)
    periods = 2 * np.pi / chosen.omega[order]
    rows = []
    for name, unit in zip(response.names, response.units, strict=True):
        if "/reaction_" not in name:
            rows.append((short_name(name), unit, np.abs(response[name]), np.abs(chosen[name])))
    for name, power in response.power.items():
        rows.append((f"{name_of_power(name)} mean power", "W/m2", power, chosen.power[name]))
    largest: dict[str, float] = {}
    for _, unit, values, _ in rows:
        largest[unit] = max(largest.get(unit, 0.0), float(np.abs(values).max()))
    width = max([len(row[0]) for row in rows] + [10])
    head = " ".join(f"{f'{period:.4g} s':>10}" for period in periods)
    lines = [
        "amplitude per metre of wave amplitude, heading "
        f"{np.degrees(response.heading):g} deg: peak and its period, then at chosen periods",
        f"  {'':{width}} {'':7} {'peak':>10} {'period':>9}  {head}",
    ]
    still = []
    for name, unit, values, at in rows:
        if np.abs(values).max() <= NOTHING * largest[unit]:
            still.append(name)
            continue
        factor, shown = displayed(unit)
        top, period = peak(response, values)
        numbers = " ".join(f"{factor * value:10.4g}" for value in at[order])
        at_end = np.argmax(values) in (0, len(values) - 1)
        mark = "*" if at_end else " "
        lines.append(
            f"  {name:{width}} {shown:7} {factor * top:10.4g} {period:7.3f} s{mark} {numbers}"
        )
    if any("s* " in line for line in lines):
        lines.append("  * at the end of the frequencies: the peak may lie beyond")
    if still:
        lines.append(f"  nothing moves: {', '.join(still)}")
    return "\n".join(lines)


def comparison(response: Response, names: Sequence[str], runs: Sequence[Harmonic]) -> str:
    """Runs in regular waves against the frequency domain, one line a period."""
    lines = ["time domain against frequency domain: |difference| over amplitude, % (settled to, %)"]
    width = max([15] + [len(short_name(name)) for name in names])
    lines.append("period, s " + " ".join(f"{short_name(name):>{width}}" for name in names))
    for k, harmonic in enumerate(runs):
        cells = []
        for name in names:
            exact = response[name][k]
            error = abs(harmonic.response[name] - exact) / max(abs(exact), 1e-300)
            cells.append(f"{100 * error:8.3f} ({100 * harmonic.unsettled[name]:4.2f})")
        period = 2 * np.pi / response.omega[k]
        lines.append(f"{period:9.4g} " + " ".join(f"{c:>{width}}" for c in cells))
    return "\n".join(lines)


def sea_table(
    response: Response, deviation: Mapping[str, float], power: Mapping[str, float]
) -> str:
    """Standard deviations and mean powers in the sea of the case, one line each.

    Parameters
    ----------
    response : Response
        Of the same case: it shows the units.
    deviation, power : mapping from str
        As `LinearModel.irregular` returns them.
    """
    units = {n: u.removesuffix("/m") for n, u in zip(response.names, response.units, strict=True)}
    lines = ["in the sea of the case (linear): standard deviations"]
    shown = {name: value for name, value in deviation.items() if "/reaction_" not in name}
    largest: dict[str, float] = {}
    for name, value in shown.items():
        unit = units.get(name, "m")
        largest[unit] = max(value, largest.get(unit, 0.0))
    for name, value in shown.items():
        # by constraints or symmetry
        held = value <= NOTHING * largest[units.get(name, "m")]
        factor, unit = displayed(units.get(name, "m"))
        lines.append(f"  {name:40} {0.0 if held else factor * value:.5g} {unit}")
    lines += [
        f"  mean power of {name_of_power(name):26} {power_text(value, 5)}"
        for name, value in power.items()
    ]
    return "\n".join(lines)
