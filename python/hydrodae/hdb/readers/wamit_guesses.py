"""What of a WAMIT run is taken from its files, from the user, or guessed by what obeys physics."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from hydrodae.errors import DatabaseError
from hydrodae.hdb.database.findings import Finding
from hydrodae.hdb.labels import DOFS
from hydrodae.hdb.readers.rows import FIRST, Rows, to_omega
from hydrodae.hdb.readers.setting import Setting
from hydrodae.hdb.readers.source import LARGEST, SEA_WATER, USUAL_GRAVITY, SourceData, Water
from hydrodae.hdb.readers.wamit_control import WAVELENGTH, Asked, Control
from hydrodae.hdb.relations.causality import causal_line
from hydrodae.hdb.relations.depth import depth_of_bodies
from hydrodae.hdb.relations.dispersion import frequency, group_velocity, wavenumber
from hydrodae.support.arrays import Array

#: Correlation of A with what B implies that is no chance.
CLEAR = 0.98
#: Factors between damping and force of heave within which they agree, and that nothing explains.
NEAR, FAR = 1.4, 2.0
#: Share of the largest |F_3|^2 beyond which waves are long, and fewest values that decide.
LIFTS, ROWS = 0.1, 3
#: Relative distance within which a frequency is one that was asked for, and share of a step.
SAME, QUARTER = 3e-3, 0.25
#: Share of the frequencies of a table that must have been asked for; by chance a half may be.
MOST = 0.8


def settled(
    stem: Path, control: Control, water: Water, findings: list[Finding], *, waves: bool
) -> Setting:
    """Water and length scale; what no file says is asked for or assumed.

    The depth is asked for where there are forces of `waves`: A and B do not need it.
    """
    for what, stated, given, unit in (
        ("density", control.rho, water.density, "kg/m3"),
        ("depth", control.depth, water.depth, "m"),
        ("gravity", control.gravity, water.gravity, "m/s2"),
    ):
        same = stated is None or given is None or stated == given
        if not same and not np.isclose(given, stated, rtol=1e-3):  # type: ignore[arg-type]
            raise DatabaseError(f"its files say {what} {stated:g} {unit}, not {given:g}").about(
                "conflict", what, file=stem
            )
    assumed = []

    def known(given: float | None, stated: float | None, usual: float, text: str) -> float:
        """What is given, else stated, else usual, which the text reports."""
        if given is None and stated is None:
            assumed.append(text)
            return usual
        return float(stated if given is None else given)  # type: ignore[arg-type]

    if control.depth is None and water.depth is None and waves:
        raise DatabaseError(
            f"the water depth is in {stem.name}.pot or .out, in ControlFile.in of HAMS or "
            f"in HydroDyn's input: all are missing; state it (depth=, --depth 70, or --depth inf)"
            f"{_also(stem, control, water)}"
        ).about("missing", "depth", file=stem)
    deep = "infinitely deep water: there are no forces of waves to need it (--depth)"
    density = f"density {SEA_WATER:g} kg/m3, to which A, B and F are proportional (--rho)"
    gravity = f"gravity {USUAL_GRAVITY:g} m/s2 (--gravity)"
    setting = Setting(
        (),
        depth=known(water.depth, control.depth, np.inf, deep),
        rho=known(water.density, control.rho, SEA_WATER, density),
        gravity=known(water.gravity, control.gravity, USUAL_GRAVITY, gravity),
        length=known(None, control.length, 1.0, "length scale (ULEN) 1 m"),
    )
    if assumed:
        text = f"no file says it, taken: {'; '.join(assumed)}"
        findings.append(Finding("warning", "assumption", text))
    return setting


def _also(stem: Path, control: Control, water: Water) -> str:
    """Name what else no file says, so that nothing is asked for one by one."""
    wanted = []
    if not control.points:
        name = control.names[0] if control.names else stem.name
        wanted.append(
            f"about which point moments are (--origin {name}=x,y,z; of several bodies body1=...)"
        )
    taken = [
        f"{what} {usual:g} ({option})"
        for what, known, given, usual, option in (
            ("density", control.rho, water.density, SEA_WATER, "--rho"),
            ("gravity", control.gravity, water.gravity, USUAL_GRAVITY, "--gravity"),
        )
        if known is None and given is None
    ]
    text = f"; nor does a file say {', '.join(wanted)}" if wanted else ""
    return text + (f"; taken unless you state another: {', '.join(taken)}" if taken else "")


def told_depth(deep: SourceData, control: Control, findings: list[Finding]) -> float | None:
    """Depth that damping and force of heave show, else what HydroDyn takes it for; None: neither.

    `deep` holds the tables as if the water were deep.
    """
    told = depth_of_bodies(
        deep.coordinates,
        deep.omega,
        deep.radiation_damping,
        deep.heading,
        deep.excitation,
        deep.rho,
        deep.gravity,
    )
    likely = control.likely_depth
    if likely is not None and (told is None or told.agrees(likely)):
        return likely
    if told is None or not told.decided:
        return None
    said = "no file says the depth" if likely is None else f"HydroDyn takes {likely:g} m"
    best = f"{told.depth:.4g} m" if np.isfinite(told.depth) else f"infinite (over {told.low:.3g} m)"
    text = f"water depth {best}: with that damping and force of heave agree; {said} (--depth)"
    findings.append(Finding("warning", "assumption", text))
    return told.depth


def first_column(
    name: str, radiation: Rows, force: Rows | None, setting: Setting, findings: list[Finding]
) -> int:
    """IPEROUT: what the first column of the tables holds, where no `.cfg` says it.

    The diagonal entries of A and B decide: they belong to each other
    (`hydrodae.hdb.relations.causality`) by one of the four meanings only. Where the tables are too
    short for that, or end before B falls, damping and force of heave decide, which Haskind's
    relation joins at every frequency. Else the tables hold periods, the default of WAMIT.
    """
    options = [replace(setting, first_column=option) for option in FIRST]
    fits = [_fit(radiation, option) for option in options]
    known = max(fits) > CLEAR
    best, law = 0, "A and B"
    if known and fits[0] <= CLEAR:
        best = int(np.argmax(fits))
    if not known or best != 0:  # several wrong ones may look causal; heave decides between them
        heave = _heave(radiation.table, force)
        apart = [_apart(radiation, heave, option) for option in options]
        right = int(np.argmin(apart))
        doubt = np.log(FAR) if best == 0 else apart[right] + np.log(NEAR)
        if apart[right] < np.log(NEAR) and apart[best] > doubt:
            best, law = right, "damping and force of heave"
    option = list(FIRST)[best]
    if best == 0:
        text = f"no {name}.cfg: first column taken as the period (IPEROUT 1)"
        findings.append(Finding("info", "assumption", text))
        return option
    text = (
        f"no {name}.cfg: first column taken as the {FIRST[option]} (IPEROUT {option}), by "
        f"which {law} agree; a line IPEROUT={option} in {name}.cfg confirms it"
    )
    findings.append(Finding("warning", "assumption", text))
    return option


def _heave(rows: Array, force: Rows | None) -> Array:
    """First column, B'_33 and the mean of |F'_3|^2 over the headings of long waves, (m, 3).

    Of all bodies; long are those that lift by much, which they do from all sides alike.
    """
    if force is None:
        return np.zeros((0, 3))
    table = force.table
    lifts = table[(table[:, 0] > 0.0) & (table[:, 2] % 6 == 3) & (np.abs(table[:, 3]) < LARGEST)]
    pairs, place = np.unique(lifts[:, [0, 2]], axis=0, return_inverse=True)
    count = np.bincount(place.ravel(), minlength=len(pairs))
    mean = np.bincount(place.ravel(), lifts[:, 3] ** 2, len(pairs)) / np.maximum(count, 1)
    known = {(first, mode): value for (first, mode), value in zip(pairs, mean, strict=True)}
    own = rows[(rows[:, 1] == rows[:, 2]) & (rows[:, 4] > 0.0) & (rows[:, 4] < LARGEST)]
    found = np.array(
        [[first, b, known[first, i]] for first, i, b in own[:, [0, 1, 4]] if (first, i) in known]
    ).reshape(-1, 3)
    return np.asarray(found[found[:, 2] > LIFTS * found[:, 2].max(initial=0.0)])


def _apart(rows: Rows, heave: Array, setting: Setting) -> float:
    """Typical |log| of the damping of heave over what its force implies, if the column means that.

    B_33 = k / (4 rho g c_g) |F_3|^2; of tables over rho w L^3 and rho g L^2 it is
    B'_33 = k g L |F'_3|^2 / (4 w c_g). Infinite where nothing limits it.
    """
    if len(heave) < ROWS:
        return np.inf
    depth, gravity = setting.depth, setting.gravity
    omega = to_omega(heave[:, 0], setting)
    k, speed = wavenumber(omega, depth, gravity), group_velocity(omega, depth, gravity)
    implied = k * gravity * setting.length * heave[:, 2] / (4.0 * omega * speed)
    return float(np.median(np.abs(np.log(implied / heave[:, 1]))))


def _fit(radiation: Rows, setting: Setting) -> float:
    """Correlation of A with what B implies if the first column means that; 0 if it is another."""
    rows = radiation.table
    omega = to_omega(rows[:, 0], setting)
    usual = np.isfinite(omega) & (omega > 0.0) & (rows[:, 1] == rows[:, 2])
    usual &= (np.abs(rows[:, 3:5]) < LARGEST).all(axis=1)
    grid = np.unique(omega[usual])
    if not grid.size:
        return 0.0
    modes = np.unique(rows[usual, 1])
    tables = np.zeros((2, grid.size, modes.size))
    place = (np.searchsorted(grid, omega[usual]), np.searchsorted(modes, rows[usual, 1]))
    tables[0][place], tables[1][place] = rows[usual, 3], rows[usual, 4] * omega[usual]
    slope, correlation = causal_line(grid, *tables)
    right = np.abs(np.log(np.maximum(slope, 1e-9))) < np.log(1.25)
    return float(np.median(np.where(right, correlation, 0.0))) if slope.size else 0.0


def asked_findings(
    asked: Asked | None,
    radiation: Rows,
    omega: Array,
    modes: Array,
    names: list[str],
    setting: Setting,
    starts: Array,
) -> list[Finding]:
    """Compare frequencies (nw,) and modes (n,) of A and B with those of a control file: errors.

    `starts` are the modes before those of each body.
    """
    if asked is None:
        return []
    found, table = [], radiation.path.name
    kinds = list(FIRST) if asked.kind is None else [asked.kind]
    grids = [_omega(asked, kind, radiation, setting) for kind in kinds]
    if omega.size and all(g.size for g in grids) and not any(_within(omega, g) for g in grids):
        grid = grids[kinds.index(2)] if 2 in kinds else grids[0]
        text = (
            f"{asked.where.name} asks for {grid[0]:.4g}..{grid[-1]:.4g} rad/s; the first column of "
            f"{table}, read as the {FIRST[setting.first_column]}, holds {omega[0]:.4g}.."
            f"{omega[-1]:.4g} rad/s: another unit, or files of different runs"
        )
        found.append(Finding("error", "frequencies asked for", text))
    lost = [
        f"{name}.{DOFS[mode - 1]}"
        for i, (name, wanted) in enumerate(zip(names, asked.modes, strict=False))
        if np.any((modes > starts[i]) & (modes <= starts[i + 1]))
        for mode in wanted
        if starts[i] + mode not in modes
    ]
    if lost:
        text = (
            f"{asked.where.name} asks for {', '.join(lost)}, of which {table} holds "
            f"nothing: rows are missing"
        )
        found.append(Finding("error", "motions asked for", text))
    return found


def _omega(asked: Asked, kind: int, rows: Rows, setting: Setting) -> Array:
    """Frequencies that were asked for [rad/s], ascending; those of 0 and infinity left out."""
    values = asked.values[asked.values > 0.0]
    if kind == WAVELENGTH:
        found = np.asarray(frequency(2.0 * np.pi / values, setting.depth, setting.gravity))
    elif kind in FIRST:
        found = to_omega(values, replace(setting, first_column=kind))
    else:
        return np.zeros(0)
    return np.unique(found)


def _within(omega: Array, grid: Array) -> bool:
    """Return whether most frequencies were asked for."""
    at = np.abs(omega[:, None] - grid).argmin(axis=1)
    step = np.gradient(grid)[at] if grid.size > 1 else np.full(at.size, np.inf)
    near = np.abs(omega - grid[at]) < np.minimum(SAME * omega, QUARTER * step)
    return bool(np.mean(near) > MOST)
