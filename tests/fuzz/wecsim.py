"""Mutated runs of WEC-Sim: input files, Simulink models, tables of conditions."""

from __future__ import annotations

import io
import re
import zipfile
from pathlib import Path
from random import Random

import numpy as np
from scipy.io import savemat
from tests.fuzz.cases import damaged
from tests.fuzz.values import TEXTS
from tests.python.test_wecsim_controls import ACTUATED, PI, controller
from tests.python.wecsim_files import write_slx

INPUT = """simu = simulationClass(); simu.simMechanicsFile = 'model.slx'; simu.endTime = 20;
simu.mcrMatFile = 'mcr.mat'; k = [1 2; 3 4]; controller(1).pi.Kp = 2e5; controller.pi.Ki = 3e4;
waves = waveClass('irregular'); waves.height = 2; waves.period = 9; waves.spectrumType = 'PM';
waves.direction = [0 200]; waves.spread = [0.25 0.75]; waves.marker.location = [0 0; 12 -3];
body(1) = bodyClass(''); body(1).nonHydro = 1; body(1).mass = 1e5; body(1).volume = 100;
body(1).inertia = [1 2 3]*1e6; body(1).centerGravity = [0 0 -2]; body(1).quadDrag.drag(3,3) = 1e5;
body(1).centerBuoyancy = [0 0 -1]; body(1).initial.displacement = [0 0 k(1,2)];
body(1).morisonElement.option = 1; body(1).morisonElement.cd = [1 1 1];
body(1).morisonElement.ca = [1 1 1]; body(1).morisonElement.area = [2 2 2];
body(1).morisonElement.VME = 3; body(1).morisonElement.rgME = [0 0 -5];
pto(1) = ptoClass('PTO1'); pto(1).damping = 1e4; pto(1).location = [0 0 0];
pto(1).hardStops.upperLimitSpecify = 'on'; pto(1).hardStops.upperLimitBound = 4;
for i = 1:3
  if i == 2
    mooring(1) = mooringClass('Lines'); mooring(1).matrix.stiffness(1,1) = 1e5*i;
  end
end
"""
EXPRESSIONS = (
    *(
        "10^400",
        "(" * 5000,
        "0:1e-9:1e9",
        "zeros(1e9)",
        "[]",
        "NaN",
        "-Inf",
        "1/0",
        "'a'",
        "{1,'b'}",
    ),
    *("k'", "k*k", "k^2", "sqrt(-1)", "k(0)", "k(9,9)", "1e5*ones(1e4)", "[1 2 3]", "a.b", "2.5"),
    *("reshape(k,[],1)", "length(k)", "linspace(0,1,1e9)", "diag(k)", "-true", "1:0:2"),
)
BLOCKS = [
    ("Buoy", "Rigid Body", "body(1)"),
    ("World", "Global Reference Frame", "simu"),
    ("PTO", ACTUATED, "pto(1)"),
    ("Lines", "MooringMatrix", "mooring(1)"),
]


def write(folder: Path, random: Random) -> None:
    """Write a folder of WEC-Sim of which a file or two are damaged."""
    text = INPUT
    for _ in range(random.choice((0, 1, 1, 3))):
        values = list(re.finditer(r"(?<== )[^;\n]+(?=;)", text))
        place = random.choice(values)
        text = text[: place.start()] + random.choice(EXPRESSIONS) + text[place.end() :]
    if random.random() < 0.3:
        text = damaged(text, random)
    (folder / "wecSimInputFile.m").write_bytes(text.encode("utf-8", "replace"))
    write_slx(folder / "model.slx", BLOCKS, ["2r-3l", "3r-1r-4l"], controller(PI))
    if random.random() < 0.6:
        _damage_model(folder / "model.slx", random)
    names = np.array(["waves.height", "pto(1).damping"], dtype=object)
    savemat(folder / "mcr.mat", {"mcr": {"header": names, "cases": np.array([[1.0, 5.0]] * 2)}})
    for name in ("model.slx", "mcr.mat"):
        if random.random() < 0.2:
            _damage_bytes(folder / name, random)


def _damage_model(path: Path, random: Random) -> None:
    """Values, ends of lines, names and references of a model."""
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name).decode() for name in archive.namelist()}
    name = list(files)[random.random() < 0.9]
    for _ in range(random.choice((1, 1, 3))):
        text = files[name]
        values = list(re.finditer(r'(?<=>)[^<>]+(?=</P>)|(?<=")[^"<>]+(?=")', text))
        if not values:
            break
        first, second = random.choice(values), random.choice(values)
        new = random.choice((second.group(), "system_root", "9" * 5000, "", *TEXTS[1:6]))
        files[name] = text[: first.start()] + new + text[first.end() :]
    if random.random() < 0.2:
        inner = '<Block BlockType="SubSystem" Name="s" SID="99"><System Ref="system_root"/></Block>'
        depth = random.choice((0, 3000))
        inner = '<Block SID="98"><System>' * depth + inner + "</System></Block>" * depth
        files[name] = files[name].replace("</System>", inner + "</System>")
    if random.random() < 0.3:
        files[name] = damaged(files[name], random)
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w", random.choice((zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED))) as z:
        for key, text in files.items():
            z.writestr(key, text.encode("utf-8", "replace"))
    path.write_bytes(held.getvalue())


def _damage_bytes(path: Path, random: Random) -> None:
    """Bytes replaced, and the end cut off."""
    data = bytearray(path.read_bytes())
    for _ in range(random.choice((1, 3, 10))):
        data[random.randrange(len(data))] = random.randrange(256)
    path.write_bytes(data[: random.choice((len(data), len(data), random.randrange(len(data))))])
