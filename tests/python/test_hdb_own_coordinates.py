"""`hydrodae hdb compute --piston --mode`: pistons on pools, and modes by formula."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from tests.errors import refused
from tests.python.hdb_command import call

import hydrodae
from hydrodae import hdb
from hydrodae.commands.hdb.own_coordinates import with_own_coordinates
from hydrodae.errors import CaseError, DatabaseError
from hydrodae.hdb.bem import modes, shapes
from hydrodae.hdb.bem.lids import lid, pools
from hydrodae.hdb.bem.revolution import ring
from hydrodae.hdb.bem.run import Settings, WettedBody
from hydrodae.hdb.database import HydroDatabase
from hydrodae.hdb.preparation import computing

RING = ["--body", "owc=ring:radius=0.5:inner=0.25:draft=1", "--cog", "owc=0,0,0"]
GRID = ["--rho", "1000", "--gravity", "9.80665", "-q"]
AREA = np.pi * 0.25**2
STARTER = Path(hydrodae.__file__).parent / "starters" / "owc" / "hydro.h5"


def compute(out: Path, *words: str) -> HydroDatabase:
    pytest.importorskip("capytaine", reason="needs the extra bem")
    assert call("compute", *words, "-o", out) == 0
    return HydroDatabase.read(out)


def column(reference: Path) -> HydroDatabase:
    source = reference / "owc" / "owc_wecsim" / "test17a" / "test17a.out"
    return hdb.import_database(source, rho=1000.0, cut=5.0)[0]


@pytest.mark.slow
def test_piston_of_wamit(reference: Path, tmp_path: Path) -> None:
    """A77, B77 and F7 of test17a at k = 0.1, 1, 1.5 and 2 1/m, each within 3 %."""
    pytest.importorskip("capytaine", reason="needs the extra bem")
    exact, at = column(reference), [0, 9, 14, 19]
    hull = ring(0.071, radius=0.5, inner=0.25, draft=1.0)
    alone = [WettedBody("owc", hull, np.zeros(3))]
    bodies = with_own_coordinates(alone, pistons=True, formulas=[])
    settings = Settings(omega=exact.omega[at], rho=1000.0, gravity=9.80665)
    found, report = computing.compute(bodies, settings, tmp_path)
    assert report.ok
    i, j = found.coordinates.index("owc.piston"), exact.coordinates.index("test17a.mode7")
    for name in ("added_mass", "radiation_damping"):
        of_wamit = getattr(exact, name)[at, j, j]
        np.testing.assert_allclose(getattr(found, name)[:, i, i], of_wamit, rtol=0.03)
    force = exact.excitation[at, 0, j]
    np.testing.assert_allclose(found.excitation[:, 0, i] / force, 1.0, atol=0.03)


@pytest.fixture(scope="module")
def coarse(tmp_path_factory: pytest.TempPathFactory) -> HydroDatabase:
    """The column of test17a with few panels, and its heave by formula as well."""
    words = [*RING, *GRID, "--piston", "--mode", "owc.lift=1", "--panel", "0.25"]
    words += ["--omega", "0.9,3.2,5"]
    return compute(tmp_path_factory.mktemp("owc") / "owc.h5", *words)


def test_stiffness_of_a_piston_is_that_of_its_area(coarse: HydroDatabase) -> None:
    stiffness = coarse.bodies["owc"].mode_stiffness
    assert stiffness is not None
    k = 1000.0 * 9.80665 * AREA
    np.testing.assert_allclose(stiffness[[2, 6, 6], [6, 2, 6]], k, rtol=1e-9)
    # hull and pool together close the water plane
    assert stiffness[2, 2] == pytest.approx(4.0 * k, rel=1e-9)
    assert coarse.hydrostatic_stiffness("owc")[2, 2] == pytest.approx(4.0 * k, rel=1e-9)


def test_shapes_are_kept_on_the_surface(coarse: HydroDatabase) -> None:
    body, names = coarse.bodies["owc"], [c.partition(".")[2] for c in coarse.coordinates[6:]]
    assert body.mesh is not None
    assert body.mode_shapes is not None
    lift = np.broadcast_to([0.0, 0.0, 1.0], body.mesh.shape)
    for shape, name in zip(body.mode_shapes, names, strict=True):
        np.testing.assert_array_equal(shape, {"piston": 0.0, "lift": 1.0}[name] * lift)


def test_heave_by_formula_is_heave(coarse: HydroDatabase) -> None:
    heave, lift = (coarse.coordinates.index(f"owc.{c}") for c in ("heave", "lift"))
    for table in (coarse.added_mass, coarse.radiation_damping):
        np.testing.assert_allclose(table[:, lift], table[:, heave], rtol=1e-9, atol=1e-6)
    np.testing.assert_allclose(coarse.excitation[..., lift], coarse.excitation[..., heave])


def test_few_panels_are_near_wamit(coarse: HydroDatabase, reference: Path) -> None:
    """At k = 0.08 and 0.22 1/m, where the force on the piston is no small difference."""
    exact = column(reference)
    i, j = coarse.coordinates.index("owc.piston"), exact.coordinates.index("test17a.mode7")
    for name, error in (("added_mass", 0.04), ("radiation_damping", 0.03)):
        of_wamit = CubicSpline(exact.omega, getattr(exact, name)[:, j, j])(coarse.omega[:2])
        np.testing.assert_allclose(getattr(coarse, name)[:2, i, i], of_wamit, rtol=error)


def test_pitch_by_formula_is_pitch(tmp_path: Path) -> None:
    """A hull without a pool: u = e_y x r."""
    words = ["--body", "b=box:length=8:width=4:draft=2", "--cog", "b=0,0,0", "--panel", "1.4"]
    words += ["--omega", "0.5,2,4", "--mode", "b.turn=z,0,-x", *GRID]
    found = compute(tmp_path / "b.h5", *words)
    pitch, turn = found.coordinates.index("b.pitch"), found.coordinates.index("b.turn")
    for table in (found.added_mass, found.radiation_damping):
        np.testing.assert_allclose(table[:, turn, turn], table[:, pitch, pitch], rtol=1e-6)
    np.testing.assert_allclose(found.excitation[..., turn], found.excitation[..., pitch])


def test_stiffness_of_a_bending_barge() -> None:
    """Closed forms: of w = cos(2 pi x/L) B L/2, of pitch B L^3/12 - V z_B without its weight.

    The end walls turn in pitch: it and another mode differ by int n_x z w dS, B d^2 w_tip.
    """
    panels = shapes.box(1.0, length=80.0, width=10.0, draft=5.0)
    centers, _ = modes.centers_and_areas(panels)
    bend, tilt = (modes.by_formula(t, centers) for t in ("cos(2*pi*x/80)", "sin(pi*x/80)"))
    k = modes.stiffness(panels, np.zeros(3), [bend, tilt], 1.0, 1.0)
    assert k[6, 6] == pytest.approx(400.0, rel=1e-3)
    assert k[4, 4] == pytest.approx(10.0 * 80.0**3 / 12.0 - 4000.0 * 2.5, rel=1e-3)
    assert k[7, 4] - k[4, 7] == pytest.approx(250.0, rel=0.01)


def test_divergence_of_a_field() -> None:
    places = np.array([[1.0, 2.0, -3.0], [0.5, -1.0, -2.0]])
    found = modes.by_formula("x*y, y**2, x*z", places)
    np.testing.assert_allclose(found.shape[0], [2.0, 4.0, -3.0])
    x, y, _ = places.T
    np.testing.assert_allclose(found.divergence, y + 2.0 * y + x, rtol=1e-6)


@pytest.mark.parametrize("size", [0.085, 0.12, 0.3])
def test_lids_and_pools_of_a_ring_have_no_slivers(size: float) -> None:
    """Corners on one ray, whose angles differ by rounding, make no panels without width."""
    hull = ring(size, radius=0.5, inner=0.25, draft=1.0)
    for panels, area in ((lid(hull), 3.0 * AREA), (pools(hull)[0], AREA)):
        _, areas = modes.centers_and_areas(panels)
        assert -areas[:, 2].min() > 0.0
        assert np.all(areas[:, 2] < -1e-9)
        assert areas[:, 2].sum() == pytest.approx(-area, rel=1e-9)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--mode", "owc.a=open(x)"], "'open.x.' is unknown; it may have x, y, z, pi"),
        (["--mode", "owc.a=1/x*"], "cannot be read"),
        (["--mode", "owc.a=log(x)"], "is unknown"),
        (["--mode", "owc.a=sqrt(x-9)"], "no finite value at x, y, z ="),
        (["--mode", "owc.a=1,x"], "expected one formula, along z, or three"),
        (["--mode", "owc.heave=1"], "that no other coordinate of owc has"),
        (["--mode", "owc.piston=1", "--piston"], "that no other coordinate of owc has"),
        (["--mode", "oww.a=1"], "did you mean 'owc'"),
        (["--mode", "owc=1"], "expected BODY.NAME=FORMULA"),
        (["--piston", "--poses", "heave=0,1"], "has no table of poses"),
    ],
)
def test_bad_formulas(tmp_path: Path, words: list[str], message: str) -> None:
    given = [*RING, "--omega", "1,4,4", *words, "-o", str(tmp_path / "x.h5"), "-q"]
    with pytest.raises((CaseError, DatabaseError), match=message):
        call("compute", *given)


def test_a_piston_needs_a_pool_and_a_lid(tmp_path: Path) -> None:
    ends = ["--omega", "1,4,4", "--piston", "-o", str(tmp_path / "x.h5"), "-q"]
    with pytest.raises(CaseError, match="no body has a free surface inside its hull"):
        call("compute", "--body", "b=sphere:radius=5", "--cog", "b=0,0,0", *ends)
    for option in (["--no-lid"], ["--kochin", "4"]):
        with refused("option", "piston"):
            call("compute", *RING, *ends, *option)


def test_a_piston_alone_is_read_and_drawn(tmp_path: Path) -> None:
    alone = HydroDatabase.read(STARTER).select(["owc.piston"])
    assert hdb.check(alone).of("error") == []
    alone.write(tmp_path / "hydro.h5")
    read = hdb.read(tmp_path / "hydro.h5")
    assert read.coordinates == ("owc.piston",)
    assert hdb.draw_report(read, hdb.check(read)).axes == []
