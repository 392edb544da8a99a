"""The body that stands for a scene where a load is known of all bodies together only."""

from __future__ import annotations

from dataclasses import dataclass

from hydrodae.case.contents import case_tables
from hydrodae.linear import LinearModel
from hydrodae.mooring.stiffness import holds
from hydrodae.support.arrays import Array


@dataclass(frozen=True)
class Carrier:
    """A body of the case.

    Attributes
    ----------
    body : str
        Its name in the case.
    hydro : str
        Its name in the database.
    place : (3,) array
        Its centre of gravity in the equilibrium [m].
    """

    body: str
    hydro: str
    place: Array


def carrier_of(model: LinearModel) -> Carrier:
    """Return the body that the moorings hold if it is one, else the largest body in the water."""
    bodies = case_tables(model.case).get("body", [])
    found = {body["hydro"]: body["name"] for body in bodies if "hydro" in body}
    database = model.database
    assert database is not None  # a case with wet bodies has one
    moored = [name for hold in holds(model) for name in hold.held if name in found.values()]
    if len(set(moored)) == 1:
        found = {hydro: body for hydro, body in found.items() if body == moored[0]}

    def volume(name: str) -> float:
        statics = database.bodies[name].hydrostatics
        return 0.0 if statics is None else statics.displaced_volume

    hydro = max(found, key=volume)
    return Carrier(found[hydro], hydro, model.places[found[hydro]])
