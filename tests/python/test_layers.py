"""The layers of the C++ library: a file includes its own layer and lower ones only."""

from __future__ import annotations

import re
from pathlib import Path

LAYERS = [
    {"core"},
    {"math"},
    {"sea", "hydro", "hull"},
    {"joint", "element", "control"},
    {"model"},
    {"io", "system"},
    {"measure", "events"},
    {"observe"},
    {"solve", "accuracy"},
    {"run", "cosim"},
    {"simulation.h", "analysis.h", "analysis_moorings.h", "examine.h", "session"},
]
LEVEL = {name: level for level, names in enumerate(LAYERS) for name in names}
ONLY = {
    "solve": r"<(ida|nvector|sundials|sunlinsol|sunmatrix)/",
    "io": r"<(toml\+\+/|hdf5\.h)",
}


def includes(repository: Path) -> list[tuple[str, str, str]]:
    """Return (file, its room, included path) of every include."""
    library = repository / "cpp" / "hydrodae"
    found = []
    for file in sorted(library.rglob("*.[ch]*")):
        relative = file.relative_to(library)
        room = "simulation.h" if len(relative.parts) == 1 else relative.parts[0]
        for line in file.read_text().splitlines():
            if match := re.match(r'#include ([<"].*[>"])', line):
                found.append((str(relative), room, match[1]))
    return found


def test_lower_layers_do_not_include_higher_ones(repository: Path) -> None:
    wrong = []
    for file, room, target in includes(repository):
        if target.startswith('"hydrodae/'):
            other = target.strip('"').split("/")[1]
            if LEVEL[other] > LEVEL[room]:
                wrong.append(f"{file} includes {target}")
    assert not wrong


def test_libraries_stay_in_their_rooms(repository: Path) -> None:
    wrong = [
        f"{file} includes {target}"
        for file, room, target in includes(repository)
        for owner, pattern in ONLY.items()
        if re.match(pattern, target) and room != owner
    ]
    assert not wrong
