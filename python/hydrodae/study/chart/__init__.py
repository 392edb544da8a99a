"""Speed against accuracy of one case: every method over a ladder of tolerances or steps.

From Python::

    from hydrodae.study.chart.measure import chart, recommend

    made = hydrodae.chart("cases/benchmarks/simple_pendulum.toml")
    made.front()  # the runs that no other beats in both error and time
    made.best(1e-5)  # the cheapest run whose error is at most 1e-5
"""

from __future__ import annotations

from hydrodae.study.chart.measure import chart, recommend
from hydrodae.study.chart.records import Chart, Recommendation, Run, pareto

__all__ = ["Chart", "Recommendation", "Run", "chart", "pareto", "recommend"]
