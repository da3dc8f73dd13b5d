"""Effects whose strengths belong to single pads: on a rig without a pad at each of four corners, one for each pad."""

from collections.abc import Sequence
from dataclasses import replace

from slipwise.effects._effect import Effect
from slipwise.params import Parameter


def for_pads(effect: Effect, pads: Sequence[str], *, corners: bool) -> Effect:
    """Return an effect with the strengths that this rig's pads can have; itself where none belongs to single pads.

    Args:
        effect: of the catalogue or a user's own.
        pads: names of the rig's pads.
        corners: whether they are four, one at each corner: an effect's strengths by corner or side then say all.

    Returns:
        Without the parameters of single pads, or with one for each pad, "level[B]", in place of the other strengths.
    """
    single = [p for p in effect.parameters if p.by_pad]
    if not single:
        return effect
    others = [p for p in effect.parameters if not p.by_pad]
    if corners:
        return replace(effect, parameters=tuple(others), original=effect)
    size = next(p.typical for p in others if p.neutral is not None and p.typical != p.neutral)
    own = [_of_pad(p, pad, size) for p in single for pad in (pads if p.by_pad == "each" else pads[1:])]
    return replace(effect, parameters=(*own, *(p for p in others if p.neutral is None)), original=effect)


def _of_pad(parameter: Parameter, pad: str, size: float) -> Parameter:
    return replace(parameter.of_pad(pad), typical=size)
