"""The audit of the instruments in words and rows: which fault, on which channel, how large, how sure, what else it is.

Nothing is corrected unless a finding is named: then the records are corrected by its size, and the campaign says so.
"""

import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slipwise.campaign import Campaign
from slipwise.display import Drawn, Tabular
from slipwise.effects import Effect
from slipwise.instruments.audit import NOTHING_MAPPED, audit
from slipwise.instruments.corrections import correct
from slipwise.instruments.report import AuditFinding, AuditReport
from slipwise.instruments.sentences import shown
from slipwise.preparation.logger import LoggerEstimate
from slipwise.preparation.prepared import Prepared


@dataclass(frozen=True, repr=False)
class Checks(Drawn, Tabular):
    """What the audit of the instruments says, for tables and pages.

    Attributes:
        words: the answer in a sentence.
        report: the audit itself, in numbers.
        seconds: that it took.
    """

    words: str
    report: AuditReport
    seconds: float

    @property
    def accused(self) -> bool:
        """Whether a gauge is accused, or what campaign.toml says of a column is contradicted."""
        return bool(self.report.findings or self.report.contradictions)

    @property
    def rows(self) -> list[Mapping[str, Any]]:
        """Findings in the units that people read, one a row."""
        return [_row(finding) for finding in self.report.findings]

    @property
    def cannot(self) -> tuple[str, ...]:
        """What could not be tested, and for lack of what."""
        return self.report.cannot

    @property
    def notes(self) -> tuple[str, ...]:
        """What matters to nobody but should be known, and what the data say of the logger."""
        logger = self.report.logger
        return self.report.notes if logger is None else (_logger(logger), *self.report.notes)

    def as_json(self) -> dict[str, Any]:
        """Return the findings as `slipwise audit --json` prints them."""
        return {
            "schema": 1,
            "campaign": self.report.campaign,
            "accused": self.accused,
            "words": self.words,
            "findings": self.report.rows(),
            "cannot": list(self.cannot),
            "notes": list(self.notes),
            "contradictions": list(self.report.contradictions),
            "levels": [one.as_json() for one in self.report.levels],
        }

    def _headline(self) -> str:
        return self.words

    def _rows(self) -> list[dict[str, Any]]:
        return self.report.rows()


def check_instruments(campaign: Campaign | Path | str | Prepared, *, own: Iterable[Effect] = ()) -> Checks:
    """Audit a campaign without any law of friction.

    Args:
        campaign: or its folder; one that is prepared is not prepared again.
        own: effects beside those of the catalogue, as `slipwise.effects.find_effect` gives them: faults of gauges
            (`fault`) and physical explanations (`disturb`).

    Raises:
        InputError: the folder holds no campaign that can be read.
    """
    began = time.perf_counter()
    report = audit(campaign, own)
    tested = [b for b in report.balances if not b.relation.startswith("rest_")]
    count = len(tested) + len({(one.level, one.below) for one in report.levels})
    if report.findings or report.contradictions:
        wrong = "; ".join([*(f.words for f in report.findings), *report.contradictions])
        words = f"No: {wrong}. No law of friction was needed to see it."
    elif count:
        words = f"Yes: {count} balances and kinematic relations agree, no gauge is accused."
    elif NOTHING_MAPPED in report.cannot:
        words = f"Not known: {NOTHING_MAPPED}."
    else:
        words = "Not known: these channels allow no balance, so no gauge can be held against another."
    return Checks(words, report, time.perf_counter() - began)


def corrected_campaign(campaign: Campaign, checks: Checks, names: Sequence[str]) -> Campaign:
    """Mend the records by the named findings, and note it.

    Args:
        campaign: as recorded.
        checks: its audit.
        names: of findings, as the audit prints them.

    Raises:
        UnknownNameError: the audit has no such finding.
        InputError: the audit has no finding at all, or one whose harm cannot be undone.
    """
    return correct(campaign, checks.report, names)[0]


def _row(finding: AuditFinding) -> dict[str, Any]:
    low, high = (shown(end, finding.unit, finding.effect) for end in (finding.low, finding.high))
    return {
        "finding": finding.name,
        "in words": finding.words,
        "95 % interval": f"{low} to {high}",
        "probability": f"{finding.probability:.0%}",
        "could be mistaken for": ", ".join(finding.mistaken_for) or "nothing near",
        "what would separate them": finding.settle_by,
    }


def _logger(found: LoggerEstimate) -> str:
    if found.lowpass is None:
        return f"the logger's filter is not known: {found.why}"
    by = found.lowpass
    return (
        f"the logger's low-pass filter, which campaign.toml does not give: {by.frequency:.0f} Hz "
        f"({found.low:.0f} to {found.high:.0f}), order {by.order}, phase {by.phase}, {found.why}"
    )
