"""Worker processes that leave the script of the user alone."""

from __future__ import annotations

import multiprocessing
import sys
import types
from multiprocessing.context import BaseContext, SpawnContext, SpawnProcess
from typing import Any


class _Process(SpawnProcess):
    """A new process that does not run the main script again.

    By default it would, to find functions that are defined there; ours are all in the package. A
    script without ``if __name__ == "__main__":`` would start processes of its own in each.
    """

    @staticmethod
    def _Popen(process_obj: Any) -> Any:
        main = sys.modules["__main__"]
        bare = types.ModuleType("__main__")  # without the place of a script
        try:
            sys.modules["__main__"] = bare
            return SpawnProcess._Popen(process_obj)
        finally:
            sys.modules["__main__"] = main


class _Context(SpawnContext):
    Process = _Process


def context(*, anew: bool) -> BaseContext:
    """How processes begin.

    Parameters
    ----------
    anew : bool
        Each imports what it needs and has no memory, thread or open file of this one; else they are
        copies of this process where that is usual on the system, which is faster.
    """
    if not anew and multiprocessing.get_start_method() == "fork":
        return multiprocessing.get_context("fork")
    return _Context()
