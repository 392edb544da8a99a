"""Work in a child process: results, errors and warnings come back, faults do not."""

from __future__ import annotations

import os
import signal
import threading
import warnings
from pathlib import Path

import numpy as np
import pytest

from hydrodae.errors import DatabaseError
from hydrodae.support.child import ChildEnded, in_child
from hydrodae.support.damaged import apart


def end_by(what: signal.Signals) -> None:
    os.kill(os.getpid(), what)


def damaged(path: Path, fault: str) -> DatabaseError:
    return DatabaseError(fault).about("damaged", file=path)


def test_what_a_child_returns_is_the_callers_own() -> None:
    process, numbers = in_child(lambda: (os.getpid(), np.arange(100_000.0)))
    assert process != os.getpid()
    numbers[0] = 1.0  # can be written to
    assert np.array_equal(numbers[1:], np.arange(1.0, 100_000.0))


def test_an_error_comes_back_with_its_attributes() -> None:
    def work() -> None:
        raise DatabaseError("no heave").about("missing", "heave", file="a.nc", line=3)

    with pytest.raises(DatabaseError, match=r"^a\.nc:3: no heave$") as caught:
        in_child(work)
    assert (caught.value.reason, caught.value.subject) == ("missing", "heave")


def test_warnings_come_back() -> None:
    with pytest.warns(UserWarning, match="coarse"):
        in_child(lambda: warnings.warn("coarse", UserWarning, stacklevel=1))


@pytest.mark.parametrize("what", [signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGFPE])
def test_a_fault_is_one_error_and_no_other_words(
    what: signal.Signals, capfd: pytest.CaptureFixture[str]
) -> None:
    fault = rf"^a\.nc: is damaged: reading it ended the HDF5 library by signal {what.name[3:]}; "
    with pytest.raises(DatabaseError, match=fault):
        apart(Path("a.nc"), damaged, "unreadable", lambda: end_by(what))
    assert capfd.readouterr() == ("", "")


def test_a_child_that_another_ended_is_no_damage() -> None:
    with pytest.raises(DatabaseError, match="ended by signal KILL; is memory short"):
        apart(Path("a.nc"), damaged, "unreadable", lambda: end_by(signal.SIGKILL))


def test_an_exit_without_an_answer_is_noticed() -> None:
    with pytest.raises(ChildEnded, match="exit code 3"):
        in_child(lambda: os._exit(3))


def test_a_thread_may_have_a_child() -> None:
    found: list[int] = []
    thread = threading.Thread(target=lambda: found.append(in_child(lambda: 42)))
    thread.start()
    thread.join()
    assert found == [42]
