"""OrcaFlex's vessel types: YAML of any layout, units of each quantity, symmetric hulls."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from hydrodae.errors import DatabaseError
from hydrodae.hdb.readers.orcayaml import read_yaml
from hydrodae.hdb.readers.reading import read_source
from hydrodae.hdb.readers.symmetric import mirrored_forces

OMEGA = np.array([0.4, 0.6, 0.8, 1.0, 1.2])
#: kg, m, N: a made-up hull about a point in its planes of symmetry.
ADDED = np.diag([2e5, 3e5, 4e5, 5e6, 6e6, 7e6]) + 0.0
ADDED[0, 4] = ADDED[4, 0] = -3e5
DAMPING = np.diag([1e4, 2e4, 3e4, 4e5, 5e5, 6e5]) + 0.0
STIFFNESS = np.diag([5e6, 3e7, 4e7])
#: Loads per metre of wave of a small body of revolution, by the direction of the wave.
SURGE, HEAVE, PITCH = 3e5j, 4e5, -2e6j
SENSES = "Surge Sway Heave Roll Pitch Yaw".split()


def loads(beta):
    """(6,): what a body of revolution about the z axis feels."""
    c, s = np.cos(beta), np.sin(beta)
    return np.array([SURGE * c, SURGE * s, HEAVE, -PITCH * s, PITCH * c, 0.0])


def write(path, *, headings, symmetry="None", units=None, forces=loads):
    """Write a vessel type in units (words, length, mass, force) [m, kg, N]."""
    words, length, mass, force = units or ("SI", 1.0, 1e3, 1e3)
    arm = length ** np.array([0.0, 0.0, 0.0, 1.0, 1.0, 1.0])
    matrix = np.outer(arm, arm)
    lines = ["%YAML 1.1", "---", "General:", f"  UnitsSystem: {words}"]
    lines += ["Environment:", f"  Density: {1025.0 * length**3 / mass:.12g}"]
    lines += [f"  WaterDepth: {200.0 / length:.12g}", "VesselTypes:", "  - Name: hull type"]
    lines += ["    WavesReferredToBy: frequency (rad/s)", f"    Symmetry: {symmetry}"]
    lines += ["    Draughts:", "      - Name: deep", "        CentreOfMass: [0, 0, 0]"]
    lines += ["        ReferenceOrigin: [0, 0, 0]"]
    lines += [f"        DisplacedVolume: {500.0 / length**3:.12g}"]
    lines += [f"        CentreOfBuoyancy: [0, 0, {-3.0 / length:.12g}]", "        LoadRAOs:"]
    lines += ["          RAOOrigin: [0, 0, 0]", "          PhaseOrigin: [~, ~, ~]"]
    lines += ["          RAOs:"]
    for degrees in headings:
        value = forces(np.radians(degrees)) * length / (force * arm)
        lines += [f"            - RAODirection: {degrees}"]
        lines += ["              RAOPeriodOrFrequency, RAOSurgeAmp, RAOSurgePhase:"]
        pairs = ", ".join(f"{abs(v):.12g}, {np.degrees(np.angle(v)):.12g}" for v in value)
        lines += [f"                - [{w}, {pairs}]" for w in OMEGA]
    lines += ["        HydrostaticStiffnessz, HydrostaticStiffnessRx, HydrostaticStiffnessRy:"]
    scaled = STIFFNESS * length / force / matrix[2:5, 2:5]
    lines += [f"          - [{', '.join(f'{v:.12g}' for v in row)}]" for row in scaled]
    lines += ["        FrequencyDependentAddedMassAndDamping:"]
    for w in OMEGA:
        lines += [f"          - AMDPeriodOrFrequency: {w}"]
        for key, table in (
            ("AddedMassMatrixX, AddedMassMatrixY", ADDED / mass / matrix),
            ("DampingX, DampingY", DAMPING * length / force / matrix),
        ):
            lines += [f"            {key}:"]
            lines += [f"              - [{', '.join(f'{v:.12g}' for v in row)}]" for row in table]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8-sig")
    return path


def test_yaml_that_other_programs_write(tmp_path):
    path = tmp_path / "model.yml"
    path.write_text(
        "Faces:\n- [1, 2,\n   3]\n- - 4\n  - 5\nTypes:\n  - # a comment behind the dash\n"
        "    Name: 'it''s: \"quoted\"'\n    Wide: {a: 1, b: [2, [3, 4]]}\n"
        "    Text: >-\n      two\n      lines\n  -\n    Name: 12:30\n    On: Yes\n"
        "    Date: 2020-01-02\n    Far: -.inf\n    Power: 1e6\n    Octal: 010\n"
    )
    model = read_yaml(path)
    assert model["Faces"] == [[1.0, 2.0, 3.0], [4.0, 5.0]]
    first, second = model["Types"]
    assert first == {
        "Name": 'it\'s: "quoted"',
        "Wide": {"a": 1.0, "b": [2.0, [3.0, 4.0]]},
        "Text": "two lines",
    }
    assert (second["Name"], second["On"], second["Date"]) == ("12:30", "Yes", "2020-01-02")
    assert (second["Far"], second["Power"], second["Octal"]) == (-np.inf, 1e6, 10.0)


@pytest.mark.parametrize(
    ("words", "length", "mass", "force"),
    [
        ("SI", 1.0, 1e3, 1e3),
        ("m kg N", 1.0, 1.0, 1.0),
        ("m kg kN", 1.0, 1.0, 1e3),
        ("m te N", 1.0, 1e3, 1.0),
        ("km kg N", 1e3, 1.0, 1.0),
        ("ft te kN", 0.3048, 1e3, 1e3),
    ],
)
def test_units_of_length_mass_and_force_are_independent(tmp_path, words, length, mass, force):
    system = words
    if words != "SI":
        keys = zip(("LengthUnits", "MassUnits", "ForceUnits"), words.split(), strict=True)
        rest = "".join(f"\n  {key}: {word}" for key, word in keys)
        system = f"User{rest}\n  g: {9.80665 / length:.12g}"
    path = write(tmp_path / "hull.yml", headings=[0], units=(system, length, mass, force))
    data: Any = read_source(path)
    assert (data.rho, data.gravity, data.water_depth) == pytest.approx((1025.0, 9.80665, 200.0))
    np.testing.assert_allclose(data.added_mass[0], ADDED)
    np.testing.assert_allclose(data.radiation_damping[0], DAMPING)
    np.testing.assert_allclose(data.excitation[0, 0], loads(0.0), atol=1e-6)
    statics = data.hydrostatics["hull"][0]
    assert statics.displaced_volume == pytest.approx(500.0)
    assert statics.waterplane_area == pytest.approx(5e6 / (1025.0 * 9.80665))


@pytest.mark.parametrize(
    ("symmetry", "given", "found"),
    [
        ("xz plane", [0, 60, 180], [0, 60, 180, 300]),
        ("yz plane", [90, 30], [30, 90, 150]),
        ("xz and yz planes", [0, 60, 90], [0, 60, 90, 120, 180, 240, 270, 300]),
        ("Circular", [30], list(range(0, 360, 30))),
    ],
)
def test_the_other_directions_of_symmetric_hulls(tmp_path, symmetry, given, found):
    data: Any = read_source(write(tmp_path / "hull.yml", headings=given, symmetry=symmetry))
    beta = np.radians(found)
    if data.heading[-1] > 6.0:  # all round: closed by the forces of the first
        beta = np.append(beta, 2.0 * np.pi)
    np.testing.assert_allclose(data.heading, beta, atol=1e-9)
    expected = np.array([loads(b) for b in beta])
    np.testing.assert_allclose(data.excitation[2], expected, atol=1e-6)


def test_a_symmetry_of_another_name_names_what_to_save(tmp_path):
    path = write(tmp_path / "hull.yml", headings=[0], symmetry="helix")
    with pytest.raises(DatabaseError, match=r"'helix'.*xz plane.*Symmetry: None"):
        read_source(path)


def test_mirrors_turn_moments_the_other_way():
    force = np.arange(1.0, 7.0)[None, None].astype(complex)
    heading, both = mirrored_forces(np.array([0.5]), force, across=True)
    np.testing.assert_allclose(heading, [0.5, 2.0 * np.pi - 0.5])
    np.testing.assert_array_equal(both[0, 1].real, [1, -2, 3, -4, 5, -6])
    heading, both = mirrored_forces(np.array([0.5]), force, along=True)
    np.testing.assert_allclose(heading[1], np.pi - 0.5)
    np.testing.assert_array_equal(both[0, 1].real, [-1, 2, 3, 4, -5, -6])
