"""Runs in the folders below one: the user names the folder of a case, whatever its layout."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path

#: How far below the folder that was named, and in how many folders, runs are looked for.
DEEPEST, MOST = 5, 2000


def runs_below(root: Path, holds_one: Callable[[Path], bool]) -> list[Path]:
    """Return the folders below `root` that hold a run, copies of others left out.

    Parameters
    ----------
    root : Path
    holds_one : function of a folder
        Whether it holds a run by itself; folders within such a one are not looked at.

    Returns
    -------
    list of Path
        In alphabetical order. Of folders whose files of results are byte for byte among those of
        another one, that other one only.
    """
    found: list[Path] = []
    waiting = [(child, 1) for child in _folders(root)]
    seen = 0
    while waiting and seen < MOST:
        folder, depth = waiting.pop(0)
        seen += 1
        if holds_one(folder):
            found.append(folder)
        elif depth < DEEPEST:
            waiting += [(child, depth + 1) for child in _folders(folder)]
    return _without_copies(sorted(found))


def _folders(path: Path) -> list[Path]:
    try:
        children = sorted(path.iterdir())
    except OSError:  # not ours to look into
        return []
    return [p for p in children if p.is_dir() and not p.is_symlink() and p.name[0] not in "._"]


def _without_copies(folders: list[Path]) -> list[Path]:
    if len(folders) < 2:
        return folders
    prints = [_prints(folder) for folder in folders]
    kept = []
    for i, own in enumerate(prints):
        within = [
            j
            for j, other in enumerate(prints)
            if j != i and own <= other and (own < other or j < i)
        ]
        if not within or not own:
            kept.append(folders[i])
    return kept


def _prints(folder: Path) -> frozenset[str]:
    """Hashes of the files in and below a folder that are not empty."""
    files = [p for p in folder.rglob("*") if p.is_file() and p.stat().st_size > 0]
    return frozenset(hashlib.sha256(p.read_bytes()).hexdigest() for p in files)
