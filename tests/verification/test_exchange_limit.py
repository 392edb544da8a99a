"""The longest period of an explicit exchange: runs against eigenvalues of the sampled system."""

from __future__ import annotations

import threading
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest
from tests.python.test_tcp import free_port
from tests.verification.test_wecccomp import load

import hydrodae
from hydrodae import SolverError, tcp

DAMPER, SPRING = (0.0, 2000.0), (800.0, 0.0)  # N/m, N s/m


@pytest.fixture(scope="module")
def study(repository: Path) -> ModuleType:
    return load(repository / "cases" / "control", "delay")


def test_limits_without_water(study: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    """A free mass under a damper: v(k+1) = (1 - C T / m) v(k) grows from C T = 2 m on.

    One period late, where a root of z^2 - z + C T / m leaves the circle: from m on.
    """
    monkeypatch.setattr(study, "SPRING", 0.0)
    monkeypatch.setattr(study, "DAMPING", 0.0)
    for late, most in ((False, 2.0), (True, 1.0)):
        period = most * study.MASS / 2000.0
        assert study.eigenvalue(0.99 * period, *DAMPER, late) < 1.0 + 1e-9
        assert study.eigenvalue(1.01 * period, *DAMPER, late) > 1.0 + 1e-3


@pytest.mark.parametrize("late", [False, True])
@pytest.mark.parametrize("load", [DAMPER, SPRING], ids=["damper", "spring"])
def test_runs_grow_where_the_eigenvalues_say(
    study: ModuleType, load: tuple[float, float], late: bool
) -> None:
    limit = study.limit(*load, late, by_runs=False)
    for factor in (0.9, 0.98, 1.02, 1.1):
        period = factor * limit
        text = study.text(period, *load, late, study.SAMPLES * period)
        found = study.measured(study.run(text), late)
        assert found == pytest.approx(study.eigenvalue(period, *load, late), rel=1e-6)
        assert (found > 1.0) == (factor > 1.0)


def test_an_exchange_over_tcp_has_the_same_limit(study: ModuleType) -> None:
    port, (K, C) = free_port(), DAMPER
    limit = study.limit(K, C, True, by_runs=False)
    text = study.text(1.05 * limit, K, C, True, study.SAMPLES * limit)
    text = text.replace('"reactive"', '"tcp"')
    text = text.replace(f"stiffness = {K!r}\ndamping = {C!r}\n\n", f"port = {port}\n\n")

    def peer() -> None:
        with tcp.connect(port=port) as run:
            for _, (x, rate) in run:
                run.answer(-K * x - C * rate)

    thread = threading.Thread(target=peer)
    thread.start()
    run = hydrodae.run(hydrodae.Case.from_text(text))
    thread.join(5.0)
    expected = study.eigenvalue(1.05 * limit, K, C, True)
    assert expected > 1.01
    assert study.measured(run, True) == pytest.approx(expected, rel=1e-6)


def test_far_beyond_the_limit_a_run_stops(study: ModuleType) -> None:
    """The motion grows by a factor each period; the run ends with the reason, what was is kept."""
    given = hydrodae.Case.from_text(study.text(0.6, *DAMPER, True, 100.0))
    with pytest.raises(SolverError, match="controller 'exchange' feeds the motion: over") as caught:
        hydrodae.run(given)
    results = caught.value.results
    assert results is not None
    assert results.status == "failed"
    x = np.abs(results["joints/slide/displacement"].to_numpy())
    assert 1e2 < x.max() < 1e5
