"""One replay of an ensemble: everything that decides it, and the few numbers that are kept of it."""

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import asdict, dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from scipy.optimize import brentq

from slipwise.errors import SimulationError
from slipwise.jobs.executors import run_all
from slipwise.jobs.job_log import Numbers
from slipwise.model import Model, use
from slipwise.motion import TableMotion, load_motion
from slipwise.short_repr import short_repr
from slipwise.simulation.replay import replay
from slipwise.simulation.simulator import Replay
from slipwise.studies.members import key_of, numbers_or_failure
from slipwise.studies.paper.one_dof import OneDof, one_dof
from slipwise.studies.paper.settings import PaperSettings, paper_model

#: Energy that a searched motion has to reach lies within this fraction; at most so many replays are tried.
_CLOSE, _TRIES = 5e-4, 12


@short_repr
@dataclass(frozen=True)
class Member:
    """One replay.

    Attributes:
        bridge: "bridge1" or "bridge2".
        seed: of the earthquake.
        peak: along x [m/s^2].
        frequency: predominant [Hz].
        strong: length of the strong part [s].
        vertical: peak upwards [m/s^2]; 0 for none.
        target: energy of the pads that the motion is scaled to reach [J]; 0 to take the peaks as they are.
        slenderness: h/b instead of the bridge's; 0 to keep it.
        effects: names of effects that are switched on at their typical size.
        settings: the assumptions.
    """

    bridge: str
    seed: int
    peak: float
    frequency: float
    strong: float
    vertical: float
    settings: PaperSettings
    target: float = 0.0
    slenderness: float = 0.0
    effects: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.bridge}, earthquake {self.seed}, {self.peak:.3g} m/s^2 along and {self.vertical:.3g} upwards"

    def motion(self) -> TableMotion:
        """Make the table motion."""
        spec = f"quake:seed={self.seed},peak={self.peak!r}m/s^2,f={self.frequency!r}Hz,strong={self.strong!r}s"
        return load_motion(spec + (f",vertical={self.vertical!r}m/s^2" if self.vertical > 0.0 else ""))

    def model(self) -> Model:
        """Make the model."""
        return _model(self.bridge, self.settings, self.effects, self.slenderness)

    def key(self) -> str:
        """Return a hash of everything that decides the result, the code included."""
        model = self.model()
        specimen = {k: v for k, v in asdict(model.specimen).items() if k not in ("path", "sources")}
        law = {u.label: u.numbers for u in model.uses}
        motion = [self.seed, self.peak, self.frequency, self.strong, self.vertical, self.target]
        return key_of([specimen, law, motion], __name__)


@cache
def _model(bridge: str, settings: PaperSettings, effects: tuple[str, ...], slenderness: float) -> Model:
    model = paper_model(bridge, settings).adding(*(use(name) for name in effects))
    if slenderness > 0.0:
        height = slenderness * 2.0 * model.specimen.half_spacing[0]
        model = replace(model, specimen=replace(model.specimen, centre_height=height))
    return model


def run_member(member: Member) -> dict[str, Any]:
    """Shake one member and keep its numbers; a simulation that diverges is a result too: "failed" says why.

    Returns:
        Numbers that JSON holds exactly, all SI.
    """
    return numbers_or_failure(lambda: _searched(member) if member.target > 0.0 else _numbers(*_shaken(member)))


def run_ensemble(
    members: Sequence[Member],
    folder: Path,
    *,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> list[Numbers]:
    """Run what has not been run yet and return the numbers of all members in their order.

    Args:
        members: the replays; equal ones are run once.
        folder: of `members.jsonl`; made if absent.
        executor: as for `slipwise.jobs.executors.run_all`, like the others and what is raised.
        workers: when no executor is given.
        progress: called with how many of how many are finished.
    """
    keys, path = [member.key() for member in members], folder / "members.jsonl"
    done = run_all(run_member, keys, members.__getitem__, path, executor=executor, workers=workers, progress=progress)
    return list(done.numbers(keys))


def _shaken(member: Member) -> tuple[Replay, OneDof]:
    model, motion = member.model(), member.motion()
    return replay(model, motion), one_dof(model, motion)


def _searched(member: Member) -> dict[str, Any]:
    """Scale a motion until the pads dissipate the target; then shake it without its vertical part too."""

    @cache
    def energy(factor: float, vertical: bool = True) -> float:
        scaled = replace(
            member, peak=member.peak * factor, vertical=member.vertical * factor if vertical else 0.0, target=0.0
        )
        return sum(replay(scaled.model(), scaled.motion()).pad_energy.values()) if factor > 0.0 else 0.0

    def missed(factor: float) -> float:
        """Return by what share the target is missed; 0, at which the search ends, where that is close enough."""
        share = energy(factor) / member.target - 1.0
        return share if abs(share) >= _CLOSE else 0.0

    low, high = 0.0, 1.0
    while energy(high) < member.target:
        low, high = high, high * 1.5
        if high > 10.0:
            raise SimulationError(f"{low:.3g} times this motion still dissipates only {energy(low) / 10:.0f} kN cm")
    found: Any = brentq(
        missed, low, high, maxiter=_TRIES, disp=False
    )  # its type depends on arguments that are not given
    factor = float(found)
    return {"factor": factor, "energy": energy(factor), "energy_without": energy(factor, vertical=False)}


def _numbers(answer: Replay, single: OneDof) -> dict[str, Any]:
    record = answer.record
    slip = record["slip_x"]
    loads = record.stacked("pad_{}_N")
    one_slip = np.interp(record.time, single.time, single.slip)
    moved = float(np.ptp(slip))
    return {
        "energy": sum(answer.pad_energy.values()),
        "slip_max": max(abs(v) for v in answer.slip_range),
        "path": float(np.abs(np.diff(slip)).sum()),
        "speed_max": float(np.abs(record["slip_vx"]).max()),
        "girder_max": float(np.abs(record["girder_ax"]).max()),
        "load_low": min(low for low, _ in answer.load_range.values()),
        "load_high": max(high for _, high in answer.load_range.values()),
        "load_swing": [float(v) for v in loads.std(axis=0)],
        "uplift": answer.uplift,
        "energy_error": answer.energy_error,
        "one_dof_energy": single.energy,
        "one_dof_slip_max": float(np.abs(single.slip).max()),
        "one_dof_slip_error": float(np.sqrt(np.mean((one_slip - slip) ** 2))) / moved if moved > 0.0 else 0.0,
    }
