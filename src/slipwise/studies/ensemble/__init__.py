"""Ensembles: many motions, many scales, and numbers that are known only within ranges."""

from slipwise.studies.ensemble.distributions import SAMPLINGS, Varied, read_varied
from slipwise.studies.ensemble.member import Base, FileBase, Shaken, run_shaken
from slipwise.studies.ensemble.responses import RESPONSES, Limit, Response
from slipwise.studies.ensemble.run import Ensemble, run_scaled
from slipwise.studies.ensemble.scales import read_scales
from slipwise.studies.ensemble.tables import QUANTILES, Exceedance, Quantiles

__all__ = [
    "QUANTILES",
    "RESPONSES",
    "SAMPLINGS",
    "Base",
    "Ensemble",
    "Exceedance",
    "FileBase",
    "Limit",
    "Quantiles",
    "Response",
    "Shaken",
    "Varied",
    "read_scales",
    "read_varied",
    "run_scaled",
    "run_shaken",
]
