"""The other end of a controller of type "tcp": pure Python, without the kernel.

A program that controls a run that listens on this machine::

    from hydrodae import tcp

    with tcp.connect() as run:
        for t, (rate,) in run:
            run.answer(-2.0e4 * rate)

The bytes are described in docs/tcp.md.
"""

from __future__ import annotations

import json
import math
import socket
import struct
import time as clock
from collections.abc import Iterator, Sequence
from typing import Any, Protocol, Self

__all__ = ["Hotint", "Numbered", "Run", "TcpError", "connect", "listen"]

VERSION = 1
DEFAULT = ("127.0.0.1", 50000)

_HEAD = struct.Struct("<IIQd")  # length of what follows it, kind, sequence, time
_BEHIND_LENGTH = _HEAD.size - 4
_LONGEST = 1 << 24
_ROOM = 4096
_VALUES, _RESET, _CLOSE, _ERROR = 1, 2, 3, 4


class TcpError(Exception):
    """The connection is gone, or what came over it is no frame."""


class Run(Protocol):
    """A run of hydrodae, seen from a controller; iterate over it, and answer each time."""

    #: Has the run gone to another time than that of the step after the last answer?
    reset: bool

    def __iter__(self) -> Iterator[tuple[float, tuple[float, ...]]]:
        """Yield the time [s] and the inputs of each sampling instant, until the run ends."""

    def answer(self, *outputs: float) -> None:
        """Send the outputs for the instant that was yielded last."""

    def stop(self) -> None:
        """End the run instead of an answer; what it has computed is kept."""

    def close(self) -> None:
        """Close the connection."""

    def __enter__(self) -> Run: ...

    def __exit__(self, *_: object) -> None: ...


class _Connection:
    """What both protocols have in common."""

    def __init__(self, connection: socket.socket) -> None:
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._socket = connection
        self._kept = b""  # come with what was asked for before
        self.reset = False

    def close(self) -> None:
        """Close the connection."""
        self._socket.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _receive(self, count: int) -> bytes:
        """So many bytes; mostly one call of the operating system brings them all."""
        while (missing := count - len(self._kept)) > 0:
            got = self._socket.recv(max(_ROOM, missing))
            if not got:
                raise TcpError("the run has closed the connection")
            self._kept = self._kept + got if self._kept else got
        got, self._kept = self._kept[:count], self._kept[count:]
        return got


class Numbered(_Connection):
    """The protocol "hydrodae": a JSON handshake, then numbered frames.

    Attributes
    ----------
    hello : dict
        What the run says of itself: title, controller, period and delay [s], time and end_time [s],
        inputs and outputs as lists of name, unit and start.
    error : str
        Why the run has ended, if not at its end.
    """

    def __init__(
        self,
        connection: socket.socket,
        input_units: Sequence[str] = (),
        output_units: Sequence[str] = (),
    ) -> None:
        super().__init__(connection)
        (length,) = struct.unpack("<I", self._receive(4))
        if length > _LONGEST:
            raise TcpError("the other end does not speak the protocol of hydrodae")
        self.hello: dict[str, Any] = json.loads(self._receive(length))
        if self.hello.get("protocol") != "hydrodae" or self.hello.get("version") != VERSION:
            raise TcpError(f"the other end speaks {self.hello}, not version {VERSION}")
        answer: dict[str, str | int] = {"protocol": "hydrodae", "version": VERSION}
        for key, units in (("input_units", input_units), ("output_units", output_units)):
            if units:
                answer[key] = ", ".join(units)
        said = json.dumps(answer).encode()
        self._socket.sendall(struct.pack("<I", len(said)) + said)
        self._inputs = struct.Struct(f"<{len(self.hello['inputs'])}d")
        self._outputs = len(self.hello["outputs"])
        self._frame = struct.Struct(f"<IIQd{self._outputs}d")
        self._sequence, self._time = 0, 0.0
        self.error = ""

    def __iter__(self) -> Iterator[tuple[float, tuple[float, ...]]]:
        """Yield the time [s] and the inputs of each sampling instant, until the run ends."""
        size = _HEAD.size + self._inputs.size
        while True:
            head = self._receive(_HEAD.size)
            length, kind, self._sequence, self._time = _HEAD.unpack(head)
            if not _BEHIND_LENGTH <= length <= _LONGEST:
                raise TcpError(f"a frame of length {length}")
            rest = self._receive(length - _BEHIND_LENGTH)
            if kind in (_CLOSE, _ERROR):
                self.error = rest.decode(errors="replace")
                return
            if kind not in (_VALUES, _RESET) or _HEAD.size + len(rest) != size:
                raise TcpError(f"a frame of kind {kind} and length {length}")
            self.reset = kind == _RESET
            yield self._time, self._inputs.unpack(rest)

    def answer(self, *outputs: float) -> None:
        """Send the outputs for the instant that was yielded last."""
        if len(outputs) != self._outputs:
            raise ValueError(f"{self._outputs} outputs are expected, got {len(outputs)}")
        length = self._frame.size - 4
        self._socket.sendall(
            self._frame.pack(length, _VALUES, self._sequence, self._time, *outputs)
        )

    def stop(self) -> None:
        """End the run instead of an answer; what it has computed is kept."""
        self._socket.sendall(_HEAD.pack(_BEHIND_LENGTH, _CLOSE, self._sequence, self._time))


class Hotint(_Connection):
    """The protocol "hotint": doubles only, there [t, u1 ... un, flag], back [y1 ... ym, flag].

    Parameters
    ----------
    connection : socket
    inputs, outputs : int
        How many numbers the controller of the case reads and writes.
    """

    def __init__(self, connection: socket.socket, inputs: int, outputs: int) -> None:
        super().__init__(connection)
        self._there = struct.Struct(f"<{inputs + 2}d")
        self._back = struct.Struct(f"<{outputs + 1}d")

    def __iter__(self) -> Iterator[tuple[float, tuple[float, ...]]]:
        """Yield the time [s] and the inputs of each sampling instant, until the run ends."""
        while True:
            t, *values, flag = self._there.unpack(self._receive(self._there.size))
            if flag in (2.0, 3.0):
                return
            self.reset = flag == 1.0
            yield t, tuple(values)

    def answer(self, *outputs: float) -> None:
        """Send the outputs for the instant that was yielded last."""
        self._socket.sendall(self._back.pack(*outputs, 0.0))

    def stop(self) -> None:
        """End the run instead of an answer; what it has computed is kept."""
        count = self._back.size // 8
        self._socket.sendall(self._back.pack(*[0.0] * (count - 1), 3.0))


def connect(
    host: str = DEFAULT[0],
    port: int = DEFAULT[1],
    *,
    hotint: Sequence[int] | None = None,
    timeout: float = 60.0,
    input_units: Sequence[str] = (),
    output_units: Sequence[str] = (),
) -> Numbered | Hotint:
    """Connect to a run that listens (``role = "server"``), trying until it does.

    Parameters
    ----------
    host, port : str, int
        Where the run listens.
    hotint : (int, int), optional
        Speak the protocol "hotint" with so many inputs and outputs.
    timeout : float
        Longest wait for the run, and for each of its frames, s.
    input_units, output_units : sequence of str
        Units of this program, one for each input or output, where they are others than those that
        the run shows: ``["deg", "deg/s"]``. The run converts them, or refuses units of something
        else. Protocol "hydrodae" only.

    Raises
    ------
    TcpError
        Nobody listens there, or not a run of hydrodae.
    """
    deadline = clock.monotonic() + timeout
    while True:
        try:
            connection = socket.create_connection((host, port), timeout=timeout)
            break
        except ConnectionRefusedError:
            if clock.monotonic() > deadline:
                raise TcpError(f"nobody listens at {host}:{port}") from None
            clock.sleep(0.02)
    return _made(connection, hotint, input_units, output_units)


def listen(
    host: str = DEFAULT[0],
    port: int = DEFAULT[1],
    *,
    hotint: Sequence[int] | None = None,
    timeout: float = 60.0,
    input_units: Sequence[str] = (),
    output_units: Sequence[str] = (),
) -> Numbered | Hotint:
    """Wait for one run that connects (``role = "client"``); parameters as in `connect`."""
    with socket.create_server((host, port)) as server:
        server.settimeout(timeout)
        connection, _ = server.accept()
    connection.settimeout(timeout)
    return _made(connection, hotint, input_units, output_units)


def _made(
    connection: socket.socket,
    hotint: Sequence[int] | None,
    input_units: Sequence[str],
    output_units: Sequence[str],
) -> Numbered | Hotint:
    if not math.isfinite(connection.gettimeout() or 0.0):
        connection.settimeout(None)
    if hotint is None:
        return Numbered(connection, input_units, output_units)
    if input_units or output_units:
        raise ValueError("the protocol hotint has no units: give them in the case")
    return Hotint(connection, *hotint)
