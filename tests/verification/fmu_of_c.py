"""FMUs that are compiled from C when a test asks for one."""

from __future__ import annotations

import subprocess
import tempfile
import zipfile
from functools import cache
from pathlib import Path

NAMES = {
    1: "rate",
    2: "load",
    3: "kp",
    4: "ki",
    5: "discard_at",
    6: "fail_at",
    7: "end_at",
    8: "trick",
}
PLATFORMS = {2: "linux64", 3: "x86_64-linux"}


def description(fmi: int, *, states: bool = True, how: str = "CoSimulation") -> str:
    """modelDescription.xml of the PI controller."""
    state = "State" if fmi == 3 else "state"
    lines = [
        f'<fmiModelDescription fmiVersion="{fmi}.0" modelName="pi" '
        f'{"guid" if fmi == 2 else "instantiationToken"}="token-of-pi">',
        f'<{how} modelIdentifier="pi" canGetAndSetFMU{state}="{str(states).lower()}" '
        f'canSerializeFMU{state}="{str(states).lower()}"/>',
        "<ModelVariables>",
    ]
    if fmi == 3:
        lines.append('<Float64 name="time" valueReference="0" causality="independent"/>')
    for reference, name in NAMES.items():
        causality = {1: "input", 2: "output"}.get(reference, "parameter")
        start = "" if causality == "output" else ' start="0"'
        fixed = ' variability="fixed"' if causality == "parameter" else ""
        head = f'name="{name}" valueReference="{reference}" causality="{causality}"{fixed}'
        lines.append(
            f"<Float64 {head}{start}/>"
            if fmi == 3
            else f"<ScalarVariable {head}><Real{start}/></ScalarVariable>"
        )
    count = 'name="count" valueReference="99" causality="output" variability="discrete"'
    if fmi == 3:
        lines += [f"<Int32 {count}/>", "</ModelVariables>", "<ModelStructure>"]
        lines += ['<Output valueReference="2"/>', '<Output valueReference="99"/>']
        lines += ['<InitialUnknown valueReference="2"/>', '<InitialUnknown valueReference="99"/>']
    else:
        lines += [f"<ScalarVariable {count}><Integer/></ScalarVariable>", "</ModelVariables>"]
        unknowns = '<Unknown index="2"/><Unknown index="9"/>'
        lines += [f"<ModelStructure><Outputs>{unknowns}</Outputs>"]
        lines += [f"<InitialUnknowns>{unknowns}</InitialUnknowns>"]
    return "\n".join([*lines, "</ModelStructure>", "</fmiModelDescription>"])


@cache
def compiled(name: str, fmi: int) -> bytes:
    """The shared library of NAME_fmu.c beside this file, for a version of FMI."""
    source = Path(__file__).parent / f"{name}_fmu.c"
    options = ["-shared", "-fPIC", "-O1", "-fvisibility=hidden", f"-DFMI={fmi}"]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "library.so"
        subprocess.run(["cc", *options, str(source), "-o", str(path), "-lm"], check=True)
        return path.read_bytes()


def with_units(xml: str, fmi: int, rate: str, load: str) -> str:
    """The description with units: it explains some, "kN" is a thousand newtons."""
    powers = {"m/s": 'm="1" s="-1"', "N": 'kg="1" m="1" s="-2"', "K": 'K="1"'}
    powers["W"] = 'kg="1" m="2" s="-3"'
    powers["zero"] = powers["m/s"] + ' factor="0"'
    powers["kN"] = powers["N"] + ' factor="1000"'
    told = "".join(
        f'<Unit name="{name}"><BaseUnit {base}/></Unit>' for name, base in powers.items()
    )
    xml = xml.replace(
        "<ModelVariables>", f"<UnitDefinitions>{told}</UnitDefinitions><ModelVariables>"
    )
    for name, unit in (("rate", rate), ("load", load)):
        at = xml.index(f'name="{name}"')
        tag = "<Real" if fmi == 2 else f'name="{name}"'
        at = xml.index(tag, at) + len(tag)
        xml = f'{xml[:at]} unit="{unit}"{xml[at:]}'
    return xml


def write_fmu(path: Path, fmi: int, xml: str | None = None, binary: str | None = None) -> Path:
    """The FMU; `xml` in place of its description, `binary` in place of its platform."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("modelDescription.xml", xml or description(fmi))
        archive.writestr(f"binaries/{binary or PLATFORMS[fmi]}/pi.so", compiled("pi", fmi))
        archive.writestr("resources/notes.txt", "nothing")
    return path
