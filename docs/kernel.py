"""The package where its kernel is not built: enough of it to read docstrings.

`docs/site.py` and `docs/api.py` import this module before the package.
"""

from __future__ import annotations

import ast
import importlib.util
import sys
from pathlib import Path
from types import ModuleType

PACKAGE = Path(__file__).resolve().parent.parent / "python"
NAME = "hydrodae._core"


def stand_in() -> ModuleType:
    """A module with the names of the stub of the kernel, without values.

    Its functions return empty lists.
    """
    stub = PACKAGE / "hydrodae" / "_core.pyi"
    tree = ast.parse(stub.read_text())
    for node in tree.body:
        if isinstance(node, ast.AnnAssign):
            node.value = ast.Constant(None)
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            node.body = [ast.Return(ast.List([], ast.Load()))]
    module = ModuleType(NAME)
    vars(module)["__annotations__"] = {}
    later = ast.parse("from __future__ import annotations").body
    tree.body = [*later, *tree.body[1:]]
    exec(compile(ast.fix_missing_locations(tree), str(stub), "exec"), vars(module))
    return module


if importlib.util.find_spec("hydrodae") is None:
    sys.path.insert(0, str(PACKAGE))
#: False: the kernel is a stand-in, and methods made from its fields are missing.
BUILT = importlib.util.find_spec(NAME) is not None
if not BUILT:
    sys.modules[NAME] = stand_in()
