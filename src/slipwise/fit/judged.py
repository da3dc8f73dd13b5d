"""Which samples each relation is judged by: sliding pads, pads on the ground, gauges that tell the truth."""

from collections.abc import Mapping
from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import NDArray

from slipwise.channels import VELOCITY_CHANNELS

Mask = NDArray[np.bool_]
#: Channels that the balances are made of, slip by all that it is fused from; pads and friction across take their own
#: pad's besides the velocity's.
_USES: dict[str, tuple[str, ...]] = {
    "girder": ("pad_?_Fx", *VELOCITY_CHANNELS),
    "heave": ("pad_?_N", "girder_az"),
    "pitch": ("pad_?_N", "pad_?_Fx", *VELOCITY_CHANNELS),
    "roll": ("pad_?_N",),
    "warp": ("pad_?_N",),
    "motion": VELOCITY_CHANNELS,
}


def judged(
    grounded: Mask, sliding: Mask, fast: Mask, pads: tuple[str, ...], spoiled: Mapping[str, Mask]
) -> dict[str, Mask]:
    """Give the samples by which each relation is judged: (n,), or (n, p) for pads and friction across.

    Args:
        grounded: (n,) every pad carries load.
        sliding: (n,) the law says the force of a pad.
        fast: (n,) the direction of sliding is known.
        pads: those measured.
        spoiled: channel -> samples (n,) at which its gauge does not tell the truth.
    """

    def truthful(*names: str) -> Mask:
        bad = [mask for channel, mask in spoiled.items() if any(fnmatchcase(channel, n) for n in names)]
        return ~np.any(bad, axis=0) if bad else np.ones(len(grounded), dtype=bool)

    out = {name: grounded & truthful(*names) for name, names in _USES.items()}
    moving = sliding & truthful(*VELOCITY_CHANNELS)
    for name, axis, kept in (("pads", "x", moving), ("across", "y", moving & fast)):
        out[name] = np.stack([kept & truthful(f"pad_{p}_N", f"pad_{p}_F{axis}") for p in pads], axis=1)
    return out
