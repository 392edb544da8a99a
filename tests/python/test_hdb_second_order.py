"""Tables of second order: values of six formats, symmetry, what is refused, what is warned of."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.errors import refused
from tests.python.hdb_command import call
from tests.python.small_database import make_database

from hydrodae import hdb
from hydrodae.hdb.checks.drift import drift_findings
from hydrodae.hdb.database.extra import SourceTable
from hydrodae.hdb.database.second_order import SecondOrderTable
from hydrodae.hdb.database.tables import Body
from hydrodae.hdb.readers.second_order import named
from hydrodae.hdb.relations.dispersion import wavenumber

RHO_G = 1025.0 * 9.81
SIX = tuple(f"float.{motion}" for motion in ("surge", "sway", "heave", "roll", "pitch", "yaw"))


def floating(point=(0.0, 0.0, 0.0), depth=np.inf, rho=1025.0, gravity=9.81):
    """A made-up database of one body, as the owner of tables of other programs."""
    base = make_database(SIX)
    body = Body("float", np.array(point), base.bodies["float"].hydrostatics)
    water = {"rho": rho, "gravity": gravity, "water_depth": depth}
    return replace(base, bodies={"float": body}, memory={}, **water)


def read(owner, *files, findings=None):
    return named({"": files}, owner, [] if findings is None else findings)


def row(w1, w2, mode, value, heading=(0.0, 0.0)):
    """A line of a `.12d` file."""
    periods = [2.0 * np.pi / w for w in (w1, w2)]
    parts = [abs(value), np.degrees(np.angle(value)), value.real, value.imag]
    return " ".join(f"{x:.8E}" for x in (*periods, *heading)) + f" {mode} " + " ".join(
        f"{x:.8E}" for x in parts
    )  # fmt: skip


def write_rows(path, rows):
    path.write_text("\n".join(["title", *rows]) + "\n")
    return path


@pytest.fixture
def second_order(reference):
    return reference / "second_order"


def test_oc4_by_wamit(second_order, reference):
    """Values as printed, and the force of four waves that another program made of them."""
    db, report = hdb.import_database(
        second_order / "qtf_oc4_wamit" / "marin_semi.1", depth=200.0, rho=1025.0, gravity=9.81
    )
    table = db.second_order["difference"]
    surge = table.coordinates.index("marin_semi.surge")
    assert table.values[0, 0, 0, surge].real == pytest.approx(0.427149 * RHO_G, rel=1e-12)
    assert db.second_order["sum"].values[0, 0, 0, surge] == pytest.approx(
        (-1.45161 - 1.27650j) * RHO_G, rel=1e-12
    )
    assert table.computed.all()
    waves = [(0.8, 1.0, 0.3), (0.85, 0.8, 1.7), (0.95, 0.6, -2.0), (1.1, 0.5, 0.9)]
    known = np.genfromtxt(
        second_order / "own_values" / "slow_force.csv", delimiter=",", skip_header=1
    )
    force = np.zeros(len(known))
    for w1, a1, p1 in waves:
        for w2, a2, p2 in waves:
            i, j = (np.abs(table.omega - w).argmin() for w in (w1, w2))
            turn = np.exp(1j * ((w1 - w2) * known[:, 0] + p1 - p2))
            force += (a1 * a2 * table.values[i, j, 0, surge] * turn).real
    np.testing.assert_allclose(force, known[:, 1], rtol=1e-6, atol=1e-3)
    assert [f.severity for f in report.find("drift along")] == ["info"]


def test_hydrostar_cylinder(second_order):
    """Values of the README; zeros that fill the triangle are not computed."""
    findings: list[Any] = []
    folder = second_order / "qtf_hydrostar" / "8b_QTF_Cylinder__mesh634_floating"
    owner = floating()
    tables = read(owner, folder, findings=findings)
    mean = tables["mean"]
    for omega, value in (
        (1.0676, 8312.7), (1.4444, 26585.0), (1.8212, 40928.0), (2.198, 41219.0),
        (2.5748, 42335.0), (2.9516, 44429.0), (3.3284, 46475.0),
    ):  # fmt: skip
        assert mean.values[np.flatnonzero(mean.omega == omega)[0], 0, 0] == value
    pairs = tables["difference"]
    assert (pairs.omega.size, pairs.omega[-1]) == (50, 3.14)
    # the line of w = 3.0772 holds w and w + 0.0628, the last frequency
    # whose phases are about x = -0.0015 m
    turn = np.exp(1j * (3.14**2 - 3.0772**2) / 9.81 * -0.0015)
    expected = (4.4504e4 - 7.4342e2j) * turn
    assert pairs.values[48, 49, 0, 0] == pytest.approx(expected, rel=1e-12)
    np.testing.assert_array_equal(pairs.values, pairs.values.conj().swapaxes(0, 1))
    assert any("DriftFxFF.rao" in f.message and "not computed" in f.message for f in findings)
    found = drift_findings(owner.with_second_order(tables))
    assert not [f for f in found if f.severity != "info"]


def test_hydrostar_of_another_run(second_order):
    folder = second_order / "qtf_hydrostar" / "8b_QTF_Cylinder__mesh634_floating"
    for owner, reason, subject in (
        (floating(rho=1000.0), "conflict", "density"),
        (floating(depth=100.0), "conflict", "depth"),
        (floating(point=(0.0, 0.0, -2.0)), "point", "float"),
    ):
        with refused(reason, subject):
            read(owner, folder)


@pytest.mark.parametrize(
    ("name", "source", "value", "omega"),
    [
        ("oc3hywind", "oc3hywind_nemoh_v3.0.2", -266483.0, 1.0),
        ("volturnus", "volturnus_nemoh", -1.05e8, 4.08),
    ],
)
def test_wrong_tables_of_nemoh(second_order, reference, name, source, value, omega):
    """Both are read, and warned of: drift against the waves."""
    files = sorted((second_order / "qtf_nemoh").glob(f"{name}_OUT_QTF*"))
    db, report = hdb.import_database(reference / "hdb" / source, second_order={"": files})
    assert set(db.second_order) == {"difference", "sum"}
    (finding,) = report.find("drift along the waves")
    assert finding.severity == "warning"
    assert finding.omega == pytest.approx(omega, abs=0.005)
    drift, _ = db.second_order["difference"].diagonal()
    assert drift[..., 0].real.min() == pytest.approx(value, rel=2e-3)


def test_phases_of_three_codes(second_order, reference):
    """The slow moment on a spar or semisubmersible leads the waves: one sign from three codes.

    Pitch about the water plane at w1 > w2, long waves: nearly imaginary, by Nemoh and HydroStar of
    one spar, by WAMIT of another float; their files differ in phasors and in the order of waves.
    """
    spar, _ = hdb.import_database(
        reference / "hdb" / "oc3hywind_nemoh_v3.0.2",
        second_order={"": [second_order / "qtf_nemoh" / "oc3hywind_OUT_QTFM_N_0.dat"]},
        reference_points={"": (0.0, 0.0, 0.0)},
    )
    folder = second_order / "qtf_hydrostar" / "11_QTF_OC3_Hywind__mesh4842_Floating"
    semi, _ = hdb.import_database(
        second_order / "qtf_oc4_wamit" / "marin_semi.1", depth=200.0, rho=1025.0, gravity=9.81
    )
    tables = [
        spar.second_order["difference"],
        read(floating(depth=320.0), folder)["difference"],
        semi.second_order["difference"],
    ]
    for table in tables:
        (pitch,) = [i for i, c in enumerate(table.coordinates) if c.endswith("pitch")]
        for w1, w2 in ((0.5, 0.3), (0.6, 0.4), (0.9, 0.7)):
            i, j = (np.abs(table.omega - w).argmin() for w in (w1, w2))
            value = table.values[i, j, 0, pitch]
            assert value.imag > abs(value.real)


def test_control_surface_before_pressures(second_order, tmp_path):
    """`.7` is taken; without it `.8`, and heave, roll and pitch of `.9`."""
    source = second_order / "wecsim_mean_drift_sphere"
    db, report = hdb.import_database(source)
    table = db.second_order["mean"]
    assert table.method == ("control surface",) * 6
    said = " ".join(f.message for f in report.find("second order"))
    assert "sphere.7 (control surface) taken" in said
    assert "sphere.8 (momentum), not used; sphere.9 (pressure), not used" in said
    k = table.omega**2 / db.gravity
    unit = db.rho * db.gravity
    for kr, value in ((0.948, 0.303), (1.285, 0.811), (1.672, 0.653), (2.11, 0.647), (2.6, 0.669)):
        at = np.abs(k - kr).argmin()
        assert table.values[at, 0, 0].real / unit == pytest.approx(value, abs=6e-4)
    run = shutil.copytree(source, tmp_path / "run")
    (run / "sphere.7").unlink()
    other = hdb.import_database(run)[0].second_order["mean"]
    methods = dict(zip(other.coordinates, other.method, strict=True))
    assert methods["sphere.surge"] == methods["sphere.yaw"] == "momentum"
    assert methods["sphere.heave"] == methods["sphere.pitch"] == "pressure"
    (run / "sphere.8").unlink()
    checked = hdb.import_database(run)[1].find("drift along")
    assert checked[0].severity == "warning"  # irregular frequencies: negative beyond kR 3


def test_orcawave_and_aqwa(second_order):
    yml = second_order / "qtf_orcawave" / "MultibodyQTF_res.yml"
    db, _ = hdb.import_database(yml)
    mean, both = db.second_order["mean"], db.second_order["sum"]
    assert mean.values[-1, 0, 0] == pytest.approx(76802.9968033277)
    assert both.values[0, 0, 0, 0] == pytest.approx(
        1180.7646592855543 * np.exp(1j * np.radians(189.33496588229556))
    )
    db, _ = hdb.import_database(second_order / "qtf_aqwa_boxes" / "Box2_ANALYSIS.LIS")
    table = db.second_order["difference"]
    assert len(table.coordinates) == 12
    assert table.values.shape == (4, 4, 4, 12)
    heave = table.coordinates.index("structure1.heave")
    assert table.values[0, 0, 0, heave] == pytest.approx(156.86)


def test_another_number_of_bodies(second_order):
    with refused("conflict", "bodies"):
        read(floating(), second_order / "qtf_aqwa_boxes" / "Box2_ANALYSIS.QTF")


def test_written_and_read(tmp_path):
    rng = np.random.default_rng(1)
    rows = [
        row(a, b, mode, complex(*rng.normal(size=2)) if a != b else 1.0 + 0.0j)
        for a, b in ((0.5, 0.5), (1.0, 0.5), (1.0, 1.0))
        for mode in (1, 3)
    ]
    file = write_rows(tmp_path / "a.12d", rows)
    db = floating().with_second_order(read(floating(), file))
    db.write(tmp_path / "hydro.h5")
    again = hdb.read(tmp_path / "hydro.h5").second_order["difference"]
    table = db.second_order["difference"]
    for name in ("omega", "heading1", "heading2", "values", "computed"):
        np.testing.assert_array_equal(getattr(again, name), getattr(table, name))
    assert (again.coordinates, again.method, again.source) == (
        ("float.surge", "float.heave"), ("direct",) * 2, "a.12d",
    )  # fmt: skip
    assert "order 2    difference: float.surge, float.heave; 2 x 2" in db.summary()
    renamed = db.renamed({"float": "buoy"}).second_order["difference"]
    assert renamed.coordinates == ("buoy.surge", "buoy.heave")
    assert db.select(["float.heave"]).second_order["difference"].coordinates == ("float.heave",)
    assert not db.select(["float.sway"]).second_order


def test_moments_about_another_point():
    """M' = M + r x F; a moment is not known where a force that it needs is not."""
    labels = ("float.surge", "float.heave", "float.pitch")
    values = np.array([[[2.0, 3.0, 5.0]]], dtype=complex)
    table = SecondOrderTable(
        "mean", labels, ("pressure",) * 3, np.array([1.0]), np.zeros(1), np.zeros(1), values,
        np.ones(values.shape, dtype=bool),
    )  # fmt: skip
    moved = table.moved({"float": np.array([0.5, 0.0, -2.0])})  # old minus new point
    assert moved.values[0, 0, 2] == pytest.approx(5.0 + (-2.0) * 2.0 - 0.5 * 3.0)
    part = table.selected(labels[1:])
    assert part is not None
    lacking = part.moved({"float": np.array([0.0, 0.0, -2.0])})
    assert lacking.computed[0, 0].tolist() == [True, False]


def test_both_triangles_and_sum(tmp_path):
    """The other triangle follows; of sums without the conjugate."""
    lines = [row(1.0, 0.5, 1, 2.0 + 1.0j), row(0.5, 0.5, 1, 1.0 + 0j), row(1.0, 1.0, 1, 3.0 + 0j)]
    files = [write_rows(tmp_path / f"a.12{s}", lines) for s in "ds"]
    tables = read(floating(), *files)
    assert tables["difference"].values[0, 1, 0, 0] == pytest.approx(RHO_G * (2.0 - 1.0j))
    assert tables["sum"].values[0, 1, 0, 0] == pytest.approx(RHO_G * (2.0 + 1.0j))


def test_zeros_are_not_computed(tmp_path):
    lines = [row(0.5, 0.5, 1, 1.0 + 0j), row(1.0, 1.0, 1, 3.0 + 0j), row(1.0, 0.5, 1, 0j)]
    table = read(floating(), write_rows(tmp_path / "a.12d", lines))["difference"]
    assert table.computed[..., 0, 0].tolist() == [[True, False], [False, True]]
    assert "50% computed" in table.summary()


@pytest.mark.parametrize(
    ("lines", "reason", "subject", "line"),
    [
        ([row(1, 1, 1, 2 + 1j)], "symmetry", "difference", 3),
        ([row(1, 0.5, 1, 2 + 1j), row(0.5, 1, 1, 2 + 1j)], "symmetry", "difference", 3),
        ([row(1, 0.5, 1, complex(np.nan, 0.0))], "not_finite", "difference", 3),
        ([row(1, 0.5, 7, 2 + 1j)], "label", "modes", 3),
    ],
)
def test_refused(tmp_path, lines, reason, subject, line):
    file = write_rows(tmp_path / "a.12d", [row(0.5, 0.5, 1, 3 + 0j), *lines])
    with refused(reason, subject, file="a.12d", line=line):
        read(floating(), file)


def test_wrong_table_beside_a_source(second_order, tmp_path, capsys):
    """The import is refused, and --accept takes the database without the table."""
    run = shutil.copytree(second_order / "wecsim_mean_drift_sphere", tmp_path / "run")
    lines = (run / "sphere.8").read_text().splitlines()
    lines[10] = lines[10].rpartition(" ")[0] + " x"
    (run / "sphere.8").write_text("\n".join(lines))
    target = tmp_path / "hydro.h5"
    assert call("import", run, "-o", target) == 2
    said = capsys.readouterr().out
    assert "sphere.8:11" in said
    assert "--accept second-order" in said
    assert not target.exists()
    assert call("import", run, "-o", target, "--accept", "second-order") == 0
    assert not hdb.read(target).second_order


def test_named_file_of_the_command(second_order, tmp_path, capsys):
    """Second step: tables of another program are added to a finished file."""
    run = second_order / "wecsim_mean_drift_sphere"
    target, other = tmp_path / "hydro.h5", tmp_path / "other.h5"
    assert call("import", run, "-o", target) == 0
    nine = run / "sphere.9"
    assert call("import", target, "-o", other, "--second-order", nine) == 0
    assert "mean: sphere.9 in place of sphere.7" in capsys.readouterr().out
    assert hdb.read(other).second_order["mean"].method == ("pressure",) * 6
    with refused("unsupported", file="sphere.GDF"):
        call("import", target, "-o", other, "--second-order", run / "sphere.GDF")


def test_pairs_of_headings_of_capytaine():
    """Conjugate of the file's e^{-iwt}, and of the pair in the other order."""
    from hydrodae.hdb.readers.capytaine_drift import read as read_extra
    from hydrodae.hdb.readers.quadratic import tabulate
    from hydrodae.hdb.readers.second_order import setting_of

    axes = {
        "omega": np.array([0.5, 1.0]),
        "wave_direction_k": np.array([0.0, 0.5]),
        "wave_direction_l": np.array([0.0, 0.5]),
    }
    values = np.array([[[1.0, 2.0 + 1.0j], [2.0 - 1.0j, 3.0]]] * 2)
    table = SourceTable(values, tuple(axes), axes)
    setting = setting_of(floating())
    (entries,) = read_extra(Path("a.nc"), {"drift_force_surge": table}, setting, [])
    made = tabulate(entries, setting)
    assert made is not None
    assert made.coordinates == ("float.surge",)
    pairs = list(zip(made.heading1, made.heading2, strict=True))
    assert made.values[0, pairs.index((0.0, 0.5)), 0] == 2.0 - 1.0j
    assert made.values[0, pairs.index((0.5, 0.0)), 0] == 2.0 + 1.0j


def cylinder_waves(k, radius, count=64):
    """Amplitudes of waves that a fixed cylinder to the bed scatters, at equal angles.

    MacCamy and Fuchs: eta_s = sum eps_m i^m S_m H_m(k r) cos(m theta), S_m = -J_m'(ka)/H_m'(ka).
    """
    from scipy.special import h1vp, jvp

    theta = 2.0 * np.pi * np.arange(count) / count
    orders = np.arange(0, int(4 * k * radius) + 25)
    scattered = -jvp(orders, k * radius) / h1vp(orders, k * radius)
    scattered[1:] *= 2.0
    return scattered @ np.cos(np.outer(orders, theta))


@pytest.mark.parametrize("depth", [np.inf, 3.0])
@pytest.mark.parametrize(
    ("ka", "value"),
    [
        (0.1, 0.00307), (0.2, 0.02393), (0.3, 0.07673), (0.4, 0.16678), (0.5, 0.28599),
        (0.6, 0.41393), (0.8, 0.60765), (1.0, 0.66493), (1.5, 0.60041), (2.0, 0.62717),
        (3.0, 0.63292), (5.0, 0.64376), (10.0, 0.65508),
    ],
)  # fmt: skip
def test_far_field_of_havelocks_cylinder(ka, value, depth):
    """F/(rho g a) of the fixed cylinder; to the bed 1 + 2 k h / sinh 2 k h times that."""
    from hydrodae.hdb.relations.far_field import horizontal_drift, momentum_factor

    gravity, rho = 9.81, 1000.0
    omega = np.sqrt(gravity * ka * (np.tanh(ka * depth) if np.isfinite(depth) else 1.0))
    k = wavenumber(np.array([omega]), depth, gravity)
    factor = momentum_factor(k, np.array([omega]), rho, gravity, depth)[0]
    # H = i mu f: mu by energy, of which a fixed body takes none
    kochin = 1j * rho * omega / factor * cylinder_waves(float(k[0]), 1.0) * -1j
    heading = np.array([0.0])
    drift = horizontal_drift(kochin[None, None], heading, np.array([omega]), rho, gravity, depth)[
        0, 0
    ]
    shallow = 1.0 if np.isinf(depth) else 1.0 + 2.0 * ka * depth / np.sinh(2.0 * ka * depth)
    assert drift[0] / (rho * gravity) == pytest.approx(value * shallow, rel=5e-3)
    assert abs(drift[1]) < 1e-9 * rho * gravity


def with_kochin(owner):
    """Made-up waves all round: diffraction of a cylinder, and radiation of heave."""
    theta = 2.0 * np.pi * np.arange(64) / 64
    k = owner.omega**2 / owner.gravity
    mu = owner.omega / (2.0 * np.pi * k**2)
    waves = np.stack([m * cylinder_waves(x, 2.0) for m, x in zip(mu, k, strict=True)])
    axes = {"omega": owner.omega, "theta": theta}
    diffraction = SourceTable(
        waves[:, None],
        ("omega", "wave_direction", "theta"),
        {**axes, "wave_direction": np.zeros(1)},
    )
    radiated = np.zeros((owner.omega.size, 6, 64), dtype=complex)
    radiated[:, 2] = 3.0
    dofs = tuple(label.rpartition(".")[2].capitalize() for label in owner.coordinates)
    radiation = SourceTable(
        radiated, ("omega", "radiating_dof", "theta"), {**axes, "radiating_dof": dofs}
    )
    force = np.zeros((owner.omega.size, 1, 6), dtype=complex)
    force[..., 2] = 2e4
    extra = {"kochin_diffraction": diffraction, "kochin_radiation": radiation}
    return replace(owner, extra=extra, diffraction=force)


@pytest.mark.parametrize("state", ["fixed", "free", "neither"])
def test_drift_of_the_fixed_or_the_free_body(state):
    """The report names the body whose far field the table is of."""
    from hydrodae.hdb.checks.fixed_and_free import far_fields

    owner = with_kochin(floating())
    known = {name: far for name, far in far_fields(owner).items() if far is not None}
    assert not np.allclose(known["fixed"][2], known["free"][2], rtol=0.2)
    omega, heading, drift = known["fixed" if state == "neither" else state]
    values = (drift[..., :1] * (2.0 if state == "neither" else 1.0)).astype(complex)
    table = SecondOrderTable(
        "mean", ("float.surge",), ("pressure",), omega, heading, heading, values,
        np.ones(values.shape, dtype=bool),
    )  # fmt: skip
    found = drift_findings(owner.with_second_order({"mean": table}))
    (finding,) = [f for f in found if "far field" in f.check]
    assert finding.message.startswith(
        "of neither" if state == "neither" else f"of the {state} body"
    )
    assert finding.severity == ("warning" if state == "neither" else "info")


def test_asymmetry_in_a_file(tmp_path):
    """The check of a finished file finds a triangle that was changed."""
    lines = [row(1.0, 0.5, 1, 2.0 + 1.0j), row(0.5, 0.5, 1, 1.0 + 0j), row(1.0, 1.0, 1, 3.0 + 0j)]
    table = read(floating(), write_rows(tmp_path / "a.12d", lines))["difference"]
    assert not [f for f in drift_findings(floating().with_second_order({"difference": table}))
                if f.severity == "error"]  # fmt: skip
    values = table.values.copy()
    values[0, 1] *= 1.01
    changed = {"difference": replace(table, values=values)}
    (error,) = [
        f for f in drift_findings(floating().with_second_order(changed)) if f.severity == "error"
    ]
    assert "not Hermitian" in error.message


def test_drift_of_a_file_of_capytaine(reference, tmp_path):
    """`drift_force_*` beside A and B becomes the table of mean drift."""
    with xr.open_dataset(reference / "hdb" / "own" / "sphere.nc") as opened:
        data = opened.load()
    one = np.zeros(1)
    axes = {"omega": data["omega"].values, "wave_direction_k": one, "wave_direction_l": one}
    for number, motion in enumerate(("surge", "sway", "yaw")):
        values = np.full((2, len(axes["omega"]), 1, 1), 10.0 + number)
        values[1] = 0.0
        data[f"drift_force_{motion}"] = xr.DataArray(
            values, dims=("complex", *axes), coords={**axes, "complex": data["complex"].values}
        )
    data.to_netcdf(tmp_path / "sphere.nc")
    db, report = hdb.import_database(tmp_path / "sphere.nc")
    table = db.second_order["mean"]
    assert [label.rpartition(".")[2] for label in table.coordinates] == ["surge", "sway", "yaw"]
    assert table.method == ("momentum",) * 3
    assert table.values[0, 0, 0] == 10.0
    assert report.find("second order")
