"""Response amplitude operators of a case, linearised about its static equilibrium."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hydrodae.case.case import CaseLike
from hydrodae.errors import CaseError
from hydrodae.linear import LinearModel, Mode, Response
from hydrodae.study.drift.far_field import Drift, drift_of
from hydrodae.study.drift.scene import Surroundings
from hydrodae.study.drift.text import columns
from hydrodae.study.rao import output, text
from hydrodae.study.rao.regular_waves import Harmonic, time_domain
from hydrodae.study.slow import SlowMotion, slow_motion
from hydrodae.study.slow.text import table as slow_table
from hydrodae.support.arrays import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure


FREQUENCIES = 400


@dataclass(frozen=True)
class Rao:
    """Natural modes and responses of a case, linearised about its static equilibrium.

    Printed, it is what the command `hydrodae rao` says.

    Attributes
    ----------
    model : LinearModel
        The linearised case; `model.notes` list what it leaves out.
    modes : list of Mode
        Natural modes, longest period [s] first.
    response : Response
        Over all frequencies of the database (nw,) [rad/s], closer about the peaks; without a
        database at the chosen ones. Phasors (nw, n) per metre of wave amplitude [m/m, rad/m, N/m,
        N m/m], mean power of the dampers (nw,) [W/m2].
    chosen : Response
        The same at the periods asked for, in their order.
    periods : tuple of float or None
        Those that were asked for [s]; None if they were chosen within the database.
    """

    model: LinearModel
    modes: list[Mode]
    response: Response
    chosen: Response
    periods: tuple[float, ...] | None = None

    @property
    def notes(self) -> list[str]:
        """What a linear model has to leave out of this case."""
        return self.model.notes

    def in_sea(self) -> tuple[dict[str, float], dict[str, float]]:
        """Response in the sea of the case; see `hydrodae.linear.LinearModel.irregular`.

        Returns
        -------
        standard_deviation : dict
            Of every channel, in its unit [m, rad, N, N m].
        power : dict
            Mean power of every damper [W].

        Raises
        ------
        CaseError
            The case has no waves.
        DatabaseError
            Its waves are outside the database.
        """
        return self.model.irregular()

    def slow_motion(self) -> SlowMotion | None:
        """Return slow loads and motion by the pairs of waves of the case; None without.

        Raises
        ------
        CaseError
            The tables of second order do not cover its waves.
        """
        return slow_motion(self.model)

    def drift(self) -> Drift:
        """Return mean drift in the waves of `response`, or at the periods asked for.

        Raises
        ------
        CaseError, DatabaseError
            As `hydrodae.drift`.
        """
        shown = self.response if self.periods is None else self.chosen
        return drift_of(Surroundings(self.model), np.unique(shown.omega), [shown.heading])

    def regular_waves(
        self, *, amplitude: float = 0.01, settle: float = 100.0, jobs: int | None = None
    ) -> list[Harmonic]:
        """Run the case in regular waves at the chosen frequencies, in parallel processes.

        Parameters
        ----------
        amplitude : float
            Of the waves [m].
        settle : float
            Time between the ramp, ten periods, and the fit of the harmonics [s].
        jobs : int, optional
            Runs at a time; default: all cores.

        Returns
        -------
        list of Harmonic
            One for each frequency of `chosen`.

        Raises
        ------
        CaseError
            The case is not in a file, or cannot be run.
        SolverError
            A run failed.
        """
        if self.model.memory_missing is not None:
            raise self.model.memory_missing
        return time_domain(
            self.model.case,
            self.chosen.omega.tolist(),
            self.chosen.heading,
            text.coordinates(self.response),
            amplitude=amplitude,
            settle=settle,
            jobs=jobs,
        )

    def write(self, path: str | os.PathLike[str], drift: Drift | None = None) -> Path:
        """Write all responses: at the periods asked for, else over all frequencies.

        Parameters
        ----------
        path : path
            Its ending says how: .csv, or .nc and .h5 (netCDF, which is HDF5).
        drift : Drift, optional
            Mean drift of the same case and frequencies, written beside.

        Raises
        ------
        CaseError
            Another ending.
        """
        shown = self.response if self.periods is None else self.chosen
        return output.write(path, shown, {} if drift is None else columns(drift, shown.omega))

    def draw(self) -> Figure:
        """Draw the amplitudes over the period [s].

        Raises
        ------
        CaseError
            Nothing moves.
        """
        case = self.model.case
        title = case.title or ("" if case.path is None else case.path.stem)
        return output.draw(self.response, title)

    def table(self) -> str:
        """Return peaks, their periods and the values at the chosen ones, one line a response."""
        return text.table(self.response, self.chosen)

    def sea_table(self) -> str:
        """Return `in_sea` as text, and `slow_motion` of a case with it; raises as those."""
        deviation, power = self.in_sea()
        told = text.sea_table(self.response, deviation, power)
        slow = self.slow_motion()
        return told if slow is None else f"{told}\n\n{slow_table(slow, deviation)}"

    def __str__(self) -> str:
        parts = [text.opening(self.notes, self.modes), self.table()]
        if self.model.case.scene.wave_names:
            parts.append(self.sea_table())
        return "\n\n".join(parts)


def rao(
    case: CaseLike | LinearModel,
    *,
    periods: Sequence[float] | None = None,
    heading: float = 0.0,
    set: Mapping[str, Any] | None = None,
) -> Rao:
    """Linearise a case about its static equilibrium and solve it in the frequency domain.

    A(w), B(w) and the excitation are those of the database, without any fit of the memory.

    Parameters
    ----------
    case : Case, Scene, path or LinearModel
        The case, the path of its file, or the case as it was linearised before.
    periods : sequence of float, optional
        Wave periods of `Rao.chosen` [s]; default: up to six within the database.
    heading : float
        Direction of travel of the waves [rad], 0 = +x.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key; not for a LinearModel.

    Returns
    -------
    Rao

    Raises
    ------
    CaseError
        The case cannot be used, it has no equilibrium near its start, a period is not positive, or
        it has no database and no `periods` were given.
    DatabaseError
        A period or the heading is outside the database, or nothing in the case feels waves.

    Examples
    --------
    >>> found = rao("cases/f3of/flap_decay.toml", periods=[8.0, 12.0])  # doctest: +SKIP
    >>> found.chosen["joints/hinge1/angle"]  # doctest: +SKIP
    """
    model = LinearModel.of(case, set)
    if not np.isfinite(heading):
        raise CaseError(f"heading {heading:g}: expected a direction of travel", key="heading")
    chosen = model.response(_chosen(model, periods), heading)
    return Rao(
        model,
        model.modes(),
        _curves(model, chosen.omega, heading),
        chosen,
        None if periods is None else tuple(map(float, periods)),
    )


def _chosen(model: LinearModel, periods: Sequence[float] | None) -> Array:
    """Frequencies [rad/s] of the periods asked for; else six whole ones within the database."""
    if periods is None:
        if model.database is None:
            raise CaseError("the case has no hydrodynamic database: give the --periods")
        shortest, longest = 2.0 * np.pi / model.database.omega[[-1, 0]]
        usual = np.array([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20], dtype=float)
        inside = usual[(usual >= shortest) & (usual <= longest)]
        if len(inside) == 0:
            inside = np.linspace(shortest, longest, 6)
        pick = np.linspace(0, len(inside) - 1, min(6, len(inside))).round().astype(int)
        return np.asarray(2.0 * np.pi / inside[pick])
    values = np.asarray(periods, dtype=float)
    if values.ndim != 1 or values.size == 0 or not np.all(values > 0.0):
        raise CaseError(f"periods {list(periods)}: expected numbers > 0 [s]", key="periods")
    return np.asarray(2.0 * np.pi / values)


def _curves(model: LinearModel, chosen: Array, heading: float) -> Response:
    """Responses over the whole database, frequencies ascending; without one at those chosen.

    Each peak lies between points that are close enough to read it off: they are added about the
    highest point of every response, three times.
    """
    if model.database is None:
        return model.response(np.sort(chosen), heading)
    low, high = model.database.omega[[0, -1]]
    w = np.union1d(np.linspace(low, high, FREQUENCIES), chosen)
    for mode in model.modes():  # a lightly damped one may fall between two points
        own = 2.0 * np.pi / mode.period
        w = np.union1d(w, own * (1.0 + max(mode.damping_ratio, 1e-4) * np.linspace(-4, 4, 33)))
    w = w[(w >= low) & (w <= high)]
    for _ in range(3):
        response = model.response(w, heading)
        heights = np.hstack(
            [np.abs(response.values), np.stack([*response.power.values()] or [w]).T]
        )
        more = []
        for k in set(np.argmax(heights, axis=0).tolist()):
            more.append(np.linspace(w[max(k - 1, 0)], w[min(k + 1, len(w) - 1)], 9))
        w = np.union1d(w, np.concatenate(more))
    return model.response(w, heading)
