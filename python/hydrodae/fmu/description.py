"""modelDescription.xml of FMI 2.0 and 3.0."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from xml.etree import ElementTree as Xml

from hydrodae.fmu.units import base_units
from hydrodae.fmu.variables import OUTPUT, Value, Variable
from hydrodae.support.licences import expression
from hydrodae.support.version import version

_CAN = {
    "canHandleVariableCommunicationStepSize": "true",
    "canSerializeFMUState": "true",
    "canGetAndSetFMUState": "true",
}


@dataclass(frozen=True)
class Type:
    """How a type of values is called."""

    line: str  #: in variables.txt, of a parameter
    fmi2: str  #: in modelDescription.xml
    fmi3: str


def type_of(variable: Variable) -> Type:
    """Type of a variable, that of its start value."""
    match variable.start:
        case bool():
            return Type("boolean", "Boolean", "Boolean")
        case int():
            return Type("integer", "Integer", "Int32")
        case str():
            return Type("text", "String", "String")
    return Type("parameter", "Real", "Float64")


def start_text(start: Value) -> str:
    """A start value in the files of an FMU."""
    if isinstance(start, bool):
        return "true" if start else "false"
    return start if isinstance(start, str) else repr(start)


@dataclass(frozen=True)
class Description:
    """What the XML file shows."""

    identifier: str  #: name of the shared library, a C identifier
    title: str
    token: str
    end_time: float  #: s
    step: float  #: suggested communication step, s
    variables: Sequence[Variable]


def model_description(told: Description, fmi: int) -> bytes:
    """Return the XML file for version 2 or 3 of FMI."""
    root = _root_2(told) if fmi == 2 else _root_3(told)
    Xml.indent(root)
    return bytes(Xml.tostring(root, encoding="UTF-8", xml_declaration=True))


def _root_3(told: Description) -> Xml.Element:
    names = {"fmiVersion": "3.0", "instantiationToken": told.token, **_names(told)}
    root = Xml.Element("fmiModelDescription", names)
    _add(root, "CoSimulation", modelIdentifier=told.identifier, **_CAN)
    _add_units(root, told)
    _add_experiment(root, told)
    variables = _add(root, "ModelVariables")
    structure = Xml.Element("ModelStructure")
    time = {"causality": "independent", "variability": "continuous", "unit": "s"}
    _add(variables, "Float64", name="time", valueReference="0", **time)
    for variable in told.variables:
        attributes = _attributes(variable)
        number = attributes["valueReference"]
        text = variable.start if isinstance(variable.start, str) else None
        start = {} if text is not None else _value(variable)
        added = _add(variables, type_of(variable).fmi3, **attributes, **start)
        if text is not None:
            _add(added, "Start", value=text)
        if variable.causality is OUTPUT:
            _add(structure, "Output", valueReference=number)
    for variable in told.variables:
        if variable.causality is OUTPUT:
            number = str(variable.reference)
            _add(structure, "InitialUnknown", valueReference=number)
    root.append(structure)
    return root


def _root_2(told: Description) -> Xml.Element:
    names = {"fmiVersion": "2.0", "guid": told.token, **_names(told)}
    root = Xml.Element("fmiModelDescription", names)
    can = {key.replace("FMUState", "FMUstate"): value for key, value in _CAN.items()}
    _add(root, "CoSimulation", modelIdentifier=told.identifier, **can)
    _add_units(root, told)
    _add_experiment(root, told)
    variables = _add(root, "ModelVariables")
    time = {"causality": "independent", "variability": "continuous"}
    scalar = _add(variables, "ScalarVariable", name="time", valueReference="0", **time)
    _add(scalar, "Real", unit="s")
    outputs = []  # by place in the list, from 1 on
    for place, variable in enumerate(told.variables, start=2):
        attributes = _attributes(variable)
        unit = {"unit": attributes.pop("unit")} if "unit" in attributes else {}
        scalar = _add(variables, "ScalarVariable", **attributes)
        _add(scalar, type_of(variable).fmi2, **unit, **_value(variable))
        if variable.causality is OUTPUT:
            outputs.append(str(place))
    structure = _add(root, "ModelStructure")
    for name in ("Outputs", "InitialUnknowns") if outputs else ():
        part = _add(structure, name)
        for place_text in outputs:
            _add(part, "Unknown", index=place_text)
    return root


def _add(parent: Xml.Element, tag: str, **attributes: str) -> Xml.Element:
    return Xml.SubElement(parent, tag, attributes)


def _names(told: Description) -> dict[str, str]:
    return {
        "modelName": told.title,
        "generationTool": f"hydrodae {version()}",
        "license": expression(),
        "copyright": "hydrodae contributors",
        "variableNamingConvention": "flat",
    }


def _attributes(variable: Variable) -> dict[str, str]:
    out = {
        "name": variable.name,
        "valueReference": str(variable.reference),
        "causality": variable.causality.word,
        "variability": variable.causality.variability,
    }
    if variable.causality.initial:
        out["initial"] = variable.causality.initial
    if variable.unit not in ("", "-"):
        out["unit"] = variable.unit
    return out


def _value(variable: Variable) -> dict[str, str]:
    return {} if variable.start is None else {"start": start_text(variable.start)}


def _add_units(root: Xml.Element, told: Description) -> None:
    names = {v.unit for v in told.variables} - {"", "-"} | {"s"}
    units = _add(root, "UnitDefinitions")
    for name in sorted(names):
        unit = _add(units, "Unit", name=name)
        powers = base_units(name)
        if powers is not None:
            powers_text = {base: str(power) for base, power in powers.items()}
            _add(unit, "BaseUnit", **powers_text)


def _add_experiment(root: Xml.Element, told: Description) -> None:
    _add(
        root,
        "DefaultExperiment",
        startTime="0",
        stopTime=repr(told.end_time),
        stepSize=repr(told.step),
    )
