"""What messages about wrong words suggest leads to a case that can be read."""

from __future__ import annotations

import re

import pytest

from hydrodae import _core
from hydrodae.errors import CaseError

WAVE = """
[solver]
end_time = 1.0
[environment]
water_density = 1000.0
water_depth = 50.0
[[body]]
name = "buoy"
motion = "fixed"
mass = 1.0
center_of_gravity = [0, 0, 0]
[[morison]]
name = "ball"
body = "buoy"
point = [0, 0, -1]
volume = 1.0
added_mass_coefficient = 0.5
[[wave]]
name = "sea"
type = "TYPE"
significant_height = 1.0
"""
PEAK = "peak_period = 6.0\n"


def refusal(text: str) -> str:
    with pytest.raises(CaseError) as caught:
        _core.parse_case(text, ".", {})
    return str(caught.value)


def suggested(message: str) -> str:
    found = re.search(r"did you mean '(\w+)'\?", message)
    assert found is not None, message
    return found[1]


@pytest.mark.parametrize(
    ("word", "name"),
    [("irregular", "jonswap"), ("Irregular", "jonswap"), ("JS", "jonswap"), ("jonswp", "jonswap")],
)
def test_words_of_other_codes_for_waves(word: str, name: str) -> None:
    text = WAVE + PEAK
    assert suggested(refusal(text.replace("TYPE", word))) == name
    _core.parse_case(text.replace("TYPE", name), ".", {})


@pytest.mark.parametrize(
    ("word", "name"), [("hinge", "revolute"), ("translational", "prismatic"), ("ball", "spherical")]
)
def test_words_of_other_codes_for_joints(word: str, name: str) -> None:
    joint = '[[joint]]\nname = "j"\ntype = "TYPE"\nbody_a = "ground"\nbody_b = "b"\n'
    with pytest.raises(CaseError) as caught:
        _core.check_tables(joint.replace("TYPE", word))
    assert suggested(str(caught.value)) == name


def test_a_key_of_other_types_names_those_that_take_all_keys() -> None:
    """Each of them can be read."""
    text = WAVE.replace("TYPE", "pierson_moskowitz") + PEAK
    found = re.search(r"types with all the keys given: ([\w, ]+);", refusal(text))
    assert found is not None
    types = found[1].split(", ")
    assert {"bretschneider", "jonswap"} <= set(types)
    for name in ("bretschneider", "jonswap"):
        _core.parse_case(text.replace("pierson_moskowitz", name), ".", {})


def test_a_key_that_is_given_already_is_not_suggested() -> None:
    text = WAVE.replace("TYPE", "jonswap") + PEAK
    assert "did you mean" not in refusal(text + "peak_perio = 7.0\n")
    assert suggested(refusal(text.replace("peak_period", "peak_perio"))) == "peak_period"
