"""`hydrodae.spectral`: the motion in the sea of a case with drag and friction linearised in it."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from hydrodae.case.case import CaseLike
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel, Response
from hydrodae.linear.response import moves
from hydrodae.linear.sea import in_waves, wave_components
from hydrodae.study.slow import SlowMotion, slow_motion
from hydrodae.study.spectral import text
from hydrodae.study.spectral.air import air_notes, curved_outlets, turbine_powers
from hydrodae.study.spectral.linearise import all_notes, dampings, mean_powers, nonlinear_loads
from hydrodae.study.spectral.output import write
from hydrodae.study.spectral.seeds import Seeds, comparison, time_domain
from hydrodae.study.spectral.solve import equivalents
from hydrodae.support.arrays import Array, Complex

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class Spectral:
    """Motion in the sea of a case; printed, it is what the command `hydrodae spectral` says.

    Attributes
    ----------
    model : LinearModel
        The linearised case, without the slopes at rest of what was linearised in the sea.
    waves : (nw, 4) array
        Components of the sea: frequency [rad/s], heading [rad], amplitude [m], phase [rad].
    names, units : tuple of str
        Channels (coordinates, joints, reactions) and their units per metre of wave amplitude.
    values : (nw, n) complex array
        Phasors per metre of wave amplitude, phase zero when the crest passes the origin.
    standard_deviation : dict
        Of every channel [m, rad, N, N m], and of "sea/elevation" [m].
    rate : dict
        Standard deviation of the rates of coordinates and joints [m/s, rad/s].
    power : dict
        Mean power that each force along a joint, viscous damping, chamber (all its outlets) and
        outlet takes; of a turbine with an efficiency also by `outlets/NAME/power_turbine`,
        `power_shaft` and `power_electric` [W].
    damping : dict
        Linear equivalents by name: c of a force along a joint [N s/m, N m s]; of viscous damping
        (6, 6), its quadratic part [N s/m, N s, N m s]; of a Morison element (segments, 3, 3)
        in world axes [N s/m], over the velocity of the water against the body.
    outlet : dict
        Mass flow over drop of pressure of each outlet whose slope depends on it [kg/(s Pa)].
    iterations : int
    change : float
        Relative change of the equivalents in the last iteration [-].
    time : float
        Wall time of the iteration and the responses, without reading and linearising [s].
    notes : list of str
        What is left out.
    slow : SlowMotion or None
        Slow loads and motion by pairs of waves, with the same equivalents; None of a case without.
    """

    model: LinearModel
    waves: Array
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: Complex
    standard_deviation: dict[str, float]
    rate: dict[str, float]
    power: dict[str, float]
    damping: dict[str, Any]
    outlet: dict[str, float]
    iterations: int
    change: float
    time: float
    notes: list[str]
    slow: SlowMotion | None = None

    def spectrum(self, name: str, per_band: int = 4) -> tuple[Array, Array]:
        """Spectral density of a channel over bands of frequency.

        Parameters
        ----------
        name : str
            Of `names`, or "sea/elevation".
        per_band : int
            Wave components in each band.

        Returns
        -------
        omega : (n + 1,) array
            Edges of the bands [rad/s].
        density : (n,) array
            Mean density in each [unit2 s/rad]: the sum times the widths is the variance.

        Raises
        ------
        CaseError
            No such channel, or fewer than two components.
        """
        order = np.argsort(self.waves[:, 0], kind="stable")
        omega, half = self.waves[order, 0], 0.5 * self.waves[order, 2] ** 2
        if len(np.unique(omega)) < 2:
            raise CaseError("a sea of one frequency has no spectral density")
        if name == "sea/elevation":
            squares = half
        else:
            squares = half * np.abs(self.channel(name)[order]) ** 2
        starts = np.arange(per_band, len(omega) - per_band + 1, per_band)
        inner = 0.5 * (omega[starts - 1] + omega[starts])
        edges = np.unique([omega[0], *inner, omega[-1]])
        inside = np.clip(np.searchsorted(edges, omega, side="right") - 1, 0, len(edges) - 2)
        sums = np.bincount(inside, squares, len(edges) - 1)
        return edges, sums / np.diff(edges)

    def channel(self, name: str) -> Complex:
        """Phasors (nw,) of a channel per metre of wave amplitude."""
        if name not in self.names:
            raise CaseError(f"no response {name!r}; there are: {', '.join(self.names)}")
        return np.asarray(self.values[:, self.names.index(name)])

    def dataset(self) -> xarray.Dataset:
        """All of it as xarray; see `write`."""
        from hydrodae.study.spectral.output import dataset

        return dataset(self)

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Write the phasors of all channels and what follows from them: .csv, .nc or .h5.

        Raises
        ------
        CaseError
            Another ending.
        """
        return write(path, self)

    def time_domain(
        self, seeds: int | Sequence[int] = 10, *, settle: float = 100.0, jobs: int = 1
    ) -> Seeds:
        """Run the case in the time domain with other seeds of its sea.

        Parameters
        ----------
        seeds : int or sequence of int
            How many, 1, 2, ...; or which.
        settle : float
            Time from the start that is left out [s].
        jobs : int
            Runs at a time.

        Returns
        -------
        Seeds
            Standard deviations of every run; `comparison` prints them beside these.

        Raises
        ------
        CaseError
            The case cannot be run, nothing in its sea is random, or the runs are too short or few.
        SolverError
            A run failed.
        """
        if self.model.memory_missing is not None:
            raise self.model.memory_missing
        names = {
            name: unit.removesuffix("/m")
            for name, unit in zip(self.names, self.units, strict=True)
            if name in self.rate
        }
        chosen = range(1, seeds + 1) if isinstance(seeds, int) else seeds
        return time_domain(self.model.case, names, list(chosen), settle, jobs)

    def comparison(self, runs: Seeds) -> str:
        """Return standard deviations and mean powers beside those of runs, and what both cost."""
        return comparison(self, runs)

    def __str__(self) -> str:
        return text.table(self)


def spectral(
    case: CaseLike | LinearModel,
    *,
    set: Mapping[str, Any] | None = None,
    tolerance: float = 1e-6,
    iterations: int = 2000,
) -> Spectral:
    """Motion of a case in its sea in the frequency domain, nonlinear damping linearised in it.

    Linear loads replace drag of Morison elements, quadratic viscous damping, friction along joints
    and power take-offs that are nonlinear in the rate. They miss these least in the mean square,
    for the motion that follows with them: Gaussian in a sea of many components, harmonic (Lorentz)
    in one of a single one. Orifices and turbines of chambers have the slope that takes the same
    power from the air. The drag of Morison elements is that of the motion
    of the water against the body, and so excites it as well.

    Parameters
    ----------
    case : Case, Scene, path or LinearModel
        The case, the path of its file, or the case as it was linearised before.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key; not for a LinearModel.
    tolerance : float
        Relative change of the equivalents that ends the iteration [-].
    iterations : int
        Largest number of them.

    Returns
    -------
    Spectral

    Raises
    ------
    CaseError
        The case cannot be used, has no waves or no equilibrium near its start; a nonlinear load
        has no equivalent here (a hydraulic power take-off, limits beside a spring, drag in a
        current); or the iteration does not settle.
    DatabaseError
        A wave is outside the database, or nothing in the case feels waves.

    Notes
    -----
    Other nonlinear loads (stops, ropes, hardening springs, moorings) have their slope at rest, as
    in `hydrodae.rao`; `Spectral.notes` list them. Means do not change: a law that is not odd
    in the rate has a mean load, which is reported but left out.

    References
    ----------
    Borgman, Proc. ASCE J. Waterways Harbors 95 (1969); Atalik, Utku, Earthquake Engineering and
    Structural Dynamics 4 (1976) 411-420; Folley, Whittaker, Proc. EWTEC (2010), spectral-domain
    models of wave energy converters.
    """
    if not tolerance > 0.0 or iterations < 1:
        raise CaseError(
            f"tolerance = {tolerance:g}, iterations = {iterations}: expected numbers > 0"
        )
    model = LinearModel.of(case, set)
    loads, model = nonlinear_loads(model)
    outlets = curved_outlets(model)
    start = perf_counter()
    waves = wave_components(model.case)
    found = equivalents(model, loads, waves, tolerance, iterations, outlets)
    model = model.with_outlets(found.slopes)
    responses: list[tuple[NDArray[np.intp], Response]] = []

    def respond(omega: Array, heading: float) -> Response:
        mine = np.flatnonzero(waves[:, 1] == heading)
        response = model.response(omega, heading, damping=found.damping, force=found.force[mine])
        responses.append((mine, response))
        return response

    deviation, power = in_waves(respond, waves)
    names, units = responses[0][1].names, responses[0][1].units
    values = np.empty((len(waves), len(names)), dtype=complex)
    for mine, response in responses:
        values[mine] = response.values
    half = 0.5 * (waves[:, 2] * waves[:, 0]) ** 2
    rates = np.sqrt(half @ np.abs(values) ** 2)
    return Spectral(
        model=model,
        waves=waves,
        names=names,
        units=units,
        values=values,
        standard_deviation=deviation,
        rate={name: float(rates[k]) for k, name in enumerate(names) if moves(name)},
        power=power | mean_powers(loads, found) | turbine_powers(model, found.drops),
        damping=dampings(loads, found),
        outlet=found.slopes,
        iterations=found.iterations,
        change=found.change,
        time=perf_counter() - start,
        notes=[*all_notes(model, loads, outlets), *air_notes(model, found.drops)],
        slow=slow_motion(model, found.damping),
    )
