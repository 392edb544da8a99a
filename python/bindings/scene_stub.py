"""Write the stub of `hydrodae.Scene`, whose methods are made of the tables of the kernel.

    python python/bindings/scene_stub.py FILE                    # of the installed package
    python python/bindings/scene_stub.py FILE --kernel _core.so  # of this source and that kernel

The build does it, so that editors and type checkers find the stub in the installed package.
tests/run.sh puts it beside the source, for mypy; git ignores it there.
"""

from __future__ import annotations

import argparse
import sys
import textwrap
from collections.abc import Iterable
from dataclasses import replace
from importlib.machinery import ExtensionFileLoader
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from hydrodae.case.tables import Key, Table

HEAD = '''"""Scenes built in Python. Made by scene_stub.py from the fields of the kernel."""

from collections.abc import Sequence
from typing import Any, Literal, TypedDict

from numpy.typing import NDArray

from hydrodae.case.builder.base import SceneBase, TypedList

_Numbers = Sequence[float] | NDArray[Any]
_Rows = Sequence[_Numbers] | NDArray[Any]
'''

SCENE = '''
class Scene(SceneBase):
    """A scene that is built call by call; `hydrodae.run` and the other functions take it."""
'''


def scene_stub(tables: Iterable[Table]) -> str:
    """The text of scene.pyi."""
    inner, lists, methods = "", "", ""
    words = Words()
    for table in tables:
        for kind in table.types or (table,):
            inner += "".join(typed_dict(kind, nested, words) for nested in kind.nested)
        if not table.types:
            methods += method(table, table, words)
            continue
        name = f"{table.name.capitalize()}Types"
        lists += f'\nclass {name}(TypedList):\n    """{table.doc}"""\n\n'
        lists += "".join(method(table, kind, words) for kind in table.types)
        methods += f"    @property\n    def {table.name}(self) -> {name}:\n"
        methods += f'        """{table.doc}"""\n'
    return HEAD + words.text() + inner + lists + SCENE + "\n" + methods


class Words:
    """Names for the words that keys allow."""

    def __init__(self) -> None:
        self._names: dict[tuple[str, tuple[str, ...]], str] = {}

    def name(self, owner: Table, key: Key) -> str:
        """_BodyMotion for the words of `motion` of `body`; str for a key that takes any."""
        if len(key.choices) < 2:
            return "str"
        name = "_" + camel_case(owner.name, key.name)
        return self._names.setdefault((key.name, key.choices), name)

    def text(self) -> str:
        """All that were asked for."""
        text = ""
        for (_, words), name in self._names.items():
            lines = "".join(f"    {quoted(word)},\n" for word in words)
            text += f"{name} = Literal[\n{lines}]\n"
        return text


def camel_case(*names: str) -> str:
    """BodyInitial for body, initial."""
    return "".join(word.capitalize() for name in names for word in name.split("_"))


def typed_dict(owner: Table, table: Table, words: Words) -> str:
    """The class of a table inside another one."""
    keys = "".join(f"    {key.name}: {annotation(owner, key, words)}\n" for key in table.keys)
    head = f"\nclass {camel_case(owner.name, table.name)}(TypedDict, total=False):\n"
    return head + f'    """Table `{table.name}` of `{owner.name}`."""\n\n{keys}'


def method(table: Table, kind: Table, words: Words) -> str:
    """The method that adds an entry."""
    keys = [key for key in kind.keys if key.name != "type"]
    lines = ["self,"]
    if table.is_list:
        keys = [key for key in keys if key.name != "name"]
        lines.append("name: str,")
    lines.append("*,")
    for key in sorted(keys, key=lambda key: not key.required):
        default = "" if key.required else " = ..."
        lines.append(f"{key.name}: {annotation(kind, key, words)}{default},")
    lines += [f"{inner.name}: {camel_case(kind.name, inner.name)} = ...," for inner in kind.nested]
    arguments = textwrap.indent("\n".join(lines), " " * 8)
    from hydrodae.case.builder.methods import docstring

    text = textwrap.indent(docstring(table, kind), " " * 8, lambda line: bool(line.strip()))
    result = "str" if table.is_list else "None"
    head = f"    def {kind.name}(\n{arguments}\n    ) -> {result}:\n"
    return head + f'        """{text[8:]}\n        """\n'


def annotation(owner: Table, key: Key, words: Words) -> str:
    """The type of a key for a type checker."""
    word = words.name(owner, key)
    if key.is_number and key.choices:
        instead = ", ".join(map(quoted, key.choices))
        return f"{annotation(owner, replace(key, choices=()), words)} | Literal[{instead}]"
    return {
        "number": "float",
        "integer": "int",
        "truth": "bool",
        "word": word,
        "words": f"{word} | Sequence[{word}]",
        "numbers": "_Numbers",
        "points": "_Rows",
        "vector3": "_Numbers",
        "vector6": "_Numbers",
        "matrix6": "_Numbers | _Rows",
    }[key.kind]


def quoted(word: str) -> str:
    """A word in double quotes."""
    return f'"{word}"'


def load_kernel(path: str) -> None:
    """Make this file `hydrodae._core`, and take `hydrodae` from this source."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    name = "hydrodae._core"
    spec = spec_from_file_location(name, path, loader=ExtensionFileLoader(name, path))
    assert spec is not None
    assert spec.loader is not None
    sys.modules[name] = module = module_from_spec(spec)
    spec.loader.exec_module(module)


def main() -> None:
    """Write the stub."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("file", metavar="FILE", type=Path)
    parser.add_argument("--kernel", metavar="FILE", help="the compiled module `hydrodae._core`")
    arguments = parser.parse_args()
    if arguments.kernel:
        load_kernel(arguments.kernel)
    from hydrodae.case.tables import tables

    arguments.file.write_text(scene_stub(tables()), encoding="utf-8")


if __name__ == "__main__":
    main()
