"""Arrays of half-submerged spheres on a hexagonal grid, with a made-up memory that couples them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

import hydrodae
from hydrodae import arrays, hdb
from hydrodae.hdb.memory import ExponentialMemory
from hydrodae.support.arrays import Array

RHO, GRAVITY = 1025.0, 9.81  # kg/m3, m/s2
RADIUS = 5.0  # m
MASS = RHO * 2.0 / 3.0 * np.pi * RADIUS**3  # kg
DEPTH = 3.0 / 8.0 * RADIUS  # m, of the centre of a half sphere
SPACING = 30.0  # m
STATES = 10  # of each body
DOFS = ("surge", "sway", "heave", "roll", "pitch", "yaw")


@dataclass(frozen=True)
class Layout:
    """How many spheres there are, how they move, and who is coupled."""

    count: int
    neighbours: bool  # each mode of the memory feels its own body and those next to it; else all
    rigid: bool = False  # six coordinates each; else heave

    @property
    def dofs(self) -> tuple[str, ...]:
        """Coordinates of a body."""
        return DOFS if self.rigid else ("heave",)

    @property
    def labels(self) -> tuple[str, ...]:
        """Coordinates of all bodies."""
        return tuple(f"b{i}.{dof}" for i in range(self.count) for dof in self.dofs)

    def places(self) -> Array:
        """Return the centre of each body (count, 3) [m]."""
        plane = np.array(list(arrays.hexagonal(self.count, SPACING).values()))
        return np.column_stack((plane, np.full(self.count, -DEPTH)))

    def nearness(self) -> Array:
        """Return what bodies feel of each other (count, count): 1 / (1 + distance / SPACING)."""
        at = self.places()
        far = np.linalg.norm(at[:, None] - at, axis=2) / SPACING
        return np.where(far < 1.5, 1.0 / (1.0 + far), 0.0) if self.neighbours else 1.0 / (1.0 + far)


def memory(layout: Layout) -> ExponentialMemory:
    """Return a memory that is passive whatever B is: z' = p z + B U, load Re(B^H z), Re p < 0."""
    random = np.random.default_rng(7)
    count, n = layout.count, len(layout.labels)
    modes, near = STATES // 2 * count, layout.nearness()
    unit = np.tile([RADIUS if dof in DOFS[3:] else 1.0 for dof in layout.dofs], count)
    own = np.arange(modes) * count // modes
    draws = random.uniform(-1.0, 1.0, (2, modes, n))
    felt = np.repeat(near[own], len(layout.dofs), axis=1) * unit
    inlet = (draws[0] + 1j * draws[1]) * felt * np.sqrt(0.05 * MASS)
    poles = -0.3 - 0.2 * random.random(modes) + 1j * (0.6 + 0.5 * random.random(modes))
    # Rows add up to less than 1 beside the 1 of the body itself: positive definite.
    apart = 0.3 * near / (near.sum(axis=1).max() - 1.0 if count > 1 else 1.0)
    np.fill_diagonal(apart, 1.0)
    each = np.kron(apart, np.eye(len(layout.dofs)))
    inertia: Array = np.asarray(0.5 * MASS * each * np.outer(unit, unit), dtype=float)
    report = {"n_states": 2 * modes, "passive": True}
    labels = layout.labels
    return ExponentialMemory(
        "made up", labels, labels, poles, inlet, inlet.conj().T, inertia, report
    )


def database(layout: Layout) -> hdb.HydroDatabase:
    """Return the database of an array: tables of its memory, and no waves."""
    fit = memory(layout)
    omega = np.linspace(0.2, 2.0, 10)
    radiation = np.array([fit.transfer(np.array([w]))[0] for w in omega])
    loads = np.zeros((len(omega), 1, len(layout.labels)), dtype=complex)
    disc = np.pi * RADIUS**2
    moments = np.array([0.0, 0.0, 0.25 * disc * RADIUS**2, 0.25 * disc * RADIUS**2, 0.0])
    bodies = {}
    for i, centre in enumerate(layout.places()):
        statics = hdb.Hydrostatics(MASS / RHO, centre, disc, moments)
        bodies[f"b{i}"] = hdb.Body(f"b{i}", centre, statics)
    return hdb.HydroDatabase(
        layout.labels,
        omega,
        fit.added_mass_inf + radiation.imag / omega[:, None, None],
        radiation.real,
        fit.added_mass_inf,
        np.zeros_like(fit.added_mass_inf),
        np.zeros(1),
        loads,
        loads,
        bodies,
        RHO,
        GRAVITY,
        memory={fit.name: fit},
    )


def write_array(folder: Path, layout: Layout) -> Path:
    """Write the case of an array and its database; return the path of the case."""
    folder.mkdir(parents=True, exist_ok=True)
    database(layout).write(folder / "hydro.h5")
    scene = hydrodae.Scene("array", directory=folder)
    scene.hydro(database="hydro.h5", radiation="exponential")
    for i, centre in enumerate(layout.places()):
        scene.body(
            f"b{i}",
            hydro=f"b{i}",
            motion="rigid" if layout.rigid else "heave",
            mass=MASS,
            inertia=[0.4 * MASS * RADIUS**2] * 3,
            center_of_gravity=centre.tolist(),
            initial={"displacement": [0.0, 0.0, 1.0 if i % 2 == 0 else -0.5]},
        )
    scene.solver(end_time=5.0)
    scene.output(step=0.1)
    (folder / "case.toml").write_text(scene.to_toml())
    return folder / "case.toml"
