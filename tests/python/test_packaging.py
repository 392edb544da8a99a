"""Wheels, the conda recipe and the package for C++ programs say what the project says."""

from __future__ import annotations

import re
import shutil
import subprocess
import tomllib
from pathlib import Path
from typing import Any

import pytest

NEWEST = 14


@pytest.fixture
def project(repository: Path) -> dict[str, Any]:
    return tomllib.loads((repository / "pyproject.toml").read_text())


def test_wheels_are_for_every_version_that_is_supported(project: dict[str, Any]) -> None:
    oldest = int(project["project"]["requires-python"].removeprefix(">=3."))
    wanted = [f"cp3{minor}-*" for minor in range(oldest, NEWEST + 1)]
    assert project["tool"]["cibuildwheel"]["build"] == wanted


def test_recipe_needs_what_the_project_needs(repository: Path, project: dict[str, Any]) -> None:
    jinja2, yaml = pytest.importorskip("jinja2"), pytest.importorskip("yaml")
    text = (repository / "conda" / "meta.yaml").read_text()
    cmake = (repository / "CMakeLists.txt").read_text()
    rendered = jinja2.Template(text).render(
        load_file_data=lambda *_, **__: project,
        load_file_regex=lambda regex_pattern, **_: re.search(regex_pattern, cmake),
        compiler=lambda language: f"{language}_compiler",
        stdlib=lambda language: f"{language}_stdlib",
        PYTHON="python",
    )
    recipe = yaml.safe_load(rendered)
    assert recipe["requirements"]["run"][1:] == [
        name.lower() for name in project["project"]["dependencies"]
    ]
    host = [name.replace(" ", "") for name in recipe["requirements"]["host"]]
    assert set(project["build-system"]["requires"]) <= set(host)
    assert f"VERSION {recipe['package']['version']} " in cmake


def test_page_shows_the_program_that_is_built(repository: Path) -> None:
    page = (repository / "docs" / "install.md").read_text()
    for language, name in (("cmake", "CMakeLists.txt"), ("cpp", "main.cpp")):
        (shown,) = re.findall(rf"^```{language}\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
        text = (repository / "tests" / "package" / name).read_text()
        whole = [line.strip() for line in text.splitlines()]
        assert [line for line in shown.splitlines() if line and line.strip() not in whole] == []


@pytest.mark.slow
def test_a_program_uses_the_installed_library(repository: Path) -> None:
    """Needs a finished build of the kernel in `build`, which pip leaves there."""
    builds = [b for b in (repository / "build").glob("cp3*") if any(b.glob("cpp/libhydrodae*"))]
    if not builds or shutil.which("cmake") is None:
        pytest.skip("no build of the kernel in build/, or no cmake")
    script = repository / "tests" / "package" / "run.sh"
    done = subprocess.run(
        ["bash", str(script), str(builds[0])], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
