"""JSON schema of case files, for editors that check and complete TOML by one."""

from __future__ import annotations

import json
from typing import Any

from hydrodae.case.tables import Key, Table, tables

Schema = dict[str, Any]


def case_schema() -> Schema:
    """Return the schema of case files (draft 2020-12).

    It holds what can be said of one table by itself: keys, types of entries, units, ranges and
    words. What compares tables with each other only `hydrodae check` shows.
    """
    schema: Schema = {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "hydrodae case",
        "description": "A case of hydrodae: bodies, joints, forces, sea and solver. SI units.",
        "type": "object",
        "properties": {
            "title": {"type": "string", "description": "Title of the case."},
            "missing": {
                "type": "array",
                "items": {"type": "string"},
                "description": "Parts of the modelled device that the case lacks; each is a note.",
            },
            **{table.name: _table_schema(table) for table in tables()},
        },
        "required": [table.name for table in tables() if table.required],
        "additionalProperties": False,
    }
    return schema


def _table_schema(table: Table) -> Schema:
    if not table.is_list:
        return _object(table)
    if not table.types:
        items = _object(table)
    else:
        items = {
            "type": "object",
            "required": ["type"],
            "oneOf": [{"title": kind.name, **_object(kind)} for kind in table.types],
        }
    schema: Schema = {"description": table.doc, "type": "array", "items": items}
    return {**schema, "minItems": 1} if table.required else schema


def _object(table: Table) -> Schema:
    """A table with its keys, and no others."""
    schema: Schema = {
        "description": table.doc,
        "type": "object",
        "properties": {
            **{key.name: _key_schema(key) for key in table.keys},
            **{inner.name: _object(inner) for inner in table.nested},
        },
        "additionalProperties": False,
    }
    needed = [key.name for key in table.keys if key.required]
    return {**schema, "required": needed} if needed else schema


def _key_schema(key: Key) -> Schema:
    unit = "" if key.unit == "-" else f" [{key.unit}]"
    value = _value_schema(key)
    if key.is_number and key.choices:
        value = {"anyOf": [value, {"type": "string", "enum": list(key.choices)}]}
    schema = {"description": key.doc + unit, **value}
    if key.default:
        schema["default"] = json.loads(key.default)
    return schema


#: Numbers that are no floating-point ones, in the words of the schema.
_NUMBERS = {"integer": "integer"}


def _value_schema(key: Key) -> Schema:
    number = {"type": _NUMBERS.get(key.kind, "number"), **_range(key)}
    word: Schema = {"type": "string", **({"enum": list(key.choices)} if key.choices else {})}
    six = _list(number, 6)
    match key.kind:
        case "number" | "integer":
            return number
        case "truth":
            return {"type": "boolean"}
        case "word":
            return word
        case "words":
            return {"anyOf": [word, {"type": "array", "items": word}]}
        case "numbers":
            return {"type": "array", "items": number, "minItems": 1}
        case "points":
            return {"type": "array", "items": _list(number, 3), "minItems": 1}
        case "vector3":
            return _list(number, 3)
        case "vector6":
            return six
        case "matrix6":
            return {"anyOf": [six, _list(six, 6)]}
    raise AssertionError(f"a key of kind {key.kind!r}")


def _range(key: Key) -> Schema:
    limits: Schema = {}
    if key.minimum is not None:
        limits["exclusiveMinimum" if key.above_minimum else "minimum"] = key.minimum
    if key.maximum is not None:
        limits["maximum"] = key.maximum
    return limits


def _list(items: Schema, count: int) -> Schema:
    return {"type": "array", "items": items, "minItems": count, "maxItems": count}
