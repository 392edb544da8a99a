"""Wheels, the conda recipe and the package for C++ programs say what the project says."""

from __future__ import annotations

import re
import shutil
import subprocess
import tomllib
import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

import hydrodae
from hydrodae.support import licences

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


def test_licences_are_those_of_what_is_inside(repository: Path, project: dict[str, Any]) -> None:
    """Every library that CMake asks for is in the list, and every licence in the metadata."""
    text = licences.LIST.read_text()
    assert (repository / "LICENSE").read_text() in text
    assert project["project"]["license"] == licences.expression()
    assert all((repository / name).is_file() for name in project["project"]["license-files"])
    cmake = "".join(
        (repository / name / "CMakeLists.txt").read_text() for name in ("cpp", "python/bindings")
    )
    asked = set(
        re.findall(r"^\s*(?:find_package|find_library|pkg_check_modules)\((\w+)", cmake, re.M)
    )
    words = {"Eigen3": "Eigen", "tomlplusplus": "toml++", "Python": None, "Threads": None}
    missing = {
        name
        for name in asked
        if (said := words.get(name, name)) and said.lower().split("_")[0] not in text.lower()
    }
    assert asked >= {"Eigen3", "SUNDIALS", "HDF5", "pugixml"}
    assert missing == set()


@pytest.mark.parametrize("fmi", [2, 3])
def test_an_fmu_has_the_licences_of_what_is_inside(
    repository: Path, tmp_path: Path, fmi: int
) -> None:
    case = repository / "cases" / "sphere" / "decay.toml"
    path = hydrodae.fmu.export(case, tmp_path / "sphere.fmu", fmi=fmi)
    with zipfile.ZipFile(path) as archive:
        told = archive.read("documentation/licenses/license.txt").decode()
        root = ElementTree.fromstring(archive.read("modelDescription.xml"))
    assert told == licences.LIST.read_text()
    assert root.attrib["license"] == licences.expression()


def test_every_download_of_scripts_and_workflows_has_a_hash(repository: Path) -> None:
    """One of sha256sum for each curl; nothing is unpacked from a pipe."""
    scripts = [*(repository / ".github/workflows").glob("*.yml"), *repository.rglob("*.sh")]
    downloads = 0
    for script in scripts:
        if {".venv", "build"} & set(script.relative_to(repository).parts):
            continue
        text = script.read_text()
        count = len(re.findall(r"\b(?:curl|wget) ", text))
        assert len(re.findall(r"sha256sum --check", text)) == count, script
        assert not re.search(r"curl[^\n]*\|", text), script
        downloads += count
    assert downloads == 3


def test_version_of_the_package_is_that_of_cmake(repository: Path, project: dict[str, Any]) -> None:
    """Numbers, and `.dev0` behind them but for a tag; changelog and pages have the numbers."""
    setting = project["tool"]["scikit-build"]["metadata"]["version"]
    found = re.search(setting["regex"], (repository / setting["input"]).read_text())
    assert found is not None
    version = setting["result"].format(**found.groupdict())
    assert re.fullmatch(r"\d+\.\d+\.\d+(\.dev\d+)?", version)
    released = re.search(r"^## \[?(\d[\d.]*)", changelog(repository), re.M)
    assert released is not None
    number = [*map(int, found["value"].split("."))]
    last = [*map(int, released[1].split("."))]
    assert number > last if found["dev"] else number == last
    minor = ".".join(found["value"].split(".")[:2])
    assert f"find_package(hydrodae {minor} " in (repository / "docs" / "install.md").read_text()


def test_citation_has_the_version_and_its_date(repository: Path, project: dict[str, Any]) -> None:
    yaml = pytest.importorskip("yaml")
    citation = yaml.safe_load((repository / "CITATION.cff").read_text())
    title, date = re.findall(r"^## \[?(\d[\d.]*)\]? - (\S+)$", changelog(repository), re.M)[0]
    assert (citation["version"], str(citation["date-released"])) == (title, date)
    assert citation["license"] in project["project"]["license"].split(" AND ")
    assert citation["cff-version"] == "1.2.0"


def changelog(repository: Path) -> str:
    return (repository / "CHANGELOG.md").read_text()


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
