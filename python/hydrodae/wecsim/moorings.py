"""Moorings of a model as forces of a case."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from hydrodae.errors import CaseError
from hydrodae.mooring import read_moordyn
from hydrodae.mooring.moordyn_deck import read_deck
from hydrodae.wecsim.bodies import Bodies, _short, _six
from hydrodae.wecsim.objects import InputFile, Item
from hydrodae.wecsim.slx import Block
from hydrodae.wecsim.text import CaseText
from hydrodae.wecsim.topology import MOORDYN, plain_name


def add_mooring(
    text: CaseText, block: Block, place: str, body: int | None, bodies: Bodies, read: InputFile
) -> None:
    """Add the forces of a mooring block; what is not read goes to the remarks."""
    match = re.search(r"mooring\((\d{1,9})\)", block.parameters.get("mooring", "mooring(1)"))
    item = read.get("mooring", int(match.group(1)) if match else 1)
    if item is None or body is None:
        why = "holds no body" if body is None else f"no mooring in {read.path.name}"
        read.remarks.left_out(place, why, "mooring")
        return
    if block.kind == "MooringMatrix":
        _matrix(text, item, body, bodies)
    elif block.kind in MOORDYN or item.number_of("moorDyn"):
        _moordyn(text, item, body, bodies, read)
    else:
        _all_used(item)
        read.remarks.left_out(
            place,
            f"{item.title}: {block.kind}; `catenary` and `line` are the moorings with lines here",
            "mooring",
        )


def _all_used(item: Item) -> None:
    item.used |= set(item.entries)


def _name(item: Item) -> str:
    name = item.arguments[0] if item.arguments else None
    return plain_name(name if isinstance(name, str) else item.title, item.title)


def _matrix(text: CaseText, item: Item, body: int, bodies: Bodies) -> None:
    """A matrix about a point of the body, moved to its centre of gravity."""
    stiffness, damping = _six(item.get("matrix.stiffness")), _six(item.get("matrix.damping"))
    pretension = item.vector("matrix.preTension", np.zeros(6))
    pretension = np.pad(pretension, (0, max(6 - pretension.size, 0)))[:6]
    point = item.vector("location", [0.0, 0.0, 0.0])
    offset = item.vector("initial.displacement", [0.0, 0.0, 0.0])
    item.used |= {"initial.axis", "initial.angle"}
    shift, _ = bodies.start(body)
    arm = point + offset - shift - bodies.center_of_gravity(body)
    move = np.eye(6)
    move[:3, 3:] = -np.array(
        [[0.0, -arm[2], arm[1]], [arm[2], 0.0, -arm[0]], [-arm[1], arm[0], 0.0]]
    )
    # the displacement counts from `location`; that here from the reference pose of the body
    counted = np.concatenate([offset - shift, np.zeros(3)])
    force = move.T @ (pretension - stiffness @ counted)
    keys: dict[str, Any] = {
        "type": "mooring_matrix",
        "name": _name(item),
        "body": bodies.names[body],
        "stiffness": _short(move.T @ stiffness @ move),
        "damping": _short(move.T @ damping @ move) if damping.any() else None,
        "pretension": force if np.abs(force).max() > 0.0 else None,
    }
    text.table("[[force]]", keys, f"{item.title}, about the centre of gravity")


def _moordyn(text: CaseText, item: Item, body: int, bodies: Bodies, read: InputFile) -> None:
    stated = item.text("moorDynInputFile", "Mooring/lines.txt").replace("\\", "/")
    _all_used(item)
    place = read.place(item.line)
    path = read.path.parent / stated
    if not path.is_file():
        read.remarks.left_out(place, f"{item.title}: {path} is not there", "mooring")
        return
    shift, _ = bodies.start(body)
    origin = item.vector("location", np.zeros(3)) + item.vector("initial.displacement", np.zeros(3))
    name = bodies.names[body]
    try:
        coupled = [k for k, b in read_deck(path).bodies.items() if b.attachment == "coupled"]
        at = {key: list(origin - shift) for key in coupled or [""]}
        held = dict.fromkeys(coupled or ["1"], name)
        made = read_moordyn(path, body=name, at=at, bodies=held, type="line")
    except CaseError as error:
        read.remarks.left_out(place, f"{item.title}: {error}", "mooring")
        return
    text.lines += ["", *made.to_toml().rstrip().splitlines()]
    for note in made.notes:  # each below its own file and line
        read.remarks.assumed(*note.split(": ", 1))
    read.remarks.assumed(
        place,
        f"{item.title}: dynamic lines (`line`); `hydrodae mooring import --type catenary` makes "
        "faster ones, at rest at each instant",
    )
