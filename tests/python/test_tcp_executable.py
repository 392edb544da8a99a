"""hydrodae-solve with another program as its controller: exit codes."""

from __future__ import annotations

import socket
import subprocess
import threading
from pathlib import Path

from tests.python.test_tcp import free_port

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
