"""What an audit says: findings with intervals and rivals, what could not be tested, and what holds."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from slipwise.display import Drawn, Tabular
from slipwise.effects import Effect
from slipwise.instruments.level_checks import StoreyAnswer
from slipwise.preparation.logger import LoggerEstimate
from slipwise.preparation.sample_fault import SampleFault
from slipwise.short_repr import short_repr


@short_repr
@dataclass(frozen=True)
class AuditFinding:
    """One fault of an instrument.

    Attributes:
        effect: that the fault is, of the catalogue or a user's own.
        channel: the channel, or a card of cells as a pattern, e.g. "pad_*_Fx".
        size: in `unit`.
        low: lower end of the 95 % interval.
        high: upper end.
        unit: SI unit; "1" for a share.
        probability: that this fault, on this channel, is what is there.
        mistaken_for: other explanations, nearest first.
        settle_by: what would tell them apart.
        words: the finding as a sentence.
        target: of the effect that undoes it.
        values: parameters of that effect.
        runs: names of the runs that show it.
        of_samples: the fault of samples that it is; None of one that balances show.
    """

    effect: Effect
    channel: str
    size: float
    low: float
    high: float
    unit: str
    probability: float
    mistaken_for: tuple[str, ...]
    settle_by: str
    words: str
    target: str
    values: Mapping[str, float]
    runs: tuple[str, ...] = ()
    of_samples: SampleFault | None = None

    @property
    def what(self) -> str:
        """Name of the effect, e.g. "channel_delay"."""
        return self.effect.name

    @property
    def name(self) -> str:
        """What and where, as one writes it after --correct."""
        return f"{self.what}:{self.channel}"


@dataclass(frozen=True)
class Balance:
    """How well one relation holds.

    Attributes:
        relation: its name.
        floor: what noise alone leaves, in the relation's unit.
        left: what it leaves as recorded, constants of the rig fitted, in floors.
        explained: what it leaves after findings and physical alternatives, in floors.
        rows: how many samples it was evaluated on.
    """

    relation: str
    floor: float
    left: float
    explained: float
    rows: int


@dataclass(frozen=True, repr=False)
class AuditReport(Drawn, Tabular):
    """Result of an audit. It changes no data.

    Attributes:
        campaign: its name.
        findings: faults of instruments, most probable first.
        balances: how well each relation holds.
        physics: what the balances show beside the base rig that is no fault of a gauge: names of effects, or words.
        constants: mass [kg], stiffness_x [N/m], lever (mass times height of the centre of gravity) [kg m], ...
        logger: estimate of the filter; None where campaign.toml describes the logger.
        cannot: what could not be tested, and why.
        notes: small things that matter to nobody but should be known.
        contradictions: what campaign.toml says of columns and the motions contradict, and what to write instead.
        levels: how each level of a structure answers the one below.
    """

    campaign: str
    findings: tuple[AuditFinding, ...]
    balances: tuple[Balance, ...]
    physics: tuple[str, ...]
    constants: Mapping[str, float]
    logger: LoggerEstimate | None
    cannot: tuple[str, ...]
    notes: tuple[str, ...] = field(default=())
    contradictions: tuple[str, ...] = field(default=())
    levels: tuple[StoreyAnswer, ...] = field(default=())

    def rows(self) -> list[dict[str, Any]]:
        """Return the findings as rows of a table."""
        return [
            {
                "what": f.what,
                "channel": f.channel,
                "size": f.size,
                "low": f.low,
                "high": f.high,
                "unit": f.unit,
                "probability": f.probability,
                "mistaken_for": ", ".join(f.mistaken_for),
                "settle_by": f.settle_by,
                "words": f.words,
            }
            for f in self.findings
        ]

    def _headline(self) -> str:
        found = "; ".join([*(f.words for f in self.findings), *self.contradictions]) or "no gauge is accused"
        return f"{self.campaign}: {found}"

    def _rows(self) -> list[dict[str, Any]]:
        return self.rows()
