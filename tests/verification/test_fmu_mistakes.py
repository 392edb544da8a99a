"""FMUs as controllers: what can be wrong with one, in its files and in a run."""

from __future__ import annotations

import os
import zipfile
from pathlib import Path

import pytest
from tests.verification.fmu_cart import FMU, cart
from tests.verification.fmu_of_c import compiled, description, with_units, write_fmu

import hydrodae
from hydrodae import CaseError, Simulation, SolverError
from hydrodae.fmu import export


def broken(folder: Path, how: str) -> None:
    """Something that is no FMU of use, at pi.fmu."""
    path = folder / "pi.fmu"
    xml = description(2)
    if how == "no zip":
        path.write_bytes(b"PK" + os.urandom(300))
    elif how == "empty":
        path.write_bytes(b"")
    elif how == "no description":
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("readme.txt", "hello")
    elif how == "no xml":
        write_fmu(path, 2, xml[:200])
    elif how == "version":
        write_fmu(path, 2, xml.replace('fmiVersion="2.0"', 'fmiVersion="1.0"'))
    elif how == "model exchange":
        write_fmu(path, 2, description(2, how="ModelExchange"))
    elif how == "platform":
        write_fmu(path, 2, binary="win64")
    elif how == "token":
        write_fmu(path, 2, xml.replace("token-of-pi", "another"))
    elif how == "functions":
        write_fmu(path, 3, xml, binary="linux64")
    elif how == "library":
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("modelDescription.xml", xml)
            archive.writestr("binaries/linux64/pi.so", "no library")
    elif how == "outside":
        write_fmu(path, 2)
        with zipfile.ZipFile(path, "a") as archive:
            archive.writestr("resources/../../../tmp/evil", "x")
    elif how == "clash":
        write_fmu(path, 2)
        with zipfile.ZipFile(path, "a") as archive:
            archive.writestr("resources/notes.txt/more.txt", "x")
    elif how == "cut off":
        write_fmu(path, 2)
        path.write_bytes(path.read_bytes()[:-30])
    elif how == "no reference":
        write_fmu(path, 2, xml.replace('name="rate" valueReference="1"', 'name="rate"'))
    elif how == "wild reference":
        write_fmu(path, 2, xml.replace('valueReference="2"', 'valueReference="-2"'))
    elif how == "wild identifier":
        write_fmu(path, 2, xml.replace('Identifier="pi"', 'Identifier="../../../pi"'))
    elif how == "no text":
        with zipfile.ZipFile(path, "w") as archive:
            name = b'name="\xff\xfe'
            archive.writestr("modelDescription.xml", xml.encode().replace(b'name="rate', name))
            archive.writestr("binaries/linux64/pi.so", compiled("pi", 2))
    elif how == "damaged":
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("modelDescription.xml", xml)
        data = bytearray(path.read_bytes())
        data[200] ^= 0xFF
        path.write_bytes(data)


FAULTS = {
    "no zip": "pi.fmu: is no zip archive, as an FMU is one",
    "empty": "pi.fmu: is no zip archive",
    "no description": "pi.fmu: has no modelDescription.xml: it is no FMU",
    "no xml": "pi.fmu: modelDescription.xml: .* at byte",
    "version": "is of version '1.0' of FMI; those of 2.0 and 3.0 can be loaded",
    "model exchange": "is for model exchange only; a controller needs one for co-simulation",
    "platform": "no library binaries/linux64/pi.so for this machine; there are win64",
    "token": "fmi2Instantiate has given no instance",
    "functions": "its library has no function 'fmi2Instantiate'",
    "library": "its library cannot be loaded: .*pi.so: ",
    "outside": "would be unpacked elsewhere",
    "clash": "pi.fmu: cannot be unpacked",
    "cut off": "pi.fmu: is no zip archive",
    "no reference": "'rate' of the FMU has no valueReference that is a number",
    "wild reference": "'load' of the FMU has no valueReference that is a number",
    "wild identifier": "no library binaries/linux64/../../../pi.so for this machine",
    "no text": "the FMU has no input 'rate'",
    "damaged": "pi.fmu: .*damaged",
}


@pytest.mark.parametrize("how", FAULTS)
def test_what_is_no_fmu_is_told(how: str, tmp_path: Path) -> None:
    broken(tmp_path, how)
    case = cart(tmp_path)
    with pytest.raises(CaseError, match=FAULTS[how]) as caught:
        hydrodae.run(case)
    assert caught.value.file == str(case.path)
    assert caught.value.key.startswith("controller.pi")
    assert not list(Path("/tmp").glob("hydrodae-fmu-*/evil"))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('["rate"]', '["rat"]', "the FMU has no input 'rat'; did you mean 'rate'"),
        ('["rate"]', '["load"]', "'load' of the FMU is of causality 'output', expected 'input'"),
        ('"kp"', '"kq"', "the FMU has no parameter 'kq'; did you mean 'kp'"),
        ('["rate"]', "[]", "'fmu_inputs' must have as many as 'inputs': 1, it has 0"),
        ("[1.3, 0.7]", "[1.3]", "'parameter_values' must have as many as 'parameters': 2"),
        ("[1.3, 0.7]", "[-1.3, 0.7]", "fmi.Set.* has ended in status Error: kp is negative"),
        ('"pi.fmu"', '"po.fmu"', "key 'file' in .*po.fmu"),
        ('file = "pi.fmu"', "", "missing key 'file'"),
        ("fmu_outputs", "damping = 1.0\nfmu_outputs", "unknown key 'damping'"),
    ],
)
def test_mistakes_are_told(fmi: int, old: str, new: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=message):
        hydrodae.run(cart(tmp_path, FMU.replace(old, new)))


def test_check_tells_mistakes_before_the_run(fmi: int, tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="did you mean 'rate'"):
        hydrodae.check(cart(tmp_path, FMU.replace('["rate"]', '["rat"]')))


def test_an_fmu_cannot_be_in_another_one(tmp_path: Path) -> None:
    write_fmu(tmp_path / "pi.fmu", 3)
    with pytest.raises(CaseError, match="'pi' is an FMU, which cannot be part of another one"):
        export(cart(tmp_path), tmp_path / "x.fmu")


TRICKS = {
    1: "stopped at t = 1 s: controller 'pi': input 'forces/pto/load' .N.: expected a finite number",
    2: "DoStep has ended in status 42",
    3: "DoStep has ended in status Fatal: it is no more",
    4: r"DoStep has ended in status Error: bad \?\?\? bytes\?",
}


@pytest.mark.parametrize("trick", TRICKS)
def test_what_an_fmu_does_wrong_in_a_run_is_told(trick: int, fmi: int, tmp_path: Path) -> None:
    keys = FMU.replace('"ki"]', '"ki", "trick"]').replace("0.7]", f"0.7, {trick}.0]")
    with pytest.raises(SolverError, match=TRICKS[trick]) as caught:
        hydrodae.run(cart(tmp_path, keys), tmp_path / "r.h5")
    assert "controller 'pi'" in str(caught.value)
    kept = hydrodae.Results.read(tmp_path / "r.h5")
    assert kept.status == "failed"
    assert 0.9 <= kept.end_time <= 1.1


def test_a_state_without_end_is_refused(fmi: int, tmp_path: Path) -> None:
    keys = FMU.replace('"ki"]', '"ki", "trick"]').replace("0.7]", "0.7, 5.0]")
    run = Simulation(cart(tmp_path, keys))
    run.advance(0.1)
    with pytest.raises(CaseError, match=r"reports a size of its state of .* bytes; at most"):
        run.state()


@pytest.mark.parametrize(
    ("rate", "load", "message"),
    [
        ("K", "N", r"'rate' of the FMU is in 'K' \(K\), which is no unit of 'joints/sl.*in 'm/s'"),
        ("m/s", "W", r"'load' of the FMU is in 'W' \(kg m2 s-3\), which is no unit of 'forces/p"),
        ("zero", "N", "'rate' of the FMU is in 'zero' .of factor 0 and offset 0"),
    ],
)
def test_units_of_something_else_are_refused(
    rate: str, load: str, message: str, fmi: int, tmp_path: Path
) -> None:
    write_fmu(tmp_path / "pi.fmu", fmi, with_units(description(fmi), fmi, rate, load))
    with pytest.raises(CaseError, match=message):
        hydrodae.run(cart(tmp_path))
    with pytest.raises(CaseError, match=message):
        hydrodae.check(cart(tmp_path))
