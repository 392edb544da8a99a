"""hydrodae-solve with another program as its controller: exit codes."""

from __future__ import annotations

import socket
import struct
import subprocess
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.python.test_tcp import free_port, raw_peer

import hydrodae
from hydrodae import tcp


def test_exit_codes_of_the_executable(executable: str, repository: Path, tmp_path: Path) -> None:
    """0 with a controller, 2 where the port is taken, 3 where nobody comes."""

    def code(port: int, **values: object) -> int:
        sets = [f"--set=controller.pi.{key}={value}" for key, value in values.items()]
        words = [word for item in sets for word in item.split("=", 1)]
        path = repository / "cases" / "control" / "case_tcp.toml"
        command = [executable, str(path), "-o", str(tmp_path / "r.h5"), *words]
        command += ["--set", f"controller.pi.port={port}"]
        return subprocess.run(command, capture_output=True, timeout=60, check=False).returncode

    assert code(free_port(), connect_timeout=0.2) == 3
    with socket.create_server(("127.0.0.1", 0)) as taken:
        assert code(taken.getsockname()[1]) == 2
    port = free_port()

    def peer() -> None:
        with tcp.connect(port=port, hotint=(1, 1), timeout=10.0) as run:
            for _, (rate,) in run:
                run.answer(-rate)

    thread = threading.Thread(target=peer)
    thread.start()
    assert code(port) == 0
    thread.join(10.0)


def three_answers(then: bytes, wait: bool) -> Callable[[socket.socket], None]:
    """Answer three frames of the protocol hotint, then with these bytes; stay or leave."""

    def act(connection: socket.socket) -> None:
        for answer in (*3 * [struct.pack("<2d", 1.0, 0.0)], then):
            if not connection.recv(24, socket.MSG_WAITALL):
                return
            connection.sendall(answer)
        if wait:
            while connection.recv(1000):
                pass

    return act


@pytest.mark.parametrize(
    ("act", "code", "message"),
    [
        (three_answers(b"", False), 3, "closed the connection"),
        (three_answers(b"", True), 3, "sent nothing for 1 s"),
        (three_answers(b"\0" * 9, True), 3, "part of a frame only for 1 s"),
        (three_answers(b"GET / HTTP/1.1\r\nHost: x\r\n", True), 3, "more than 2 numbers"),
        (three_answers(b"garbage." * 2, True), 3, "the flag"),
        (three_answers(struct.pack("<2d", 0.0, 2.0), True), 3, "reported an error"),
        (three_answers(struct.pack("<2d", 0.0, 3.0), True), 4, "interrupted"),
    ],
    ids=["killed", "silent", "half a frame", "long garbage", "garbage", "error", "stop"],
)
def test_faults_end_the_executable_with_code_and_message(
    executable: str,
    repository: Path,
    tmp_path: Path,
    act: Callable[[socket.socket], None],
    code: int,
    message: str,
) -> None:
    """After three periods of 0.05 s: what is on disk then reaches to 0.15 s."""
    port, output = free_port(), tmp_path / "r.h5"
    path = repository / "cases" / "control" / "case_tcp.toml"
    command = [executable, str(path), "-o", str(output)]
    command += ["--set", f"controller.pi.port={port}", "--set", "controller.pi.timeout=1.0"]
    thread = threading.Thread(target=raw_peer(port, act))
    thread.start()
    done = subprocess.run(command, capture_output=True, timeout=30, check=False, text=True)
    thread.join(10.0)
    assert done.returncode == code
    assert message in done.stderr + done.stdout
    results = hydrodae.Results(output)
    assert results.end_time == pytest.approx(0.15)
    assert results.status == ("failed" if code == 3 else "interrupted")
