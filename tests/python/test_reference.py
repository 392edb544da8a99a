"""What is made of the tables of the kernel: reference pages, and the stub of `hydrodae.Scene`."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

from hydrodae import Scene, _core
from hydrodae.case.tables import tables


def test_the_pages_are_up_to_date(repository: Path) -> None:
    done = subprocess.run(
        [sys.executable, repository / "docs" / "reference.py", "--check"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_every_table_has_a_page_with_all_its_keys(repository: Path) -> None:
    for table in tables():
        text = (repository / "docs" / "reference" / f"{table.name}.md").read_text()
        for kind in (table, *table.types):
            assert all(f"| `{key.name}` |" in text for key in kind.keys)
            assert kind.doc.replace("|", "\\|") in text or kind.doc in text


def test_the_stub_has_every_method_with_its_keys(repository: Path, tmp_path: Path) -> None:
    """As the build makes it: of the source and a kernel."""
    script, stub = repository / "python" / "bindings" / "scene_stub.py", tmp_path / "scene.pyi"
    command = [sys.executable, "-B", str(script), str(stub), "--kernel", _core.__file__]
    subprocess.run(command, check=True)
    module = ast.parse(stub.read_text())
    classes = {node.name: node for node in module.body if isinstance(node, ast.ClassDef)}
    members = {
        (name, f.name): {a.arg for a in f.args.kwonlyargs}
        for name, node in classes.items()
        for f in node.body
        if isinstance(f, ast.FunctionDef)
    }
    for table in tables():
        assert hasattr(Scene, table.name)
        owner = f"{table.name.capitalize()}Types" if table.types else "Scene"
        for kind in table.types or (table,):
            keys = (
                {key.name for key in kind.keys} - {"type"} - ({"name"} if table.is_list else set())
            )
            assert keys <= members[owner, kind.name]
