"""A subject of the mutation check, and how one of its mutants is tried."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import hydrodae

ROOT = Path(__file__).resolve().parents[2]
INSTALLED = Path(hydrodae.__file__).parent
#: Seconds for the tests of one mutant; one that hangs is killed.
LIMIT = 600.0


@dataclass(frozen=True)
class Mutant:
    """One wrong line: `new` in place of `old`, which stands once in the file."""

    file: str  #: below the repository
    old: str
    new: str

    @property
    def name(self) -> str:
        """File, and what is wrong in it."""
        return f"{self.file}: {self.old.strip()} -> {self.new.strip() or '(nothing)'}"


@dataclass(frozen=True)
class Subject:
    """Mutants of some files, and the tests that have to see them."""

    name: str
    tests: tuple[str, ...]
    mutants: tuple[Mutant, ...]
    compiled: bool = False  #: sources of the kernel: each mutant is built


def copy_package(folder: Path) -> Path:
    """Copy the package with its kernel into a folder for `PYTHONPATH`; returns the folder."""
    site = folder / "site"
    shutil.copytree(
        INSTALLED, site / "hydrodae", ignore=shutil.ignore_patterns("__pycache__"), symlinks=False
    )
    return site


def mutate(mutant: Mutant, root: Path, copy: Path) -> None:
    """Write the wrong file of a mutant into a copy of the sources.

    Raises
    ------
    ValueError
        The text stands nowhere in the file, or more than once.
    """
    text = (root / mutant.file).read_text()
    if (count := text.count(mutant.old)) != 1:
        raise ValueError(f"{mutant.name}: the text stands {count} times in the file, not once")
    copy.write_text(text.replace(mutant.old, mutant.new))


def passes(tests: tuple[str, ...], site: Path) -> bool:
    """Whether all tests pass with the package of a folder."""
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", *tests]
    environment = os.environ | {"PYTHONPATH": str(site), "PYTHONDONTWRITEBYTECODE": "1"}
    try:
        done = subprocess.run(
            command, cwd=ROOT, env=environment, capture_output=True, timeout=LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def survives(subject: Subject, mutant: Mutant, folder: Path, site: Path) -> bool:
    """Whether the tests of a subject pass with a mutant; the copy is whole again after it."""
    if subject.compiled:
        return _survives_compiled(subject, mutant, folder)
    copy = site / Path(mutant.file).relative_to("python")
    mutate(mutant, ROOT, copy)
    try:
        return passes(subject.tests, site)
    finally:
        shutil.copyfile(ROOT / mutant.file, copy)


def _survives_compiled(subject: Subject, mutant: Mutant, folder: Path) -> bool:
    """As `survives`, with a kernel that is built from a copy of the repository."""
    tree, built = folder / "tree", folder / "built"
    if not tree.exists():
        names = ("CMakeLists.txt", "pyproject.toml", "README.md", "LICENSE", "cpp", "python")
        tree.mkdir()
        for source in (ROOT / name for name in names):
            copy = shutil.copytree if source.is_dir() else shutil.copy
            copy(source, tree / source.name)
    mutate(mutant, ROOT, tree / mutant.file)
    try:
        command = [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--upgrade"]
        command += ["--no-build-isolation", "--target", str(built), str(tree)]
        subprocess.run(command, check=True)
        return passes(subject.tests, built)
    finally:
        shutil.copyfile(ROOT / mutant.file, tree / mutant.file)
