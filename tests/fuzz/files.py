"""Studies, journals of sweeps, records, components, checkpoints: where mutated ones start."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path
from random import Random

import numpy as np
from tests.fuzz import hdf5

KINDS = ("study", "journal", "record", "components", "checkpoint")

CASE = """
[[body]]
name = "float"
motion = ["heave"]
mass = 2.0
center_of_gravity = [0.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0]
initial.velocity = [0.0, 0.0, 1.0]

[environment]
gravity = 0.0

[solver]
end_time = 0.5
max_step = 0.05

[output]
step = 0.1
"""
STUDY = """case = "case.toml"
[list]
"body.float.mass" = [2.0, 4.0, 6.0]
"solver.end_time" = [0.5, 0.25, 0.5]
[latin_hypercube]
samples = 2
[latin_hypercube.range]
"solver.rtol" = [1e-6, 1e-5]
[result.way]
channel = "bodies/float/position"
component = "z"
statistic = "last"
"""
RECORDS = {
    "csv": "time [s],elevation [m]\n",
    "txt": "% gauge at 3 m, 20 °C\nTime\tEta\n[s]\t[mm]\n",
    "spectrum.csv": "period [s],density [m2/Hz]\n",
}
#: What a text gets instead of a part of it.
PIECES = (
    b"1e400", b"1" * 400, b"9" * 5000, b"[" * 5000, b"{" * 3000, b"nan", b"-inf", b"\xe9\xff",
    b"\0", b"\xef\xbb\xbf", b"\xff\xfe", b'"', b",", b";", b"\r", b"\t\t", b"null", b"true", b"-0",
    b"1,5", b"2026-02-31T25:61", b"", b"{}", b"[]", b'{"key": 1}',
)  # fmt: skip


def prepare(folder: Path) -> dict[str, Path]:
    """Write a folder for each kind, whose last file in the alphabet is the one to mutate."""
    import hydrodae
    from hydrodae import RunInterrupted

    places = {kind: folder / kind for kind in KINDS}
    for place in places.values():
        place.mkdir()
        (place / "case.toml").write_text(CASE)
    for kind in ("study", "journal"):
        (places[kind] / "study.toml").write_text(STUDY)
    journal = places["journal"]
    hydrodae.sweep(journal / "study.toml", journal / "table.nc", jobs=1)
    (journal / "table.nc").unlink()
    (journal / "table.runs.jsonl").rename(journal / "zz.runs.jsonl")
    time = np.arange(0.0, 30.0, 0.5)
    values = np.exp(-((time - 9.0) ** 2)) + 1e-3
    for name, head in RECORDS.items():
        rows = "\n".join(f"{t + 1.0:.6g},{x:.6g}" for t, x in zip(time, values, strict=True))
        text = head + (rows.replace(",", "\t") if name == "txt" else rows) + "\n"
        (places["record"] / f"zz.{name}").write_text(text, encoding="latin-1")
    head = "omega [rad/s],amplitude [m],phase [rad],heading [deg]\n"
    (places["components"] / "zz.csv").write_text(head + "0.7,0.4,1.3,0\n0.9,0.2,-2.1,15\n")
    try:
        case, output = places["checkpoint"] / "case.toml", places["checkpoint"] / "zz.h5"
        hydrodae.run(case, output, checkpoint=1e9, progress=lambda t, _: t < 0.3)
    except RunInterrupted:
        pass
    return places


def mutated(kind: str, places: dict[str, Path], place: Path, random: Random) -> Path:
    """Copy the files of a kind and mutate one of them; returns it."""
    shutil.copytree(places[kind], place, dirs_exist_ok=True)
    if kind == "checkpoint":
        path = place / "zz.checkpoint.h5"
        hdf5.mutate(path, random)
        return path
    choices = sorted(place.glob("zz.*")) or [place / "study.toml"]
    path = random.choice(choices)
    path.write_bytes(damaged(path.read_bytes(), random))
    return path


def damaged(content: bytes, random: Random) -> bytes:
    """Change some parts of a text."""
    for _ in range(random.choice((1, 1, 2, 4))):
        content = random.choice(_WAYS)(content, random)
    return content


def _place(content: bytes, random: Random) -> tuple[int, int]:
    at = random.randrange(len(content) + 1)
    return at, min(len(content), at + random.choice((0, 1, 3, 8)))


def _replace(content: bytes, random: Random) -> bytes:
    at, end = _place(content, random)
    return content[:at] + random.choice(PIECES) + content[end:]


def _word(content: bytes, random: Random) -> bytes:
    """A whole word, so that what is around it is still understood."""
    words = content.split(b" ") if random.random() < 0.5 else content.split(b",")
    words[random.randrange(len(words))] = random.choice(PIECES)
    return (b" " if random.random() < 0.5 else b",").join(words)


def _flip(content: bytes, random: Random) -> bytes:
    at, _ = _place(content, random)
    changed = bytes(b ^ (1 << random.randrange(8)) for b in content[at : at + 1])
    return content[:at] + changed + content[at + 1 :]


def _cut(content: bytes, random: Random) -> bytes:
    return content[: random.randrange(len(content) + 1)]


def _lines(content: bytes, random: Random) -> bytes:
    """A line twice, or in another place."""
    lines = content.split(b"\n")
    lines.insert(random.randrange(len(lines)), random.choice(lines))
    if random.random() < 0.5:
        lines.pop(random.randrange(len(lines)))
    return b"\n".join(lines)


_WAYS: tuple[Callable[[bytes, Random], bytes], ...] = (_replace, _word, _flip, _cut, _lines)
