"""Language of pages, `--help` texts, messages, docstrings and comments: a check beside ruff.

Prints each sentence that breaks a rule, with its file and line, and ends with exit code 1.

    python -m tests.lint
"""

from __future__ import annotations

import argparse
import ast
import inspect
import io
import re
import sys
import tokenize
from collections.abc import Iterable, Iterator
from pathlib import Path

from tests.python.doc_blocks import pages

from hydrodae.commands.parser import ALL, parser_of

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("cpp", "python", "tests", "cases", "docs")

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


def held() -> list[Path]:
    """All pages, also those that docs/reference.py makes from the kernel."""
    found = [*pages(ROOT), ROOT / "CHANGELOG.md", ROOT / "tests" / "README.md"]
    return found + list((ROOT / ".github").glob("*.md"))


def of_pages() -> Iterator[str]:
    """Faults of pages, and of the mean length of their sentences."""
    counts = []
    for page in held():
        yield from (f"{page.relative_to(ROOT)}: {fault}" for fault in faults(page.read_text()))
        counts += [count for one in sentences(page.read_text()) if (count := words(one))]
    if sum(counts) > MEAN * len(counts):
        yield f"pages: {sum(counts) / len(counts):.2f} words a sentence (at most {MEAN})"


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


def of_help() -> Iterator[str]:
    """Faults of the texts that `--help` prints."""
    for name, text in parsers(parser_of(ALL), "hydrodae"):
        yield from (f"{name}: {fault}" for fault in faults(text))


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


def of_comments() -> Iterator[str]:
    """Faults of comments, and files that comments of C++ name but that do not exist."""
    files = [file for folder in FOLDERS for file in sorted((ROOT / folder).rglob("*.*"))]
    paths = [f"/{file.relative_to(ROOT)}" for file in files]
    named = re.compile(r"//.*?([\w/]+\.(?:h|cpp|py|md|toml)\b)")
    for file in files:
        cpp = file.suffix in (".cpp", ".h")
        if not cpp and file.suffix != ".py":
            continue
        name, source = file.relative_to(ROOT), file.read_text()
        for line, text in blocks((cpp_comments if cpp else python_comments)(source)):
            for fault in faults(clauses(text), LONGEST):
                yield f"{name}:{line}: {fault}"
        if not cpp or not file.is_relative_to(ROOT / "cpp"):
            continue
        for line, text in enumerate(source.splitlines(), 1):
            for match in named.finditer(text):
                if not any(path.endswith(f"/{match[1]}") for path in paths):
                    yield f"{name}:{line}: there is no file {match[1]}"


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


def of_messages() -> Iterator[str]:
    """Faults of messages and keys of the kernel."""
    for folder in (ROOT / "cpp", ROOT / "python" / "bindings"):
        for file in sorted(folder.rglob("*.[ch]*")):
            for line, text in literals(file.read_text()):
                for fault in faults(clauses(text)):
                    yield f"{file.relative_to(ROOT)}:{line}: {fault}"


def of_docstrings() -> Iterator[str]:
    """Faults of messages and docstrings of the package; None is a word of Python."""
    for file in sorted((ROOT / "python" / "hydrodae").rglob("*.py")):
        for line, text, is_docstring in strings(file.read_text()):
            if is_docstring:
                found = faults(clauses(described(text)), LONGEST, allowed=NONE)
            else:
                found = faults(clauses(text)) if " " in text.strip() else iter(())
            yield from (f"{file.relative_to(ROOT)}:{line}: {fault}" for fault in found)


def check_itself() -> None:
    """Find what is known to break a rule, and nothing in code."""
    for text in (
        "The summary tells the error.",
        "A run is " + "very " * 25 + "long.",
        "| key | there is none |",
        "- one of your own\n- some 30 of one's own",
    ):
        assert list(faults(text)), text
    assert not list(faults("```text\nhe told him\n```\n\nThe key `tell` is [short](tell.md)."))
    source = 'x; // "a"\nf("he told \\"it\\" "\n  "twice");'
    assert list(literals(source)) == [(2, "he told 'it' twice")]
    source = '"""One."""\nx = f"two {x} three"\nwords = "four five".split()\n'
    assert list(strings(source)) == [(2, "two `x` three", False), (1, "One.", True)]
    source = 'f("// no");  // one\n/// Two\n///   T = told\n/// three.\n/// @returns four\n'
    assert list(blocks(cpp_comments(source)))[1:] == [(1, "one"), (2, "Two\n\nthree.\n\n four")]
    source = 'x = "# no"  # one\n#: Two\n# three.\n'
    assert list(blocks(python_comments(source)))[1:] == [(1, "one"), (2, "Two\nthree.")]
    text = "Return the sum.\n\n    Parameters\n    ----------\n    tell : float\n        First.\n"
    assert not list(faults(described(text)))
    assert list(faults(described(text.replace("First", "As told"))))


def main() -> int:
    """Print what breaks the rules; 1 if anything does."""
    argparse.ArgumentParser(prog="python -m tests.lint", description=__doc__).parse_args()
    check_itself()
    broken = [*of_pages(), *of_help(), *of_messages(), *of_docstrings(), *of_comments()]
    print("\n".join(broken) or "words: no faults")
    return int(bool(broken))


if __name__ == "__main__":
    sys.exit(main())
