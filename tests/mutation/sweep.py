"""Mutants of sweeps: the record, points, means, annual energy."""

from __future__ import annotations

from tests.mutation.subject import Mutant, Subject

_ROOM = "python/hydrodae/study/sweep"
_JOURNAL, _PLAN, _POINTS = (f"{_ROOM}/{name}.py" for name in ("journal", "plan", "points"))
_TABLE, _ESTIMATE, _REPETITIONS = (f"{_ROOM}/{n}.py" for n in ("table", "estimate", "repetitions"))

SUBJECT = Subject(
    "sweep",
    (
        *("tests/python/test_journal.py", "tests/python/test_control_variates.py"),
        *("tests/python/test_input_files.py", "tests/python/test_sweep.py"),
    ),
    (
        Mutant(_JOURNAL, '"case": _digest(case.text)', '"case": ""'),
        Mutant(_JOURNAL, '_digest("\\0".join(map(str, measured)))', '""'),
        Mutant(_JOURNAL, "case.scene.text_of_files + more", "case.scene.text_of_files"),
        Mutant(_JOURNAL, '"version of hydrodae": version()', '"version of hydrodae": ""'),
        Mutant(_JOURNAL, "fcntl.LOCK_EX | fcntl.LOCK_NB", "fcntl.LOCK_SH | fcntl.LOCK_NB"),
        Mutant(_JOURNAL, 'row.pop("crc32") == _checksum(row)', 'row.pop("crc32")'),
        Mutant(_JOURNAL, "self._file.truncate(len(whole) + 1)", "pass"),
        Mutant(_JOURNAL, "        self._file.flush()\n", "        pass\n"),
        Mutant(_PLAN, "*((self.repetitions.seeds,) if controlled else ())", "*()"),
        Mutant(_PLAN, "set(study.dimensions) - {*study.over, RUNG} != {", "{1} == {"),
        Mutant(_PLAN, "x >= 0.0 for column", "x >= -1e9 for column"),
        Mutant(_PLAN, "json.dumps(point, sort_keys=True)", "json.dumps(point)[:20]"),
        Mutant(_POINTS, "draw.permutation(samples)", "draw.integers(samples, size=samples)"),
        Mutant(_POINTS, "itertools.product(*kinds)", "zip(*kinds)"),
        Mutant(_POINTS, "if len(keys) != len(set(keys))", "if False"),
        Mutant(_TABLE, "power.isel(at) * hours * 3600.0", "power.isel(at) * hours * 3500.0"),
        Mutant(_TABLE, "50.0 * (ends[1] - ends[0])", "100.0 * (ends[1] - ends[0])"),
        Mutant(_ESTIMATE, "stdtrit(n - 1, 0.975)", "stdtrit(n - 1, 0.95)"),
        Mutant(_ESTIMATE, "y.std(ddof=1)", "y.std()"),
        Mutant(
            _REPETITIONS, "range(max(seeds) + 1, max(seeds) + 1 +", "range(max(seeds), max(seeds) +"
        ),
    ),
)
