"""The commands of the documentation: those of shell blocks, of docstrings, and inside sentences."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.python.doc_blocks import BLOCK, pages

#: A line of a docstring that is a command, up to a remark behind it.
USAGE = re.compile(
    r"^ *((?:\.venv/bin/)?(?:python|hydrodae|bash) (?:.*\\\n)*.*?)(?: +#.*)?$", re.MULTILINE
)
#: Code inside a sentence that is more than the name of a command.
INLINE = re.compile(
    r"(?<!`)`((?:\.venv/bin/)?(?:hydrodae|python|pytest|bash|\w+=\S+ python) [^`]+)`"
)


@dataclass(frozen=True)
class Command:
    """One command: where it stands, its text, and why the tests of the pages leave it out.

    `usage` is whether the text is a usage line, with optional parts in brackets; `sentence` whether
    it stands inside a sentence, where files may be left out.
    """

    source: str
    line: int
    text: str
    reason: str = ""
    usage: bool = False
    sentence: bool = False

    @property
    def plain(self) -> str:
        """Text without the optional parts of a usage line."""
        if not self.usage:
            return self.text
        return " ".join(re.sub(r"\[[^\[\]]*\]", " ", self.text).split())


def documents(repository: Path) -> list[Path]:
    """All pages with commands, that of the tests too."""
    return [*pages(repository), repository / "tests" / "README.md"]


def scripts(repository: Path) -> list[Path]:
    """All Python files that are not of the package, and no tests."""
    found = (
        p for folder in ("cases", "docs", "tests") for p in (repository / folder).rglob("*.py")
    )
    return sorted(path for path in found if not path.name.startswith("test_"))


def of_page(page: Path, name: str) -> Iterator[Command]:
    """Commands of the shell blocks of a page, then those inside its sentences."""
    text = page.read_text()
    for block in BLOCK.finditer(text):
        if block["language"] != "sh":
            continue
        line, joined = text.count("\n", 0, block.start("text")) + 1, ""
        for number, part in enumerate(block["text"].splitlines()):
            joined += part
            if joined.endswith("\\"):
                joined = joined[:-1]
            elif joined.strip():
                yield Command(name, line + number, joined.strip(), block["reason"] or "")
                joined = ""
    prose = BLOCK.sub(lambda block: "\n" * block[0].count("\n"), text)
    for found in INLINE.finditer(prose):
        line = prose.count("\n", 0, found.start()) + 1
        yield Command(name, line, " ".join(found[1].split()), sentence=True)


def of_script(script: Path, name: str) -> Iterator[Command]:
    """Commands of the docstring of a script."""
    tree = ast.parse(script.read_text())
    told = ast.get_docstring(tree, clean=False) or ""
    for found in USAGE.finditer(told):
        line = tree.body[0].lineno + told.count("\n", 0, found.start(1))
        yield Command(name, line, " ".join(found[1].replace("\\\n", " ").split()), usage=True)


def all_commands(repository: Path) -> list[Command]:
    """All commands, in the order in which they stand."""
    found: list[Command] = []
    for page in documents(repository):
        found += of_page(page, page.relative_to(repository).as_posix())
    for script in scripts(repository):
        found += of_script(script, script.relative_to(repository).as_posix())
    return found
