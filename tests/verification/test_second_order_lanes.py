"""Runs side by side with loads of pairs of waves end where runs by themselves end."""

from __future__ import annotations

import pytest
from tests.verification.test_second_order_loads import made_sums, made_up, write
from tests.verification.test_slow_spectrum import case

import hydrodae
from hydrodae import _core

SEA = """type = "jonswap"
significant_height = 2.0
peak_period = 6.5
components = 40
frequency_range = [0.6, 1.4]"""


@pytest.mark.parametrize("loads", [["newman"], ["difference", "sum"]])
@pytest.mark.parametrize("phase", ["fixed", "moving"])
def test_side_by_side(tmp_path, loads, phase):
    """Eight seeds; the surge at the end of the run."""
    write(tmp_path, made_up(), made_sums())
    values = {
        "second_order.loads": loads,
        "sea.phase": phase,
        "solver.end_time": 60.0,
        "solver.accuracy": "none",
        "solver.rtol": 1e-9,
        "output.step": 1.0,
    }
    alone = case(tmp_path, "newman", SEA).with_values(values)
    cases = [alone.with_values({"wave.sea.seed": seed}) for seed in range(1, 9)]
    wanted = [([("bodies/body/position", "x", 1.0, 1)], 0.0, False, -1.0)]
    answers = _core.simulate_together([each.scene for each in cases], wanted)
    apart, slow = [], []
    for answer, each in zip(answers, cases, strict=True):
        assert not isinstance(answer, str), answer
        x, other = (
            hydrodae.run(each, set={"second_order.loads": words})["bodies/body/position"].values
            for words in (loads, ["mean"])
        )
        size = abs(x[:, 0]).max()
        apart.append(abs(answer["measured"][0]["last"] - x[-1, 0]) / size)
        slow.append(abs(other[-1, 0] - x[-1, 0]) / size)
    assert max(apart) < 1e-6
    assert max(slow) > 0.05
