"""A database in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from hydrodae.hdb.database.convolution import RadiationKernel
from hydrodae.hdb.database.tables import Body, Tables

if TYPE_CHECKING:
    from hydrodae.hdb.memory import ExponentialMemory


def summary(db: Tables) -> str:
    """Return what is in the database, for a newcomer: bodies, ranges, headings, fits."""
    depth = f"{db.water_depth:g} m deep" if np.isfinite(db.water_depth) else "infinitely deep"
    headings = ", ".join(f"{h:.4g}" for h in np.degrees(db.heading)) or "none"
    lines = [
        f"{db.title or 'hydrodynamic database'} (source {db.source or 'not stated'}, "
        f"sha256 {db.source_sha256[:12] or '-'})",
        f"  water      {db.rho:g} kg/m3, {depth}, gravity {db.gravity:g} m/s2",
        f"  frequency  {db.omega.size} from {db.omega[0]:.4g} to {db.omega[-1]:.4g} rad/s "
        f"(periods {2 * np.pi / db.omega[-1]:.3g} to {2 * np.pi / db.omega[0]:.3g} s)",
        f"  heading    {headings} deg (direction of travel, 0 = +x)",
        f"  excitation {'Froude-Krylov and diffraction' if db.excitation_split else 'total only'}",
        f"  A_inf      {db.added_mass_inf_origin}",
    ]
    for body in db.bodies.values():
        lines += _body(db, body)
    if db.kernel is not None:
        lines.append(f"  kernel     {kernel_summary(db.kernel)}")
    for name, fit in db.memory.items():
        lines.append(f"  memory     {name}: {fit_summary(fit)}")
    for name, table in db.extra.items():
        lines.append(f"  also       {name} over {', '.join(table.dims)}, as in the source")
    lines += [f"  order 2    {table.summary()}" for table in db.second_order.values()]
    lines += [f"  repaired   {text}" for text in db.repairs]
    return "\n".join(lines)


def fit_summary(fit: ExponentialMemory) -> str:
    """Return the figures that matter of a fit of the radiation memory, on one line."""
    report = fit.report
    parts = [f"{report.get('n_states', '?')} states", f"{', '.join(fit.inputs)} move"]
    parts[-1] += f", loads on {len(fit.outputs)} coordinates"
    band, error = report.get("band"), report.get("h_error_band")
    if isinstance(error, float):
        parts.append(f"error of H {error:.2g}")
        if isinstance(band, tuple) and len(band) == 2:
            parts[-1] += f" in {band[0]:.3g}..{band[1]:.3g} rad/s"
    if "passive" in report:
        parts.append("passive" if report["passive"] else "NOT passive")
    parts += [str(report[key]) for key in ("left_out", "noisy") if key in report]
    return "; ".join(parts)


def kernel_summary(kernel: RadiationKernel) -> str:
    """Return the figures that matter of a radiation kernel, on one line."""
    parts = [
        f"K(t) to {kernel.length:.4g} s, {kernel.time.size} times",
        f"{', '.join(kernel.inputs)} move, loads on {len(kernel.outputs)} coordinates",
    ]
    band, error = kernel.report.get("band"), kernel.report.get("h_error_band")
    if isinstance(error, float) and isinstance(band, tuple):
        parts.append(
            f"error of H {error:.2g} at the frequencies in {band[0]:.3g}..{band[1]:.3g} rad/s"
        )
    if "h_error_between" in kernel.report:
        parts.append(f"B uncertain by {kernel.report['h_error_between']:.1e} between them")
    if "rest" in kernel.report:
        parts.append(f"{kernel.report['rest']:.1e} of int |K| left out")
    if "min_eig_relative" in kernel.report:
        parts.append(f"smallest eigenvalue of Re H {kernel.report['min_eig_relative']:.1e}")
    return "; ".join(parts)


def _body(db: Tables, body: Body) -> list[str]:
    dofs = [label.motion for label in db.labels if label.body == body.name]
    point = "unknown" if body.reference_point is None else _vector(body.reference_point)
    lines = [f"  body       {body.name}: {', '.join(dofs)}; moments about {point}"]
    hs = body.hydrostatics
    if hs is None:
        lines.append("             no hydrostatics")
    else:
        lines.append(
            f"             displaces {hs.displaced_volume:.5g} m3 (would float with "
            f"{db.rho * hs.displaced_volume:.5g} kg), "
            f"buoyancy at {_vector(hs.center_of_buoyancy)}, waterplane {hs.waterplane_area:.5g} m2"
        )
    if body.mesh is not None:
        lines.append(f"             wetted surface of {len(body.mesh)} panels")
    return lines


def _vector(v: np.typing.ArrayLike) -> str:
    return "(" + ", ".join(f"{x:.4g}" for x in np.asarray(v)) + ") m"
