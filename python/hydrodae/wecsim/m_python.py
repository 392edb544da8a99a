"""MATLAB functions of plain arithmetic as lines of Python."""

from __future__ import annotations

import keyword
import re
from collections.abc import Collection, Sequence

from hydrodae.wecsim.m_blocks import assignment, without_newlines
from hydrodae.wecsim.m_text import NotEvaluated, Statement, Token, statements

#: Functions of numbers, by their name in MATLAB.
FUNCTIONS = {
    **{n: f"math.{n}" for n in "sqrt exp log sin cos tan asin acos atan atan2".split()},
    **{n: f"math.{n}" for n in "sinh cosh tanh floor ceil".split()},
    "abs": "abs",
    "min": "min",
    "max": "max",
    "sign": "sign",
}
_OPERATORS = {
    **{text: text for text in ("+", "-", "*", "/", "(", ")", ",", "<", ">", "<=", ">=", "==")},
    **{".*": "*", "./": "/", "^": "**", ".^": "**", "~=": "!=", "!=": "!="},
    **{"&&": "and", "&": "and", "||": "or", "|": "or", "'": "", ".'": ""},
}
_COMPARED = ("<", ">", "<=", ">=", "==", "!=")


def head_of(script: str) -> tuple[str, list[str]]:
    """The only output of a function and its arguments.

    Raises
    ------
    NotEvaluated
        It has no text, or several outputs.
    """
    head = re.match(r"\s*(?:%[^\n]*\n\s*)*function\s+(\w+)\s*=\s*\w+\s*\(([^)]*)\)", script)
    if head is None:
        raise NotEvaluated("a MATLAB function without text, or with several outputs")
    return head[1], [word.strip() for word in head[2].split(",") if word.strip()]


def python_lines(
    script: str, known: Collection[str], vectors: dict[str, dict[int, str]]
) -> list[str]:
    """Lines of Python for the statements of a function, without its head.

    Parameters
    ----------
    script : str
    known : collection of str
        Arguments that are numbers.
    vectors : dict of dict
        Arguments that are vectors: the Python of their elements, by index from 1 on.

    Raises
    ------
    NotEvaluated
        A statement is something else than arithmetic of numbers, or `if`.
    """
    return _Translation(set(known), vectors).run(statements(script)[1:])


class _Translation:
    def __init__(self, known: set[str], vectors: dict[str, dict[int, str]]) -> None:
        self.known, self.vectors = known, vectors

    def run(self, parts: Sequence[Statement]) -> list[str]:
        lines: list[str] = []
        depth = 0
        for number, part in enumerate(parts):
            tokens = without_newlines(part.tokens)
            if not tokens:
                continue
            word = tokens[0].text if tokens[0].kind == "name" else ""
            if word == "function":
                break
            if word == "end" and len(tokens) == 1:
                depth -= 1
                if depth < 0:  # that of the function
                    break
            elif word in ("if", "elseif", "else"):
                depth += word == "if"
                test = {"if": "if ", "elseif": "elif ", "else": "else"}[word]
                test += self.text(tokens[1:]) if word != "else" else ""
                lines.append("    " * (depth - 1) + test + ":")
                if self._is_empty(parts[number + 1 :]):
                    lines.append("    " * depth + "pass")
            else:
                lines.append("    " * depth + self.assigned(tokens))
        return lines

    def _is_empty(self, rest: Sequence[Statement]) -> bool:
        found = (without_newlines(part.tokens) for part in rest)
        first = next((tokens for tokens in found if tokens), ())
        return bool(first) and first[0].text in ("end", "elseif", "else")

    def assigned(self, tokens: tuple[Token, ...]) -> str:
        equals = assignment(tokens)
        if equals != 1 or tokens[0].kind != "name":
            raise NotEvaluated(f"the statement in line {tokens[0].line} of a MATLAB function")
        name = tokens[0].text
        if keyword.iskeyword(name) or name in FUNCTIONS or name == "math":
            raise NotEvaluated(f"a variable {name!r} in a MATLAB function")
        text = self.text(tokens[2:])
        self.known.add(name)
        self.vectors.pop(name, None)
        return f"{name} = {text}"

    def text(self, tokens: Sequence[Token]) -> str:
        words: list[str] = []
        #: Comparisons of the open brackets, and whether their last operator is a power.
        open_: list[tuple[int, bool]] = [(0, False)]
        at = 0
        while at < len(tokens):
            token = tokens[at]
            if token.kind == "name":
                word, at = self._name(tokens, at)
                words.append(word)
                continue
            at += 1
            if token.kind == "number":
                words.append(re.sub("[dD]", "e", token.text))
                continue
            if token.kind != "operator" or token.text not in _OPERATORS:
                raise NotEvaluated(f"{token.text!r} in a MATLAB function")
            word = _OPERATORS[token.text]
            words.append(word)
            _follow(open_, word)
        joined = re.sub(r"(\() | (?=[),])", r"\1", " ".join(word for word in words if word))
        return re.sub(r"(math\.\w+|\b(?:abs|min|max|sign)) \(", r"\1(", joined)

    def _name(self, tokens: Sequence[Token], at: int) -> tuple[str, int]:
        name = tokens[at].text
        called = at + 1 < len(tokens) and tokens[at + 1].text == "("
        if name in self.vectors:
            index = [token.text for token in tokens[at + 2 : at + 4]] if called else []
            element = int(index[0]) if len(index) == 2 and index[0].isdecimal() else 0
            if element not in self.vectors[name] or index[1] != ")":
                raise NotEvaluated(f"other elements of {name!r} in a MATLAB function")
            return self.vectors[name][element], at + 4
        if called and name in FUNCTIONS and name not in self.known:
            return FUNCTIONS[name], at + 1
        if name == "pi" and name not in self.known:
            return "math.pi", at + 1
        if called or name not in self.known:
            raise NotEvaluated(f"{name!r} in a MATLAB function")
        return name, at + 1


def _follow(open_: list[tuple[int, bool]], word: str) -> None:
    """Refuse what Python reads otherwise: a < b < c, and a^b^c."""
    if word == "(":
        open_.append((0, False))
    elif word == ")":
        open_.pop()
    elif word in (",", "and", "or"):
        open_[-1] = (0, False)
    elif word:
        compared, power = open_[-1]
        compared += word in _COMPARED
        if compared > 1 or (power and word == "**"):
            raise NotEvaluated("a chain of comparisons or powers in a MATLAB function")
        open_[-1] = (compared, word == "**")
