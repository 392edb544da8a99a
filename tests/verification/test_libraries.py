"""Force laws of shared libraries, compiled by the tests."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.errors import CaseError

METHODS = ["ida", "radau", "explicit_rk"]


def compile_library(source: Path, repository: Path, target: Path) -> Path:
    compiler = shutil.which("c++")
    assert compiler, "the tests need a C++ compiler"
    include = repository / "cpp" / "hydrodae" / "element"
    command = [compiler, "-O1", "-shared", "-fPIC", f"-I{include}", str(source), "-o", str(target)]
    subprocess.run(command, check=True)
    return target


@pytest.fixture(scope="module")
def brake(repository: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("plugin")
    return compile_library(
        repository / "cases" / "plugin" / "brake.cpp", repository, folder / "brake.so"
    )


def only(text: str, name: str) -> str:
    """The case without its other force."""
    head, *forces = text.split("[[force]]\n")
    last, solver = forces[-1].split("[solver]")
    forces[-1] = last
    kept = [force for force in forces if f'name = "{name}"' in force]
    return head + "".join(f"[[force]]\n{force}" for force in kept) + "[solver]" + solver


@pytest.mark.parametrize("method", METHODS)
def test_a_law_of_a_library_brakes(method: str, brake: Path, repository: Path) -> None:
    """m v' = -c v^2: v = v0 / (1 + c v0 t / m)."""
    text = only((repository / "cases" / "plugin" / "case.toml").read_text(), "brake")
    case = hydrodae.Case.from_text(text, libraries=[brake]).with_values(
        {"solver.method": method, "solver.rtol": 1e-8}
    )
    run = hydrodae.run(case)
    rate = run["joints/slide/displacement_rate"].values
    assert rate == pytest.approx(3.0 / (1.0 + 1.5 * 3.0 * run.time / 2.0), rel=1e-6)
    assert run["forces/brake/force"].values == pytest.approx(-1.5 * rate**2, rel=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_a_law_with_a_state(method: str, brake: Path, repository: Path) -> None:
    """Mass, spring and damper in a row: s'' = -k z / m, z' = s' - k z / c, by its eigenvalues."""
    text = only((repository / "cases" / "plugin" / "case.toml").read_text(), "buffer")
    case = hydrodae.Case.from_text(text, libraries=[brake])
    run = hydrodae.run(case.with_values({"solver.method": method, "solver.rtol": 1e-8}))
    matrix = np.array([[0.0, -40.0 / 2.0], [1.0, -40.0 / 8.0]])
    values, vectors = np.linalg.eig(matrix)
    start = np.linalg.solve(vectors, np.array([3.0, 0.0]))
    motion = (vectors @ (start[:, None] * np.exp(values[:, None] * run.time))).real
    assert run["joints/slide/displacement_rate"].values == pytest.approx(motion[0], abs=1e-6)
    assert run["forces/buffer/stretch"].values == pytest.approx(motion[1], abs=1e-6)


def test_the_executable_takes_libraries(
    brake: Path, repository: Path, tmp_path: Path, executable: Path
) -> None:
    case = repository / "cases" / "plugin" / "case.toml"
    output = tmp_path / "out.h5"
    command = [str(executable), str(case), "-o", str(output), "--library", str(brake), "--quiet"]
    subprocess.run(command, check=True)
    assert hydrodae.Results.read(output)["forces/buffer/stretch"].values.max() > 0.1
    missing = subprocess.run([*command[:4], "--quiet"], capture_output=True, text=True)
    assert missing.returncode == 2
    assert "--library" in missing.stderr


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('law = "brake"', 'law = "break"', r"no library has a law .break.*did you mean .brake"),
        (
            "parameters = [1.5]",
            "parameters = [1.5, 2.0]",
            r"takes 1 parameters \(damping\), the case gives 2",
        ),
        (
            'type = "library_load"\nname = "brake"\njoint = "slide"',
            'type = "library_wrench"\nname = "brake"\nbody = "block"',
            "acts along a joint",
        ),
    ],
)
def test_what_does_not_fit_is_refused(
    old: str, new: str, message: str, brake: Path, repository: Path
) -> None:
    text = (repository / "cases" / "plugin" / "case.toml").read_text()
    assert old in text
    with pytest.raises(CaseError, match=message):
        hydrodae.Case.from_text(text.replace(old, new), libraries=[brake])


def test_what_is_no_library_is_refused(repository: Path, tmp_path: Path) -> None:
    case = repository / "cases" / "plugin" / "case.toml"
    with pytest.raises(CaseError, match="no such file"):
        hydrodae.Case.read(case, libraries=[tmp_path / "none.so"])
    text = tmp_path / "text.so"
    text.write_text("no library\n")
    with pytest.raises(CaseError, match="cannot be loaded"):
        hydrodae.Case.read(case, libraries=[text])
    source = tmp_path / "empty.cpp"
    source.write_text("int nothing() { return 0; }\n")
    empty = compile_library(source, repository, tmp_path / "empty.so")
    with pytest.raises(CaseError, match="HYDRODAE_PLUGIN"):
        hydrodae.Case.read(case, libraries=[empty])
    old = (repository / "cases" / "plugin" / "brake.cpp").read_text()
    source.write_text(
        old.replace(
            '#include "plugin.h"',
            '#include "plugin.h"\n'
            "#undef HYDRODAE_PLUGIN_VERSION\n#define HYDRODAE_PLUGIN_VERSION 7",
        )
    )
    other = compile_library(source, repository, tmp_path / "other.so")
    with pytest.raises(CaseError, match="version 7"):
        hydrodae.Case.read(case, libraries=[other])
