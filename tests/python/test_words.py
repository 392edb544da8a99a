"""The language of pages and `--help` texts: short sentences, plain words."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.python.doc_blocks import pages

from hydrodae.commands import cli

MOST = 25
"""Words in a sentence; code, numbers and symbols do not count."""

BANNED = {
    r"tells?|told|telling": "report, print, show, state, list or warn",
    r"(?:say|says|said|saying) so": "report, print or state",
    r"(?:is|are|has|have|there) none": "no ..., zero, missing or empty",
    r"of (?:one's|its|their|your) own to|of one's own": "your own",
    r"dear(?:er|ly)?": "expensive",
    r"some \d[\d ]*": "about",
    r"anew": "again",
    r"none the less|ought to|thereby|therein|whereby|heretofore": "a plain word",
    r"it should be noted(?: that)?|it is worth noting(?: that)?|please note": "leave it out",
    r"in order to": "to",
    r"simply|obviously|of course": "leave it out",
    r"utili[sz]e[sd]?": "use",
}

#: Pages that still break the rules: take a page off when you have rewritten it, add none.
PENDING: set[str] = set()


def prose(text: str) -> str:
    """Text without code, comments and link targets."""
    text = re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    return re.sub(r"`[^`]*`", "`", text)


def sentences(text: str) -> Iterator[str]:
    """Sentences of paragraphs and lists; those of tables and headings are left out."""
    lines = ["" if line.startswith(("|", "#")) else line for line in prose(text).splitlines()]
    for part in re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", "\n".join(lines)):
        yield from re.split(
            r"(?:(?<=[.?!])|(?<=[.?!]\*\*))\s+(?=[A-Z*\[(0-9\"'`])", part.replace("\n", " ").strip()
        )


def words(sentence: str) -> int:
    """How many words a sentence has; `radius=R` and the like are no words."""
    return len(re.findall(r"[A-Za-z][\w'-]*", re.sub(r"\S*=\S*", "", sentence)))


def faults(text: str) -> Iterator[str]:
    """What breaks the rules, with what to write instead."""
    for sentence in sentences(text):
        if words(sentence) > MOST:
            yield f"{words(sentence)} words (at most {MOST}): {sentence[:120]}"
    plain = " ".join(prose(text).split())
    for pattern, instead in BANNED.items():
        for found in re.finditer(rf"\b(?:{pattern})\b", plain, re.IGNORECASE):
            around = plain[max(0, found.start() - 40) : found.end() + 40]
            yield f"{found[0]!r}, write {instead}: ...{around}..."


def held(repository: Path) -> list[Path]:
    """All pages but those that docs/reference.py makes from the kernel."""
    found = [*pages(repository), repository / "CHANGELOG.md", repository / "tests" / "README.md"]
    found += (repository / ".github").glob("*.md")
    return [page for page in found if page.parent.name != "reference"]


def test_pages_keep_to_the_rules(repository: Path) -> None:
    broken_rules, clean = [], set()
    for page in held(repository):
        name = page.relative_to(repository).as_posix()
        broken = list(faults(page.read_text()))
        if name not in PENDING:
            broken_rules += [f"{name}: {fault}" for fault in broken]
        elif not broken:
            clean.add(name)
    assert not broken_rules, "\n".join(broken_rules)
    assert not clean, f"take off PENDING: {clean}"


def parsers(parser: argparse.ArgumentParser, name: str) -> Iterator[tuple[str, str]]:
    """Name and texts of a parser, and of those of its commands."""
    texts = [parser.description or ""]
    for action in parser._actions:
        texts.append(action.help or "")
        if isinstance(action, argparse._SubParsersAction):
            texts += [choice.help or "" for choice in action._choices_actions]
            for below, child in action.choices.items():
                yield from parsers(child, f"{name} {below}")
    yield name, "\n\n".join(texts)


def test_help_keeps_to_the_rules() -> None:
    broken = [
        f"{name}: {fault}"
        for name, text in parsers(cli._parser(cli.ALL), "hydrodae")
        for fault in faults(text)
    ]
    assert not broken, "\n".join(broken)


@pytest.mark.parametrize(
    "text",
    [
        "The summary tells the error.",
        "A run is " + "very " * 25 + "long.",
        "| key | there is none |",
        "- one of your own\n- some 30 of one's own",
    ],
)
def test_a_broken_rule_is_found(text: str) -> None:
    assert list(faults(text))


def test_code_is_no_prose() -> None:
    assert not list(faults("```text\nhe told him\n```\n\nThe key `tell` is [short](tell.md)."))
