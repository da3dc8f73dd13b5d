"""The whole paper, re-enacted: one call, one list of replays, one result."""

import time
from collections import Counter
from collections.abc import Callable
from concurrent.futures import Executor
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from slipwise.motion import TableMotion
from slipwise.short_repr import short_repr
from slipwise.studies.paper import beyond, claims, extreme, factors, hysteresis, law, scaling, sine_tests, table_input
from slipwise.studies.paper.finding import VERDICTS, Study
from slipwise.studies.paper.member import run_ensemble
from slipwise.studies.paper.plan import Plan, plan
from slipwise.studies.paper.settings import SETTINGS, PaperSettings

#: Share of the time that the ensemble takes, for the progress bar.
_ENSEMBLE_SHARE = 0.85


@short_repr
@dataclass(frozen=True)
class Reenactment:
    """What came out.

    Attributes:
        settings: the assumptions it rests on.
        studies: in the paper's order.
        replays: of the ensemble.
        failed: replays that diverged.
        seconds: that it took.
    """

    settings: PaperSettings
    studies: tuple[Study, ...]
    replays: int
    failed: int
    seconds: float

    def verdicts(self) -> dict[str, int]:
        """Count the findings by verdict."""
        counted = Counter(f.verdict for study in self.studies for f in study.findings)
        return {verdict: counted[verdict] for verdict in VERDICTS}


def reenact(
    settings: PaperSettings,
    folder: Path,
    *,
    quick: bool = False,
    ground: TableMotion | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> Reenactment:
    """Re-enact the paper.

    Args:
        settings: the assumptions.
        folder: keeps the finished replays, so that the next call with the same settings goes on where this one stopped.
        quick: a coarse map.
        ground: a recorded ground motion for the bridge model, in the prototype's time; the assumed one when not given.
        executor: that runs the replays; processes on this machine when not given.
        workers: number of these processes.
        progress: called with the fraction done.
    """
    began = time.perf_counter()
    chosen = plan(settings, quick=quick)

    def part(finished: int, of: int) -> None:
        if progress is not None:
            progress(_ENSEMBLE_SHARE * finished / of)

    answers = run_ensemble(chosen.members, folder, executor=executor, workers=workers, progress=part)
    studies = _studies(settings, chosen, chosen.sorted(answers), ground, progress)
    failed = sum("failed" in numbers for numbers in answers)
    return Reenactment(settings, studies, len(answers), failed, time.perf_counter() - began)


def _studies(
    settings: PaperSettings,
    chosen: Plan,
    numbers: dict[str, list[dict[str, Any]]],
    ground: TableMotion | None,
    progress: Callable[[float], None] | None,
) -> tuple[Study, ...]:
    entered = table_input.study(settings, ground)
    steps: tuple[Callable[[], Study], ...] = (
        lambda: scaling.study(settings),
        lambda: entered,
        lambda: factors.study(settings, entered.curves["records"]),
        lambda: hysteresis.study(settings, numbers),
        lambda: law.study(settings),
        lambda: sine_tests.study(settings),
        lambda: extreme.study(settings, chosen, numbers),
        lambda: claims.study(settings, numbers),
        lambda: beyond.study(settings, numbers),
    )
    out = []
    for i, step in enumerate(steps):
        out.append(step())
        if progress is not None:
            progress(_ENSEMBLE_SHARE + (1.0 - _ENSEMBLE_SHARE) * (i + 1) / len(steps))
    return tuple(out)


def assumptions(settings: PaperSettings) -> list[dict[str, Any]]:
    """List every assumption with its value, default and reason."""
    default = PaperSettings()
    return [
        {
            "name": s.name,
            "value": settings.value(s.name),
            "default": default.value(s.name),
            "unit": s.unit,
            "decides": s.about,
            "why": s.why,
        }
        for s in SETTINGS
    ]


def as_json(result: Reenactment) -> dict[str, Any]:
    """Return the content of paper.json."""
    return {
        "schema": 1,
        "versions": {name: version(name) for name in ("slipwise", "mujoco", "numpy", "scipy")},
        "verdicts": result.verdicts(),
        "assumptions": assumptions(result.settings),
        "ground": result.settings.ground,
        "ensemble": {
            "motions": result.settings.members,
            "seed": result.settings.seed,
            "replays": result.replays,
            "failed": result.failed,
        },
        "studies": [
            {
                "name": study.name,
                "title": study.title,
                "findings": [asdict(finding) for finding in study.findings],
                "tables": {title: list(rows) for title, rows in study.tables.items()},
            }
            for study in result.studies
        ],
        "seconds": round(result.seconds, 1),
    }
