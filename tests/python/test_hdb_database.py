"""The database: moving points, choosing coordinates, names, the file hydro.h5."""

from __future__ import annotations

import dataclasses

import h5py
import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.database import files
from hydrodae.hdb.database.convolution import RadiationKernel
from hydrodae.hdb.database.coordinates import skew
from hydrodae.hdb.labels import DOFS, Label
from hydrodae.hdb.memory import ExponentialMemory
from hydrodae.hdb.relations.dispersion import frequency, wavenumber

RHO, G = 1025.0, 9.81


def hydrostatics(db, name):
    return db.bodies[name].hydrostatics


def rigid_mass(mass, inertia, center, point):
    """Mass matrix (6, 6) about a point, of a rigid body with its centre of gravity elsewhere."""
    r = skew(np.asarray(center, dtype=float) - np.asarray(point, dtype=float))
    m = np.zeros((6, 6))
    m[:3, :3] = mass * np.eye(3)
    m[3:, :3] = mass * r
    m[:3, 3:] = -mass * r
    m[3:, 3:] = inertia - mass * r @ r
    return m


def box(point, at=(3.0, 1.0), length=4.0, width=2.0, draught=1.5):
    """Hydrostatics of a floating box centred at `at`, moments about `point`."""
    x, y = at[0] - point[0], at[1] - point[1]
    area = length * width
    moments = [
        area * x,
        area * y,
        width * length**3 / 12 + area * x**2,
        length * width**3 / 12 + area * y**2,
        area * x * y,
    ]
    center = np.array([*at, -0.5 * draught])
    return hdb.Hydrostatics(area * draught, center, area, np.array(moments))


CENTERS = {"a": np.array([1.0, 2.0, -3.0]), "b": np.array([-4.0, 0.5, 1.0])}
FORCE = {"a": np.array([1.0, 2j, 3.0]), "b": np.array([2.0, 1.0, 1j])}


def make(points=None, **changes):
    """A database that looks like two rigid masses and two forces at known points."""
    points = points or {"a": np.zeros(3), "b": np.array([5.0, 0.0, 0.0])}
    inertia = np.array([[5.0, 0.2, 0.1], [0.2, 6.0, 0.3], [0.1, 0.3, 7.0]])
    one = np.zeros((12, 12))
    f = np.zeros(12, dtype=complex)
    for k, name in enumerate(points):
        s = slice(6 * k, 6 * k + 6)
        one[s, s] = rigid_mass(10.0 + k, inertia, CENTERS[name], points[name])
        f[s] = np.r_[FORCE[name], np.cross(CENTERS[name] - points[name], FORCE[name])]
    omega = np.array([0.5, 1.0, 1.5, 2.0])
    tables = omega[:, None, None] * one
    fields = {
        "coordinates": tuple(f"{b}.{d}" for b in points for d in DOFS),
        "omega": omega,
        "added_mass": tables,
        "radiation_damping": 2.0 * tables,
        "added_mass_inf": one,
        "added_mass_inf_std": 0.01 * np.abs(one),
        "heading": np.array([0.0, 1.0]),
        "froude_krylov": omega[:, None, None] * f * np.ones((1, 2, 1)),
        "diffraction": 1j * omega[:, None, None] * f * np.ones((1, 2, 1)),
        "bodies": {n: hdb.Body(n, p, box(p)) for n, p in points.items()},
        "rho": RHO,
        "gravity": G,
    }
    return hdb.HydroDatabase(**{**fields, **changes})


def fit_of(db, inputs):
    rng = np.random.default_rng(3)
    shape = (2, len(inputs)), (len(db.coordinates), 2)
    b, c = (rng.standard_normal(s) + 1j * rng.standard_normal(s) for s in shape)
    i = db.index(inputs)
    return ExponentialMemory(
        name="fit",
        inputs=tuple(inputs),
        outputs=db.coordinates,
        poles=np.array([-0.3 + 1j, -0.5]),
        input_matrix=np.array([b[0], b[1].real]),
        output_matrix=np.stack([c[:, 0], c[:, 1].real.astype(complex)], axis=1),
        added_mass_inf=db.added_mass_inf[:, i],
        report={
            "n_states": 3,
            "passive": True,
            "h_error_band": 0.01,
            "method": "test",
            "band": (0.1, 2.0),
            "groups": ("a", "b.x"),
            "dropped": (),
        },
    )


def test_moved_tables_are_those_computed_about_the_new_points():
    new = {"a": np.array([0.3, -1.0, 2.0]), "b": np.array([1.0, 1.0, 1.0])}
    moved, expected = make().moved_to(new), make(new)
    for name in ("added_mass", "radiation_damping", "added_mass_inf", "excitation"):
        np.testing.assert_allclose(getattr(moved, name), getattr(expected, name), atol=1e-10)
    for body in new:
        k = moved.hydrostatic_stiffness(body)
        np.testing.assert_allclose(k, expected.hydrostatic_stiffness(body), atol=1e-8)


def test_box_stiffness_in_closed_form():
    at = np.array([3.0, 1.0, -0.2])  # on the box's own axis
    k = make().moved_to({"a": at}).hydrostatic_stiffness("a") / (RHO * G)
    volume, lever = 12.0, -0.75 + 0.2
    assert k[2, 2] == pytest.approx(8.0)
    assert k[3, 3] == pytest.approx(4 * 2**3 / 12 + volume * lever)
    assert k[4, 4] == pytest.approx(2 * 4**3 / 12 + volume * lever)
    np.testing.assert_allclose(k - np.diag(np.diag(k)), 0.0, atol=1e-12)


def test_stiffness_is_the_change_of_buoyancy_under_a_small_rotation():
    # oracle: integrate the pressure over a tilted box numerically, about an eccentric point
    point = np.array([1.0, 0.4, -0.3])
    hs = box(point)
    n = 200
    x = 3.0 + 4.0 * ((np.arange(n) + 0.5) / n - 0.5)
    y = 1.0 + 2.0 * ((np.arange(n) + 0.5) / n - 0.5)
    xx, yy = np.meshgrid(x - point[0], y - point[1], indexing="ij")
    cell = 8.0 / n**2
    k = hs.stiffness(point, RHO, G)
    for axis in (3, 4, 5):
        angle = 1e-4
        # vertical change of each column: roll lifts +y, pitch lowers +x, yaw nothing
        lift = angle * {3: yy, 4: -xx, 5: 0.0 * xx}[axis]
        up = -RHO * G * lift * cell
        change = np.array([up.sum(), (up * yy).sum(), (-up * xx).sum()])
        # the displaced volume itself moves with the body: V at its centre, turned
        r = hs.center_of_buoyancy - point
        turn = np.cross(np.eye(3)[axis - 3] * angle, r)
        force = RHO * G * hs.displaced_volume
        change[1:] += np.cross(turn, [0, 0, force])[:2]
        expected = change / angle
        found = -k[2:5, axis]
        np.testing.assert_allclose(found, expected, rtol=2e-4, atol=1.0)


def test_hydrostatics_invert_their_stiffness():
    point = np.array([1.0, -2.0, 0.5])
    hs = box(point)
    back = hdb.Hydrostatics.from_stiffness(
        hs.stiffness(point, RHO, G), point, 12.0, hs.center_of_buoyancy, RHO, G
    )
    np.testing.assert_allclose(back.waterplane_moments, hs.waterplane_moments)
    assert back.waterplane_area == pytest.approx(8.0)


def test_moving_there_and_back_changes_nothing():
    db = make()
    db.memory["fit"] = fit_of(db, db.coordinates[:6])
    there = db.moved_to({"a": (1, 2, 3), "b": (0, 0, 1)})
    back = there.moved_to({"a": (0, 0, 0), "b": (5, 0, 0)})
    np.testing.assert_allclose(back.added_mass, db.added_mass, atol=1e-9)
    for name in ("input_matrix", "output_matrix", "added_mass_inf"):
        a, b = getattr(back.memory["fit"], name), getattr(db.memory["fit"], name)
        np.testing.assert_allclose(a, b, atol=1e-9)
        assert np.abs(getattr(there.memory["fit"], name) - b).max() > 0.1


def test_moved_fit_gives_the_transported_memory():
    db = make()
    db.memory["fit"] = fit = fit_of(db, db.coordinates)
    moved = db.moved_to({"a": (1, 2, 3)}).memory["fit"]
    # a motion about the new point (0..2 velocity of the point (1, 2, 3), 3..5 rotation)
    u_new = np.arange(1.0, 13.0)
    u_old = u_new.copy()
    u_old[:3] = u_new[:3] + np.cross(u_new[3:6], np.array([0, 0, 0]) - np.array([1, 2, 3]))
    f_old = fit.output_matrix @ (fit.input_matrix @ u_old)
    f_new = f_old.copy()
    f_new[3:6] = f_old[3:6] + np.cross(np.array([0, 0, 0]) - np.array([1, 2, 3]), f_old[:3])
    np.testing.assert_allclose(moved.output_matrix @ (moved.input_matrix @ u_new), f_new)


def test_a_move_that_needs_a_missing_coordinate_is_an_error():
    db = make().select(["a.heave", "a.pitch", "b.heave"])
    with refused("missing", "a.surge"):
        db.moved_to({"a": (0, 0, 1)})
    # in x, pitch couples with heave only, and translations do not mind
    moved = db.moved_to({"a": (1, 0, 0), "b": (9, 9, 9)})
    full = make().moved_to({"a": (1, 0, 0)})
    np.testing.assert_allclose(moved.added_mass[:, 1, 1], full.added_mass[:, 4, 4])


def test_select_and_reorder():
    db = make()
    db.memory["fit"] = fit_of(db, ["a.heave", "a.pitch"])
    part = db.select(["b.heave", "a.pitch"])
    assert list(part.bodies) == ["b", "a"]
    assert part.added_mass[0, 1, 1] == db.added_mass[0, 4, 4]
    assert part.excitation[1, 0, 0] == db.excitation[1, 0, 8]
    assert part.memory["fit"].inputs == ("a.pitch",)
    np.testing.assert_array_equal(
        part.memory["fit"].output_matrix, db.memory["fit"].output_matrix[[4, 8]]
    )
    with refused("label", "coordinates"):
        db.reordered(db.coordinates[:4])
    back = db.reordered(db.coordinates[::-1]).reordered(db.coordinates)
    np.testing.assert_array_equal(back.added_mass, db.added_mass)


def test_names_that_are_not_there_come_with_the_nearest():
    db = make().renamed({"a": "float", "b": "spar"})
    assert db.coordinates[6] == "spar.surge"
    assert db.index("spar.heave") == [8]
    with pytest.raises(DatabaseError, match=r"'spar.heav'.*did you mean 'spar.heave'"):
        db.index(["float.heave", "spar.heav"])
    with pytest.raises(DatabaseError, match=r"no body 'flaot'.*did you mean 'float'"):
        db.moved_to({"flaot": (0, 0, 0)})
    with refused("label", "names"):
        db.renamed({"float": "spar"})


def test_shorthands_of_coordinates():
    labels = make().select(["a.surge", "a.heave", "a.pitch", "b.yaw", "b.roll"]).coordinates
    assert hdb.expand("a.planar, b.lateral", labels) == [
        *("a.surge", "a.heave", "a.pitch"),
        *("b.roll", "b.yaw"),
    ]
    assert hdb.expand("a.pitch,a.all", labels) == ["a.pitch", "a.surge", "a.heave"]
    assert hdb.expand("all", labels) == list(labels)
    with refused("label", "b.planar"):
        hdb.expand("b.planar", labels)
    with refused("label", "c"):
        hdb.expand("c.all", labels)
    with refused("label", "a.ptich"):
        hdb.expand("a.ptich", labels)


@pytest.mark.parametrize("single", [False, True])
def test_round_trip_of_the_file(tmp_path, single):
    db = make(source="f", source_sha256="ab", title="t", excitation_split=False, water_depth=30.0)
    labels = ("a.heave", "b.pitch")
    kernel = RadiationKernel(
        np.linspace(0, 1, 9), np.ones((9, 2, 1)) / 3.0, labels[:1], labels, np.eye(2)[:, :1] / 7.0
    )
    db = dataclasses.replace(db, kernel=kernel)
    db.memory["flaps"] = fit_of(db, ["a.heave", "b.pitch"])
    db.write(tmp_path / "hydro.h5", single=single)
    back = hdb.read(tmp_path / "hydro.h5")
    for field in dataclasses.fields(db):
        a, b = getattr(db, field.name), getattr(back, field.name)
        if isinstance(a, np.ndarray):
            exact = not single or field.name in ("omega", "added_mass_inf")
            np.testing.assert_allclose(b, a, rtol=0 if exact else 1e-7, err_msg=field.name)
        elif field.name == "bodies":
            assert list(a) == list(b)
            for name in a:
                np.testing.assert_array_equal(b[name].reference_point, a[name].reference_point)
                np.testing.assert_array_equal(
                    b[name].hydrostatics.waterplane_moments, a[name].hydrostatics.waterplane_moments
                )
        elif field.name not in ("memory", "kernel"):
            assert a == b, field.name
    assert back.kernel is not None
    for name in ("time", "added_mass_inf"):
        np.testing.assert_array_equal(getattr(back.kernel, name), getattr(kernel, name))
    np.testing.assert_allclose(back.kernel.values, kernel.values, rtol=1e-7 if single else 0)
    assert (back.kernel.inputs, back.kernel.outputs) == (kernel.inputs, kernel.outputs)
    a, b = db.memory["flaps"], back.memory["flaps"]
    for name in ("poles", "input_matrix", "output_matrix", "added_mass_inf"):
        np.testing.assert_array_equal(getattr(b, name), getattr(a, name))
    assert (b.inputs, b.outputs) == (a.inputs, a.outputs)
    assert all(b.report[key] == value for key, value in a.report.items())
    assert files.is_single(tmp_path / "hydro.h5") == single


def test_the_file_is_what_the_solver_expects(tmp_path):
    make().write(tmp_path / "hydro.h5")
    with h5py.File(tmp_path / "hydro.h5") as f:
        assert f.attrs["format"] == "hydrodae-hydro"
        assert f.attrs["format_version"] == 1
        assert np.isinf(f.attrs["water_depth"])
        assert f["coordinates"].dtype == "S32"
        assert f["excitation/diffraction"].dtype == np.complex128
        assert f["added_mass"].attrs["unit"] == "kg, kg m, kg m2"
        assert "radiation_kernel" not in f
        body = f["bodies/b"]
        assert body.attrs["index"] == 1
        assert body["hydrostatic_stiffness"].shape == (6, 6)
        np.testing.assert_allclose(body.attrs["reference_point"], [5, 0, 0])


def test_files_are_small_in_single_precision(tmp_path, reference):
    db = hdb.read(reference / "hdb" / "own" / "4n3la.nc")
    db.write(tmp_path / "double.h5")
    db.write(tmp_path / "single.h5", single=True)
    sizes = [(tmp_path / f"{k}.h5").stat().st_size for k in ("double", "single")]
    assert sizes[1] < 0.6 * sizes[0]


def test_wrong_files_are_refused(tmp_path):
    with refused("missing", file="hydro.h5"):
        hdb.HydroDatabase.read(tmp_path / "hydro.h5")
    with h5py.File(tmp_path / "x.h5", "w") as f:
        f.attrs["format"] = "something"
    with refused("format", file="x.h5"):
        hdb.HydroDatabase.read(tmp_path / "x.h5")
    make().write(tmp_path / "y.h5")
    with h5py.File(tmp_path / "y.h5", "a") as f:
        del f["heading"]
    with refused("missing", "heading", file="y.h5"):
        hdb.HydroDatabase.read(tmp_path / "y.h5")
    with refused("missing", "folder"):
        make().write(tmp_path / "nowhere" / "z.h5")


@pytest.mark.parametrize(
    ("changes", "reason", "subject"),
    [
        ({"omega": np.array([1.0, 0.5, 2.0, 3.0])}, "frequencies", ""),
        ({"heading": np.zeros(3)}, "shape", "froude_krylov"),
        ({"added_mass_inf": np.full((12, 12), np.nan)}, "not_finite", "added_mass_inf"),
        ({"rho": -1.0}, "value", "water"),
        ({"coordinates": ("a.surge",) * 12}, "label", "coordinates"),
        ({"coordinates": ("a.warp", *make().coordinates[1:])}, "label", "a"),
    ],
)
def test_inconsistent_tables_are_refused(changes, reason, subject):
    with refused(reason, subject):
        make(**changes)


def test_summary_names_bodies_water_and_headings():
    text = make(title="two masses").summary()
    for word in ("two masses", "infinitely deep", "a: surge", "57.3", "displaces 12 m3"):
        assert word in text


@pytest.mark.parametrize("depth", [0.5, 20.0, 1000.0, np.inf])
def test_dispersion_relation(depth):
    w = np.array([1e-3, 0.02, 0.5, 1.0, 3.0, 9.0])
    k = wavenumber(w, depth, G)
    t = np.tanh(k * depth) if np.isfinite(depth) else 1.0
    np.testing.assert_allclose(G * k * t, w**2, rtol=1e-12)
    np.testing.assert_allclose(frequency(k, depth, G), w, rtol=1e-12)


@pytest.mark.parametrize(
    ("mesh", "reason"), [(np.zeros((0, 4, 3)), "mesh"), (np.zeros((2, 3, 3)), "shape")]
)
def test_a_mesh_has_panels(mesh, reason):
    with refused(reason, "a"):
        hdb.Body("a", mesh=mesh)


@pytest.mark.parametrize(
    ("text", "dof", "kind"),
    [
        ("a.heave", 2, "translation"),
        ("a.b.yaw", 5, "rotation"),
        ("a.mode7", 6, "mode"),
        ("a.bend", 6, "mode"),
    ],
)
def test_a_label_is_a_body_and_what_it_does(text, dof, kind):
    label = Label.read(text)
    assert str(label) == text
    assert (label.body, label.dof) == (text[: -len(label.motion) - 1], dof)
    assert [k for k in ("translation", "rotation", "mode") if getattr(label, f"is_{k}")] == [kind]


@pytest.mark.parametrize("text", ["heave", ".heave", "a."])
def test_what_is_no_label_is_refused(text):
    with refused("label", text):
        Label.read(text)
