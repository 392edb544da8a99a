"""The mutation check: its mutants stand in the sources, and one that is wrong is seen."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.mutation import __main__ as command
from tests.mutation.subject import Mutant, Subject, mutate


def test_every_mutant_stands_once_in_its_file(repository: Path, tmp_path: Path) -> None:
    for subject in command.SUBJECTS.values():
        assert subject.compiled or len(subject.mutants) == 20
        assert len({mutant.name for mutant in subject.mutants}) == len(subject.mutants)
        assert all((repository / test).is_file() for test in subject.tests)
        for mutant in subject.mutants:
            mutate(mutant, repository, tmp_path / "copy")


def test_a_mutant_is_killed_or_survives(
    repository: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    test = tmp_path / "test_one.py"
    test.write_text(
        "from hydrodae.support.units import power_text\n"
        "def test_it(): assert power_text(17020.0) == '17.02 kW'\n"
    )
    units = "python/hydrodae/support/units.py"
    before = (repository / units).read_bytes()
    wrong = Mutant(units, '("k", 1e3)', '("k", 1e2)')
    harmless = Mutant(units, '("G", 1e9)', '("G", 2e9)')
    assert not command.check(Subject("one", (str(test),), (wrong, harmless)), tmp_path)
    assert [line.split()[0] for line in capsys.readouterr().out.splitlines()] == [
        *("killed", "SURVIVES", "one:")
    ]
    assert (repository / units).read_bytes() == before


def test_an_unknown_subject_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        command.main(["sweeps"])
    assert "no subject 'sweeps'; there are sweep, " in capsys.readouterr().err
