"""The audit of the instruments in words and rows: what lies, on which channel, how large, how sure, what else it is.

Nothing is corrected unless a finding is named: then the records are mended by its size, and the campaign says so.
"""

import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from slipwise.campaign import Campaign
from slipwise.errors import InputError, unknown_name

if TYPE_CHECKING:
    from slipwise.audit.verdict import Evidence


@dataclass(frozen=True)
class Checks:
    """What the audit of the instruments says, for tables and pages.

    Attributes:
        words: the answer in a sentence.
        accused: whether a gauge is accused.
        rows: findings, one a row: finding, size, interval, unit, relations that show it, what it could be mistaken for.
        cannot: what could not be tested, and for want of what.
        seconds: that it took.
        evidence: what stands behind the rows.
    """

    words: str
    accused: bool = False
    rows: tuple[Mapping[str, Any], ...] = ()
    cannot: tuple[str, ...] = ()
    seconds: float = 0.0
    evidence: "tuple[Evidence, ...]" = ()


def check_instruments(campaign: Campaign) -> Checks:
    """Audit a campaign without any law of friction."""
    from slipwise.audit.balances import relations
    from slipwise.audit.judge import RATED_MASS, Case
    from slipwise.audit.rows import hold, noise_of_channels, noise_of_runs
    from slipwise.audit.verdict import judge

    began = time.perf_counter()
    runs, band = hold(campaign)
    possible, cannot = relations(runs[0].record, campaign.specimen)
    balances = [r for r in possible if not r.name.startswith("rest_")]
    if not balances:
        words = "Not known: these channels allow no balance, so no gauge can be held against another."
        return Checks(words, cannot=tuple(cannot), seconds=time.perf_counter() - began)
    noise = noise_of_runs(runs, noise_of_channels(campaign, runs, band), band)
    mass_error = 0.003 if "mass" in campaign.known else RATED_MASS
    found = judge(Case(runs, possible, campaign.specimen, noise, mass_error))
    rows = tuple(_row(e) for e in found.accepted)
    if not rows:
        words = f"Yes: {len(balances)} balances and kinematic relations agree, no gauge is accused."
    else:
        named = "; ".join(f"{r['finding']} ({r['size']})" for r in rows)
        words = f"No. The balances, in which there is no law of friction, accuse: {named}."
    return Checks(words, bool(rows), rows, tuple(cannot), time.perf_counter() - began, found.accepted)


def corrected_campaign(campaign: Campaign, checks: Checks, names: Sequence[str]) -> Campaign:
    """Mend the records by the named findings, and note it.

    Args:
        campaign: as recorded.
        checks: its audit.
        names: of findings, as the audit prints them.

    Raises:
        UnknownNameError: the audit has no such finding.
        InputError: the audit has no finding at all.
    """
    known = {_name(e): e for e in checks.evidence}
    for name in names:
        if name not in known:
            if not known:
                raise InputError(f"--correct {name!r}: the audit accuses no gauge, there is nothing to correct")
            raise unknown_name("finding", name, known, "`slipwise audit CAMPAIGN` lists them.")
    for name in names:
        found = known[name]
        records = {run.name: found.suspect.mend(run.record, found.size) for run in campaign.runs}
        note = f"corrected: {name} by {_size(found)}"
        campaign = campaign.with_records(records, note)
    return campaign


def _row(found: "Evidence") -> dict[str, Any]:
    reach = 2.0 * found.error
    rivals = [name for name, loss in found.rivals if loss < 10.0][:2]
    scale, unit = _shown(found)
    return {
        "finding": _name(found),
        "channels": ", ".join(found.suspect.channels),
        "size": _size(found),
        "95 % interval": f"{scale * (found.size - reach):.3g} to {scale * (found.size + reach):.3g} {unit}".strip(),
        "sure": f"{found.share:.0%} of what its balances show is explained",
        "shown by": ", ".join(found.balances),
        "could be mistaken for": ", ".join(rivals) or "nothing near",
        "runs": ", ".join(f"{scale * one:.3g}" for one in found.runs),
    }


def _name(found: "Evidence") -> str:
    return f"{found.suspect.effect} {found.suspect.label}"


def _shown(found: "Evidence") -> tuple[float, str]:
    return {"1": (100.0, "%"), "s": (1e3, "ms"), "m": (1e3, "mm"), "m/s": (1e3, "mm/s")}.get(
        found.suspect.unit, (1.0, found.suspect.unit)
    )


def _size(found: "Evidence") -> str:
    scale, unit = _shown(found)
    return f"{scale * found.size:.3g} {unit}".strip()
