"""The verb: shake a model whose numbers are uncertain by many motions at many scales."""

import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.arrays import Array
from slipwise.errors import SettingError
from slipwise.jobs.executors import run_all
from slipwise.jobs.job_log import Finished
from slipwise.motion import TableMotion, load_motion
from slipwise.motion.load import is_description
from slipwise.short_repr import short_repr
from slipwise.studies.ensemble.distributions import Varied, check_sampling, draw, read_varied
from slipwise.studies.ensemble.member import Base, Shaken, member_key, motion_key, run_shaken
from slipwise.studies.ensemble.members_file import write_members
from slipwise.studies.ensemble.responses import read_limit
from slipwise.studies.ensemble.scales import read_scales
from slipwise.studies.ensemble.tables import Exceedance, Quantiles, tables_of


@short_repr
@dataclass(frozen=True)
class Ensemble:
    """What came out.

    Attributes:
        path: of members.parquet.
        varied: what was drawn.
        motions: as they were given.
        scales: factors on each.
        members: draws for every motion and scale.
        quantiles: of every response.
        exceedances: of every limit.
        run: replays that were run now, the others had been finished before.
        seconds: that they took.
    """

    path: Path
    varied: tuple[Varied, ...]
    motions: tuple[str, ...]
    scales: tuple[float, ...]
    members: int
    quantiles: tuple[Quantiles, ...]
    exceedances: tuple[Exceedance, ...]
    run: int
    seconds: float


@dataclass(frozen=True)
class _Plan:
    """All members, counted through: motion by motion, scale by scale, draw by draw."""

    base: Base
    motions: dict[str, TableMotion]
    scales: tuple[float, ...]
    varied: tuple[Varied, ...]
    drawn: Array | None

    @property
    def members(self) -> int:
        return 1 if self.drawn is None else len(self.drawn)

    def __len__(self) -> int:
        return len(self.motions) * len(self.scales) * self.members

    def at(self, place: int) -> tuple[str, float, int]:
        """Return motion, scale and draw of a member."""
        rest, draw_number = divmod(place, self.members)
        motion, scale = divmod(rest, len(self.scales))
        return list(self.motions)[motion], self.scales[scale], draw_number

    def values(self, number: int) -> dict[str, float]:
        """Return what was drawn, key -> value [SI]."""
        if self.drawn is None:
            return {}
        return {v.key: float(x) for v, x in zip(self.varied, self.drawn[number], strict=True)}

    def keys(self) -> list[str]:
        """Return the key of every member."""
        base = self.base.key()
        motions = {name: motion_key(motion) for name, motion in self.motions.items()}
        places = (self.at(place) for place in range(len(self)))
        return [member_key(base, motions[name], scale, self.values(number)) for name, scale, number in places]

    def job(self, place: int) -> Shaken:
        """Return a member; a description goes to another machine faster than the motion it describes."""
        name, scale, number = self.at(place)
        motion = name if is_description(name) else self.motions[name]
        return Shaken(self.base, tuple(self.values(number).items()), motion, scale)


def run_scaled(
    motions: Sequence[str],
    folder: Path,
    *,
    rig: str = "bridge1",
    law: str = "paper",
    effects: Sequence[str] = (),
    vary: Sequence[str] = (),
    scales: str = "1",
    members: int = 128,
    sampling: str = "sobol",
    seed: int = 1,
    limits: Sequence[str] = (),
    executor: Executor | None = None,
    workers: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Ensemble:
    """Shake a model whose numbers are uncertain by many motions at many scales.

    Every motion and scale meets the same draws, so that a response differs between them by the motion alone.

    Args:
        motions: files or descriptions, each a motion of its own.
        folder: of members.parquet, and of members.jsonl, from which a stopped run goes on.
        rig: a name of `slipwise rigs`, or the path of an MJCF file.
        law: "paper" or "coulomb".
        effects: names or files, switched on at their typical size.
        vary: "KEY=LOW..HIGH[unit]" each, see `read_varied`; a number that is not varied keeps its value.
        scales: "FIRST:LAST:STEP", or one factor.
        members: draws for every motion and scale; one where nothing is varied.
        sampling: "sobol" or "latin".
        seed: of the draws.
        limits: "RESPONSE=VALUE" each.
        executor: that runs the replays, see `slipwise.jobs.executors`.
        workers: when no executor is given.
        progress: called with how many of how many replays are finished.

    Raises:
        SettingError: settings that cannot go together.
        SlipwiseError: a motion, rig, effect or number that does not exist or cannot be read.
    """
    if members < 1:
        raise SettingError(f"--members {members}: at least 1 is needed")
    check_sampling(sampling)
    base = Base(_anywhere(rig, ".xml"), law, tuple(_anywhere(name, ".py") for name in effects))
    model = base.model()
    varied = tuple(read_varied(text, model) for text in vary)
    twice = [v.key for i, v in enumerate(varied) if v.key in {other.key for other in varied[:i]}]
    if twice:
        raise SettingError(f"--vary {twice[0]} is given twice; give one range")
    drawn = draw(varied, members, sampling, seed) if varied else None
    wanted = tuple(read_limit(text) for text in limits)
    plan = _Plan(base, _motions(motions), read_scales(scales), varied, drawn)
    began = time.perf_counter()
    keys = plan.keys()
    finished = run_all(
        run_shaken, keys, plan.job, folder / "members.jsonl", executor=executor, workers=workers, progress=progress
    )
    seconds = time.perf_counter() - began
    path = folder / "members.parquet"
    write_members(_rows(plan, keys, finished), varied, path)
    quantiles, exceedances = tables_of(path, list(plan.motions), plan.scales, wanted)
    names = tuple(plan.motions)
    return Ensemble(
        path, varied, names, plan.scales, plan.members, quantiles, exceedances, finished.run, seconds
    )  # fmt: skip


def _motions(given: Sequence[str]) -> dict[str, TableMotion]:
    """Read every motion, name -> motion; the name is what was given."""
    motions: dict[str, TableMotion] = {}
    for text in given:
        if text in motions:
            raise SettingError(f"the motion {text} is given twice; give it once, a draw meets it once at each scale")
        motions[text] = load_motion(text)
    return motions


def _anywhere(name: str, suffix: str) -> str:
    """Return a path that holds in a process of another folder too."""
    return str(Path(name).resolve()) if name.endswith(suffix) else name


def _rows(plan: _Plan, keys: Sequence[str], finished: Finished) -> Iterator[dict[str, Any]]:
    for place, numbers in enumerate(finished.numbers(keys)):
        motion, scale, number = plan.at(place)
        yield {"motion": motion, "scale": scale, "member": number, **plan.values(number), **numbers}
