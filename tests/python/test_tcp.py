"""Controllers over TCP/IP: both protocols, both roles, and every way in which a peer can fail."""

from __future__ import annotations

import json
import random
import socket
import struct
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from tests.errors import wrong
from tests.python.controlled import PI, Pi
from tests.scenes import controlled_cart

import hydrodae
from hydrodae import Case, SolverError, tcp
from hydrodae.results import Results

HEAD = struct.Struct("<IIQd")


def free_port() -> int:
    with socket.create_server(("127.0.0.1", 0)) as server:
        return int(server.getsockname()[1])


def case(port: int, keys: str = "", end: float = 5.0) -> Case:
    keys = f"port = {port}\ntimeout = 1.0\nconnect_timeout = 5.0\n{keys}"
    text = controlled_cart("tcp", keys)
    return Case.from_text(text.replace("end_time = 5.0", f"end_time = {end}"))


def with_peer(given: Case, peer: Callable[[], None], path: Path | None = None) -> Results:
    """Run the case with another thread as the controller."""
    failures: list[BaseException] = []

    def work() -> None:
        try:
            peer()
        except BaseException as error:
            failures.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    try:
        results = hydrodae.run(given, path)
    finally:
        thread.join(10.0)
        assert not thread.is_alive()
    assert not failures, failures
    return results


@pytest.mark.parametrize("protocol", ["hydrodae", "hotint"])
@pytest.mark.parametrize("role", ["server", "client"])
def test_a_pi_over_tcp_equals_the_kernels_own(protocol: str, role: str) -> None:
    port = free_port()
    meet = tcp.connect if role == "server" else tcp.listen
    flags: list[bool] = []

    def peer() -> None:
        law = Pi()
        with meet(port=port, hotint=(1, 1) if protocol == "hotint" else None, timeout=5.0) as run:
            for t, (rate,) in run:
                flags.append(run.reset)
                run.answer(law(t, rate))
            if isinstance(run, tcp.Numbered):
                assert run.hello["inputs"][0]["unit"] == "m/s"
                assert run.hello["outputs"][0] == {
                    "name": "forces/pto/load",
                    "unit": "N",
                    "start": 0.0,
                }
                assert run.error == ""

    over = with_peer(case(port, f'protocol = "{protocol}"\nrole = "{role}"'), peer)
    own = hydrodae.run(Case.from_text(controlled_cart("pid", PI)))
    for name in ("joints/slide/displacement", "controllers/pi/output"):
        np.testing.assert_allclose(over[name], own[name], atol=1e-12)
    assert flags == [False] * 50
    assert over.statistics["controller_calls.pi"] == 50


def test_a_peer_may_end_the_run() -> None:
    for protocol in ("hydrodae", "hotint"):
        port = free_port()

        def peer(port: int = port, protocol: str = protocol) -> None:
            bare = (1, 1) if protocol == "hotint" else None
            with tcp.connect(port=port, hotint=bare, timeout=5.0) as run:
                for t, _ in run:
                    if t > 2.0:
                        run.stop()
                        return
                    run.answer(0.0)

        with pytest.raises(hydrodae.RunInterrupted) as caught:
            with_peer(case(port, f'protocol = "{protocol}"'), peer)
        assert caught.value.results is not None
        assert caught.value.results.end_time == pytest.approx(2.1)


def test_going_back_is_told_as_a_reset() -> None:
    port = free_port()
    seen: list[tuple[float, bool]] = []

    def peer() -> None:
        with tcp.connect(port=port, timeout=5.0) as run:
            for t, _ in run:
                seen.append((round(t, 9), run.reset))
                run.answer(0.0)

    thread = threading.Thread(target=peer)
    thread.start()
    simulation = hydrodae.Simulation(case(port, end=1.0))
    while simulation.time < 0.25:
        simulation.advance(0.25)
    saved = simulation.state()
    while simulation.time < 0.45:
        simulation.advance(0.45)
    simulation.restore(saved)
    while not simulation.finished:
        simulation.advance()
    simulation.close()
    thread.join(5.0)
    assert seen[:5] == [(0.0, False), (0.1, False), (0.2, False), (0.3, False), (0.4, False)]
    assert seen[5] == (0.3, True)
    assert seen[-1] == (0.9, False)


def hello(connection: socket.socket, **changes: object) -> None:
    (length,) = struct.unpack("<I", connection.recv(4, socket.MSG_WAITALL))
    connection.recv(length, socket.MSG_WAITALL)
    said = json.dumps({"protocol": "hydrodae", "version": 1, **changes}).encode()
    connection.sendall(struct.pack("<I", len(said)) + said)


def raw_peer(port: int, act: Callable[[socket.socket], None]) -> Callable[[], None]:
    def peer() -> None:
        deadline = time.monotonic() + 5.0
        while True:
            try:
                connection = socket.create_connection(("127.0.0.1", port), timeout=5.0)
                break
            except ConnectionRefusedError:
                assert time.monotonic() < deadline
                time.sleep(0.01)
        with connection:
            try:
                act(connection)
            except (ConnectionError, TimeoutError, struct.error):
                pass  # the run has gone

    return peer


def frame(sequence: int, t: float, *values: float, kind: int = 1) -> bytes:
    return HEAD.pack(20 + 8 * len(values), kind, sequence, t) + struct.pack(
        f"<{len(values)}d", *values
    )


def answers(first: bytes, wait: bool = True) -> Callable[[socket.socket], None]:
    """Shake hands, then answer the first frame with these bytes."""

    def act(connection: socket.socket) -> None:
        hello(connection)
        connection.recv(HEAD.size + 8, socket.MSG_WAITALL)
        connection.sendall(first)
        if wait:
            connection.recv(1000)

    return act


def test_frames_may_come_byte_by_byte() -> None:
    given = case(port := free_port(), end=0.25)

    def act(connection: socket.socket) -> None:
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        said = b'{"protocol": "hydrodae", "version": 1}'
        (length,) = struct.unpack("<I", connection.recv(4, socket.MSG_WAITALL))
        connection.recv(length, socket.MSG_WAITALL)
        parts = struct.pack("<I", len(said)) + said
        for number in range(1, 5):
            for k in range(len(parts)):
                connection.sendall(parts[k : k + 1])
                time.sleep(0.0002)  # so that they do not come together
            asked = connection.recv(HEAD.size + 8, socket.MSG_WAITALL)
            if number < 4:
                parts = frame(number, HEAD.unpack(asked[: HEAD.size])[3], 0.25 * number)

    results = with_peer(given, raw_peer(port, act))
    held = results["controllers/pi/output"].to_numpy()
    np.testing.assert_array_equal(held, [0.0, 0.25, 0.25, 0.5, 0.5, 0.75])


def listens(connection: socket.socket) -> None:
    while connection.recv(10000):
        pass


NUMBERED_FAULTS: dict[str, tuple[Callable[[socket.socket], None], str]] = {
    "killed": (lambda c: None, "closed the connection"),
    "killed after the handshake": (lambda c: hello(c), "closed the connection"),
    "silent": (answers(b""), "sent nothing for 1 s"),
    "silent at the handshake": (listens, "sent nothing for 1 s"),
    "half a frame": (answers(frame(1, 0.0, 1.0)[:20]), "part of a frame only for 1 s"),
    "half a frame, then killed": (answers(frame(1, 0.0, 1.0)[:20], wait=False), "inside a frame"),
    "garbage": (answers(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n"), "frame of"),
    "oversized": (answers(frame(1, 0.0, 1.0, 2.0)), "of length 36; expected 28"),
    "two frames": (answers(2 * frame(1, 0.0, 1.0)), "more than one frame"),
    "no number": (answers(frame(1, 0.0, float("nan"))), "answered nan"),
    "infinite": (answers(frame(1, 0.0, float("-inf"))), "answered -inf"),
    "out of order": (answers(frame(7, 0.0, 1.0)), "frame 7; expected frame 1"),
    "another time": (answers(frame(1, 0.1, 1.0)), "t = 0.1 s; expected 0 s"),
    "unknown kind": (answers(frame(1, 0.0, 1.0, kind=9)), "kind 9"),
    "error": (answers(HEAD.pack(24, 4, 1, 0.0) + b"oops"), "has stopped: oops"),
    "huge error": (answers(HEAD.pack(2**31, 4, 1, 0.0)), "of length 2147483648"),
    "another version": (lambda c: hello(c, version=2), "version '2' of the protocol; expected 1"),
    "another protocol": (lambda c: hello(c, protocol="x"), "speaks the protocol 'x'"),
    "nested handshake": (lambda c: hello(c, more=[1, 2]), "no flat JSON object"),
    "huge handshake": (lambda c: c.sendall(b"\xff" * 100), "4294967295 bytes"),
}


@pytest.mark.parametrize("name", NUMBERED_FAULTS)
def test_faults_of_a_peer_are_one_clear_error(name: str) -> None:
    act, message = NUMBERED_FAULTS[name]
    port = free_port()
    began = time.monotonic()
    with pytest.raises(SolverError, match=message) as caught:
        with_peer(case(port), raw_peer(port, act))
    assert time.monotonic() - began < 10.0  # the timeout is 1 s, on a machine with other work
    assert "controller 'pi'" in str(caught.value)
    assert caught.value.results is not None
    assert caught.value.results.status == "failed"


def doubles(*values: float) -> Callable[[socket.socket], None]:
    def act(connection: socket.socket) -> None:
        connection.recv(24, socket.MSG_WAITALL)
        connection.sendall(struct.pack(f"<{len(values)}d", *values))
        connection.recv(1000)

    return act


@pytest.mark.parametrize(
    ("act", "message"),
    [
        (doubles(1.0), "part of a frame only"),
        (doubles(1.0, 0.0, 1.0), "more than 2 numbers"),
        (doubles(1.0, 2.0), "reported an error"),
        (doubles(1.0, 5.0), "the flag 5"),
        (doubles(float("nan"), 0.0), "answered nan"),
        (lambda c: None, "closed the connection"),
    ],
)
def test_faults_of_a_bare_peer(act: Callable[[socket.socket], None], message: str) -> None:
    port = free_port()
    with pytest.raises(SolverError, match=message):
        with_peer(case(port, 'protocol = "hotint"'), raw_peer(port, act))


@pytest.mark.parametrize("count", [200, pytest.param(10_000, marks=pytest.mark.slow)])
def test_random_frames_never_crash_or_hang(count: int) -> None:
    """Frames with a few wrong bytes, cut off or drawn at random: an answer, or one error."""
    random.seed(7)
    good = frame(1, 0.0, 1.0)
    refused = 0
    for k in range(count):
        data = bytearray(good)
        if k % 2:
            data = bytearray(random.randbytes(random.randrange(1, 60)))
        for _ in range(random.randrange(1, 4)):
            data[random.randrange(len(data))] = random.randrange(256)
        port = free_port()
        try:
            with_peer(case(port, end=0.05), raw_peer(port, answers(bytes(data), wait=False)))
        except (SolverError, hydrodae.RunInterrupted):
            refused += 1
    assert refused > 0.75 * count


def test_a_port_in_use_is_told_before_the_run() -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with wrong("controller.pi.port"):
            hydrodae.run(case(port))


def test_nobody_there() -> None:
    for role, message in (("server", "nobody has connected"), ("client", "nobody listens")):
        given = case(free_port(), f'role = "{role}"')
        given.set("controller.pi.connect_timeout", 0.2)
        with pytest.raises(SolverError, match=message):
            hydrodae.run(given)
