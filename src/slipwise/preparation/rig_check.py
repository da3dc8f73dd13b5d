"""Whether the rig that a campaign declares is the one that was shaken: what a fit finds, held against every rig.

Most rigs are as declared, and two linear balances say so in a hundredth of the time of a fit:

    girder   sum F + m a_x + K x = 0          K: stiffness of the buffers
    pitch    moment of the loads + m h a_x + K z_b x + J Q1'' = 0          h: height of the centre of gravity

Only where one of both numbers is off by half of what makes a rig another one, or is not shown by the channels, the base
model is fitted and decides.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from slipwise.campaign import Campaign
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.errors import InputError
from slipwise.estimation.base_fit import BaseFit, fit_base
from slipwise.preparation.balance_records import BalanceRecords
from slipwise.relations.balance_rows import Stack, constants_of, prepare_runs, stack
from slipwise.relations.rigid_balances import relations
from slipwise.rig import load_specimen
from slipwise.rig.files import RIGS
from slipwise.rig.known import better_known
from slipwise.rig.specimen import Specimen

#: What is held against every rig: only balances tell it, and rigs differ by it.
HELD_AGAINST: tuple[str, ...] = ("centre_height", "buffer_stiffness")
#: A rig's numbers may be off by this share, and by this one those of another rig that fits [1]: chosen by judgement,
#: the two rigs of the paper differ by factors of 2 and 1.5.
_OFF, _FITS = 0.35, 0.15


@dataclass(frozen=True)
class WrongRig:
    """Another rig than the declared one.

    Attributes:
        declared: name of the rig in campaign.toml.
        fitting: the rig whose numbers fit.
        words: in a sentence.
    """

    declared: str
    fitting: Specimen
    words: str


def check_rig(
    campaign: Campaign, invalid: InvalidSamples, start: Mapping[str, float], balances: BalanceRecords
) -> WrongRig | None:
    """Return the rig that was shaken where it is not the declared one; None where it is, or where nothing tells.

    Args:
        campaign: as fits see it.
        invalid: run -> channel -> samples (n,) at which it is no measurement.
        start: key -> value where a fit begins.
        balances: records of the same campaign for balances.
    """
    rig = campaign.specimen
    if not rig.free or not rig.buffer_stiffness:
        return None
    seen = _numbers_of_balances(balances, rig)
    if seen is not None and _distance(seen, rig) < 0.5 * np.log1p(_OFF):
        return None
    try:
        return find_wrong_rig(fit_base(campaign, None, invalid, start))
    except InputError:  # what a fit lacks is told by whoever asks for one
        return None


def on_rig_shaken(campaign: Campaign, other: WrongRig) -> Campaign:
    """Return a campaign on the rig that was shaken; what it states of the declared one beside its mass is dropped."""
    known = {name: value for name, value in campaign.known.items() if name not in HELD_AGAINST}
    return replace(campaign, specimen=better_known(other.fitting, known, "campaign.toml"))


def _numbers_of_balances(balances: BalanceRecords, rig: Specimen) -> dict[str, float] | None:
    """Return height and stiffness by linear least squares of two balances; None where the channels do not show them."""
    runs, _ = prepare_runs(balances.campaign, balances.left_out)
    allowed = [r for r in relations(runs[0].record, rig)[0] if r.name in ("girder_x", "pitch")]
    stacked = stack(runs, allowed, rig, {**dict.fromkeys(constants_of(allowed), 0.0), "mass": rig.mass})
    girder, pitch = (_constants(stacked, name) for name in ("girder_x", "pitch"))
    if "stiffness_x" not in girder or "lever" not in pitch:
        return None
    found = {"centre_height": pitch["lever"] / rig.mass, "buffer_stiffness": girder["stiffness_x"]}
    return found if min(found.values()) > 0.0 else None


def _constants(stacked: Stack, relation: str) -> dict[str, float]:
    """Return the constants of one relation by least squares, with a zero of its own in every run; the mass is rated."""
    if relation not in stacked.residual:
        return {}
    run = stacked.run_of[relation]
    names = [name for name, of in stacked.base.items() if relation in of and name != "mass"]
    columns = np.column_stack([stacked.base[name][relation][:, 0] for name in names])
    rows, target = (_centred(values, run) for values in (columns, stacked.residual[relation][:, None]))
    solution = np.linalg.lstsq(rows / np.maximum(rows.std(axis=0), 1e-300), -target[:, 0], rcond=None)[0]
    return dict(zip(names, (solution / np.maximum(rows.std(axis=0), 1e-300)).tolist(), strict=True))


def _centred(columns: NDArray[np.float64], run: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return columns (n, k) without their means in each run."""
    means = np.stack([np.bincount(run, c) / np.maximum(np.bincount(run), 1) for c in columns.T], axis=1)
    return columns - means[run]


def find_wrong_rig(base: BaseFit) -> WrongRig | None:
    """Return whether the numbers that a fit found are those of another rig than the declared one; None where not.

    Args:
        base: the base fit, on the balances of a girder.
    """
    values, declared = base.solution.values, base.model.specimen
    if not base.problem.balanced or not declared.buffer_stiffness:
        return None
    found = {name: values[f"rig.{name}"] for name in HELD_AGAINST}
    off = _distance(found, declared)
    if off < np.log1p(_OFF):
        return None
    others = [load_specimen(name) for name in RIGS if name != declared.name]
    others = [o for o in others if o.free and o.pads == declared.pads and len(o.buffer_stiffness) > 0]
    best = min(others, key=lambda other: _distance(found, other), default=None)
    if best is None or _distance(found, best) > min(np.log1p(_FITS), 0.5 * off):
        return None
    numbers = _told(found["centre_height"], found["buffer_stiffness"] / len(declared.buffer_stiffness))
    rated = _told(declared.centre_height, declared.buffer_stiffness[0])
    words = f"campaign.toml declares {declared.name} ({rated}), but these numbers fit {best.name}: {numbers}"
    return WrongRig(declared.name, best, words)


def _distance(found: Mapping[str, float], rated: Specimen) -> float:
    """Return the largest logarithm of a ratio of what was found to what is rated [1]."""
    numbers = {"centre_height": rated.centre_height, "buffer_stiffness": sum(rated.buffer_stiffness)}
    return max(abs(float(np.log(found[name] / number))) for name, number in numbers.items())


def _told(height: float, stiffness: float) -> str:
    return f"height {height:.2f} m, buffers {stiffness / 1e6:.2f} kN/mm"
