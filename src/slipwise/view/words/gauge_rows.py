"""The noise of every gauge as people read it: in the channel's usual unit, with what has shown it."""

from collections.abc import Mapping

from slipwise.channels import channel
from slipwise.noise.gauges import Gauge
from slipwise.units import parse_unit


def gauge_rows(gauges: Mapping[str, Gauge]) -> list[dict[str, str]]:
    """Return one row a channel: its unit, the noise of one sample, and what that rests on."""
    rows = []
    for name, gauge in gauges.items():
        known = channel(name)
        factor = parse_unit(known.shown_in, known.unit, name)
        level = f"{gauge.level / factor:.3g}" if gauge.known else "unknown"
        rows.append({"channel": name, "unit": known.shown_in, "noise": level, "from": gauge.basis})
    return rows
