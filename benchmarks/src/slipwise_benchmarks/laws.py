"""Laws outside the catalogue, by name: what `slipwise discover` has to find, or to leave alone.

A scale whose range is one number is a reference at which a power is stated. Sizes are those that leave about six times
the noise after a fit of the base parameters; all numbers are assumed.
"""

from slipwise_benchmarks.law import Law

_PADS = ("pad A", "pad B", "pad C", "pad D")
_SIDES = ("side x+", "side x-")

LAWS: dict[str, Law] = {
    # added to the coefficient of friction
    "speed bump": Law(("speed",), "adds to mu", "bump", 0.030, {"place": (0.11, 0.18), "scale": (0.045, 0.07)}),
    "speed resonance": Law(("speed",), "adds to mu", "lorentz", 0.035, {"place": (0.12, 0.2), "scale": (0.03, 0.05)}),
    "speed threshold": Law(("speed",), "adds to mu", "hinge", 0.25, {"place": (0.13, 0.2)}),
    "following acceleration": Law(("speed_rate",), "adds to mu", "tanh", 0.014, {"scale": (2.0, 5.0)}),
    "late load": Law(("lagged_load",), "adds to mu", "linear", 6.0e-7, {"time": (0.02, 0.06)}),
    "memory of the stroke": Law(
        ("last_stroke",), "adds to mu", "power", 0.010, {"scale": (0.02, 0.02), "exponent": (0.6, 2.2)}
    ),
    "squeeze": Law(("load_rate", "speed_rate"), "adds to mu", "linear", 2.5e-8, {"time": (0.008, 0.02)}),
    "warm film": Law(
        ("heat",), "adds to mu", "bump", 0.030, {"place": (2.5e5, 4.0e5), "scale": (1.0e5, 1.8e5), "time": (2.0, 5.0)}
    ),
    # multiplied with it
    "washboard": Law(("slip",), "multiplies mu", "sine", 0.16, {"scale": (5.0e-3, 1.3e-2), "phase": (0.0, 6.28)}),
    "grooves": Law(
        ("slip",),
        "multiplies mu",
        "sine",
        0.18,
        {"scale": (7.0e-3, 1.0e-2), "back": (1.2e-2, 1.5e-2), "phase": (0.0, 6.28)},
    ),
    "load threshold": Law(("load",), "multiplies mu", "hinge", 8.0e-5, {"place": (2.5e4, 2.8e4)}),
    "load rate": Law(("load_rate",), "multiplies mu", "tanh", 0.20, {"scale": (1.5e5, 4.0e5), "time": (0.006, 0.015)}),
    "fresh reversal": Law(("time_since_reversal",), "multiplies mu", "exp", 0.22, {"scale": (0.018, 0.05)}),
    "film that breaks": Law(
        ("distance_since_reversal",), "multiplies mu", "step", 0.15, {"place": (5e-3, 1.1e-2), "scale": (1e-3, 2.5e-3)}
    ),
    "way since reversal": Law(("distance_since_reversal",), "multiplies mu", "square", 200.0),
    "fastest of the stroke before": Law(("last_peak_speed",), "multiplies mu", "tanh", 0.25, {"scale": (0.12, 0.28)}),
    "outward": Law(("outward",), "multiplies mu", "linear", 0.09, parity="even"),
    "hot and fast": Law(("heat", "speed"), "multiplies mu", "linear", 4.0e-6, {"time": (2.0, 6.0)}),
    "inertia of the face": Law(
        ("speed_rate",), "multiplies mu", "bump", 0.2, {"place": (-3.0, 3.0), "scale": (1.5, 3.0)}
    ),
    # on a pad, or a side
    "ramp under a pad": Law(("slip",), "one pad", "linear", 15.0, where=_PADS),
    "fast pad": Law(("speed",), "one pad", "step", 0.18, {"place": (0.12, 0.2), "scale": (0.015, 0.03)}, where=_PADS),
    "fresh side": Law(("time_since_reversal",), "one pad", "exp", 0.30, {"scale": (0.02, 0.05)}, where=_SIDES),
    "loaded side": Law(
        ("load",), "one pad", "step", 0.20, {"place": (2.3e4, 2.6e4), "scale": (2e3, 4e3)}, where=_SIDES
    ),
    # on the girder, where no pad carries it
    "cubic drag": Law(
        ("speed",), "girder", "power", 5.0e3, {"scale": (0.2, 0.2), "exponent": (3.0, 4.0)}, signs=(1.0,)
    ),
    "rack": Law(
        ("slip",), "girder", "sine", 4.0e3, {"scale": (6e-3, 1.4e-2), "phase": (0.0, 6.28)}, "even", signed=False
    ),
    "guide that binds": Law(
        ("distance_since_reversal",), "girder", "bump", 8.0e3, {"place": (5e-3, 1e-2), "scale": (2e-3, 4e-3)}
    ),
    # on the buffers
    "one-sided stop": Law(
        ("slip",), "buffer", "hinge", 1.0e6, {"place": (4e-3, 7e-3)}, "even", signs=(1.0,), signed=False
    ),
    "catch": Law(
        ("slip",), "buffer", "bump", 6.0e3, {"place": (-8e-3, 8e-3), "scale": (2e-3, 4e-3)}, "even", signed=False
    ),
    "relief valve": Law(
        ("speed",), "buffer", "bump", 6.0e3, {"place": (0.09, 0.15), "scale": (0.03, 0.05)}, signs=(1.0,)
    ),
    "one-way damper": Law(("speed", "outward"), "buffer", "linear", 1.5e4, parity="even"),
    # on the load
    "lift": Law(("speed",), "load", "square", 1.0e5, parity="even", signed=False),
    "rail joint": Law(
        ("slip",), "load", "bump", 5.0e3, {"place": (-8e-3, 8e-3), "scale": (2e-3, 5e-3)}, "even", signed=False
    ),
    "suction": Law(("time_since_reversal",), "load", "exp", 5.0e3, {"scale": (0.03, 0.08)}, "even", signed=False),
    # driven by what no state tells
    "time of day": Law(("time_of_day",), "multiplies mu", "linear", 0.10, {"scale": (1.5, 4.0)}),
    "chance": Law(("random_process",), "adds to mu", "linear", 0.006, {"scale": (1.0, 3.0), "phase": (0.0, 6.28)}),
    "separate body": Law(("separate_body",), "multiplies mu", "tanh", 0.50, {"scale": (0.3, 1.0), "time": (0.8, 2.0)}),
    "swinging body": Law(("swinging_body",), "multiplies mu", "tanh", 0.12, {"scale": (0.5, 1.5), "time": (0.3, 0.6)}),
}
