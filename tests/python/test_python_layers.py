"""The layers of the Python package: a module imports its own layer and lower ones, in no circle.

All imports count, those inside functions and those for type checkers as well.
"""

from __future__ import annotations

import ast
import subprocess
import sys
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

#: Rooms from the lowest to the highest. A room is a module or a folder with all that is in it,
#: unless a part of it is listed by itself; those of one layer do not import each other.
LAYERS = [
    {"errors"},  # what the kernel raises as well
    {"support", "starters"},
    {"records"},  # measured, from files
    # one database, which needs no kernel
    {"hdb.relations", "hdb.hull", "hdb.labels"},
    {"hdb.memory"},
    {"hdb.database"},
    {"hdb.bem", "hdb.checks", "hdb.interaction", "hdb.readers"},
    {"hdb.preparation"},
    {"hdb"},
    {"_core"},  # the compiled kernel
    # one case and its results
    {"case", "results"},
    {"linear", "pictures", "simulation"},
    {"control", "fmu", "mooring"},
    # many runs of a case, and what people ask about it
    {"study", "viewer", "wecsim"},
    {"report"},
    {"commands"},
    {"", "__main__"},
]
#: Folders whose parts are rooms of their own, all of them listed above.
OPEN = {"hdb"}
LEVEL = {room: level for level, rooms in enumerate(LAYERS) for room in rooms}

Imports = dict[str, set[str]]


def room_of(module: str) -> str:
    """The longest listed name that a module is or is in; its root is ""."""
    parts = module.split(".")
    names = [".".join(parts[:count]) for count in range(len(parts), 0, -1)]
    found = next((name for name in names if name in LEVEL), None)
    assert found is not None, f"{module} is in no layer"
    assert found not in OPEN or module in OPEN, f"{module} is in no layer"
    return found


def read_imports(package: Path) -> Imports:
    """Modules of the package that each of its modules imports, names without that of the package.

    The folder of a module is no import of it: `from hydrodae.hdb import files` is of `hdb.files`.
    """
    files = {}
    for file in sorted(package.rglob("*.py")):
        parts = file.relative_to(package).with_suffix("").parts
        files[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = file
    known = {*files, "_core"}
    found: Imports = {"_core": set()}
    for module, file in files.items():
        found[module] = set()
        for node in ast.walk(ast.parse(file.read_text())):
            for name in imported(node):
                if name == package.name or name.startswith(f"{package.name}."):
                    inside = name.removeprefix(package.name).removeprefix(".")
                    if inside not in known:
                        inside = inside.rpartition(".")[0]  # a name in a module
                    assert inside in known, f"{file}: there is no module {name}"
                    found[module].add(inside)
        found[module].discard(module)
    return found


def imported(node: ast.AST) -> list[str]:
    """Full names that an import statement asks for."""
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    if isinstance(node, ast.ImportFrom):
        assert node.level == 0, "imports are absolute in this package"
        return [f"{node.module}.{alias.name}" for alias in node.names]
    return []


def wrong_layers(imports: Imports) -> list[str]:
    wrong = []
    for module, targets in imports.items():
        for target in sorted(targets):
            room, other = room_of(module), room_of(target)
            if other != room and LEVEL[other] >= LEVEL[room]:
                wrong.append(f"{module or 'the package'} imports {target or 'the package'}")
    return wrong


def circle(imports: Imports) -> list[str]:
    try:
        TopologicalSorter(imports).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


@pytest.fixture(scope="module")
def imports(repository: Path) -> Imports:
    return read_imports(repository / "python" / "hydrodae")


def test_lower_layers_do_not_import_higher_ones(imports: Imports) -> None:
    assert wrong_layers(imports) == []


def test_no_modules_import_each_other_in_a_circle(imports: Imports) -> None:
    assert circle(imports) == []


def test_every_room_of_the_list_is_there(imports: Imports) -> None:
    assert {room_of(module) for module in imports} == set(LEVEL)


def test_a_wrong_import_is_seen_wherever_it_stands(tmp_path: Path) -> None:
    package = tmp_path / "hydrodae"
    package.mkdir()
    (package / "__init__.py").write_text("from hydrodae.case import Case\n")
    (package / "errors.py").write_text(
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from hydrodae.case import Case\n"
    )
    (package / "case.py").write_text("def f():\n    from hydrodae import errors, linear\n")
    (package / "linear.py").write_text("import hydrodae.case\nfrom hydrodae import _core\n")
    found = read_imports(package)
    assert wrong_layers(found) == ["case imports linear", "errors imports case"]
    assert {"case", "linear"} <= set(circle(found)) or {"case", "errors"} <= set(circle(found))


def test_databases_need_no_kernel() -> None:
    """All of hdb is imported, and a name of it used, where the compiled kernel is not there."""
    code = """
import sys
sys.modules["hydrodae._core"] = None
from importlib import import_module
from pkgutil import walk_packages
import hydrodae.hdb
for module in walk_packages(hydrodae.hdb.__path__, "hydrodae.hdb."):
    import_module(module.name)
for name in hydrodae.hdb.__all__:
    getattr(hydrodae.hdb, name)
try:
    hydrodae.tables.tables()
except ImportError:
    print("done")
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.stdout == "done\n", run.stderr


def test_importing_the_package_is_cheap() -> None:
    """Nor needs a controller that is another program any library."""
    code = """
import sys
import hydrodae, hydrodae.control.tcp
dear = {"numpy", "scipy", "h5py", "matplotlib", "xarray", "hydrodae._core"} & set(sys.modules)
assert not dear, dear
"""
    subprocess.run([sys.executable, "-c", code], check=True)
