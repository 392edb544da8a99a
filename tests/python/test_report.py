"""Reports: one page that holds all, of runs and of sweeps."""

from __future__ import annotations

import hashlib
import re
from html.parser import HTMLParser
from pathlib import Path

import numpy as np
import pytest

import hydrodae
from hydrodae.case.contents import tables_of
from hydrodae.commands import cli
from hydrodae.report import report
from hydrodae.report.run import report_of_run
from hydrodae.report.scene import parts, rungs
from hydrodae.results import Results, ResultsError
from hydrodae.starters import create


class Page(HTMLParser):
    """Collects the rows of tables and all places that a page refers to; notes bad nesting."""

    EMPTY = ("meta", "img", "link", "br")

    def __init__(self, text: str) -> None:
        super().__init__()
        self.rows: list[list[str]] = []
        self.sources: list[str] = []
        self.open: list[str] = []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.sources += [str(value) for name, value in attrs if name in ("src", "href")]
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] in ("td", "th"):
            self.rows[-1][-1] += data


@pytest.fixture(scope="module")
def flap(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run of the flap, beside its case."""
    folder = tmp_path_factory.mktemp("report") / "flap"
    case = create("flap", folder)
    values = {"solver.end_time": 240.0, "wave.sea.significant_height": 2.25}
    hydrodae.run(case, folder / "case.h5", set=values)
    return folder


def test_a_report_replaces_nothing_but_pages(flap: Path) -> None:
    before = (flap / "case.h5").read_bytes()
    with pytest.raises(ResultsError, match=r"case.h5: a report needs a name that ends in .html"):
        report(flap / "case.h5", flap / "case.h5")
    assert (flap / "case.h5").read_bytes() == before


def test_report_of_a_run_holds_all_and_needs_no_other_file(flap: Path) -> None:
    results = Results.read(flap / "case.h5")
    path = report(flap / "case.h5")
    assert path == flap / "case_report.html"
    text = path.read_text()
    page = Page(text)
    assert all(place.startswith("data:image/") for place in page.sources)
    assert len(page.sources) == 2
    for heading in ("Outcome", "Scene", "Models used", "Checks", "Figures", "Versions and hashes"):
        assert f"<h2>{heading}</h2>" in text
    rows = {row[0]: row[1:] for row in page.rows if row}
    assert rows["radiation"] == ["exponential"]
    assert rows["sha256 of the database"] == [
        hashlib.sha256((flap / "hydro.h5").read_bytes()).hexdigest()
    ]
    assert rows["its sha256"] == [hashlib.sha256((flap / "case.h5").read_bytes()).hexdigest()]
    assert rows["absorbed power"][:2] == ["pto", "MW"]
    power = results.statistics["mean_power_absorbed"] / 1e6
    mean, _, interval = rows["absorbed power"][2].partition(" ")
    assert float(mean) == pytest.approx(power, rel=0.05)
    assert " to " in interval
    assert "mobility: 1 " in text
    assert any(row[-1] == "Hs 2.25 m, Tp 9 s" for row in page.rows)  # as it was run
    assert "wave.sea.significant_height = 2.25" in text


def test_checks_are_not_made_with_another_database(flap: Path, tmp_path: Path) -> None:
    moved = tmp_path / "moved.h5"
    moved.write_bytes((flap / "case.h5").read_bytes())
    (flap / "hydro.h5").rename(flap / "away.h5")
    try:
        text = report(moved).read_text()
    finally:
        (flap / "away.h5").rename(flap / "hydro.h5")
    assert re.search("not made: .*hydro.h5", text)


def test_names_are_no_markup(results_writer, tmp_path: Path) -> None:
    time = np.linspace(0.0, 10.0, 101)
    case = 'title = "<b>x</b>"\n[[body]]\nname = "<i>"\nmass = 1.0\ncenter_of_gravity = [0, 0, 0]\n'
    path = results_writer(time, title="<b>x</b>", case_text=case, status="failed", message="<u>")
    text = report(path, tmp_path / "r.html").read_text()
    assert "<b>" not in text
    assert "<i>" not in text
    assert "&lt;u&gt;" in text


def test_report_of_a_sweep(flap: Path, capsys: pytest.CaptureFixture[str]) -> None:
    study = flap / "power_matrix.toml"
    study.write_text(
        'case = "case.toml"\n[grid]\n"wave.sea.significant_height" = [1.0, -1.0]\n'
        '"wave.sea.peak_period" = [7.0, 9.0]\n'
    )
    wrong = flap / "wrong.nc"
    wrong.write_text("no netCDF")
    with pytest.raises(ResultsError, match=r"wrong\.nc"):
        report(wrong)
    values = {"solver.end_time": 40.0}
    hydrodae.sweep(study, flap / "power_matrix.nc", set=values, jobs=1)
    assert cli.main(["report", str(flap / "power_matrix.nc")]) == 0
    path = Path(capsys.readouterr().out.strip())
    page = Page(path.read_text())
    rows = [row for row in page.rows if row]
    failed = [row for row in rows if row[1] == "refused"]
    assert len(failed) == 2
    assert "must be" in failed[0][2]
    assert any(row[0] == "mean_power_absorbed" for row in rows)
    assert any(place.startswith("data:image/svg") for place in page.sources)


def test_models_that_a_case_uses() -> None:
    tables = tables_of(
        '[[body]]\nname = "a"\nmotion = "heave"\n[[force]]\nname = "p"\ntype = "pto_linear"\n'
        '[hydro]\ndatabase = "x"\nradiation = "none"\n',
        'hydro.radiation = "convolution"\nforce.p.type = "pto_hydraulic"\nsolver.method = "ida"\n',
    )
    told = dict(rungs(tables))
    assert told["radiation"] == "convolution"
    assert told["power take-offs"] == "pto_hydraulic"
    assert told["waves"] == "still water"
    assert told["motion"] == "time domain, method ida"


def test_forces_that_are_new_count_by_how_their_type_begins() -> None:
    told = dict(rungs({"force": [{"type": "pto_new"}, {"type": "friction_new"}]}))
    assert (told["power take-offs"], told["friction"]) == ("pto_new", "friction_new")
    assert told["moorings and ropes"] == "none"


def test_the_scene_is_drawn_when_the_sea_has_grown(flap: Path) -> None:
    """A mass by a word is one of the parts."""
    text = report_of_run(Results.read(flap / "case.h5"))
    ramp = tables_of((flap / "case.toml").read_text())["sea"]["ramp"]
    assert f"The scene at t = {ramp:g} s" in text
    body = {"name": "float", "mass": "equilibrium", "center_of_gravity": [0.0, 0.0, -1.0]}
    assert next(parts({"body": [body]}))[3] == "mass equilibrium at 0, 0, -1 m"
