"""Methods of a chart: how their names are written, and what is turned to make them more exact."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from hydrodae import _core
from hydrodae.errors import CaseError
from hydrodae.support.nearest import did_you_mean

#: What the kernel says of each integrator, by name; "auto" chooses among them.
TRAITS: dict[str, dict[str, Any]] = {
    "auto": {"orders": (), "adapts": True, "fixes": False, "limits_order": False},
    **{traits["name"]: traits for traits in _core.methods()},
}
#: Tolerance of Newton's iteration in Runge-Kutta methods of fixed steps, below any useful error.
_NEWTON = 1e-10

#: Methods whose own error test chooses the steps, the most trusted first.
ADAPTIVE = tuple(name for name, traits in TRAITS.items() if traits["adapts"] and name != "auto")
#: Those, and the ones of fixed steps that have one order.
SHORT_METHODS = (
    *ADAPTIVE,
    *(name for name, t in TRAITS.items() if not t["adapts"] and not t["orders"]),
)
#: What a chart compares by default; three orders of a method with many, the lowest of one with few.
METHODS = (
    "auto",
    *SHORT_METHODS,
    *(f"{n}:{o}" for n in ADAPTIVE for o in TRAITS[n]["orders"][2:7:2] or TRAITS[n]["orders"][:1]),
)
#: Relative tolerances of the adaptive methods.
TOLERANCES = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)


@dataclass(frozen=True)
class Method:
    """An integrator, at a fixed order or at one of its own choice.

    Attributes
    ----------
    name : str
        As the key `method` of [solver].
    order : int
        0: the method chooses. For ida the highest order.
    """

    name: str
    order: int = 0

    @property
    def label(self) -> str:
        """Name and order as on the command line, such as "radau:13"."""
        return f"{self.name}:{self.order}" if self.order else self.name

    @property
    def adaptive(self) -> bool:
        """Whether a tolerance chooses the step."""
        return bool(TRAITS[self.name]["adapts"])

    @property
    def knob(self) -> str:
        """The key of [solver] that trades accuracy for time: rtol [-] or step [s]."""
        return "rtol" if self.adaptive else "step"

    def solver(self, setting: float) -> dict[str, Any]:
        """Keys of [solver] that run this method with `setting`, an rtol [-] or a step [s]."""
        keys: dict[str, Any] = {"method": self.name}
        if self.order:
            limited = TRAITS[self.name]["limits_order"]
            keys["max_order" if limited else "order"] = self.order
        if not self.adaptive and TRAITS[self.name]["orders"]:
            keys["rtol"] = _NEWTON
        keys[self.knob] = float(setting)
        return keys

    def values(self, setting: float) -> dict[str, Any]:
        """Values by dotted key for a `Case`, so that nothing of the case's own method stays."""
        clean = {"step": 0.0, "order": 0, "max_order": 5, "accuracy": "none"}
        if not TRAITS[self.name].get("takes_radius"):
            clean["spectral_radius"] = 0.8  # the default
        return {f"solver.{key}": value for key, value in {**clean, **self.solver(setting)}.items()}


def parse_method(spec: str) -> Method:
    """Read "name" or "name:order".

    Raises
    ------
    CaseError
        There is no such method, or it has no such order.

    Examples
    --------
    >>> parse_method("radau:13").solver(1e-6)
    {'method': 'radau', 'order': 13, 'rtol': 1e-06}
    """
    name, colon, order = (part.strip() for part in spec.partition(":"))
    if name not in TRAITS:
        hint = did_you_mean(name, TRAITS, f"; there are {', '.join(TRAITS)}")
        raise CaseError(f"{spec!r}: no such method{hint}")
    if not colon:
        return Method(name)
    traits = TRAITS[name]
    orders = range(1, 6) if traits["limits_order"] else traits["orders"]
    if not orders:
        raise CaseError(f"{spec!r}: {name} has no choice of order; leave out ':{order}'")
    if not order.isdecimal() or int(order) not in orders:
        known = ", ".join(map(str, orders))
        raise CaseError(f"{spec!r}: {name} has no order {order!r}; it has {known}")
    return Method(name, int(order))


def parse_methods(specs: Iterable[str]) -> list[Method]:
    """Read several methods, each once; raises CaseError as `parse_method`, or if there is none."""
    methods = list(dict.fromkeys(map(parse_method, specs)))
    if not methods:
        raise CaseError("a chart needs a method at least")
    return methods


def check_ladder(values: Iterable[float], what: str, lowest: float, highest: float) -> list[float]:
    """The rungs from loose to tight, each once.

    Raises
    ------
    CaseError
        There are none, or one lies outside `lowest` to `highest`.
    """
    ladder = sorted({float(value) for value in values}, reverse=True)
    if not ladder:
        raise CaseError(f"{what}: at least one is needed")
    for value in ladder:
        if not lowest <= value <= highest:
            raise CaseError(f"{what}: {value:g} is not between {lowest:g} and {highest:g}")
    return ladder


def step_ladder(mean_step: float, output_step: float, rungs: int) -> list[float]:
    """Fixed steps from about 4 times `mean_step` down, each half the one before.

    Parameters
    ----------
    mean_step : float, s
        What an adaptive method takes on the average at a middling tolerance.
    output_step : float, s
        Interval of the output. The steps are this by a whole number, or a whole number of this, so
        that short ones meet the output times and nothing is interpolated.
    rungs : int

    Returns
    -------
    list of float, s
        Longest first.

    Examples
    --------
    >>> step_ladder(0.03, 0.05, 4)
    [0.1, 0.05, 0.025, 0.0125]
    """
    first = 4.0 * mean_step
    power = 0
    while output_step * 2.0**power < first / 1.5:
        power += 1
    while output_step * 2.0**power > first * 1.5:
        power -= 1
    return [output_step * 2.0 ** (power - k) for k in range(rungs)]
