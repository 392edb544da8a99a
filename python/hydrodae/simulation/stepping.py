"""A run that a Python program drives: in steps, saved and restored, read and written by name."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from hydrodae.case import Case
from hydrodae.case.callbacks import join_functions
from hydrodae.case.case import read_case

if TYPE_CHECKING:
    from hydrodae._core import State
    from hydrodae.case.callbacks.controllers import Controller
    from hydrodae.case.callbacks.drives import Drive
    from hydrodae.case.callbacks.laws import Force
    from hydrodae.support.arrays import Array


class Simulation:
    """One run of a case, from its start to its end time, in steps that the caller asks for.

    The same steps, events and guards as `hydrodae.run`, without a results file.

    Parameters
    ----------
    case : Case or path
        The case, or the path of its file.
    set : mapping from str, optional
        Values that replace those of the case, by dotted key.
    drives, forces, controllers : mapping from str to callable, optional
        Python functions that constraints follow, that are laws of forces, and controllers; see
        `hydrodae.run`. Controllers are sampled when a step goes on from a sampling instant.

    Raises
    ------
    CaseError
        The case cannot be used or cannot start.
    SolverError
        No accelerations satisfy the constraints at the start.

    Examples
    --------
    >>> simulation = Simulation("cases/f3of/flap_decay.toml")  # doctest: +SKIP
    >>> while not simulation.finished:  # doctest: +SKIP
    ...     simulation.advance()
    """

    def __init__(
        self,
        case: Case | str | os.PathLike[str],
        *,
        set: Mapping[str, Any] | None = None,
        drives: Mapping[str, Drive] | None = None,
        forces: Mapping[str, Force] | None = None,
        controllers: Mapping[str, Controller] | None = None,
    ) -> None:
        from hydrodae import _core

        self._case = read_case(case, set)
        scene, functions = join_functions(self._case.scene, drives, forces, controllers)
        self._stepper = _core.Stepper(scene, *functions)
        self._channels = {name: (width, unit) for name, width, unit in self._stepper.channels}

    @property
    def time(self) -> float:
        """End of the last accepted step, s."""
        return self._stepper.time

    @property
    def end_time(self) -> float:
        """End of the run, s."""
        return self._case.end_time

    @property
    def finished(self) -> bool:
        """Whether the end time is reached."""
        return self._stepper.finished

    @property
    def channels(self) -> dict[str, str]:
        """What `read` knows, with the units; the names are those of a results file."""
        return {name: unit for name, (_, unit) in self._channels.items()}

    @property
    def inputs(self) -> dict[str, float]:
        """What `write` may change, with the values that hold now.

        SI units and rad; ``hydrodae check`` lists them:

        - ``forces/NAME/damping``, ``stiffness``, ``neutral`` and ``load`` of each power take-off
          along a joint
        - ``force.x`` to ``moment.z`` of each constant load
        - ``static`` of each dry friction
        - ``constraints/NAME/rate``, the constant part of each rate that a constraint prescribes;
          only in scenes without stops, one-sided joints and dry friction
        """
        return self._stepper.inputs

    @property
    def input_units(self) -> dict[str, str]:
        """The unit of each of `inputs`."""
        return self._stepper.input_units

    def close(self) -> None:
        """Notify controllers that are other programs of the end of the run; ports are free then."""
        self._stepper.close()

    def advance(self, limit: float | None = None) -> float:
        """Make one accepted step.

        Parameters
        ----------
        limit : float, optional
            Time that the step does not pass, s; one that would ends there exactly.

        Returns
        -------
        float
            The time reached, s: as far as the method likes, the next event of a stop or of dry
            friction, or `limit`. At the end of the run, or at `limit`, nothing happens.

        Raises
        ------
        SolverError
            The step cannot be made, or a guard does not trust the motion. Only `restore` goes on.
        RunInterrupted
            A controller that is another program, or an FMU, has ended the run, as it ends
            `hydrodae.run`. Only `restore` goes on.
        """
        return self._stepper.advance(math.inf if limit is None else float(limit))

    def state(self) -> State:
        """All that the run is now, as a value that can be copied, compared and pickled.

        What follows depends on it alone, bit for bit: going on from here equals coming back to it.
        To that end the method starts again from the state in this run, too: ``ida`` begins at order
        1, one-step methods keep their step and their polynomial. The motion then differs from that
        of a run left alone, within the tolerance.

        Returns
        -------
        State
            `time` [s], `y` and `yp` (n,) are the unknowns and their rates.
        """
        return self._stepper.state()

    def restore(self, state: State) -> None:
        """Go to a state of the same case and overrides, back or ahead, of this run or another one.

        Python functions of `drives` are no part of it.

        Raises
        ------
        CaseError
            It is of another case, database or version of hydrodae.
        """
        self._stepper.restore(state)

    def read(self, name: str) -> float | Array:
        """Read a channel, or one component of it such as ``velocity.z``; the run does not notice.

        Returns
        -------
        float or array
            Scalars as float; vectors (3,), quaternions (4,) as w, x, y, z; SI units.

        Raises
        ------
        CaseError
            There is no such channel.
        """
        values = self._stepper.read(name)
        if len(values) == 1:
            return values[0]
        import numpy as np

        return np.array(values)

    def write(self, name: str, value: float) -> None:
        """Hold an input at a value from now on, until the next write.

        Accelerations jump there, and with a prescribed rate velocities, so the method starts again
        as it does at an event; a value that holds already changes nothing.

        Raises
        ------
        CaseError
            There is no such input, or a controller of the case writes it, or the value is not
            finite, or negative where it may not be.
        """
        self._stepper.write(name, float(value))
