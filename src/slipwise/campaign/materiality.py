"""What matters to the user of a model: how much an effect must change before it is named."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Materiality:
    """Least changes that matter, when an effect is left out; [materiality] in campaign.toml sets others.

    The defaults are what laboratories of this kind hold their own repeatability to.

    Attributes:
        channel: of any measured channel, rms of the change over the channel's rms about its mean [1].
        response: of the largest slip, the dissipated energy or the largest pad load of the held-out motion [1].
        gauge: of the channel that a gauge's fault changes, like `channel` [1].
    """

    channel: float = 0.02
    response: float = 0.02
    gauge: float = 0.01
