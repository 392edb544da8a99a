"""One thread of OpenBLAS for a while, and what there was before after it."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg

from hydrodae.support import blas


def test_one_thread_for_a_while_even_after_an_error() -> None:
    scipy.linalg.cho_factor(np.eye(2))
    pools = blas._pools()
    if not pools:
        pytest.skip("no OpenBLAS is loaded")
    before = [read() for _, read in pools]
    try:
        for change, _ in pools:
            change(2)
        during: list[int] = []

        @blas.one_blas_thread()
        def broken() -> None:
            during.extend(read() for _, read in pools)
            raise ZeroDivisionError

        with pytest.raises(ZeroDivisionError):
            broken()
        assert during == [1] * len(pools)
        assert [read() for _, read in pools] == [2] * len(pools)
    finally:
        for (change, _), number in zip(pools, before, strict=True):
            change(number)
