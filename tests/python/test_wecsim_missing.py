"""What an import from WEC-Sim takes, and what it refuses to leave out."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
import pytest
from tests.python.wecsim_files import (
    TWO_BODIES,
    TWO_BODY_LINES,
    append,
    left_out,
    write_one_body,
    write_slx,
)

import hydrodae
from hydrodae import hdb
from hydrodae.errors import CaseError
from hydrodae.wecsim import convert

WAVES = "waves = waveClass('regular'); waves.height = 1; waves.period = 6;"
ROPE = ("Rope", "Cable", "cable(1)")
LINES = ("Lines", "MooringMatrix", "mooring(3)")


@pytest.mark.parametrize(
    ("change", "part"),
    [
        ("waves = waveClass(kind);", "waves"),
        ("waves = waveClass('spectrumImport'); waves.spectrumFile = 'absent.txt';", "waves"),
        ("waves = waveClass('regular'); waves.period = 6; waves.height = f(2);", "waves"),
        ("pto(1) = ptoClass('P'); pto(1).damping = gain(3);", "pto"),
        ("pto(1) = ptoClass('P'); switch kind\ncase 1\npto(1).damping = 3;\nend\n", "pto"),
        ("pto(1) = ptoClass('P'); if kind == 1\npto(1).damping = 3;\nend\n", "pto"),
        ("constraint(1).location = place(1);", "joint"),
        ("body(1).flex = 1;", "modes"),
        ("cable(1) = cableClass('Rope', 'constraint(1)', 'constraint(2)');", "cable"),
    ],
)
def test_a_part_that_is_missing_must_be_accepted(
    two_bodies: Path, tmp_path: Path, change: str, part: str
) -> None:
    source = two_bodies
    if part in ("waves", "pto"):  # one body in heave is converted in less time
        source = tmp_path / "buoy"
        write_one_body(source, WAVES, "")
    path = source / "wecSimInputFile.m"
    path.write_text(path.read_text().replace("constraint(1).location = [0 0 0];", ""))
    append(source, change + "\n")
    with pytest.raises(CaseError, match=f"lacks parts .* no {part} .*--accept {part} writes"):
        convert(source, tmp_path / "case")
    assert not (tmp_path / "case").exists()
    converted = convert(source, tmp_path / "case", accept=[part])
    told = tomllib.loads(converted.case.read_text())["missing"]
    assert "\n".join(told) == left_out(converted)


@pytest.mark.parametrize(("block", "part"), [(ROPE, "cable"), (LINES, "mooring")])
def test_a_block_that_is_missing_must_be_accepted(
    two_bodies: Path, tmp_path: Path, block: tuple[str, str, str], part: str
) -> None:
    write_slx(two_bodies / "model.slx", [*TWO_BODIES, block], [*TWO_BODY_LINES[:2], "5l-1r-6l"])
    with pytest.raises(CaseError, match=f"no {part} .model.slx, block '{block[0]}'"):
        convert(two_bodies, tmp_path / "case")


@pytest.mark.parametrize(
    "change",
    [
        "waves.phaseSeed = clock();",
        "waves.bem.count = clock();",
        "pto(1).damping = clock(); pto(1).damping = 4;",
        "waves = waveClass('noWaveCIC');",
    ],
)
def test_what_changes_no_part_needs_no_word(tmp_path: Path, change: str) -> None:
    write_one_body(tmp_path / "source", WAVES, "pto(1).damping = 3;")
    append(tmp_path / "source", change + "\n")
    assert convert(tmp_path / "source", tmp_path / "case").case.is_file()


def test_loads_are_those_of_the_density_of_the_input_file(tmp_path: Path) -> None:
    """WEC-Sim has tables per density: A, B ~ rho; F and stiffness ~ rho g; mass ~ rho."""
    source, case = tmp_path / "source", tmp_path / "case"
    there = write_one_body(source, WAVES.replace("regular", "regularCIC"), "")
    assert (there.rho, there.gravity) == (1025.0, 9.81)
    append(source, "simu.rho = 900; simu.gravity = 10;\n")
    converted = convert(source, case)
    here = hdb.read(case / "hydro.h5")
    assert (here.rho, here.gravity) == (900.0, 10.0)
    mass, force = 900.0 / 1025.0, 9000.0 / (1025.0 * 9.81)
    for name, factor in (
        *(("added_mass", mass), ("radiation_damping", mass), ("added_mass_inf", mass)),
        *(("froude_krylov", force), ("diffraction", force)),
    ):
        np.testing.assert_allclose(getattr(here, name), factor * getattr(there, name), rtol=1e-12)
    stiffness = [database.hydrostatic_stiffness("buoy")[2, 2] for database in (here, there)]
    assert stiffness[0] == pytest.approx(force * stiffness[1])
    model = hydrodae.linear.LinearModel(case / "case.toml")
    volume = there.bodies["buoy"].hydrostatics.displaced_volume  # type: ignore[union-attr]
    assert model.mass[0, 0] == pytest.approx(900.0 * volume)
    assert "simu.rho = 900" in "\n".join(map(str, converted.remarks.of("assumed")))


READ = "hydro = struct();\nhydro = readAQWA(hydro, {name}, 'x.LIS');\nwriteBEMIOH5(hydro)\n"


@pytest.mark.parametrize(
    ("files", "bemio", "taken"),
    [
        (("alpha.nc", "device.nc"), "", "device.nc"),
        (("alpha.AH1", "Device.AH1"), "", "Device.AH1"),
        (("alpha.AH1", "zeta.AH1"), "'zeta.AH1'", "zeta.AH1"),
        (("alpha.AH1", "zeta.AH1"), 'fullfile(".", "zeta.AH1")', "zeta.AH1"),
        (("alpha.AH1",), "", "alpha.AH1"),
        (("alpha.AH1", "zeta.AH1"), "", "beside it alpha.AH1, zeta.AH1; write in the input"),
        (("device.AH1", "device.out"), "", "beside it device.out, device.AH1; write in the input"),
        (("alpha.AH1",), "'gone.AH1'", "bemio.m reads gone.AH1, which cannot be used"),
    ],
)
def test_results_are_those_that_made_the_database(
    tmp_path: Path, files: tuple[str, ...], bemio: str, taken: str
) -> None:
    from hydrodae.wecsim.hydro import find_source
    from hydrodae.wecsim.objects import InputFile

    folder = tmp_path / "hydroData"
    folder.mkdir()
    for name in files:
        (folder / name).write_text("x" * 2000)
    if bemio:
        (folder / "bemio.m").write_text(READ.format(name=bemio))
    read = InputFile(tmp_path / "wecSimInputFile.m")
    if taken in files:
        assert find_source("hydroData/device.h5", read).name == taken
        return
    with pytest.raises(CaseError, match=taken):
        find_source("hydroData/device.h5", read)
