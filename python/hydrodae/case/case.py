"""Case files from Python: read, change values by their dotted key, look at the scene."""

from __future__ import annotations

import math
import os
import re
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeAlias

from hydrodae.errors import CaseError

if TYPE_CHECKING:
    from hydrodae._core import Scene
    from hydrodae.case.callbacks.drives import Drive
    from hydrodae.case.callbacks.laws import Force

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+")
_BARE_WORD = re.compile(r"[A-Za-z_./][A-Za-z0-9_./+-]*")  # as the kernel has it


class Origin(Protocol):
    """Names what made the lines of a text, in errors of the kernel."""

    def error(self, error: CaseError) -> CaseError:
        """Return the error with what made the line in place of the file."""
        ...

    def place(self, place: tuple[str, int, int]) -> tuple[str, int, int]:
        """Return the same of file, line and column alone."""
        ...


class Case:
    """A case: the text of a case file and the values that replace some of it.

    The kernel has the only parser of case files, so a case that exists has been read and checked.

    Parameters
    ----------
    text : str or None
        Case file as text; None to read the file at `path`.
    path : path or None
        Case file; used when `text` is None. A pipe, such as /dev/stdin, is read once; `directory`
        then counts.
    directory : path
        What relative paths in `text` refer to.
    values : mapping from str, optional
        Values by dotted key, for example ``{"solver.rtol": 1e-8}``.
    libraries : sequence of paths, optional
        Shared libraries with the laws of forces of type ``library_load`` and ``library_wrench``
        (cpp/hydrodae/element/plugin.h). They are programs: load what you trust only.
    origin : Origin, optional
        Says where errors are in a text that nobody wrote.

    Raises
    ------
    CaseError
        The case cannot be used; the message says where and why.

    Examples
    --------
    >>> case = Case.read("cases/f3of/flap_decay.toml")  # doctest: +SKIP
    >>> case.set("solver.rtol", 1e-8)  # doctest: +SKIP
    """

    def __init__(
        self,
        text: str | None = None,
        *,
        path: str | os.PathLike[str] | None = None,
        directory: str | os.PathLike[str] = ".",
        values: Mapping[str, Any] | None = None,
        libraries: Sequence[str | os.PathLike[str]] = (),
        origin: Origin | None = None,
    ) -> None:
        if (text is None) == (path is None):
            raise TypeError("a case needs either a text or a path")
        if path is not None and _is_pipe(Path(path)):  # which is read once only
            text, path = _read_pipe(Path(path)), None
        self._text = text
        self._path = None if path is None else Path(path)
        self._directory = Path(directory)
        self._origin = origin
        self._libraries = [os.fspath(path) for path in libraries]
        self._overrides = {key: to_toml(value, key) for key, value in (values or {}).items()}
        self._scene = self._load(self._overrides)

    @classmethod
    def read(
        cls, path: str | os.PathLike[str], *, libraries: Sequence[str | os.PathLike[str]] = ()
    ) -> Case:
        """Read the case file at `path`."""
        return cls(path=path, libraries=libraries)

    @classmethod
    def from_text(
        cls,
        text: str,
        directory: str | os.PathLike[str] = ".",
        *,
        libraries: Sequence[str | os.PathLike[str]] = (),
    ) -> Case:
        """Read a case from a string; relative paths in it refer to `directory`."""
        return cls(text, directory=directory, libraries=libraries)

    def set(self, key: str, value: Any) -> None:
        """Replace the value at a dotted `key`, such as "solver.rtol" or "joint.hinge1.type".

        An entry of a list of tables ([[body]], [[joint]], ...) goes by its name.

        Raises
        ------
        CaseError
            The key or the value is wrong; the case is then as it was.
        """
        self._update({key: value})

    def with_values(self, values: Mapping[str, Any]) -> Case:
        """Return a copy of this case with `values` (by dotted key) replaced."""
        copy = object.__new__(Case)
        copy.__dict__.update(self.__dict__)
        copy._update(values)
        return copy

    @property
    def scene(self) -> Scene:
        """The validated scene, as the kernel runs it."""
        return self._scene

    @property
    def path(self) -> Path | None:
        """The case file, or None for a case from a string."""
        return self._path

    @property
    def directory(self) -> Path:
        """Folder that relative paths refer to: that of the case file, if there is one."""
        return self._directory if self._path is None else self._path.parent

    @property
    def overrides(self) -> dict[str, str]:
        """Replaced values as TOML text, by dotted key."""
        return dict(self._overrides)

    @property
    def libraries(self) -> list[str]:
        """Paths of the shared libraries with laws of forces."""
        return list(self._libraries)

    @property
    def title(self) -> str:
        """Title of the case."""
        return self._scene.title

    @property
    def text(self) -> str:
        """The case file as it was read."""
        return self._scene.text

    @property
    def body_names(self) -> list[str]:
        """Names of the bodies, in the order of the case file."""
        return self._scene.body_names

    @property
    def joint_names(self) -> list[str]:
        """Names of the joints, in the order of the case file."""
        return self._scene.joint_names

    @property
    def end_time(self) -> float:
        """End of the run, s."""
        return self._scene.end_time

    @property
    def unsampled(self) -> str:
        """What the samples of a run will miss at its end; empty if nothing."""
        end, step = self.end_time, self._scene.output_step
        rest = math.fmod(end, step)
        if min(rest, step - rest) <= 1e-6 * step:
            return ""
        return (
            f"output.step = {step:g} s: the last sample is at {end - rest:g} s, "
            f"the end at {end:g} s"
        )

    def summary(self) -> str:
        """Return the scene as a short tree: bodies, joints, forces, solver."""
        return self._scene.summary()

    def examine(
        self, drives: Mapping[str, Drive] | None = None, forces: Mapping[str, Force] | None = None
    ) -> str:
        """Return the summary with what the case costs, its mobility and redundant rows.

        Parameters
        ----------
        drives, forces : mapping from str to callable, optional
            As in `hydrodae.run`.

        Raises
        ------
        CaseError
            The joints cannot be closed near the start.
        """
        from hydrodae import _core
        from hydrodae.case.callbacks.drives import kernel_drives
        from hydrodae.case.callbacks.laws import kernel_forces

        return _core.examine(
            self._scene, kernel_drives(self._scene, drives), kernel_forces(self._scene, forces)
        )

    def __repr__(self) -> str:
        changed = "".join(f", {key} = {value}" for key, value in self._overrides.items())
        return f"<hydrodae.Case {self.title!r} from {self._path or 'a string'}{changed}>"

    def _update(self, values: Mapping[str, Any]) -> None:
        changed = {key: to_toml(value, key) for key, value in values.items()}
        overrides = {**self._overrides, **changed}
        self._scene = self._load(overrides)
        self._overrides = overrides

    def _load(self, overrides: dict[str, str]) -> Scene:
        scene = self._read(overrides)
        if not self._libraries:
            return scene
        from hydrodae import _core

        return _core.join_libraries(scene, self._libraries)

    def _read(self, overrides: dict[str, str]) -> Scene:
        if self._path is not None and not self._path.is_file():
            if self._path.is_dir():
                raise CaseError("is a folder; give the case file in it", file=str(self._path))
            raise CaseError(f"no such case file{_near_file(self._path)}", file=str(self._path))
        from hydrodae import _core

        if self._path is not None:
            _refuse_other_kind(self._path)
            return _core.load_case(str(self._path), overrides)
        assert self._text is not None
        if self._origin is None:
            return _core.parse_case(self._text, str(self._directory), overrides)
        return _parse_from(self._text, str(self._directory), overrides, self._origin)


def _is_pipe(path: Path) -> bool:
    try:
        return path.is_fifo()
    except OSError as error:  # a name that is too long
        raise CaseError(f"cannot be read: {error.strerror}", file=str(path)) from None


def _refuse_other_kind(path: Path) -> None:
    """Raise CaseError for results, databases and other files that are no text."""
    from hydrodae.support import outputs

    with path.open("rb") as file:
        head = file.read(8)
    if head.startswith((b"\x89HDF", b"CDF", b"\x89PNG", b"%PDF", b"PK")):
        raise CaseError(f"is a {outputs.kind_of(path)}; a case is a TOML file", file=str(path))
    if head.startswith((b"\xff\xfe", b"\xfe\xff")):
        raise CaseError("is text in UTF-16; save the case as UTF-8", file=str(path))


def _read_pipe(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8")
    except UnicodeDecodeError:
        raise CaseError("is no text in UTF-8; a case is a TOML file", file=str(path)) from None


class MakesCase(Protocol):
    """What makes a case of itself, as `hydrodae.Scene` does."""

    def case(self, values: Mapping[str, Any] | None = None) -> Case:
        """Return it as a case, with `values` by dotted key replaced."""


#: What the functions of the package take as a case: a path is that of the case file.
CaseLike: TypeAlias = Case | MakesCase | str | os.PathLike[str]


def read_case(case: CaseLike, values: Mapping[str, Any] | None = None) -> Case:
    """Return a case as it is, from a scene or from its file, with `values` by dotted key replaced.

    Raises
    ------
    CaseError
        The case cannot be used; the message says where and why.
    """
    if isinstance(case, Case):
        return case.with_values(values) if values else case
    if isinstance(case, str | os.PathLike):
        return Case(path=case, values=values)
    return case.case(values)


def to_toml(value: Any, key: str = "value") -> str:
    """Write a Python or numpy value as TOML.

    Parameters
    ----------
    value : bool, int, float, str, path, list, tuple, dict, numpy scalar or array
        Value of a case key; lists and dicts may be nested.
    key : str
        Name of the value in the message of an error.

    Raises
    ------
    CaseError
        The value has no counterpart in a case file.
    """
    numpy = sys.modules.get("numpy")  # where nobody has loaded it, no value is of it
    if numpy is not None and isinstance(value, numpy.ndarray | numpy.generic):
        value = value.tolist()
    match value:
        case bool():
            return "true" if value else "false"
        case int():
            if not -(2**63) <= value < 2**63:
                raise CaseError(f"{key}: {value} does not fit into a 64-bit integer")
            return str(value)
        case float():
            return repr(value) if math.isfinite(value) else str(value)  # inf, -inf, nan are TOML
        case str():
            return _quoted(value)
        case os.PathLike():
            return _quoted(os.fspath(value))
        case list() | tuple():
            return "[" + ", ".join(to_toml(item, key) for item in value) + "]"
        case dict():
            entries = (f"{_key(k, key)} = {to_toml(v, f'{key}.{k}')}" for k, v in value.items())
            return "{" + ", ".join(entries) + "}"
    raise CaseError(f"{key}: a {type(value).__name__} cannot stand in a case file ({value!r})")


def parse_assignment(text: str) -> tuple[str, Any]:
    """Split "key=value" of a command line into the dotted key and the value.

    The value is TOML; a bare word (``solver.method=ida``) is a string without its quotes.

    Raises
    ------
    CaseError
        There is no "=", no key, or the value is not TOML.

    Examples
    --------
    >>> parse_assignment("solver.rtol=1e-8")
    ('solver.rtol', 1e-08)
    >>> parse_assignment("hydro.axes=mean")
    ('hydro.axes', 'mean')
    """
    import tomllib

    key, equals, value = (part.strip() for part in text.partition("="))
    if not (key and equals and value):
        raise CaseError(f"--set {text}: expected key=value, for example solver.rtol=1e-8")
    try:
        return key, tomllib.loads(f"value = {value}")["value"]
    except tomllib.TOMLDecodeError as error:
        if _BARE_WORD.fullmatch(value):
            return key, value
        raise CaseError(
            f"--set {text}: the value is not TOML ({error}); "
            'numbers, true, false, words, "quoted text" and [lists] are'
        ) from None


def _parse_from(text: str, directory: str, overrides: dict[str, str], origin: Origin) -> Scene:
    """Parse a case whose errors, also the later ones about the scene, go through `origin`."""
    from hydrodae import _core

    try:
        scene = _core.parse_case(text, directory, overrides)
    except CaseError as error:
        raise origin.error(error) from None
    return scene.with_places({key: origin.place(place) for key, place in scene.places.items()})


def _key(key: Any, context: str) -> str:
    if not isinstance(key, str):
        raise CaseError(f"{context}: the key {key!r} is not a string")
    return key if _BARE_KEY.fullmatch(key) else _quoted(key)


def _quoted(text: str) -> str:
    """TOML basic string."""
    named = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    escaped = (
        named.get(c, f"\\u{ord(c):04x}" if ord(c) < 0x20 or ord(c) == 0x7F else c) for c in text
    )
    return '"' + "".join(escaped) + '"'


def _near_file(path: Path) -> str:
    """Hint at a file of nearly the same name in the same folder."""
    if not path.parent.is_dir():
        return f" (there is no folder {path.parent})"
    import difflib

    names = [other.name for other in path.parent.glob("*.toml")]
    near = difflib.get_close_matches(path.name, names, n=1)
    return f"; did you mean {path.with_name(near[0])}?" if near else ""
