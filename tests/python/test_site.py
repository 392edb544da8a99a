"""The site of the documentation: all pages are in it, and it builds without a warning."""

from __future__ import annotations

import importlib
import re
import runpy
import sys
from pathlib import Path
from types import ModuleType

import pytest

import hydrodae


@pytest.fixture
def api(repository: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.syspath_prepend(str(repository / "docs"))
    monkeypatch.delitem(sys.modules, "api", raising=False)
    return importlib.import_module("api")


def test_every_page_is_in_the_navigation(repository: Path, api: ModuleType) -> None:
    nav = (repository / "mkdocs.yml").read_text().partition("\nnav:\n")[2]
    listed = set(re.findall(r": (\S+\.md)$", nav, re.MULTILINE))
    site = runpy.run_path(str(repository / "docs" / "site.py"))
    pages = {str(page.relative_to(repository)) for page in site["pages"]()}
    made = {path.as_posix() for path in api.pages()}
    assert listed <= pages | made
    left_out = {page for page in pages - listed if not page.startswith("docs/reference/")}
    assert left_out == set()


def test_the_interface_pages_have_every_public_name_and_header(
    repository: Path, api: ModuleType
) -> None:
    made = {path.name: text for path, text in api.pages().items()}
    for name in set(hydrodae.__all__) - {"hdb", "mooring"}:
        assert f"### hydrodae.{name}\n" in made["python.md"], name
    for name in ("read", "fit", "import_database"):
        assert f"### hydrodae.hdb.{name}\n" in made["python.md"]
    for header in (repository / "cpp" / "hydrodae").glob("*/*.h"):
        assert f"\n## {header.name}\n" in made[f"cpp_{header.parent.name}.md"]
    assert all(text.count("```") % 2 == 0 for text in made.values())


def test_declarations_of_a_header_have_their_comments(api: ModuleType) -> None:
    header = "/// Twice\n/// x.\ndouble twice(double x,\n  int n);\nint a; ///< first\n"
    header += "private:\n/// Hidden.\nint b;\n};\n/// Seen.\nstruct C {\n"
    assert list(api.declarations(header)) == [
        ("double twice(double x,\n  int n);", "Twice x."),
        ("int a;", "first"),
        ("struct C", "Seen."),
    ]


@pytest.mark.slow
def test_the_site_builds_without_a_warning(repository: Path) -> None:
    pytest.importorskip("mkdocs")
    assert runpy.run_path(str(repository / "docs" / "site.py"))["main"]() == 0
    assert (repository / "build" / "site" / "docs" / "sweeps.html").is_file()
