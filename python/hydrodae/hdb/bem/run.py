"""Compute a database with Capytaine 3 (extra `bem`): direct method, one factorisation a frequency.

Every frequency is kept in a folder as soon as it is done; an interrupted run goes on where it
stopped, and other bodies or settings start a new folder.
"""

from __future__ import annotations

import hashlib
import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
import xarray as xr
from scipy.linalg import block_diag

from hydrodae.errors import DatabaseError
from hydrodae.hdb.bem.green import solve
from hydrodae.hdb.bem.lids import lid
from hydrodae.hdb.bem.modes import Mode, stiffness
from hydrodae.hdb.bem.overlap import overlapping
from hydrodae.hdb.bem.pool import in_water_plane, solve_pool
from hydrodae.hdb.database.extra import SHALLOW
from hydrodae.hdb.relations.dispersion import wavenumber
from hydrodae.support.arrays import Array
from hydrodae.support.extras import install_command

#: Panels of all bodies and lids: a full matrix of complex numbers, 16 bytes an entry.
MOST_PANELS = 6000


@dataclass(frozen=True)
class WettedBody:
    """A body to compute.

    Attributes
    ----------
    name : str
    panels : (n, 4, 3) array
        Wetted surface (`hydrodae.hdb.bem.shapes`), or more: what is above z = 0 is cut off [m].
    point : (3,) array
        Reference point of rotations and moments [m].
    pool : (m, 4, 3) array
        Panels on the free surfaces inside the hull, which move with the body (`lids.pools`) [m].
    modes : dict of Mode
        Its own coordinates, on panels and pool.
    """

    name: str
    panels: Array
    point: Array
    pool: Array = field(default_factory=lambda: np.zeros((0, 4, 3)))
    modes: dict[str, Mode] = field(default_factory=dict)

    @property
    def moving(self) -> Array:
        """Panels (n + m, 4, 3) of hull and pool [m]."""
        return np.concatenate([self.panels, self.pool])


@dataclass(frozen=True)
class Settings:
    """What to compute.

    Attributes
    ----------
    omega : (nw,) array
        Frequencies [rad/s], finite and > 0; w = inf is added where no body has a pool.
    heading : (nh,) array
        Directions of travel [rad].
    rho, gravity, water_depth : float
        [kg/m3], [m/s2], [m] (may be infinite).
    lid : bool
        Close the inner water plane, which removes irregular frequencies.
    kochin : int
        Angles around the circle at which Kochin functions are kept; 0 for none. They need the
        sources of the indirect method: each frequency is then solved twice.
    most_panels : int
        Of all bodies and lids.
    """

    omega: Array
    heading: Array = field(default_factory=lambda: np.zeros(1))
    rho: float = 1025.0
    gravity: float = 9.81
    water_depth: float = np.inf
    lid: bool = True
    kochin: int = 0
    most_panels: int = MOST_PANELS

    def __post_init__(self) -> None:
        w = np.asarray(self.omega, dtype=float)
        object.__setattr__(self, "omega", w)
        object.__setattr__(self, "heading", np.asarray(self.heading, dtype=float))
        if w.ndim != 1 or w.size < 4 or w.min() <= 0.0 or not np.all(np.diff(w) > 0.0):
            raise DatabaseError(
                "needs at least 4 frequencies > 0 in ascending order [rad/s]"
            ).about("frequencies")
        if not (self.rho > 0.0 and self.gravity > 0.0 and self.water_depth > 0.0):
            raise DatabaseError("rho, gravity and water_depth must be > 0").about("value", "water")
        if self.kochin < 0:
            raise DatabaseError(f"kochin {self.kochin}: expected a number of angles").about(
                "option", "kochin"
            )


def compute(
    bodies: Sequence[WettedBody],
    settings: Settings,
    folder: Path,
    *,
    progress: Callable[[int, int, float, float], None] | None = None,
) -> Path:
    """Compute all frequencies that the folder does not hold yet.

    Parameters
    ----------
    bodies : sequence of WettedBody
    settings : Settings
    folder : Path
        Results are kept in a folder inside it, whose name is a hash of bodies and settings.
    progress : callable, optional
        Called with (done, of, frequency [rad/s], seconds spent) after each frequency.

    Returns
    -------
    Path
        A netCDF file as Capytaine makes them, NaN included where Capytaine failed: read it with
        `hydrodae.hdb.import_database`, which counts and names them, and shows the frequencies that
        were solved with the Green function of shallow water (`green.solve`).

    Raises
    ------
    DatabaseError
        Capytaine is missing, a body is deeper than the water, a lid covers too little, too many
        panels, a frequency at which Capytaine has no Green function, or NaN at w = inf; a pool
        without lids, or with Kochin functions.
    """
    piped = any(len(body.pool) for body in bodies)
    if piped and (settings.kochin or not settings.lid):
        raise DatabaseError("a piston on a pool needs the lid, and has no Kochin functions").about(
            "option", "piston"
        )
    _check_depth(bodies, settings.water_depth)
    pair = overlapping({body.name: body.panels for body in bodies})
    if pair is not None:
        raise DatabaseError(
            f"body {pair[1]!r} stands in body {pair[0]!r}: their hulls overlap; move one (:x=..), "
            f"or join both into one mesh"
        ).about("geometry", pair[1])
    cpt = _capytaine()
    cpt.set_logging("ERROR")
    logging.getLogger("capytaine").setLevel(logging.ERROR)
    place = folder / _key(cpt.__version__, bodies, settings)
    place.mkdir(parents=True, exist_ok=True)
    omega = settings.omega if piped else np.append(settings.omega, np.inf)
    files = [place / f"omega_{w:.6f}.nc" for w in omega]
    todo = [(w, f) for w, f in zip(omega, files, strict=True) if not f.is_file()]
    if todo:
        device = _device(cpt, bodies, settings)
        start = monotonic()
        for i, (w, file) in enumerate(todo, start=1):
            data = _solve(cpt, device, float(w), settings)
            partial = file.with_suffix(".part")
            plain = cpt.io.xarray.separate_complex_values(data)
            plain.to_netcdf(partial, engine="netcdf4")
            partial.rename(file)
            if progress is not None:
                progress(len(files) - len(todo) + i, len(files), float(w), monotonic() - start)
    return _collect(files, bodies, settings, place / "all.nc")


def _check_depth(bodies: Sequence[WettedBody], water_depth: float) -> None:
    for body in bodies:
        lowest = -float(body.panels[..., 2].min())
        if lowest >= water_depth:
            raise DatabaseError(
                f"body {body.name!r} goes down to {lowest:g} m, but the water is {water_depth:g} m "
                "deep: it has to float above the seabed"
            ).about("geometry", body.name)


def panel_warning(bodies: Sequence[WettedBody], settings: Settings) -> str:
    """Return a warning of panels longer than an eighth of the shortest wave; else empty text."""
    longest = max(
        float(np.linalg.norm(b.panels - np.roll(b.panels, 1, axis=1), axis=2).max()) for b in bodies
    )
    k = wavenumber(settings.omega[-1:], settings.water_depth, settings.gravity)[0]
    wave = 2.0 * np.pi / float(k)
    if longest <= wave / 8.0:
        return ""
    bearable = np.sqrt(2.0 * np.pi * settings.gravity / (8.0 * longest))
    return (
        f"the longest panel side, {longest:.3g} m, is more than an eighth of the shortest wave, "
        f"{wave:.3g} m: trust the results up to about {bearable:.3g} rad/s, or take finer panels"
    )


def _capytaine() -> Any:
    try:
        import capytaine
    except ImportError as error:
        raise DatabaseError(
            f"computing a database needs Capytaine: {install_command('bem')}"
        ).about("software") from error
    if int(capytaine.__version__.split(".")[0]) < 3:
        raise DatabaseError(f"needs Capytaine 3 or later, found {capytaine.__version__}").about(
            "software"
        )
    return capytaine


def _mesh(cpt: Any, panels: Array) -> Any:
    vertices, index = np.unique(panels.reshape(-1, 3).round(9), axis=0, return_inverse=True)
    mesh = cpt.Mesh(vertices=vertices, faces=index.reshape(-1, 4))
    if mesh.nb_faces != len(panels):
        raise DatabaseError(
            f"Capytaine keeps {mesh.nb_faces} of {len(panels)} panels: some are double or have no "
            f"area; clean the mesh"
        ).about("mesh", "panels")
    return mesh


def _device(cpt: Any, bodies: Sequence[WettedBody], settings: Settings) -> Any:
    """All bodies as one mesh with degrees of freedom `<body>__<Dof>`: six each, and their modes."""
    from capytaine.bodies.dofs import DofOnSubmesh, rigid_body_dofs

    hull = np.concatenate([b.moving for b in bodies])
    _check_count(len(hull), settings.most_panels)
    found = [_lid(b) for b in bodies] if settings.lid else []
    lids = [panels for panels in found if len(panels)]
    _check_count(len(hull) + sum(map(len, lids)), settings.most_panels)
    starts = np.r_[0, np.cumsum([len(b.moving) for b in bodies])]
    dofs: dict[str, Any] = {}
    for body, first, last in zip(bodies, starts[:-1], starts[1:], strict=True):
        mine = np.arange(first, last)
        for dof, motion in rigid_body_dofs(rotation_center=np.asarray(body.point)).items():
            dofs[f"{body.name}__{dof}"] = DofOnSubmesh(motion, mine)
        for dof, mode in body.modes.items():
            dofs[f"{body.name}__{dof}"] = np.zeros((len(hull), 3))
            dofs[f"{body.name}__{dof}"][mine] = mode.shape
    return cpt.FloatingBody(
        mesh=_mesh(cpt, hull),
        lid_mesh=_mesh(cpt, np.concatenate(lids)) if lids else None,
        dofs=dofs,
        name="device",
    )


def _check_count(count: int, most: int) -> None:
    if count > most:
        raise DatabaseError(
            f"{count} panels, {most} are allowed with the lids: take larger panels, or allow more "
            "(--most-panels)"
        ).about("mesh", "panels")


def _lid(body: WettedBody) -> Array:
    try:
        return lid(body.panels)
    except DatabaseError as error:
        raise error.within(body.name) from None


def _solve(cpt: Any, device: Any, omega: float, settings: Settings) -> xr.Dataset:
    water = {"rho": settings.rho, "g": settings.gravity, "water_depth": settings.water_depth}
    if in_water_plane(device.mesh).any():
        return solve_pool(cpt, device, omega, water, settings.heading)
    results, shallow = solve(cpt, device, omega, water, settings.heading, "direct")
    names = list(device.dofs)
    data: xr.Dataset = cpt.assemble_dataset(results)
    data = data.sel(influenced_dof=names, radiating_dof=names)
    data = data.assign_coords(influenced_dof=names, radiating_dof=names)
    data.attrs[SHALLOW] = int(shallow)
    if not np.isfinite(omega) and np.isnan(data["added_mass"].values).any():
        raise DatabaseError("Capytaine gave NaN for the added mass at w = inf").about("software")
    if settings.kochin and np.isfinite(omega):
        # Kochin functions follow from the sources of the indirect method
        sources, _ = solve(cpt, device, omega, water, settings.heading, "indirect")
        theta = np.linspace(0.0, 2.0 * np.pi, settings.kochin, endpoint=False)
        axis = xr.DataArray(theta, dims=["theta"], coords={"theta": theta})
        far = cpt.io.xarray.kochin_data_array(sources, axis).sel(radiating_dof=names)
        data = data.merge(far, join="left", compat="override")
    return data


def _collect(
    files: list[Path], bodies: Sequence[WettedBody], settings: Settings, target: Path
) -> Path:
    parts = []
    for file in files:
        with xr.open_dataset(file, engine="netcdf4") as opened:
            parts.append(opened.load())
    shallow = [float(p["omega"].values.item()) for p in parts if p.attrs.get(SHALLOW)]
    data = xr.concat(
        parts, "omega", data_vars="all", coords="minimal", compat="override", join="outer"
    )
    data = data.sortby("omega").drop_vars("rotation_center", errors="ignore")
    data = data.assign_coords(body_name=[b.name for b in bodies])
    points = np.array([b.point for b in bodies], dtype=float)
    data["rotation_center"] = (("body_name", "space_coordinate"), points)
    data.attrs[SHALLOW] = sorted(shallow)
    if any(body.modes for body in bodies):
        pairs = ("influenced_dof", "radiating_dof")
        data["hydrostatic_stiffness"] = (pairs, _stiffness(bodies, settings))
    data.to_netcdf(target, engine="netcdf4")
    return target


def _stiffness(bodies: Sequence[WettedBody], settings: Settings) -> Array:
    """Hydrostatics (n, n) of all degrees of freedom of `_device`; none between bodies."""
    water = settings.rho, settings.gravity
    blocks = [stiffness(b.moving, b.point, list(b.modes.values()), *water) for b in bodies]
    return np.asarray(block_diag(*blocks))


def _key(version: str, bodies: Sequence[WettedBody], settings: Settings) -> str:
    numbers = [settings.rho, settings.gravity, settings.water_depth, settings.lid]
    numbers += [settings.kochin] if settings.kochin else []
    digest = hashlib.sha256(
        f"{version} {tuple(numbers)} {settings.heading.round(9).tolist()}".encode()
    )
    for body in bodies:
        digest.update(f"{body.name} {np.asarray(body.point).round(9).tolist()}".encode())
        digest.update(np.ascontiguousarray(body.moving.round(9)).tobytes())
        for name, mode in body.modes.items():
            digest.update(name.encode() + mode.shape.round(9).tobytes())
    return digest.hexdigest()[:12]
