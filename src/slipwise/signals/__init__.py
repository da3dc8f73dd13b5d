"""Signals on a uniform time axis: filter, shift, differentiate, fuse, and measure their noise."""
