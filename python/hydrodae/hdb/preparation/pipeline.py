"""What happens to a database, stage by stage: the lists that the functions of this room run.

A stage is a function that takes one state, adds to it, and says in its docstring what it takes and
what it adds. Tables are in SI units and phasors e^{+iwt}: A, B (nw, n, n), forces (nw, nh, n).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeVar

from hydrodae.hdb.preparation import compute_stages as bem
from hydrodae.hdb.preparation import fit_stages as memory
from hydrodae.hdb.preparation import import_stages as tables
from hydrodae.hdb.preparation.compute_stages import Computation
from hydrodae.hdb.preparation.fit_stages import Fit
from hydrodae.hdb.preparation.import_stages import Import

State = TypeVar("State")
Stages = Sequence[tuple[str, Callable[[State], None]]]

#: From any source to a checked database with the names and points of the scene.
IMPORT: Stages[Import] = (
    ("read", tables.read_tables),
    ("cut", tables.cut),
    ("name the bodies", tables.name_bodies),
    ("state the points", tables.state_points),
    ("symmetrise and extend to infinity", tables.complete),
    ("second order", tables.add_second_order),
    ("arrange", tables.arrange),
    ("hydrostatics", tables.add_hydrostatics),
    ("keep", tables.keep),
    ("mirror", tables.mirror),
    ("check", tables.check_tables),
)
#: From tables to a fit of the radiation memory that is good enough to keep.
FIT: Stages[Fit] = (
    ("choose the band", memory.choose_band),
    ("leave out single frequencies", memory.leave_out_lone),
    ("look", memory.look),
    ("search", memory.search),
    ("judge", memory.judge),
    ("store", memory.store),
)
#: From panels to a checked database.
COMPUTE: Stages[Computation] = (
    ("hydrostatics of the panels", bem.weigh_panels),
    ("solve", bem.solve),
    *IMPORT,
    ("add the panels", bem.add_panels),
)


def names(stages: Stages[State]) -> list[str]:
    """Return the names of stages."""
    return [name for name, _ in stages]


def run(
    stages: Stages[State], state: State, progress: Callable[[str], None] | None = None
) -> State:
    """Run the stages one after the other on one state; `progress` gets the name of each."""
    for name, stage in stages:
        if progress is not None:
            progress(name)
        stage(state)
    return state
