"""Controllers designed from the linear model of a case: impedance matching, model prediction."""

from hydrodae.control.design import Matching, match
from hydrodae.control.forecast import AutoregressiveForecast, KnownSea
from hydrodae.control.plant import Plant
from hydrodae.control.predictive import ModelPredictive

__all__ = [
    "AutoregressiveForecast",
    "KnownSea",
    "Matching",
    "ModelPredictive",
    "Plant",
    "match",
]
