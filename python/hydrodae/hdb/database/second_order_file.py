"""The group `second_order` of `hydro.h5`: a group for each kind of table."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import h5py
import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.layout import (
    COMPLEX,
    TEXT,
    Entry,
    read_group,
    refused,
    write_dataset,
)
from hydrodae.hdb.database.second_order import KINDS, SecondOrderTable


def _layout(kind: str) -> dict[str, Entry]:
    dims = (*("w",) * KINDS[kind].axes, "h", "n")
    return {
        "coordinates": Entry(("n",), TEXT),
        "method": Entry(("n",), TEXT),
        "omega": Entry(("w",), unit="rad/s"),
        "heading1": Entry(("h",), unit="rad"),
        "heading2": Entry(("h",), unit="rad"),
        "values": Entry(dims, COMPLEX, "N/m2, N m/m2"),
        "computed": Entry(dims),
    }


def write_second_order(group: h5py.Group, tables: Mapping[str, SecondOrderTable]) -> None:
    """Write each table as a group by its kind."""
    for kind, table in tables.items():
        target = group.create_group(kind)
        target.attrs["source"] = table.source
        for name, entry in _layout(kind).items():
            value = getattr(table, name)
            value = value.astype(np.uint8) if name == "computed" else value
            write_dataset(target, name, entry, value)


def read_second_order(group: h5py.Group) -> dict[str, SecondOrderTable]:
    """Read what `write_second_order` wrote.

    Raises
    ------
    DatabaseError
        A dataset is missing, or of another type or shape; an unknown kind of table.
    """
    found = {}
    for kind in group:
        if kind not in KINDS:
            raise refused(group, kind, "label", f"expected one of {', '.join(KINDS)}")
        layout = _layout(kind)
        values: dict[str, Any] = read_group(group[kind], layout)
        if missing := [name for name in layout if name not in values]:
            raise refused(group[kind], missing[0], "missing", "missing dataset")
        values["computed"] = values["computed"] != 0.0
        source = group[kind].attrs.get("source", "")
        try:
            found[kind] = SecondOrderTable(kind, **values, source=str(source))
        except DatabaseError as error:
            raise error.in_file(group.file.filename) from None
    return found
