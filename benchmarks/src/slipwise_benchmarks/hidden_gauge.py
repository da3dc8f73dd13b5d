"""Faults of gauges: which channels, how large, which variant; forces go with the load of a pad.

table_gain and table_cross_axis are here too. The rig records the table's MEASURED motion, against which neither can
be seen; made on request only, they mean that table_ax or table_az holds the command instead.
"""

import numpy as np

from slipwise_benchmarks.faults import Fault, groups
from slipwise_benchmarks.settings import Settings, pad_names

_PER_KIND = {"slip": 4.0e-4, "girder": 0.12, "force": 120.0, "load": 350.0, "table": 0.12}


def _pick(rng: np.random.Generator, *groups: str) -> str:
    return str(rng.choice(groups))


def _sign(rng: np.random.Generator) -> float:
    return float(rng.choice([-1.0, 1.0]))


def _channels(base: Settings, group: str) -> tuple[str, ...]:
    return groups(pad_names(base))[group]


def _one(what: str, rng: np.random.Generator, base: Settings) -> str:
    pads = pad_names(base)
    return f"{what} {pads[rng.integers(len(pads))]}"


def _one_force(rng: np.random.Generator, base: Settings) -> str:
    return _one("force", rng, base)


def _one_load(rng: np.random.Generator, base: Settings) -> str:
    return _one("load", rng, base)


def _per_kind(base: Settings, group: str) -> float:
    kind = group.split()[0]
    return _PER_KIND[kind] * (base.pad_size if kind in ("force", "load") else 1.0)


def channel_delay(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """A channel or a card that is 1 to 6 ms late."""
    group = _pick(rng, "slip", "girder", "forces", "loads", _one_force(rng, base), _one_load(rng, base))
    return Fault("channel_delay", _channels(base, group), 2.5e-3 * scale)


def channel_gain(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """A gauge that reads 1.5 to 10 % too much or too little."""
    group = _pick(rng, "slip", "girder", "forces", "loads", _one_force(rng, base), _one_load(rng, base))
    return Fault("channel_gain", _channels(base, group), _sign(rng) * 0.04 * scale)


def channel_sign(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """A gauge wired the wrong way round."""
    return Fault(
        "channel_sign", _channels(base, _pick(rng, "slip", "girder", "girder up", _one_force(rng, base))), -1.0
    )


def channel_offset(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """A gauge whose zero is off."""
    group = _pick(rng, "slip", "girder", _one_force(rng, base), _one_load(rng, base))
    return Fault("channel_offset", _channels(base, group), _sign(rng) * _per_kind(base, group) * scale)


def channel_drift(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """A gauge that walks away during the run."""
    group = _pick(rng, "slip", "girder", _one_force(rng, base), _one_load(rng, base))
    size = _sign(rng) * 0.25 * _per_kind(base, group) * scale
    return Fault("channel_drift", _channels(base, group), size, _pick(rng, "linear", "warming up"))


def channel_filter(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """A channel or a card with a slower filter than the others: 15 to 80 Hz."""
    group = _pick(rng, "forces", "loads", "girder", "slip", _one_force(rng, base))
    return Fault("channel_filter", _channels(base, group), 32.0 / scale, _pick(rng, "first order", "second order"))


def channel_clipping(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """A gauge that meets its rail at 35 to 90 % of the largest excursion."""
    group = _pick(rng, "girder", _one_force(rng, base), _one_load(rng, base))
    return Fault("channel_clipping", _channels(base, group), float(np.clip(1.0 - 0.3 * scale, 0.35, 0.92)))


def dropped_samples(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """0.5 to 6 % of a channel's samples repeat the last value; or are lost, and the rest moves up."""
    group = _pick(rng, "slip", "girder", "forces", _one_force(rng, base), _one_load(rng, base))
    form, share = ("held", 0.02) if rng.random() < 0.7 else ("lost", 0.0025)
    return Fault("dropped_samples", _channels(base, group), share * scale, form, seed=int(rng.integers(2**31)))


def clock_skew(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """A card whose clock runs 100 to 1000 ppm fast or slow."""
    return Fault(
        "clock_skew", _channels(base, _pick(rng, "slip", "forces", "loads", "girder")), _sign(rng) * 4.0e-4 * scale
    )


def load_crosstalk(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """Cells whose friction channel feels 0.3 to 2 % of the load, or the other way round."""
    group = _pick(rng, "forces", "forces", _one_force(rng, base), "loads")
    size = _sign(rng) * (0.008 if "force" in group else 0.08) * scale
    form = "zeroed at rest" if rng.random() < 0.3 else "not zeroed"
    return Fault("load_crosstalk", _channels(base, group), size, form)


def cell_inertia(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """10 to 80 kg of plate between pad and cell, on all pads."""
    return Fault(
        "cell_inertia",
        _channels(base, "forces") + _channels(base, "loads"),
        30.0 * scale * base.pad_size,
        _pick(rng, "subtracted", "added"),
    )


def table_gain(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """The recorded table_ax is the command, of which the table did 2 to 10 % more or less."""
    return Fault("table_gain", _channels(base, "table"), _sign(rng) * 0.04 * scale)


def table_cross_axis(rng: np.random.Generator, scale: float, base: Settings) -> Fault:
    """The recorded table_az is the command; the table also moves up with a share of table_ax."""
    return Fault("table_cross_axis", _channels(base, "table up"), _sign(rng) * 0.04 * scale)


GAUGE_EFFECTS = {
    "channel_delay": channel_delay,
    "channel_gain": channel_gain,
    "channel_sign": channel_sign,
    "channel_offset": channel_offset,
    "channel_drift": channel_drift,
    "channel_filter": channel_filter,
    "channel_clipping": channel_clipping,
    "dropped_samples": dropped_samples,
    "clock_skew": clock_skew,
    "load_crosstalk": load_crosstalk,
    "cell_inertia": cell_inertia,
    "table_gain": table_gain,
    "table_cross_axis": table_cross_axis,
}
#: Seen only where a table channel holds the command.
ON_REQUEST = ("table_gain", "table_cross_axis")
