"""Rollback and checkpoints of runs whose controllers remember, or are other programs."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from tests.errors import stopped
from tests.python.controlled import LATCH
from tests.python.test_tcp import case, free_port
from tests.scenes import controlled_cart

import hydrodae
from hydrodae import Case, Simulation, tcp

PLACE, HELD = "joints/slide/displacement", "controllers/pi/output"
PROTOCOLS = ("hydrodae", "hotint")


@contextmanager
def damper(
    port: int, protocol: str, until: float = np.inf, *, leaves: bool = False
) -> Iterator[list[tuple[float, bool]]]:
    """A program that answers -2 s' until it ends the run, or leaves; yields what it has seen."""
    seen: list[tuple[float, bool]] = []

    def work() -> None:
        bare = (1, 1) if protocol == "hotint" else None
        with tcp.connect(port=port, hotint=bare, timeout=10.0) as run:
            for t, (rate,) in run:
                seen.append((round(t, 9), run.reset))
                if t > until:
                    if not leaves:
                        run.stop()
                    return
                run.answer(-2.0 * rate)

    thread = threading.Thread(target=work)
    thread.start()
    yield seen
    thread.join(10.0)
    assert not thread.is_alive()


def go(run: Simulation, until: float) -> list[float]:
    """Advance; all that is read at the ends of steps."""
    out = []
    while run.time < until and not run.finished:
        out += [run.advance(until), *(float(run.read(name)) for name in (PLACE, HELD))]
    return out


def again(run: Simulation, between: Callable[[], None] = lambda: None) -> None:
    """From 1.23 s on twice: bit for bit the same."""
    go(run, 1.23)
    saved = run.state()
    went_on = go(run, 4.0)
    for _ in range(3):
        run.restore(saved)
        assert go(run, 4.0) == went_on
        between()


@pytest.mark.parametrize("method", ["radau", "ida", "auto"])
def test_latching_goes_on_from_inside_a_hold(method: str) -> None:
    keys = "hold_time = 0.4\nhold_load = 100.0"
    text = controlled_cart("latching", keys, period=0.05)
    text = text.replace("forces/pto/load", "forces/latch/static")
    text = text.replace("[[controller]]", LATCH + "[[controller]]").replace("radau", method)
    text = text.replace("displacement = [0.5, 0.0, 0.0]", "velocity = [1.0, 0.0, 0.0]")
    run = Simulation(Case.from_text(text))
    go(run, 1.0)
    assert run.read(PLACE) == pytest.approx(0.5, abs=1e-5)  # held since pi / 4
    saved = run.state()
    went_on = go(run, 5.0)
    assert min(went_on) < -0.49  # it was let go, and held on the other side
    run.restore(saved)
    assert go(run, 5.0) == went_on
    other = Simulation(Case.from_text(text))
    other.restore(saved)
    assert go(other, 5.0) == went_on


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_rollback_with_another_program(protocol: str) -> None:
    port = free_port()
    with damper(port, protocol) as seen:
        run = Simulation(case(port, f'protocol = "{protocol}"'))
        again(run)
        run.close()
    assert [t for t, reset in seen if reset] == [1.3, 1.3, 1.3]


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_a_program_that_ends_a_simulation_ends_it_as_a_run(protocol: str) -> None:
    port = free_port()
    run = Simulation(case(port, f'protocol = "{protocol}"'))
    saved = run.state()
    with damper(port, protocol, until=2.0), pytest.raises(hydrodae.RunInterrupted) as caught:
        go(run, 4.0)
    assert str(caught.value) == (
        "stopped at t = 2.1 s of 5 s: controller 'pi': the other program has ended the run"
    )
    with stopped("state"):
        run.advance()
    with damper(port, protocol):
        run.restore(saved)
        assert go(run, 1.0)
        run.close()


def test_a_port_is_free_when_a_run_is_closed() -> None:
    port = free_port()
    run = Simulation(case(port))
    run.close()  # before anybody was there
    with damper(port, "hydrodae"):
        other = Simulation(case(port))
        go(other, 1.0)
        other.close()
    with socket.create_server(("127.0.0.1", port)), stopped("controller", "controllers/pi"):
        run.advance()
    fresh = Simulation(case(port))
    fresh.close()
    with damper(port, "hydrodae"):  # a run that was closed listens again where it goes on
        assert go(fresh, 1.0)
        fresh.close()


def test_going_back_to_the_last_exchange_is_told() -> None:
    """A program that remembers would else take one instant for two."""
    port = free_port()
    with damper(port, "hydrodae") as seen:
        run = Simulation(case(port))
        go(run, 0.2)  # the exchange of that instant is still to come
        saved = run.state()
        go(run, 0.25)
        run.restore(saved)
        go(run, 0.35)
        run.close()
    assert seen == [(0.0, False), (0.1, False), (0.2, False), (0.2, True), (0.3, False)]


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_a_state_goes_on_with_a_new_connection(protocol: str) -> None:
    """Where the first one is lost: the run ends, and nothing but a state goes on."""
    port = free_port()
    run = Simulation(case(port, f'protocol = "{protocol}"'))
    with damper(port, protocol):
        go(run, 1.23)
        saved = run.state()
        went_on = go(run, 4.0)
        run.close()
    del run  # which listens at the port
    run = Simulation(case(port, f'protocol = "{protocol}"'))
    with damper(port, protocol, until=2.0, leaves=True), stopped("controller", "controllers/pi"):
        go(run, 4.0)
    with stopped("state"):
        run.advance(4.0)
    with damper(port, protocol) as seen:
        run.restore(saved)
        assert go(run, 4.0) == went_on
        run.close()
    assert seen[0][0] == 1.3


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_a_run_with_another_program_is_resumed(protocol: str, tmp_path: Path) -> None:
    def given(port: int) -> Case:
        return case(port, f'protocol = "{protocol}"')

    port = free_port()
    with damper(port, protocol):
        whole = hydrodae.run(given(port), tmp_path / "whole.h5", checkpoint=0)
    port = free_port()
    with damper(port, protocol, until=2.0), pytest.raises(hydrodae.RunInterrupted):
        hydrodae.run(given(port), tmp_path / "cut.h5", checkpoint=0)
    with damper(port, protocol) as seen:
        resumed = hydrodae.run(given(port), tmp_path / "cut.h5", checkpoint=0, resume=True)
    assert seen[0][0] == pytest.approx(2.1)
    for name in (PLACE, HELD):
        np.testing.assert_array_equal(resumed[name], whole[name])
