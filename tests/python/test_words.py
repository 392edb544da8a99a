"""The language of pages, `--help` texts, messages, docstrings and comments."""

from __future__ import annotations

import argparse
import ast
import inspect
import io
import re
import tokenize
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import pytest
from tests.python.doc_blocks import pages

from hydrodae.commands.parser import ALL, parser_of

Comments = Callable[[str], Iterator[tuple[int, str, bool]]]

MOST = 25
"""Words in a sentence; code, numbers and symbols do not count."""

MEAN = 18
"""Words in a sentence of the pages, on average."""

LONGEST = 35
"""Words in a sentence of a docstring or comment."""

NONE = r"(?:is|are|has|have|there) none"

BANNED = {
    r"tells?|told|telling": "report, print, show, state, list or warn",
    r"(?:say|says|said|saying) so": "report, print or state",
    NONE: "no ..., zero, missing or empty",
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


def faults(text: str, most: int = MOST, allowed: str = "") -> Iterator[str]:
    """What breaks the rules, with what to write instead."""
    for sentence in sentences(text):
        if words(sentence) > most:
            yield f"{words(sentence)} words (at most {most}): {sentence[:120]}"
    plain = " ".join(prose(text).split())
    for pattern, instead in BANNED.items():
        if pattern == allowed:
            continue
        for found in re.finditer(rf"\b(?:{pattern})\b", plain, re.IGNORECASE):
            around = plain[max(0, found.start() - 40) : found.end() + 40]
            yield f"{found[0]!r}, write {instead}: ...{around}..."


def held(repository: Path) -> list[Path]:
    """All pages, also those that docs/reference.py makes from the kernel."""
    found = [*pages(repository), repository / "CHANGELOG.md", repository / "tests" / "README.md"]
    found += (repository / ".github").glob("*.md")
    return found


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
        for name, text in parsers(parser_of(ALL), "hydrodae")
        for fault in faults(text)
    ]
    assert not broken, "\n".join(broken)


def test_sentences_of_the_pages_are_short_on_average(repository: Path) -> None:
    counts = [
        count
        for page in held(repository)
        for sentence in sentences(page.read_text())
        if (count := words(sentence))
    ]
    assert sum(counts) / len(counts) <= MEAN


def clauses(text: str) -> str:
    """A message whose parts, *where: what is wrong; what to write*, are sentences."""
    return re.sub(r"[;:]\s+(?=\S)", ". X ", text)


def literals(source: str) -> Iterator[tuple[int, str]]:
    """Line and text of each string of C++; adjacent literals are one string."""
    one = r'"(?:[^"\\\n]|\\.)*"'
    source = re.sub(r"//[^\n]*", "", source)
    for found in re.finditer(rf"{one}(?:\s*{one})*", source):
        text = re.sub(r'(?<!\\)"\s*"', "", found[0][1:-1]).replace("\\n", "\n").replace('\\"', "'")
        yield source.count("\n", 0, found.start()) + 1, text


def strings(source: str) -> Iterator[tuple[int, str, bool]]:
    """Line and text of each string of Python, and whether it is a docstring."""
    tree = ast.parse(source)
    docstrings, inside = set(), set()
    for node in ast.walk(tree):
        for statement in ast.iter_child_nodes(node):
            if isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant):
                docstrings.add(statement.value)
        if isinstance(node, ast.Attribute) and node.attr == "split":
            inside.add(node.value)  # a list of names
        if isinstance(node, ast.JoinedStr):
            inside.update(node.values)
            values = (v.value if isinstance(v, ast.Constant) else "`x`" for v in node.values)
            yield node.lineno, "".join(map(str, values)), False
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in inside:
            yield node.lineno, node.value, node in docstrings


def blocks(comments: Iterable[tuple[int, str, bool]]) -> Iterator[tuple[int, str]]:
    """First line and text of comments; those that stand alone on adjacent lines are one text.

    Displayed equations and tables, which are indented, are left out.
    """
    first, next_line, lines = 0, 0, list[str]()
    for line, text, alone in comments:
        if not alone or line != next_line:
            yield first, "\n".join(lines)
            first, lines = line, []
        next_line = line + 1 if alone else 0
        lines.append("" if text.startswith("  ") else re.sub(r"^@\w+", "\n", text))
    yield first, "\n".join(lines)


def cpp_comments(source: str) -> Iterator[tuple[int, str, bool]]:
    """Line, text and whether nothing stands before it, of each comment of C++."""
    source = re.sub(r'R"\((.|\n)*?\)"', lambda raw: "\n" * raw[0].count("\n"), source)
    for number, line in enumerate(source.splitlines(), 1):
        code, slashes, text = re.sub(r'"(?:[^"\\]|\\.)*"', "X", line).partition("//")
        if slashes:
            yield number, re.sub(r"^/?!?<? ?", "", text), not code.strip()


def python_comments(source: str) -> Iterator[tuple[int, str, bool]]:
    """The same of Python."""
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            before = token.line[: token.start[1]]
            yield token.start[0], re.sub(r"^#:? ?", "", token.string), not before.strip()


@pytest.mark.parametrize(
    ("suffixes", "comments", "fewest"),
    [({".cpp", ".h"}, cpp_comments, 500), ({".py"}, python_comments, 400)],
    ids=["cpp", "python"],
)
def test_comments_keep_to_the_rules(
    repository: Path, suffixes: set[str], comments: Comments, fewest: int
) -> None:
    folders = ("cpp", "python", "tests", "cases", "docs")
    files = [file for folder in folders for file in sorted((repository / folder).rglob("*.*"))]
    files = [file for file in files if file.suffix in suffixes]
    assert len(files) > fewest
    broken = [
        f"{file.relative_to(repository)}:{line}: {fault}"
        for file in files
        for line, text in blocks(comments(file.read_text()))
        for fault in faults(clauses(text), LONGEST)
    ]
    assert not broken, "\n".join(broken)


def described(docstring: str) -> str:
    """The prose of a docstring: without examples, displayed equations, types and parameters."""
    lines = inspect.cleandoc(docstring).splitlines()
    depth = [len(line) - len(line.lstrip()) for line in lines]
    kept = []
    for k, line in enumerate(lines):
        deeper = k + 1 < len(lines) and lines[k + 1] and depth[k + 1] > depth[k]
        item = deeper and not line.endswith(":")
        equation = depth[k] and k and not lines[k - 1]
        rule = not line.strip(" -") or re.match(r" *(>>>|\.\.\. |\w+ : )", line)
        kept.append("" if item or equation or rule else line)
    return "\n".join(kept)


def test_messages_and_keys_of_the_kernel_keep_to_the_rules(repository: Path) -> None:
    folders = (repository / "cpp", repository / "python" / "bindings")
    files = [file for folder in folders for file in sorted(folder.rglob("*.[ch]*"))]
    assert len(files) > 400
    broken = [
        f"{file.relative_to(repository)}:{line}: {fault}"
        for file in files
        for line, text in literals(file.read_text())
        for fault in faults(clauses(text))
    ]
    assert not broken, "\n".join(broken)


def test_messages_and_docstrings_of_python_keep_to_the_rules(repository: Path) -> None:
    broken = []
    for file in sorted((repository / "python" / "hydrodae").rglob("*.py")):
        for line, text, is_docstring in strings(file.read_text()):
            if is_docstring:  # None is a word of Python
                found = faults(clauses(described(text)), LONGEST, allowed=NONE)
            else:
                found = faults(clauses(text)) if " " in text.strip() else iter(())
            broken += [f"{file.relative_to(repository)}:{line}: {fault}" for fault in found]
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


def test_strings_are_found_and_joined() -> None:
    assert list(literals('x; // "a"\nf("he told \\"it\\" "\n  "twice");')) == [
        (2, "he told 'it' twice")
    ]
    source = '"""One."""\nx = f"two {x} three"\nwords = "four five".split()\n'
    assert list(strings(source)) == [(2, "two `x` three", False), (1, "One.", True)]


def test_comments_are_found_and_joined() -> None:
    source = 'f("// no");  // one\n/// Two\n///   T = told\n/// three.\n/// @returns four\n'
    assert list(blocks(cpp_comments(source)))[1:] == [(1, "one"), (2, "Two\n\nthree.\n\n four")]
    source = 'x = "# no"  # one\n#: Two\n# three.\n'
    assert list(blocks(python_comments(source)))[1:] == [(1, "one"), (2, "Two\nthree.")]


def test_the_prose_of_a_docstring_is_short() -> None:
    text = """Return the sum.

    Parameters
    ----------
    tell : float
        First.
    """
    assert not list(faults(described(text)))
    assert list(faults(described(text.replace("First", "As told"))))


def test_code_is_no_prose() -> None:
    assert not list(faults("```text\nhe told him\n```\n\nThe key `tell` is [short](tell.md)."))
