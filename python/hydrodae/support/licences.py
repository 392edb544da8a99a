"""Licences of the package and of what is inside it."""

from __future__ import annotations

import re
from importlib.metadata import PackageNotFoundError, files
from pathlib import Path

#: The list of works with their licences, and the licence of the package.
LIST = Path(__file__).with_name("LICENSES.md")


def expression() -> str:
    """SPDX expression of all licences in the list.

    Examples
    --------
    >>> expression()
    'BSD-3-Clause AND LGPL-2.1-or-later AND MIT AND MPL-2.0 AND Zlib'
    """
    rows = re.findall(r"^\| [^|]+ \| [^|]+ \| ([^|]+) \| <", LIST.read_text("utf-8"), re.MULTILINE)
    return " AND ".join(sorted({row.strip() for row in rows}))


def texts() -> dict[str, bytes]:
    """The list, and the texts that a wheel has beside it, by their path below `licenses`."""
    found = {"license.txt": LIST.read_bytes()}
    try:
        own = files("hydrodae") or []
    except PackageNotFoundError:  # a copy of the sources
        own = []
    for path in own:
        folder, _, name = path.as_posix().partition(".dist-info/licenses/")
        if folder.startswith("hydrodae-") and name.count("/") == 1:  # of a library
            found[name] = Path(str(path.locate())).read_bytes()
    return found
