"""Tables of far-field drift in databases, what judges them, and mean offsets."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.errors import refused
from tests.scenes import table
from tests.verification.cylinder_scenes import OMEGA, database, float_of, guide, mooring, written

import hydrodae
from hydrodae.case import Case
from hydrodae.commands.cli import main
from hydrodae.errors import CaseError
from hydrodae.hdb.checks.drift import drift_findings
from hydrodae.hdb.database import HydroDatabase
from hydrodae.linear import LinearModel
from hydrodae.study.drift import mean_offset
from hydrodae.study.drift.table import scene_digest, write_database

PLACE = (0.0, 0.0)
DAMPED = float_of("buoy", PLACE, ["heave"]) + guide("buoy", PLACE, 3000.0)
STIFFNESS = 900.0
PERIOD, HEIGHT = 3.0, 0.4
WAVE = table("wave", name="swell", type="regular", period=PERIOD, height=HEIGHT)
FLOAT = float_of("buoy", PLACE, ["surge", "heave"])


@pytest.fixture(scope="module")
def water() -> HydroDatabase:
    """One cylinder, two headings."""
    return database({"buoy": PLACE}, (0.0, 0.6))


@pytest.fixture
def case_file(tmp_path: Path, water: HydroDatabase) -> Path:
    path = tmp_path / "case.toml"
    path.write_text(written(tmp_path, water, DAMPED).text)
    return path


def test_the_command_writes_a_table(
    case_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    target, lines = tmp_path / "with_drift.h5", tmp_path / "drift.csv"
    call = ["drift", str(case_file), "--pairs", "-o", str(target), "-o", str(lines), "--json"]
    assert main(call) == 0
    told = json.loads(capsys.readouterr().out)
    stored = HydroDatabase.read(target).second_order["mean"]
    found = hydrodae.drift(case_file, pairs=True)
    assert stored.values == pytest.approx(found.load, rel=1e-12)
    assert (stored.coordinates, set(stored.method)) == (
        ("buoy.surge", "buoy.sway", "buoy.yaw"),
        {"momentum"},
    )
    mate, there = stored.mate()
    assert there.all()
    assert mate == pytest.approx(stored.values, abs=1e-9 * np.abs(stored.values).max())
    assert f"scene {scene_digest(Case.read(case_file))}" in stored.source
    assert "pto_buoy c=3000" in stored.source
    assert np.array(told["along"]) == pytest.approx(found.along)
    rows = np.genfromtxt(lines, delimiter=",", skip_header=1)
    assert rows.shape[0] == found.omega.size * len(found.pairs)
    assert rows[0, 3] == pytest.approx(found.load[0, 0, 0].real)
    findings = drift_findings(HydroDatabase.read(target))
    assert {finding.severity for finding in findings} == {"info"}
    with pytest.raises(CaseError, match="name another file"):
        write_database(tmp_path / "hydro.h5", found, LinearModel(case_file))


@pytest.mark.parametrize(("part", "severity"), [(1e-12, "info"), (0.01, "error")])
def test_a_yaw_of_rounding_is_no_fault(
    part: float, severity: str, case_file: Path, tmp_path: Path
) -> None:
    """An imaginary yaw, the only moment of the table, of this part of the largest force x 1/k."""
    target = tmp_path / "with_drift.h5"
    write_database(target, hydrodae.drift(case_file), LinearModel(case_file))
    found = HydroDatabase.read(target)
    stored = found.second_order["mean"]
    values = stored.values.copy()
    lever = 9.81 / stored.omega.max() ** 2
    values[..., 2] = 1j * part * np.abs(values[..., :2]).max() * lever
    changed = found.with_second_order({"mean": replace(stored, values=values)})
    assert severity in {finding.severity for finding in drift_findings(changed)}
    assert ("error" in {f.severity for f in drift_findings(changed)}) == (severity == "error")


def test_the_digest_is_of_what_moves(case_file: Path) -> None:
    case = Case.read(case_file)
    own = scene_digest(case)
    same = {"solver.end_time": 20.0, "hydro.database": "hydro.h5", "output.step": 0.2}
    assert scene_digest(case.with_values(same)) == own
    assert scene_digest(case.with_values({"force.pto_buoy.damping": 3001.0})) != own


def test_check_knows_a_table_without_power(
    case_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Its own table is right; that of the undamped device is warned of with the remedy."""
    base = ["drift", str(case_file), "-o"]
    assert main([*base, str(tmp_path / "own.h5")]) == 0
    undamped = ["--set", "force.pto_buoy.damping=0"]
    assert main([*base, str(tmp_path / "free.h5"), *undamped]) == 0
    capsys.readouterr()
    said = {}
    for name in ("own", "free", "hydro"):
        assert main(["check", str(case_file), "--set", f"hydro.database={name}.h5"]) == 0
        said[name] = capsys.readouterr().out
    assert "that of this device" in said["own"]
    assert "look at: mean drift" in said["free"]
    assert "without its power take-offs" in said["free"]
    assert "hydrodae drift" in said["free"]
    assert "drift" not in said["hydro"]


def test_rao_prints_drift_beside_motions(
    case_file: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "rao.csv"
    call = ["rao", str(case_file), "--periods", "2.5,4", "--drift", "-o", str(file)]
    assert main(call) == 0
    out = capsys.readouterr().out
    omega = 2.0 * np.pi / np.array([4.0, 2.5])
    found = hydrodae.drift(case_file, omega=omega, headings=[0.0])
    (row,) = [line for line in out.splitlines() if line.startswith("  drift surge")]
    assert [float(word) for word in row.split()[-2:]] == pytest.approx(
        1e-3 * found.load[::-1, 0, 0].real, rel=1e-3
    )
    head, *rows = file.read_text().splitlines()
    column = head.split(",").index("drift surge [N/m2]")
    values = [float(row.split(",")[column]) for row in rows]
    assert values == pytest.approx(found.load[::-1, 0, 0].real, rel=1e-8)


def test_offset_of_a_linear_mooring(tmp_path: Path, water: HydroDatabase) -> None:
    """F a^2 / K at once; a second iteration changes nothing."""
    case = written(tmp_path, water, FLOAT, mooring("buoy", STIFFNESS), WAVE)
    found = mean_offset(case)
    drift = hydrodae.drift(case, omega=[2.0 * np.pi / PERIOD], headings=[0.0])
    load = drift.load[0, 0, 0].real * (0.5 * HEIGHT) ** 2
    assert found.load[0] == pytest.approx(load, rel=1e-9)
    assert found.offset[0] == pytest.approx(load / STIFFNESS, rel=1e-6)
    assert len(found.steps) == 2


def test_offset_where_the_mooring_stiffens(tmp_path: Path, water: HydroDatabase) -> None:
    """A slack catenary: the drift found belongs to the stiffness at the offset found."""
    line = table(
        "force", name="bow", type="catenary", body_a="ground", point_a=[-18.0, 0.0, -6.0],
        body_b="buoy", point_b=[-1.0, 0.0, -0.9], length=[18.1], weight=[60.0], stiffness=[1e6],
    )  # fmt: skip
    stern = mooring("buoy", 20.0)
    wave = table("wave", name="swell", type="regular", period=2.6, height=0.6)
    case = written(tmp_path, water, FLOAT, line, stern, wave)
    found = mean_offset(case)
    assert 2 < len(found.steps) < 30
    assert abs(found.steps[-1] - found.steps[-2]) < 1e-3 * found.steps[-1]
    fixed = table("force", name="push", type="constant_load", body="buoy",
                  force=[float(found.load[0]), 0.0, 0.0])  # fmt: skip
    there = written(tmp_path, water, FLOAT, line, stern, fixed, wave)
    held = hydrodae.equilibrium(there)
    assert held.offsets["buoy"] == pytest.approx(found.held["buoy"], abs=1e-6)
    drift = hydrodae.drift(there, omega=[2.0 * np.pi / 2.6], headings=[0.0])
    assert drift.load[0, 0, 0].real * 0.09 == pytest.approx(found.load[0], rel=5e-3)


def test_what_cannot_be_is_refused(tmp_path: Path, water: HydroDatabase) -> None:
    case = written(tmp_path, water, DAMPED)
    with refused("range", "headings"):
        hydrodae.drift(case, headings=[0.3])
    with refused("range", "frequencies"):
        hydrodae.drift(case, omega=[0.2])
    bare = written(tmp_path, replace(water, extra={}), DAMPED, file="bare.h5")
    with refused("missing", "kochin_diffraction"):
        hydrodae.drift(bare)
    # moments of surge about another point are not those of the functions
    moved = water.moved_to({"buoy": (0.0, 0.0, -3.0)})
    rolling = float_of("buoy", PLACE, ["surge", "heave", "pitch"]).replace("-0.4", "-3.0")
    with refused("conflict", "kochin"):
        hydrodae.drift(written(tmp_path, moved, rolling, file="moved.h5"), omega=OMEGA)
    with pytest.raises(CaseError, match="wave"):
        mean_offset(case)
