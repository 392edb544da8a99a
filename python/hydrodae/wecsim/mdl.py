"""Models in the text format of older Simulink (.mdl), as the XML that .slx files hold.

A file is nested ``Name { key value ... }``. A value is a word, an array in brackets, or a string in
quotes that goes on in the next line if that begins with a quote. Lines name blocks, not numbers.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

from hydrodae.errors import CaseError
from hydrodae.wecsim.archive import LARGEST
from hydrodae.wecsim.slx import BLOCKS, CHART, Model, read_model

_STRING = r'"(?:[^"\\]|\\.)*"'
_STRINGS = re.compile(rf"{_STRING}(?:\s*{_STRING})*")
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}
_ENCODING = re.compile(rb'SavedCharacterEncoding\s+"([\w-]{1,40})"')
#: Most parts within each other; models of WEC-Sim have less than 20.
DEEPEST = 200


@dataclass
class Part:
    """A part ``name { ... }`` of a file, from a line on."""

    name: str
    line: int
    values: dict[str, str] = field(default_factory=dict)
    parts: list[Part] = field(default_factory=list)

    def of(self, name: str) -> list[Part]:
        """Parts in it of this name."""
        return [part for part in self.parts if part.name == name]

    def below(self) -> Iterator[Part]:
        """All parts in it."""
        for part in self.parts:
            yield part
            yield from part.below()


def read_mdl(path: Path) -> Model:
    """Read the topology of a model.

    Raises
    ------
    CaseError
        There is no such file, or a line of it cannot be read.
    """
    return read_model(path, _Files(path, parse(path)))


def parse(path: Path) -> Part:
    """Read a file: a part without a name that holds all others.

    Raises
    ------
    CaseError
        As `read_mdl`.
    """
    root = Part("", 0)
    opened, last = [root], ""  # last: key whose string may go on
    lines = enumerate(_text(path).splitlines(), 1)
    for number, line in lines:
        place, text = f"{path}:{number}", line.strip()
        if not text or text.startswith("#"):
            continue
        key, value = [*text.split(None, 1), ""][:2]
        if text.startswith('"') and last:
            opened[-1].values[last] += _string(text, place)
        elif text == "}" and len(opened) > 1:
            opened.pop()
            last = ""
        elif value == "{" and len(opened) <= DEEPEST:
            opened.append(Part(key, number))
            opened[-2].parts.append(opened[-1])
            last = ""
        elif re.fullmatch(r"\$?[\w.:]+", key) and value and value != "{":
            while value.startswith("[") and value.count("[") > value.count("]"):
                value += " " + next(lines, (0, "]"))[1].strip()
            last = key if value.startswith('"') else ""
            opened[-1].values[key] = _string(value, place) if last else value
        else:
            raise CaseError(
                f"{place}: cannot be read as a line of an .mdl file: expected `key value`, "
                f"`Name {{` or `}}`, got {text[:60]!r}"
            )
    if len(opened) > 1:
        part = opened[-1]
        raise CaseError(f"{path}:{part.line}: {part.name} {{ is not closed; is the file cut off?")
    return root


def _text(path: Path) -> str:
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST + 1)
    except FileNotFoundError:
        raise CaseError(f"{path}: there is no such file") from None
    except OSError as error:
        raise CaseError(f"{path}: no .mdl file of Simulink ({error})") from None
    if len(data) > LARGEST:
        raise CaseError(f"{path}: more than {LARGEST} bytes")
    if data.startswith(b"PK") or b"__MWOPC_PACKAGE_BEGIN__" in data:
        raise CaseError(f"{path}: an .mdl file that is a package; save it as .slx in Simulink")
    stated = _ENCODING.search(data)
    try:
        return data.decode(stated.group(1).decode() if stated else "utf-8")
    except (LookupError, ValueError) as error:
        raise CaseError(f"{path}: no .mdl file of Simulink ({error})") from None


def _string(text: str, place: str) -> str:
    """The strings of a line, joined."""
    if not _STRINGS.fullmatch(text):
        raise CaseError(f"{place}: a string that does not end in this line: {text[:60]!r}")
    inside = "".join(one[1:-1] for one in re.findall(_STRING, text))
    return re.sub(r"\\(.)", lambda m: _ESCAPES.get(m.group(1), m.group(1)), inside)


class _Files:
    """The files that an .slx archive of the model would hold."""

    def __init__(self, path: Path, root: Part) -> None:
        self._path = path
        self._files = {BLOCKS: self._diagram(root)}
        for number, chart in enumerate(_charts(root), 1):
            self._files[CHART.format(number)] = chart

    def names(self) -> list[str]:
        return list(self._files)

    def xml(self, name: str) -> Element:
        return self._files[name]

    def _diagram(self, root: Part) -> Element:
        out = Element("ModelInformation")
        for part in (*root.of("Model"), *root.of("Library")):
            top = SubElement(out, part.name)
            for system in part.of("System"):
                self._system(top, system)
        return out

    def _system(self, above: Element, system: Part) -> None:
        out = SubElement(above, "System")
        numbers: dict[str, str] = {}
        for count, block in enumerate(system.of("Block"), 1):
            name = block.values.get("Name", "")
            sid = numbers[name] = block.values.get("SID", f"block{count}")
            kind = block.values.get("BlockType", "")
            element = SubElement(out, "Block", BlockType=kind, Name=name, SID=sid)
            _add(element, block.values)
            mask = SubElement(element, "Mask")
            for key, value in _mask(block).items():
                parameter = SubElement(mask, "MaskParameter", Name=key)
                SubElement(parameter, "Value").text = value
            for inner in block.of("System"):
                self._system(element, inner)
        for line in system.of("Line"):
            element = SubElement(out, "Line")
            _add(element, {k: v for k, v in line.values.items() if k == "LineType"})
            for part in (line, *line.below()):
                for end in ("Src", "Dst"):
                    self._end(element, part, end, numbers)

    def _end(self, line: Element, part: Part, end: str, numbers: dict[str, str]) -> None:
        """An end of a line: block and port, such as RConn1, or 2 for a signal."""
        name = part.values.get(f"{end}Block")
        if name is None:
            return
        place = f"{self._path}:{part.line}"
        if name not in numbers:
            raise CaseError(f"{place}: {end}Block: this system has no block {name!r}")
        port = part.values.get(f"{end}Port", "1").lower()
        found = re.fullmatch(r"([lr]conn)?(\d{1,9})", port)
        if found:
            port = f"{found[1] or {'Src': 'out', 'Dst': 'in'}[end]}:{found[2]}"
        SubElement(line, "P", Name=end).text = f"{numbers[name]}#{port}"


def _add(element: Element, values: dict[str, str]) -> None:
    for key, value in values.items():
        SubElement(element, "P", Name=key).text = value


def _mask(block: Part) -> dict[str, str]:
    """Parameters of a mask by name: objects of newer files, lists in two strings of older ones."""
    found = {
        part.values["Name"]: part.values.get("Value", "")
        for mask in block.of("Object")
        if mask.values.get("$PropName") == "MaskObject"
        for part in mask.below()
        if "Name" in part.values
    }
    names = re.findall(r"(\w+)=[@&](\d+)", block.values.get("MaskVariables", ""))
    values = block.values.get("MaskValueString", "").split("|")
    return {n: values[int(k) - 1] for n, k in names if int(k) <= len(values)} | found


def _charts(root: Part) -> Iterator[Element]:
    """Charts of Stateflow with the text of their MATLAB function."""
    for machine in root.of("Stateflow"):
        names = {c.values.get("id"): c.values.get("name", "") for c in machine.of("chart")}
        for state in machine.of("state"):
            for text in state.of("eml"):
                chart = Element("chart")
                name = names.get(state.values.get("chart"), "")
                _add(chart, {"name": name, "script": text.values.get("script", "")})
                yield chart
