"""Controllers designed from the linear model of a case, and one that is another program.

Impedance matching, prediction by the model; `tcp` is the other end of a controller over TCP/IP, and
needs nothing of the rest.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hydrodae.control.design import Matching, match
    from hydrodae.control.forecast import AutoregressiveForecast, KnownSea
    from hydrodae.control.plant import Plant
    from hydrodae.control.predictive import ModelPredictive

__all__ = ["AutoregressiveForecast", "KnownSea", "Matching", "ModelPredictive", "Plant", "match"]

#: Where each name is; it is imported when it is first asked for.
_LATER = {
    "AutoregressiveForecast": "forecast",
    "KnownSea": "forecast",
    "Matching": "design",
    "ModelPredictive": "predictive",
    "Plant": "plant",
    "match": "design",
}

if not TYPE_CHECKING:

    def __getattr__(name: str) -> Any:
        if name in _LATER:
            return getattr(import_module(f"hydrodae.control.{_LATER[name]}"), name)
        raise AttributeError(f"module 'hydrodae.control' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
