"""Which gauge broke since the last run: the audit of the new runs by themselves, held against that of the runs before.

A fault that only the last of five runs has is a fifth of itself in an audit of all of them.
"""

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace

from slipwise.campaign import Campaign
from slipwise.effects import Effect
from slipwise.errors import SlipwiseError
from slipwise.instruments.checks import check_instruments
from slipwise.instruments.report import AuditFinding


@dataclass(frozen=True)
class GaugeChange:
    """What the new runs show of the gauges by themselves.

    Attributes:
        accused: names of all findings, as the audit writes them.
        broke: those that the runs before had not, a sentence each.
        sound: those of the runs before that are not seen any more.
    """

    accused: tuple[str, ...]
    broke: tuple[str, ...]
    sound: tuple[str, ...]


def find_faults_of_runs(
    campaign: Campaign, names: Collection[str], own: Iterable[Effect] = ()
) -> Sequence[AuditFinding]:
    """Return what the audit finds in some runs by themselves, nothing where they allow no audit.

    Args:
        campaign: with these runs and others.
        names: of the runs.
        own: effects beside those of the catalogue.
    """
    runs = tuple(run for run in campaign.runs if run.name in names)
    if not runs:
        return ()
    try:
        return check_instruments(replace(campaign, runs=runs), own=own).report.findings
    except SlipwiseError:  # the audit of all runs says what is wrong
        return ()


def compare_gauges(found: Sequence[AuditFinding], before: Collection[str]) -> GaugeChange:
    """Hold the findings of new runs against the names of those of the runs before."""
    names = tuple(finding.name for finding in found)
    broke = tuple(finding.words for finding in found if finding.name not in before)
    return GaugeChange(names, broke, tuple(name for name in before if name not in names))
