"""Scenes built in Python: the text that they make, their messages, the functions that take them."""

from __future__ import annotations

import inspect
import tomllib
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from tests.errors import wrong

import hydrodae
from hydrodae.case.tables import tables
from hydrodae.errors import CaseError


def pendulum() -> hydrodae.Scene:
    scene = hydrodae.Scene(title="Pendulum")
    arm = scene.body("arm", mass=1.0, center_of_gravity=[0, 0, -1], inertia=[0.1, 0.1, 0.1])
    scene.joint.revolute(
        "hinge",
        body_a="ground",
        body_b=arm,
        point=np.zeros(3),
        axis=[0, 1, 0],
        initial={"angle_deg": 10.0},
    )
    scene.force.pto_linear("pto", joint="hinge", damping=0.1)
    scene.solver(end_time=0.5)
    return scene


def test_a_scene_is_the_case_file_of_the_same_words(repository: Path, tmp_path: Path) -> None:
    folder = repository / "cases" / "sphere"
    scene = hydrodae.Scene(title="Sphere, heave decay from 1 m", directory=folder)
    scene.hydro(database="hydro.h5")
    scene.body(
        "sphere",
        hydro="sphere",
        motion="heave",
        mass=261.8e3,
        center_of_gravity=[0.0, 0.0, -2.0],
        initial={"displacement": [0.0, 0.0, 1.0]},
    )
    scene.solver(end_time=40.0)
    scene.output(step=0.02)
    assert tomllib.loads(scene.to_toml()) == tomllib.loads((folder / "decay.toml").read_text())
    assert scene.case().body_names == ["sphere"]
    with wrong("hydro.database"):  # there is no database in that folder
        scene.save(tmp_path / "case.toml")


def test_run_and_check_take_a_scene(tmp_path: Path) -> None:
    scene = pendulum()
    built = hydrodae.run(scene, tmp_path / "a.h5")
    case = scene.save(tmp_path / "case.toml")
    read = hydrodae.run(tmp_path / "case.toml", tmp_path / "b.h5")
    np.testing.assert_array_equal(built["joints/hinge/angle"], read["joints/hinge/angle"])
    assert hydrodae.check(scene) == hydrodae.check(case)
    assert hydrodae.run(scene, set={"solver.end_time": 0.2}).end_time == pytest.approx(0.2)


def test_every_table_and_every_type_is_a_method_with_its_keys() -> None:
    scene = hydrodae.Scene()
    for table in tables():
        member = getattr(scene, table.name)
        for kind in table.types or (table,):
            method = getattr(member, kind.name) if table.types else member
            names = set(inspect.signature(method).parameters)
            assert names == set(kind.key_names) - ({"type"} if table.types else set())
            assert kind.doc.split()[0] in (inspect.getdoc(method) or "")


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (
            lambda s: s.body("buoy", mass=-1.0, center_of_gravity=[0, 0, 0]),
            "scene.body(\"buoy\"): key 'mass': must be >= 0 kg, got -1",
        ),
        (
            lambda s: s.body("buoy", mas=1.0, center_of_gravity=[0, 0, 0]),
            "scene.body(\"buoy\"): unknown key 'mas'; did you mean 'mass'? (valid: name, ",
        ),
        (
            lambda s: s.body("buoy", center_of_gravity=[0, 0, 0]),
            "scene.body(\"buoy\"): missing key 'mass' (Mass, or that of the water displaced in the "
            "reference pose (equilibrium) [kg])",
        ),
        (
            lambda s: s.body("buoy", mass=1, center_of_gravity=[0, 0, 0], initial={"velo": 1}),
            "scene.body(\"buoy\"): unknown key 'velo' in initial; ",
        ),
        (
            lambda s: s.body("buoy", mass=1, center_of_gravity=object()),
            'scene.body("buoy"): center_of_gravity: a object cannot stand in a case file',
        ),
        (
            lambda s: s.joint.revolute("h", body_a="a", body_b="b", point=[0, 0, 0], length=1.0),
            "scene.joint.revolute(\"h\"): unknown key 'length'; valid: name, body_a, body_b, point",
        ),
        (
            lambda s: s.joint.revolute("h", body_a="a", body_b="b", point=[0, 0, 0]),
            "scene.joint.revolute(\"h\"): missing key 'axis' (",
        ),
        (
            lambda s: s.wave.jonswap("w", significant_height=2.0, peak_period=8.0, gamma=0.5),
            "scene.wave.jonswap(\"w\"): key 'gamma': must be >= 1 and <= 20, got 0.5",
        ),
        (
            lambda s: s.solver(end_time=1.0, method="radua"),
            "scene.solver(): key 'method': unknown value 'radua'; did you mean 'radau'?",
        ),
    ],
)
def test_a_wrong_call_is_refused_at_once(
    call: Callable[[hydrodae.Scene], object], message: str
) -> None:
    scene = hydrodae.Scene()
    with pytest.raises(CaseError) as told:
        call(scene)
    assert str(told.value).startswith(message)
    assert message.startswith(f"{told.value.file}: ")
    assert told.value.key
    assert "title" in scene.to_toml()
    assert "[" not in scene.to_toml()  # what was refused is not in the scene


def test_a_scene_may_call_a_single_table_once() -> None:
    scene = pendulum()
    with pytest.raises(CaseError, match=r"scene.solver\(\): called before; a case has one \[solv"):
        scene.solver(end_time=2.0)


def test_what_the_whole_scene_gets_wrong_names_the_call() -> None:
    scene = pendulum()
    scene.force.pto_linear("brake", joint="hing", damping=1.0)
    message = r'^scene.force.pto_linear\("brake"\): joint = \'hing\' is no joint; did you mean'
    for check in (scene.case, lambda: hydrodae.run(scene), lambda: hydrodae.check(scene)):
        with pytest.raises(CaseError, match=message) as told:
            check()
        assert told.value.key == "force.brake.joint"
        assert (told.value.file, told.value.line) == ('scene.force.pto_linear("brake")', 0)


def test_what_only_the_assembly_finds_names_the_call_too() -> None:
    scene = pendulum()
    scene.body("rod", mass=1.0, center_of_gravity=[0, 0, -3], inertia=[0.1, 0.1, 0.1])
    scene.joint.revolute("pin", body_a="arm", body_b="rod", point=[0, 0, -2], axis=[0, 1, 0])
    scene.joint.distance(
        "stay", body_a="ground", body_b="rod", point=[0, 0, 0], point_b=[0, 0, -4], length=40.0
    )
    with pytest.raises(CaseError, match=r"^scene\.[a-z.]+\(\"\w+\"\): "):
        hydrodae.check(scene)


def test_what_is_missing_names_the_scene() -> None:
    scene = hydrodae.Scene()
    scene.solver(end_time=1.0)
    with wrong("body") as body:
        scene.case()
    with wrong("solver.rtl") as rtol:
        pendulum().case({"solver.rtl": 1})
    with wrong("solver") as solver:
        hydrodae.Scene().case()
    assert [e.value.file for e in (body, rtol, solver)] == ["scene", "--set solver.rtl", "scene"]


def test_unknown_methods_and_types_are_told_with_the_nearest() -> None:
    scene = hydrodae.Scene()
    with pytest.raises(AttributeError, match="a scene has no 'boddy'; did you mean 'body'"):
        scene.boddy  # type: ignore[attr-defined]  # noqa: B018
    with pytest.raises(AttributeError, match=r"did you mean scene\.joint\.revolute\?"):
        scene.revolute  # type: ignore[attr-defined]  # noqa: B018
    with pytest.raises(AttributeError, match=r"scene.force has no type 'pto_liner'; did you mean"):
        scene.force.pto_liner  # type: ignore[attr-defined]  # noqa: B018
    with pytest.raises(TypeError, match="takes the name first"):
        scene.body("a", "b")  # type: ignore[arg-type, call-arg]
    with pytest.raises(TypeError, match="says the type itself"):
        scene.joint.fixed("a", body_a="b", body_b="c", point=[0, 0, 0], type="screw")  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="by their names only"):
        scene.solver(1.0)  # type: ignore[call-arg]
