"""A run in a few lines for people."""

from __future__ import annotations

import math
from collections.abc import Sequence

from hydrodae.results.files import ResultsError
from hydrodae.results.recording import Recording
from hydrodae.support.units import displayed, prefixed


def summary(results: Recording) -> str:
    """Few lines about a run: status, cost, extrema of the joint coordinates, energy balance.

    Returns
    -------
    str
        Several lines without a trailing newline; angles in degrees, marked so.
    """
    lines = [f"{results.title or results.path.name}: {_ending(results)}"]
    cost = _cost(results)
    if cost:
        lines.append(f"  {cost}")
    lines += _methods(results)
    names = [*results.channels("joints/*/angle"), *results.channels("joints/*/displacement")]
    width = max(map(len, names), default=0)
    for name in names:
        lines.append(f"  {name:{width}}  {_extrema(results, name)}")
        lines += [f"  {'':{width}}  {line}" for line in _expected(results, name)]
    lines += _loads(results)
    lines += _power(results)
    lines += _controllers(results)
    lines += _impacts(results)
    lines += _overloads(results)
    lines += _work(results)
    lines += [f"  note: {note}" for note in results.notes]
    lines += [f"  {line}" for line in (_energy_balance(results), *_errors(results)) if line]
    return "\n".join(lines)


def _ending(results: Recording) -> str:
    reached = f"{results.end_time:g} s simulated"
    if results.status == "completed":
        return reached
    return f"{results.status}, {reached}" + (f" ({results.message})" if results.message else "")


def _cost(results: Recording) -> str:
    names = {
        "steps": "steps",
        "residual_calls": "residuals",
        "jacobian_calls": "Jacobians",
        "events": "events",
    }
    known = {k: v for k, v in results.statistics.items() if isinstance(v, int | float)}
    parts = [f"{int(known[key])} {word}" for key, word in names.items() if known.get(key)]
    if "wall_time" in known:
        wall = float(known["wall_time"])
        speed = (
            f" ({results.end_time / wall:,.0f} times real time)"
            if min(wall, results.end_time) > 0
            else ""
        )
        parts.append(f"wall time {wall:.3g} s{speed}")
    return ", ".join(parts)


def _methods(results: Recording) -> list[str]:
    """The methods that "auto" has taken, when and why."""
    columns = ("methods", "method_from", "method_reason")
    texts = [str(results.statistics.get(key, "")).splitlines() for key in columns]
    if len({len(text) for text in texts}) > 1:
        raise ResultsError(f"{results.path}: the methods of its parts are damaged")
    parts, before = [], ""
    for name, start, reason in zip(*texts, strict=True):
        since = f"{name} from t = {start} s because {reason}"
        parts.append(since if before else f"{name} ({reason})")
        before = name
    if len(parts) > 4:
        more = f"and {len(parts) - 4} more changes, at last to {before} at t = {start} s"
        parts[4:] = [more]
    return ["  method auto: " + ", ".join(parts)] if parts else []


def _errors(results: Recording) -> list[str]:
    """Lines on the estimated error of the motion, and on what is not reproducible."""
    known, lines = results.statistics, []
    if known.get("at_rest"):
        return []
    if known.keys() >= {"estimated_error", "estimated_error_of", "estimated_error_time"}:
        lines.append(
            f"estimated error {float(known['estimated_error']):.1g} of the motion "
            f"({known['estimated_error_of']}, t = {float(known['estimated_error_time']):.4g} s), "
            f"by {known.get('accuracy')}"
        )
    if missing := known.get("accuracy_missing"):
        until = known.get("estimated_until")
        after = "" if until is None else f" after t = {float(until):.4g} s"
        lines.append(f"error not estimated{after}: {missing}")
    for name, error in results.accuracy().items():
        if not error.reproducible:
            until = f"reproducible until t = {error.reproducible_until:.4g} s"
        elif math.isfinite(error.runs_part_at):
            until = f"error up to {error.largest:.1g} of the motion"
        else:
            continue
        lines.append(f"{name}: {until}; two runs part by 5 % at t = {error.runs_part_at:.4g} s")
    return lines


def _power(results: Recording) -> list[str]:
    """What power take-offs absorbed on average, each and in all."""
    head = "mean_power_absorbed."
    known = {
        key: float(value)
        for key, value in results.statistics.items()
        if key.startswith("mean_power_") and isinstance(value, int | float)
    }
    each = {key.removeprefix(head): power for key, power in known.items() if key.startswith(head)}
    if not each:
        return []
    parts = [_with_interval(name, power, known, f".{name}") for name, power in each.items()]
    if len(each) > 1 and "mean_power_absorbed" in known:
        parts.append(_with_interval("in all", known["mean_power_absorbed"], known))
    since = known.get("mean_power_from", 0.0)
    line = f"  mean absorbed power{f' after {since:g} s' * (since > 0)}: {', '.join(parts)}"
    if "mean_power_low" in known:
        line += "; in brackets: 95 % interval of the sea state"
    elif reason := results.statistics.get("mean_power_interval_missing"):
        line += f"; {reason}"
    return [line]


def _with_interval(name: str, power: float, known: dict[str, float], of: str = "") -> str:
    """A name, its mean power [W] and the interval of the sea state, all three in one unit."""
    factor, unit = prefixed(power, "W")
    told = f"{name} {factor * power:.4g} {unit}"
    if f"mean_power_low{of}" not in known:
        return told
    low, high = (factor * known[f"mean_power_{end}{of}"] for end in ("low", "high"))
    return f"{told} ({low:.3g} to {high:.3g})"


def _expected(results: Recording, name: str) -> list[str]:
    """What extremes of a channel are to be expected in other records of this sea and length."""
    start = results.settled
    if not results.is_sample(start):
        return []
    from hydrodae.results.series import intervals_of  # with numpy

    channel = results.channel(name)
    found = intervals_of(channel.values[results.time >= start])
    if not found:
        return []
    factor, unit = displayed(channel.unit)
    least, largest = (
        f"{factor * low:z.3g} to {factor * high:z.3g}" for low, high in (found["min"], found["max"])
    )
    length = f"{results.end_time - start:.4g} s"
    return [f"expected of such {length}: {least} and {largest} {unit} (95 %)"]


def _loads(results: Recording) -> list[str]:
    """What holds bodies that cannot move, and all that holds a scene at rest: mean and extremes."""
    names = results.channels("bodies/*/support_*")
    if results.statistics.get("at_rest"):
        names += [
            *results.channels("joints/*/reaction_*"),
            *results.channels("constraints/*/reaction"),
        ]
    else:
        names = [name for name in names if name.rpartition("/")[0] + "/velocity" not in results]
    start = results.settled
    first = next((k for k, t in enumerate(results.times) if t >= start), len(results.times) - 1)
    lines = []
    for name in names:
        channel = results.channel(name)
        columns = channel.columns
        components = [f".{c}" for c in "xyz"] if len(columns) == 3 else [""]
        for component, series in zip(components, columns, strict=True):
            if any(series):
                kept = series[first:]
                mean = f"mean {math.fsum(kept) / len(kept):.4g} {channel.unit}"
                lines.append((name + component, f"{mean}, {_range(results, series)}"))
    width = max((len(name) for name, _ in lines), default=0)
    head = f"  loads of supports{f', means after {start:g} s' * (start > 0)}:"
    return [head, *(f"    {name:{width}}  {text}" for name, text in lines)] if lines else []


def _range(results: Recording, values: Sequence[float]) -> str:
    low, high = _places(values)
    if values[low] == values[high]:
        return "constant"
    ends = (f"{values[i]:.4g} at {results.times[i]:.2f} s" for i in (low, high))
    return " to ".join(ends)


def _places(values: Sequence[float]) -> tuple[int, int]:
    """Where the least and the largest value are first."""
    numbers = list(values)
    return numbers.index(min(numbers)), numbers.index(max(numbers))


def _controllers(results: Recording) -> list[str]:
    """What each call of a controller outside the kernel took, on average."""
    head = "controller_calls."
    lines = []
    for key, calls in results.statistics.items():
        if key.startswith(head):
            name = key.removeprefix(head)
            mean = float(results.statistics[f"controller_mean_time.{name}"])
            lines.append(f"  controller {name}: {int(calls)} calls, {1e6 * mean:.3g} us each")
    return lines


def _work(results: Recording) -> list[str]:
    """The work of each load over the run, largest first, and the kinetic energy that came of it."""
    head, least = "energy/work/", 1e-3
    channels = map(results.channel, results.channels(f"{head}*"))
    done = {
        channel.name.removeprefix(head): channel.columns[0][-1]
        for channel in channels
        if len(results.times)
        and len(channel.columns) == 1
        and not str(channel.attributes.get("description", "")).startswith("Part of")
    }
    largest = max(map(abs, done.values()), default=0.0)
    if not largest > 0.0:
        return []
    scale, unit = next(((s, u) for s, u in _JOULES if largest >= s), (1.0, "J"))
    told = sorted(
        ((name, work) for name, work in done.items() if abs(work) >= least * largest),
        key=lambda item: -abs(item[1]),
    )
    parts = [f"{name} {work / scale:+.4g}" for name, work in told]
    moving = sum(done.values())
    return [f"  work in {unit}: {', '.join(parts)}; gain of kinetic energy {moving / scale:+.3g}"]


_JOULES = [(1e9, "GJ"), (1e6, "MJ"), (1e3, "kJ"), (1.0, "J"), (1e-3, "mJ")]


def _impacts(results: Recording) -> list[str]:
    """One line for each stop that was struck."""
    lines = []
    for name, table in results.impact_tables().items():
        times, _ = table["time"]
        impulse, unit = table["impulse"]
        lost, _ = table["energy_lost"]
        _, k = _places(impulse)
        lines.append(
            f"  {name}: struck {len(times)} times, largest impulse {impulse[k]:.4g} {unit} at "
            f"t = {times[k]:.4g} s, energy lost in all {math.fsum(lost):.4g} J"
        )
        if "peak_force" in table:
            peak, unit = table["peak_force"]
            lines[-1] += f", peak force {max(peak):.4g} {unit}"
    return lines


def _overloads(results: Recording) -> list[str]:
    """One line for each rope or mooring line that parts, or exceeds its breaking load."""
    lines = []
    for channel in results.channels("forces/*/tension_ratio"):
        name = channel.split("/")[1]
        if f"forces/{name}/parted" in results:
            lines += _parting(results, name)
            continue
        ratio = results.channel(channel).columns[0]
        first = next((k for k, value in enumerate(ratio) if value > 1.0), None)
        if first is None:
            continue
        times, (_, most) = results.times, _places(ratio)
        lines.append(
            f"  {name}: BREAKING LOAD EXCEEDED from t = {times[first]:.4g} s, at most "
            f"{ratio[most]:.3g} times at t = {times[most]:.4g} s; the line goes on unbroken"
        )
    return lines


def _parting(results: Recording, name: str) -> list[str]:
    """That this rope or line has parted, when and where."""
    place = results.channel(f"forces/{name}/parted").columns[0]
    if not len(place) or not place[-1]:
        return []
    at = results.channel(f"forces/{name}/parted_at").columns[0][-1]
    if f"forces/{name}/tension_along" in results:
        segments = len(results.channel(f"forces/{name}/tension_along").columns)
        where = f" in segment {int(place[-1])} of {segments}, counted from end A"
    elif f"forces/{name}/length_on_seabed" in results:
        where = f" in part {int(place[-1])}, counted from end A"
    else:
        where = ""
    return [f"  {name}: PARTED at t = {at:.4g} s{where}"]


def _extrema(results: Recording, name: str) -> str:
    channel = results.channel(name)
    values = channel.columns[0]
    if not len(values):
        return "no samples"
    factor, unit = displayed(channel.unit)
    low, high = (
        f"{factor * values[i]:z8.3f} {unit} at {results.times[i]:.2f} s" for i in _places(values)
    )
    return f"{low}  to {high}"


def _energy_balance(results: Recording) -> str:
    """Largest error of the energy balance against the largest energy exchanged."""
    known = results.statistics
    if known.get("at_rest"):
        return "at rest: nothing has moved by more than rounding"
    if "relative_balance_error" in known and "energy_scale" in known:
        share, scale = (float(known[k]) for k in ("relative_balance_error", "energy_scale"))
        return f"energy balance: error at most {share:.1e} of {scale:.3g} J exchanged"
    # a file of an earlier version, or one cut short
    if "energy/balance_error" not in results or "energy/kinetic" not in results:
        return ""
    error = results.channel("energy/balance_error").columns[0]
    kinetic = results.channel("energy/kinetic").columns[0]
    if "energy/kinetic_added_mass" in results:
        added = results.channel("energy/kinetic_added_mass").columns[0]
        kinetic = [abs(a) + b for a, b in zip(kinetic, added, strict=True)]
    largest = max(map(abs, kinetic), default=0.0)
    if not largest > 0:
        return ""
    share = max(map(abs, error)) / largest
    return f"energy balance: error at most {share:.1e} of the largest kinetic energy"
