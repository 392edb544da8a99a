"""Work in a child process, whose end by a fault of a library leaves the caller alive."""

from __future__ import annotations

import faulthandler
import os
import pickle
import resource
import signal
import traceback
import warnings
from collections.abc import Callable
from typing import Any, NoReturn, TypeVar

from hydrodae.errors import HydrodaeError

Result = TypeVar("Result")
#: Signals by which a process ends that meets damaged memory.
FAULTS = (signal.SIGSEGV, signal.SIGBUS, signal.SIGABRT, signal.SIGFPE, signal.SIGILL)


class ChildEnded(Exception):
    """A child process ended before it answered; the message says by what.

    Attributes
    ----------
    fault : bool
        Whether its memory was damaged, rather than that something else has ended it.
    """

    def __init__(self, code: int) -> None:
        ended = signal.Signals(-code) if code < 0 else None
        super().__init__(f"signal {ended.name[3:]}" if ended else f"exit code {code}")
        self.fault = ended is None or ended in FAULTS


def in_child(work: Callable[[], Result]) -> Result:
    """Return what a function returns in a fork of this process.

    The child has copies of all objects and runs this thread alone; nothing that it changes is seen
    by its parent, which gets the result, and the warnings, through a pipe.

    Parameters
    ----------
    work : callable
        It takes no locks that other threads of this process may hold; its result can be pickled.

    Raises
    ------
    ChildEnded
        The child ended without an answer.
    Exception
        What `work` raises; with the traceback of the child as a note if it is no `HydrodaeError`.
    """
    receiver, sender = os.pipe()
    with warnings.catch_warnings():
        # Python 3.12 warns of all forks beside other threads; `work` takes none of their locks.
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        os.close(receiver)
        _answer(work, sender)
    os.close(sender)
    answer = None
    try:
        with open(receiver, "rb") as pipe:
            answer = pickle.load(pipe)
    except (EOFError, pickle.UnpicklingError):
        pass  # the child ended before or while it answered
    except BaseException:
        os.kill(child, signal.SIGKILL)
        raise
    finally:
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if answer is None:
        raise ChildEnded(code)
    result, error, said = answer
    for text, category in said:
        warnings.warn(text, category, stacklevel=3)
    if error is not None:
        raise error
    return result  # type: ignore[no-any-return]


def _answer(work: Callable[[], Any], sender: int) -> NoReturn:
    """Run in the child: send the result of `work`, its exception and its warnings."""
    code = 1
    try:
        _be_silent()
        result: Any = None
        error: Exception | None = None
        with warnings.catch_warnings(record=True) as said:
            try:
                result = work()
            except Exception as raised:
                error = _sendable(raised)
        texts = [(str(warning.message), warning.category) for warning in said]
        with open(sender, "wb") as pipe:
            pickle.dump((result, error, texts), pipe, protocol=5)
        code = 0
    finally:
        os._exit(code)  # files and threads of the parent are not ended here


def _be_silent() -> None:
    """Let a fault end the child at once, without words of the run-time libraries or a core file."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    faulthandler.disable()
    for fault in FAULTS:
        signal.signal(fault, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)


def _sendable(error: Exception) -> Exception:
    """Return an exception that can be sent; one that was not meant has its traceback as a note."""
    trace = "".join(traceback.format_exception(error))
    try:
        again: Exception = pickle.loads(pickle.dumps(error))
    except Exception:  # classes of other packages may not be made again from their arguments
        again = RuntimeError(f"{type(error).__name__}: {error}")
    if not isinstance(error, HydrodaeError):
        again.add_note(f"In a child process:\n{trace}")
    return again
