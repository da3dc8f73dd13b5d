"""Gauges wired the wrong way round, found before anything else: with one of them no balance means anything.

No law of friction and no fit: every gauge is held against the others that must move with it.

    along x, y    slip'' = girder - table, all three signs tried; below 12 Hz
    friction      F has the sign of the slip's rate while a pad slides fast; of a slider, its work on the way is lost
    vertical      sum N and both vertical accelerations move together, for the pads are stiff
    load          N presses

On 32 planted signs this and a search through the balances of forces and moments were both right in all; this takes
0.08 s, the balances 3.3 s.
"""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from itertools import product

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign
from slipwise.channels import pads_in
from slipwise.record import Record
from slipwise.signals.ends import in_frequency
from slipwise.signals.filters import LowPass, lowpass
from slipwise.signals.noise import white_level

#: A mean agreement below this, of +1 for a right sign and -1 for a wrong one, says that a sign is wrong.
_AGAINST = -0.3
#: The motion that is compared is slower than this [Hz]: rigid, and above the noise of a differentiated slip.
_SLOW = 12.0
#: A record of fewer periods of that shows no motion by which a sign could be told.
_PERIODS = 4.0
#: A pad slides fast above this part of the largest rate [1].
_FAST = 0.2
#: Accelerations that leave more than this part of the slip's own say nothing of signs [1].
_UNTIED = 0.5
#: An acceleration that is in the slip by less than this part of the other one has no sign there [1].
_NOT_THERE = 0.3
#: A vertical motion must stand above its noise by this factor to say anything.
_STRONG = 3.0


def find_wrong_signs(campaign: Campaign, tared: Collection[str] = ()) -> list[str]:
    """Return the channels that are wired the wrong way round.

    Of a slider loads have their own sign; a force that drives the slip is no friction, and is taken for turned.

    Args:
        campaign: as recorded.
        tared: load cells that were set to zero under the girder: they neither press nor pull, and have no sign to see.
    """
    if not campaign.specimen.free:
        seen = {name: [_presses(run.record, name) for run in campaign.runs] for name in _loads(campaign)}
        return _against({**seen, **_dissipated(campaign)})
    along: dict[str, list[float]] = {}
    for run in campaign.runs:
        for name, value in _accelerations(run.record):
            along.setdefault(name, []).append(value)
    found = _against(along)
    rest: dict[str, list[float]] = {}
    for run in campaign.runs:
        for name, value in _forces(run.record, found, campaign.specimen.pads):
            rest.setdefault(name, []).append(value)
    return [*found, *(name for name in _against(rest) if name not in tared)]


def reverse_signs(record: Record, turned: Iterable[str]) -> Record:
    """Return a record with these channels turned back."""
    return record.replaced(**{name: -record[name] for name in turned if name in record})


def _loads(campaign: Campaign) -> list[str]:
    every = set.intersection(*(set(run.record.channels) for run in campaign.runs))
    return [name for name in (f"pad_{pad}_N" for pad in campaign.specimen.pads) if name in every]


def _dissipated(campaign: Campaign) -> dict[str, list[float]]:
    """Return for a slider's forces the share of the work to and fro that is lost [1]: negative, it would drive."""
    out: dict[str, list[float]] = {}
    for run in campaign.runs:
        for pad, axis in product(campaign.specimen.pads, "xy"):
            slip, force = f"slip_{axis}", f"pad_{pad}_F{axis}"
            if run.record.has_all(slip, force):
                way = np.gradient(_smooth(run.record)(run.record[slip] - run.record[slip][0]))
                work = run.record[force] * way
                out.setdefault(force, []).append(float(np.sum(work) / max(np.sum(np.abs(work)), 1e-300)))
    return out


def _presses(record: Record, name: str) -> float:
    """Return 1 for a load that presses throughout, -1 for one that pulls."""
    return float(np.mean(record[name]) / max(np.mean(np.abs(record[name])), 1e-300))


def _against(agreements: Mapping[str, Iterable[float]]) -> list[str]:
    return [name for name, values in agreements.items() if float(np.mean(list(values))) < _AGAINST]


def _smooth(record: Record) -> Callable[[Array], Array]:
    by = LowPass(min(_SLOW, 0.1 / record.dt), 4, "aligned")
    return lambda values: lowpass(values, record.dt, by)


def _accelerations(record: Record) -> Iterable[tuple[str, float]]:
    """Yield slip and horizontal accelerations with +1, or -1 for the one whose turning makes them agree."""
    if len(record) * record.dt < _PERIODS / _SLOW:
        return
    smooth = _smooth(record)
    for axis in "xy":
        names = [f"slip_{axis}", f"girder_a{axis}", f"table_a{axis}"]
        if not record.has_all(*names):
            continue
        girder, table = (smooth(record[name]) for name in names[1:])
        slip = smooth(record[names[0]] - record[names[0]][0])
        bend = in_frequency(slip, record.dt, lambda f: -((2.0 * np.pi * f) ** 2), 256)
        both = np.stack([girder, -table], axis=1)
        own, other = np.linalg.lstsq(both, bend, rcond=None)[0]
        if float(np.sum((bend - both @ [own, other]) ** 2)) > _UNTIED * float(np.sum(bend**2)):
            continue  # the girder hardly slides
        if min(abs(own), abs(other)) < _NOT_THERE * max(abs(own), abs(other)):
            continue  # a displacement in space or of something else, in which one of the two is not
        wrong = {(False, False): names[0], (False, True): names[1], (True, False): names[2]}.get((own > 0, other > 0))
        yield from ((name, -1.0 if name == wrong else 1.0) for name in names)


def _forces(record: Record, turned: Iterable[str], pads: Sequence[str]) -> Iterable[tuple[str, float]]:
    """Yield pads' forces, loads and vertical accelerations with their agreement, from -1 to 1."""
    smooth = _smooth(record)
    for axis in "xy":
        slip = f"slip_{axis}"
        if slip not in record:
            continue
        rate = np.gradient(smooth(record[slip] - record[slip][0]), record.dt) * (-1.0 if slip in turned else 1.0)
        moving = np.abs(rate) > _FAST * float(np.max(np.abs(rate)))
        for name in (f"pad_{pad}_F{axis}" for pad in pads_in(record.channels)):
            if name in record and moving.any():
                yield name, float(np.mean(np.sign(record[name][moving]) * np.sign(rate[moving])))
    loads = [f"pad_{pad}_N" for pad in pads]
    if not record.has_all(*loads):
        return
    presses = {name: _presses(record, name) for name in loads}
    yield from presses.items()
    # A cell that was tared under the girder neither presses nor pulls.
    total = smooth(np.sum([record[n] * (-1.0 if presses[n] < _AGAINST else 1.0) for n in loads], axis=0))
    for name in (n for n in record.channels if n.startswith(("girder_az", "table_az"))):
        vertical = smooth(record[name])
        noise = white_level(record[name]) * np.sqrt(2.0 * _SLOW * record.dt)
        if float(np.std(vertical)) > _STRONG * noise:
            yield name, float(np.corrcoef(total, vertical)[0, 1])
