"""What docs/reference.py makes: the reference pages and the stub of `hydrodae.Scene`."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from hydrodae.case.tables import tables


def test_pages_and_stub_are_up_to_date(repository: Path) -> None:
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
