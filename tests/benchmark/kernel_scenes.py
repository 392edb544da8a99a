"""The scenes of `kernel_costs.py`: cases of the repository, and arrays with a made-up database."""

from __future__ import annotations

import runpy
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

import hydrodae
from hydrodae import hdb
from hydrodae.hdb.memory import ExponentialMemory

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "cases"
STARTERS = ROOT / "python" / "hydrodae" / "starters"
RHO, GRAVITY = 1025.0, 9.81  # kg/m3, m/s2
RADIUS = 5.0  # m, of half-submerged spheres
MASS = RHO * 2.0 / 3.0 * np.pi * RADIUS**3  # kg
STATES = 10  # of each body


@dataclass(frozen=True)
class Scene:
    """A case, and how much of it is run."""

    case: Path
    end: float  # s
    values: dict[str, Any] = field(default_factory=dict)

    @property
    def keys(self) -> dict[str, Any]:
        """Values that replace those of the case."""
        return {"solver.end_time": self.end} | self.values


def windows(count: int) -> Path:
    """Write the case of a chain of four-bar windows, and return its path."""
    path = ROOT / "build" / f"n_four_bar_{count}.toml"
    path.parent.mkdir(exist_ok=True)
    four_bar = runpy.run_path(str(CASES / "benchmarks" / "four_bar.py"))["four_bar"]
    path.write_text(four_bar(count), encoding="utf-8")
    return path


FIXED = {
    "F3OF, flap decay": Scene(CASES / "f3of" / "flap_decay.toml", 100.0),
    "F3OF, irregular sea": Scene(CASES / "f3of" / "waves.toml", 100.0),
    "sphere, regular wave": Scene(CASES / "sphere" / "wave.toml", 60.0),
    "4N3LA, irregular sea": Scene(CASES / "4n3la" / "irregular.toml", 10.0),
    "9N9LA, irregular sea": Scene(CASES / "9n9la" / "irregular.toml", 5.0),
    "attenuator, irregular sea": Scene(STARTERS / "attenuator" / "case.toml", 30.0),
    "two bodies on catenaries": Scene(STARTERS / "moored" / "case.toml", 30.0),
    "40 four-bar windows": Scene(windows(40), 1.0),
    "chain of 10": Scene(CASES / "benchmarks" / "chain_10.toml", 1.5),
}
ARRAYS = {"81 in heave, limited": True, "81 in heave, full": False}
NAMES = (*FIXED, *ARRAYS)


def database(count: int, limited: bool) -> hdb.HydroDatabase:
    """Bodies in heave with a memory that is passive whatever its input is.

    z' = p z + B U, load Re(B^H z), Re p < 0. A mode feels its own body, and the others less the
    further they are; if limited, its own body alone.
    """
    random = np.random.default_rng(7)
    labels = tuple(f"b{i}.heave" for i in range(count))
    modes = STATES // 2 * count
    own = np.arange(modes) * count // modes
    far = np.abs(own[:, None] - np.arange(count)).astype(float)
    near = np.where(far == 0.0, 1.0, 0.0 if limited else 1.0 / (1.0 + far))
    draws = random.uniform(-1.0, 1.0, (2, modes, count))
    inlet = (draws[0] + 1j * draws[1]) * near * np.sqrt(0.05 * MASS)
    poles = -0.3 - 0.2 * random.random(modes) + 1j * (0.6 + 0.5 * random.random(modes))
    apart = np.abs(np.subtract.outer(np.arange(count), np.arange(count)))
    coupling = np.eye(count) if limited else np.where(apart == 0, 1.0, 0.3 / (1 + apart) / count)
    inertia = 0.5 * MASS * coupling
    outlet, report = inlet.conj().T, {"n_states": 2 * modes, "passive": True}
    fit = ExponentialMemory("made up", labels, labels, poles, inlet, outlet, inertia, report)
    omega = np.linspace(0.2, 2.0, 10)
    radiation = np.array([fit.transfer(np.array([w]))[0] for w in omega])
    loads = np.zeros((len(omega), 1, count), dtype=complex)
    bodies = {}
    for i in range(count):
        centre = np.array([30.0 * i, 0.0, -3.0 / 8.0 * RADIUS])
        statics = hdb.Hydrostatics(MASS / RHO, centre, np.pi * RADIUS**2, np.zeros(5))
        bodies[f"b{i}"] = hdb.Body(f"b{i}", centre, statics)
    return hdb.HydroDatabase(
        labels,
        omega,
        inertia + radiation.imag / omega[:, None, None],
        radiation.real,
        inertia,
        np.zeros_like(inertia),
        np.zeros(1),
        loads,
        loads,
        bodies,
        RHO,
        GRAVITY,
        memory={fit.name: fit},
    )


def write_array(folder: Path, limited: bool, count: int = 81) -> Scene:
    """Write the case of an array and its database."""
    folder.mkdir(parents=True, exist_ok=True)
    database(count, limited).write(folder / "hydro.h5")
    scene = hydrodae.Scene("array", directory=folder)
    scene.hydro(database="hydro.h5", radiation="exponential")
    for i in range(count):
        scene.body(
            f"b{i}",
            hydro=f"b{i}",
            motion="heave",
            mass=MASS,
            center_of_gravity=[30.0 * i, 0.0, -3.0 / 8.0 * RADIUS],
            initial={"displacement": [0.0, 0.0, 1.0 if i % 2 == 0 else -0.5]},
        )
    scene.solver(end_time=5.0)
    scene.output(step=0.1)
    (folder / "case.toml").write_text(scene.to_toml())
    return Scene(folder / "case.toml", 5.0)


def scene(name: str, folder: Path) -> Scene | None:
    """Return the scene of a name; None where its database has not been computed."""
    if name in ARRAYS:
        return write_array(folder / ("limited" if ARRAYS[name] else "full"), ARRAYS[name])
    found = FIXED[name]
    text = found.case.read_text()
    return found if "[hydro]" not in text or (found.case.parent / "hydro.h5").exists() else None
