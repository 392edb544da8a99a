"""Optional parts of the package: how to get what is missing, by a command that works."""

from __future__ import annotations

import json
import re
import shlex
from importlib import metadata
from pathlib import Path
from urllib.parse import unquote, urlparse


def install_command(extra: str) -> str:
    """Return the pip command that installs an extra of this package.

    The package is on no registry: the command names the folder that it was installed from where
    that is still there, else the packages that the extra consists of.

    Parameters
    ----------
    extra : str
        Such as "bem".
    """
    folder = source_folder()
    if folder is not None:
        return f"pip install {shlex.quote(f'{folder}[{extra}]')}"
    return "pip install " + " ".join(shlex.quote(name) for name in requirements(extra))


def source_folder() -> Path | None:
    """Folder with the sources that the installed package was built from, if it is still there."""
    try:
        text = metadata.distribution("hydrodae").read_text("direct_url.json")
    except metadata.PackageNotFoundError:
        return None
    if not text:
        return None
    url = urlparse(json.loads(text).get("url", ""))
    folder = Path(unquote(url.path))
    return folder if url.scheme == "file" and (folder / "pyproject.toml").is_file() else None


def requirements(extra: str) -> list[str]:
    """Packages of an extra, such as "capytaine>=3"."""
    found = []
    for line in metadata.requires("hydrodae") or []:
        name, _, marker = line.partition(";")
        if re.search(rf"extra\s*==\s*['\"]{re.escape(extra)}['\"]", marker):
            found.append(name.strip())
    return found
