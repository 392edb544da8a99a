"""Picture of a database: A, B, |F|, phase, K(t) and what breaks causality, body by body."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from hydrodae.hdb.checks.energy import energy_identity
from hydrodae.hdb.checks.irregular import bands, ogilvie_residual, suspect_rows
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.database.findings import CheckReport
from hydrodae.hdb.database.kernels import diagonal_kernels, envelope_length
from hydrodae.hdb.database.scales import scaled_damping_eigenvalues, scales
from hydrodae.hdb.labels import Label, rigid
from hydrodae.hdb.relations import tails
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array
from hydrodae.support.style import COLORS, STYLE

if TYPE_CHECKING:
    from matplotlib.axes import Axes

UNITS = {"A": ("kg", "kg m2"), "B": ("N s/m", "N m s"), "F": ("N/m", "N m/m"), "K": ("N/m", "N m")}
SUSPECT, FIT = "#F6D5D5", "black"


@matplotlib.rc_context(STYLE)
def draw_report(database: HydroDatabase, report: CheckReport) -> Figure:
    """Draw a database with the errors and warnings above it.

    Parameters
    ----------
    database : HydroDatabase
    report : CheckReport
        What `hydrodae.hdb.check` (and the reader) found.

    Returns
    -------
    matplotlib.figure.Figure
        Six panels a body, of its rigid motions; every line over its own largest value, which the
        legend shows. Fits of the memory are dashed; suspect frequencies are shaded.
    """
    labels = rigid(database.coordinates)
    database = database.select(labels) if labels else database
    head = _head(database, report)
    bodies = list(database.bodies) if labels else []
    count = len(bodies)
    heights = [0.145 * (head.count("\n") + 2), *([5.6] * count)]
    figure = Figure(figsize=(13.0, sum(heights)), layout="constrained")
    blocks = figure.subfigures(count + 1, 1, height_ratios=heights, squeeze=False)[:, 0]
    blocks[0].text(0.01, 0.98, head, va="top", family="monospace", fontsize=8)
    shaded = bands(database.omega, suspect_rows(database))
    for block, body in zip(blocks[1:], bodies, strict=True):
        block.suptitle(f"body {body}", x=0.01, ha="left", fontweight="bold", fontsize=11)
        axes = block.subplots(2, 3)
        _draw_body(axes, database, body)
        for ax in (*axes[0], axes[1, 0], axes[1, 2]):
            for low, high in shaded:
                ax.axvspan(low, high, color=SUSPECT, zorder=0)
    return figure


def _head(db: HydroDatabase, report: CheckReport) -> str:
    serious = [*report.of("error"), *report.of("warning")]
    lines = db.summary().splitlines()[:6]
    lines.append(f"checks: {len(report.of('error'))} errors, {len(report.of('warning'))} warnings")
    for finding in serious:
        lines += textwrap.wrap(str(finding), 185, subsequent_indent=" " * 8)
    return "\n".join(lines)


def _draw_body(axes: NDArray[np.object_], db: HydroDatabase, body: str) -> None:
    rows = [i for i, label in enumerate(db.labels) if label.body == body]
    active = scales(db) > 0.0
    radiating = [i for i in rows if active[i]]
    w = db.omega
    here = {db.coordinates[i] for i in rows}
    fit = next((f for f in db.memory.values() if here & set(f.inputs)), None)
    for i in radiating:
        label = db.coordinates[i]
        color = COLORS[Label.read(label).dof]
        a, b = db.added_mass[:, i, i], db.radiation_damping[:, i, i]
        top_a, top_b = np.abs(a).max(), np.abs(b).max()
        _line(axes[0, 0], w, a / top_a, label, top_a, "A")
        axes[0, 0].plot(w[-1], db.added_mass_inf[i, i] / top_a, ">", color=color, clip_on=False)
        _line(axes[0, 1], w, b / top_b, label, top_b, "B")
        if fit is not None and label in fit.inputs and label in fit.outputs:
            p, q = fit.outputs.index(label), fit.inputs.index(label)
            h = fit.transfer(w)[:, p, q]
            fitted = fit.added_mass_inf[p, q] + h.imag / w
            axes[0, 0].plot(w, fitted / top_a, "--", color=FIT, lw=0.7)
            axes[0, 1].plot(w, h.real / top_b, "--", color=FIT, lw=0.7)
    axes[0, 0].set_title("added mass A_ii (triangle: A_inf)")
    axes[0, 1].set_title("radiation damping B_ii (dotted: from the excitation)")
    _draw_identity(axes[0, 1], db, radiating)
    _draw_excitation(axes[0, 2], axes[1, 0], db, body, rows)
    _draw_kernel(axes[1, 1], db, radiating)
    _draw_causality(axes[1, 2], db, radiating)
    for ax in (*axes[0], axes[1, 0], axes[1, 2]):
        ax.set_xlabel("w [rad/s]")
        ax.set_xlim(0.0, w[-1])


def _line(ax: Axes, x: Array, y: Array, label: str, top: float, kind: str) -> None:
    named = Label.read(label)
    unit = UNITS[kind][named.is_rotation]
    ax.plot(x, y, color=COLORS[named.dof], label=f"{named.motion} / {top:.3g} {unit}")
    ax.legend(loc="best", fontsize=7, frameon=True, framealpha=0.7, edgecolor="none")


def _draw_identity(ax: Axes, db: HydroDatabase, radiating: list[int]) -> None:
    found = energy_identity(db)
    if found is None:
        return
    for column, damping in zip(found.columns, found.damping.T, strict=True):
        if column in radiating:
            top = np.abs(db.radiation_damping[:, column, column]).max()
            implied = np.where(found.valid, damping / top, np.nan)
            ax.plot(db.omega, implied, ":", color="#444444", lw=1.2)
    ax.set_ylim(min(0.0, ax.get_ylim()[0], -0.05), 1.15)


def _draw_excitation(
    size_ax: Axes, phase_ax: Axes, db: HydroDatabase, body: str, rows: list[int]
) -> None:
    if db.heading.size == 0:
        for ax in (size_ax, phase_ax):
            ax.set_title("no excitation")
        return
    h = int(np.argmax(np.cos(db.heading)))
    beta = db.heading[h]
    point = db.bodies[body].reference_point
    place = np.zeros(3) if point is None else point
    k = wavenumber(db.omega, db.water_depth, db.gravity)
    shift = np.exp(1j * k * (place[0] * np.cos(beta) + place[1] * np.sin(beta)))
    force = db.excitation[:, h] * shift[:, None]
    top = np.abs(force).max(axis=0)
    for kind in (True, False):
        mine = [i for i in rows if db.labels[i].is_rotation == kind]
        largest = max((top[i] for i in mine), default=0.0)
        for i in mine:
            if top[i] > 1e-3 * largest > 0.0:
                label = db.coordinates[i]
                _line(size_ax, db.omega, np.abs(force[:, i]) / top[i], label, top[i], "F")
                angle = np.where(np.abs(force[:, i]) > 1e-3 * top[i], np.angle(force[:, i]), np.nan)
                jumps = np.flatnonzero(np.abs(np.diff(angle)) > np.pi)
                angle[jumps] = np.nan
                phase_ax.plot(db.omega, angle, color=COLORS[db.labels[i].dof])
    size_ax.set_title(f"excitation |F|, heading {np.degrees(beta):.4g} deg")
    phase_ax.set_title("phase of F at the reference point, e^{+iwt}")
    phase_ax.set_ylim(-np.pi, np.pi)
    phase_ax.set_yticks(np.pi * np.array([-1, -0.5, 0, 0.5, 1]), ["-π", "-π/2", "0", "π/2", "π"])
    phase_ax.set_ylabel("[rad]")


def _draw_kernel(ax: Axes, db: HydroDatabase, radiating: list[int]) -> None:
    time, kernel = diagonal_kernels(db)
    used = np.flatnonzero(scales(db) > 0.0).tolist()
    end = 0.0
    for i in radiating:
        k = kernel[:, used.index(i)]
        top = float(np.abs(k).max())
        end = max(end, float(envelope_length(time, k[:, None], 0.02)[0]))
        _line(ax, time, k / top, db.coordinates[i], top, "K")
    for fit in db.memory.values():
        for i in radiating:
            label = db.coordinates[i]
            if label in fit.inputs and label in fit.outputs:
                at = np.linspace(0.0, min(end, time[-1]), 600)
                k = fit.kernel(at)[:, fit.outputs.index(label), fit.inputs.index(label)]
                ax.plot(at, k / np.abs(kernel[:, used.index(i)]).max(), "--", color=FIT, lw=0.7)
    ax.set_title("radiation kernel K_ii(t)" + (" (dashed: fit)" if db.memory else ""))
    ax.set_xlabel("t [s]")
    ax.set_xlim(0.0, min(max(1.2 * end, 1.0), time[-1]))


def _draw_causality(ax: Axes, db: HydroDatabase, radiating: list[int]) -> None:
    used = np.flatnonzero(scales(db) > 0.0).tolist()
    residual = ogilvie_residual(db)
    for i in radiating:
        dof = db.labels[i].dof
        ax.semilogy(db.omega, np.maximum(residual[:, used.index(i)], 1e-6), color=COLORS[dof])
    negative = np.maximum(-scaled_damping_eigenvalues(db), 1e-6)
    ax.semilogy(db.omega, negative, color="black", lw=0.8, label="negative eigenvalue of scaled B")
    ax.axhline(tails.TAIL_SCATTER, color="#999999", lw=0.8, ls=":")
    ax.set_ylim(1e-5, 2.0)
    ax.set_title("Ogilvie residual / A, and energy fed in")
    ax.legend(loc="best", fontsize=7)
