"""Which gauge broke since the last run: the audit of the new runs by themselves, held against that of the others.

A fault that only the last of five runs has is a fifth of itself in an audit of all of them.
"""

from collections.abc import Container, Iterable, Sequence
from dataclasses import replace

from slipwise.campaign import Campaign
from slipwise.effects import Effect
from slipwise.errors import SlipwiseError
from slipwise.instruments.checks import check_instruments
from slipwise.instruments.report import AuditFinding


def find_faults_of_runs(campaign: Campaign, names: Container[str], own: Iterable[Effect] = ()) -> Sequence[AuditFinding]:
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
