"""Meshes of HAMS, and hydrostatics from the mesh of a run, against a box in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from hydrodae.hdb.hull.mesh_statics import mesh_statics
from hydrodae.hdb.hull.meshes import read_mesh
from hydrodae.hdb.readers.reading import read_source

#: Length, width and draught of a box [m].
LENGTH, WIDTH, DRAUGHT = 8.0, 6.0, 2.0
RHO, GRAVITY = 1025.0, 9.81
CONTROL = """   Waterdepth  -1.D0
    Output_frequency_type       3
    Reference_body_center       0.000       0.000      -1.000
    Reference_body_length   1.D0
"""


def walls(x_from, y_from):
    """Panels (n, 4, 3) of the box from x_from and y_from on, without its planes of symmetry."""
    x, y, z = (x_from, LENGTH / 2), (y_from, WIDTH / 2), (-DRAUGHT, 0.0)
    found = [[(x[0], y[0], z[0]), (x[0], y[1], z[0]), (x[1], y[1], z[0]), (x[1], y[0], z[0])]]
    ends = [(x[1], 1)] if x_from == 0.0 else [(x[0], -1), (x[1], 1)]
    sides = [(y[1], 1)] if y_from == 0.0 else [(y[0], -1), (y[1], 1)]
    for at, turn in ends:
        wall = [(at, y[0], z[0]), (at, y[1], z[0]), (at, y[1], z[1]), (at, y[0], z[1])]
        found.append(wall[::turn])
    for at, turn in sides:
        wall = [(x[1], at, z[0]), (x[0], at, z[0]), (x[0], at, z[1]), (x[1], at, z[1])]
        found.append(wall[::turn])
    return found


def write_pnl(path, symmetric=(0, 0), *, panels=None):
    isx, isy = symmetric
    panels = panels or walls(0.0 if isx else -LENGTH / 2, 0.0 if isy else -WIDTH / 2)
    nodes = sorted({corner for panel in panels for corner in panel})
    lines = ["    --------------Hull Mesh File---------------", ""]
    lines += ["    # Number of Panels, Nodes, X-Symmetry and Y-Symmetry"]
    lines += [f"   {len(panels)}   {len(nodes)}   {isx}   {isy}", ""]
    lines += ["    #Start Definition of Node Coordinates     ! node_number   x   y   z"]
    lines += [f"  {i} " + " ".join(f"{v:.6f}" for v in n) for i, n in enumerate(nodes, 1)]
    lines += ["   #End Definition of Node Coordinates", ""]
    lines += ["   #Start Definition of Node Relations   ! panel_number number_of_vertices"]
    for i, panel in enumerate(panels, 1):
        corners = list(dict.fromkeys(panel))
        numbers = " ".join(str(nodes.index(c) + 1) for c in corners)
        lines.append(f"  {i}  {len(corners)}  {numbers}")
    lines += ["   #End Definition of Node Relations", "    ------End Hull Mesh File------"]
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize("symmetric", [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_a_box_of_hams_and_its_halves(tmp_path, symmetric):
    write_pnl(tmp_path / "HullMesh.pnl", symmetric)
    statics = mesh_statics(read_mesh(tmp_path / "HullMesh.pnl"), np.zeros(3))
    assert statics.displaced_volume == pytest.approx(LENGTH * WIDTH * DRAUGHT)
    assert statics.waterplane_area == pytest.approx(LENGTH * WIDTH)
    np.testing.assert_allclose(statics.center_of_buoyancy, [0, 0, -DRAUGHT / 2], atol=1e-12)
    second = [LENGTH**3 * WIDTH / 12.0, LENGTH * WIDTH**3 / 12.0]
    np.testing.assert_allclose(statics.waterplane_moments[2:4], second)


def test_triangles_of_hams(tmp_path):
    quads = walls(-LENGTH / 2, -WIDTH / 2)
    triangles = [t for a, b, c, d in quads for t in ([a, b, c], [a, c, d])]
    write_pnl(tmp_path / "HullMesh.pnl", panels=triangles)
    statics = mesh_statics(read_mesh(tmp_path / "HullMesh.pnl"), np.zeros(3))
    assert statics.displaced_volume == pytest.approx(LENGTH * WIDTH * DRAUGHT)


def run_of_hams(root, *, area=LENGTH * WIDTH, force=1.0):
    """Write heave tables whose long-wave force is that of the box, times `force`."""
    for name in ("Input", "Output/Wamit_format"):
        (root / name).mkdir(parents=True)
    (root / "Input" / "ControlFile.in").write_text(CONTROL)
    write_pnl(root / "Input" / "HullMesh.pnl", (1, 1))
    added, volume = 30.0, LENGTH * WIDTH * DRAUGHT
    radiation, excitation = [], []
    for w in np.linspace(0.2, 1.1, 10):
        heave = force * (LENGTH * WIDTH - w**2 * (volume + added) / GRAVITY)
        damping = w**2 / GRAVITY * heave**2 * GRAVITY / (4 * w * 0.5 * GRAVITY / w)
        radiation.append(f"{w:.6E} 3 3 {added:.6E} {damping:.6E}")
        excitation.append(f"{w:.6E} 0.0 3 {heave:.6E} 0.0 {heave:.6E} 0.0")
    tables = root / "Output" / "Wamit_format"
    (tables / "Buoy.1").write_text("\n".join(radiation) + "\n")
    (tables / "Buoy.3").write_text("\n".join(excitation) + "\n")
    rows = [f"{i} {j} {area if i == j == 3 else 0.0}" for i in range(1, 7) for j in range(1, 7)]
    (tables / "Buoy.hst").write_text("\n".join(rows) + "\n")


def test_hydrostatics_of_the_mesh_of_the_run(tmp_path):
    run_of_hams(tmp_path)
    data = read_source(tmp_path)
    statics, point = data.hydrostatics["Buoy"]
    np.testing.assert_array_equal(point, [0.0, 0.0, -1.0])
    assert statics.displaced_volume == pytest.approx(LENGTH * WIDTH * DRAUGHT)
    assert data.meshes["Buoy"].shape == (12, 4, 3)
    (found,) = [f for f in data.findings if "taken from its mesh" in f.message]
    assert found.severity == "info"
    assert "long-wave heave force is 1.000 of what follows" in found.message


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"area": 30.0}, "its stiffness in heave is that of 30 m2"),
        ({"force": 1.3}, "long-wave heave force is 1.30 of that"),
    ],
)
def test_the_mesh_of_another_hull_is_not_taken(tmp_path, options, message):
    run_of_hams(tmp_path, **options)
    data = read_source(tmp_path)
    assert data.hydrostatics == {}
    (found,) = [f for f in data.findings if f.check == "hydrostatics"]
    assert message in found.message
    assert "--mesh Buoy=FILE" in found.message


def test_a_gdf_of_wamit_is_in_the_axes_of_the_body(tmp_path):
    run_of_hams(tmp_path)
    tables = tmp_path / "Output" / "Wamit_format"
    panels = np.array(walls(0.0, 0.0)) - np.array([0.0, 0.0, -1.0])
    rows = "\n".join(" ".join(f"{v:.6f}" for v in corner) for corner in panels.reshape(-1, 3))
    (tables / "Buoy.gdf").write_text(f"box\n1.0 9.81\n1 1\n{len(panels)}\n{rows}\n")
    (tmp_path / "Input" / "HullMesh.pnl").unlink()
    statics, _ = read_source(tmp_path).hydrostatics["Buoy"]
    np.testing.assert_allclose(statics.center_of_buoyancy, [0, 0, -DRAUGHT / 2], atol=1e-12)
