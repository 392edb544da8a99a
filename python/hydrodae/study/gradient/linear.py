"""Gradients of the linear models: differences of the response in the sea of a case."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from hydrodae.case import Case
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel
from hydrodae.study.gradient.differences import slopes_of
from hydrodae.study.gradient.parameters import Parameter
from hydrodae.study.gradient.quantity import Found, Quantity
from hydrodae.study.spectral import spectral
from hydrodae.study.sweep.rungs import linear_name, unit_of

#: Standard deviations of the channels and mean powers of the forces.
Measured = tuple[dict[str, float], dict[str, float]]
#: Change of the linear equivalents that ends their iteration: a difference divides it by the step
#: of a thousandth.
TOLERANCE, MOST = 1e-11, 5000


def linear_gradient(case: Case, what: Quantity, parameters: Sequence[Parameter]) -> Found:
    """Value and gradient of a quantity of the linear response in the sea of a case.

    Raises
    ------
    CaseError
        There is no such quantity here, or the case cannot be linearised nearby.
    """
    return _gradient(case, what, parameters, LinearModel.irregular)


def spectral_gradient(case: Case, what: Quantity, parameters: Sequence[Parameter]) -> Found:
    """Value and gradient of a quantity of the motion that `hydrodae.spectral` finds.

    Raises
    ------
    CaseError
        There is no such quantity here, the case cannot be linearised nearby, or the equivalents do
        not settle.
    """

    def measured(model: LinearModel) -> Measured:
        found = spectral(model, tolerance=TOLERANCE, iterations=MOST)
        return found.standard_deviation, found.power

    return _gradient(case, what, parameters, measured)


def _gradient(
    case: Case,
    what: Quantity,
    parameters: Sequence[Parameter],
    measured: Callable[[LinearModel], Measured],
) -> Found:
    model = LinearModel(case)

    def value(there: Case) -> float:
        return _value(what, there, *measured(LinearModel(there).sharing_tables_of(model)))

    unit = "W" if what.measure is None else unit_of(what.measure)
    return slopes_of(value, case, parameters, unit)


def _value(
    what: Quantity, case: Case, deviation: dict[str, float], power: dict[str, float]
) -> float:
    if what.measure is None:
        return sum(power.get(name, 0.0) for name in what.take_offs(case))
    name = linear_name(what.measure)
    if what.measure.statistic == "mean" and name in power:
        return power[name]
    if name not in deviation:
        raise CaseError(
            f"{what.name}: the frequency domain has no channel {name!r}; there are: "
            f"{', '.join(deviation)}"
        )
    if what.measure.statistic != "std":
        raise CaseError(
            f"{what.name}: the frequency domain knows the statistic 'std' only, not "
            f"{what.measure.statistic!r}"
        )
    return deviation[name]
