"""One thread of the linear algebra for a while, and what there was before after it."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg
from threadpoolctl import threadpool_info, threadpool_limits

from hydrodae.support.blas import one_blas_thread


def threads() -> list[int]:
    return [pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"]


def test_one_thread_for_a_while_even_after_an_error() -> None:
    scipy.linalg.cho_factor(np.eye(2))  # loads the library of scipy
    during: list[int] = []

    @one_blas_thread()
    def broken() -> None:
        during.extend(threads())
        raise ZeroDivisionError

    with threadpool_limits(limits=2, user_api="blas"):
        before = threads()
        assert before
        assert set(before) == {2}
        with pytest.raises(ZeroDivisionError):
            broken()
        assert set(during) == {1}
        assert threads() == before
