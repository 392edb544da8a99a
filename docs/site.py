"""Build the site of the documentation without a warning.

    python docs/site.py          # extra: docs

The pages keep their places in the repository, so that links hold here and there. They are copied
into build/site_source with the pictures and files that they link to. docs/api.py adds the pages of
the interfaces; mkdocs makes build/site.
"""

from __future__ import annotations

import argparse
import importlib.util
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import api
import kernel
import search

from hydrodae.support.extras import install_command

ROOT = Path(__file__).resolve().parent.parent
SOURCE = ROOT / "build" / "site_source"

KEYS = re.compile(r"^\| key \|.*\n(?:\|.*\n)+", re.MULTILINE)
"""A table of keys; site.css gives its second column, the meaning, room on a telephone."""


def pages() -> list[Path]:
    """README, docs with the reference, and what each case says."""
    docs = sorted((ROOT / "docs").rglob("*.md"))
    return [ROOT / "README.md", *docs, *sorted((ROOT / "cases").glob("*/README.md"))]


def linked(page: Path) -> Iterator[Path]:
    """Files of the repository that a page links to or shows."""
    for link in re.findall(r"\]\((?!http|#)([^)#]+)(?:#[^)]*)?\)", page.read_text()):
        target = (page.parent / link).resolve()
        if target.is_file() and target.is_relative_to(ROOT):
            yield target


def gather() -> None:
    """Copy the pages and what they link to."""
    shutil.rmtree(SOURCE, ignore_errors=True)
    found = pages()
    style = ROOT / "docs" / "site.css"
    for file in dict.fromkeys(
        [*found, style, *(target for page in found for target in linked(page))]
    ):
        copy = SOURCE / file.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, copy)
    for path, text in api.pages().items():
        (SOURCE / path).parent.mkdir(exist_ok=True)
        (SOURCE / path).write_text(text)
    for page in SOURCE.rglob("*.md"):
        path = page.relative_to(SOURCE).as_posix()
        text = page.read_text()
        if path.startswith("docs/reference/"):
            text = KEYS.sub(r'<div class="keys" markdown>\n\n\g<0>\n</div>\n', text)
        page.write_text(search.front_matter(path) + text)


def main(arguments: Sequence[str] = ()) -> int:
    """Build the site; returns the exit code of mkdocs, which counts warnings as errors."""
    argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0]).parse_args(arguments)
    if importlib.util.find_spec("mkdocs") is None:
        print(f"the site needs mkdocs: {install_command('docs')}", file=sys.stderr)
        return 2
    if not kernel.BUILT:
        print(f"the kernel is not built: {api.FOLDER}/python.md has no methods of hydrodae.Scene")
    gather()
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet"]
    return subprocess.run([*command, "-f", str(ROOT / "mkdocs.yml")], check=False).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
