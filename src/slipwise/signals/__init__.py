"""Signals on a uniform time axis: filter, shift, differentiate, fuse, and measure their noise."""

from slipwise.signals.derivative import derivative, integral
from slipwise.signals.filters import LowPass, align, folded, lowpass, response
from slipwise.signals.fused import Fused, fuse
from slipwise.signals.noise import Noise, noise, white_level
from slipwise.signals.resample import UniformTime, resampled, uniform_time
from slipwise.signals.shift import shift

__all__ = [
    "Fused",
    "LowPass",
    "Noise",
    "UniformTime",
    "align",
    "derivative",
    "folded",
    "fuse",
    "integral",
    "lowpass",
    "noise",
    "resampled",
    "response",
    "shift",
    "uniform_time",
    "white_level",
]
