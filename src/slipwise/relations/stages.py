"""Stages of an evaluation: each a function of what it asks for, made anew only where an answer has changed.

A stage gets everything through its `Inputs`: numbers of the fit, the terms that it declares to see, the runs, what was
weighed, and what other stages make. Each question is written down with its answer, those of the stages that it asks
included. What a stage made is used again where the same questions would be answered alike. So nothing has to be
declared twice, and a number that a stage begins to read counts from then on.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Generic, TypeVar, cast

from slipwise.relations.parameters import Term
from slipwise.relations.run_data import FitRun
from slipwise.relations.setting import Measurements, Weighing
from slipwise.short_repr import short_repr

Made = TypeVar("Made")
#: Kind of a question and what it is about: a number's key, a predicate of terms, an attribute.
Question = tuple[str, Any]
#: Results kept of each stage: a difference quotient comes back to its base again and again. Fewer are kept of runs that
#: have more samples than this together: each is as long as they are.
_KEPT, _KEPT_OF_LONG, LONG = 4, 2, 60_000


def _sees_none(term: Term) -> bool:
    return False


@dataclass(frozen=True, eq=False)
class Stage(Generic[Made]):
    """One step from measured runs to residuals.

    Attributes:
        name: of what it makes.
        make: makes it of its inputs alone.
        sees: tells which terms it sees; none, if not given.
    """

    name: str
    make: "Callable[[Inputs], Made]"
    sees: Callable[[Term], bool] = _sees_none


@short_repr
@dataclass(frozen=True, eq=False)
class _Entry:
    """What a stage made, and what it was made of."""

    answers: Mapping[Question, Any]
    made: Any


@short_repr
@dataclass(frozen=True, eq=False)
class Memo:
    """What every stage made lately.

    Attributes:
        most: results kept of each stage.
    """

    most: int
    _kept: dict[Stage[Any], list[_Entry]] = field(default_factory=dict[Stage[Any], list[_Entry]])

    def find(self, stage: Stage[Any], answers_alike: Callable[[Mapping[Question, Any]], bool]) -> _Entry | None:
        """Return what a stage made where every question would be answered alike, and keep it longest."""
        kept = self._kept.get(stage, [])
        for entry in reversed(kept):
            if answers_alike(entry.answers):
                self._kept[stage] = [*(e for e in kept if e is not entry), entry]
                return entry
        return None

    def keep(self, stage: Stage[Any], entry: _Entry) -> None:
        """Keep what a stage made; the oldest of it is dropped."""
        self._kept[stage] = [*self._kept.get(stage, []), entry][-self.most :]

    def make_room(self, stage: Stage[Any]) -> None:
        """Drop the oldest of a stage before another is made: both would be in memory at once."""
        self._kept[stage] = self._kept.get(stage, [])[1 - self.most :]


def make_memo(measurements: Measurements) -> Memo:
    """Return an empty memo for results as long as these runs."""
    return Memo(_KEPT if measurements.samples <= LONG else _KEPT_OF_LONG)


@short_repr
@dataclass(frozen=True, eq=False)
class Evaluation:
    """One evaluation of an objective: everything that its stages may ask for.

    Attributes:
        measurements: the runs.
        weighing: with which they are weighed.
        terms: effects.
        values: key -> value of every term's parameters and the rig's numbers.
        count: of runs from the first on that are evaluated.
        makes_yaw: whether the girder's yaw is made from the measured forces.
        around: values from which slopes are taken, where faults move noise in time; see `measurement.without`.
        memo: what the stages made before.
    """

    measurements: Measurements
    weighing: Weighing
    terms: tuple[Term, ...]
    values: Mapping[str, float]
    count: int
    makes_yaw: bool
    around: Mapping[str, float] | None
    memo: Memo

    def answer(self, question: Question) -> Any:
        """Return the answer to a stage's question."""
        kind, about = question
        if kind == "number":
            return self.values.get(about)
        if kind == "terms":
            return tuple(term for term in self.terms if about(term))
        return getattr(self.weighing if kind == "weighing" else self, about)

    def result(self, stage: Stage[Made]) -> tuple[Made, Mapping[Question, Any]]:
        """Return what a stage makes, and the questions that it asked with their answers."""
        entry = self.memo.find(stage, self._answers_alike)
        if entry is None:
            self.memo.make_room(stage)
            inputs = self.inputs(stage)
            made = stage.make(inputs)
            entry = _Entry(inputs.answers, made)
            self.memo.keep(stage, entry)
        return cast(Made, entry.made), entry.answers

    def of(self, stage: Stage[Made]) -> Made:
        """Return what a stage makes."""
        return self.result(stage)[0]

    def inputs(self, stage: Stage[Any]) -> "Inputs":
        """Return what a stage is given."""
        return Inputs(self, stage.sees)

    def weighed(self, weighing: Weighing) -> "Evaluation":
        """Return the same evaluation with another noise."""
        return replace(self, weighing=weighing)

    def _answers_alike(self, answers: Mapping[Question, Any]) -> bool:
        for question, before in answers.items():
            now = self.answer(question)
            # arrays are told apart by which they are: to compare them takes longer than to make them anew
            comparable = question[0] == "terms" or isinstance(before, float | int)
            if now is not before and not (comparable and now == before):
                return False
        return True


class Inputs:
    """What a stage is given; what it asks for is written down."""

    def __init__(self, evaluation: Evaluation, sees: Callable[[Term], bool]) -> None:
        """Begin with no question."""
        self._evaluation = evaluation
        self._sees = sees
        self.answers: dict[Question, Any] = {}
        self.values: Mapping[str, float] = _Numbers(self)

    def ask(self, kind: str, about: Any) -> Any:
        """Return the answer to a question, and write both down."""
        question = (kind, about)
        if question not in self.answers:
            self.answers[question] = self._evaluation.answer(question)
        return self.answers[question]

    def of(self, stage: Stage[Made]) -> Made:
        """Return what another stage makes; its questions become this one's."""
        made, answers = self._evaluation.result(stage)
        self.answers.update(answers)
        return made

    @property
    def measurements(self) -> Measurements:
        """All measured runs."""
        return self.ask("setting", "measurements")

    @property
    def runs(self) -> tuple[FitRun, ...]:
        """The runs that are evaluated, as measured."""
        return self.measurements.runs[: self.ask("setting", "count")]

    @property
    def terms(self) -> tuple[Term, ...]:
        """The terms that the stage sees."""
        return self.ask("terms", self._sees)

    @property
    def makes_yaw(self) -> bool:
        """Whether the girder's yaw is made from the measured forces."""
        return self.ask("setting", "makes_yaw")

    @property
    def around(self) -> Mapping[str, float] | None:
        """Values from which slopes are taken, where faults move noise in time."""
        return self.ask("setting", "around")

    def weighed(self, what: str) -> Any:
        """Return an attribute of the weighing."""
        return self.ask("weighing", what)


class _Numbers(Mapping[str, float]):
    """The numbers of a fit, each of which counts as an input once it was asked for."""

    def __init__(self, inputs: Inputs) -> None:
        self._inputs = inputs

    def __getitem__(self, key: str) -> float:
        value = self._inputs.ask("number", key)
        if value is None:
            raise KeyError(key)
        return value

    def __iter__(self) -> Iterator[str]:
        raise TypeError("a stage asks for the numbers that it needs by their keys: it must not depend on all of them")

    def __len__(self) -> int:
        raise TypeError("a stage asks for the numbers that it needs by their keys: it must not depend on all of them")
