"""The verb: watch a campaign's folder, and judge every run that comes in."""

import hashlib
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from slipwise.campaign import Campaign
from slipwise.comparison.compare import compare
from slipwise.design.motions import Limits
from slipwise.design.next_test import next_test
from slipwise.diagnosis.diagnose import diagnose
from slipwise.diagnosis.result import Diagnosis
from slipwise.effects import Effect, Trust
from slipwise.errors import InputError, SlipwiseError
from slipwise.instruments.checks import check_instruments
from slipwise.model import Model
from slipwise.model.file import load_model
from slipwise.monitoring.folder import FolderState, Observer
from slipwise.monitoring.gauges import compare_gauges, find_faults_of_runs
from slipwise.monitoring.read_runs import RunReader
from slipwise.monitoring.step import Step, load_steps, save_steps, short_verdict
from slipwise.preparation.prepare import prepare
from slipwise.short_repr import short_repr

#: Time between two looks at the folder [s].
_EVERY = 0.5
#: Motions that are listed of the next ones.
_LISTED = 5
#: What a piece of news is about.
About = Literal["waiting", "runs", "gauges", "verdict", "places", "next", "broken off"]


@short_repr
@dataclass(frozen=True)
class News:
    """What `watch` has to tell.

    Attributes:
        about: what the news is.
        steps: all steps so far; the last one is that of the news.
        waiting: what is waited for, and what was taken unasked, a sentence each.
        found: the diagnosis, with news of a verdict.
    """

    about: About
    steps: tuple[Step, ...]
    waiting: tuple[str, ...] = ()
    found: Diagnosis | None = None


class _FolderChanged(Exception):
    """A run has come in: what is still being worked out for the runs before is not worth finishing."""


def watch(
    campaign: Path | str,
    kept: Path | str,
    *,
    model: Path | str | None = None,
    trust: Trust = False,
    own: Iterable[Effect] = (),
    limits: Limits | None = None,
    progress: Callable[[str, float], None] | None = None,
) -> Iterator[News]:
    """Look at a campaign's folder for ever, judge each new or changed run, and yield what there is to tell.

    A run that campaign.toml names is waited for; a data file that is younger than campaign.toml is a run too. After
    each: the audit of the instruments, the diagnosis, where the model fails, and the next motion. A run that comes in
    while the last two are worked out breaks them off.

    Args:
        campaign: the folder.
        kept: file in which every step stands as soon as it is known; where there is one, it is gone on from.
        model: the model.toml to start from; the one beside campaign.toml if there is one when not given.
        trust: effect files of the model that may be run, see `load_model`.
        own: effects beside those of the catalogue.
        limits: of the table, for the next motion.
        progress: called with what is being done and the share done.

    Raises:
        InputError: no such folder, no campaign.toml in it, a model that cannot be used, or `kept` is another file.
        OutputError: `kept` cannot be written.
    """
    folder, kept = Path(campaign), Path(kept)
    if not folder.is_dir():
        raise InputError(f"{folder}: no such folder; a campaign is a folder with campaign.toml and data files")
    steps, tell = load_steps(kept), progress or (lambda words, share: None)
    observer, reader = Observer(folder, {name for step in steps for name in step.files}), RunReader(folder)
    observer.look()  # a folder that is none, or without a campaign.toml, is told at once
    told: tuple[str, ...] = ()
    begun = False
    judged: object = None
    while True:
        seen, measured, notices = _looked(observer, reader, judged)
        if notices != told or not begun:  # even nothing is told once: whoever listens knows that it has begun
            told, begun = notices, True
            yield News("waiting", steps, told)
        if seen is None:
            time.sleep(_EVERY)
            continue
        judged, began = seen.key, time.monotonic()
        basis = _basis(folder / "campaign.toml", Path(model) if model is not None else folder / "model.toml")
        step, anew = _next_step(steps, measured, tuple(reader.refused.values()), basis)
        if not anew:
            if step != steps[-1]:
                steps = (*steps[:-1], step)
                save_steps(folder.resolve().name, steps, kept)
                yield News("runs", steps, told)
            continue
        earlier = steps[: step.number - 1]
        work = _Work(folder, model, trust, tuple(own), limits, observer, seen, tell, began)
        try:
            for about, known, found in _judged(work, step, earlier, measured):
                steps = (*earlier, known)
                save_steps(folder.resolve().name, steps, kept)
                yield News(about, steps, told, found)
        except _FolderChanged:
            yield News("broken off", steps, told)


def _looked(
    observer: Observer, reader: RunReader, judged: object
) -> tuple[FolderState | None, Campaign | None, tuple[str, ...]]:
    """Return what is there to be judged: the folder, its runs, and what is waited for or was taken unasked.

    No folder where nothing has changed since the last judgement, and where campaign.toml is being edited.
    """
    try:
        seen = observer.look()
        if not seen.whole:
            return None, None, seen.notices
        measured = None if seen.key == judged else reader.read(seen)
    except SlipwiseError as error:
        return None, None, (f"{' '.join(str(error).split())}; it is looked at again",)
    taken = tuple(
        f"{name} is not in campaign.toml: it is taken as a run of role fit; a [[run]] there gives it another role, and "
        "moved away it is left out"
        for name in seen.unnamed
        if name not in reader.refused  # that is told for itself
    )
    return None if seen.key == judged else seen, measured, (*seen.notices, *taken)


@dataclass(frozen=True)
class _Work:
    """What judging a step needs beside the runs."""

    folder: Path
    model: Path | str | None
    trust: Trust
    own: tuple[Effect, ...]
    limits: Limits | None
    observer: Observer
    seen: FolderState
    tell: Callable[[str, float], None]
    began: float

    def since(self) -> float:
        """Return how long ago the files were whole [s]."""
        return round(time.monotonic() - self.began, 1)

    def go_on(self, words: str, share: float) -> None:
        """Tell progress, and break off where the folder is no longer as it was."""
        self.tell(words, share)
        try:
            now = self.observer.look()
        except SlipwiseError:  # campaign.toml is being edited
            raise _FolderChanged from None
        if now.key != self.seen.key or now.unfinished != self.seen.unfinished:
            raise _FolderChanged

    def start(self) -> Model | None:
        """Return the model to start from."""
        path = Path(self.model) if self.model is not None else self.folder / "model.toml"
        if self.model is None and not path.is_file():
            return None
        return load_model(path, trust=self.trust)


def _next_step(
    steps: tuple[Step, ...], measured: Campaign | None, refused: tuple[str, ...], basis: str
) -> tuple[Step, bool]:
    """Return the step that these files ask for, and whether anything of it is to be judged.

    A step that was not finished is done again. Where runs and model are those of the last step, only what is left out
    may be new.
    """
    runs = () if measured is None else measured.runs
    files = {run.file: run.sha256 for run in runs}
    done = steps
    if steps and (steps[-1].files, steps[-1].basis) == (files, basis):
        if steps[-1].finished:
            return replace(steps[-1], refused=refused), False
        done = steps[:-1]
    before = done[-1].files if done else {}
    new = tuple(run.name for run in runs if before.get(run.file) != run.sha256)
    return Step(len(done) + 1, time.strftime("%Y-%m-%d %H:%M:%S"), new, files, basis, refused), True


def _basis(*paths: Path) -> str:
    contents = [path.read_bytes() if path.is_file() else b"" for path in paths]
    return hashlib.sha256(b"\0".join(contents)).hexdigest()


def _judged(
    work: _Work, step: Step, earlier: tuple[Step, ...], measured: Campaign | None
) -> Iterator[tuple[About, Step, Diagnosis | None]]:
    """Yield the step as it grows: runs, gauges, verdict, places, next."""
    if measured is None:
        yield "runs", replace(step, finished=True), None
        return
    yield "runs", step, None
    work.tell("auditing the instruments", 0.05)
    prepared = prepare(measured)
    checks = check_instruments(prepared, own=work.own)
    step = replace(step, gauges=checks.words, accused=earlier[-1].accused if earlier else ())
    if step.runs:
        alone = find_faults_of_runs(measured, step.runs, work.own) if earlier else checks.report.findings
        change = compare_gauges(alone, step.accused)
        step = replace(step, accused=change.accused, sound=change.sound, broke=change.broke if earlier else ())
    step = replace(step, seconds={"audit": work.since()})
    yield "gauges", step, None
    try:
        found = diagnose(prepared, work.start(), own=work.own, progress=work.tell)
    except SlipwiseError as error:
        yield "verdict", replace(step, cannot=" ".join(str(error).split()), finished=True), None
        return
    step = replace(
        step,
        verdict=short_verdict(found.as_json()),
        report=f"step_{step.number:02d}",
        seconds={**step.seconds, "verdict": work.since()},
    )
    yield "verdict", step, found
    compared = compare(prepared, work.start(), system=False, checks=checks, progress=work.go_on)
    places = tuple(place.words for place in compared.places)
    step = replace(step, places=places or ("Nowhere: no state of motion stands above the floor",))
    yield "places", step, None
    yield "next", _with_next_motion(work, step, found), None


def _with_next_motion(work: _Work, step: Step, found: Diagnosis) -> Step:
    """Return a step with the motions that would tell most next."""
    try:
        ranked = next_test(found, work.limits, progress=work.go_on)
    except SlipwiseError as error:
        return replace(step, next_words=f"No motion is ranked: {' '.join(str(error).split())}", finished=True)
    best = next((one for one in ranked.proposals if not one.refused and not one.failed), None)
    words = ranked.words if best is None else f"Next: {best.motion}. {ranked.words}".strip()
    rows = tuple(row for row in ranked.as_json()["motions"] if row["table"] == "can make it" and not row["failed"])
    took = {**step.seconds, "next": work.since()}
    return replace(step, motions=rows[:_LISTED], next_words=words, seconds=took, finished=True)
