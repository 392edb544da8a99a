"""Synthetic results in the layout of results.h5, and a kernel that writes them."""

from __future__ import annotations

import dataclasses
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import h5py
import numpy as np
import pytest
from tests.python.wecsim_files import cylinders, two_bodies

import hydrodae
from hydrodae import _core
from hydrodae.errors import CaseError, SolverError
from hydrodae.starters import create

__all__ = ["cylinders", "two_bodies"]

PERIOD = 14.0  # s
DECAY = 0.01  # 1/s
AMPLITUDE = np.radians(10.0)

Channels = dict[str, tuple[np.ndarray, str, str]]


def decay_channels(time: np.ndarray) -> Channels:
    """Two flaps on a fixed base, as closed forms: flap 1 decays, flap 2 is pushed by it."""
    omega = 2 * np.pi / PERIOD
    angle = AMPLITUDE * np.exp(-DECAY * time) * np.cos(omega * time)
    rate = np.gradient(angle, time) if len(time) > 1 else 0 * time
    second = 0.02 * np.radians(10.0) * np.minimum(time, 40.0) / 10.0 * np.sin(omega * time)
    zero = np.zeros_like(time)
    channels: Channels = {
        "joints/hinge1/angle": (angle, "rad", "marker A of hinge1"),
        "joints/hinge1/angle_rate": (rate, "rad/s", "marker A of hinge1"),
        "joints/hinge2/angle": (second, "rad", "marker A of hinge2"),
        "energy/kinetic": (1e6 * rate**2, "J", "world"),
        "energy/kinetic_added_mass": (3e6 * rate**2, "J", "world"),
        "energy/potential": (4e6 * omega**2 * angle**2 - 5e6, "J", "world"),
        "energy/balance_error": (1e-3 * np.sin(time), "J", "world"),
        "solver/order": (zero + 4, "-", "-"),
    }
    for body, x, turn in (("base", 0.0, zero), ("flap1", -12.5, angle), ("flap2", 12.5, second)):
        arm = 3.5 if turn is not zero else 0.0
        position = np.stack([x + arm * np.sin(turn), zero, arm * np.cos(turn) - 9.0], axis=1)
        rotation = np.stack([zero, turn, zero], axis=1)
        quaternion = np.stack([np.cos(turn / 2), zero, np.sin(turn / 2), zero], axis=1)
        channels[f"bodies/{body}/position"] = (position, "m", "world")
        channels[f"bodies/{body}/rotation"] = (rotation, "rad", "world")
        channels[f"bodies/{body}/orientation"] = (quaternion, "-", "world")
    return channels


def write_results(
    path: Path,
    time: np.ndarray,
    channels: Channels | None = None,
    status: str = "completed",
    **attributes: object,
) -> Path:
    """Write `channels` (values, unit, frame) by name as results.h5."""
    with h5py.File(path, "w") as file:
        file.attrs.update(
            {
                "format": "hydrodae-results",
                "format_version": 1,
                "title": "Flap decay",
                "case_text": 'title = "Flap decay"\n',
                "case_path": "flap_decay.toml",
                "version": "0.1.0",
                "status": status,
                "message": "",
                **attributes,
            }
        )
        file["time"] = time
        file["time"].attrs["unit"] = "s"
        for name, (values, unit, frame) in (channels or decay_channels(time)).items():
            file[name] = values
            file[name].attrs.update({"unit": unit, "frame": frame, "description": f"{name}."})
        file.require_group("solver").attrs.update(
            {"steps": 812, "residual_calls": 1204, "jacobian_calls": 41, "wall_time": 0.05}
        )
    return path


@pytest.fixture
def results_writer(tmp_path: Path) -> Callable[..., Path]:
    """Write results.h5 into the test's folder; arguments as `write_results` without the path."""

    def write(time: np.ndarray | None = None, *, name: str = "results.h5", **options: Any) -> Path:
        return write_results(
            tmp_path / name, np.linspace(0, 100, 1001) if time is None else time, **options
        )

    return write


@pytest.fixture
def results_file(results_writer: Callable[..., Path]) -> Path:
    """A completed run of 100 s."""
    return results_writer()


class Kernel:
    """Stands in for hydrodae._core: a run of 10 s in steps of 1 s that writes what it reached.

    `fail_at` [s] makes it raise SolverError there.
    """

    version = "0.1.0"

    def __getattr__(self, name: str) -> Any:
        """Give what reads results, and constants, as they are."""
        return getattr(_core, name)

    def __init__(self) -> None:
        self.fail_at: float | None = None
        self.overrides: dict[str, str] = {}
        self.runs = 0

    def load_case(self, path: str, overrides: dict[str, str]) -> SimpleNamespace:
        return self.parse_case(Path(path).read_text(), str(Path(path).parent), overrides)

    def parse_case(self, text: str, directory: str, overrides: dict[str, str]) -> SimpleNamespace:
        for key in overrides:
            if not key.startswith("solver."):
                raise CaseError(f"<case>:1:1: unknown key {key}; the nearest is solver.rtol")
        self.overrides = dict(overrides)
        return SimpleNamespace(
            title=tomllib.loads(text)["title"],
            text=text,
            body_names=["base", "flap1", "flap2"],
            joint_names=["hinge1", "hinge2"],
            end_time=10.0,
            output_step=1.0,
            python_drives=[],
            python_forces=[],
            python_controllers=[],
            summary=lambda: f"3 bodies, 2 joints, paths from {directory}",
        )

    def simulate(
        self,
        scene: SimpleNamespace,
        output: str,
        progress: Callable[[float, float], bool],
        drives: dict[str, Any],
        forces: dict[str, Any],
        controllers: dict[str, Any],
        again: dict[str, Any],
        verify: str = "",
        checkpoint: float = -1.0,
        resume: bool = False,
        strict: bool = False,
    ) -> dict[str, Any]:
        assert not drives
        assert not forces
        assert not controllers
        assert not again
        assert not verify
        self.runs += 1
        times, status, message = [0.0], "completed", ""
        while times[-1] < scene.end_time:
            if times[-1] == self.fail_at:
                status, message = "failed", f"t = {times[-1]} s: IDA_CONV_FAIL in joint hinge1"
                break
            if not progress(times[-1], scene.end_time):
                status = "interrupted"
                break
            times.append(times[-1] + 1.0)
        write_results(Path(output), np.array(times), status=status, message=message)
        if status == "failed":
            raise SolverError(message)
        return {
            "status": status,
            "steps": len(times) - 1,
            "notes": [],
            "reproducible_until": {},
        }


@pytest.fixture
def kernel(monkeypatch: pytest.MonkeyPatch) -> Kernel:
    """A kernel without C++ in place of hydrodae._core."""
    stand_in = Kernel()
    monkeypatch.setattr(hydrodae, "_core", stand_in, raising=False)
    monkeypatch.setitem(sys.modules, "hydrodae._core", stand_in)
    return stand_in


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    """A case file that the stand-in kernel reads."""
    path = tmp_path / "flap_decay.toml"
    path.write_text('title = "Flap decay"\n')
    return path


@pytest.fixture(scope="session")
def sphere_tables(repository: Path) -> Any:
    """Tables of cases/sphere, of 100 frequencies in deep water, without their fits."""
    from hydrodae import hdb

    whole = hdb.read(repository / "cases" / "sphere" / "hydro.h5")
    return dataclasses.replace(whole, kernel=None, memory={})


@pytest.fixture(scope="session")
def sphere(sphere_tables: Any) -> Any:
    """The same, by the name of the body; a file may have a sphere of its own."""
    return sphere_tables


@pytest.fixture(scope="session")
def sphere_file(sphere_tables: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The same as a netCDF file of Capytaine."""
    from hydrodae.hdb.database import writers

    path = tmp_path_factory.mktemp("sphere") / "sphere.nc"
    writers.write_capytaine(sphere_tables, path)
    return path


@pytest.fixture(scope="session")
def device_tables(repository: Path) -> Any:
    """Tables of cases/f3of: base, flap1 and flap2 at five headings, without their fits."""
    from hydrodae import hdb

    whole = hdb.read(repository / "cases" / "f3of" / "hydro.h5")
    return dataclasses.replace(whole, memory={})


@pytest.fixture(scope="module")
def buoy(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The case of the starter `point_absorber`."""
    return create("point_absorber", tmp_path_factory.mktemp("cases") / "buoy")
