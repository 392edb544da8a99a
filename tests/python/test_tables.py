"""The fields of the kernel wherever they go: schema, `hydrodae keys`, messages."""

from __future__ import annotations

import importlib.util
import json
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.python.json_schema import errors

from hydrodae import _core
from hydrodae.case.case import to_toml
from hydrodae.case.schema import case_schema
from hydrodae.case.tables import Key, Table, find, tables
from hydrodae.commands import cli
from hydrodae.errors import CaseError

ENTRIES = [
    pytest.param(table, kind, id=table.name + (f".{kind.name}" if table.types else ""))
    for table in tables()
    for kind in table.types or (table,)
]
SCHEMA = case_schema()


def test_every_case_of_the_repository_fits_the_schema(repository: Path) -> None:
    read = {
        file: tomllib.loads(file.read_text())
        for file in sorted((repository / "cases").rglob("*.toml"))
    }
    cases = {file: case for file, case in read.items() if "case" not in case}  # else a study
    assert len(cases) > 20
    for file, case in cases.items():
        assert errors(SCHEMA, case) == [], file
        if importlib.util.find_spec("jsonschema"):  # not required: the small validator does
            import jsonschema

            jsonschema.Draft202012Validator(SCHEMA).validate(case)


def good_number(key: Key) -> float:
    low, high = key.minimum, key.maximum
    if low is None:
        return 0.5 if high is None else min(0.5, high)
    number = low + 1.0 if high is None else low + 0.5 * min(high - low, 2.0)
    return float(round(number)) if key.kind == "integer" else number


def good_value(key: Key) -> Any:
    number: float = good_number(key)
    if key.kind == "integer":
        number = int(number)
    word = key.choices[0] if key.choices else "some_name"
    return {
        "truth": True,
        "word": word,
        "words": [word],
        "numbers": [number],
        "points": [[number] * 3],
        "vector3": [number] * 3,
        "vector6": [number] * 6,
        "matrix6": [[number] * 6] * 6,
    }.get(key.kind, number)


def bad_values(key: Key) -> Iterator[Any]:
    yield {"a": 1}
    yield "some_name" if key.kind not in ("word", "words") or key.choices else 1
    yield True if key.kind != "truth" else 1
    yield [1.0] * 7 if key.kind not in ("numbers", "points") else []
    if key.kind == "integer":
        yield 2.5
    beyond = []
    if key.minimum is not None:
        beyond.append(key.minimum if key.above_minimum else key.minimum - 1)
    if key.maximum is not None:
        beyond.append(key.maximum * 2 + 1)
    for number in beyond:
        value = int(number) if key.kind == "integer" else number
        yield {"vector3": [value] * 3, "numbers": [value]}.get(key.kind, value)


def accepted(table: Table, entry: dict[str, Any]) -> bool:
    """Do kernel and schema take an entry? They must agree."""
    text = table.header + "\n" + "".join(f"{key} = {to_toml(v)}\n" for key, v in entry.items())
    try:
        _core.check_tables(text)
        kernel = True
    except CaseError:
        kernel = False
    schema = SCHEMA["properties"][table.name]
    value = [entry] if table.is_list else entry
    assert (errors(schema, value) == []) == kernel, (text, errors(schema, value))
    return kernel


@pytest.mark.parametrize(("table", "kind"), ENTRIES)
def test_schema_and_kernel_agree_on_each_key(table: Table, kind: Table) -> None:
    least = {key.name: good_value(key) for key in kind.keys if key.required}
    assert accepted(table, least)
    for key in kind.keys:
        assert accepted(table, {**least, key.name: good_value(key)}), key
        for word in key.choices if key.is_number else ():  # "equilibrium" for a mass
            assert accepted(table, {**least, key.name: word}), (key, word)
        for value in bad_values(key):
            assert not accepted(table, {**least, key.name: value}), (key, value)
    for inner in kind.nested:
        needed = {key.name: good_value(key) for key in inner.keys if key.required}
        for key in inner.keys:
            entry = {**least, inner.name: {**needed, key.name: good_value(key)}}
            assert accepted(table, entry), key
            for value in bad_values(key):
                entry = {**least, inner.name: {**needed, key.name: value}}
                assert not accepted(table, entry), (key, value)
        assert not accepted(table, {**least, inner.name: {"unknown": 1}})
    assert not accepted(table, {**least, "unknown": 1})


@pytest.mark.parametrize(
    ("table", "entry"),
    [
        ("joint", {"type": "revolute", "length": 1.0}),
        ("joint", {"type": "revolute"}),
        ("joint", {"type": "hinge"}),
        ("joint", {}),
    ],
)
def test_the_schema_knows_the_keys_of_each_type(table: str, entry: dict[str, Any]) -> None:
    joint = {"name": "a", "body_a": "b", "body_b": "c", "point": [0, 0, 0], "axis": [0, 0, 1]}
    schema = SCHEMA["properties"][table]
    assert errors(schema, [{**joint, "type": "revolute"}]) == []
    assert errors(schema, [{**{k: joint[k] for k in joint if k != "axis"}, **entry}]) != []


def test_the_schema_is_printed(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["schema"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed == json.loads(json.dumps(SCHEMA))
    assert printed["required"] == ["body", "solver"]
    body = printed["properties"]["body"]["items"]["properties"]
    numbers = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}
    doc = "Centre of gravity in the reference pose, world axes. [m]"
    assert body["center_of_gravity"] == {"description": doc, **numbers}
    assert body["mass"]["anyOf"] == [
        {"type": "number", "minimum": 0.0},
        {"type": "string", "enum": ["equilibrium"]},
    ]


def keys_printed(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    assert cli.main(["keys", *words]) == 0
    return capsys.readouterr().out


def test_keys_lists_tables_types_and_keys(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    listed = keys_printed(capsys)
    assert all(table.header in listed for table in tables())
    of_list = keys_printed(capsys, "force")
    assert "pto_linear" in of_list
    assert "neutral" not in of_list
    of_type = keys_printed(capsys, "force", "pto_linear").splitlines()
    row = next(line for line in of_type if line.startswith("damping"))
    assert row.split() == "damping N s/m or N m s/rad 0 >= 0 Damping c.".split()
    assert not any(line.startswith("force ") for line in of_type)
    assert any(
        line.startswith("initial.angle_deg")
        for line in keys_printed(capsys, "joint", "revolute").splitlines()
    )


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["sover"], "there is no table 'sover'; did you mean 'solver'?"),
        (["force", "pto_liner"], "[[force]] has no type 'pto_liner'; did you mean 'pto_linear'?"),
        (["solver", "ida"], "[solver] has no types"),
        (["pto_linear"], "there is no table 'pto_linear'; it is a type of [[force]]"),
    ],
)
def test_unknown_names_are_told_with_the_nearest(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["keys", *words]) == 2
    assert message in capsys.readouterr().err


def test_ranges_are_told_in_few_signs() -> None:
    assert [key.allowed for key in find("solver").keys if key.name in ("rtol", "end_time")] == [
        "> 0",
        "1e-13 to 0.1",
    ]
    assert find("wave", "jonswap").keys[0].allowed == ""


def test_an_unknown_key_is_told_with_those_of_its_own_type() -> None:
    entry = '[[force]]\nname = "p"\ntype = "pto_linear"\njoint = "h"\ndampng = 1\n'
    with pytest.raises(CaseError, match=r"did you mean 'damping'\? \(valid: name, type, joint, "):
        _core.check_tables(entry)
    wave = '[[wave]]\nname = "w"\ntype = "regular"\nheigt = 1\n'
    with pytest.raises(CaseError, match="did you mean 'height'") as told:
        _core.check_tables(wave)
    assert "significant_height" not in str(told.value)
    hinge = (
        '[[joint]]\nname = "h"\ntype = "revolute"\nbody_a = "a"\nbody_b = "b"\npoint = [0, 0, 0]\n'
    )
    with pytest.raises(CaseError, match=r"'angl' in initial of .*; valid: angle_deg, angle_rate$"):
        _core.check_tables(hinge + "initial = { angl = 1 }\n")
