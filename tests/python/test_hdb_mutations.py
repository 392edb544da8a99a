"""Real files with line ends, encodings and exponents of others, and with damage.

Places of the damage are seeded. A source reads as it did, or ends in one error that names the file.
"""

from __future__ import annotations

import dataclasses
import random
import re
import shutil
from pathlib import Path

import numpy as np
import pytest
from tests.python.nemoh_writer import NemohFolder

from hydrodae import hdb
from hydrodae.errors import DatabaseError
from hydrodae.hdb.checks.hulls import hull_findings
from hydrodae.hdb.checks.smooth import spike_findings
from hydrodae.hdb.readers.reading import read_source

OWN = "own_nemoh"  #: A folder that the tests write themselves, in every clone.
#: Folders, and the file whose numbers are garbled.
SOURCES = {
    OWN: "Results/RadiationCoefficients.tec",
    "cylinder_hams": "Wamit_format/Buoy.1",
    "boxes_aqwa": "ANALYSIS.LIS",
    "cylinder_aqwa": "cylinder.AH1",
    "multibody_orcawave": "Multibody_res.yml",
    "twospheres_capytaine_legacy": "results/RadiationCoefficients.tec",
}
#: Numbers with a point that no letter adjoins.
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+\.\d+(?:[Ee][-+]\d+)?(?![\w.])")
HARMLESS = {
    "Windows line ends": lambda text: text.replace("\n", "\r\n").encode(),
    "Fortran's D": lambda text: re.sub(r"(?<=\d)E(?=[-+]\d)", "D", text).encode(),
    "empty lines at the end": lambda text: (text + "\n\n  \n").encode(),
    "a byte order mark": lambda text: text.encode("utf-8-sig"),
    "UTF-16": lambda text: text.encode("utf-16"),
}


@pytest.fixture
def copy(request, tmp_path):
    """Copies a folder of the reference without its pictures, or writes the own one."""

    def copied(name: str) -> Path:
        if name == OWN:
            return Path(NemohFolder().write(tmp_path / name))
        reference = request.getfixturevalue("reference")
        leave = shutil.ignore_patterns(
            "*.png", "*.pdf", "*.LIS" if name == "cylinder_aqwa" else "-"
        )
        return Path(shutil.copytree(reference / "hdb" / name, tmp_path / name, ignore=leave))

    return copied


def text_of(path):
    return path.read_text(encoding="utf-8-sig", errors="replace")


def outcome(folder):
    """What a folder reads as, or None, and the message of its error."""
    try:
        return read_source(folder), ""
    except DatabaseError as error:
        return None, str(error)


def same(one, other):
    """Tell whether two sources hold the same tables at the frequencies that both have."""
    if one.coordinates != other.coordinates:
        return False
    at = np.array([np.argmin(np.abs(other.omega - w)) for w in one.omega])
    if not np.allclose(other.omega[at], one.omega, rtol=1e-9):
        return False
    pairs = [
        (getattr(one, name), getattr(other, name))
        for name in ("added_mass", "radiation_damping", "excitation")
    ]
    return all(x is None or np.allclose(x, y[at], rtol=1e-6, atol=1e-9) for x, y in pairs)


@pytest.mark.parametrize("way", HARMLESS)
@pytest.mark.parametrize("name", SOURCES)
def test_how_text_is_written_does_not_matter(copy, name, way):
    folder = copy(name)
    before = read_source(folder)
    for path in before.files:
        if path.suffix == ".yml" and way == "Fortran's D":
            continue  # no Fortran writes YAML
        path.write_bytes(HARMLESS[way](text_of(path)))
    assert same(read_source(folder), before)


@pytest.mark.parametrize("name", SOURCES)
def test_a_garbled_number_names_its_line(copy, name):
    folder = copy(name)
    path, before = folder / SOURCES[name], read_source(folder)
    text, told = text_of(path), 0
    for seed in range(6):
        place = random.Random(f"{name} {seed}").choice(list(NUMBER.finditer(text)))
        word = place.group()
        line = text[: place.start()].count("\n") + 1
        path.write_text(f"{text[: place.start()]}{word[:3]}x{word[3:]}{text[place.end() :]}")
        found, message = outcome(folder)
        told += found is None
        if found is None:
            assert f"{path.name}:{line}:" in message
        else:
            assert same(found, before)  # a number that is not used
    assert told > 0 or name == "boxes_aqwa"  # most of a listing is not used


@pytest.mark.parametrize("name", SOURCES)
def test_a_file_that_is_cut_short_never_reads_as_something_else(copy, name):
    folder = copy(name)
    path, before = folder / SOURCES[name], read_source(folder)
    raw = path.read_bytes()
    for share in (0.0, 0.02, 0.3, 0.61, 0.9, 0.97):
        path.write_bytes(raw[: int(share * len(raw))])
        found, message = outcome(folder)
        if found is None:
            assert path.name in message or folder.name in message
        else:
            assert same(found, before)


def test_phases_of_the_other_sign_than_the_parts_are_told(copy):
    folder = copy("cylinder_hams")
    path = folder / "Wamit_format" / "Buoy.3"
    rows = [line.split() for line in path.read_text().splitlines()]
    for row in rows:
        row[4] = str(-float(row[4]))
    path.write_text("\n".join(" ".join(row) for row in rows))
    told = [f.message for f in read_source(folder).findings if f.check == "excitation"]
    assert any(re.search(r"Buoy\.3:1: phase .* which are used", text) for text in told)


def test_strange_water_is_told(copy):
    path = copy("twospheres_capytaine_legacy") / "Nemoh.cal"
    lines = path.read_text().splitlines()
    path.write_text("\n".join([lines[0], "1.0e6", *lines[2:]]))
    found = read_source(path.parent).findings
    assert any(f.check == "water" and "density 1e+06 kg/m3" in f.message for f in found)


def test_a_single_garbled_force_is_told(sphere_tables):
    sphere = sphere_tables
    band = (0.3, 2.0)
    assert spike_findings(sphere, band) == []
    at, heave = int(np.abs(sphere.omega - 1.0).argmin()), sphere.index("sphere.heave")[0]
    force = sphere.diffraction.copy()
    force[at, 0, heave] += 0.3 * np.abs(sphere.excitation[:, 0, heave]).max()
    (found,) = spike_findings(dataclasses.replace(sphere, diffraction=force), band)
    assert found.severity == "warning"
    assert "sphere.heave" in found.message
    assert found.omega == pytest.approx(sphere.omega[at])
    (found,) = spike_findings(dataclasses.replace(sphere, diffraction=force), (1.5, 2.0))
    assert found.severity == "info"


def test_an_irregular_frequency_of_three_values_is_told(sphere_tables):
    """It is no single value: a narrow resonance of the water inside."""
    sphere = sphere_tables
    at, heave = int(np.abs(sphere.omega - 1.0).argmin()), sphere.index("sphere.heave")[0]
    force = sphere.diffraction.copy()
    resonance = np.array([0.15, 0.3, -0.15]) * np.abs(sphere.excitation[:, 0, heave]).max()
    force[at - 1 : at + 2, 0, heave] += resonance
    (found,) = spike_findings(dataclasses.replace(sphere, diffraction=force), (0.3, 2.0))
    assert found.severity == "warning"
    assert found.omega == pytest.approx(sphere.omega[at])


def test_hydrostatics_of_another_hull_are_told(reference):
    cubes = hdb.read(reference / "hdb" / "cubes_nemoh_v3.0.2")
    assert hull_findings(cubes) == []
    statics = cubes.bodies["r_cube"].hydrostatics
    assert statics is not None

    def told(**changes):
        other = dataclasses.replace(statics, **changes)
        found = hull_findings(cubes.with_hydrostatics({"r_cube": other}))
        return [(f.severity, f.message.removeprefix("r_cube: ")[:26]) for f in found]

    center, volume = statics.center_of_buoyancy, statics.displaced_volume
    assert told(center_of_buoyancy=3.0 * center) == [("warning", "its centre of buoyancy is ")]
    ((severity, text),) = told(displaced_volume=0.8 * volume)
    assert severity == "warning"
    assert text.startswith("displaces ")
    for factor, severity in ((-1.0, "error"), (0.0, "warning"), (1000.0, "error")):
        found = told(center_of_buoyancy=factor * center)
        assert found[0] == (severity, "its centre of buoyancy, z ")
    area = -statics.waterplane_area
    assert told(waterplane_area=area) == [("error", "its waterplane area is neg")]


def test_overflows_are_dropped_and_told(copy):
    folder = copy("cylinder_hams")
    path = folder / "Wamit_format" / "Buoy.1"
    lines = path.read_text().splitlines()
    at = next(i for i, line in enumerate(lines) if len(line.split()) == 5)
    words = lines[at].split()
    lines[at] = " ".join([*words[:3], "1.0E+300", words[4]])
    path.write_text("\n".join(lines))
    _, report = hdb.import_database(folder)
    assert any(f.check == "NaN" for f in report.of("warning"))


def test_damping_of_the_wrong_sign_of_one_coordinate_is_told(sphere_tables):
    sphere = sphere_tables.select(["sphere.heave"])
    damping = sphere.radiation_damping.copy()
    damping[np.abs(sphere.omega - 1.0).argmin()] *= -3.0
    wrong = dataclasses.replace(sphere, radiation_damping=damping)
    errors = [f for f in hdb.check(wrong).findings if f.severity == "error"]
    assert any("mostly sphere.heave;" in f.message for f in errors)


def test_a_column_that_is_no_phase_is_told(copy):
    """Phases in other units, or of other coordinates, jump from frequency to frequency."""
    folder = copy("twospheres_capytaine_legacy")
    whole = hdb.read(folder)
    assert not any("jumps" in f.message for f in hdb.check(whole).find("excitation smooth"))
    heave = next(c for c in whole.coordinates if c.endswith("heave"))
    turned = whole.diffraction.copy()
    i = whole.index(heave)[0]
    total = whole.excitation[:, 0, i]
    turned[:, 0, i] = np.abs(total) * np.exp(57.3j * 10.0 * np.angle(total))
    turned[:, 0, i] -= whole.froude_krylov[:, 0, i]
    told = hdb.check(dataclasses.replace(whole, diffraction=turned)).find("excitation smooth")
    assert [f.severity for f in told] == ["warning"]
    assert f"{heave} at heading" in told[0].message
    assert "jumps" in told[0].message


def test_halves_of_added_mass_far_apart_are_an_error(copy):
    """One number of the coupling of surge and pitch, a thousand times too large."""
    path = copy("cylinder_hams") / "Wamit_format" / "Buoy.1"
    lines = path.read_text().splitlines()
    k = next(k for k, line in enumerate(lines) if line.split()[1:3] == ["1", "5"] and k > 900)
    cells = lines[k].split()
    lines[k] = "  ".join([*cells[:3], f"{1e6 * float(cells[3]):.6E}", *cells[4:]])
    path.write_text("\n".join(lines) + "\n")
    _, report = hdb.import_database(path.parents[1])
    errors = [f.message for f in report.findings if f.severity == "error"]
    assert any("asymmetry" in message and "of the diagonal" in message for message in errors)


def test_a_garbled_frequency_names_its_line(copy):
    path = copy("twospheres_capytaine_legacy") / "results" / "RadiationCoefficients.tec"
    lines = path.read_text().splitlines()
    at = next(i for i, line in enumerate(lines) if re.match(r"\s*\d", line)) + 3
    right = lines[at].split()
    for word, told in (("0.0", rf"tec:{at + 1}: .* > 0, but is 0"), ("77.7", f"in line {at + 1};")):
        path.write_text("\n".join([*lines[:at], " ".join([word, *right[1:]]), *lines[at + 1 :]]))
        with pytest.raises(DatabaseError, match=told):
            read_source(path.parents[1])
