"""YAML files of OrcaFlex and OrcaWave: all numbers are floats, all other words are text."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.text import read_text
from hydrodae.support.naming import names_file

#: `1`, `2.5e3`, `-1e-6`, and `Infinity` as OrcaFlex writes it.
_FLOAT = re.compile(r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|\.?inf(?:inity)?)$", re.IGNORECASE)
_NULL = re.compile(r"~?$")
_BASE: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _Loader(_BASE):
    """Numbers and nothing; no dates, no yes and no, no 12:30 as a number in base 60."""

    yaml_implicit_resolvers: dict[str, Any] = {}  # noqa: RUF012


def _number(loader: Any, node: Any) -> float:
    return float(str(loader.construct_scalar(node)).lower().replace(".inf", "inf"))


_Loader.add_implicit_resolver("tag:yaml.org,2002:float", _FLOAT, list("-+.0123456789iI"))
_Loader.add_implicit_resolver("tag:yaml.org,2002:null", _NULL, ["~", ""])
_Loader.add_constructor("tag:yaml.org,2002:float", _number)


@names_file
def read_yaml(path: Path) -> dict[str, Any]:
    """Read a data file of OrcaFlex or OrcaWave.

    Returns
    -------
    dict
        Mappings, lists, numbers (float) and text; None for `~`. Empty for an empty file.

    Raises
    ------
    DatabaseError
        Not YAML, or no mapping; the message names file and line.
    """
    try:
        value = yaml.load(read_text(path), Loader=_Loader)
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = 0 if mark is None else mark.line + 1
        what = getattr(error, "problem", None) or str(error)
        raise DatabaseError(f"not YAML: {what}").about("format", line=line) from None
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise DatabaseError("not a data file of OrcaFlex: expected `key: value`").about("format")
    return value
