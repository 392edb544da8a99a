"""The report of a run."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Iterator
from pathlib import Path

from hydrodae.case import Case
from hydrodae.case.case import parse_assignment
from hydrodae.case.contents import tables_of
from hydrodae.errors import HydrodaeError
from hydrodae.pictures.panels import overview
from hydrodae.pictures.plot import plot_overview
from hydrodae.report import page
from hydrodae.report.scene import parts, rungs, sketch
from hydrodae.report.stage import scene_picture
from hydrodae.results import Results
from hydrodae.results.series import Statistics, statistics
from hydrodae.support.version import version
from hydrodae.viewer import view


def report_of_run(results: Results) -> str:
    """Return the page of a run: outcome, scene, models, checks, figures, versions, hashes."""
    tables = tables_of(results.case_text, str(results.header.get("case_overrides", "")))
    title = results.title or results.path.name
    return page.page(title, filter(None, _sections(results, tables)))


def _sections(results: Results, tables: dict[str, object]) -> Iterator[str]:
    failed = "failed" if results.status != "completed" else ""
    yield page.section(
        "Outcome",
        page.paragraph(
            f"{results.status} at t = {results.end_time:g} s. {results.message}", failed
        ),
        page.text_block(results.summary()),
    )
    yield page.section(
        "Scene",
        *_scene(results, tables),
        page.table(["part", "name", "type", "where"], parts(tables)),
    )
    yield page.section("Models used", page.table(["effect", "model"], rungs(tables)))
    yield page.section("Assumptions and notes", _notes(results))
    yield page.section("Checks", page.text_block(_checks(results)))
    if len(results.time):
        yield page.section("Figures", page.picture(plot_overview(results), "all that moves"))
        yield page.section(f"Statistics {_since(results)}", _statistics(results))
    yield page.section("Solver", page.table([], _solver(results)))
    yield page.section("Versions and hashes", page.table([], _provenance(results)))
    yield page.section("Case file", page.folded("as it was run", results.case_text))


def _scene(results: Results, tables: dict[str, object]) -> Iterator[str]:
    """The scene when the sea has grown; a sketch of the case where its files are not there."""
    try:
        seen = view(results)
    except (HydrodaeError, OSError) as error:
        yield page.picture(sketch(tables), "bodies and joints in the reference pose")
        yield page.paragraph(
            "Reference pose from the side: centres of gravity, joints (squares), lines. "
            f"The scene is not drawn: {str(error).splitlines()[0]}"
        )
        return
    drawn = scene_picture(seen.stage, seen.frame, seen.opening)
    yield page.picture(drawn, "bodies, lines and sea")
    yield page.paragraph(f"The scene at t = {seen.opening:g} s, true to scale, waves too.")


def _notes(results: Results) -> str:
    lines = [
        "Linear potential flow about the mean position, unless said otherwise above; SI units; "
        "z upwards from the still water line.",
        *results.notes,
    ]
    return "<ul>" + "".join(f"<li>{page.escape(line)}</li>" for line in lines) + "</ul>"


def _checks(results: Results) -> str:
    """What `hydrodae check` says, if the case can be read again with the same inputs."""
    from hydrodae import _core

    overrides = str(results.header.get("case_overrides", "")).splitlines()
    values = dict(parse_assignment(line) for line in overrides)
    reason = "its folder is unknown"
    for folder in (Path(str(results.header.get("case_path", ""))).parent, results.path.parent):
        try:
            case = Case.from_text(results.case_text, folder).with_values(values)
            before = str(results.header.get("input_files", ""))
            if not (changed := _core.changed_file(before, case.scene.text_of_files)):
                return case.examine()
            reason = f"the inputs are not those of the run: {changed}"
        except (HydrodaeError, OSError) as error:
            reason = str(error).splitlines()[0]
    return f"not made: {reason}"


def _digest(path: str) -> str:
    return hashlib.sha256(Path(path).read_bytes()).hexdigest()


def _since(results: Results) -> str:
    start = results.settled
    return f"from {start:g} s on" if start else "of the whole run"


def _statistics(results: Results) -> str:
    """Moments and waves of what the overview draws, in its units."""
    rows = []
    start = results.settled
    for panel in overview(results):
        if panel.quantity == "energy":
            continue
        for line in panel.lines:
            kept = line.label.partition(", mean")[0]
            since = min(start, results.end_time)
            s = statistics(
                kept, panel.unit, results.time, line.values, since, results.is_sample(since)
            )
            what = panel.quantity.replace("\n", " ")
            shown = [_with_interval(s, name) for name in ("mean", "std", "min", "max")]
            row = [*shown, s.waves.mean_period, s.waves.significant_height]
            rows.append([what, kept, panel.unit, *row])
    head = ["quantity", "of", "unit", "mean", "std", "least seen", "largest seen"]
    drawn = page.table([*head, "mean period [s]", "significant height"], rows)
    why = _INTERVALS if results.is_sample(start) else results.too_short(start).capitalize()
    return drawn + (page.paragraph(why) if why else "")


_INTERVALS = (
    "In brackets: 95 % intervals of the sea state, of which the run is one sample. Of an extreme: "
    "of its average over records of this length."
)


def _with_interval(s: Statistics, name: str) -> float | str:
    """A number, with its sampling interval where it has one."""
    value = float(getattr(s, name))
    if name not in s.intervals:
        return value
    low, high = s.intervals[name]
    return f"{value:.4g} ({low:.3g} to {high:.3g})"


def _solver(results: Results) -> Iterator[tuple[str, object]]:
    for name, value in sorted(results.statistics.items()):
        if value != "":
            yield name.replace("_", " "), value


def _provenance(results: Results) -> Iterator[tuple[str, str]]:
    header = results.header
    yield "results file", str(results.path)
    yield "its sha256", _digest(str(results.path))
    yield "made by hydrodae", str(header.get("version", ""))
    yield "case file", str(header.get("case_path", ""))
    yield "sha256 of its text", hashlib.sha256(results.case_text.encode()).hexdigest()
    yield "values replaced", str(header.get("case_overrides", "")).strip() or "none"
    yield "sha256 of the database", str(header.get("hydro_sha256", "")) or "none"
    yield "sha256 of all inputs", str(header.get("input_files", "")).strip() or "none"
    yield "report by", f"hydrodae {version()}, Python {platform.python_version()}"
