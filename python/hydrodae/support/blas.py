"""Threads of the linear algebra: on small matrices they cost more than they save."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import threadpool_limits


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Let the linear algebra of numpy and scipy work with one thread for a while.

    Threads of OpenBLAS wait in a busy loop: on matrices of some hundred rows two of them save
    little time, and many times the processor time is lost where other programs run.
    """
    with threadpool_limits(limits=1, user_api="blas"):
        yield
