"""Fields of errors: they outlive other processes, and a file is named once."""

from __future__ import annotations

import pickle
from pathlib import Path

from tests.errors import refused

from hydrodae.errors import DatabaseError
from hydrodae.support.naming import names_file


def test_a_file_is_named_once_with_its_line() -> None:
    @names_file
    def read(path: Path) -> None:
        raise DatabaseError("expected 3 numbers").about("format", "COG", line=7)

    outer = names_file(lambda path: read(Path("tiny.AH1")))
    with refused("format", "COG", file="tiny.AH1", line=7) as caught:
        outer(Path("folder"))
    error = caught.value
    assert str(error) == "tiny.AH1:7: expected 3 numbers"
    assert str(error.within("body float", " (again)")) == (
        "body float: tiny.AH1:7: expected 3 numbers (again)"
    )


def test_fields_come_back_from_another_process() -> None:
    error = DatabaseError("holes").about("mesh", "holes", file="hull.stl", line=2)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), vars(again)) == ("hull.stl:2: holes", vars(error))
