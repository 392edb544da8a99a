"""Values that a reader may not expect, and how a case is written with them."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from random import Random
from typing import Any

NUMBERS: tuple[Any, ...] = (
    *(0, 1, -1, 2, 3, 7, 0.0, -0.0, 0.5, 1e-3, -1e-3, 1e3, 1e6, 1e9, 1e-9, 1e-15, 1e15),
    *(1e-300, 5e-324, 1e300, 1.7976931348623157e308, -1.7976931348623157e308),
    *(math.nan, math.inf, -math.inf),
    *(2**31 - 1, -(2**31), 2**32, 2**53 + 1, 2**63 - 1, -(2**63), 100000, 360.0, 1e-6),
)
TEXTS = (
    *("", " ", "x", "ground", "a.b", "../..", "/", ".", "#1", "'", '"', "\\", "\t", "\n", "\0"),
    *("é", "жук", "波", "\u202e", "\U0001f30a", "e\u0301", "a" * 300, "nan", "true", "1e5", "%s%n"),
)
DATES = ("1979-05-27", "07:32:00", "1979-05-27T07:32:00Z")


@dataclass(frozen=True)
class Raw:
    """A value written as it stands."""

    text: str


def number(random: Random) -> Any:
    """A number: extreme, or of any size."""
    if random.random() < 0.7:
        return random.choice(NUMBERS)
    return random.choice((-1, 1, 1, 1)) * 10.0 ** random.uniform(-12, 12)


def anything(random: Random, depth: int = 0) -> Any:
    """A value of any type."""
    kind = random.randrange(9 if depth < 2 else 5)
    if kind <= 1:
        return number(random)
    if kind == 2:
        return random.choice(TEXTS)
    if kind == 3:
        return random.random() < 0.5
    if kind == 4:
        return Raw(random.choice((*DATES, "0x1F", "+1_000", "1__0", "[", "{}", "'''a'''", "=", "")))
    if kind == 5:
        return {
            random.choice(TEXTS): anything(random, depth + 1) for _ in range(random.randrange(3))
        }
    return [anything(random, depth + 1) for _ in range(random.randrange(5))]


def near(value: Any, random: Random) -> Any:
    """A value of the same kind, or hardly."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        factor = random.choice((-1.0, 0.5, 2.0, 10.0, 0.1, 1e3, 1e-3, 1.0 + 1e-9))
        return random.choice(
            (value * factor, number(random), int(value) if abs(value) < 1e9 else 0)
        )
    if isinstance(value, str):
        at = random.randrange(len(value) + 1)
        return random.choice(
            (value[:at], value[:at] + random.choice(TEXTS) + value[at:], value.upper(), value * 2)
        )
    if isinstance(value, list) and value:
        at = random.randrange(len(value))
        changed = [*value]
        how = random.randrange(5)
        if how == 0:
            del changed[at]
        elif how == 1:
            changed.insert(at, changed[at])
        elif how == 2:
            random.shuffle(changed)
        elif how == 3:
            changed = changed * random.choice((2, 50))
        else:
            changed[at] = near(changed[at], random)
        return changed
    return anything(random)


def toml(value: Any) -> str:
    """A value as TOML on one line."""
    if isinstance(value, Raw):
        return value.text
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return repr(value) if not math.isnan(value) else "nan"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, list):
        return f"[{', '.join(map(toml, value))}]"
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{key(k)} = {toml(v)}' for k, v in value.items())} }}"
    return str(value)  # a date


def key(name: str) -> str:
    """A key, in quotes where it needs them."""
    plain = name.isascii() and name.replace("_", "a").replace("-", "a").isalnum()
    return name if plain else json.dumps(name, ensure_ascii=False)


def case_text(tables: dict[str, Any]) -> str:
    """A case by table, entries of lists as [[name]]."""
    lines = []
    for name, value in tables.items():
        entries = isinstance(value, list) and value and all(isinstance(v, dict) for v in value)
        if entries:
            for entry in value:
                lines += [f"[[{key(name)}]]", *(f"{key(k)} = {toml(v)}" for k, v in entry.items())]
        elif isinstance(value, dict):
            lines += [f"[{key(name)}]", *(f"{key(k)} = {toml(v)}" for k, v in value.items())]
        else:
            lines.insert(0, f"{key(name)} = {toml(value)}")
    return "\n".join(lines) + "\n"
