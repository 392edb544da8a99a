"""Errors of databases that name the file they are about."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from pathlib import Path
from typing import Any, TypeVar, cast

from hydrodae.errors import DatabaseError

Reader = TypeVar("Reader", bound=Callable[..., Any])


def names_file(read: Reader) -> Reader:
    """Wrap a function that reads a file, its first argument: its errors name the file."""

    @wraps(read)
    def named(path: str | Path, *args: Any, **options: Any) -> Any:
        try:
            return read(path, *args, **options)
        except DatabaseError as error:
            error.in_file(Path(path))
            raise

    return cast(Reader, named)
