"""Apply corrections that a user has named; what was done is written down, nothing is done silently."""

from collections.abc import Iterable

import numpy as np

from slipwise.campaign import Campaign
from slipwise.errors import InputError, unknown_name
from slipwise.instruments.report import AuditFinding, AuditReport
from slipwise.instruments.suspects import declared, effect_of
from slipwise.preparation.balance_records import bridge_by_splines
from slipwise.preparation.tare import find_tared_cells
from slipwise.record import Record


def correct(campaign: Campaign, report: AuditReport, names: Iterable[str]) -> tuple[Campaign, list[str]]:
    """Take named faults out of a campaign's records.

    Args:
        campaign: that was audited.
        report: its audit.
        names: of findings: "channel_delay:slip_x", or only "channel_delay" for all of that kind.

    Returns:
        The campaign with corrected records and notes, and the corrections in words.

    Raises:
        UnknownNameError: no finding has such a name.
        InputError: nothing was found at all, or a fault whose harm cannot be undone, such as a rail.
    """
    done: list[str] = []
    for name in names:
        chosen = [finding for finding in report.findings if name in (finding.name, finding.what)]
        if not chosen:
            known = [finding.name for finding in report.findings]
            if not known:
                raise InputError(f"{name!r}: the audit accuses no gauge, there is nothing to correct")
            raise unknown_name("finding", name, known, "`slipwise audit` lists them.")
        for finding in chosen:
            _check_known_weight(finding, campaign)
            words = f"corrected: {finding.words}"
            records = {run.name: _corrected(run.record, finding, run.name) for run in campaign.runs}
            campaign = campaign.with_records(records, words)
            done.append(words)
    return campaign, done


def _check_known_weight(finding: AuditFinding, campaign: Campaign) -> None:
    """Refuse to put back a weight that is only rated.

    Raises:
        InputError: the load cells are tared, and the campaign does not give the girder's mass.
    """
    if is_tared(finding, campaign) and "mass" not in campaign.known:
        each = (
            "each cell then gets a quarter of the weight"
            if finding.channel == "pad_*_N"
            else ("the cell then gets what the others do not carry")
        )
        raise InputError(
            f'{finding.words}: to put it back, give the girder\'s mass in campaign.toml, [specimen] mass = "10.02 t"; '
            f"{each}"
        )


def is_tared(finding: AuditFinding, campaign: Campaign) -> bool:
    """Return whether a finding is a load cell, or all four, that was set to zero under the girder."""
    cells = find_tared_cells(campaign)
    return finding.what == effect_of("shifted").name and bool(cells) and finding.channel in (*cells, "pad_*_N")


def _corrected(record: Record, finding: AuditFinding, run: str) -> Record:
    hooks = finding.effect.hooks
    if declared(finding.effect).scales and finding.size <= -1.0:
        raise InputError(f"{finding.channel} is dead: there is nothing that could be corrected; leave the channel out")
    if "held" in declared(finding.effect).samples:
        return _bridged(record, finding, run)
    undo = hooks.get("undo", hooks.get("sharpen"))
    if undo is None:
        raise InputError(f"{finding.words}: what it has cut away cannot be brought back; leave the channel or run out")
    return undo(record, finding.target, **finding.values)


def _bridged(record: Record, finding: AuditFinding, run: str) -> Record:
    """Interpolate over repeated samples."""
    fault = finding.of_samples
    if fault is not None and fault.kind == "held" and run in fault.bad:
        bad = fault.bad[run]
        return record.replaced(**{n: bridge_by_splines(record[n], bad) for n in fault.channels if np.any(bad)})
    if run in finding.runs:
        raise InputError(f"{finding.words}: samples that are lost cannot be put back; cut the run before them")
    return record
