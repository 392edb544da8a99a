"""The templates of docs/extending.md, added in the number of places that the page states."""

from __future__ import annotations

import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tests.python.doc_blocks import all_blocks

from hydrodae import DatabaseError, hdb
from hydrodae.hdb.readers import formats


def edit(text: str, pattern: str, new: str) -> str:
    """Text with one match of the pattern replaced."""
    out, found = re.subn(pattern, lambda _: new, text)
    assert found == 1, pattern
    return out


def listed(header: str, template: str, last: str, entry: str) -> str:
    """A header of the kernel with the template included, and its struct last in the list."""
    first = re.search(r'#include "hydrodae/', header)
    assert first
    header = f'{header[: first.start()]}#include "{template}"\n{header[first.start() :]}'
    return edit(header, re.escape(last), last.replace(">;", f", {entry}>;"))


#: Template, its folder in the kernel, the header with the list, the end of the list, the entry.
PLACES = [
    ("dead_band.h", "control", "model/controller.h", "control::Fmu>;", "control::DeadBand"),
    ("gaussian_swell.h", "sea", "sea/wave.h", "NewWave, ComponentFile>;", "GaussianSwell"),
    (
        "pto_quadratic.h",
        "element",
        "model/forces.h",
        "std::vector<element::PtoLagged>>;",
        "std::vector<element::PtoQuadratic>",
    ),
    ("span_b_row.h", "joint", "joint/rows.h", "AcrossRow, ScrewRow>;", "SpanBRow"),
]


@pytest.fixture
def overlay(repository: Path, tmp_path: Path) -> Path:
    """Headers of the kernel with all templates in them: each in its folder and in one list."""
    kernel = repository / "cpp" / "hydrodae"
    for template, folder, header, last, entry in PLACES:
        place = tmp_path / "hydrodae" / folder / template
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(repository / "docs" / "templates" / template, place)
        include = f"hydrodae/{folder}/{template}"
        changed = tmp_path / "hydrodae" / header
        changed.parent.mkdir(parents=True, exist_ok=True)
        changed.write_text(listed((kernel / header).read_text(), include, last, entry))
    page = repository / "docs" / "extending.md"
    rows = "".join(b.text for b in all_blocks(page) if b.text.startswith('{"slotted'))
    assert rows.count("slotted") == 2
    types = tmp_path / "hydrodae" / "joint" / "types.h"
    types.parent.mkdir(parents=True, exist_ok=True)
    table = (kernel / "joint" / "types.h").read_text()
    types.write_text(edit(table, r"table = \{\n", f"table = {{\n{rows}"))
    return tmp_path


def test_the_lists_of_the_kernel_take_the_templates(overlay: Path) -> None:
    changed = {str(p.relative_to(overlay / "hydrodae")) for p in overlay.rglob("*.h")}
    lists = {header for _, _, header, _, _ in PLACES} | {"joint/types.h"}
    assert changed == lists | {f"{folder}/{template}" for template, folder, *_ in PLACES}


@pytest.mark.slow
@pytest.mark.parametrize(
    "source",
    ["model/tables.cpp", "model/check_controller.cpp", "build/elements.cpp", "joint/basic.cpp"],
)
def test_the_kernel_compiles_with_the_templates(
    repository: Path, overlay: Path, source: str
) -> None:
    """Keys of all types, checks of controllers, laws of forces with channels, rows of joints."""
    compiler = shutil.which("g++") or shutil.which("clang++")
    if compiler is None or not Path("/usr/include/eigen3").is_dir():
        pytest.skip("no C++ compiler, or no Eigen where Debian has it")
    flags = ["-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", "-DTOML_HEADER_ONLY=0"]
    folders = [f"-I{overlay}", f"-I{repository / 'cpp'}", "-isystem/usr/include/eigen3"]
    file = repository / "cpp" / "hydrodae" / source
    command = [compiler, *flags, *folders, str(file)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_reader_is_one_module_and_one_word(
    repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    name = "hydrodae.hdb.readers.heave_table"
    spec = importlib.util.spec_from_file_location(
        name, repository / "docs" / "templates" / "heave_table.py"
    )
    assert spec
    assert spec.loader
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, name, module)
    spec.loader.exec_module(module)
    monkeypatch.setattr(formats, "READERS", (*formats.READERS, "heave_table"))

    sphere = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    k = sphere.coordinates.index("sphere.heave")
    force = sphere.excitation[:, 0, k]
    a, b = sphere.added_mass[:, k, k], sphere.radiation_damping[:, k, k]
    rows = zip(sphere.omega, a, b, force.real, force.imag, strict=True)
    header = f"# density={sphere.rho} gravity={sphere.gravity} depth=inf point=0,0,-2"
    text = "\n".join([header, *(" ".join(map(repr, map(float, row))) for row in rows)])
    (tmp_path / "sphere.heave").write_text(text)

    read, report = hdb.import_database(tmp_path)
    assert report.ok
    assert read.coordinates == ("sphere.heave",)
    assert read.added_mass[:, 0, 0] == pytest.approx(a, rel=1e-12)
    assert read.excitation[:, 0, 0] == pytest.approx(force, rel=1e-12)

    (tmp_path / "sphere.heave").write_text("# density=1000\n1 2 3 4 5\n")
    with pytest.raises(DatabaseError, match="'gravity'; expected '# density"):
        hdb.import_database(tmp_path)


def test_the_files_of_the_guide_exist(repository: Path) -> None:
    page = (repository / "docs" / "extending.md").read_text()
    names = re.findall(r"`((?:[\w.]+/)+[\w.]+\.(?:h|cpp|py))`", page)
    roots = (repository, repository / "cpp" / "hydrodae")
    assert len(names) > 20
    assert [name for name in names if not any((root / name).is_file() for root in roots)] == []
    templates = {file.name for file in (repository / "docs" / "templates").iterdir()}
    assert set(re.findall(r"\(templates/([\w.]+)\)", page)) == templates
