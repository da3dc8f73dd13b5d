"""The load of a pad whose cell is dead, as a rigid girder on its springs distributes it: three cells give all others.

A load at rest that no rigid girder makes (a warp: pads of unlike heights) is not seen by the other cells. Runs in which
the cell lives show it; where there are none it is taken as zero and counts as error. What was estimated so is good
enough for the law of friction, and no balance of loads is held against it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from slipwise.arrays import Array
from slipwise.campaign import Campaign, Run
from slipwise.campaign.invalid_samples import InvalidSamples
from slipwise.preparation.sample_fault import SampleFault
from slipwise.rig import Specimen
from slipwise.rig.load_basis import RIGID_MODES, basis_of

#: The warp that nobody has seen, as a share of what a pad carries at rest: assumed [1].
_UNSEEN_WARP = 0.05


@dataclass(frozen=True)
class EstimatedLoad:
    """The load of a dead cell, made of the other cells.

    Attributes:
        channel: of the dead cell.
        runs: names of the runs in which it is estimated.
        made_of: channels of the other cells.
        error: expected, of one sample [N].
        warp_seen: whether other runs show what a rigid girder does not explain; else it is taken as zero.
    """

    channel: str
    runs: tuple[str, ...]
    made_of: tuple[str, ...]
    error: float
    warp_seen: bool

    @property
    def words(self) -> str:
        """Say what stands there, in a sentence."""
        warp = "the warp that it shows in other runs" if self.warp_seen else "a warp of zero"
        return (
            f"in its place the load that a rigid girder leaves to it by {', '.join(self.made_of)} and {warp}, "
            f"within {self.error / 1e3:.2g} kN; no balance of loads is judged there"
        )


def estimate_dead_loads(
    campaign: Campaign, faults: Sequence[SampleFault], masks: Mapping[str, InvalidSamples]
) -> tuple[Campaign, tuple[EstimatedLoad, ...]]:
    """Return a campaign in which dead load cells are replaced where rigidity allows it, and those that were.

    Args:
        campaign: put right.
        faults: found in it.
        masks: reason -> run -> channel -> samples (n,) that are no measurement.
    """
    rig = campaign.specimen
    loads = tuple(f"pad_{pad}_N" for pad in rig.pads) if rig.free else ()
    dead = {f.channels[0]: f.runs for f in faults if f.kind == "dead" and f.channels[0] in loads}
    found: list[EstimatedLoad] = []
    for name, runs in dead.items():
        tried = {run: _estimated(campaign.run(run), name, loads, campaign, masks) for run in runs}
        done = {run: one for run, one in tried.items() if one is not None}
        if not done:
            continue
        records = {run: campaign.run(run).record.replaced(**{name: values}) for run, (values, _) in done.items()}
        found.append(replace(next(iter(done.values()))[1], runs=tuple(done)))
        campaign = replace(
            campaign,
            runs=tuple(
                replace(r, record=records[r.name], estimated={**r.estimated, name: found[-1].error})
                if r.name in records
                else r
                for r in campaign.runs
            ),
        )
    return campaign, tuple(found)


def _estimated(
    run: Run, name: str, loads: Sequence[str], campaign: Campaign, masks: Mapping[str, InvalidSamples]
) -> tuple[Array, EstimatedLoad] | None:
    """Return the load of a dead cell in one run (n,) [N]; None where the living cells do not hold the girder."""
    alive = tuple(n for n in loads if _lives(n, run, masks))
    weights = _weights(campaign.specimen, loads, name, alive)
    if weights is None:
        return None
    seen = [one for one in campaign.runs if all(_lives(n, one, masks) for n in (name, *alive))]
    warps = [one.record[name] - weights @ np.stack([one.record[n] for n in alive]) for one in seen]
    warp = float(np.mean(np.concatenate(warps))) if warps else 0.0
    share = _UNSEEN_WARP * campaign.specimen.weight / len(loads)
    error = float(np.std(np.concatenate(warps))) if warps else share
    values = weights @ np.stack([run.record[n] for n in alive]) + warp
    return values, EstimatedLoad(name, (), alive, error, bool(warps))


def _lives(name: str, run: Run, masks: Mapping[str, InvalidSamples]) -> bool:
    bad = [of[run.name][name] for of in masks.values() if name in of.get(run.name, {})]
    return name in run.record and not any(mask.all() for mask in bad)


def _weights(specimen: Specimen, loads: Sequence[str], name: str, alive: Sequence[str]) -> Array | None:
    """Return by which factors the loads of living cells give that of another one on a rigid girder, (k,)."""
    patterns = dict(zip(loads, (basis_of(specimen).rigid * np.array(specimen.springs)).T, strict=True))
    if name not in patterns or len(alive) < RIGID_MODES:
        return None
    living = np.stack([patterns[n] for n in alive])
    if np.linalg.matrix_rank(living) < RIGID_MODES:
        return None
    return patterns[name] @ np.linalg.pinv(living)
