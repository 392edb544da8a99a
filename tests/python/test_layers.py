"""The layers of the C++ library: a file includes its own room and rooms of lower layers only."""

from __future__ import annotations

import re
from pathlib import Path

LAYERS = [
    {"core"},
    {"math"},
    {"sea", "hull"},
    {"hydro", "joint", "element", "control"},
    {"water", "air"},
    {"line"},
    {"model"},
    {"io", "system", "cosim"},
    {"build", "measure", "linalg"},
    {"sanity", "observe", "events", "accuracy"},
    {"statics", "integrate"},
    {"run"},
    {"simulation.h"},
    {"check", "session"},
    {"ensemble"},
]
# Rooms that hold the equations of motion and the methods that integrate them.
HEART = {
    "core",
    "math",
    "sea",
    "hull",
    "hydro",
    "joint",
    "element",
    "control",
    "water",
    "line",
    "air",
}
HEART |= {"system", "linalg", "integrate", "events"}
LEVEL = {name: level for level, names in enumerate(LAYERS) for name in names}
ONLY = {
    "integrate": r"<(ida|nvector|sundials|sunlinsol|sunmatrix)/",
    "linalg": r"<(klu|suitesparse)",
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
            if other != room and LEVEL[other] >= LEVEL[room]:
                wrong.append(f"{file} includes {target}")
    assert not wrong


def test_the_heart_knows_no_case(repository: Path) -> None:
    """Equations, steps and methods read a System: no case, no file, no way of building it."""
    wrong = [
        f"{file} includes {target}"
        for file, room, target in includes(repository)
        if room in HEART and re.match(r'"hydrodae/(model|build|io|check|session|statics)/', target)
    ]
    assert not wrong


def test_the_precompiled_header_holds_no_element(repository: Path) -> None:
    """A change of one law must not compile every source again."""
    text = (repository / "cpp" / "CMakeLists.txt").read_text()
    listed = re.search(r"target_precompile_headers\(hydrodae PRIVATE ([^)]*)\)", text)
    assert listed
    assert {word for word in listed[1].split() if "hydrodae/" in word} == {"hydrodae/core/field.h"}


def test_a_change_of_one_force_compiles_few_sources(repository: Path) -> None:
    """Sources that read the header of a type of force: those that name types of force."""
    included: dict[str, set[str]] = {}
    for file, _, target in includes(repository):
        included.setdefault(file, set()).add(target.strip('"<>').removeprefix("hydrodae/"))

    def behind(file: str, seen: set[str]) -> set[str]:
        for target in included.get(file, set()) - seen:
            seen.add(target)
            behind(target, seen)
        return seen

    sources = {file: behind(file, set()) for file in included if file.endswith(".cpp")}
    forces = {f for f in included["model/forces.h"] if f.startswith("element/")}
    assert len(forces) >= 15
    many = {f: n for f in forces if (n := sum(f in read for read in sources.values())) > 15}
    assert not many


def test_libraries_stay_in_their_rooms(repository: Path) -> None:
    wrong = [
        f"{file} includes {target}"
        for file, room, target in includes(repository)
        for owner, pattern in ONLY.items()
        if re.match(pattern, target) and room != owner
    ]
    assert not wrong


def test_no_code_asks_for_a_type_or_method_by_its_name(repository: Path) -> None:
    """What differs from type to type is a member of the type, or stands in a table."""
    asks = re.compile(r"\b(type|method|kind)(->name)? *[!=]= *[\"']")
    files = [*(repository / "cpp" / "hydrodae").rglob("*.[ch]*")]
    files += (repository / "python" / "hydrodae").rglob("*.py")
    wrong = [
        f"{file.relative_to(repository)}:{number}: {line.strip()}"
        for file in sorted(files)
        if "wecsim" not in file.parts
        for number, line in enumerate(file.read_text().splitlines(), 1)
        if asks.search(line)
    ]
    assert not wrong
