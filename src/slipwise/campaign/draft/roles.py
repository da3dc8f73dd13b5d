"""Which run is fitted, which repeats another, which is held out: told from the table's motion; and which rig it was."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign.same_specimen import lever_of
from slipwise.record import Record
from slipwise.rig import load_specimen

#: Two motions are one where this little of them differs [1]; a sine holds this part of its power near one frequency.
_SAME, _SINE = 0.25, 0.6
#: A vertical motion counts where it is this part of the horizontal one.
_COUNTS = 0.05


def roles_of(records: Mapping[str, Record | None]) -> dict[str, tuple[str, str]]:
    """Return file -> role and why.

    Args:
        records: by file, in the order of the files; None where the file's channels are not known.
    """
    moved = {name: _motion(record) for name, record in records.items()}
    known = {name: motion for name, motion in moved.items() if motion is not None}
    out = {name: ("fit", "") for name in records}
    sines = {name for name, motion in known.items() if is_sine(motion[:, 0])}
    for name in sines:
        out[name] = ("fit", "a sine")
    names = [name for name in known if name not in sines]
    copies: set[str] = set()
    for k, name in enumerate(names):
        first = next((other for other in names[:k] if _same(known[other], known[name])), None)
        if first:
            out[name] = ("repeat", f"the motion of {first} again")
            copies |= {first, name}
    alone = [
        name
        for name in names
        if name not in copies and not any(_same(known[name][:, :1], known[c][:, :1]) for c in copies)
    ]
    if alone and len(names) > 1:
        strongest = max(alone, key=lambda name: float(np.abs(known[name][:, 0]).max()))
        out[strongest] = ("holdout", "the strongest other earthquake")
    elif len(records) > 1 and not any(role == "holdout" for role, _ in out.values()):
        last = next((name for name in reversed(list(records)) if out[name][0] != "repeat"), None)
        if last is not None and last != next(iter(records)):
            out[last] = ("holdout", "the last file; nothing else tells")
    return out


def rig_of(records: Sequence[Record], rigs: Sequence[str]) -> tuple[str, str]:
    """Return which of some rigs these runs are nearest to, and why.

    Args:
        records: of the runs.
        rigs: of the package, whose pads have the names of those in the records and stand alike.
    """
    first = load_specimen(rigs[0])
    loaded = [record for record in records if record.has_all(*(f"pad_{pad}_N" for pad in first.pads))]
    levers = [lever for record in loaded if (lever := lever_of(record, first)) is not None]
    if not levers:
        return rigs[0], f"pads {', '.join(first.pads)}; nothing tells which rig"
    height = float(np.median(levers))
    stiff = _restored(loaded, first.pads)
    near = [name for name in rigs if bool(sum(load_specimen(name).buffer_stiffness)) == stiff] or rigs
    name = min(near, key=lambda n: abs((load_specimen(n).slenderness or 0.0) - height))
    return (
        name,
        f"its centre of gravity stands {height:.3g} pad spacings high, {'with' if stiff else 'without'} buffers",
    )


def _restored(records: Sequence[Record], pads: Sequence[str]) -> bool:
    """Return whether a force in proportion to the slip acts beside friction: buffers."""
    for record in records:
        if record.has_all("girder_ax", "slip_x", *(f"pad_{pad}_Fx" for pad in pads)):
            mass = float(np.median(np.sum([record[f"pad_{pad}_N"] for pad in pads], axis=0))) / 9.80665
            rest = -(mass * record["girder_ax"] + np.sum([record[f"pad_{pad}_Fx"] for pad in pads], axis=0))
            return bool(np.corrcoef(rest, record["slip_x"])[0, 1] > 0.7)
    return True


def _motion(record: Record | None) -> Array | None:
    """Return the table's motion (n, 2), x and z, or the slip's where no table is recorded."""
    if record is None:
        return None
    for along, up in (("table_ax", "table_az"), ("slip_x", "")):
        if along in record:
            x = record[along] - np.median(record[along])
            z = record[up] - np.median(record[up]) if up in record else np.zeros(len(x))
            return np.stack([x, z], axis=1)
    return None


def is_sine(values: Array) -> bool:
    """Tell a sine, whose power lies near one frequency, from an earthquake."""
    power = np.abs(np.fft.rfft(values * np.hanning(len(values)))) ** 2
    power[0] = 0.0
    peak = int(np.argmax(power))
    width = max(2, round(0.1 * peak))
    return bool(power.sum() > 0.0 and power[max(0, peak - width) : peak + width + 1].sum() > _SINE * power.sum())


def _same(one: Array, other: Array) -> bool:
    """Return whether two motions (n, k) are one, each direction by itself."""
    length = min(len(one), len(other))
    if length < 0.8 * max(len(one), len(other)):
        return False
    largest = max(float(np.std(one[:, 0])), 1e-300)
    for k in range(one.shape[1]):
        a, b = one[:length, k], other[:length, k]
        if max(np.std(a), np.std(b)) < _COUNTS * largest:
            continue
        if float(np.std(a - b)) > _SAME * max(float(np.std(a)), float(np.std(b))):
            return False
    return True


def record_of(channels: Mapping[str, Array], file: Path) -> Record | None:
    """Make a record of what was recognised in a file, None where its times are not known."""
    time = channels.get("time")
    if time is None or len(time) < 2 or not np.all(np.diff(time) > 0.0):
        return None
    return Record(time, {n: v for n, v in channels.items() if n != "time"}, {"file": file.name})
