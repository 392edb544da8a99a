"""Mutated cases and command lines."""

from __future__ import annotations

import copy
import re
import tomllib
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from typing import Any

from tests.fuzz.values import TEXTS, anything, case_text, near, number, toml

Tables = dict[str, Any]
ROOT = Path(__file__).resolve().parents[2]
LISTS = ("body", "joint", "constraint", "marker", "force", "morison", "wave", "gauge")


@dataclass
class Corpus:
    """Cases to start from, what they are made of, and all keys that the program knows."""

    cases: list[Tables]
    entries: dict[str, list[Tables]] = field(init=False)
    singles: dict[str, list[Tables]] = field(init=False)
    keys: list[str] = field(init=False)

    def __post_init__(self) -> None:
        """Take the cases apart."""
        self.entries = {name: [e for c in self.cases for e in c.get(name, [])] for name in LISTS}
        single = {name for c in self.cases for name, v in c.items() if isinstance(v, dict)}
        self.singles = {n: [c[n] for c in self.cases if n in c] for n in sorted(single)}
        headers = sorted((ROOT / "cpp" / "hydrodae").rglob("*.[ch]*"))
        text = "".join(path.read_text() for path in headers)
        self.keys = sorted(set(re.findall(r'\{\s*"([a-z_0-9]+)",\s*&', text)))


def collect(databases: Path) -> Corpus:
    """All small cases of the repository; `databases` takes the files that they name."""
    from tests.stability import all_scenes

    paths = [
        *sorted((ROOT / "cases").rglob("*.toml")),
        *sorted((ROOT / "tests/fuzz/seeds").glob("*")),
    ]
    found = []
    for path in paths:
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
        if "hydro" in tables:
            folder = ROOT / "cases" / "sphere" if "fuzz" in path.parts else path.parent
            if not (folder / "hydro.h5").exists():  # made from data of others
                continue
            tables["hydro"]["database"] = str(folder / "hydro.h5")
        for controller in tables.get("controller", []):
            if controller["type"] == "tcp":  # nobody is there
                controller |= {"connect_timeout": 0.2, "timeout": 0.2}
        found.append(tables)
    for scene in all_scenes().values():
        tables = copy.deepcopy(dict(scene.tables))
        if scene.database is not None:
            file = databases / f"{scene.name}.h5"
            scene.database(file)
            tables["hydro"] = {**tables.get("hydro", {}), "database": str(file)}
        found.append(tables)
    return Corpus([_plain(tables) for tables in found])


def _plain(value: Any) -> Any:
    """Numbers and lists of numpy and tuples as those of Python."""
    if isinstance(value, dict):
        return {str(k): _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    return value.tolist() if hasattr(value, "tolist") else value


def _places(node: Any) -> Iterator[tuple[Any, Any]]:
    """All (container, key) of values."""
    pairs = node.items() if isinstance(node, dict) else enumerate(node)
    for k, value in pairs:
        yield node, k
        if isinstance(value, (dict, list)):
            yield from _places(value)


def _names(tables: Tables) -> list[str]:
    entries = [e for name in LISTS for e in _listed(tables, name)]
    return [str(e["name"]) for e in entries if "name" in e] or ["ground"]


def _listed(tables: Tables, name: str) -> list[Tables]:
    value = tables.get(name)
    return [e for e in value if isinstance(e, dict)] if isinstance(value, list) else []


def _change_value(tables: Tables, corpus: Corpus, random: Random) -> None:
    owner, k = random.choice(list(_places(tables)))
    owner[k] = near(owner[k], random)


def _change_type(tables: Tables, corpus: Corpus, random: Random) -> None:
    owner, k = random.choice(list(_places(tables)))
    owner[k] = anything(random)


def _change_number(tables: Tables, corpus: Corpus, random: Random) -> None:
    """Only numbers, so that the case is read and the checks and the solver meet them."""
    places = [(o, k) for o, k in _places(tables) if type(o[k]) in (int, float)]
    for owner, k in random.sample(places, min(len(places), random.choice((1, 1, 2, 5)))):
        owner[k] = number(random)


def _change_a_little(tables: Tables, corpus: Corpus, random: Random) -> None:
    """A number by a factor."""
    places = [(o, k) for o, k in _places(tables) if type(o[k]) is float]
    if places:
        owner, k = random.choice(places)
        owner[k] *= random.choice((-1.0, 0.0, 0.1, 10.0, 1e3, 1e-3, 1e-9, 1e9))


def _change_reference(tables: Tables, corpus: Corpus, random: Random) -> None:
    places = [(o, k) for o, k in _places(tables) if isinstance(o[k], str)]
    if places:
        owner, k = random.choice(places)
        owner[k] = random.choice((*_names(tables), *TEXTS))


def _tables_of(tables: Tables) -> list[Tables]:
    return [tables, *(o[k] for o, k in _places(tables) if isinstance(o[k], dict))]


def _change_key(tables: Tables, corpus: Corpus, random: Random) -> None:
    owner = random.choice(_tables_of(tables))
    if not owner:
        return
    k = random.choice(list(owner))
    how = random.randrange(4)
    if how == 0:
        del owner[k]
    elif how == 1:
        owner[random.choice((*corpus.keys, *TEXTS))] = owner.pop(k)
    elif how == 2:
        other = random.choice(list(owner))
        owner[k], owner[other] = owner[other], owner[k]
    else:
        owner[random.choice(corpus.keys)] = random.choice((number, anything))(random)


def _change_entries(tables: Tables, corpus: Corpus, random: Random) -> None:
    """Drop, double or move a table."""
    name = random.choice(list(tables))
    value, how = tables[name], random.randrange(4)
    if how == 0:
        del tables[name]
    elif how == 1 and isinstance(value, list) and value:
        value.append(copy.deepcopy(random.choice(value)))
        if random.random() < 0.5 and isinstance(value[-1], dict):
            value[-1]["name"] = "another"
    elif how == 2 and isinstance(value, list) and value:
        value.pop(random.randrange(len(value)))
    elif how == 3:
        tables[random.choice((*LISTS, *TEXTS))] = copy.deepcopy(value)


def _combine(tables: Tables, corpus: Corpus, random: Random) -> None:
    """Add an element of any case between bodies and joints of this one."""
    name = random.choice(LISTS)
    if not corpus.entries[name] or not isinstance(tables.get(name, []), list):
        return
    kinds = sorted({str(e.get("type")) for e in corpus.entries[name]})
    kind = random.choice(kinds)
    entry = copy.deepcopy(
        random.choice([e for e in corpus.entries[name] if str(e.get("type")) == kind])
    )
    entry["name"] = f"new_{random.randrange(1000)}"
    for k in ("body", "body_a", "body_b", "joint", "joint_b"):
        of = k.partition("_")[0]
        names = [str(e.get("name")) for e in _listed(tables, of)]
        if k in entry and names:
            entry[k] = random.choice([*names, "ground"] if of == "body" else names)
    tables.setdefault(name, []).append(entry)


def _exchange_single(tables: Tables, corpus: Corpus, random: Random) -> None:
    """Take [solver], [hydro], [sea], .. from another case, but not its length."""
    name = random.choice(list(corpus.singles))
    single = copy.deepcopy(random.choice(corpus.singles[name]))
    if name == "solver" and isinstance(tables.get("solver"), dict):
        single["end_time"] = tables["solver"].get("end_time", 1.0)
    tables[name] = single


METHODS: tuple[dict[str, Any], ...] = (
    {"method": "auto"},
    {"method": "auto", "max_step": 0.05},
    {"method": "ida"},
    {"method": "radau"},
    {"method": "radau", "order": 9, "step": 0.01},
    {"method": "explicit_rk"},
    {"method": "explicit_rk", "order": 5},
    {"method": "generalized_alpha", "step": 0.002},
    {"method": "gauss", "step": 0.01, "order": 2},
    {"method": "lobatto_iiic", "step": 0.01},
    {"method": "ida", "formulation": "index_1", "baumgarte_time": 0.1},
    {"method": "radau", "formulation": "index_3", "force": True},
)


def _change_method(tables: Tables, corpus: Corpus, random: Random) -> None:
    if isinstance(tables.get("solver"), dict):
        tables["solver"].update(random.choice(METHODS))
        tables["solver"]["start"] = random.choice(("given", "given", "equilibrium"))


def _add_stop(tables: Tables, corpus: Corpus, random: Random) -> None:
    """A stop, dry friction or a drive on a joint."""
    joints = [e for e in _listed(tables, "joint") if e.get("type") not in ("fixed", "spherical")]
    if not joints:
        return
    joint = random.choice(joints)
    turns = joint.get("type") in ("revolute", "universal", "cylindrical", "screw")
    end, at = ("_deg", random.choice((10.0, 0.0, 1e-6, 400.0))) if turns else ("", 0.1)
    new = f"new_{random.randrange(1000)}"
    kind = random.randrange(4)
    if kind <= 1:
        stop = {"type": "stop", "joint": joint.get("name"), f"upper{end}": at}
        if random.random() < 0.5:
            stop |= {f"lower{end}": -at, "restitution": random.choice((0.0, 0.5, 1.0))}
        tables.setdefault("constraint", []).append({"name": new, **stop})
    elif kind == 2:
        friction = {"type": "dry_friction", "joint": joint.get("name"), "static": 1.0}
        tables.setdefault("force", []).append({"name": new, **friction})
    else:
        drive = {"amplitude": 0.1, "period": 1.0}
        motor = {"type": "coordinate", "joint": joint.get("name"), "drive": drive}
        tables.setdefault("constraint", []).append({"name": new, **motor})


SOUND: tuple[Callable[[Tables, Corpus, Random], None], ...] = (
    *(_combine, _combine, _change_method, _change_method, _add_stop, _add_stop, _change_a_little),
)
MUTATIONS: tuple[Callable[[Tables, Corpus, Random], None], ...] = (
    *(_change_value, _change_type, _change_number, _change_number, _change_reference),
    *(_change_key, _change_entries, _combine, _combine, _combine, _exchange_single),
    *(_change_method, _change_method, _add_stop, _add_stop),
)


def mutated(corpus: Corpus, random: Random) -> str:
    """A case file.

    Half of them keep to the rules, so that most can be run: elements combined at random, other
    methods, and one number that is off. Of the others one in five has its text damaged.
    """
    tables = copy.deepcopy(random.choice(corpus.cases))
    if isinstance(tables.get("solver"), dict) and tables["solver"].get("end_time", 0.0) > 5.0:
        tables["solver"]["end_time"] = random.choice((0.1, 1.0, 5.0))
    sound = random.random() < 0.5
    for _ in range(random.choice((1, 2, 3) if sound else (1, 1, 2, 2, 3, 5, 10))):
        # What an earlier change left may not be changed so.
        with suppress(AttributeError, KeyError, TypeError):
            random.choice(SOUND if sound else MUTATIONS)(tables, corpus, random)
    if sound and random.random() < 0.3:
        _change_a_little(tables, corpus, random)
    text = case_text(tables)
    return damaged(text, random) if not sound and random.random() < 0.2 else text


def damaged(text: str, random: Random) -> str:
    """Characters lost, doubled or foreign; lines moved."""
    for _ in range(random.choice((1, 1, 3, 10))):
        at = random.randrange(len(text) + 1)
        end = min(len(text), at + random.choice((1, 1, 10, 100)))
        how = random.randrange(4)
        if how == 0:
            text = text[:at] + text[end:]
        elif how == 1:
            text = text[:at] + text[at:end] + text[at:]
        elif how == 2:
            text = text[:at] + random.choice((*TEXTS, *"[]{}=,.'\"#\r")) + text[at:]
        else:
            lines = text.splitlines(keepends=True)
            random.shuffle(lines)
            text = "".join(lines)
    return text


def words(text: str, corpus: Corpus, random: Random) -> list[str]:
    """A command line: values set in a case, options that need not exist."""
    try:
        tables = tomllib.loads(text)
    except (ValueError, RecursionError):
        tables = {}
    found = []
    for _ in range(random.choice((1, 1, 2, 5))):
        how = random.randrange(12)
        numbers = _number_places(tables) if how < 5 else []
        if numbers:
            k, value = random.choice(numbers)
            found += ["--set", f"{k}={toml(near(value, random))}"]
        elif how < 9:
            found += ["--set", f"{_dotted(tables, corpus, random)}={_given(random)}"]
        elif how == 9:
            found += ["--method", random.choice(("auto", "ida", "radau", "explicit_rk", *TEXTS))]
        elif how == 10:
            found += [random.choice(("--set", "--force", "--quiet", "--check", "-o", "--method"))]
        else:
            found += [random.choice((*TEXTS, "--", "-", "--version", "--help", "--st", "a=b"))]
    return [word.replace("\0", "") for word in found]


def _number_places(tables: Tables) -> list[tuple[str, Any]]:
    """Dotted keys of numbers, and their values."""
    found = []
    owners = [(n, v) for n, v in tables.items() if isinstance(v, dict)]
    owners += [(f"{n}.{e.get('name')}", e) for n in LISTS for e in _listed(tables, n)]
    for path, owner in owners:
        for k, value in owner.items():
            inner = value.items() if isinstance(value, dict) else [("", value)]
            dotted = [(f"{path}.{k}.{i}".rstrip("."), v) for i, v in inner]
            found += [pair for pair in dotted if type(pair[1]) in (int, float)]
    return found


def _given(random: Random) -> str:
    value = random.choice((number, number, anything))(random)
    text = toml(value)
    return random.choice((text, text, text, text[:-1], text + text, random.choice(TEXTS)))


def _dotted(tables: Tables, corpus: Corpus, random: Random) -> str:
    """A key of the case, of another one, or none."""
    part: Any = tables
    parts: list[str] = []
    while isinstance(part, (dict, list)) and part and random.random() < 0.95:
        if isinstance(part, list):
            entry = random.choice(part)
            parts.append(str(entry.get("name", "#1")) if isinstance(entry, dict) else "0")
            part = entry
        else:
            k = random.choice([*part, random.choice(corpus.keys)])
            parts.append(str(k))
            part = part.get(k)
    if random.random() < 0.1:
        parts.insert(random.randrange(len(parts) + 1), random.choice((*TEXTS, *corpus.keys)))
    return ".".join(parts)
