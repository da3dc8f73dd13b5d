"""What `next_test` answers: table motions, ranked by how well they would separate the rivals."""

from dataclasses import dataclass
from typing import Any

from slipwise.display import Drawn, Tabular
from slipwise.preparation.data_corrections import DataCorrection


@dataclass(frozen=True)
class Proposal:
    """What a motion would tell.

    Attributes:
        motion: as `slipwise replay` takes it.
        separation: mean squared residual that the wrong one of two rivals would leave beyond the right one, mean of
            both ways; of the two that are hardest to tell apart [noise variance].
        relation: where.
        probability: expected of the best hypothesis afterwards, if it is right [1].
        refused: why the table cannot make it; "" where it can.
        failed: why it could not be judged; "" where it was.
    """

    motion: str
    separation: float
    relation: str
    probability: float
    refused: str
    failed: str = ""


@dataclass(frozen=True, repr=False)
class NextTest(Drawn, Tabular):
    """Motions, the best first.

    Attributes:
        rivals: names of the effects of each hypothesis, the best first; none for the base model.
        chances: probability of each today [1].
        proposals: sorted by what they would tell.
        words: what else tells the rivals apart, or would, where no motion does.
        sentence: the verdict of the diagnosis.
        corrections: what was done about the data before it.
    """

    rivals: tuple[tuple[str, ...], ...]
    chances: tuple[float, ...]
    proposals: tuple[Proposal, ...]
    words: str
    sentence: str = ""
    corrections: tuple[DataCorrection, ...] = ()

    @property
    def gain(self) -> float:
        """By how much the best of the motions would raise the probability of the best hypothesis [1]."""
        return max((p.probability for p in self.proposals if not p.refused), default=0.0) - self.chances[0]

    def as_json(self) -> dict[str, Any]:
        """Return what next.json holds."""
        return {
            "schema": 1,
            "best": list(self.rivals[0]),
            "rival": list(self.rivals[1]),
            "probability": round(self.chances[0], 3),
            "rivals": [
                {"effects": list(names), "probability": round(chance, 3)}
                for names, chance in zip(self.rivals, self.chances, strict=True)
            ],
            "words": self.words,
            "corrections": [one.as_json() for one in self.corrections],
            "motions": self._rows(),
        }

    def _headline(self) -> str:
        rivals = " against ".join(" + ".join(names) or "the base model" for names in self.rivals)
        return f"{rivals}: best told apart by {self.proposals[0].motion}" if self.proposals else rivals

    def _rows(self) -> list[dict[str, Any]]:
        return [
            {
                "motion": p.motion,
                "separation": round(p.separation, 3),
                "in": p.relation,
                "probability then": round(p.probability, 3),
                "table": p.refused or "can make it",
                "failed": p.failed,
            }
            for p in self.proposals
        ]
