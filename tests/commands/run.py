"""Running the commands of the documentation in clean copies of the repository."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from tests import reference_data
from tests.commands.find import Command

#: What is not run, by how it begins, and why.
LEFT_OUT = {
    "bash cases/quickstart.sh": "is a part of .ci/run",
    "bash tests/run.sh": "is a part of .ci/run",
    "pip install": "changes the environment",
    "pipx run cibuildwheel": "needs a container engine and an hour",
    "cmake --preset": "is a part of tests/run.sh",
    "ctest": "is a part of tests/run.sh",
}
#: Pages whose Python blocks make what their commands read: tests/python/test_docs.py runs both.
WITH_PYTHON = ("docs/closed_loop.md",)
#: What a page takes as given: commands that go before, and links into the reference data.
BEFORE = {"python/hydrodae/starters/README.md": ["hydrodae new point_absorber case", "cd case"]}
LINKS = {
    "cases/rm3": {"rm3_wamit": "hdb/rm3_wamit"},
    "cases/sphere": {"sphere.nc": "hdb/own/sphere.nc"},
}
PLACEHOLDER = re.compile(r"[A-Z]{3,}(\.\w+|\.\.\.)?")
LACK = re.compile(r"pip install|HYDRODAE_REFERENCE")
OWN = re.compile("^needs|of (?:one's|your) own")
LONG = re.compile("hour|choices? of the tests")
CHANGES_FOLDER = re.compile(r"cd (\S+)$")


@dataclass(frozen=True)
class Outcome:
    """How a command ended: passed, failed, too long, lacks or left out; and in words."""

    command: Command
    status: str
    detail: str = ""
    code: int | None = None
    seconds: float = 0.0

    def __str__(self) -> str:
        code = "-" if self.code is None else str(self.code)
        place = f"{self.command.source}:{self.command.line}"
        line = f"{self.status:8} {code:>4} {self.seconds:7.1f} s  {place}: {self.command.plain}"
        return f"{line}\n{'':26}{self.detail}" if self.detail else line


def group(command: Command) -> str:
    """Commands of one group run in one copy: those of a page, and all of the folder of a case."""
    case = re.match(r"cases/\w+", command.source)
    return case[0] if case else command.source


def bare(command: Command) -> str:
    """Text without its remark, variables and the path of the environment."""
    text = re.sub(r"^(\w+=\S+ )+|\s#\s.*", "", command.plain).replace(".venv/bin/", "")
    return " ".join(text.split())


def to_run(commands: Sequence[Command]) -> dict[str, list[Command]]:
    """Commands by group, each once in a group; those of scripts that no page has."""
    groups: dict[str, list[Command]] = {}
    of_pages = {bare(c) for c in commands if c.source.endswith(".md") and not c.sentence}
    for command in commands:
        own = groups.setdefault(group(command), [])
        told = command.usage and bare(command) in of_pages
        if not (command.sentence or told or bare(command) in map(bare, own)):
            own.append(command)
    return {name: found for name, found in groups.items() if found}


def make_copy(repository: Path, folder: Path) -> None:
    """Copy the files that git knows; `.venv` is the environment of this Python."""
    listed = subprocess.run(
        ["git", "ls-files", "-z"], cwd=repository, check=True, capture_output=True, text=True
    ).stdout
    for name in filter(None, listed.split("\0")):
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(repository / name, target)
    (folder / ".venv").symlink_to(sys.prefix)


def environment() -> dict[str, str]:
    """Variables of the commands: this Python first, no screen, the reference data where it is."""
    found = {**os.environ, "MPLBACKEND": "Agg", "PYTHONDONTWRITEBYTECODE": "1"}
    found["PATH"] = os.pathsep.join([str(Path(sys.prefix) / "bin"), found["PATH"]])
    found.pop("HYDRODAE_REFERENCE", None)
    if reference_data.folder().is_dir():
        found["HYDRODAE_REFERENCE"] = str(reference_data.folder())
    return found


def lack(text: str) -> str:
    """What a command names that only its reader has: a program, or a name in capitals."""
    for word in shlex.split(text, comments=True):
        if PLACEHOLDER.fullmatch(word) or word.startswith("REFERENCE"):
            return word
    word = re.sub(r"^(\w+=\S+ )+", "", text).split()[0]
    return "" if "/" in word or shutil.which(word, path=environment()["PATH"]) else word


def call(text: str, folder: Path, limit: float) -> tuple[int | None, str]:
    """Run one command; its exit code (None beyond the limit [s]) and the last line that it says."""
    process = subprocess.Popen(
        ["bash", "-c", text],
        cwd=folder,
        env=environment(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        said, _ = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, f"over {limit:g} s"
    lines = [line for line in said.splitlines() if line.strip()]
    return process.returncode, lines[-1].strip() if lines else ""


def outcome(command: Command, folder: Path, limit: float) -> Outcome:
    """Run a command in a folder."""
    for word, why in LEFT_OUT.items():
        if bare(command).startswith(word):
            return Outcome(command, "left out", why)
    text = command.plain
    if "HYDRODAE_REFERENCE" in environment():
        text = text.replace("REFERENCE", environment()["HYDRODAE_REFERENCE"])
    if missing := lack(text):
        return Outcome(command, "lacks", missing)
    start = time.monotonic()
    code, said = call(text, folder, limit)
    seconds = time.monotonic() - start
    expected = 2 if command.reason.startswith("an error") else 0
    if code == expected:
        return Outcome(command, "passed", "", code, seconds)
    if code == 2 and (LACK.search(said) or OWN.search(command.reason)):
        return Outcome(command, "lacks", said, code, seconds)
    return Outcome(command, "too long" if code is None else "failed", said, code, seconds)


def run_group(
    commands: Sequence[Command], repository: Path, folder: Path, limit: float, hours: bool = False
) -> Iterator[Outcome]:
    """Run the commands of a group in a new copy of the repository.

    Parameters
    ----------
    commands : sequence of Command
    repository, folder : path
        What is copied, and a new folder for the copy.
    limit : float
        Most seconds of a command.
    hours : bool
        Whether those run that take an hour or more, or are choices of the tests.
    """
    make_copy(repository, folder)
    (folder / "build").mkdir()
    name = group(commands[0])
    for link, target in LINKS.get(name, {}).items():
        if (reference_data.folder() / target).exists():
            (folder / link).symlink_to(reference_data.folder() / target)
    here = folder
    apart = [
        c
        for c in commands
        if c.source in WITH_PYTHON and (not c.reason or "test_docs.py" in c.reason)
    ]
    given = [Command(name, 0, text) for text in BEFORE.get(name, [])]
    for command in [*given, *commands]:
        if command in apart:
            yield Outcome(command, "left out", "needs the Python of its page: test_docs.py runs it")
            continue
        if found := CHANGES_FOLDER.match(command.plain):
            here = here / found[1]
            continue
        if LONG.search(command.reason) and not hours:
            yield Outcome(command, "left out", f"{command.reason}; --hours runs it")
            continue
        result = outcome(command, here, limit)
        if command not in given or result.status != "passed":
            yield result
