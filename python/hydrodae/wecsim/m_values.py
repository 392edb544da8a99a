"""Values of MATLAB expressions: numbers, strings, arrays, simple functions."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from hydrodae.support.arrays import Array
from hydrodae.wecsim.m_text import NotEvaluated, Quoted, Token, understood

#: A number or an array of them (two axes), a string, or a list (of a cell array).
Value: TypeAlias = "float | str | Array | list[Any]"

#: Most numbers of an array, 8 MB; what input files hold has thousands.
LARGEST = 1_000_000
_CONSTANTS = {
    "pi": math.pi,
    "Inf": math.inf,
    "inf": math.inf,
    "NaN": math.nan,
    "nan": math.nan,
    "true": 1.0,
    "false": 0.0,
    "eps": float(np.finfo(float).eps),
}
_ELEMENTWISE: dict[str, Callable[[Any], Any]] = {
    "sqrt": np.sqrt,
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "exp": np.exp,
    "log": np.log,
    "abs": np.abs,
    "round": np.round,
    "floor": np.floor,
    "ceil": np.ceil,
    "deg2rad": np.deg2rad,
    "rad2deg": np.rad2deg,
    "sind": lambda x: np.sin(np.deg2rad(x)),
    "cosd": lambda x: np.cos(np.deg2rad(x)),
    "tand": lambda x: np.tan(np.deg2rad(x)),
    "atanh": np.arctanh,
    "sinh": np.sinh,
    "cosh": np.cosh,
    "tanh": np.tanh,
}
_OPERATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    ".*": lambda a, b: a * b,
    "./": np.true_divide,
    ".^": np.power,
    "==": lambda a, b: a == b,
    "~=": lambda a, b: a != b,
    "<": lambda a, b: a < b,
    ">": lambda a, b: a > b,
    "<=": lambda a, b: a <= b,
    ">=": lambda a, b: a >= b,
    "&&": lambda a, b: bool(np.all(a)) and bool(np.all(b)),
    "||": lambda a, b: bool(np.all(a)) or bool(np.all(b)),
}
#: Operators by their precedence in MATLAB, the lowest first.
_LEVELS = (
    ("||",),
    ("&&",),
    ("|",),
    ("&",),
    ("==", "~=", "!=", "<", ">", "<=", ">="),
    (":",),
    ("+", "-"),
    ("*", "/", ".*", "./"),
)
_SUM = _LEVELS.index(("+", "-"))
#: The left operand that decides alone: MATLAB does not evaluate the right one then.
_DECIDES = {"||": True, "&&": False}


def sized(*shape: float) -> None:
    """Refuse an array of more numbers than `LARGEST`.

    Raises
    ------
    NotEvaluated
        It has more, or its shape is not of whole numbers.
    """
    count = math.prod(max(float(size), 0.0) for size in shape)
    if not count <= LARGEST:
        raise NotEvaluated(f"an array of {count:.3g} numbers; at most {LARGEST} are read")


def _real(value: Any, *given: Any) -> Any:
    """A result; without a real value where those it was made of have one, it is complex."""
    if np.isnan(value).any() and not any(np.isnan(number).any() for number in given):
        raise NotEvaluated("the result is complex, or has no value")
    return value


def plain(value: Any) -> Any:
    """An array of one number as that number; strings and lists as they are."""
    if isinstance(value, np.ndarray):
        return float(value.flat[0]) if value.size == 1 else np.asarray(value, dtype=float)
    if isinstance(value, bool | int | float | np.generic):
        return float(value)
    return value


class Handle(str):
    """A function that an argument names: ``@num2str``."""

    __slots__ = ()


class Expression:
    """Evaluates tokens of one expression.

    Parameters
    ----------
    tokens : tuple of Token
    look_up : function
        Value of a name with its indices and fields, given as tokens read so far:
        ``look_up(name, path)``; raises NotEvaluated where there is none.
    call : function
        Value of a function by its name and its arguments; raises NotEvaluated where it is unknown.
    """

    def __init__(
        self,
        tokens: tuple[Token, ...],
        look_up: Callable[[str, tuple[str, ...]], Any],
        call: Callable[[str, list[Any]], Any],
    ) -> None:
        self.tokens, self.look_up, self.call, self.at = tokens, look_up, call, 0
        self.rows = 0  # depth of brackets in which white space separates
        self.skipped = 0  # depth of operands that are read without their values

    def value(self) -> Any:
        """Evaluate all; whatever is left over is not understood."""
        with understood():
            result = self._level(0)
            if self.at < len(self.tokens):
                raise NotEvaluated(f"{self.tokens[self.at].text!r} is not understood here")
            return plain(result)

    def _peek(self) -> Token | None:
        return self.tokens[self.at] if self.at < len(self.tokens) else None

    def _take(self, text: str) -> bool:
        token = self._peek()
        if token is not None and token.kind == "operator" and token.text == text:
            self.at += 1
            return True
        return False

    def _level(self, level: int) -> Any:
        if level == len(_LEVELS):
            return self._unary()
        left = self._level(level + 1)
        while (token := self._peek()) is not None and token.kind == "operator":
            if token.text not in _LEVELS[level] or self._starts_element(token):
                break
            self.at += 1
            if token.text == ":":
                left = self._range(left, self._level(level + 1))
                continue
            decided = not self.skipped and _is_decided(token.text, left)
            self.skipped += decided
            right = self._level(level + 1)
            self.skipped -= decided
            left = float(_DECIDES[token.text]) if decided else self._of(token.text, left, right)
        return left

    def _of(self, operator: str, left: Any, right: Any) -> Any:
        return 0.0 if self.skipped else _combine(operator, left, right)

    def _starts_element(self, token: Token) -> bool:
        """Within brackets, "1 -2" is two elements and "1 - 2" one."""
        if not (self.rows and token.spaced and token.text in "+-"):
            return False
        following = self.tokens[self.at + 1] if self.at + 1 < len(self.tokens) else None
        return following is not None and not following.spaced

    def _range(self, first: Any, second: Any) -> Any:
        step, last = 1.0, second
        if self._take(":"):
            step, last = second, self._level(_SUM)
        if self.skipped:
            return 0.0
        first, step, last = (float(_number(value)) for value in (first, step, last))
        length = (last - first) / step + 1e-10 if step else -1.0
        sized(length)
        return (first + step * np.arange(max(math.floor(length) + 1, 0)))[None, :]

    def _unary(self) -> Any:
        if self._take("-"):
            return -plain(_number(self._unary()))
        if self._take("+"):
            return self._unary()
        if self._take("~") or self._take("!"):
            return float(not np.all(self._unary()))
        base = self._postfix()
        token = self._peek()
        if token is not None and token.text in ("^", ".^") and token.kind == "operator":
            self.at += 1
            return self._of(token.text, base, self._unary())
        return base

    def _postfix(self) -> Any:
        value = self._atom()
        while (token := self._peek()) is not None and token.kind == "operator":
            if token.text not in ("'", ".'") or token.spaced:
                break
            self.at += 1
            value = value.T if isinstance(value, np.ndarray) else value
        return value

    def _atom(self) -> Any:
        token = self._peek()
        if token is None:
            raise NotEvaluated("the expression ends too early")
        self.at += 1
        if token.kind == "number":
            return np.float64(token.text.lower().replace("d", "e"))
        if token.kind == "string":
            return token.text
        if token.kind == "name":
            return self._name(token.text)
        if token.text == "(":
            rows, self.rows = self.rows, 0
            value = self._level(0)
            self.rows = rows
            self._expect(")")
            return value
        if token.text == "@" and (named := self._peek()) is not None and named.kind == "name":
            self.at += 1
            return Handle(named.text)
        if token.text in "[{":
            return self._bracket("]" if token.text == "[" else "}")
        raise NotEvaluated(f"{token.text!r} is not understood here")

    def _expect(self, text: str) -> None:
        if not self._take(text):
            raise NotEvaluated(f"{text!r} is missing")

    def _arguments(self) -> list[Any]:
        rows, self.rows = self.rows, 0
        values: list[Any] = []
        while not self._take(")"):
            if self._peek() is None:
                raise NotEvaluated("')' is missing")
            if not self._take(","):
                values.append(self._level(0))
        self.rows = rows
        return values

    def _name(self, name: str) -> Any:
        path, arguments = [], None
        while (token := self._peek()) is not None and token.kind == "operator":
            if token.text == "(" and not (self.rows and token.spaced):
                self.at += 1
                arguments = self._arguments()
                path.append(f"({','.join(_index(value) for value in arguments)})")
            elif token.text == "." and self._is_field():
                path.append(self.tokens[self.at + 1].text)
                self.at += 2
            else:
                break
        if self.skipped:
            return 0.0
        try:
            return self.look_up(name, tuple(path))
        except NotEvaluated:
            if name in _CONSTANTS and not path:
                return _CONSTANTS[name]
            if len(path) <= 1 and (arguments is not None) == bool(path):
                return self.call(name, arguments or [])
            raise

    def _is_field(self) -> bool:
        following = self.tokens[self.at + 1] if self.at + 1 < len(self.tokens) else None
        return following is not None and following.kind == "name"

    def _bracket(self, end: str) -> Any:
        rows: list[list[Any]] = [[]]
        self.rows += 1
        while not self._take(end):
            token = self._peek()
            if token is None:
                raise NotEvaluated(f"{end!r} is missing")
            if token.kind == "newline" or token.text == ";":
                self.at += 1
                rows.append([])
            elif not self._take(","):
                rows[-1].append(self._level(0))
        self.rows -= 1
        rows = [row for row in rows if row and not self.skipped]
        if end == "}":
            return [plain(value) for row in rows for value in row]
        return _matrix(rows)


def _matrix(rows: list[list[Any]]) -> Any:
    if rows and all(isinstance(value, Quoted) for row in rows for value in row):
        return [value for row in rows for value in row]
    if any(isinstance(value, str) for row in rows for value in row):
        if len(rows) == 1 and all(isinstance(value, str) for value in rows[0]):
            return _joined(rows[0])
        raise NotEvaluated("strings and numbers in one array")
    try:
        parts = [[np.atleast_2d(_number(value)) for value in row] for row in rows]
        parts = [[part for part in row if part.size] for row in parts]
        sized(sum(part.size for row in parts for part in row))
        blocks = [np.hstack(row) for row in parts if row]
        return np.vstack(blocks).astype(float) if blocks else np.zeros((0, 0))
    except ValueError:
        raise NotEvaluated("the rows of an array differ in length") from None


def _joined(texts: list[Any]) -> str:
    sized(sum(len(text) for text in texts))
    return "".join(texts)


def _index(value: Any) -> str:
    value = plain(value)
    return f"{value:.0f}" if isinstance(value, float) and math.isfinite(value) else ":"


def _number(value: Any) -> Any:
    if isinstance(value, str | list):
        raise NotEvaluated("a number is needed")
    return value


def _is_decided(operator: str, left: Any) -> bool:
    """Whether a logical operation has its value without the right operand."""
    return operator in _DECIDES and bool(np.all(_number(left))) is _DECIDES[operator]


def _combine(operator: str, left: Any, right: Any) -> Any:
    if isinstance(left, str) or isinstance(right, str):
        if operator == "==":
            return left == right
        if operator == "+" and isinstance(left, str) and isinstance(right, str):
            return _joined([left, right])
        raise NotEvaluated(f"{operator!r} of strings")
    left, right = plain(_number(left)), plain(_number(right))
    scalars = (np.size(left) == 1) + (np.size(right) == 1)
    if scalars >= (2 if operator == "^" else 1) and operator in "*/^":
        operator = f".{operator}"
    if operator == "*":
        product = [np.atleast_2d(value) for value in (left, right)]
        sized(product[0].shape[0], product[1].shape[1], product[0].shape[1])
        return product[0] @ product[1]
    operator = {"!=": "~=", "&": "&&", "|": "||"}.get(operator, operator)
    if operator not in _OPERATIONS:
        raise NotEvaluated(f"{operator!r} of matrices")
    sized(*np.broadcast_shapes(np.shape(left), np.shape(right)))
    return plain(_real(_OPERATIONS[operator](np.asarray(left), right), left, right))


def _reshaped(array: Any, sizes: list[Any]) -> Any:
    """Values column by column in another shape; one size may be ``[]``, and follows."""
    sides = [int(s) for s in np.ravel(sizes[0])] if len(sizes) == 1 else []
    for size in sizes if len(sizes) == 2 else ():
        sides.append(-1 if np.size(size) == 0 else int(_number(size)))
    if len(sides) != 2:
        raise NotEvaluated("reshape to two axes is known here")
    return np.reshape(array, sides, order="F")


def _square(sizes: list[Any]) -> tuple[int, int]:
    """Shape by none, one or two sizes."""
    shape = [float(_number(size)) for size in sizes or [1.0]]
    sized(shape[0], shape[-1])
    return max(int(shape[0]), 0), max(int(shape[-1]), 0)


def function_value(name: str, values: list[Any]) -> Any:
    """Value of a function of numbers or text that is known here.

    Raises
    ------
    NotEvaluated
        It is not known, or its arguments are others than it takes here.
    """
    if name in ("zeros", "ones") and len(values) <= 2:
        return np.full(_square(values), float(name == "ones"))
    if name == "eye" and len(values) <= 2:
        return np.eye(*_square(values))
    if name in ("double", "string", "char") and len(values) == 1:
        return values[0]
    if name in _ELEMENTWISE and len(values) == 1:
        value = plain(_number(values[0]))
        return _real(_ELEMENTWISE[name](value), value)
    if name == "diag" and len(values) == 1:
        array = np.atleast_2d(_number(values[0]))
        sized(max(array.shape), max(array.shape))
        return np.diag(array.ravel()) if 1 in array.shape else np.diag(array)[:, None]
    if name == "linspace" and len(values) in (2, 3):
        count = values[2] if values[2:] else 100.0
        sized(count)
        return np.linspace(values[0], values[1], int(count))[None, :]
    if name in ("max", "min") and len(values) in (1, 2):
        function = np.max if name == "max" else np.min
        return function(np.hstack([np.ravel(_number(value)) for value in values]))
    if name in ("length", "numel") and len(values) == 1:
        extent = np.shape(np.atleast_2d(_number(values[0])))
        return float(np.prod(extent) if name == "numel" or 0 in extent else max(extent))
    if name == "reshape" and len(values) in (2, 3):
        return _reshaped(_number(values[0]), values[1:])
    if name == "fullfile" and values and all(isinstance(value, str) for value in values):
        return _joined([part for value in values for part in ("/", value)][1:])
    if name in ("strcat", "append") and all(isinstance(value, str) for value in values):
        return _joined(values)
    if name == "struct" and not values:
        return []
    if name == "struct" and len(values) % 2 == 0:
        raise NotEvaluated("a struct of pairs")
    raise NotEvaluated(f"{name} is not known here")
