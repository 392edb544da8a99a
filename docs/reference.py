"""Write the reference pages of case files.

    python docs/reference.py            # writes docs/reference/*.md
    python docs/reference.py --check    # prints which are out of date; exit code 1 if any is

All is made from the fields that the kernel declares beside its structs.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from pathlib import Path

from hydrodae.case.tables import Key, Table, tables

ROOT = Path(__file__).resolve().parent.parent
PAGES = Path("docs", "reference")
MADE = "<!-- Made by docs/reference.py from the fields of the kernel; do not edit. -->\n\n"

INTRODUCTION = """# Reference of case files

This page lists the tables of a case file, and links their keys. A case is one TOML file. Units are
SI, world axes have z up, and z = 0 is the still water line. Only keys that end in `_deg` are in
degrees. Unknown keys and values out of range are errors that name file, line, column and the
nearest valid name. Outside tables are `title`, and `missing`: texts that name parts of the modelled
device that the case lacks. Each run notes them.

`hydrodae keys` prints what stands here:

```sh
hydrodae keys
hydrodae keys solver
hydrodae keys force pto_linear
```

| table | meaning |
|---|---|
"""

EDITORS = """
## In an editor

`hydrodae schema > case.schema.json` writes a JSON schema (draft 2020-12) of case files. With it,
editors that use Taplo complete keys, show their meaning and mark what is wrong. Even Better TOML in
VS Code uses it, and many others do through its language server. Name it in the first line of a
case:

```toml
#:schema ./case.schema.json
title = "..."
```

or for all cases of a folder in its `.taplo.toml`:

<!-- not run: settings of an editor -->

```toml
[[rule]]
include = ["cases/**/*.toml"]
[rule.schema]
path = "./case.schema.json"
```

The schema knows one table at a time; what tables say of each other `hydrodae check` checks.

## In Python

Each table is a method of `hydrodae.Scene`, each type of a list with types too:
`scene.body("buoy", mass=..., ...)`, `scene.joint.revolute("hinge", ...)`; see
[Python](../python.md#scenes-in-python).

## A new key

A key is one line in the `fields()` of its struct, a force one struct: case reader, schema,
`hydrodae keys` and the methods of `hydrodae.Scene` follow. The build writes the stub of
`hydrodae.Scene` for editors. `python docs/reference.py` then writes these pages again; a test fails
if they are out of date.
"""


def pages() -> dict[Path, str]:
    """Every generated file of the repository by its path in it."""
    made = {PAGES / f"{table.name}.md": page(table) for table in tables()}
    made[PAGES / "README.md"] = index(tables())
    return made


def index(all_tables: Iterable[Table]) -> str:
    """The page that lists the tables."""
    rows = []
    for table in all_tables:
        types = ", ".join(f"[{t.name}]({table.name}.md#{t.name})" for t in table.types)
        need = " Every case has it." if table.required else ""
        meaning = escaped(table.doc) + need + (f" Types: {types}." if types else "")
        rows.append(f"| [`{table.header}`]({table.name}.md) | {meaning} |\n")
    return MADE + INTRODUCTION + "".join(rows) + EDITORS


def page(table: Table) -> str:
    """The page of one table: its keys, then those of each type."""
    text = f"{MADE}# `{table.header}`\n\n{table.doc}"
    text += " Every case has it.\n\n" if table.required else "\n\n"
    if table.types:
        text += "Keys of every type:\n\n"
    text += keys_table(table.keys) + nested_tables(table, "##")
    for kind in table.types:
        text += type_section(table, kind)
    return text


def type_section(table: Table, kind: Table) -> str:
    """What a type has beside what all types have."""
    shared = {key.name for key in table.keys}
    own = [key for key in kind.keys if key.name not in shared]
    text = f"\n## {kind.name}\n\n{kind.doc}\n\n"
    return text + (keys_table(own) if own else "No other keys.\n") + nested_tables(kind, "###")


def nested_tables(table: Table, heading: str) -> str:
    """The tables inside a table, written `name = { ... }`."""
    return "".join(
        f"\n{heading} {inner.name} = {{ ... }}\n\n{inner.doc}\n\n{keys_table(inner.keys)}"
        for inner in table.nested
    )


def keys_table(keys: Iterable[Key]) -> str:
    """Keys as a table of Markdown."""
    text = "| key | meaning | value | unit | default | allowed |\n|---|---|---|---|---|---|\n"
    for key in keys:
        default = "required" if key.required else f"`{key.default}`" if key.default else ""
        words = ", ".join(f"`{word}`" for word in key.choices if not key.is_number)
        cells = [f"`{key.name}`", key.doc, key.kind_text, key.unit, default, words or key.allowed]
        text += "| " + " | ".join(map(escaped, cells)) + " |\n"
    return text


def escaped(text: str) -> str:
    """Text for a cell of a table."""
    return text.replace("|", "\\|").replace("<", "&lt;")


def main(arguments: list[str]) -> int:
    """Write or compare the files; returns the exit code."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--check", action="store_true", help="only print which are out of date")
    check = parser.parse_args(arguments).check
    made = pages()
    old = {path for path in (ROOT / PAGES).glob("*.md")} - {ROOT / path for path in made}
    stale = [path for path, text in made.items() if not is_file_with(ROOT / path, text)]
    if check:
        for path in [*stale, *(path.relative_to(ROOT) for path in sorted(old))]:
            print(f"{path} is out of date: run python docs/reference.py")
        return int(bool(stale or old))
    (ROOT / PAGES).mkdir(exist_ok=True)
    for path in stale:
        (ROOT / path).write_text(made[path])
    for path in old:
        path.unlink()
    return 0


def is_file_with(path: Path, text: str) -> bool:
    """Tell whether the file holds this text already."""
    return path.is_file() and path.read_text() == text


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
