"""What a command does, a function does: the same results through `import hydrodae`."""

from __future__ import annotations

import json
import re
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.errors import refused, wrong

import hydrodae
from hydrodae.commands.cli import main

CAPTURE = pytest.CaptureFixture[str]


@pytest.fixture
def rao_case(repository: Path) -> Path:
    return repository / "cases" / "f3of" / "rao.toml"


@pytest.fixture
def sphere(repository: Path) -> Path:
    return repository / "cases" / "sphere" / "hydro.h5"


def said(capsys: CAPTURE, *words: object, code: int = 0) -> str:
    """What a command prints."""
    capsys.readouterr()
    assert main([str(word) for word in words]) == code
    return capsys.readouterr().out


def test_all_names_are_there() -> None:
    for module in (hydrodae, hydrodae.hdb):
        assert set(module.__all__) <= set(dir(module))
        for name in module.__all__:
            value = getattr(module, name)
            assert value.__doc__, name
    with pytest.raises(AttributeError, match="no attribute 'roa'"):
        _ = hydrodae.roa  # type: ignore[attr-defined]


def test_a_run_imports_no_study_and_no_database() -> None:
    """Nor do the processes of a sweep import what they have no use for: it takes a second each."""
    text = (
        "import sys, hydrodae; hydrodae.run\n"
        "print(sorted(m for m in sys.modules if 'hydrodae.' in m))\n"
        "import hydrodae.study.sweep.pool\n"
        "slow = {'matplotlib', 'scipy.stats', 'xarray'} & set(sys.modules)\n"
        "assert not slow, slow"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert "hydrodae.simulation.simulate" in done.stdout
    assert "hydrodae.hdb" not in done.stdout
    assert "hydrodae.study" not in done.stdout


def test_documented_modules_are_there_after_importing_the_package(repository: Path) -> None:
    """`import hydrodae` is enough for these, and for every `hydrodae.NAME` of the documentation."""
    text = "".join(page.read_text() for page in (repository / "docs").glob("*.md"))
    named = set(re.findall(r"hydrodae\.([a-z]\w+)\.\w+\(", text))
    assert {"fmu", "control"} <= named
    uses = "import hydrodae\n" + "\n".join(f"hydrodae.{name}" for name in sorted(named))
    uses += """
hydrodae.arrays.place, hydrodae.case.Case, hydrodae.control.match, hydrodae.errors.CaseError
hydrodae.fmu.export, hydrodae.frequency.LinearModel, hydrodae.hdb.read, hydrodae.mooring.linearise
hydrodae.plot.plot_overview, hydrodae.report.report, hydrodae.results.Results
hydrodae.schema.case_schema, hydrodae.starters.create, hydrodae.tables.tables, hydrodae.tcp
from hydrodae import arrays, frequency, plot, schema, tables, tcp
assert callable(hydrodae.run) and callable(hydrodae.hdb.fit) and callable(hydrodae.hdb.kernel)
"""
    subprocess.run([sys.executable, "-c", uses], check=True)


def test_check(rao_case: Path, capsys: CAPTURE) -> None:
    told = said(capsys, "check", rao_case, "--set", "solver.rtol=1e-5")
    assert hydrodae.check(rao_case, set={"solver.rtol": 1e-5}) == told
    assert hydrodae.check(hydrodae.Case.read(rao_case)) == hydrodae.Case.read(rao_case).examine()
    with pytest.raises(hydrodae.CaseError, match="no such case file"):
        hydrodae.check("nothing.toml")


def test_equilibrium(rao_case: Path, capsys: CAPTURE) -> None:
    found = hydrodae.equilibrium(rao_case)
    assert str(found) + "\n" == said(capsys, "equilibrium", rao_case)
    assert set(found.offsets) == set(found.rotations)
    assert {v.shape for v in (*found.offsets.values(), *found.rotations.values())} == {(3,)}
    heavier = hydrodae.equilibrium(rao_case, set={"body.flap1.mass": 190000.0})
    name = "joints/hinge1/reaction_force.y"
    assert abs(heavier.reactions[name] - found.reactions[name]) > 1e4  # N
    assert heavier.offsets["flap1"][2] < found.offsets["flap1"][2] < 0.0


def test_rao(rao_case: Path, tmp_path: Path, capsys: CAPTURE) -> None:
    table = tmp_path / "by_command.csv"
    told = said(capsys, "rao", rao_case, "--periods", "14,11", "--heading", "0", "-o", table)
    found = hydrodae.rao(rao_case, periods=[14.0, 11.0])
    assert str(found) + "\n" == re.sub(r"written: .*\n", "", told)
    np.testing.assert_allclose(2 * np.pi / found.chosen.omega, [14.0, 11.0])
    assert found.write(tmp_path / "by_function.csv").read_text() == table.read_text()
    assert found.modes[0].period > found.modes[-1].period
    with wrong("periods"):
        hydrodae.rao(rao_case, periods=[0.0])
    with refused("range", "frequencies"):
        hydrodae.rao(rao_case, periods=[1.0])


def test_rao_in_the_sea_of_a_case(repository: Path, capsys: CAPTURE) -> None:
    case = repository / "cases" / "f3of" / "waves.toml"
    found = hydrodae.rao(case)
    assert str(found) + "\n" == said(capsys, "rao", case)
    deviation, power = found.in_sea()
    assert deviation["sea/elevation"] == pytest.approx(0.25, rel=0.02)  # Hs is 1 m
    assert min(power.values()) > 0.0
    assert found.draw().axes


def test_ladder_and_sensitivity(repository: Path, capsys: CAPTURE) -> None:
    case = repository / "cases" / "sphere" / "decay.toml"
    rungs = hydrodae.ladder(case, repeat=1, set={"solver.end_time": 2.0}).rungs
    told = said(capsys, "ladder", case, "--repeat", "1", "--set", "solver.end_time=2")
    for rung in rungs:
        (line,) = (line for line in told.splitlines() if line.startswith(f"{rung.name} "))
        assert f" {rung.steps} " in line
    rows = hydrodae.sensitivity(case, "period")
    told = said(capsys, "hdb", "sensitivity", case, "--result", "period")
    for row in rows:
        assert re.search(rf"{re.escape(row.variant)} +{re.escape(f'{row.value:.6g}')} ", told)


def test_chart_and_recommend(repository: Path, tmp_path: Path, capsys: CAPTURE) -> None:
    case = repository / "cases" / "benchmarks" / "simple_pendulum.toml"
    few: dict[str, Any] = {"methods": ["radau"], "tolerances": [1e-3, 1e-6], "repeat": 1}
    few["set"] = {"solver.end_time": 1.0}
    words: tuple[object, ...] = ("--methods", "radau", "--tolerances", "1e-3,1e-6", "--repeat", 1)
    words = (*words, "--set", "solver.end_time=1")
    said(capsys, "chart", case, *words, "-o", tmp_path / "made")
    runs = json.loads((tmp_path / "made.json").read_text())["runs"]
    made = hydrodae.chart(case, **few)
    for key in ("method", "setting", "outcome", "error"):
        assert [getattr(run, key) for run in made.runs] == [run[key] for run in runs]
    told = said(capsys, "recommend", case, "--error", "1e-2", *words)
    assert hydrodae.recommend(case, 1e-2, **few).run.method == "radau"
    assert 'method = "radau"' in told


def test_hdb_read_check_and_write(sphere: Path, tmp_path: Path, capsys: CAPTURE) -> None:
    database = hydrodae.hdb.read(sphere)
    report = hydrodae.hdb.check(database)
    told = said(capsys, "hdb", "show", sphere, "--check")
    assert told == f"{database.summary()}\n{report}\n"
    hydrodae.hdb.write(database, tmp_path / "copy.h5")
    again = hydrodae.hdb.read(tmp_path / "copy.h5")
    np.testing.assert_array_equal(again.added_mass, database.added_mass)
    examined = said(capsys, "hdb", "doctor", sphere, "--no-report")
    assert examined == f"{database.summary()}\n\n{hydrodae.hdb.examination(report)}\n"


def test_hdb_import(sphere_file: Path, tmp_path: Path, capsys: CAPTURE) -> None:
    source, out = sphere_file, tmp_path / "hydro.h5"
    words = ("-o", out, "--bodies", "buoy", "--cog", "buoy=0,0,-1.5", "--keep", "buoy.planar")
    told = said(capsys, "hdb", "import", source, *words)
    database, report = hydrodae.hdb.import_database(
        source, names=["buoy"], reference_points={"buoy": (0.0, 0.0, -1.5)}, keep="buoy.planar"
    )
    assert told.startswith(f"{database.summary()}\n{report}\n")
    same(hydrodae.hdb.read(out), database)


def test_hdb_fit_and_kernel(sphere: Path, tmp_path: Path, capsys: CAPTURE) -> None:
    case = sphere.parent / "decay.toml"
    database = hydrodae.hdb.read(sphere)
    (body,) = database.bodies
    fitted, out = tmp_path / "fitted.h5", tmp_path / "kernel.h5"
    told = said(capsys, "hdb", "fit", sphere, f"mine={body}.heave", "--case", case, "-o", fitted)
    band = hydrodae.working_band(case, database)
    assert f"band {band[0]:.3g} to {band[1]:.3g} rad/s" in told
    before = dict(database.memory)
    mine = hydrodae.hdb.fit(database, f"{body}.heave", name="mine", band=band)
    assert dict(database.memory) == before
    by_command = hydrodae.hdb.read(fitted).memory["mine"]
    np.testing.assert_array_equal(by_command.poles, mine.memory["mine"].poles)
    np.testing.assert_array_equal(by_command.added_mass_inf, mine.memory["mine"].added_mass_inf)
    said(capsys, "hdb", "kernel", sphere, f"{body}.heave", "--length", "12", "-o", out)
    stored = hydrodae.hdb.kernel(database, [f"{body}.heave"], length=12.0).kernel
    by_command_kernel = hydrodae.hdb.read(out).kernel
    assert stored is not None
    assert by_command_kernel is not None
    np.testing.assert_allclose(by_command_kernel.values, stored.values, rtol=1e-6)  # single
    with wrong("name"):
        hydrodae.hdb.fit(database, f"{body}.heave", name="a b")
    with wrong("target"):
        hydrodae.hdb.fit(database, f"{body}.heave", target=-1.0)
    with refused("label", f"{body}.heaf"):
        hydrodae.hdb.kernel(database, f"{body}.heaf")


def test_hdb_repair_compare_and_export(sphere: Path, tmp_path: Path, capsys: CAPTURE) -> None:
    database, out = hydrodae.hdb.read(sphere), tmp_path / "longer.h5"
    said(capsys, "hdb", "doctor", sphere, "--no-report", "--repair", "tail", "-o", out)
    repaired = hydrodae.hdb.repair(database, ["tail"])
    same(hydrodae.hdb.read(out), repaired)
    assert hydrodae.hdb.draw_report(repaired, hydrodae.hdb.check(repaired)).subfigs
    told = said(capsys, "hdb", "compare", out, sphere)
    for difference in hydrodae.hdb.compare(repaired, database):
        assert str(difference) in told
    told = said(capsys, "hdb", "compare", sphere)
    for text, _, _ in hydrodae.hdb.grid_sensitivity(database):
        assert text in told
    said(capsys, "hdb", "export", sphere, "-o", tmp_path / "a.nc")
    hydrodae.hdb.export(database, tmp_path / "b.nc")
    same(hydrodae.hdb.read(tmp_path / "a.nc"), hydrodae.hdb.read(tmp_path / "b.nc"))
    with pytest.raises(hydrodae.CaseError, match=r"ends in \.h5"):
        hydrodae.hdb.export(database, tmp_path / "b.txt")


def test_hdb_compute(tmp_path: Path) -> None:
    pytest.importorskip("capytaine", reason="needs the extra bem")
    from hydrodae.hdb.bem import cutting, run, shapes

    out, point = tmp_path / "hydro.h5", np.array([0.0, 0.0, -2.0])
    words = ["--body", "buoy=sphere:radius=5", "--cog", "buoy=0,0,-2", "--omega", "0.4,1.6,4"]
    words += ["--panel", "1.2", "-o", str(out), "--work", str(tmp_path), "-q"]
    assert main(["hdb", "compute", *words]) == 0
    panels = cutting.immersed(shapes.build("sphere", 1.2, {"radius": 5.0}))
    database, _ = hydrodae.hdb.compute(
        [run.WettedBody("buoy", panels, point)],
        run.Settings(omega=np.linspace(0.4, 1.6, 4)),
        tmp_path,
    )
    same(hydrodae.hdb.read(out), database)


def same(a: hydrodae.hdb.HydroDatabase, b: hydrodae.hdb.HydroDatabase) -> None:
    assert a.coordinates == b.coordinates
    assert a.repairs == b.repairs
    for name in ("omega", "added_mass", "radiation_damping", "added_mass_inf", "excitation"):
        np.testing.assert_array_equal(getattr(a, name), getattr(b, name))


def test_the_examples_of_the_description_run(repository: Path, tmp_path: Path) -> None:
    text = (repository / "docs" / "python.md").read_text()
    blocks = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    assert blocks
    named = set(re.findall(r"`hydrodae\.(?:hdb\.)?(\w+)\(", text))
    assert named <= {*hydrodae.__all__, *hydrodae.hdb.__all__}
    script = "\n".join(blocks).replace('"hydro_fitted.h5"', repr(str(tmp_path / "hydro.h5")))
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=repository, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_libraries_of_a_wheel_go_along_in_an_fmu(
    repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In one folder. The kernel has a name of its own there, which both files give."""
    from hydrodae import _core

    kernel = f"libhydrodae-{_core.version}.so"
    files = ["hydrodae/lib/hydrodae_fmu.so", f"hydrodae/{kernel}", "hydrodae.libs/libx-1.so"]
    for name in files:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(f"{Path(name).parent} {kernel} end")
    monkeypatch.setattr(_core, "__file__", str(tmp_path / "hydrodae" / "_core.so"))
    made = hydrodae.fmu.export(repository / "cases" / "sphere" / "wave.toml", tmp_path / "a.fmu")
    with zipfile.ZipFile(made) as archive:
        binaries = [name for name in archive.namelist() if name.startswith("binaries/")]
        texts = [archive.read(name).decode() for name in binaries]
    assert len({Path(name).parent for name in binaries}) == 1
    library, own, other = (Path(name).name for name in binaries)
    assert (library, other) == ("a.so", "libx-1.so")
    assert own != kernel
    assert len(own) == len(kernel)
    assert texts == [
        f"hydrodae/lib {own} end",
        f"hydrodae {own} end",
        f"hydrodae.libs {kernel} end",
    ]
