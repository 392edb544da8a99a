"""Pages of the interfaces for Python and C++, from docstrings and comments of headers.

`docs/site.py` writes them into the site; the repository does not hold them.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
FOLDER = Path("docs", "api")
KERNEL = ROOT / "cpp" / "hydrodae"

#: Modules whose `__all__` is the interface, in the order of the page.
MODULES = ("hydrodae", "hydrodae.hdb", "hydrodae.results", "hydrodae.mooring", "hydrodae.arrays")
MODULES += ("hydrodae.control", "hydrodae.tcp", "hydrodae.fmu", "hydrodae.records")
MODULES += ("hydrodae.report", "hydrodae.plot", "hydrodae.schema", "hydrodae.tables")
MODULES += ("hydrodae.extremes",)


def plain(text: str) -> str:
    """Text in which Markdown means nothing but code between backticks."""
    parts = re.split(r"(``.+?``|`[^`]+`)", text)
    return "".join(
        part if part.startswith("`") else re.sub(r"([*_<\[\]|])", r"\\\1", part) for part in parts
    )


def described(docstring: str) -> Iterator[str]:
    """Paragraphs and lists of a numpydoc docstring as Markdown."""
    lines = inspect.cleandoc(docstring).splitlines()
    listed = code = False
    for k, line in enumerate(lines):
        below = lines[k + 1] if k + 1 < len(lines) else ""
        shown = line.startswith((">>>", "...")) or (line.startswith("    ") and not listed)
        shown = shown or (code and not line and below.startswith("    "))
        if shown != code:
            yield "```" if code else "\n```python" if ">>>" in line else "\n```text"
            code = shown
        if shown:
            yield line
        elif re.fullmatch(r"-{3,}", below):
            listed = line in ("Parameters", "Returns", "Attributes", "Raises", "Other Parameters")
            yield f"\n**{line}**\n"
        elif re.fullmatch(r"-{3,}", line):
            continue
        elif listed and line and not line.startswith(" "):
            name, _, kind = line.partition(" : ")
            yield f"- `{name}`" + (f", {plain(kind)}" if kind else "")
        else:
            yield plain(re.sub("::$", ":", line))
    if code:
        yield "```"


def signature(thing: Any) -> str:
    """Its arguments, or nothing where they are not known."""
    try:
        return str(inspect.signature(thing)).replace("'", "")
    except (TypeError, ValueError):
        return ""


def members(name: str, thing: Any) -> Iterator[str]:
    """Public methods and properties of a class that have a docstring."""
    for key, value in sorted(vars(thing).items()):
        call = getattr(value, "fget", None) or getattr(value, "__func__", value)
        if key.startswith("_") or not (inspect.isfunction(call) and call.__doc__):
            continue
        arguments = "" if isinstance(value, property) else signature(call)
        yield f"\n#### {name}.{key}\n\n```python\n{key}{arguments}\n```\n"
        yield from described(call.__doc__)


def entry(name: str, thing: Any) -> Iterator[str]:
    """One name of a module: its call, its docstring and its methods."""
    if isinstance(thing, ModuleType) or not (inspect.isclass(thing) or callable(thing)):
        return
    yield f"\n### {name}\n\n```python\n{name}{signature(thing)}\n```\n"
    yield from described(thing.__doc__ or "")
    if inspect.isclass(thing):
        yield from members(name, thing)


def public(module: Any) -> list[str]:
    """Names of the interface of a module."""
    named = getattr(module, "__all__", None)
    if named is not None:
        return list(named)
    own = vars(module).items()
    return [
        n
        for n, v in own
        if not n.startswith("_") and getattr(v, "__module__", 0) == module.__name__
    ]


def python_page() -> str:
    """Every public name of the package."""
    out = ["# Python interface", "", "This page lists every public name, from its docstring."]
    out += ["[Python](../python.md) shows how they work together:", "", "```python"]
    out += ["import hydrodae", "", "help(hydrodae.rao)", "```"]
    for name in MODULES:
        parent, _, last = name.rpartition(".")
        module = getattr(import_module(parent), last) if parent else import_module(name)
        out += ["", f"## {name}", ""]
        out += described(module.__doc__ or "")
        for key in public(module):
            out += entry(f"{name}.{key}", getattr(module, key))
    return "\n".join(out) + "\n"


def declarations(source: str) -> Iterator[tuple[str, str]]:
    """Declarations of a header that have a comment, and the comment; private ones left out."""
    comment: list[str] = []
    lines = iter(source.splitlines())
    hidden = False
    for line in lines:
        text = line.strip()
        hidden = text in ("private:", "protected:") or (hidden and not line.startswith("};"))
        if hidden:
            continue
        if text.startswith("/// "):
            comment.append(text[4:])
            continue
        if comment and text and not text.startswith(("//", "#", "namespace")):
            said = text
            while not re.search(r"[;{}]|///<", said) and (more := next(lines, "")).strip():
                said += f"\n  {more.strip()}"
            yield re.sub(r"\s*(///<.*|\{\s*)$", "", said), " ".join(comment)
        elif "///<" in text:
            said, _, rest = text.partition("///<")
            yield said.strip(), rest.strip()
        comment = []


def room(folder: Path) -> str:
    """The headers of one folder of the kernel."""
    out = [f"# C++: {folder.name}", "", "[All folders](cpp.md)"]
    for header in sorted(folder.glob("*.h")):
        source = header.read_text()
        out += ["", f"## {header.name}", "", "```cpp"]
        out += [f'#include "hydrodae/{header.relative_to(KERNEL)}"', "```", ""]
        first = re.match(r"#pragma once\n((?:///.*\n)+)\n", source)
        if first:
            out.append(plain(re.sub(r"^/// ?", "", first[1], flags=re.MULTILINE)))
            source = source[first.end() :]
        for text, comment in declarations(source):
            out += ["", "```cpp", text, "```", "", plain(comment)]
    return "\n".join(out) + "\n"


def pages() -> dict[Path, str]:
    """Every page by its path in the repository."""
    found = sorted(f for f in KERNEL.iterdir() if f.is_dir() and any(f.glob("*.h")))
    index = [
        "# C++ interface",
        "",
        "This page lists the folders of the library with their headers.",
    ]
    index += ["A program needs `simulation.h` alone ([how](../install.md#for-c-programs)):", ""]
    index += ["```cpp", '#include "hydrodae/simulation.h"', "```", ""]
    for text, comment in declarations((KERNEL / "simulation.h").read_text()):
        index += ["", "```cpp", text, "```", "", plain(comment)]
    index += ["", "## Folders", "", "| folder | headers |", "|---|---|"]
    for folder in found:
        headers = ", ".join(f"`{h.name}`" for h in sorted(folder.glob("*.h")))
        index.append(f"| [{folder.name}](cpp_{folder.name}.md) | {headers} |")
    made = {FOLDER / f"cpp_{folder.name}.md": room(folder) for folder in found}
    made[FOLDER / "cpp.md"] = "\n".join(index) + "\n"
    made[FOLDER / "python.md"] = python_page()
    return made
