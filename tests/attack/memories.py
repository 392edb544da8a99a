"""Bad memories: radiation that feeds the motion, in every rung; and sound ones beside them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
from tests.attack import sea, truth
from tests.attack.family import chosen, family, log_uniform, unnamed
from tests.attack.parts import case, position
from tests.stability import Scene, past, truths, water

KIND = "bad memories"
FEEDS = "the radiated waves would feed the motion"
RUNGS = ("exponential", "convolution", "constant")


def _options(rung: str) -> dict[str, Any]:
    return {"radiation": rung, **({"frequency": 1.45} if rung == "constant" else {})}


def flipped(path: Path, factor: float) -> None:
    """Put the sphere's database at a path with its radiation in heave times a negative factor."""
    sea.stored(path)
    with h5py.File(path, "r+") as file:
        file["radiation_damping"][:, sea.HEAVE, sea.HEAVE] *= factor
        file["memory/heave/output_matrix"][...] *= factor
        file["radiation_kernel/kernel"][...] *= factor


def _draw_flip(g: np.random.Generator) -> dict[str, Any]:
    return dict(rung=RUNGS[g.integers(3)], factor=-log_uniform(g, 0.05, 1.0))


@family(KIND, _draw_flip)
@chosen(rung="exponential", factor=-1.0)
@chosen(rung="convolution", factor=-1.0)
@chosen(rung="constant", factor=-1.0)
@chosen(rung="exponential", factor=-0.1)
@chosen(rung="convolution", factor=-0.1)
@chosen(rung="constant", factor=-0.1)
@chosen(rung="exponential", factor=-1.0, kind="ship")
def flipped_sphere(rung: str, factor: float) -> Scene:
    """The decay of the sphere, its radiation times a negative factor."""
    tables = case([sea.float_body(displacement=[0.0, 0.0, 1.0])], 60.0, hydro=_options(rung))
    return unnamed(
        title=f"a sphere whose {rung} radiation is flipped ({factor:g})",
        tables=tables,
        size=1.0,
        time_scale=0.7,
        source="still water gives no energy",
        truth=None,
        measured=position("sphere", 2),
        impossible=FEEDS,
        database=lambda path: flipped(path, factor),
    )


def _draw_band(g: np.random.Generator) -> dict[str, Any]:
    return {"rung": RUNGS[g.integers(3)], "excess": g.uniform(1.5, 4.0)}


@family(KIND, _draw_band, alone=True)
@chosen(rung="exponential", excess=2.0)
@chosen(rung="convolution", excess=2.0)
@chosen(rung="constant", excess=2.0)
def band_that_feeds(rung: str, excess: float) -> Scene:
    """The sphere with a band about its resonance whose damping is negative, the rest as it is.

    H(s) less r s' / (s'^2 + ...): one pair of poles -0.1 +- 1.45i is added, with a negative gain.
    """

    def write(path: Path) -> None:
        sea.stored(path)
        pole = -0.1 + 1.45j
        damping = float(sea.sphere().radiation(np.array([1.45])).real[0])
        gain = -2.0 * excess * damping * 0.1  # of Re(gain exp(pole t)): B(1.45) = gain / 0.2
        with h5py.File(path, "r+") as file:
            omega = file["omega"][:]
            added = 0.5 * gain * (1.0 / (1j * omega - pole) + 1.0 / (1j * omega - pole.conjugate()))
            at = (slice(None), sea.HEAVE, sea.HEAVE)
            file["radiation_damping"][at] += added.real
            file["added_mass"][at] += added.imag / omega
            fit = file["memory/heave"]
            for name, value, axis in (
                ("poles", [pole], 0),
                ("input_matrix", [[1.0 + 0j]], 0),
                ("output_matrix", [[gain + 0j]], 1),
            ):
                longer = np.concatenate([fit[name][:], value], axis=axis)
                del fit[name]
                fit[name] = longer
            fit.attrs["n_states"] = int(fit.attrs["n_states"]) + 2
            kernel = file["radiation_kernel"]
            time = kernel["time"][:]
            kernel["kernel"][:, 0, 0] += gain * (np.exp(pole * time)).real

    tables = case([sea.float_body(displacement=[0.0, 0.0, 1.0])], 60.0, hydro=_options(rung))
    return unnamed(
        title=f"a sphere whose {rung} radiation feeds its resonance",
        tables=tables,
        size=1.0,
        time_scale=0.7,
        source="still water gives no energy",
        truth=None,
        measured=position("sphere", 2),
        impossible=FEEDS,
        database=write,
    )


def _draw_false(g: np.random.Generator) -> dict[str, Any]:
    return {"residue": -log_uniform(g, 20.0, 2000.0)}


@family(KIND, _draw_false)
@chosen(residue=-800.0)
@chosen(residue=-100.0)
@chosen(residue=-800.0, kind="ship")
def falsely_passive(residue: float) -> Scene:
    """A float whose memory says that it is passive and is not."""

    def write(path: Path) -> None:
        water.write(path, residue, water.ADDED_MASS)
        with h5py.File(path, "r+") as file:
            file["memory/heave"].attrs["passive"] = True

    return unnamed(
        title="a memory with a false attribute `passive`",
        tables=water.float_tables(),
        size=1.0,
        time_scale=0.5,
        source="still water gives no energy",
        truth=None,
        measured=water.heave,
        impossible=FEEDS,
        database=write,
    )


def _draw_sound(g: np.random.Generator) -> dict[str, Any]:
    return {"release": log_uniform(g, 1e-3, 1.0)}


@family(KIND, _draw_sound)
@chosen(release=1.0)
@chosen(release=1e-3)
@chosen(release=0.1, kind="ship")
def sound_sphere(release: float) -> Scene:
    """The decay of the sphere as it is (a check must not refuse it)."""
    s = sea.sphere()
    exact = truth.integrated(
        rates=s.rates(lambda _t: 0.0),
        start=s.start(release),
        place=lambda _t, y: [y[0]],
        scale=release,
        rtol=1e-10,
    )
    tables = case([sea.float_body(displacement=[0.0, 0.0, release])], 40.0)
    return unnamed(
        title=f"decay of the sphere from {release:g} m",
        tables=tables,
        size=release,
        time_scale=0.7,
        source="linear states of the same tables (DOP853)",
        truth=exact,
        measured=position("sphere", 2, origin=[0.0, 0.0, -sea.DRAFT]),
        database=sea.stored,
    )


@family(KIND, lambda g: {"rung": RUNGS[g.integers(3)]}, alone=True)
@chosen(rung="convolution")
@chosen(rung="constant")
def sound_float(rung: str) -> Scene:
    """A float with the kernel 800 exp(-t), or with a constant damping."""
    inertia = water.MASS + water.ADDED_MASS
    system = np.array([[0, 1, 0], [-water.STIFFNESS / inertia, 0, -1 / inertia], [0, 800.0, -1.0]])
    options: dict[str, Any] = {"radiation": rung}
    if rung == "convolution":
        options["memory_length"] = 20.0

    def write(path: Path) -> None:
        past._write(path)
        if rung == "constant":
            with h5py.File(path, "r+") as file:
                omega = np.linspace(0.2, 6.0, 30)
                file["omega"] = omega
                file["added_mass"] = np.full((30, 1, 1), water.ADDED_MASS)
                file["radiation_damping"] = np.full((30, 1, 1), 300.0)

    if rung == "constant":
        system = np.array([[0, 1], [-water.STIFFNESS / inertia, -300.0 / inertia]])
        options["frequency"] = 2.0
    tables = water.float_tables() | {"hydro": options}
    return unnamed(
        title=f"a float with sound {rung} radiation",
        tables=tables,
        size=1.0,
        time_scale=0.5,
        source="closed form by eigenvectors",
        truth=truths.linear(system, [1.0, 0.0, 0.0][: len(system)], 0),
        measured=water.heave,
        database=write,
    )
