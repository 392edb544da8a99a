"""Listings of AQWA of several structures, and its units, on small hand-made files."""

from __future__ import annotations

import numpy as np
import pytest
from tests.errors import refused

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.reading import read_source

OMEGA = np.array([0.4, 0.8, 1.2, 1.6])
CENTERS = {1: (0.0, 2.0, -1.0), 2: (10.0, 0.0, -3.0)}
ROWS = ("X", "Y", "Z", "RX", "RY", "RZ")


def block(seed, force, moving, omega):
    """A table of six rows (forces) and columns (motions), in kg: its own for each pair."""
    entries = np.arange(36.0).reshape(6, 6) + 40.0 * seed + 1000.0 * force + 100.0 * moving
    return np.round(entries * (1.0 + omega), 1)


def page(structure, *parts):
    title = "H Y D R O D Y N A M I C   P A R A M E T E R S   F O R   S T R U C T U R E"
    return ["1", f"      * * * * {title}   {structure} * * * *", "      - - -", "", *parts]


def matrix(title, values):
    lines = [title, "-" * len(title), "", "    X    Y    Z   RX   RY   RZ", "    " + "-" * 60, ""]
    for name, row in zip(ROWS, values, strict=True):
        lines += [f"  {name:>2s}  " + "  ".join(f"{v:12.4E}" for v in row), ""]
    return lines


def radiation(structure, omega, scale, others):
    state = f"     WAVE PERIOD = {2 * np.pi / omega:7.3f}   WAVE FREQUENCY = {omega:7.4f}"
    lines = []
    for k in others:
        for seed, word in enumerate(("ADDED MASS", "DAMPING")):
            title = f"H/I {word} FOR FORCE ON STR#  {k}"
            head = page(structure, state, "") if seed == 0 else [""]
            lines += head + matrix(title, block(seed, k, structure, omega) / scale)
    lines += page(structure, state, "")
    lines += matrix("ADDED  MASS", block(0, structure, structure, omega) / scale)
    return lines + matrix("DAMPING", block(1, structure, structure, omega) / scale)


def forces(structure, scale):
    lines = []
    for factor, word in ((1.0, "DIFFRACTION"), (2.0, "FROUDE KRYLOV")):
        lines += page(structure, f"     {word} FORCES-VARIATION WITH WAVE PERIOD/FREQUENCY", "-")
        for i, w in enumerate(OMEGA):
            pairs = [(factor * structure * (j + 1) * 1e3 / scale, 30.0 * j) for j in range(6)]
            words = "".join(f"  {a:8.2E} {p:8.2f}" for a, p in pairs)
            heading = "      0.00" if i == 0 else " " * 10
            lines.append(f"{2 * np.pi / w:8.2f} {w:7.3f} {heading}{words}")
    return lines


def listing(path, *, scale=1.0, coupled=True, left_out=(), rho=1000.0, gravity=9.81):
    lines = [
        "     WATER  DEPTH . . . . . =      70.000",
        f"     DENSITY  OF  WATER . . . . =    {rho / scale:.3f}",
        f"     ACCELERATION  DUE  TO GRAVITY . . . =       {gravity:.3f}",
    ]
    for s, g in CENTERS.items():
        lines += ["1", "  * * * * F O R   S T R U C T U R E   " + f"{s} * * * *"]
        lines.append(f"  STRUCTURE C.O.G.   GX= {g[0]:9.4f}  GY= {g[1]:9.4f}  GZ= {g[2]:9.4f}")
        lines.append(f"  MESH BASED DISPLACEMENT  . . .   =   {8.0 * s:.5E}")
        lines.append(f"  POSITION OF THE CENTRE OF BUOYANCY      BX =    {g[0]:.4f}")
        lines += [f"      BY =     {g[1]:.4f}", "      BZ =     -1.5"]
    for s in CENTERS:
        stiffness = np.diag([0.0, 0.0, 4e4 * s, 1e4, 1e4, 0.0]) / scale
        lines += page(s, *matrix("STIFFNESS MATRIX", stiffness))
        for w in OMEGA:
            others = [k for k in CENTERS if k != s and coupled and (k, s, w) not in left_out]
            lines += radiation(s, w, scale, others)
        lines += forces(s, scale)
    path.write_text("\n".join(lines) + "\n")
    return path


def test_two_structures_are_coupled(tmp_path):
    data = read_source(listing(tmp_path / "two.LIS"))
    assert data.coordinates[:2] == ("structure1.surge", "structure1.sway")
    np.testing.assert_allclose(data.omega, OMEGA)
    for w, a, b in zip(OMEGA, data.added_mass, data.radiation_damping, strict=True):
        for i in (1, 2):
            for j in (1, 2):
                at = np.s_[6 * i - 6 : 6 * i, 6 * j - 6 : 6 * j]
                np.testing.assert_allclose(a[at], block(0, i, j, w), rtol=1e-4)
                np.testing.assert_allclose(b[at], block(1, i, j, w), rtol=1e-4)
    assert data.hydrostatics["structure2"][0].displaced_volume == 16.0
    assert data.reference_points["structure2"] == pytest.approx(CENTERS[2])
    assert data.froude_krylov is not None
    # the phase counts from the centre of gravity, 10 m along the waves
    heave = data.froude_krylov[3, 0, data.coordinates.index("structure2.heave")]
    k = OMEGA[3] ** 2 / 9.81
    np.testing.assert_allclose(heave, 12e3 * np.exp(-1j * (np.radians(60.0) + 10.0 * k)))


def test_tonnes_are_kilograms_in_the_end(tmp_path):
    kilograms = read_source(listing(tmp_path / "kg.LIS"))
    tonnes = read_source(listing(tmp_path / "t.LIS", scale=1000.0))
    assert tonnes.rho == 1000.0
    for name in ("added_mass", "radiation_damping", "froude_krylov", "diffraction"):
        np.testing.assert_allclose(getattr(tonnes, name), getattr(kilograms, name), rtol=1e-3)
    areas = [d.hydrostatics["structure1"][0].waterplane_area for d in (kilograms, tonnes)]
    assert areas[0] == pytest.approx(areas[1])
    with refused("units", "density"):
        hdb.read(listing(tmp_path / "feet.LIS", gravity=32.2))


def test_tonnes_in_the_numeric_file(reference, tmp_path):
    """RM3 in tonnes: every number with a mass or a force in it is a thousandth."""
    source = (reference / "hdb" / "rm3_aqwa" / "RM3.AH1").read_text().splitlines()
    massive = ("MASS", "HYDSTIFFNESS", "ADDEDMASS", "DAMPING", "FIDD")
    word, lines = "", []
    for line in source:
        if line[:1].isalpha():
            word = line.split()[0]
        elif word == "GENERAL":
            line = line.replace("1000.000", "1.000")
        elif word.startswith(massive) and "." in line:
            line = " ".join(f"{float(w) / 1e3:.7E}" if "." in w else w for w in line.split())
        elif word == "FORCERAO" and "." in line:
            words = line.split()
            if len(words) == 9:  # indices and amplitudes; the line after it holds phases
                words[3:] = [f"{float(w) / 1e3:.7E}" for w in words[3:]]
            line = " ".join(words)
        lines.append(line)
    (tmp_path / "RM3.AH1").write_text("\r\n".join(lines))
    tonnes, kilograms = hdb.read(tmp_path), hdb.read(reference / "hdb" / "rm3_aqwa")
    assert tonnes.rho == 1000.0
    for name in ("added_mass", "radiation_damping", "excitation"):
        ours, theirs = getattr(tonnes, name), getattr(kilograms, name)
        np.testing.assert_allclose(ours, theirs, atol=1e-4 * np.abs(theirs).max())


def test_added_mass_at_infinity_of_each_structure_alone(reference, tmp_path):
    """Blocks 1 1 and 2 2 without 1 2 are no A_inf: as if the section was not there."""
    lines = (reference / "hdb" / "rm3_aqwa" / "RM3.AH1").read_text().splitlines()
    start = lines.index("ADDEDMASS_HF") + 1
    path = tmp_path / "RM3.AH1"
    path.write_text("\n".join(lines[: start - 1] + lines[start + 24 :]))
    without = hdb.read(tmp_path)
    path.write_text("\n".join(lines[: start + 6] + lines[start + 18 :]))
    alone, report = hdb.import_database(tmp_path)
    np.testing.assert_array_equal(alone.added_mass_inf, without.added_mass_inf)
    finding = report.find("added_mass_inf of the source")[0]
    assert "each structure alone" in finding.message
    path.write_text("\n".join(lines[: start + 6] + lines[start + 12 :]))
    with refused("shape", "ADDEDMASS_HF"):
        hdb.read(tmp_path)


def test_structures_without_interaction_are_told(tmp_path):
    data = read_source(listing(tmp_path / "apart.LIS", coupled=False))
    assert not data.added_mass[:, :6, 6:].any()
    assert any("radiate alone" in f.message for f in data.findings)
    with pytest.raises(DatabaseError, match=r"force on structure 1 by motion of 2, at 0\.8 rad/s"):
        hdb.read(listing(tmp_path / "hole.LIS", left_out={(1, 2, 0.8)}))
