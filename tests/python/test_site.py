"""The site of the documentation: all pages are in it, and it builds without a warning."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest


def test_every_page_is_in_the_navigation(repository: Path) -> None:
    nav = (repository / "mkdocs.yml").read_text().partition("\nnav:\n")[2]
    listed = set(re.findall(r": (\S+\.md)$", nav, re.MULTILINE))
    site = runpy.run_path(str(repository / "docs" / "site.py"))
    pages = {str(page.relative_to(repository)) for page in site["pages"]()}
    assert listed <= pages
    left_out = {page for page in pages - listed if not page.startswith("docs/reference/")}
    assert left_out == set()


@pytest.mark.slow
def test_the_site_builds_without_a_warning(repository: Path) -> None:
    pytest.importorskip("mkdocs")
    assert runpy.run_path(str(repository / "docs" / "site.py"))["main"]() == 0
    assert (repository / "build" / "site" / "docs" / "sweeps.html").is_file()
