"""Whether the rig that a campaign declares is the one that was shaken: what a fit finds, held against every rig.

Most rigs are as declared, and linear balances say so in a hundredth of the time of a fit:

    girder   sum F + m a_x + K x = 0          K: stiffness of the buffers
    pitch    moment of the loads + m h a_x + K z_b x + J Q1'' = 0          h: height of the centre of gravity

Only where what they show is near to another rig the base model is fitted, and decides.
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
from slipwise.relations.balance_rows import Stack, list_constants, prepare_runs, stack_rows
from slipwise.relations.rigid_balances import list_rigid_balances
from slipwise.rig import load_specimen
from slipwise.rig.files import RIGS
from slipwise.rig.known import better_known
from slipwise.rig.specimen import Specimen

#: What is held against every rig: only balances tell it, and rigs differ by it.
HELD_AGAINST: tuple[str, ...] = ("centre_height", "buffer_stiffness")
#: A rig's numbers may be off by this share, and by this one those of another rig that fits [1]: chosen by judgement,
#: the two rigs of the paper differ by factors of 2 and 1.5.
_OFF, _FITS = 0.35, 0.15
#: Balances alone may miss the numbers of the rig that was shaken by this share, for an effect or a fault in them [1].
_NEAR = 0.4


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
    if not seen or not any(_distance(seen, other) < np.log1p(_NEAR) for other in _other_rigs(rig)):
        return None
    try:
        return find_wrong_rig(fit_base(campaign, None, invalid, start))
    except InputError:  # what a fit lacks is told by whoever asks for one
        return None


def put_on_rig_shaken(campaign: Campaign, other: WrongRig) -> Campaign:
    """Return a campaign on the rig that was shaken; what it states of the declared one beside its mass is dropped."""
    known = {name: value for name, value in campaign.known.items() if name not in HELD_AGAINST}
    return replace(campaign, specimen=better_known(other.fitting, known, "campaign.toml"))


def _numbers_of_balances(balances: BalanceRecords, rig: Specimen) -> dict[str, float]:
    """Return height and stiffness by linear least squares of two balances, as far as the channels show them."""
    runs, _ = prepare_runs(balances.campaign, balances.left_out)
    allowed = [r for r in list_rigid_balances(runs[0].record, rig)[0] if r.name in ("girder_x", "pitch")]
    stacked = stack_rows(runs, allowed, rig, {**dict.fromkeys(list_constants(allowed), 0.0), "mass": rig.mass})
    stiffness, lever = _constants(stacked, "girder_x").get("stiffness_x"), _constants(stacked, "pitch").get("lever")
    height = None if lever is None else lever / rig.mass
    found = {"centre_height": height, "buffer_stiffness": stiffness}
    return {name: value for name, value in found.items() if value is not None and value > 0.0}


def _constants(stacked: Stack, relation: str) -> dict[str, float]:
    """Return the constants of one relation by least squares, with a zero of its own in every run; the mass is rated."""
    if relation not in stacked.residual:
        return {}
    names = [name for name, of in stacked.base.items() if relation in of and name != "mass"]
    columns = np.column_stack([stacked.residual[relation], *(stacked.base[name][relation][:, 0] for name in names)])
    target, *rows = _centred(columns, stacked.run_of[relation]).T
    size = np.maximum(np.std(rows, axis=1), 1e-300)
    solution = np.linalg.lstsq(np.transpose(rows) / size, -target, rcond=None)[0] / size
    return dict(zip(names, solution.tolist(), strict=True))


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
    if not base.objective.balanced or not declared.buffer_stiffness:
        return None
    if not all(f"rig.{name}" in values for name in HELD_AGAINST):  # without measured loads no height is found
        return None
    found = {name: values[f"rig.{name}"] for name in HELD_AGAINST}
    off = _distance(found, declared)
    if off < np.log1p(_OFF):
        return None
    best = min(_other_rigs(declared), key=lambda other: _distance(found, other), default=None)
    if best is None or _distance(found, best) > min(np.log1p(_FITS), 0.5 * off):
        return None
    numbers = _told(found["centre_height"], found["buffer_stiffness"] / len(declared.buffer_stiffness))
    rated = _told(declared.centre_height, declared.buffer_stiffness[0])
    words = f"campaign.toml declares {declared.name} ({rated}), but these numbers fit {best.name}: {numbers}"
    return WrongRig(declared.name, best, words)


def _other_rigs(declared: Specimen) -> list[Specimen]:
    """Return the rigs that may have been shaken instead."""
    others = [load_specimen(name) for name in RIGS if name != declared.name]
    return [o for o in others if o.free and o.pads == declared.pads and len(o.buffer_stiffness) > 0]


def _distance(found: Mapping[str, float], rated: Specimen) -> float:
    """Return the largest logarithm of a ratio of what was found to what is rated [1]; 0 where nothing was."""
    numbers = {"centre_height": rated.centre_height, "buffer_stiffness": sum(rated.buffer_stiffness)}
    return max((abs(float(np.log(value / numbers[name]))) for name, value in found.items()), default=0.0)


def _told(height: float, stiffness: float) -> str:
    return f"height {height:.2f} m, buffers {stiffness / 1e6:.2f} kN/mm"
