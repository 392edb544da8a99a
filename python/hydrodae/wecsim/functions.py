"""Laws of Simulink as a file of Python beside the case: translated ones, and prepared ones."""

from __future__ import annotations

import textwrap
from dataclasses import dataclass, field
from pathlib import Path

from hydrodae.wecsim.diagrams import imports

#: Name of the file beside the case.
FUNCTIONS = "functions.py"
_HEAD = '''"""Laws of {model} for case.toml: blocks of Simulink as functions of Python.

    hydrodae run case.toml --functions functions.py
    hydrodae.run("case.toml", {arguments})
'''
_PREPARED = (
    "Not written yet, zero: {names}. Write each, by the blocks of Simulink in its comments. Then "
    "delete its line in `missing` of case.toml."
)


@dataclass
class Law:
    """A law of one block.

    Attributes
    ----------
    name : str
        Of the force or controller in the case.
    function : str
        Of the function.
    text : list of str
        Its lines.
    prepared : bool
        Whether it answers zero until somebody writes it: a controller. Else it is a force.
    """

    name: str
    function: str
    text: list[str]
    prepared: bool


@dataclass
class FunctionFile:
    """The laws of a case."""

    model: str
    laws: list[Law] = field(default_factory=list)

    def translated(self, name: str, function: str, title: str, body: list[str]) -> None:
        """Add a law of time, coordinate and rate of a joint, to load."""
        head = [f"def {function}(_t, _s, _rate):"]
        doc = f'"""Load of {title} [N or N m] by its blocks in Simulink."""'
        self.laws.append(Law(name, function, head + _indented([doc, *body]), False))

    def prepared(
        self,
        name: str,
        function: str,
        title: str,
        inputs: dict[str, str],
        outputs: list[str],
        blocks: list[str],
    ) -> None:
        """Add a controller that answers zero; inputs by argument, with what they are."""
        doc = [f'"""Force of {title} from Simulink: not written yet, zero.', ""]
        doc += ["Parameters", "----------", "t : float", "    Time [s]."]
        for argument, channel in inputs.items():
            doc += [f"{argument} : float", f"    {channel}, in SI units and rad."]
        doc += ["", "Returns", "-------"]
        zeros = ", ".join(["0.0"] * len(outputs))
        doc += [f"{', '.join(outputs)}: loads [N or N m].", '"""']
        lines = [f"def {function}({', '.join(['t', *inputs])}):", *_indented(doc)]
        comments = [f"# {line}".rstrip() for line in blocks]
        self.laws.append(
            Law(name, function, [*lines, *_indented([*comments, f"return {zeros}"])], True)
        )

    def __str__(self) -> str:
        groups = {"forces": False, "controllers": True}
        found = {n: [law for law in self.laws if law.prepared is p] for n, p in groups.items()}
        used = {name: laws for name, laws in found.items() if laws}
        names = ", ".join(law.function for law in found["controllers"])
        text = _HEAD.format(
            model=self.model, arguments=", ".join(f"{name}={name}" for name in used)
        )
        if names:
            text += "\n" + "\n".join(textwrap.wrap(_PREPARED.format(names=names), 98)) + "\n"
        text += '"""\n'
        here = imports("\n".join("\n".join(law.text) for law in found["forces"]))
        text += f"\n{here}" if here else ""
        text += "".join("\n\n" + "\n".join(law.text) + "\n" for law in self.laws)
        for name, laws in used.items():
            entries = ", ".join(f'"{law.name}": {law.function}' for law in laws)
            text += f"\n\n{name} = {{{entries}}}\n"
        return text.replace("}\n\n\n", "}\n")

    def write(self, folder: Path) -> None:
        """Write the file, where there are laws."""
        if self.laws:
            (folder / FUNCTIONS).write_text(str(self), encoding="utf-8")


def _indented(lines: list[str]) -> list[str]:
    return [f"    {line}".rstrip() for line in lines]
