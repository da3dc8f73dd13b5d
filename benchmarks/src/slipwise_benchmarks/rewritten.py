"""Campaigns written down in another way: the physics stays as it was, so a verdict must too.

Each function takes a campaign as `slipwise.campaign.load_campaign` gives it, and gives one of the same tests.
`REWRITINGS` lists them, with the campaigns to which each applies.
"""

import re
import tempfile
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign, Logger, Run, load_campaign
from slipwise.campaign.wild_samples import WildSamples
from slipwise.channels import channel, part_of
from slipwise.record import Record
from slipwise.rig import load_specimen
from slipwise.rig.known import SPECIMEN_UNITS, known_better
from slipwise.rig.similarity import similarity
from slipwise.signals.filters import LowPass
from slipwise.units import affine, powers_of

#: Channels that change their sign when x points the other way: along x, and rotations about y and z.
_ALONG_X = re.compile(r"(.*_[adv]x|slip_x|.*_Fx|yaw|pitch|table_pitch)(_raw)?")
_EDGES = {"girder_az_1": "girder_az_2", "girder_az_2": "girder_az_1"}
#: A filter at no more than this share of the half rate leaves little above it [1].
_IN_BAND = 0.8
#: Rest after which a specimen has cooled, so that only wear knows the order of the runs [s].
_COLD = 600.0
#: Larger lengths of the similar test [1]; its times are 1.5 times as long.
LENGTH = 2.25
#: What is added to the slip, over its stroke [1]; noise of a copied run, over the range of each channel [1].
_SHIFT, _HAIR = 0.02, 1e-6
#: SI unit -> unit in which it is written.
_OTHER_UNITS = {
    "s": "ms", "m": "cm", "m/s": "mm/s", "m/s^2": "g", "N": "MN", "Pa": "MPa", "rad": "deg", "K": "degC", "kg": "t",
}  # fmt: skip
#: SI unit of what a specimen, its pads, its buffers and its storeys have; what is not here is a pure number or similar.
_UNITS = {
    **dict.fromkeys(("x", "y", "z", "radius", "gap", "centre_height", "centre_x", "centre_y", "edge_distance"), "m"),
    **dict.fromkeys(("stiffness", "stiffness_x", "stiffness_y"), "N/m"),
    **dict.fromkeys(("damping", "damping_x", "damping_y"), "N*s/m"),
    **dict.fromkeys(("mass", "bending_mass"), "kg"),
    "curvature": "1/m",
    "inertia": "kg*m^2",
    "bending_frequency": "Hz",
}

Change = Callable[[str, Array], tuple[str, Array]]


@dataclass(frozen=True)
class Rewriting:
    """One way to write a campaign down again.

    Attributes:
        name: what is done, in words.
        of: the campaign, rewritten.
        applies: whether a campaign can be rewritten so without a change of the physics.
        adds: effects that a verdict may name beside those of the campaign as it is: what was done, where it shows.
    """

    name: str
    of: Callable[[Campaign], Campaign]
    applies: Callable[[Campaign], bool] = lambda campaign: True
    adds: frozenset[str] = frozenset()

    def is_same(self, kind: str, effects: Iterable[str], before: str, known: Iterable[str]) -> bool:
        """Tell whether a verdict is that of the campaign as it is, but for what was done.

        Args:
            kind: of the verdict.
            effects: that it names.
            before: kind of the verdict on the campaign as it is.
            known: effects that that one names.
        """
        more = set(effects) - set(known)
        return set(known) <= set(effects) and more <= self.adds and (bool(more) or kind == before)


def mirrored(campaign: Campaign) -> Campaign:
    """Let x point the other way: channels along x and rotations about y and z change sign, and so do places."""

    def flip(part: Any) -> Any:
        return replace(part, x=-part.x)

    rig = campaign.specimen
    places, buffers = (tuple(map(flip, parts)) for parts in (rig.places, rig.buffers))
    specimen = replace(rig, places=places, buffers=buffers, centre_x=-rig.centre_x)
    known = {name: -value if name == "centre_x" else value for name, value in campaign.known.items()}
    turned = _with_channels(campaign, lambda n, v: (_EDGES.get(n, n), -v if _ALONG_X.fullmatch(n) else v))
    return replace(turned, specimen=specimen, known=known)


def renamed(campaign: Campaign) -> Campaign:
    """Call pads and buffers otherwise, and list them the other way round."""
    rig = campaign.specimen
    new = {("pad", p.name): f"P{i}" for i, p in enumerate(reversed(rig.places), 1)}
    new |= {("buffer", b.name): f"B{i}" for i, b in enumerate(reversed(rig.buffers), 1)}

    def name_of(old: str) -> str:
        part, word = part_of(old.removesuffix("_raw"))
        return old.replace(f"{part}_{word}_", f"{part}_{new[part, word]}_", 1) if (part, word) in new else old

    places = tuple(replace(p, name=new["pad", p.name]) for p in reversed(rig.places))
    buffers = tuple(replace(b, name=new["buffer", b.name]) for b in reversed(rig.buffers))
    own = {name_of(name): by for name, by in campaign.logger.own.items()}
    renamed_channels = _with_channels(campaign, lambda n, v: (name_of(n), v))
    specimen = replace(rig, places=places, buffers=buffers)
    return replace(renamed_channels, specimen=specimen, logger=replace(campaign.logger, own=own))


def at_half_the_rate(campaign: Campaign) -> Campaign:
    """Keep every second sample, as a logger of half the rate had written them."""
    every = slice(None, None, 2)

    def thinned(run: Run) -> Run:
        channels = {name: values[every] for name, values in run.record.channels.items()}
        record = Record(run.record.time[every], channels, run.record.provenance)
        wild = tuple(
            WildSamples(w.channel, w.bad[every], w.times[w_kept], w.values[w_kept])
            for w in run.wild
            for w_kept in [np.flatnonzero(w.bad)[: len(w.times)] % 2 == 0]
        )
        return replace(run, record=record, wild=wild)

    return replace(campaign, runs=tuple(map(thinned, campaign.runs)))


def _in_band(campaign: Campaign) -> bool:
    """Tell whether every filter of a logger that is known lies below the half rate of every second sample."""
    logger, step = campaign.logger, max(run.record.dt for run in campaign.runs)
    filters = [by for by in (logger.every, *logger.own.values()) if by is not None]
    return logger.known and all(by.frequency <= _IN_BAND / (4.0 * step) for by in filters)


def every_run_twice(campaign: Campaign) -> Campaign:
    """Give every run twice, the copy of a fitted one as a repeat; a trace of noise, as no two measurements agree."""
    rng = np.random.default_rng(1)

    def again(run: Run) -> Run:
        channels = {n: v + _HAIR * np.ptp(v) * rng.standard_normal(len(v)) for n, v in run.record.channels.items()}
        record = Record(run.record.time, channels, run.record.provenance)
        role = "repeat" if run.role == "fit" else run.role
        name = f"{run.name}_copy"
        return replace(run, name=name, role=role, record=record, file=f"{name}.csv", sha256=run.sha256[::-1])

    return replace(campaign, runs=tuple(one for run in campaign.runs for one in (run, again(run))))


def in_another_order(campaign: Campaign) -> Campaign:
    """List the fitted runs the other way round."""
    fitted = [run for run in campaign.runs if run.role == "fit"]
    return replace(campaign, runs=tuple(fitted.pop() if run.role == "fit" else run for run in campaign.runs))


def _order_is_free(campaign: Campaign) -> bool:
    """Tell whether the specimen rested long before every run, and there is an order at all."""
    rested = all(run.rest_before is not None and run.rest_before >= _COLD for run in campaign.runs)
    return rested and len(campaign.with_role("fit")) > 1


def similar(campaign: Campaign) -> Campaign:
    """Make everything larger by the similarity law of the tests: lengths L, times sqrt(L), masses and forces L^2.

    Accelerations, pressures and coefficients of friction stay.
    """
    law = similarity(LENGTH)
    scales = {
        "meter": law.length,
        "second": law.time,
        "kilogram": law.mass,
        "newton": law.force,
        "hertz": law.frequency,
    }

    def factor(unit: str) -> float:
        return float(np.prod([scales.get(name, 1.0) ** power for name, power in powers_of(unit).items()]))

    def scaled(part: Any) -> Any:
        known = {name: getattr(part, name) for name in _UNITS if hasattr(part, name) and name in vars(part)}
        changed = {
            n: tuple(factor(_UNITS[n]) * x for x in v) if isinstance(v, tuple) else factor(_UNITS[n]) * v
            for n, v in known.items()
        }
        return replace(part, **changed)

    def slower(by: LowPass | None) -> LowPass | None:
        return None if by is None else replace(by, frequency=law.frequency * by.frequency)

    rig = campaign.specimen
    parts = {name: tuple(map(scaled, getattr(rig, name))) for name in ("places", "buffers", "storeys")}
    own = {name: slower(by) for name, by in campaign.logger.own.items()}
    larger = _with_channels(campaign, lambda n, v: (n, factor(channel(n).unit) * v), law.time)
    return replace(
        larger,
        specimen=replace(scaled(rig), **parts),
        known={name: factor(SPECIMEN_UNITS[name]) * value for name, value in campaign.known.items()},
        logger=replace(campaign.logger, every=slower(campaign.logger.every), own=own),
    )


def with_another_zero_of_slip(campaign: Campaign) -> Campaign:
    """Add the same length to the slip along x in all runs, as a gauge that was clamped elsewhere reads it."""
    more = _SHIFT * max(float(np.ptp(run.record["slip_x"])) for run in campaign.runs)
    return _with_channels(campaign, lambda n, v: (n, v + more if n == "slip_x" else v))


def in_other_units(campaign: Campaign) -> Campaign:
    """Write a campaign to files in centimetres, meganewtons, tonnes, degrees, g and milliseconds, and read it back."""
    rig = campaign.specimen
    known = {**known_better(rig, load_specimen(rig.path)), **campaign.known}
    lines = [f'name = "{campaign.name}"', f'rig = "{rig.path}"', "[specimen]"]
    lines += [f"{name} = {_quantity(value, SPECIMEN_UNITS.get(name, ''))}" for name, value in known.items()]
    lines += _logger_lines(campaign.logger)
    lines += ["[materiality]", *(f"{name} = {value!r}" for name, value in vars(campaign.materiality).items())]
    with tempfile.TemporaryDirectory() as folder:
        for run in campaign.runs:
            lines += ["[[run]]", f'file = "{run.name}.csv"', f'role = "{run.role}"']
            lines += [] if run.rest_before is None else [f"rest_before = {_quantity(run.rest_before, 's')}"]
            columns = {"time": run.record.time, **run.record.channels}
            units = {name: _OTHER_UNITS.get(channel(name).unit, channel(name).unit) for name in columns}
            table = np.stack([_in_unit(v, units[n], channel(n).unit) for n, v in columns.items()], axis=1)
            header = ",".join(f"{name} [{unit}]" for name, unit in units.items())
            np.savetxt(Path(folder, f"{run.name}.csv"), table, "%.17g", ",", header=header, comments="")
        Path(folder, "campaign.toml").write_text("\n".join(lines) + "\n", encoding="utf-8")
        return load_campaign(folder)


def _quantity(value: float | str, unit: str) -> str:
    """Write a number with a unit, or a word, for campaign.toml."""
    if isinstance(value, str):
        return f'"{value}"'
    other = _OTHER_UNITS.get(unit, unit)
    return f'"{float(_in_unit(np.array(value), other, unit))!r} {other}"'


def _in_unit(values: Array, unit: str, si: str) -> Array:
    factor, offset = affine(unit, si, "a test")
    return (values - offset) / factor


def _logger_lines(logger: Logger) -> list[str]:
    """Write what is known of a logger for campaign.toml."""
    if not logger.known:
        return []
    lines = []
    for name, by in (("", logger.every), *logger.own.items()):
        lines.append(f'[logger."{name}"]' if name else "[logger]")
        lines += ['lowpass = "none"'] if by is None else [
            f'lowpass = "{by.frequency!r} Hz"', f"order = {by.order}", f'phase = "{by.phase}"'
        ]  # fmt: skip
    return lines


def _with_channels(campaign: Campaign, change: Change, time: float = 1.0) -> Campaign:
    """Give a campaign with other names or values of its channels, and times that are so much longer [1]."""

    def changed(run: Run) -> Run:
        channels = dict(change(name, values) for name, values in run.record.channels.items())
        record = Record(time * run.record.time, channels, run.record.provenance)
        wild = tuple(_changed_wild(one, change, time) for one in run.wild)
        rest = None if run.rest_before is None else time * run.rest_before
        return replace(run, record=record, rest_before=rest, wild=wild)

    return replace(campaign, runs=tuple(map(changed, campaign.runs)))


def _changed_wild(one: WildSamples, change: Change, time: float) -> WildSamples:
    name, values = change(one.channel, one.values)
    return replace(one, channel=name, times=time * one.times, values=values)


REWRITINGS: tuple[Rewriting, ...] = (
    Rewriting("x mirrored", mirrored),
    Rewriting("pads renamed and reordered", renamed),
    Rewriting("every second sample", at_half_the_rate, _in_band),
    Rewriting("every run twice", every_run_twice),
    Rewriting("fitted runs in another order", in_another_order, _order_is_free),
    Rewriting("larger by similitude", similar),
    # a buffer, a rim and a bowl have a middle, which the gauge's zero then misses
    Rewriting("another zero of the slip", with_another_zero_of_slip, adds=frozenset({"channel_offset"})),
    Rewriting("in other units", in_other_units),
)
