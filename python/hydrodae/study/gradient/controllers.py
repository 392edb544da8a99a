"""Which controllers of a case leave its results differentiable."""

from __future__ import annotations

from collections.abc import Sequence

from hydrodae.case import Case
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.study.gradient.parameters import Parameter

#: Why runs with a controller of a type have no derivative that differences of them would give.
NOT_SMOOTH = {
    "bang_bang": "it switches at its instants, so that results jump",
    "latching": "it switches at events, whose number and order may change",
    "declutching": "it switches at events, whose number and order may change",
    "python": "nothing is known of what it answers",
    "tcp": "nothing is known of what it answers",
    "fmu": "nothing is known of what it answers",
}
#: Keys of a controller that say when it acts.
INSTANTS = ("period", "delay")


def require_smooth(case: Case, parameters: Sequence[Parameter], rung: str) -> None:
    """Refuse, by name, a controller that a gradient would leave out or be wrong with.

    Raises
    ------
    CaseError
    """
    controllers = case_tables(case).get("controller", [])
    for controller in controllers:
        name, kind = controller["name"], controller["type"]
        if rung != "time":
            raise CaseError(
                f"controller.{name}: the {rung} domain has no controllers, and its gradient "
                "would be that of another device; take rung='time', or a case without it"
            )
        if kind in NOT_SMOOTH:
            raise CaseError(
                f"controller.{name}: no gradient through a {kind} controller: {NOT_SMOOTH[kind]}"
            )
    for parameter in parameters:
        for place, _ in parameter.places:
            table, _, rest = place.partition(".")
            if table == "controller" and rest.rpartition(".")[2] in INSTANTS:
                raise CaseError(
                    f"{place}: no gradient with respect to it: the instants of the controller "
                    "would move through the fixed steps of the runs"
                )
