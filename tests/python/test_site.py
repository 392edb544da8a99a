"""The site of the documentation: all pages are in it, and it builds without a warning."""

from __future__ import annotations

import importlib
import json
import re
import runpy
import shutil
import subprocess
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


def test_the_interface_page_needs_no_kernel(repository: Path) -> None:
    """A page that is made where the kernel is a stand-in has every public name too."""
    code = (
        "import sys; sys.modules['hydrodae._core'] = None; import kernel, api, hydrodae\n"
        "assert not kernel.BUILT\npage = api.python_page()\n"
        "print([n for n in hydrodae.__all__ if f'### hydrodae.{n}\\n' not in page])"
    )
    command = [sys.executable, "-c", code]
    folder = repository / "docs"
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.stdout == "['hdb', 'mooring']\n", done.stderr


#: What users of WEC-Sim, OrcaFlex and Capytaine type, and the page that answers.
WORDS = {
    "FAQ": "faq",
    "limits": "limits",
    "ssCalc": "databases",
    "state space": "databases",
    "PTO damping": "pto",
    "mooring matrix": "forces",
    "end stop": "forces",
    "morison": "cases",
    "drag": "forces",
    "irregular": "cases",
    "MCR": "sweeps",
    "power matrix": "sweeps",
    "paraview": "view",
    "nonlinear hydro": "cases",
    "simulink": "coming_from",
    "variable hydro": "cases",
    "wave gauge": "reference/gauge",
    "extreme": "extremes",
    "QTF": "second_order",
    "install": "install",
}


@pytest.mark.slow
def test_the_site_builds_without_a_warning_and_finds_pages(repository: Path) -> None:
    """By the script of the search that a browser runs: pages of users first, of C++ last."""
    pytest.importorskip("mkdocs")
    done = subprocess.run([sys.executable, "docs/site.py"], cwd=repository, check=False)
    assert done.returncode == 0
    site = repository / "build" / "site"
    assert (site / "docs" / "sweeps.html").is_file()
    if (node := shutil.which("node")) is None:
        pytest.skip("needs node for the script of the search")
    (worker,) = (site / "assets" / "javascripts" / "workers").glob("search.*.min.js")
    script = Path(__file__).with_name("search.js")
    command = [node, str(script), str(worker), str(site / "search" / "search_index.json")]
    told = subprocess.run(
        command, input="\n".join(WORDS), capture_output=True, text=True, check=True
    ).stdout
    found = dict(zip(WORDS, map(json.loads, told.splitlines()), strict=True))
    assert {word: pages[0] for word, pages in found.items()} == {
        word: f"docs/{page}.html" for word, page in WORDS.items()
    }
    for pages in found.values():
        place = {"user": [-1], "inside": [len(pages)]}
        for k, page in enumerate(pages):
            inside = page.startswith(("docs/api/", "CHANGELOG"))
            place["inside" if inside else "user"].append(k)
        assert max(place["user"]) < min(place["inside"]), pages
