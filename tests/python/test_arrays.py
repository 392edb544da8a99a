"""Copies of a device on a layout, and databases whose far bodies are uncoupled."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.errors import refused

import hydrodae
from hydrodae import arrays, hdb
from hydrodae.case.tables import tables
from hydrodae.errors import CaseError
from hydrodae.hdb.bem import shapes
from hydrodae.hdb.hull.closed import closed_surface, write_stl

NODE = hdb.Cylinder(0.3, 0.6, -0.3)
UNITS = arrays.hexagonal(3, 2.0)


def device(directory: Path) -> hydrodae.Scene:
    """A float on a spring to an arm that hangs from a fixed point."""
    scene = hydrodae.Scene("float", directory=directory)
    scene.hydro(database="hydro.h5", radiation="constant", frequency=3.0)
    scene.body(
        "float",
        hydro="float",
        mass=173.887,
        center_of_gravity=[0, 0, -0.3],
        inertia=[9.1, 9.1, 7.8],
    )
    scene.body("arm", mass=5.0, center_of_gravity=[0.5, 0, 1.0], inertia=[0.1, 0.5, 0.5])
    scene.joint.revolute("hinge", body_a="ground", body_b="arm", point=[1, 0, 1], axis=[0, 1, 0])
    scene.force.spring_damper(
        "spring",
        body_a="float",
        body_b="arm",
        point_a=[0, 0, 0],
        point_b=[0, 0, 1],
        stiffness=300.0,
        damping=50.0,
    )
    scene.force.pto_linear("pto", joint="hinge", damping=10.0)
    scene.wave.regular("wave", height=0.02, period=2.1)
    scene.solver(end_time=2.0, rtol=1e-8)
    scene.output(step=0.1)
    return scene


@pytest.fixture(scope="module")
def array_database() -> hdb.HydroDatabase:
    places = arrays.places_of({"float": (0.0, 0.0)}, UNITS)
    water = hdb.Water(np.array([2.8, 2.9, 3.0, 3.1]), 3.0)
    return hdb.cylinders(places, NODE, water, modes=40, orders=2)[0]


def test_hexagonal_grid_is_as_dense_as_its_spacing() -> None:
    points = np.array(list(arrays.hexagonal(19, 3.0).values()))
    distance = np.linalg.norm(points[:, None] - points[None, :], axis=2)
    distance[np.arange(19), np.arange(19)] = np.inf
    assert distance.min() == pytest.approx(3.0)
    assert np.sum(np.isclose(distance[0], 3.0)) == 6
    assert np.linalg.norm(points, axis=1).max() == pytest.approx(6.0)


def test_copies_have_names_and_places_of_their_own(tmp_path: Path) -> None:
    text = arrays.place(device(tmp_path), UNITS, tmp_path).to_toml()
    found = tomllib.loads(text)
    (x, y) = UNITS["u2"]
    bodies = {entry["name"]: entry for entry in found["body"]}
    assert len(bodies) == 6
    assert bodies["u2_float"]["hydro"] == "u2_float"
    assert bodies["u2_arm"]["center_of_gravity"] == pytest.approx([0.5 + x, y, 1.0])
    hinge = next(entry for entry in found["joint"] if entry["name"] == "u2_hinge")
    assert (hinge["body_a"], hinge["body_b"]) == ("ground", "u2_arm")
    assert hinge["axis"] == [0, 1, 0]
    assert len(found["wave"]) == 1


def test_gauges_of_copies_stand_beside_them(tmp_path: Path) -> None:
    one = device(tmp_path)
    one.marker("tip", body="arm", point=[0.0, 0.0, 1.0])
    one.gauge("front", point=[-5.0, 1.0], ahead=[1.0])
    one.gauge("here")
    one.gauge("on", marker="tip")
    found = tomllib.loads(arrays.place(one, UNITS, tmp_path).to_toml())
    gauges = {entry["name"]: entry for entry in found["gauge"]}
    (x, y) = UNITS["u2"]
    assert gauges["u2_front"]["point"] == pytest.approx([x - 5.0, y + 1.0])
    assert gauges["u2_here"]["point"] == pytest.approx([x, y])
    assert gauges["u2_on"]["marker"] == "u2_tip"
    assert "point" not in gauges["u2_on"]


def test_only_names_of_channels_are_copied(tmp_path: Path) -> None:
    """A joint may be called as what it tells."""
    one = hydrodae.Scene("arm", directory=tmp_path)
    one.body("angle_rate", mass=1.0, center_of_gravity=[0, 0, 0], inertia=[1, 1, 1])
    one.joint.revolute(
        "angle", body_a="ground", body_b="angle_rate", point=[0, 0, 1], axis=[0, 1, 0]
    )
    one.controller.pid(
        "brake", inputs=["joints/angle/angle_rate"], outputs=["sea/elevation"], period=0.1
    )
    found = tomllib.loads(arrays.place(one, {"u": (0, 0)}, tmp_path).to_toml())
    (brake,) = found["controller"]
    assert brake["inputs"] == ["joints/u_angle/angle_rate"]
    assert brake["outputs"] == ["sea/elevation"]


def test_uncoupled_copies_move_as_one_device_alone(
    tmp_path: Path, array_database: hdb.HydroDatabase
) -> None:
    """Radiation within the units: each moves as alone, in the waves that reach it."""
    limited = arrays.limit(array_database, units=UNITS).database
    limited.write(tmp_path / "hydro.h5")
    scene = arrays.place(device(tmp_path), UNITS, tmp_path)
    together = hydrodae.run(scene)
    single = tmp_path / "single"
    single.mkdir()
    labels = [f"u2_float.{dof}" for dof in ("surge", "sway", "heave", "roll", "pitch", "yaw")]
    limited.select(labels).write(single / "hydro.h5")
    alone = hydrodae.run(arrays.place(device(single), {"u2": UNITS["u2"]}, single))
    for name in ("bodies/u2_float/position", "joints/u2_hinge/angle"):
        assert together[name].values == pytest.approx(alone[name].values, abs=1e-6)
    sizes = [run.statistics["nonzeros"] for run in (together, alone)]
    assert sizes[0] == len(UNITS) * sizes[1]  # a matrix in blocks, one for each unit
    array_database.write(tmp_path / "hydro.h5")
    coupled = hydrodae.run(arrays.place(device(tmp_path), UNITS, tmp_path))
    angle = "joints/u2_hinge/angle"
    assert np.abs(coupled[angle].values - alone[angle].values).max() > 1e-5


def test_copies_take_their_mesh_with_them(tmp_path: Path) -> None:
    """A box whose mass is off its middle pitches as it bobs; a mesh left behind would not lift."""
    hull, _ = closed_surface(shapes.box(1.0, length=4.0, width=2.0, draft=1.0), 1.0)
    write_stl(hull, tmp_path / "box.stl")
    device = hydrodae.Scene("box", directory=tmp_path)
    device.environment(water_density=1000.0)
    device.body(
        "box", motion="planar", mass="equilibrium", center_of_gravity=[0.1, 0.0, -0.3],
        radii_of_gyration=[0.6, 1.2, 1.2], mesh="box.stl", hydrostatics="mesh",
        initial={"displacement": [0.0, 0.0, 0.2]},
    )  # fmt: skip
    device.solver(end_time=3.0, rtol=1e-8)
    alone = hydrodae.run(device)
    both = hydrodae.run(arrays.place(device, {"a": (0.0, 0.0), "b": (30.0, -10.0)}, tmp_path))
    assert np.ptp(alone["bodies/box/rotation"].values[:, 1]) > 0.01
    for unit in "ab":
        copy = both[f"bodies/{unit}_box/rotation"].values
        np.testing.assert_allclose(copy, alone["bodies/box/rotation"].values, atol=1e-6)


def test_error_of_a_limited_interaction_is_what_is_left_out(
    array_database: hdb.HydroDatabase,
) -> None:
    near = arrays.limit(array_database, radius=2.5)
    assert (near.left_out, near.error) == (0.0, 0.0)
    far = arrays.limit(array_database, radius=1.0)
    assert far.left_out == 1.0
    a, b = array_database.added_mass, array_database.radiation_damping
    heave = array_database.index(["u1_float.heave", "u2_float.heave"])
    for table in (a, b):
        i, j = heave
        largest = np.sqrt(table[:, i, i].max() * table[:, j, j].max())
        assert far.error >= np.abs(table[:, i, j]).max() / largest
    assert far.error < 1.0
    assert np.all(far.database.added_mass[:, heave[0], heave[1]] == 0.0)
    assert "100 % of the pairs uncoupled" in str(far)


def test_every_name_and_place_of_the_tables_is_known() -> None:
    """A key that is added to the tables has to be known here, or copies would share it."""
    words = set(
        """
        type motion coordinate coordinate_b level axes surface file mesh protocol role host law
        fmu_inputs fmu_outputs parameters text_parameters text_values
        """.split()
    )
    for table in (t for t in tables() if t.name in arrays.OF_UNITS):
        for kind in (table, *table.types):
            for key in kind.keys:
                if key.kind in ("word", "words") and not key.choices:
                    known = {*arrays.REFERENCES, *arrays.CHANNELS, *words}
                    assert key.name in known, f"{kind.name}.{key.name}"
                places = key.unit == "m" and key.name != "radii_of_gyration"
                if places and key.kind in ("vector3", "points"):
                    assert key.name in arrays.PLACES, f"{kind.name}.{key.name}"


def test_impossible_arrays_are_refused(tmp_path: Path, array_database: hdb.HydroDatabase) -> None:
    with pytest.raises(CaseError, match="at least one unit"):
        arrays.place(device(tmp_path), {}, tmp_path)
    wrong: list[tuple[Any, str]] = [
        ({"a.b": (0, 0)}, r"unit 'a\.b'"),
        ({1: (0, 0)}, "unit 1: expected a name"),
        ([(0, 0)], "expected a dict"),
        ({"a": (0, np.nan)}, r"unit 'a': expected x, y \[m\]"),
        ({"a": ("here", 0)}, "unit 'a': expected x, y"),
        ({"a": (0, 0, 1)}, "unit 'a': expected x, y"),
        ({"a": (0, 0), "b": (0, 0)}, "'a' and 'b' are at the same place"),
        ({"a": (0, 0), "a_b": (1, 0)}, "'a_b' begins with the name of unit 'a'"),
    ]
    for units, message in wrong:
        with pytest.raises(CaseError, match=message):
            arrays.place(device(tmp_path), units, tmp_path)
        with pytest.raises(CaseError, match=message):
            arrays.places_of({"float": (0, 0)}, units)
    for radius in (-1.0, np.nan):  # all uncoupled, bodies from themselves too
        with refused("option", "limit"):
            arrays.limit(array_database, radius=radius)
    with refused("label"):
        arrays.limit(array_database, units={"x": (0, 0)})
    with refused("option", "limit"):
        arrays.limit(array_database)
    grids: list[tuple[Any, Any]] = [(0, 1.0), (2.5, 1.0), (3, np.inf), (3, "far")]
    for count, spacing in grids:
        with pytest.raises(CaseError, match="expected an integer > 0 and a finite number > 0"):
            arrays.hexagonal(count, spacing)


def test_channels_of_a_unit_have_the_names_of_the_device() -> None:
    results = {
        "bodies/u1_flap/position": 1,
        "bodies/u11_flap/position": 2,
        "energy/work/u1_pto": 3,
        "forces/u1_mooring/u1_flap/force": 4,
        "joints/u1_hinge/u1_rate": 5,  # a quantity that begins as the unit does
    }
    first = arrays.unit(results, 1)
    assert first.channels() == [
        "bodies/flap/position",
        "energy/work/pto",
        "forces/mooring/flap/force",
        "joints/hinge/u1_rate",
    ]
    assert first["forces/mooring/flap/force"] == 4
    assert first["bodies/flap/position"] == 1
    assert arrays.unit(results, "u11")["bodies/flap/position"] == 2
    with pytest.raises(KeyError, match=r"unit 'u1' has no channel 'bodies/flop/position'; did you"):
        first["bodies/flop/position"]
    with pytest.raises(CaseError, match=r"unit 'u7': nothing .* the bodies are u11_flap, u1_flap"):
        arrays.unit(results, 7)
