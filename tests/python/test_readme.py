"""The examples of the README run as they stand."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import hydrodae
from hydrodae.results.post import absorbed_power, mean_absorbed_power


def blocks(readme: Path, language: str) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", readme.read_text(), re.DOTALL | re.MULTILINE)


@pytest.fixture
def readme(repository: Path) -> Path:
    return repository / "README.md"


def test_toml_example(readme: Path) -> None:
    (text,) = blocks(readme, "toml")
    results = hydrodae.run(hydrodae.Case.from_text(text, directory=readme.parent))
    assert results.status == "completed"
    assert "forces/pto/flap/moment" in results
    assert abs(results["sea/elevation"]).max() > 0.5
    power = absorbed_power(results, "pto")  # a damper only takes
    assert power.min() > -1e-6 * power.max()
    assert mean_absorbed_power(results, "pto", 20.0) > 1e3


def test_python_example(readme: Path) -> None:
    text, *_ = blocks(readme, "python")  # what follows are single calls
    done = subprocess.run(
        [sys.executable, "-c", text], cwd=readme.parent, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("flap 2 reaches") == 3


def test_pictures_and_files_named_exist(repository: Path) -> None:
    pages = [repository / "README.md", *sorted((repository / "docs").glob("*.md"))]
    missing = []
    for page in pages:
        text = page.read_text()
        links = re.findall(r"\]\((?!http)([^)#]+)(?:#[^)]*)?\)", text)
        missing += [f"{page.name}: {x}" for x in links if not (page.parent / x).exists()]
        named = re.findall(r"`((?:cases|tests|cpp|docs)/[^`\s]+)`", text)
        missing += [f"{page.name}: {x}" for x in named if not (repository / x).exists()]
        assert links or page.name != "README.md"
    assert not missing


def test_sections_named_exist(repository: Path) -> None:
    for page in (repository / "README.md", *(repository / "docs").glob("*.md")):
        for target, section in re.findall(r"\]\(([^)#]*)#([^)]+)\)", page.read_text()):
            text = (page.parent / target if target else page).read_text()
            titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
            slugs = {re.sub(r"[^\w -]", "", t.lower()).replace(" ", "-") for t in titles}
            assert section in slugs, f"{page.name}: {target}#{section}"
