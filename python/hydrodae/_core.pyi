"""The compiled kernel (python/bindings). Users call it through `Case` and `run`."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

version: str
lanes: int  #: Runs that a march takes side by side

class Scene:
    """A case file that was read and checked; immutable."""

    @property
    def title(self) -> str: ...
    @property
    def body_names(self) -> list[str]: ...
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def wave_names(self) -> list[str]: ...
    @property
    def text(self) -> str:
        """The case file as it was read."""
    @property
    def end_time(self) -> float:
        """End of the run, s."""
    @property
    def output_step(self) -> float:
        """Between samples, s."""
    @property
    def python_drives(self) -> list[str]:
        """Constraints whose drive is a Python function."""
    @property
    def python_forces(self) -> list[str]:
        """Forces whose law is a Python function."""
    @property
    def python_controllers(self) -> list[str]:
        """Controllers that are Python functions."""
    @property
    def database_path(self) -> str:
        """The hydrodynamic database, "" without."""
    @property
    def database_water(self) -> tuple[float, float, float]:
        """Density [kg/m3], gravity [m/s2] and depth [m] of the database, zeros without."""
    @property
    def files(self) -> list[tuple[str, str, str, str]]:
        """Files that the case reads: key, path in the case, path as opened, SHA-256."""
    @property
    def text_of_files(self) -> str:
        """A line 'SHA256 KEY = PATH' for each of them, as results files keep it."""
    def with_functions(self, digests: Mapping[str, str]) -> Scene:
        """A copy that counts Python functions, by key, among its files."""
    @property
    def places(self) -> dict[str, tuple[str, int, int]]:
        """Where each key stands: key path -> (file, line, column)."""
    def with_places(self, places: Mapping[str, tuple[str, int, int]]) -> Scene:
        """A copy in whose messages the keys stand at other places."""
    def summary(self) -> str: ...

def tables() -> list[dict[str, Any]]:
    """Every table of a case file with its keys, as nested dicts."""

def methods() -> list[dict[str, Any]]:
    """Every integrator: name, orders, adapts, fixes, limits_order, takes_radius."""

def suggestion(wanted: str, names: Sequence[str]) -> str:
    """The end of a message about an unknown name: the nearest one and all that are valid."""

def changed_file(before: str, now: str) -> str:
    """The first difference between two texts of `Scene.text_of_files` in words; empty: none."""

def check_tables(text: str) -> None:
    """Read the tables of a part of a case, each by itself. Raises CaseError."""

def load_case(path: str, overrides: Mapping[str, str]) -> Scene:
    """Read a case file; `overrides` maps dotted keys to TOML values. Raises CaseError."""

def parse_case(text: str, directory: str, overrides: Mapping[str, str]) -> Scene:
    """Read a case from a string; paths in it are relative to `directory`. Raises CaseError."""

def join_libraries(scene: Scene, paths: Sequence[str]) -> Scene:
    """A copy of the scene whose forces have their laws from these shared libraries.

    Raises CaseError.
    """

def examine(
    scene: Scene,
    drives: Mapping[str, Callable[[float], Sequence[float]]],
    forces: Mapping[str, Callable[[float, Any, Any], Any]] = ...,
) -> str:
    """The scene as a tree, what it costs, mobility and redundant rows. Raises CaseError."""

def count(scene: Scene) -> dict[str, int]:
    """Sizes of the equations of the scene, by name. Raises CaseError."""

def linearize(scene: Scene) -> dict[str, Any]:
    """The static equilibrium of the scene in still water and its linear model there.

    Raises CaseError.
    """

class CatenaryHold:
    horizontal: float
    vertical: float
    stiffness: NDArray[np.float64]
    out_of_plane: float
    on_seabed: float
    anchor_horizontal: float
    anchor_vertical: float
    tension: float

def catenary(
    x: float,
    z: float,
    length: Sequence[float],
    weight: Sequence[float],
    stiffness: Sequence[float],
    loads: Sequence[float],
    dry_weight: Sequence[float],
    dry_loads: Sequence[float],
    surface: float,
    seabed: bool,
    friction: float,
    points: Sequence[float],
) -> tuple[CatenaryHold, NDArray[np.float64]]:
    """What holds a line, and its profile (4, n_points). Raises CaseError."""

def wave_components(scene: Scene) -> NDArray[np.float64]:
    """Components of all wave systems, (n, 4): frequency, heading, amplitude, phase."""

SAMPLING_SPANS: int
SAMPLING_FEWEST: int
SAMPLING_PERIODS: float

def mean_interval(values: NDArray[np.float64]) -> tuple[float, float] | None:
    """95 % interval of the mean of a process, of which the values are a sample; None of too few."""

def with_images(
    coordinates: Sequence[str],
    points: Mapping[str, NDArray[np.float64]],
    added_mass_inf: NDArray[np.float64],
    omega: NDArray[np.float64],
    damping: Sequence[NDArray[np.float64]],
    heading: NDArray[np.float64],
    excitation: Sequence[NDArray[np.complex128]],
    water: Sequence[float],
) -> tuple[NDArray[np.float64], list[NDArray[np.complex128]]]:
    """Headings and excitation, one table (nw, n) a heading, with those that symmetry adds.

    See cpp/hydrodae/hydro/symmetry.h. `points`: reference point of each body; `water`: rho,
    gravity, depth.
    """

class Headings:
    """Between the headings (nh,) of a database, ascending [rad]; cpp/hydrodae/hydro/headings.h."""

    def __init__(self, heading: NDArray[np.float64]) -> None: ...
    def covered(self, heading: float) -> float | None:
        """The heading turned into the table, None outside of it."""
    def weights(self, heading: float) -> NDArray[np.float64]:
        """What each heading of the table counts, (nh,), at a heading from `covered`."""
    def doubt(self, miss: float) -> float:
        """Share by which forces between headings may be off, from the largest miss."""
    @property
    def misses(self) -> NDArray[np.float64]:
        """What interpolation without every other heading misses, from the forces (n, nh)."""

def simulate_together(
    scenes: Sequence[Scene],
    signals: Sequence[tuple[Sequence[tuple[str, str, float, int]], float, bool, float]] = ...,
) -> list[dict[str, Any] | str]:
    """Run scenes that differ in their seas and take-offs side by side, without samples.

    `signals`: sums of terms (channel, component, factor, power), each with its start [s] (negative:
    the end of the ramp), whether its turning points are wanted, and the frequency [Hz] of a Fourier
    integral (negative: none).

    Returns for each scene the attributes that its results file would have, with one dict a signal
    under "measured", or the reason why it has to be run by itself.
    """

def simulate(
    scene: Scene,
    output: str,
    progress: Callable[[float, float], bool] | None,
    drives: Mapping[str, Callable[[float], Sequence[float]]],
    forces: Mapping[str, Callable[[float, Any, Any], Any]] = ...,
    controllers: Mapping[str, Callable[..., Any]] = ...,
    again: Mapping[str, Callable[..., Any]] = ...,
    verify: str = "",
    checkpoint: float = -1.0,
    resume: bool = False,
    strict: bool = False,
) -> dict[str, Any]:
    """Run `scene` and write `output`; `progress(t, t_end)` returns False to stop.

    `drives` has a function t -> (f, f', f'') for every constraint in `scene.python_drives`;
    `forces` a law t, x, v -> load for every force in `scene.python_forces`;
    `controllers` a function t, inputs ... -> outputs for every one in `scene.python_controllers`;
    `again`: those of `controllers` that a second run may call, by name; `verify`: method of the
    second run, by which the error is estimated, "": the same; `checkpoint`: wall time between
    checkpoints [s], negative: none; `resume`: goes on from one;
    `strict`: an estimate of the error is needed.
    Returns the status ("completed" or "interrupted"), the statistics of the solver, notes, and
    `reproducible_until` [s] of each body and line whose error is estimated. Raises SolverError when
    the integration fails; the file then holds what was computed.
    """

class ResultsReader:
    """A results file of this process, open for reading; RuntimeError where it cannot be read."""

    def __init__(self, path: bytes | str) -> None: ...
    def close(self) -> None: ...
    def datasets(self) -> list[bytes]:
        """Paths of all datasets."""
    def has(self, member: str) -> bool:
        """Whether there is such a member of the root."""
    def attributes(self, object: str) -> dict[str, Any]:
        """Attributes of a group or dataset: texts, numbers, lists of numbers."""
    def shape(self, dataset: str) -> tuple[int, ...]: ...
    def read(self, dataset: str, rows: int) -> tuple[bytearray, tuple[int, ...]]:
        """The first rows of a dataset as float64 numbers, and their shape."""

class State:
    """All that a run is at an accepted instant: a value that can be copied, compared, pickled."""

    @property
    def time(self) -> float:
        """Of the instant, s."""
    @property
    def y(self) -> NDArray[np.float64]:
        """The unknowns (n,)."""
    @property
    def yp(self) -> NDArray[np.float64]:
        """Their rates (n,)."""
    def __copy__(self) -> State: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> State: ...

class Stepper:
    """A run that Python drives, step by step; users have `hydrodae.Simulation`."""

    def __init__(
        self,
        scene: Scene,
        drives: Mapping[str, Callable[[float], Sequence[float]]],
        forces: Mapping[str, Callable[[float, Any, Any], Any]] = ...,
        controllers: Mapping[str, Callable[..., Any]] = ...,
    ) -> None: ...
    def advance(self, limit: float) -> float:
        """One accepted step, to `limit` [s] at most; returns the time reached."""
    def state(self) -> State: ...
    def restore(self, state: State) -> None: ...
    def read(self, channel: str) -> list[float]:
        """The values of a channel now."""
    def write(self, input: str, value: float) -> None:
        """Holds an input at a value from now on."""
    @property
    def time(self) -> float: ...
    @property
    def finished(self) -> bool: ...
    @property
    def channels(self) -> list[tuple[str, int, str]]:
        """(name, width, unit) of each."""
    @property
    def inputs(self) -> dict[str, float]:
        """What each input is held at."""
    @property
    def input_units(self) -> dict[str, str]:
        """Unit of each input."""
    def close(self) -> None:
        """Tells controllers that are other programs of the end."""
