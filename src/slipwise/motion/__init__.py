"""Table motions: recorded ones in their agencies' formats, synthetic ones, and what can be done to them."""

from slipwise.motion.formats import FORMATS
from slipwise.motion.load import load_motion
from slipwise.motion.plausibility import warn_of_travel
from slipwise.motion.resample import resample
from slipwise.motion.response_spectrum import ResponseSpectrum, read_spectrum, response_spectrum, scale_to_spectrum
from slipwise.motion.shaping import scale, scale_time, scale_to_peak, taper, treat_baseline, trim
from slipwise.motion.synthetic import SyntheticMotion, parse_motion, synthetic_motions
from slipwise.motion.table_motion import HeaderPeak, Steady, TableMotion
from slipwise.motion.travel import (
    displacement_peak,
    table_displacement,
    table_velocity,
    velocity_peak,
    warn_beyond_stroke,
)

__all__ = [
    "FORMATS",
    "HeaderPeak",
    "ResponseSpectrum",
    "Steady",
    "SyntheticMotion",
    "TableMotion",
    "displacement_peak",
    "load_motion",
    "parse_motion",
    "read_spectrum",
    "resample",
    "response_spectrum",
    "scale",
    "scale_time",
    "scale_to_peak",
    "scale_to_spectrum",
    "synthetic_motions",
    "table_displacement",
    "table_velocity",
    "taper",
    "treat_baseline",
    "trim",
    "velocity_peak",
    "warn_beyond_stroke",
    "warn_of_travel",
]
