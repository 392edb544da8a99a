"""Writes the archive of an FMU."""

from __future__ import annotations

import hashlib
import os
import platform
import re
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from hydrodae.case import Case
from hydrodae.case.case import CaseLike, read_case, to_toml
from hydrodae.case.contents import case_tables
from hydrodae.errors import CaseError
from hydrodae.fmu.description import Description, model_description, start_text, type_of
from hydrodae.fmu.variables import PARAMETER, Variable, choose, number_at
from hydrodae.support import licences

_PLATFORMS = {2: "linux64", 3: "x86_64-linux"}


def export(
    case: CaseLike,
    path: str | os.PathLike[str],
    *,
    fmi: int = 3,
    inputs: Sequence[str] | None = None,
    outputs: Sequence[str] | None = None,
    parameters: Sequence[str] = (),
    set: Mapping[str, Any] | None = None,
) -> Path:
    """Write a case as an FMU for co-simulation.

    Parameters
    ----------
    case : Case or path
        The case, or the path of its file.
    path : path
        Of the FMU, with the ending .fmu; a file that is there is replaced.
    fmi : int
        Version of the standard, 2 or 3.
    inputs, outputs : sequence of str, optional
        Names or patterns such as ``"joints/*"`` of what `hydrodae.Simulation` writes and reads,
        vectors by component; by default all. Inputs that a controller of the case writes are none.
    parameters : sequence of str
        Dotted keys of numbers, truth values and words of the case that an importer may set before
        the run begins.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.

    Returns
    -------
    Path
        Of the FMU.

    Raises
    ------
    CaseError
        The case cannot start, needs Python functions or libraries of its own, or has no such
        variables; `path` does not end in .fmu; or this machine is of another sort than FMUs are
        made for.
    """
    if Path(path).suffix != ".fmu":
        raise CaseError(f"{path}: an FMU needs a name that ends in .fmu")
    if fmi not in _PLATFORMS:
        raise CaseError(f"version {fmi!r} of FMI: there are 2 and 3")
    read = read_case(case, set)
    _require_self_contained(read)
    chosen = choose(read, inputs, outputs, parameters)
    files, values = _files(read)
    text = read.text
    content = _variables_text({**read.overrides, **values}, chosen)
    files_text = read.scene.text_of_files
    token = hashlib.sha256("\n".join([text, content, files_text]).encode()).hexdigest()
    identifier = re.sub(r"\W|^(?=\d)", "_", Path(path).stem, flags=re.ASCII)
    told = Description(identifier, read.title, token, read.end_time, _step(read), chosen)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("modelDescription.xml", model_description(told, fmi))
        folder = f"binaries/{_PLATFORMS[fmi]}"
        for name, library in _libraries(identifier).items():
            archive.writestr(f"{folder}/{name}", library)
        for name, licence in licences.texts().items():
            archive.writestr(f"documentation/licenses/{name}", licence)
        archive.writestr("resources/case.toml", text)
        archive.writestr("resources/variables.txt", f"hydrodae-fmu\t1\ntoken\t{token}\n{content}")
        for name, file in files.items():
            archive.write(file, f"resources/{name}")
    return Path(path)


def _require_self_contained(case: Case) -> None:
    scene = case.scene
    names = [*scene.python_drives, *scene.python_forces, *scene.python_controllers]
    if names:
        raise CaseError(f"{names[0]!r} is a Python function, which an FMU cannot take along")
    controllers = case_tables(case).get("controller", [])
    inner = [c["name"] for c in controllers if c["type"] == "fmu"]
    if inner:
        raise CaseError(f"controller {inner[0]!r} is an FMU, which cannot be part of another one")
    if case.libraries:
        raise CaseError("laws of shared libraries cannot be part of an FMU")


def _libraries(identifier: str) -> dict[str, bytes]:
    """By name: the functions of FMI, the kernel, and what auditwheel put beside the package.

    Each looks for the others beside itself. Other installations than wheels take the libraries that
    the kernel needs from the system.
    """
    machine = platform.system(), platform.machine()
    if machine != ("Linux", "x86_64"):
        raise CaseError(f"FMUs are made on Linux, x86_64; this is {' '.join(machine)}")
    from hydrodae import _core

    package = Path(_core.__file__).parent
    name = f"libhydrodae-{_core.version}.so"
    functions, kernel = package / "lib" / "hydrodae_fmu.so", package / name
    for path in (functions, kernel):
        if not path.is_file():
            raise CaseError(f"{path}: not there; install the package again")
    # A process that has a library of this name loads no other one: the name in the FMU is that of
    # the content, so that it never meets another build. It keeps its length in both files.
    mark = hashlib.sha256(kernel.read_bytes()).hexdigest()[: len(_core.version)]
    own = f"libhydrodae-{mark}.so"
    pair = {f"{identifier}.so": functions, own: kernel}
    contents = {key: p.read_bytes().replace(name.encode(), own.encode()) for key, p in pair.items()}
    others = (package.parent / "hydrodae.libs").glob("*")
    return contents | {path.name: path.read_bytes() for path in sorted(others)}


def _files(case: Case) -> tuple[dict[str, Path], dict[str, str]]:
    """Files that the case reads, by their name in the FMU, and the keys that name them as TOML."""
    files: dict[str, Path] = {}
    names: dict[str, list[str]] = {}
    for key, _, path, _ in case.scene.files:
        name = f"{len(files)}_{Path(path).name}"
        files[name] = Path(path)
        names.setdefault(key, []).append(name)
    lists = {key for key in names if key.endswith(".databases")}
    return files, {key: to_toml(own if key in lists else own[0]) for key, own in names.items()}


def _variables_text(values: Mapping[str, str], variables: Sequence[Variable]) -> str:
    """Fields with tabs in between; what the lines are says cpp/app/fmi/contents.h."""
    lines = [["set", key, value] for key, value in values.items()]
    lines.append(["time", "0"])
    for v in variables:
        start = [] if v.start is None else [start_text(v.start)]
        kind = type_of(v).line if v.causality is PARAMETER else v.causality.word
        lines.append([kind, str(v.reference), *start, v.name])
    for line in lines:
        if any(set(field) & set("\t\n\r") for field in line):
            raise CaseError(f"{line[-1]!r}: names with tabs or line ends cannot be in an FMU")
    return "".join("\t".join(line) + "\n" for line in lines)


def _step(case: Case) -> float:
    """Suggested communication step [s]: that of the output."""
    try:
        return number_at(case, "output.step")
    except CaseError:
        return case.end_time / 1000.0
