"""The code blocks of the documentation, and which of them say why they are not run."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

BLOCK = re.compile(
    r"^(?:<!-- not run: (?P<reason>[^\n]+) -->\n\n)?```(?P<language>\w*)\n(?P<text>.*?)^```$",
    re.DOTALL | re.MULTILINE,
)


@dataclass(frozen=True)
class Block:
    """One fenced block; `reason` tells why it is not run, and is empty where it is."""

    language: str
    text: str
    reason: str


def pages(repository: Path) -> list[Path]:
    """All pages: of the README, the documentation, the cases and the starters."""
    found = [repository / "README.md", *(repository / "docs").glob("**/*.md")]
    found += (repository / "cases").glob("**/README.md")
    return [*found, repository / "python" / "hydrodae" / "starters" / "README.md"]


def all_blocks(page: Path) -> list[Block]:
    """Every fenced block of a page, in its order."""
    return [
        Block(found["language"], found["text"], found["reason"] or "")
        for found in BLOCK.finditer(page.read_text())
    ]


def blocks(page: Path, language: str) -> list[str]:
    """Texts of the blocks in a language that are to be run."""
    return [b.text for b in all_blocks(page) if b.language == language and not b.reason]


def command_lines(page: Path) -> list[str]:
    """Lines of the shell blocks that are to be run, continued ones joined."""
    text = "".join(blocks(page, "sh")).replace("\\\n", " ")
    return [line for line in text.splitlines() if line.strip()]
