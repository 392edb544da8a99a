"""An FMU under FMPy, both versions of the standard in one way."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("fmpy", reason="needs the extra cosim")

import fmpy
import fmpy.validation
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave


def problems(path: Path) -> list[str]:
    """What FMPy's validation finds."""
    return list(fmpy.validation.validate_fmu(str(path)))


def simulate(path: Path, **how: Any) -> Any:
    """A run by FMPy: structured array with "time"."""
    return fmpy.simulate_fmu(str(path), **how)


class Device:
    """One instance of an FMU, unpacked into a folder."""

    def __init__(self, path: Path, folder: Path) -> None:
        description = fmpy.read_model_description(str(path))
        self.fmi = int(description.fmiVersion[0])
        self.references = {v.name: v.valueReference for v in description.modelVariables}
        where = fmpy.extract(str(path), unzipdir=str(folder))
        self.fmu: Any = (FMU2Slave if self.fmi == 2 else FMU3Slave)(
            guid=description.guid,
            unzipDirectory=where,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="device",
        )
        self.fmu.instantiate()

    def __enter__(self) -> Device:
        return self

    def __exit__(self, *_: object) -> None:
        self.fmu.freeInstance()

    def begin(self, start: float = 0.0, stop: float | None = None) -> None:
        """Initialise, with nothing to set in between."""
        if self.fmi == 2:
            self.fmu.setupExperiment(startTime=start, stopTime=stop)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=start, stopTime=stop)
        self.fmu.exitInitializationMode()

    def step(self, t: float, h: float) -> None:
        self.fmu.doStep(currentCommunicationPoint=t, communicationStepSize=h)

    def get(self, *names: str) -> list[float]:
        read = self.fmu.getReal if self.fmi == 2 else self.fmu.getFloat64
        return list(read([self.references[name] for name in names]))

    def set(self, name: str, value: float) -> None:
        self.set_references([self.references[name]], [value])

    def set_references(self, references: Sequence[int], values: Sequence[float]) -> None:
        (self.fmu.setReal if self.fmi == 2 else self.fmu.setFloat64)(references, values)

    def save(self) -> bytes:
        """The state, serialised."""
        state = self.fmu.getFMUState()
        data = bytes(self.fmu.serializeFMUState(state))
        self.fmu.freeFMUState(state)
        return data

    def load(self, data: bytes) -> None:
        if self.fmi == 2:
            state = self.fmu.deSerializeFMUstate(data)
        else:
            state = self.fmu.deserializeFMUState(data)
        self.fmu.setFMUState(state)
        self.fmu.freeFMUState(state)
