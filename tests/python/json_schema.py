"""A validator of JSON schemas that knows what the schema of case files uses, and no more."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Schema = dict[str, Any]

_TYPES: dict[str, Callable[[Any], bool]] = {
    "object": lambda x: isinstance(x, dict),
    "array": lambda x: isinstance(x, list),
    "string": lambda x: isinstance(x, str),
    "boolean": lambda x: isinstance(x, bool),
    "number": lambda x: isinstance(x, int | float) and not isinstance(x, bool),
    "integer": lambda x: isinstance(x, int) and not isinstance(x, bool),
}
_NOTES = {"$schema", "title", "description", "default"}


def errors(schema: Schema, value: Any, path: str = "") -> list[str]:
    """What is wrong with `value`; a keyword that is not known here raises KeyError."""
    found = []
    for keyword, rule in schema.items():
        if keyword not in _NOTES:
            found += _RULES[keyword](rule, value, path, schema)
    return found


def _type(rule: str, value: Any, path: str, _: Schema) -> list[str]:
    return [] if _TYPES[rule](value) else [f"{path}: not of type {rule}"]


def _properties(rule: Schema, value: Any, path: str, _: Schema) -> list[str]:
    given = [key for key in rule if isinstance(value, dict) and key in value]
    return [e for key in given for e in errors(rule[key], value[key], f"{path}.{key}")]


def _required(rule: list[str], value: Any, path: str, _: Schema) -> list[str]:
    missing = [key for key in rule if isinstance(value, dict) and key not in value]
    return [f"{path}.{key}: missing" for key in missing]


def _no_others(rule: bool, value: Any, path: str, schema: Schema) -> list[str]:
    assert rule is False
    others = set(value) - set(schema["properties"]) if isinstance(value, dict) else set()
    return [f"{path}.{key}: unknown" for key in sorted(others)]


def _items(rule: Schema, value: Any, path: str, _: Schema) -> list[str]:
    items = value if isinstance(value, list) else []
    return [e for i, item in enumerate(items) for e in errors(rule, item, f"{path}[{i}]")]


def _one_of(rule: list[Schema], value: Any, path: str, _: Schema) -> list[str]:
    count = sum(not errors(schema, value) for schema in rule)
    return [] if count == 1 else [f"{path}: {count} schemas match"]


def _any_of(rule: list[Schema], value: Any, path: str, _: Schema) -> list[str]:
    return [] if any(not errors(schema, value) for schema in rule) else [f"{path}: none matches"]


def _limit(good: Callable[[float, float], bool], word: str, kind: type) -> Callable[..., list[str]]:
    def check(rule: float, value: Any, path: str, _: Schema) -> list[str]:
        number = len(value) if kind is list and isinstance(value, list) else value
        if isinstance(number, bool) or not isinstance(number, int | float) or good(number, rule):
            return []
        return [f"{path}: must be {word} {rule}"]

    return check


_RULES: dict[str, Callable[..., list[str]]] = {
    "type": _type,
    "properties": _properties,
    "required": _required,
    "additionalProperties": _no_others,
    "items": _items,
    "oneOf": _one_of,
    "anyOf": _any_of,
    "enum": lambda rule, value, path, _: [] if value in rule else [f"{path}: not among {rule}"],
    "minimum": _limit(lambda a, b: a >= b, ">=", float),
    "exclusiveMinimum": _limit(lambda a, b: a > b, ">", float),
    "maximum": _limit(lambda a, b: a <= b, "<=", float),
    "minItems": _limit(lambda a, b: a >= b, ">= items", list),
    "maxItems": _limit(lambda a, b: a <= b, "<= items", list),
}
